//! Strength of a landing from the speed of the tip towards the surface.

use shagreen_synth::tap::REFERENCE_IMPACT_MPS;

/// Range of the impact speed relative to [`REFERENCE_IMPACT_MPS`]. Estimates of the impact speed are rough.
const STRENGTHS: (f32, f32) = (0.1, 3.0);

/// Returns the impact speed of a landing relative to [`REFERENCE_IMPACT_MPS`], within the range that is played; 1 if the
/// impact speed in m/s is unknown.
pub fn strength_of(impact_mps: Option<f32>) -> f32 {
    let relative = impact_mps.map_or(1.0, |mps| mps / REFERENCE_IMPACT_MPS as f32);
    if relative.is_nan() { 1.0 } else { relative.clamp(STRENGTHS.0, STRENGTHS.1) }
}

#[cfg(test)]
mod tests {
    use super::strength_of;

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
}
