//! Estimation of the tip position between two stylus reports.

use shagreen_synth::contact::Place;

/// Fraction of the position error that is corrected in a tick. Reports arrive irregularly, and a step would click.
const CATCH_UP: f64 = 0.25;
/// Weight of a new velocity in the velocity estimate.
const SMOOTHING: f64 = 0.5;
/// Position error, in m, above which the tip is treated as having jumped.
const LOST_M: f64 = 0.03;
/// Longest extrapolation of the motion, in s. An overshoot has to be reversed.
const MOST_AHEAD_SECS: f64 = 0.02;

/// Position along one axis, tracked from reports without steps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FollowedPlace {
    /// Last reported position in m, its time in s, and the smoothed velocity in m/s along the axis.
    reported_m: f64,
    reported_secs: f64,
    velocity_mps: f64,
    place_m: f64,
    n_jumps: u32,
}

impl FollowedPlace {
    /// Records a reported position at a time, reached by motion from the last report.
    pub(super) fn report(&mut self, place_m: f64, secs: f64) {
        let step_secs = secs - self.reported_secs;
        if step_secs > 0.0 {
            let velocity_mps = (place_m - self.reported_m) / step_secs;
            // Report times have jitter, so the velocity from two reports is noisy.
            self.velocity_mps += SMOOTHING * (velocity_mps - self.velocity_mps);
        }
        (self.reported_m, self.reported_secs) = (place_m, secs);
    }

    /// Records a position at a time, reached by a jump.
    pub(super) fn begin(&mut self, place_m: f64, secs: f64) {
        let n_jumps = self.n_jumps;
        *self = Self { reported_m: place_m, reported_secs: secs, velocity_mps: 0.0, place_m, n_jumps };
        self.jump();
    }

    /// Returns the position at a time, one tick of `step_secs` after the last call. The tip is extrapolated with a
    /// velocity of at most `speed_mps`, which is zero once reports have stopped.
    pub(super) fn at(&mut self, secs: f64, step_secs: f64, speed_mps: f64) -> f64 {
        let velocity_mps = self.velocity_mps.min(speed_mps).max(-speed_mps);
        let wanted_m =
            self.reported_m + velocity_mps * (secs - self.reported_secs).clamp(0.0, MOST_AHEAD_SECS);
        let on_the_way_m = self.place_m + velocity_mps * step_secs;
        let off_m = wanted_m - on_the_way_m;
        self.place_m = if off_m.abs() > LOST_M { wanted_m } else { on_the_way_m + CATCH_UP * off_m };
        self.place_m
    }

    /// Marks the next position as reached by a jump.
    pub(super) fn jump(&mut self) {
        self.n_jumps = self.n_jumps.wrapping_add(1);
    }

    /// Sets the position.
    pub(super) fn set(&mut self, place_m: f64) {
        self.place_m = place_m;
    }

    /// Position at the last call.
    pub(super) fn place(&self) -> Place {
        Place { x_m: self.place_m, n_jumps: self.n_jumps }
    }
}

#[cfg(test)]
mod tests {
    use super::FollowedPlace;

    const TICK_SECS: f64 = 0.005;

    /// Reports at 133 Hz with delay and jitter: the position moves evenly and stays close to the tip.
    #[test]
    fn a_steady_tip_is_followed_evenly() {
        let mut place = FollowedPlace::default();
        let (mut next_report, mut before, mut n) = (0.0_f64, 0.0, 0_u32);
        for tick in 1..400 {
            let now = TICK_SECS * f64::from(tick);
            while next_report + 0.003 <= now {
                // Positions are quantized to 10 µm, and times have jitter.
                let rough_secs = next_report + [0.0, 4e-4, -3e-4][n as usize % 3];
                place.report((0.08 * next_report * 1e5).round() / 1e5, rough_secs);
                n += 1;
                next_report += 1.0 / 133.0 + if n % 2 == 0 { 0.001 } else { -0.001 };
            }
            let at = place.at(now, TICK_SECS, 0.08);
            if tick > 40 {
                assert!((at - 0.08 * now).abs() < 2e-4, "{at} at {now}");
                assert!(
                    ((at - before) / TICK_SECS - 0.08).abs() < 0.012,
                    "{} m/s",
                    (at - before) / TICK_SECS
                );
            }
            before = at;
        }
    }

    #[test]
    fn a_tip_that_says_no_more_stands_and_one_that_is_elsewhere_is_there() {
        let mut place = FollowedPlace::default();
        place.report(0.0, 0.0);
        place.report(0.001, 0.01);
        for tick in 1..100 {
            place.at(0.01 + TICK_SECS * f64::from(tick), TICK_SECS, 0.0);
        }
        assert!((place.place().x_m - 0.001).abs() < 1e-6);
        place.begin(0.02, 1.0);
        for tick in 0..20 {
            let at = place.at(1.0 + TICK_SECS * f64::from(tick), TICK_SECS, 1.0);
            assert!((at - 0.02).abs() < 1e-12, "the position moves to {at}");
        }
        place.set(0.05);
        assert!((place.place().x_m - 0.05).abs() < 1e-12);
    }
}
