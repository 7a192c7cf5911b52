//! Offline rendering of the tap transients in a stroke: an engine like that of an output plays the stroke without a
//! texture.

use anyhow::{Context as _, bail};
use shagreen_device::engine::{self, ChannelMask, EngineConfig};
use shagreen_device::impact::strength_of;
use shagreen_device::synth::drive::DriveConfig;
use shagreen_device::synth::renderer::Renderer;
use shagreen_device::synth::tap::{MAX_AMPLITUDE_MPS2, Tap, amplitude_factor};
use shagreen_device::track::{Track, TrackLanding};

/// Acceleration at full scale, in m/s²: far above any tap transient, so that nothing is limited, and a power of two, so
/// that nothing is rounded.
const FULL_SCALE_MPS2: f32 = 1_048_576.0;
/// Ticks before the stroke, in which the engine's initial fade ends.
const TICKS_AHEAD: f64 = 10.0;

/// Tap transients that were added to a signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AddedTaps {
    /// Time in s of the landing whose tap transient is the larger part of the peak of the signal; `None` if the peak is
    /// elsewhere.
    pub peak_landing_secs: Option<f64>,
    /// Number of landings so fast that their tap transient is limited to [`MAX_AMPLITUDE_MPS2`].
    pub n_limited: usize,
}

/// Adds the tap transients of a stroke to a rendered texture, in m/s² at a rate in Hz; `model_rate_hz` is the rate of
/// the texture. A tap transient begins at the end of the tick that detects the landing, as it does live, and scales with
/// the impact speed if the stroke states it. A stroke that starts in contact does not land there.
///
/// # Errors
/// The engine does not support the rates.
pub fn add_tap_transients(
    samples: &mut [f32],
    rate_hz: u32,
    model_rate_hz: f64,
    stroke: Track,
    tap: Tap,
) -> anyhow::Result<AddedTaps> {
    let config = EngineConfig {
        model_rate_hz: model_rate_hz as f32,
        device_rate_hz: rate_hz as f32,
        seed: 0, // There is no noise.
        drive: DriveConfig::proportional(FULL_SCALE_MPS2, 1.0),
        channels: ChannelMask::only(0),
        friction: None,
    };
    let (mut handle, mut engine) = engine::new(config).context("the tap transients cannot be rendered")?;
    handle.set_tap(tap);
    let landings = stroke.landings().to_vec();
    let tick_secs = Renderer::new(config.model_rate_hz, config.seed).tick_len() as f64 / model_rate_hz;
    let frames_in = |ticks: f64| (ticks * tick_secs * f64::from(rate_hz)) as usize;
    // In the middle of a tick, so that rounding cannot change the tick in which the stroke begins.
    let n_ahead = frames_in(TICKS_AHEAD + 0.5);
    engine.process(&mut vec![0.0; n_ahead], 1);
    if handle.play_track(stroke).is_err() {
        bail!("the tap transients cannot be rendered: the engine does not accept the stroke; try again");
    }
    // The stroke's clock started at the end of the last tick that was rendered.
    let n_late = frames_in(TICKS_AHEAD + 1.0) - n_ahead;
    engine.process(&mut vec![0.0; n_late], 1);
    // One tick at a time: of several contacts in a block, only the last is played.
    let mut block = vec![0.0; frames_in(1.0).max(1)];
    let (mut n_done, mut peak) = (0, Peak::default());
    for part in samples.chunks_mut(block.len()) {
        let block = &mut block[..part.len()];
        engine.process(block, 1);
        for (index, (sample, drive)) in (n_done..).zip(part.iter_mut().zip(block.iter())) {
            let tap_mps2 = FULL_SCALE_MPS2 * drive;
            *sample += tap_mps2;
            if sample.abs() > peak.sum_mps2 {
                peak = Peak { sum_mps2: sample.abs(), tap_mps2: tap_mps2.abs(), index };
            }
        }
        n_done += part.len();
    }
    Ok(AddedTaps {
        peak_landing_secs: peak.landing_secs(&landings, f64::from(rate_hz)),
        n_limited: landings.iter().filter(|landing| is_limited(tap, landing)).count(),
    })
}

/// Highest sample of a signal, and the part of the tap transients in it, both without their signs.
#[derive(Clone, Copy, Debug, Default)]
struct Peak {
    sum_mps2: f32,
    tap_mps2: f32,
    index: usize,
}

impl Peak {
    /// Returns the time in s of the landing that makes most of the peak.
    fn landing_secs(&self, landings: &[TrackLanding], rate_hz: f64) -> Option<f64> {
        if self.tap_mps2 <= 0.5 * self.sum_mps2 {
            return None;
        }
        // Whole frames may begin up to two frames before the landing.
        let latest_secs = (self.index as f64 + 2.0) / rate_hz;
        let n_begun = landings.partition_point(|landing| landing.time_secs <= latest_secs);
        Some(landings.get(n_begun.checked_sub(1)?)?.time_secs)
    }
}

/// Whether the tap transient of a landing is limited.
fn is_limited(tap: Tap, landing: &TrackLanding) -> bool {
    let factor = amplitude_factor(strength_of(landing.impact_mps));
    f64::from(tap.amplitude_mps2) * factor > MAX_AMPLITUDE_MPS2
}

#[cfg(test)]
mod tests {
    mod landings;

    use super::{AddedTaps, Tap, Track, add_tap_transients};
    use shagreen_device::track::PenSample;

    const WOOD: Tap = Tap { frequency_hz: 180.0, decay_per_sec: 90.0, amplitude_mps2: 6.0 };

    /// A pen that touches the surface during these parts of two seconds.
    fn stroke(touching: &[(f64, f64)]) -> Track {
        let sample = |i: u32| {
            let time_secs = 0.001 * f64::from(i);
            let touching = touching.iter().any(|(from, to)| (*from..*to).contains(&time_secs));
            PenSample { time_secs, x_m: 0.1 * time_secs, force_n: 1.0, touching, ..PenSample::default() }
        };
        Track::new(&(0..2000).map(sample).collect::<Vec<_>>()).unwrap()
    }

    fn rendered(touching: &[(f64, f64)], rate_hz: u32, model_rate_hz: f64) -> Vec<f32> {
        let mut samples = vec![0.0; 2 * rate_hz as usize];
        add_tap_transients(&mut samples, rate_hz, model_rate_hz, stroke(touching), WOOD).unwrap();
        samples
    }

    /// Each tap transient follows its equation, starting within one tick after the first touch.
    #[test]
    fn a_landing_rings_as_the_equation_says_from_the_next_tick_on() {
        for (rate_hz, model_rate_hz) in [(1000, 1000.0), (4000, 1000.0), (44_100, 1000.0), (48_000, 2000.0)] {
            let samples = rendered(&[(0.5013, 0.8), (1.2, 1.9)], rate_hz, model_rate_hz);
            let rate = f64::from(rate_hz);
            for (landed_secs, until_secs) in [(0.5013, 1.2), (1.2, 2.0)] {
                let from = (landed_secs * rate) as usize - 2;
                let begin = from + samples[from..].iter().position(|x| x.abs() > 0.0).unwrap() - 1;
                let late_secs = begin as f64 / rate - landed_secs;
                // A tick is 5 ms; the pen reports every millisecond, and frames are whole.
                assert!((-1.5 / rate..=0.0061).contains(&late_secs), "{late_secs} s late at {rate_hz} Hz");
                for (i, x) in samples[begin..(until_secs * rate) as usize].iter().enumerate() {
                    let t = i as f64 / rate;
                    let expected = 6.0 * (-90.0 * t).exp() * (std::f64::consts::TAU * 180.0 * t).sin();
                    // Rounding of `f32`, and the transient is cut off at 1e-5 m/s².
                    assert!((f64::from(*x) - expected).abs() < 2e-5, "{x} for {expected} at {t} s");
                }
            }
            assert!(samples[..(0.5 * rate) as usize].iter().all(|x| *x == 0.0));
        }
    }

    #[test]
    fn a_stroke_that_begins_on_the_surface_does_not_land_there() {
        let first = |touching: &[(f64, f64)]| rendered(touching, 4000, 1000.0).iter().position(|x| *x != 0.0);
        assert_eq!(first(&[(0.0, 1.0)]), None);
        assert_eq!(first(&[]), None);
        // It lands after its first lift.
        let landed = first(&[(0.0, 0.5), (1.0, 1.5)]).unwrap();
        assert!((3999..=4026).contains(&landed), "{landed}");
    }

    /// A gap in the recording is a lift, and the first sample may state that it is a landing.
    #[test]
    fn a_landing_follows_a_gap_or_a_stated_impact() {
        let first = |times: &[(u32, u32)], impact_mps: Option<f64>| {
            let sample = |i: u32| PenSample {
                time_secs: 0.001 * f64::from(i),
                force_n: 1.0,
                touching: true,
                impact_mps: impact_mps.filter(|_| i == 0),
                ..PenSample::default()
            };
            let samples: Vec<PenSample> =
                times.iter().flat_map(|(from, to)| (*from..*to).map(sample)).collect();
            let mut signal = vec![0.0; 4000];
            let track = Track::new(&samples).unwrap();
            add_tap_transients(&mut signal, 4000, 1000.0, track, WOOD).unwrap();
            signal.iter().position(|x| *x != 0.0)
        };
        assert!((1999..=2026).contains(&first(&[(0, 300), (500, 900)], None).unwrap()));
        assert!(first(&[(0, 900)], Some(0.1)).unwrap() <= 24);
        assert_eq!((first(&[(0, 900)], None), first(&[(0, 900)], Some(0.0))), (None, None));
    }

    #[test]
    fn the_peak_is_attributed_to_its_landing_and_limited_landings_are_counted() {
        let added = |background: f32, amplitude_mps2: f32| {
            let mut samples = vec![0.0; 8000];
            samples[1000] = background;
            let tap = Tap { amplitude_mps2, ..WOOD };
            add_tap_transients(&mut samples, 4000, 1000.0, stroke(&[(0.5, 0.8), (1.2, 1.9)]), tap).unwrap()
        };
        let AddedTaps { peak_landing_secs, n_limited } = added(0.1, 6.0);
        assert!((peak_landing_secs.unwrap() - 0.5).abs() < 1e-9 && n_limited == 0, "{peak_landing_secs:?}");
        assert_eq!(added(100.0, 6.0), AddedTaps { peak_landing_secs: None, n_limited: 0 });
        assert_eq!(added(0.1, 2000.0).n_limited, 2);
    }
}
