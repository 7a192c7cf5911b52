//! Automatic stroke: an endless periodic tip motion at a set speed and force.
//!
//! Every path is a fixed curve parameterized by distance, the integral of the set speed over time. The tip position
//! depends on this distance only, so a stroke whose speed changes continues from its position.

use std::f64::consts::PI;

use shagreen_synth::contact::Contact;

use crate::touch::Touch;

/// Depth of the reversal at each end of a line, as a fraction of the extent. The velocity passes through zero along a
/// cosine there.
pub const TURN_SHARE: f64 = 0.025;

/// Largest relative deviation of a scribble's speed from the set speed.
pub const SCRIBBLE_SPREAD: f64 = 0.02;

/// Curve of an automatic stroke, within a circle around the center of the pad; the diameter of the circle is the extent
/// of the stroke.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// Back and forth along a line, at the set speed except in the reversals ([`TURN_SHARE`]).
    #[default]
    Line,
    /// A circle, at exactly the set speed.
    Circle,
    /// A horizontal figure eight that slowly rotates, at the set speed within [`SCRIBBLE_SPREAD`].
    Scribble,
}

/// Parameters of an automatic stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hand {
    /// Curve of the stroke.
    pub path: Path,
    /// Set speed in m/s.
    pub speed_mps: f32,
    /// Normal force in N, constant.
    pub force_n: f32,
    /// Extent: diameter of the circle that contains the stroke, in m.
    pub extent_m: f32,
}

impl Hand {
    /// Returns the touch `time_secs` after the start of the stroke. Invalid parameters give a lifted tip.
    pub fn touch_at(self, time_secs: f64) -> Touch {
        self.touch_at_distance(f64::from(self.speed_mps) * time_secs)
    }

    /// Returns the touch at `distance_m` along the stroke. The distance advances at the set speed during a reversal
    /// too, although the tip itself is slower there.
    pub fn touch_at_distance(self, distance_m: f64) -> Touch {
        let extent_m = f64::from(self.extent_m);
        let u = distance_m / extent_m;
        if !(u.is_finite() && extent_m.is_finite() && extent_m > 0.0) {
            return Touch::default();
        }
        let (x, y, rate) = match self.path {
            Path::Line => line(u),
            Path::Circle => (0.5 * (2.0 * u).cos(), 0.5 * (2.0 * u).sin(), 1.0),
            Path::Scribble => scribble(u),
        };
        Touch {
            x_m: (extent_m * x) as f32,
            y_m: (extent_m * y) as f32,
            contact: Contact { speed_mps: self.speed_mps * rate as f32, force_n: self.force_n },
        }
        .sanitized()
    }
}

/// Position and relative speed on a line of extent 1 at distance `u`.
fn line(u: f64) -> (f64, f64, f64) {
    let straight = 1.0 - 2.0 * TURN_SHARE;
    let half_cycle = straight + PI * TURN_SHARE;
    let walked = u.rem_euclid(2.0 * half_cycle);
    let (walked, sign) = if walked < half_cycle { (walked, 1.0) } else { (walked - half_cycle, -1.0) };
    if walked < straight {
        (sign * (walked - 0.5 * straight), 0.0, 1.0)
    } else {
        let angle = (walked - straight) / TURN_SHARE;
        (sign * (0.5 * straight + TURN_SHARE * angle.sin()), 0.0, angle.cos().abs())
    }
}

/// Position and relative speed on the rotating figure eight of extent 1 at distance `u`.
fn scribble(u: f64) -> (f64, f64, f64) {
    // Two circles touch in the center. The right one comes first, and both start downwards.
    let radius = 0.25;
    let walked = u.rem_euclid(4.0 * PI * radius);
    let side = if walked < 2.0 * PI * radius { 1.0 } else { -1.0 };
    let (sin, cos) = (walked / radius).sin_cos();
    let (x, y) = (side * radius * (1.0 - cos), -radius * sin);
    let (dx, dy) = (side * sin, -cos);
    // The figure rotates: its outermost point, half an extent from the center, moves at `SCRIBBLE_SPREAD`.
    let turn_rate = 2.0 * SCRIBBLE_SPREAD;
    let rate = (dx - turn_rate * y).hypot(dy + turn_rate * x);
    let (sin, cos) = (turn_rate * u).sin_cos();
    (cos * x - sin * y, sin * x + cos * y, rate)
}

#[cfg(test)]
mod tests {
    use super::{Hand, PI, Path, SCRIBBLE_SPREAD, TURN_SHARE, Touch};

    const PATHS: [Path; 3] = [Path::Line, Path::Circle, Path::Scribble];

    fn hand(path: Path) -> Hand {
        Hand { path, speed_mps: 0.15, force_n: 0.7, extent_m: 0.06 }
    }

    /// The curve in f64, so that a numeric derivative is meaningful.
    fn place(path: Path, u: f64) -> (f64, f64, f64) {
        match path {
            Path::Line => super::line(u),
            Path::Circle => (0.5 * (2.0 * u).cos(), 0.5 * (2.0 * u).sin(), 1.0),
            Path::Scribble => super::scribble(u),
        }
    }

    #[test]
    fn speed_is_the_derivative_of_position() {
        for path in PATHS {
            let h = 1e-5;
            for i in 0..100_000 {
                let u = f64::from(i) * 1.37e-3;
                let (a, b, here) = (place(path, u - h), place(path, u + h), place(path, u));
                let slope = (b.0 - a.0).hypot(b.1 - a.1) / (2.0 * h);
                // Second derivatives are at most 1/TURN_SHARE = 40 and jump where a curve begins, so the error is 40 h.
                assert!((slope - here.2).abs() < 5e-4, "{path:?} at {u}: {slope} for {}", here.2);
            }
        }
    }

    #[test]
    fn set_speed_is_kept_as_stated() {
        for path in PATHS {
            let (hand, mut at_speed) = (hand(path), 0);
            for i in 0..20_000 {
                let touch = hand.touch_at(f64::from(i) * 1e-3);
                let share = f64::from(touch.contact.speed_mps / hand.speed_mps);
                assert_eq!(touch.contact.force_n, hand.force_n);
                match path {
                    Path::Line => assert!(share <= 1.0 + 1e-6),
                    Path::Circle => assert!((share - 1.0).abs() < 1e-6),
                    Path::Scribble => assert!((share - 1.0).abs() <= SCRIBBLE_SPREAD + 1e-6, "{share}"),
                }
                at_speed += i32::from((share - 1.0).abs() < 1e-6);
                // The tip never leaves the extent.
                assert!(touch.x_m.hypot(touch.y_m) <= 0.5 * hand.extent_m * 1.000_01);
            }
            if path == Path::Line {
                // Ratio of 0.95 for the straight part to 0.025 pi for the reversal.
                let share = f64::from(at_speed) / 20_000.0;
                assert!((share - 0.95 / (0.95 + 0.025 * PI)).abs() < 0.01, "{share}");
            }
        }
    }

    #[test]
    fn a_line_passes_through_rest_in_the_stated_time() {
        let hand = hand(Path::Line);
        let end_of_straight = 0.95 * 0.06 / 0.15;
        // The reversal is half a circle with a radius of 1/40 of the extent, traversed at the set speed.
        let turn_secs = PI * TURN_SHARE * 0.06 / 0.15;
        let slowest = hand.touch_at(end_of_straight + 0.5 * turn_secs);
        assert!(slowest.contact.speed_mps < 1e-6);
        assert!((slowest.x_m - 0.03).abs() < 1e-7);
        let back = hand.touch_at(end_of_straight + turn_secs);
        assert!((back.contact.speed_mps - 0.15).abs() < 1e-6 && (back.x_m - 0.95 * 0.03).abs() < 1e-6);
    }

    #[test]
    fn position_does_not_depend_on_how_fast_it_was_reached() {
        for path in PATHS {
            let (slow, fast) = (hand(path), Hand { speed_mps: 0.3, ..hand(path) });
            let (a, b) = (slow.touch_at_distance(0.123), fast.touch_at_distance(0.123));
            assert_eq!((a.x_m, a.y_m), (b.x_m, b.y_m));
        }
    }

    #[test]
    fn nonsense_is_a_lifted_tip() {
        for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
            for path in PATHS {
                assert_eq!(Hand { extent_m: bad, ..hand(path) }.touch_at(1.0).contact.speed_mps, 0.0);
                assert_eq!(Hand { speed_mps: bad, ..hand(path) }.touch_at(1.0).contact.speed_mps, 0.0);
            }
        }
        assert_eq!(hand(Path::Circle).touch_at(f64::NAN), Touch::default());
    }
}
