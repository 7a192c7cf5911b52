//! Signals given to a command: WAV files in m/s².

use std::path::Path;

use anyhow::Context as _;
use shagreen_core::dsp::filter::resample;
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::maths::statistics::{centered, mean};
use shagreen_core::units::Hertz;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::signal::{Signal, SignalHints, read_signal};

use crate::cli::output;
use crate::cli::quantity::positive;
use crate::cli::recording_answers::sidecar;
use shagreen_studio::file::{self, file_name};

#[derive(clap::Args)]
pub(crate) struct SignalArgs {
    /// Full-scale acceleration in m/s²: the acceleration of a sample value of 1.0. Only for WAV files without a sidecar
    /// file (.json).
    #[arg(long, value_name = "MPS2", value_parser = positive)]
    full_scale: Option<f64>,
    /// Channel of the WAV file to use, counted from 1. Default for three channels: combine them as the axes of an
    /// accelerometer (DFT321).
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    channel: Option<u16>,
}

impl SignalArgs {
    /// Returns whether an option was given that only signals need.
    pub(crate) fn is_given(&self) -> bool {
        self.full_scale.is_some() || self.channel.is_some()
    }

    /// Loads the signal of a file at this rate; resampling is reported.
    pub(crate) fn load_at(&self, path: &Path, rate: Hertz) -> anyhow::Result<Vec<f64>> {
        let signal = self.load(path)?;
        if signal.rate == rate {
            return Ok(signal.samples_mps2);
        }
        output::note(&format!("{} was resampled from {} to {rate}", file_name(path), signal.rate));
        Ok(resample(&signal.samples_mps2, signal.rate, rate))
    }

    /// Loads the signal of a file.
    pub(crate) fn load(&self, path: &Path) -> anyhow::Result<Signal> {
        let bytes = file::read_file(path, FileKind::Recording)?;
        let beside = sidecar(path).map_err(anyhow::Error::msg).with_context(|| file::in_file(path))?;
        let channel = self.channel.map(|channel| usize::from(channel) - 1);
        let hints = SignalHints { full_scale_mps2: self.full_scale, channel };
        let read = read_signal(&file_name(path), &bytes, beside.as_deref(), hints)
            .with_context(|| file::in_file(path))?;
        for warning in &read.warnings {
            output::warn(&format!("{}: {warning}", file_name(path)));
        }
        let samples = &read.value.samples_mps2;
        let (mean, varying) = (mean(samples), rms(&centered(samples)));
        if mean.abs() > varying && varying > 0.0 {
            output::warn(&format!(
                "{}: a constant acceleration of {mean:.2} m/s², such as gravity, is larger than the vibration; subtract it first, or the result does not describe the vibration",
                file_name(path)
            ));
        }
        Ok(read.value)
    }
}
