//! Signals that a command takes: WAV files, in m/s².

use std::path::Path;

use anyhow::Context as _;
use shagreen_core::filter::resample;
use shagreen_core::spectrum::rms;
use shagreen_core::statistics::{centered, mean};
use shagreen_core::units::Hertz;
use shagreen_formats::signal::{Signal, SignalHints, read_signal};

use crate::cli::motion::positive;
use crate::cli::output::{self, file_name};
use crate::cli::recording_answers::sidecar;

#[derive(clap::Args)]
pub(crate) struct SignalArgs {
    /// What a sample of 1.0 is, in m/s², of WAV files that have no .json beside them.
    #[arg(long, value_name = "MPS2", value_parser = positive)]
    full_scale: Option<f64>,
    /// The channel that is the signal, from 1, where a WAV file has several; three are else taken for its axes.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    channel: Option<u16>,
}

impl SignalArgs {
    /// Whether anything was said that only a signal needs.
    pub(crate) fn is_given(&self) -> bool {
        self.full_scale.is_some() || self.channel.is_some()
    }

    /// The signal of a file at one rate; at another it is brought there, and that is said.
    pub(crate) fn load_at(&self, path: &Path, rate: Hertz) -> anyhow::Result<Vec<f64>> {
        let signal = self.load(path)?;
        if signal.rate == rate {
            return Ok(signal.samples_mps2);
        }
        output::note(&format!("{} was brought from {} to {rate}", file_name(path), signal.rate));
        Ok(resample(&signal.samples_mps2, signal.rate, rate))
    }

    /// The signal of a file.
    pub(crate) fn load(&self, path: &Path) -> anyhow::Result<Signal> {
        let bytes = output::read_file(path)?;
        let beside = sidecar(path).map_err(anyhow::Error::msg).with_context(|| output::in_file(path))?;
        let channel = self.channel.map(|channel| usize::from(channel) - 1);
        let hints = SignalHints { full_scale_mps2: self.full_scale, channel };
        let read = read_signal(&file_name(path), &bytes, beside.as_deref(), hints)
            .with_context(|| output::in_file(path))?;
        for warning in &read.warnings {
            output::warn(&format!("{}: {warning}", file_name(path)));
        }
        let samples = &read.value.samples_mps2;
        let (mean, varying) = (mean(samples), rms(&centered(samples)));
        if mean.abs() > varying && varying > 0.0 {
            output::warn(&format!(
                "{}: {mean:.2} m/s² of it never change, as gravity does; take them off, or nothing is told of what is felt",
                file_name(path)
            ));
        }
        Ok(read.value)
    }
}
