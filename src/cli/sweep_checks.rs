//! Checks whether a recording contains exactly one complete sweep.

use anyhow::anyhow;
use shagreen_core::actuator::calibration::{CalibrationError, Sweep};

use crate::cli::calibrate_recording::Recorded;

/// Duration of an actuator's ringing at the ends of a sweep, in s.
const RINGING_SECS: f64 = 0.5;
/// Fraction of the sweep's peak acceleration above which other vibration is reported.
const AS_LOUD: f64 = 0.5;
/// Length of a recording, in sweep durations, above which several sweeps are suspected.
const SEVERAL_SWEEPS: f64 = 1.8;

/// Returns a warning if the recording contains strong vibration besides the sweep, such as a second sweep.
pub(crate) fn other_sound(recorded: &Recorded, begins_secs: f64, sweep: &Sweep) -> Option<String> {
    let rate_hz = recorded.rate.0;
    let signal = &recorded.acceleration_mps2;
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let (from, to) = (begins_secs - RINGING_SECS, begins_secs + sweep.seconds + RINGING_SECS);
    let is_sweep = |i: usize| (from..to).contains(&(i as f64 / rate_hz));
    let loudest = |of_sweep: bool| {
        let there = signal.iter().enumerate().filter(|(i, _)| is_sweep(*i) == of_sweep);
        there.map(|(i, a)| (i, (a - mean).abs())).max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let ((_, sweep_peak), (at, peak)) = loudest(true).zip(loudest(false))?;
    (peak > AS_LOUD * sweep_peak).then(|| {
        format!(
            "the recording contains other vibration more than half as strong as the sweep, at {:.1} s; the sweep was found from {begins_secs:.1} s on. If it contains two sweeps or knocks, cut it to one sweep with the silence around it",
            at as f64 / rate_hz
        )
    })
}

/// Returns a calibration error with the advice that follows from the length of the recording.
pub(crate) fn advised(error: &CalibrationError, recorded: &Recorded, sweep: &Sweep) -> anyhow::Error {
    let recorded_secs = recorded.acceleration_mps2.len() as f64 / recorded.rate.0;
    let is_unclear = matches!(error, CalibrationError::NoSweep { .. } | CalibrationError::Noisy { .. });
    if is_unclear && recorded_secs > SEVERAL_SWEEPS * sweep.seconds {
        return anyhow!(
            "{error}; the recording of {recorded_secs:.1} s is long enough for several sweeps of {} s: cut it to one, with the silence around it",
            sweep.seconds
        );
    }
    if is_unclear && recorded_secs < sweep.seconds {
        return anyhow!(
            "{error}; the recording of {recorded_secs:.1} s is shorter than the sweep of {} s: record from before its start to after its end",
            sweep.seconds
        );
    }
    anyhow!("{error}")
}
