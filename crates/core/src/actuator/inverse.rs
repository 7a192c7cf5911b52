//! The filter that makes up for an actuator without asking the impossible of it.

use crate::actuator::{ActuatorError, Response, check_positive};
use crate::filter::Biquad;
use crate::units::Hertz;

/// The bounded inverse: volts for an acceleration in m/s², so that filter and actuator together are a flat high-pass from
/// `lowest` on, at which its voltage stops growing.
///
/// `C(s) = (1/K) (s² + s ω₀/Q + ω₀²) / (s² + 2·0.7071 ω_h s + ω_h²)` with `ω_h` that of `lowest`, by the bilinear transform
/// pre-warped at the resonance. Above a tenth of the rate the transform bends frequencies: take the rate of the output.
///
/// # Errors
/// [`ActuatorError`] where the resonance or `lowest` is not below half the rate.
pub fn inverse(response: &Response, lowest: Hertz, rate: Hertz) -> Result<Biquad, ActuatorError> {
    check_positive("the rate in Hz", rate.0)?;
    check_positive("the lowest frequency in Hz", lowest.0)?;
    for (what, hz) in [("the resonance", response.resonance().0), ("the lowest frequency", lowest.0)] {
        if 2.0 * hz >= rate.0 {
            return Err(ActuatorError::Rate { what, hz, rate_hz: rate.0 });
        }
    }
    // The callback's own: what is shown and what is driven are one.
    Ok(Biquad::bounded_inverse(response.into(), lowest.0, rate.0))
}

/// A bound of the gain of [`inverse`] at any frequency, in V/(m/s²): `max(1, 1/2Q) / K · √(1 + (f₀/f_h)⁴)`.
pub fn inverse_gain_bound(response: &Response, lowest: Hertz) -> f64 {
    let steep = (response.resonance().0 / lowest.0).powi(4);
    let wide = (0.5 / response.q()).max(1.0);
    // The damping is Butterworth's to four digits only, which costs two of ten thousand.
    1.0002 * wide / response.gain_mps2_per_v() * (1.0 + steep).sqrt()
}
