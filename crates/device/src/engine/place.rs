//! Where the tip is between two reports of it.

use shagreen_synth::contact::Place;

/// Share of what a place is off that is made up for in a tick: reports come at their own times, and a step would click.
const CATCH_UP: f64 = 0.25;
/// How much a new velocity counts.
const SMOOTHING: f64 = 0.5;
/// Further off than this, in m, the tip is somewhere else.
const LOST_M: f64 = 0.03;
/// How long a tip is thought to go on, in s: what it went too far it has to come back.
const MOST_AHEAD_SECS: f64 = 0.02;

/// A place along one axis, that follows reports without steps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FollowedPlace {
    /// Where the tip was reported last, in m, when, in s, and how fast it went there, in m/s along the axis.
    reported_m: f64,
    reported_secs: f64,
    velocity_mps: f64,
    place_m: f64,
    n_jumps: u32,
}

impl FollowedPlace {
    /// The tip was at a place at a time, and went there from the one before.
    pub(super) fn report(&mut self, place_m: f64, secs: f64) {
        let step_secs = secs - self.reported_secs;
        if step_secs > 0.0 {
            let velocity_mps = (place_m - self.reported_m) / step_secs;
            // Times of reports are rough, and two of them make rough speeds.
            self.velocity_mps += SMOOTHING * (velocity_mps - self.velocity_mps);
        }
        (self.reported_m, self.reported_secs) = (place_m, secs);
    }

    /// The tip is at a place at a time, and did not go there.
    pub(super) fn begin(&mut self, place_m: f64, secs: f64) {
        let n_jumps = self.n_jumps;
        *self = Self { reported_m: place_m, reported_secs: secs, velocity_mps: 0.0, place_m, n_jumps };
        self.jump();
    }

    /// The place at a time, a tick of `step_secs` after it was asked for last. The tip goes on as far as `speed_mps` lets it:
    /// where nothing is reported any more, that has gone to zero.
    pub(super) fn at(&mut self, secs: f64, step_secs: f64, speed_mps: f64) -> f64 {
        let velocity_mps = self.velocity_mps.min(speed_mps).max(-speed_mps);
        let wanted_m =
            self.reported_m + velocity_mps * (secs - self.reported_secs).clamp(0.0, MOST_AHEAD_SECS);
        let on_the_way_m = self.place_m + velocity_mps * step_secs;
        let off_m = wanted_m - on_the_way_m;
        self.place_m = if off_m.abs() > LOST_M { wanted_m } else { on_the_way_m + CATCH_UP * off_m };
        self.place_m
    }

    /// The next place is not gone to from the last.
    pub(super) fn jump(&mut self) {
        self.n_jumps = self.n_jumps.wrapping_add(1);
    }

    /// The tip is here.
    pub(super) fn set(&mut self, place_m: f64) {
        self.place_m = place_m;
    }

    /// Where it was asked for last.
    pub(super) fn place(&self) -> Place {
        Place { x_m: self.place_m, n_jumps: self.n_jumps }
    }
}

#[cfg(test)]
mod tests {
    use super::FollowedPlace;

    const TICK_SECS: f64 = 0.005;

    /// Reports at 133 Hz, each a little late and by turns: the place goes on evenly, and is nowhere far from the tip.
    #[test]
    fn a_steady_tip_is_followed_evenly() {
        let mut place = FollowedPlace::default();
        let (mut next_report, mut before, mut n) = (0.0_f64, 0.0, 0_u32);
        for tick in 1..400 {
            let now = TICK_SECS * f64::from(tick);
            while next_report + 0.003 <= now {
                // Places in steps of 10 µm, times a little off.
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
            assert!((at - 0.02).abs() < 1e-12, "it goes to {at}");
        }
        place.set(0.05);
        assert!((place.place().x_m - 0.05).abs() < 1e-12);
    }
}
