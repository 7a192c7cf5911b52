//! What lets one doubt that a recording is that of one whole sweep.

use anyhow::anyhow;
use shagreen_core::calibration::{CalibrationError, Sweep};

use crate::cli::calibrate_recording::Recorded;

/// How long an actuator rings at the ends of a sweep, in seconds.
const RINGING_SECS: f64 = 0.5;
/// Share of the sweep's highest acceleration that counts as loud.
const AS_LOUD: f64 = 0.5;
/// Lengths of the sweep in a recording that may hold more than one.
const SEVERAL_SWEEPS: f64 = 1.8;

/// What is to be said where something else than the sweep, such as another one, is in the recording.
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
            "something else as loud as the sweep is in the recording, at {:.1} s, while the sweep was found from {begins_secs:.1} s on: where there are two sweeps or knocks, cut it to one sweep with the silence around it",
            at as f64 / rate_hz
        )
    })
}

/// What is wrong with a recording, and what its length lets one suspect.
pub(crate) fn advised(error: &CalibrationError, recorded: &Recorded, sweep: &Sweep) -> anyhow::Error {
    let recorded_secs = recorded.acceleration_mps2.len() as f64 / recorded.rate.0;
    let is_unclear = matches!(error, CalibrationError::NoSweep { .. } | CalibrationError::Noisy { .. });
    if is_unclear && recorded_secs > SEVERAL_SWEEPS * sweep.seconds {
        return anyhow!(
            "{error}; the recording of {recorded_secs:.1} s has room for several sweeps of {} s: cut it to one, with the silence around it",
            sweep.seconds
        );
    }
    if is_unclear && recorded_secs < sweep.seconds {
        return anyhow!(
            "{error}; the recording has {recorded_secs:.1} s, less than the sweep of {} s: record from before its beginning to after its end",
            sweep.seconds
        );
    }
    anyhow!("{error}")
}
