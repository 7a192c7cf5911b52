//! The sweep of a calibration: its options and its WAV file.

use std::path::Path;

use anyhow::anyhow;
use serde_json::json;
use shagreen_core::actuator::calibration::{Sweep, SweepError};
use shagreen_core::units::Hertz;
use shagreen_formats::wav;

use crate::cli::output;
use crate::cli::wav_name::check_wav_name;
use shagreen_studio::replace::refuse_foreign;

/// Sweep to write, or the one that was played.
#[derive(clap::Args)]
pub(crate) struct SweepArgs {
    /// Start frequency of the sweep, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = Sweep::USUAL.low.0)]
    low: f64,
    /// End frequency of the sweep, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = Sweep::USUAL.high.0)]
    high: f64,
    /// Duration of the sweep, in s.
    #[arg(long, value_name = "S", default_value_t = Sweep::USUAL.seconds)]
    seconds: f64,
    /// Peak amplitude of the sweep, as a fraction of digital full scale.
    #[arg(long, value_name = "FRACTION", default_value_t = Sweep::USUAL.amplitude)]
    amplitude: f64,
    /// Silence before and after the sweep, in s.
    #[arg(long, value_name = "S", default_value_t = Sweep::USUAL.silence_secs)]
    silence: f64,
}

impl SweepArgs {
    /// Returns the sweep that the options specify.
    ///
    /// # Errors
    /// A value is out of range, which is wrong usage.
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

/// Returns the error message of a sweep, preceded by the option that caused it.
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

/// Writes the sweep to a WAV file, for any player.
pub(crate) fn write_sweep(sweep: &Sweep, rate_hz: u32, out: &Path, as_json: bool) -> anyhow::Result<()> {
    check_wav_name(out)?;
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
                "Wrote a sweep of {} s from {} to {} Hz ({seconds} s with silence); play it without interruption and record the acceleration\n{}",
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
