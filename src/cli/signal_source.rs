//! Signals that a command takes: WAV files, in m/s².

use std::path::Path;

use anyhow::Context as _;
use shagreen_core::filter::resample;
use shagreen_core::units::Hertz;
use shagreen_formats::signal::{Signal, read_signal};

use crate::cli::motion::quantity;
use crate::cli::output::{self, file_name};
use crate::cli::recording_answers::sidecar;

#[derive(clap::Args)]
pub(crate) struct SignalArgs {
    /// What a sample of 1.0 is, in m/s²; overrules the .json beside a WAV file.
    #[arg(long, value_name = "MPS2", value_parser = positive)]
    full_scale: Option<f64>,
}

fn positive(text: &str) -> Result<f64, String> {
    let value = quantity(text)?;
    if value > 0.0 { Ok(value) } else { Err("a full scale lies above zero".to_owned()) }
}

impl SignalArgs {
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
        let read = read_signal(&file_name(path), &bytes, beside.as_deref(), self.full_scale)
            .with_context(|| output::in_file(path))?;
        for warning in &read.warnings {
            output::warn(&format!("{}: {warning}", file_name(path)));
        }
        Ok(read.value)
    }
}
