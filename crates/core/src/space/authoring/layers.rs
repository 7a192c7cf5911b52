//! Interpolation of tap transients, friction and rotation between a few textures.
//!
//! Tap transients and friction are averaged as logarithms. Touch discriminates ratios of friction, frequency and
//! damping, not differences, and the frequency of a tap transient depends on the square root of a stiffness that spans
//! decades. A texture without a known value does not contribute. If no value is known, the result is `None`.
//!
//! A texture without stick-slip friction does contribute: its static friction does not exceed its kinetic friction, so
//! its ratio is one. A blend therefore sticks less, the less its sticking parents weigh.

use crate::space::field::{LEAST_FRICTION, ln_tap, tap_from_ln};
use crate::texture::stick_slip::{STRIBECK_MPS, StickSlip};
use crate::texture::tap::Tap;
use crate::units::MetersPerSecond;

/// Weighted geometric mean of the known friction coefficients.
pub(super) fn mean_friction(parts: impl Iterator<Item = (Option<f64>, f64)>) -> Option<f64> {
    let known =
        parts.filter_map(|(friction, weight)| friction.map(|f| ([f.max(LEAST_FRICTION).ln()], weight)));
    mean(known).map(|[ln]| ln.exp())
}

/// Weighted geometric mean of the known tap transients.
pub(super) fn mean_tap(parts: impl Iterator<Item = (Option<Tap>, f64)>) -> Option<Tap> {
    mean(parts.filter_map(|(tap, weight)| tap.map(|tap| (ln_tap(tap), weight)))).map(|ln| tap_from_ln(&ln))
}

/// Stick-slip friction with the weighted geometric means of the ratio of static to kinetic friction over all textures
/// and of the Stribeck speed over those with stick-slip friction. The weights sum to one and may be negative; both
/// results stay within the range of the parents. `None` if nothing remains of the ratio.
pub(super) fn mean_stick_slip(parts: impl Iterator<Item = (Option<StickSlip>, f64)>) -> Option<StickSlip> {
    let (mut ln_ratio, mut highest_ratio) = (0.0_f64, 1.0_f64);
    let (mut ln_speed, mut total) = (0.0_f64, 0.0_f64);
    let (mut slowest_mps, mut fastest_mps) = (f64::INFINITY, 0.0_f64);
    for (known, weight) in parts {
        let Some(StickSlip { static_ratio, stribeck_speed: MetersPerSecond(speed_mps) }) = known else {
            continue;
        };
        let speed_mps = speed_mps.max(*STRIBECK_MPS.start());
        ln_ratio += weight * static_ratio.max(1.0).ln();
        ln_speed += weight * speed_mps.ln();
        total += weight;
        highest_ratio = highest_ratio.max(static_ratio);
        (slowest_mps, fastest_mps) = (slowest_mps.min(speed_mps), fastest_mps.max(speed_mps));
    }
    (total > 0.0 && ln_ratio > 0.0).then(|| StickSlip {
        static_ratio: ln_ratio.exp().clamp(1.0, highest_ratio),
        stribeck_speed: MetersPerSecond((ln_speed / total).exp().clamp(slowest_mps, fastest_mps)),
    })
}

/// Mean rotation in rad of textures with these rotations and weights; exactly zero if none is rotated.
///
/// A lay has an axis, but no sign: 170° and -10° are the same. Rotations are therefore averaged as vectors of twice the
/// angle (K. Mardia and P. Jupp, "Directional statistics", 2000). Of the two rotations with the mean axis, the result is
/// the one nearer to that of the texture with the largest weight, because a height map has a sign. Negative weights
/// count as zero: they would turn the axis away from a texture.
pub(super) fn mean_turn_rad(parts: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut x, mut y) = (0.0, 0.0);
    let (mut heaviest, mut heaviest_turn_rad) = (0.0, 0.0);
    let mut is_turned = false;
    for (turn_rad, weight) in parts {
        let weight = f64::max(weight, 0.0);
        let (sin, cos) = f64::sin_cos(2.0 * turn_rad);
        (x, y) = (x + weight * cos, y + weight * sin);
        is_turned |= turn_rad != 0.0;
        if weight > heaviest {
            (heaviest, heaviest_turn_rad) = (weight, turn_rad);
        }
    }
    if !is_turned {
        return 0.0;
    }
    let axis_rad = 0.5 * f64::atan2(y, x);
    if f64::cos(axis_rad - heaviest_turn_rad) < 0.0 { axis_rad + std::f64::consts::PI } else { axis_rad }
}

fn mean<const N: usize>(parts: impl Iterator<Item = ([f64; N], f64)>) -> Option<[f64; N]> {
    let (mut sum, mut total) = ([0.0; N], 0.0);
    for (values, weight) in parts {
        total += weight;
        for (s, v) in sum.iter_mut().zip(values) {
            *s += weight * v;
        }
    }
    (total > 0.0).then(|| sum.map(|s| s / total))
}

#[cfg(test)]
mod tests {
    use super::{mean_stick_slip, mean_turn_rad};
    use crate::texture::stick_slip::StickSlip;
    use crate::units::MetersPerSecond;

    const RUBBER: StickSlip = StickSlip { static_ratio: 2.25, stribeck_speed: MetersPerSecond(0.04) };
    const VINYL: StickSlip = StickSlip { static_ratio: 1.21, stribeck_speed: MetersPerSecond(0.01) };

    fn check_stick_slip(parts: &[(Option<StickSlip>, f64)], expected: Option<(f64, f64)>) {
        let mean = mean_stick_slip(parts.iter().copied());
        let found = mean.map(|mean| (mean.static_ratio, mean.stribeck_speed.0));
        match (found, expected) {
            (Some(found), Some(expected)) => {
                // Logarithms and exponentials round in the last digits.
                let is_near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
                assert!(is_near(found.0, expected.0) && is_near(found.1, expected.1), "{found:?}");
            }
            _ => assert_eq!(found, expected),
        }
    }

    #[test]
    fn a_blend_sticks_less_with_the_weight_of_what_does_not_stick() {
        check_stick_slip(&[(Some(RUBBER), 1.0)], Some((2.25, 0.04)));
        check_stick_slip(&[(Some(RUBBER), 0.5), (None, 0.5)], Some((1.5, 0.04)));
        check_stick_slip(&[(Some(RUBBER), 0.5), (Some(VINYL), 0.5)], Some((1.65, 0.02)));
        check_stick_slip(&[(None, 1.0)], None);
        check_stick_slip(&[(Some(RUBBER), 0.0), (None, 1.0)], None);
        check_stick_slip(&[], None);
    }

    #[test]
    fn no_weight_leads_beyond_the_parents() {
        check_stick_slip(&[(Some(RUBBER), 1.25), (None, -0.25)], Some((2.25, 0.04)));
        check_stick_slip(&[(Some(RUBBER), -0.25), (None, 1.25)], None);
        check_stick_slip(&[(Some(RUBBER), 1.25), (Some(VINYL), -0.25)], Some((2.25, 0.04)));
        let fainter = mean_stick_slip([(Some(RUBBER), 0.01), (None, 0.99)].into_iter()).unwrap();
        assert!(fainter.static_ratio > 1.0 && fainter.static_ratio < 1.01, "{fainter:?}");
    }

    fn check_turn(parts_degrees: &[(f64, f64)], expected_degrees: f64) {
        let parts = parts_degrees.iter().map(|(turn, weight)| (turn.to_radians(), *weight));
        let mean_degrees = mean_turn_rad(parts).to_degrees();
        let apart = (mean_degrees - expected_degrees).rem_euclid(360.0);
        assert!(apart.min(360.0 - apart) < 1e-9, "{mean_degrees} instead of {expected_degrees}");
    }

    #[test]
    fn rotations_are_averaged_as_axes() {
        check_turn(&[(20.0, 0.5), (40.0, 0.5)], 30.0);
        // 170° is the axis of -10°.
        check_turn(&[(20.0, 0.6), (170.0, 0.4)], mean_of_axes(20.0, 0.6, -10.0, 0.4));
        check_turn(&[(150.0, 1.0)], 150.0);
        check_turn(&[(150.0, 0.9), (-30.0, 0.1)], 150.0);
        check_turn(&[(30.0, 1.25), (80.0, -0.25)], 30.0);
        assert_eq!(mean_turn_rad([(0.0, 0.3), (0.0, 0.7)].into_iter()), 0.0);
        assert_eq!(mean_turn_rad(std::iter::empty()), 0.0);
    }

    /// Mean axis of two that are less than 45° apart on either side of zero, in degrees.
    fn mean_of_axes(a: f64, weight_a: f64, b: f64, weight_b: f64) -> f64 {
        let tangent =
            |f: fn(f64) -> f64| weight_a * f(2.0 * a.to_radians()) + weight_b * f(2.0 * b.to_radians());
        0.5 * (tangent(f64::sin) / tangent(f64::cos)).atan().to_degrees()
    }
}
