//! Estimation of the tip position between two stylus reports.

use shagreen_synth::contact::Place;

/// Fraction of the position error that is corrected in a tick. Reports arrive irregularly, and a step would click.
const CATCH_UP: f64 = 0.25;
/// Weight of a new velocity in the velocity estimate.
const SMOOTHING: f64 = 0.5;
/// Position error, in m, above which the tip is treated as having jumped.
const LOST_M: f64 = 0.03;
/// Speed in m/s at which the position may catch up, in addition to the tip's own speed. The level of a height map grows
/// with the speed of the position, so that a late report must not become a burst.
const CATCH_UP_MPS: f64 = 0.05;
/// Longest extrapolation of the motion, in s. An overshoot has to be reversed.
const MOST_AHEAD_SECS: f64 = 0.02;

/// Position on the pad, tracked from reports without steps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FollowedPlace {
    /// Last reported position in m, its time in s, and the smoothed velocity in m/s; to the right and upwards.
    reported_m: [f64; 2],
    reported_secs: f64,
    velocity_mps: [f64; 2],
    place_m: [f64; 2],
    n_jumps: u32,
}

impl FollowedPlace {
    /// Records a reported position at a time, reached by motion from the last report.
    pub(super) fn report(&mut self, place_m: [f64; 2], secs: f64) {
        let step_secs = secs - self.reported_secs;
        if step_secs > 0.0 {
            for ((smoothed_mps, place_m), reported_m) in
                self.velocity_mps.iter_mut().zip(place_m).zip(self.reported_m)
            {
                let velocity_mps = (place_m - reported_m) / step_secs;
                // Report times have jitter, so the velocity from two reports is noisy.
                *smoothed_mps += SMOOTHING * (velocity_mps - *smoothed_mps);
            }
        }
        (self.reported_m, self.reported_secs) = (place_m, secs);
    }

    /// Records a position at a time, reached by a jump.
    pub(super) fn begin(&mut self, place_m: [f64; 2], secs: f64) {
        let n_jumps = self.n_jumps;
        *self = Self { reported_m: place_m, reported_secs: secs, velocity_mps: [0.0; 2], place_m, n_jumps };
        self.jump();
    }

    /// Returns the position at a time, one tick of `step_secs` after the last call. The tip is extrapolated with a
    /// velocity of at most `speed_mps`, which is zero once reports have stopped.
    pub(super) fn at(&mut self, secs: f64, step_secs: f64, speed_mps: f64) -> [f64; 2] {
        let estimated_mps = length(self.velocity_mps);
        let share = if estimated_mps > speed_mps { speed_mps / estimated_mps } else { 1.0 };
        let ahead_secs = (secs - self.reported_secs).clamp(0.0, MOST_AHEAD_SECS);
        let moved =
            |from_m: [f64; 2], secs: f64| [0, 1].map(|i| from_m[i] + share * self.velocity_mps[i] * secs);
        let wanted_m = moved(self.reported_m, ahead_secs);
        let on_the_way_m = moved(self.place_m, step_secs);
        let off_m = [0, 1].map(|i| wanted_m[i] - on_the_way_m[i]);
        self.place_m = if length(off_m) > LOST_M {
            wanted_m
        } else {
            let most_m = (speed_mps + CATCH_UP_MPS) * step_secs;
            let share = CATCH_UP.min(most_m / length(off_m).max(f64::MIN_POSITIVE));
            [0, 1].map(|i| on_the_way_m[i] + share * off_m[i])
        };
        self.place_m
    }

    /// Marks the next position as reached by a jump.
    pub(super) fn jump(&mut self) {
        self.n_jumps = self.n_jumps.wrapping_add(1);
    }

    /// Sets the position.
    pub(super) fn set(&mut self, place_m: [f64; 2]) {
        self.place_m = place_m;
    }

    /// Position at the last call.
    pub(super) fn place(&self) -> Place {
        let [x_m, y_m] = self.place_m;
        Place { x_m, y_m, n_jumps: self.n_jumps }
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

#[cfg(test)]
mod tests {
    use super::{FollowedPlace, length};

    const TICK_SECS: f64 = 0.005;

    /// Reports at 133 Hz with delay and jitter: the position moves evenly and stays close to the tip, in any direction.
    #[test]
    fn a_steady_tip_is_followed_evenly() {
        for angle in [0.0_f64, 0.6, 2.0, -1.5] {
            let (sin, cos) = angle.sin_cos();
            let tip_at = |secs: f64| [0.08 * secs * cos, 0.08 * secs * sin];
            let mut place = FollowedPlace::default();
            let (mut next_report, mut before, mut n) = (0.0_f64, [0.0; 2], 0_u32);
            for tick in 1..400 {
                let now = TICK_SECS * f64::from(tick);
                while next_report + 0.003 <= now {
                    // Positions are quantized to 10 µm, and times have jitter.
                    let rough_secs = next_report + [0.0, 4e-4, -3e-4][n as usize % 3];
                    place.report(tip_at(next_report).map(|x| (x * 1e5).round() / 1e5), rough_secs);
                    n += 1;
                    next_report += 1.0 / 133.0 + if n % 2 == 0 { 0.001 } else { -0.001 };
                }
                let at = place.at(now, TICK_SECS, 0.08);
                if tick > 40 {
                    let tip = tip_at(now);
                    let off_m = length([at[0] - tip[0], at[1] - tip[1]]);
                    assert!(off_m < 2e-4, "{at:?} at {now}, {angle} rad");
                    let mps = length([at[0] - before[0], at[1] - before[1]]) / TICK_SECS;
                    assert!((mps - 0.08).abs() < 0.012, "{mps} m/s, {angle} rad");
                }
                before = at;
            }
        }
    }

    #[test]
    fn a_tip_that_says_no_more_stands_and_one_that_is_elsewhere_is_there() {
        let mut place = FollowedPlace::default();
        place.report([0.0, 0.0], 0.0);
        place.report([0.001, -0.002], 0.01);
        for tick in 1..100 {
            place.at(0.01 + TICK_SECS * f64::from(tick), TICK_SECS, 0.0);
        }
        let stands = place.place();
        assert!((stands.x_m - 0.001).abs() < 1e-6 && (stands.y_m + 0.002).abs() < 1e-6);
        place.begin([0.02, 0.03], 1.0);
        for tick in 0..20 {
            let [x_m, y_m] = place.at(1.0 + TICK_SECS * f64::from(tick), TICK_SECS, 1.0);
            let stays = (x_m - 0.02).abs() < 1e-12 && (y_m - 0.03).abs() < 1e-12;
            assert!(stays, "the position moves to {x_m}, {y_m}");
        }
        assert_eq!(place.place().n_jumps, 1);
        place.set([0.05, 0.01]);
        assert!((place.place().x_m - 0.05).abs() < 1e-12 && (place.place().y_m - 0.01).abs() < 1e-12);
    }
}
