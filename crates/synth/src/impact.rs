//! Landing of the tip: its strength from the impact speed, and the highest amplitude of its tap transient.

use crate::tap::{REFERENCE_IMPACT_MPS, amplitude_factor};

/// Range of the impact speed relative to [`REFERENCE_IMPACT_MPS`]. Estimates of the impact speed are rough.
const STRENGTHS: (f32, f32) = (0.1, 3.0);
/// Highest amplitude of a tap transient at the reference impact speed, as a share of the range in which the limiter is
/// linear. A hard surface lands with more than most actuators can do. Left to the limiter, its transient would silence
/// the grain until the limiter releases. The rest of the range is for the grain and for faster impacts, whose amplitude
/// is at most the whole range.
pub const TAP_SHARE: f32 = 0.7;

/// Returns the impact speed of a landing relative to [`REFERENCE_IMPACT_MPS`], within the range that is played; 1 if the
/// impact speed in m/s is unknown.
pub fn strength_of(impact_mps: Option<f32>) -> f32 {
    let relative = impact_mps.map_or(1.0, |mps| mps / REFERENCE_IMPACT_MPS as f32);
    if relative.is_nan() { 1.0 } else { relative.clamp(STRENGTHS.0, STRENGTHS.1) }
}

/// Returns the highest amplitude of a tap transient as it is stated for the reference impact speed, so that a landing of
/// this strength stays in the range in which the limiter is linear: a share of that range.
pub fn share_of_range(strength: f32) -> f32 {
    TAP_SHARE.min(amplitude_factor(strength).recip() as f32)
}

#[cfg(test)]
mod tests {
    use super::{TAP_SHARE, share_of_range, strength_of};

    #[test]
    fn a_landing_is_as_strong_as_it_is_fast_within_what_is_plausible() {
        for (impact_mps, strength) in [
            (None, 1.0),
            (Some(0.1), 1.0),
            (Some(0.05), 0.5),
            (Some(0.0), 0.1),
            (Some(50.0), 3.0),
            (Some(f32::NAN), 1.0),
            (Some(f32::INFINITY), 3.0),
            (Some(-1.0), 0.1),
        ] {
            assert!((strength_of(impact_mps) - strength).abs() < 1e-6, "{impact_mps:?}");
        }
    }

    #[test]
    fn no_landing_leaves_the_linear_range() {
        assert_eq!((share_of_range(0.1), share_of_range(1.0)), (TAP_SHARE, TAP_SHARE));
        for strength in [0.1, 1.0, 1.5, 2.0, 3.0] {
            let amplitude = f64::from(share_of_range(strength)) * super::amplitude_factor(strength);
            // Rounding of the share to `f32`.
            assert!(amplitude < 1.0 + 1e-6, "{amplitude} at {strength}");
        }
    }
}
