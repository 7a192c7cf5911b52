//! The sweep of a calibration: how it is asked for, and the file to play it from.

use std::path::Path;

use anyhow::anyhow;
use serde_json::json;
use shagreen_core::calibration::{Sweep, SweepError};
use shagreen_core::units::Hertz;
use shagreen_formats::wav;

use crate::cli::guard::refuse_foreign;
use crate::cli::output;

/// The sweep that is written, or was played.
#[derive(clap::Args)]
pub(crate) struct SweepArgs {
    /// Frequency at which the sweep begins, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = Sweep::USUAL.low.0)]
    low: f64,
    /// Frequency at which it ends, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = Sweep::USUAL.high.0)]
    high: f64,
    /// How long it takes, in s.
    #[arg(long, value_name = "S", default_value_t = Sweep::USUAL.seconds)]
    seconds: f64,
    /// Its peak as a share of digital full scale.
    #[arg(long, value_name = "SHARE", default_value_t = Sweep::USUAL.amplitude)]
    amplitude: f64,
    /// Silence before and behind it, in s.
    #[arg(long, value_name = "S", default_value_t = Sweep::USUAL.silence_secs)]
    silence: f64,
}

impl SweepArgs {
    /// The sweep that is asked for.
    ///
    /// # Errors
    /// A number of it has no meaning, which is wrong usage.
    pub(crate) fn sweep(&self) -> anyhow::Result<Sweep> {
        let sweep = Sweep {
            low: Hertz(self.low),
            high: Hertz(self.high),
            seconds: self.seconds,
            amplitude: self.amplitude,
            silence_secs: self.silence,
        };
        sweep.check().map_err(|error| output::Usage(by_option(&error)))?;
        Ok(sweep)
    }
}

/// What is wrong with a sweep, by the option that says it.
pub(crate) fn by_option(error: &SweepError) -> String {
    let option = match error {
        SweepError::Number { what: "the beginning in Hz", .. } => "--low",
        SweepError::Number { what: "the end in Hz", .. } => "--high",
        SweepError::Number { what: "the length in s", .. } => "--seconds",
        SweepError::Number { what: "the amplitude", .. } => "--amplitude",
        SweepError::Number { what: "the silence in s", .. } => "--silence",
        _ => return error.to_string(),
    };
    format!("{option}: {error}")
}

/// Writes the sweep, to be played by whatever.
pub(crate) fn write_sweep(sweep: &Sweep, rate_hz: u32, out: &Path, as_json: bool) -> anyhow::Result<()> {
    refuse_foreign(out, "the sweep", |bytes| bytes.starts_with(b"RIFF"))?;
    let samples = sweep.drive_samples(f64::from(rate_hz)).map_err(|error| anyhow!(by_option(&error)))?;
    wav::write_samples(out, &samples, rate_hz)?;
    let seconds = samples.len() as f64 / f64::from(rate_hz);
    output::print(
        as_json,
        &json!({
            "sweep": out.display().to_string(),
            "rate_hz": rate_hz,
            "seconds": seconds,
            "sweep_seconds": sweep.seconds,
            "low_hz": sweep.low.0,
            "high_hz": sweep.high.0,
            "amplitude": sweep.amplitude,
        }),
        || {
            format!(
                "Wrote a sweep of {} s from {} to {} Hz, {seconds} s with the silence around it, to play at once and record\n{}",
                sweep.seconds,
                sweep.low.0,
                sweep.high.0,
                out.display()
            )
        },
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Hertz, Sweep, by_option};

    #[test]
    fn every_limit_names_its_option() {
        let usual = Sweep::USUAL;
        for (option, sweep) in [
            ("--low", Sweep { low: Hertz(0.0), ..usual }),
            ("--high", Sweep { high: Hertz(20.0), ..usual }),
            ("--seconds", Sweep { seconds: 0.5, ..usual }),
            ("--amplitude", Sweep { amplitude: 1.5, ..usual }),
            ("--silence", Sweep { silence_secs: -1.0, ..usual }),
        ] {
            let error = by_option(&sweep.check().unwrap_err());
            assert!(error.starts_with(option) && error.contains("needs"), "{error}");
        }
    }
}
