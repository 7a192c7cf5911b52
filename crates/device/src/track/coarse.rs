//! Tip speed of recordings with long report intervals, from the distances between the reports.
//!
//! The Kalman filter assumes reports that follow each other within the time in which a hand changes its speed. Between
//! reports further apart it overshoots: it takes the whole distance for the beginning of an acceleration.

use crate::track::PenSample;

/// Usual report interval above which speeds come from distances, in seconds. Pens report at least every 20 ms, for which
/// their last speed is held.
pub(super) const COARSE_INTERVAL_SECS: f64 = 0.025;

/// Returns the speed in m/s at each position: the mean of the speeds on the ways before and after it, each weighted by
/// the duration of the other, which is the second-order difference for unequal intervals. At the ends of a contact it is
/// the speed on the only way, and zero without one. Ways last at most `gap_secs`. Constant motion has exactly its speed.
pub(super) fn coarse_speeds(fixes: &[PenSample], gap_secs: f64) -> Vec<f64> {
    let way = |pair: &[PenSample]| {
        let [from, to] = pair else { return None };
        let secs = to.time_secs - from.time_secs;
        let is_way = from.touching && to.touching && secs > 0.0 && secs <= gap_secs;
        is_way.then(|| ((to.x_m - from.x_m).hypot(to.y_m - from.y_m) / secs, secs))
    };
    let ways: Vec<Option<(f64, f64)>> = fixes.windows(2).map(way).collect();
    let speed = |index: usize| {
        let before = index.checked_sub(1).and_then(|before| ways.get(before).copied().flatten());
        match (before, ways.get(index).copied().flatten()) {
            (Some((before_mps, before_secs)), Some((after_mps, after_secs))) => {
                before_mps + (after_mps - before_mps) * before_secs / (before_secs + after_secs)
            }
            (Some((mps, _)), None) | (None, Some((mps, _))) => mps,
            (None, None) => 0.0,
        }
    };
    (0..fixes.len()).map(speed).collect()
}

#[cfg(test)]
mod tests {
    use super::{PenSample, coarse_speeds};

    /// A contact with unequal intervals on x = t², whose second-order difference is exact: 2 t.
    #[test]
    fn a_steady_acceleration_has_its_exact_speed_between_unequal_ways() {
        let times = [0.0, 0.1, 0.4, 0.5, 1.5];
        let fix = |time_secs: f64| PenSample {
            time_secs,
            x_m: time_secs * time_secs,
            touching: true,
            ..PenSample::default()
        };
        let speeds = coarse_speeds(&times.map(fix), 2.0);
        for (time_secs, speed) in times.iter().zip(&speeds).take(4).skip(1) {
            assert!((speed - 2.0 * time_secs).abs() < 1e-12, "{speed} at {time_secs} s");
        }
        // One-sided at the ends: the mean speed of the first and of the last way.
        assert!((speeds[0] - 0.1).abs() < 1e-12 && (speeds[4] - 2.0).abs() < 1e-12, "{speeds:?}");
    }

    #[test]
    fn lifts_and_gaps_end_a_contact() {
        let fix = |time_secs: f64, x_m: f64, touching: bool| PenSample {
            time_secs,
            x_m,
            touching,
            ..PenSample::default()
        };
        let fixes = [
            fix(0.0, 0.0, true),
            fix(1.0, 0.1, true),
            fix(2.0, 9.0, false),
            fix(3.0, 0.0, true),
            fix(9.0, 5.0, true),
            fix(10.0, 5.2, true),
        ];
        let speeds = coarse_speeds(&fixes, 2.0);
        for (speed, expected) in speeds.iter().zip([0.1, 0.1, 0.0, 0.0, 0.2, 0.2]) {
            assert!((speed - expected).abs() < 1e-12, "{speeds:?}");
        }
        assert!(coarse_speeds(&[], 1.0).is_empty());
    }
}
