//! Choice of the stream format to open.

use cpal::{SampleFormat, SupportedStreamConfigRange};

use crate::engine::ChannelMask;
use crate::output_options::OpenOptions;

/// Returns the stream format and the rate to open. The criteria, in order: all wanted channels if possible, the rate
/// closest to the preferred one, as few other channels as possible, the best sample format.
pub(super) fn choose(
    configs: &[SupportedStreamConfigRange],
    options: OpenOptions,
) -> Option<(SupportedStreamConfigRange, u32)> {
    let preferred_hz = options.preferred_rate_hz.unwrap_or(options.usual_audio_rate_hz());
    let least_hz = options.model_rate_hz.ceil() as u32;
    let rated = configs.iter().filter(|config| config.max_sample_rate() >= least_hz).map(|config| {
        let lowest_hz = config.min_sample_rate().max(least_hz);
        (*config, preferred_hz.clamp(lowest_hz, config.max_sample_rate()))
    });
    rated
        .filter(|(config, _)| {
            usize::from(config.channels()) >= options.channels.n_least()
                && rank_of(config.sample_format()).is_some()
        })
        .min_by_key(|(config, rate_hz)| {
            let n_channels = usize::from(config.channels());
            let n_wanted = channels_to_open(options.all_channels());
            let missing = n_wanted.saturating_sub(n_channels);
            let rest = n_channels.saturating_sub(n_wanted);
            (missing, rate_hz.abs_diff(preferred_hz), rest, rank_of(config.sample_format()))
        })
}

/// At least two channels: mono formats are rarer, and the system often emulates them with two channels.
fn channels_to_open(mask: ChannelMask) -> usize {
    mask.n_wanted().max(2)
}

/// Rank of a playable sample format, best first; `None` if it cannot be played.
fn rank_of(format: SampleFormat) -> Option<u8> {
    match format {
        SampleFormat::F32 => Some(0),
        SampleFormat::I32 => Some(1),
        SampleFormat::I24 => Some(2),
        SampleFormat::F64 => Some(3),
        SampleFormat::I16 => Some(4),
        SampleFormat::U16 => Some(5),
        SampleFormat::U8 => Some(6),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{ChannelMask, OpenOptions, SampleFormat, SupportedStreamConfigRange, choose};
    use crate::engine::{FrictionConfig, FrictionWave};
    use crate::output::tests::OPTIONS;
    use cpal::SupportedBufferSize;

    fn range(channels: u16, low_hz: u32, high_hz: u32, format: SampleFormat) -> SupportedStreamConfigRange {
        SupportedStreamConfigRange::new(channels, low_hz, high_hz, SupportedBufferSize::Unknown, format)
    }

    /// Channels, rate and format of the chosen stream.
    fn chosen(
        configs: &[SupportedStreamConfigRange],
        options: OpenOptions,
    ) -> Option<(u16, u32, SampleFormat)> {
        choose(configs, options).map(|(config, rate_hz)| (config.channels(), rate_hz, config.sample_format()))
    }

    #[test]
    fn two_channels_of_floats_at_the_usual_rate() {
        let mut configs = Vec::new();
        for channels in [1, 2, 6] {
            for format in [SampleFormat::I16, SampleFormat::F32, SampleFormat::I32] {
                configs.push(range(channels, 8000, 44_100, format));
                configs.push(range(channels, 48_000, 192_000, format));
            }
        }
        assert_eq!(chosen(&configs, OPTIONS), Some((2, 48_000, SampleFormat::F32)));
        let at = |hz| OpenOptions { preferred_rate_hz: Some(hz), ..OPTIONS };
        assert_eq!(chosen(&configs, at(44_100)), Some((2, 44_100, SampleFormat::F32)));
        assert_eq!(chosen(&configs, at(96_000)), Some((2, 96_000, SampleFormat::F32)));
        assert_eq!(chosen(&configs, at(47_000)), Some((2, 48_000, SampleFormat::F32)));
        let fourth = OpenOptions { channels: ChannelMask::only(3), ..OPTIONS };
        assert_eq!(chosen(&configs, fourth), Some((6, 48_000, SampleFormat::F32)));
    }

    #[test]
    fn friction_gets_its_channel_and_a_rate_for_its_carrier_if_there_is_one() {
        let configs = [2, 4].map(|channels| range(channels, 8000, 192_000, SampleFormat::F32));
        let with = |channel_idx, frequency_hz| {
            let wave = FrictionWave::Carrier { frequency_hz };
            OpenOptions { friction: Some(FrictionConfig { channel_idx, wave }), ..OPTIONS }
        };
        assert_eq!(chosen(&configs, with(2, 120.0)), Some((4, 48_000, SampleFormat::F32)));
        assert_eq!(chosen(&configs, with(2, 30_000.0)), Some((4, 96_000, SampleFormat::F32)));
        assert_eq!(chosen(&configs, with(3, 80_000.0)), Some((4, 192_000, SampleFormat::F32)));
        assert_eq!(chosen(&configs[..1], with(2, 120.0)), Some((2, 48_000, SampleFormat::F32)));
        assert_eq!(chosen(&configs[..1], with(1, 120.0)), Some((2, 48_000, SampleFormat::F32)));
    }

    #[test]
    fn takes_what_there_is() {
        assert_eq!(
            chosen(&[range(1, 16_000, 16_000, SampleFormat::I16)], OPTIONS),
            Some((1, 16_000, SampleFormat::I16))
        );
        assert_eq!(
            chosen(&[range(8, 44_100, 44_100, SampleFormat::U16)], OPTIONS),
            Some((8, 44_100, SampleFormat::U16))
        );
        // The rate has priority over the sample format.
        let configs = [range(2, 8000, 8000, SampleFormat::F32), range(2, 48_000, 48_000, SampleFormat::I16)];
        assert_eq!(chosen(&configs, OPTIONS), Some((2, 48_000, SampleFormat::I16)));
    }

    #[test]
    fn never_below_the_rate_of_the_model_and_never_without_its_channel() {
        let fast = OpenOptions { model_rate_hz: 4000.0, preferred_rate_hz: Some(1000), ..OPTIONS };
        assert_eq!(
            chosen(&[range(2, 1, 384_000, SampleFormat::F32)], fast),
            Some((2, 4000, SampleFormat::F32))
        );
        assert_eq!(chosen(&[range(2, 2000, 3999, SampleFormat::F32)], fast), None);
        let third = OpenOptions { channels: ChannelMask::only(2), ..OPTIONS };
        assert_eq!(chosen(&[range(2, 48_000, 48_000, SampleFormat::F32)], third), None);
        assert_eq!(chosen(&[range(2, 48_000, 48_000, SampleFormat::DsdU8)], OPTIONS), None);
        assert_eq!(chosen(&[], OPTIONS), None);
    }
}
