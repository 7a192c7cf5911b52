//! Options of rendered samples.

use anyhow::bail;
use shagreen_core::units::Hertz;
use shagreen_formats::library::Library;
use shagreen_formats::wav_encoding::{Level, SampleType, WavEncoding};
use shagreen_studio::sound::Sound;

use crate::cli::stroke_signal::Rendering;
use crate::cli::words::words;

/// Rate, seed and encoding of samples.
#[derive(clap::Args)]
pub(crate) struct SampleArgs {
    /// Sample rate of the output, in Hz. Default: the rate of the texture's model.
    #[arg(long, value_name = "HZ", value_parser = clap::value_parser!(u32).range(1..))]
    rate: Option<u32>,
    /// Random seed of the noise; the same seed gives the same samples.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Type of the samples: 32-bit floats, or integers of 24 or 16 bits.
    #[arg(long, value_name = "BITS", default_value = "32", value_parser = words(SampleType::ALL, bits_word))]
    bits: SampleType,
    /// Scale the signal so that its peak is 1 dB below full scale, for players that clip; the sidecar states the
    /// acceleration at full scale. Integers are always scaled.
    #[arg(long)]
    normalize: bool,
    /// Make a loop: the end goes on into the beginning without a click.
    #[arg(long = "loop", conflicts_with = "stroke")]
    loops: bool,
}

impl SampleArgs {
    /// Returns how a sound is rendered: at the rate that was given, or at that of its model.
    pub(crate) fn rendering(&self, library: &Library, sound: &Sound) -> anyhow::Result<Rendering> {
        let rate_hz = match self.rate {
            Some(rate_hz) => rate_hz,
            None => whole(sound.rate(library)?)?,
        };
        Ok(Rendering { rate_hz, seed: self.seed, loops: self.loops })
    }

    /// Returns the encoding of the samples.
    pub(crate) fn encoding(&self) -> WavEncoding {
        let level = if self.normalize { Level::Peak } else { Level::Kept };
        WavEncoding { samples: self.bits, level }
    }

    /// Returns the name of the first option that was given and changes only how samples are stored.
    pub(crate) fn of_encoding(&self) -> Option<&'static str> {
        let bits = (self.bits != SampleType::default()).then_some("--bits");
        bits.or(self.normalize.then_some("--normalize"))
    }

    /// Returns the name of the first option that was given, except of one that has a default.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let rate = self.rate.is_some().then_some("--rate");
        rate.or(self.of_encoding()).or(self.loops.then_some("--loop"))
    }
}

fn bits_word(of: SampleType) -> &'static str {
    match of {
        SampleType::Float32 => "32",
        SampleType::Pcm24 => "24",
        SampleType::Pcm16 => "16",
    }
}

/// Returns a rate as a whole number, as files need it.
fn whole(rate: Hertz) -> anyhow::Result<u32> {
    if rate.0.fract() == 0.0 {
        Ok(rate.0 as u32)
    } else {
        bail!("the model's rate of {rate} is not a whole number; choose a rate with --rate")
    }
}
