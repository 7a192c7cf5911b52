//! Start time of the sweep in a recording.

use std::f64::consts::PI;

use realfft::num_complex::Complex;
use rustfft::FftPlanner;

use crate::actuator::calibration::CalibrationError;
use crate::actuator::calibration::impulse::Impulse;
use crate::actuator::calibration::sweep::Sweep;

/// Maximum spread of the octaves' start times in seconds; a strongly resonant actuator is late near its resonance.
const TOGETHER_SECS: f64 = 0.25;
/// Minimum number of octaves that must agree on the start time.
const LEAST_FOUND: usize = 3;

/// Start time of the sweep in seconds. In each octave the impulse response has its maximum at some time; for the right
/// sweep, most octaves agree on it. Noise, hum and other sweeps have their maximum at a different time in each octave.
pub(super) fn locate(impulse: &Impulse, sweep: &Sweep, n_recorded: usize) -> Result<f64, CalibrationError> {
    let octaves = (sweep.high.0 / sweep.low.0).log2();
    let n_bands = octaves.floor() as usize;
    let mut planner = FftPlanner::<f64>::new();
    let n = impulse.samples.len();
    let back = planner.plan_fft_inverse(n);
    let peak_secs = |band: usize| {
        // Octaves overlap by half, so that no frequency is missed.
        let center_hz = sweep.low.0 * 2.0_f64.powf((band as f64 + 0.5) * octaves / n_bands as f64);
        let mut envelope = vec![Complex::default(); n];
        for (k, (to, bin)) in envelope.iter_mut().zip(&impulse.bins).enumerate().skip(1) {
            let away = (k as f64 * impulse.bin_hz() / center_hz).log2().clamp(-1.0, 1.0);
            *to = bin * (0.5 + 0.5 * (PI * away).cos());
        }
        back.process(&mut envelope);
        let loudest = (0..n).max_by(|a, b| envelope[*a].norm_sqr().total_cmp(&envelope[*b].norm_sqr()));
        let at = loudest.unwrap_or(0);
        // In the circular transform, negative times are at the end.
        let at = if at > n_recorded { at as f64 - n as f64 } else { at as f64 };
        at / impulse.rate.0
    };
    let mut begins: Vec<f64> = (0..n_bands).map(peak_secs).collect();
    begins.sort_by(f64::total_cmp);
    let together = |at: usize| begins[at..].iter().take_while(|t| **t - begins[at] <= TOGETHER_SECS).count();
    let (first, n_found) =
        (0..n_bands).map(|at| (at, together(at))).max_by_key(|(_, n)| *n).unwrap_or_default();
    if n_found < LEAST_FOUND.max(n_bands.div_ceil(2)) {
        return Err(CalibrationError::NoSweep {
            sweep_secs: sweep.seconds,
            low_hz: sweep.low.0,
            high_hz: sweep.high.0,
            n_found,
            n_bands,
        });
    }
    // The earliest octaves have no delay of their own.
    Ok(begins[first])
}
