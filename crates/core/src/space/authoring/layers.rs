//! Interpolation of tap transients and friction between a few textures.
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
    use super::mean_stick_slip;
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
}
