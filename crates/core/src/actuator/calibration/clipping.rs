//! Detection of clipped peaks in a recording.

use crate::actuator::calibration::CalibrationWarning;

/// Minimum number of equal samples in a flat peak.
const LEAST_RUN: usize = 3;
/// Minimum number of flat peaks on one side. A resonance that passes slowly through few converter steps has fewer peaks
/// of the same height.
const LEAST_PEAKS: usize = 8;
/// Minimum drop of the samples next to a flat peak, relative to its height; a rounded sine drops by one converter step.
const LEAST_DROP: f64 = 1e-3;

/// Returns a warning if many peaks are flat at exactly the highest or lowest value. `n_in_sweep` is the number of
/// samples in the sweep.
pub(super) fn clipped_peaks(recording: &[f64], n_in_sweep: f64) -> Option<CalibrationWarning> {
    let mean = recording.iter().sum::<f64>() / recording.len() as f64;
    let sides = [1.0, -1.0].map(|side| {
        let most = recording.iter().fold(f64::NEG_INFINITY, |most, sample| most.max(side * sample));
        let height = most - side * mean;
        let is_top = |sample: &f64| side * sample == most;
        let (mut n_peaks, mut n_samples) = (0, 0);
        let mut at = 0;
        while at < recording.len() {
            let run = recording[at..].iter().take_while(|sample| is_top(sample)).count();
            let edges = [at.checked_sub(1), Some(at + run)].map(|edge| edge.and_then(|i| recording.get(i)));
            let is_steep = edges.iter().flatten().all(|edge| most - side * **edge > LEAST_DROP * height);
            if run >= LEAST_RUN && is_steep {
                n_peaks += 1;
                n_samples += run;
            }
            at += run.max(1);
        }
        (n_peaks, n_samples, side * most)
    });
    let n_peaks: usize = sides.iter().map(|(n, ..)| n).sum();
    let n_samples: usize = sides.iter().map(|(_, n, _)| n).sum();
    let is_clipped = sides.iter().any(|(n, ..)| *n >= LEAST_PEAKS);
    let level_mps2 = sides.iter().max_by_key(|(n, ..)| *n).map_or(0.0, |(.., level)| level.abs());
    let share = (n_samples as f64 / n_in_sweep).min(1.0);
    is_clipped.then_some(CalibrationWarning::Clipped { n_peaks, share, level_mps2 })
}
