//! Onsets of contacts in a recorded signal.

/// Duration of a stroke, in seconds.
pub(crate) const STROKE_SECS: f64 = 0.4;
/// Level at the onset, relative to the level of the stroke.
const FELT_SHARE: f64 = 0.5;
/// Window over which a level is computed, in seconds.
const LEVEL_SECS: f64 = 0.004;

/// Returns the number of samples from a contact to the first that exceeds the noise before it; `None` without a clear
/// tap transient.
pub(crate) fn tap_onset(heard: &[f32], begin: usize, rate_hz: f64) -> Option<usize> {
    let before = heard.get(begin.checked_sub((0.1 * rate_hz) as usize)?..begin)?;
    let silence = before.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
    let after = heard.get(begin..begin + (STROKE_SECS * rate_hz) as usize)?;
    let peak = after.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
    // A tap transient reaches 1 % of its peak 0.05 ms after its onset.
    let threshold = (2.0 * silence).max(0.01 * peak);
    (peak > 5.0 * silence + 1e-4).then(|| after.iter().position(|x| x.abs() > threshold))?
}

/// Returns the number of samples from a contact until the level reaches half that of the stroke; `None` without a clear
/// stroke.
pub(crate) fn stroke_onset(heard: &[f32], begin: usize, rate_hz: f64) -> Option<usize> {
    let window = (LEVEL_SECS * rate_hz) as usize;
    let rms = |from: usize, n: usize| {
        let part = heard.get(from..from + n)?;
        Some((part.iter().map(|x| f64::from(x * x)).sum::<f64>() / n as f64).sqrt())
    };
    let level = rms(begin + (0.15 * rate_hz) as usize, (0.2 * rate_hz) as usize)?;
    let silence = rms(begin.checked_sub((0.1 * rate_hz) as usize)?, (0.08 * rate_hz) as usize)?;
    if level < 5.0 * silence + 1e-5 {
        return None;
    }
    let step = (window / 8).max(1);
    let half = window / 2;
    let is_felt = |at: usize| rms(begin + at - half, window).is_some_and(|l| l > FELT_SHARE * level);
    (half..(0.3 * rate_hz) as usize).step_by(step).find(|at| is_felt(*at))
}

/// Returns the quantile of sorted numbers at `share`, 0..1; NaN without numbers.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    sorted.get((share * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::{quantile, stroke_onset, tap_onset};

    #[test]
    fn onsets_are_found_where_they_are() {
        let rate_hz = 48_000.0;
        let at = |i: usize| if i < 10_720 { 1e-5 } else { 0.4 * ((i - 10_720) as f32 * 0.03).sin() };
        let tap: Vec<f32> = (0..40_000).map(at).collect();
        let found = tap_onset(&tap, 10_000, rate_hz).unwrap();
        assert!((720..730).contains(&found), "{found}");
        assert_eq!(tap_onset(&vec![1e-5; 40_000], 10_000, rate_hz), None);
        let ramp = |i: u32| {
            let share = ((f64::from(i) as f32 - 10_480.0) / 480.0).clamp(0.0, 1.0);
            0.3 * share * if i.is_multiple_of(2) { 1.0 } else { -1.0 }
        };
        let stroke: Vec<f32> = (0..40_000).map(ramp).collect();
        let found = stroke_onset(&stroke, 10_000, rate_hz).unwrap();
        assert!((690..760).contains(&found), "{found}");
        assert_eq!(stroke_onset(&vec![0.0; 40_000], 10_000, rate_hz), None);
    }

    #[test]
    fn quantiles_of_a_few() {
        let of = |share| quantile(&[1.0, 2.0, 3.0], share);
        assert_eq!((of(0.0), of(0.5), of(1.0)), (1.0, 2.0, 3.0));
        assert!(quantile(&[], 0.5).is_nan());
    }
}
