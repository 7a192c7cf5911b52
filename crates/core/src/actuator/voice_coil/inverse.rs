//! Bounded inverse filter that compensates the response of an actuator.

use crate::actuator::voice_coil::check_positive;
use crate::actuator::{ActuatorError, Response};
use crate::dsp::filter::Biquad;
use crate::units::Hertz;

/// Bounded inverse filter: voltage for an acceleration in m/s². Filter and actuator together are a high-pass that is
/// flat above `lowest`; below it the voltage stops growing.
///
/// `C(s) = (1/K) (s² + s ω₀/Q + ω₀²) / (s² + 2·0.7071 ω_h s + ω_h²)`, where `ω_h` belongs to `lowest`, by the bilinear
/// transform pre-warped at the resonance. The transform warps frequencies above a tenth of the sample rate, so use the
/// sample rate of the output.
///
/// # Errors
/// [`ActuatorError`] if a frequency is not positive, or if the resonance or `lowest` is not below half of the sample
/// rate.
pub fn inverse(response: &Response, lowest: Hertz, rate: Hertz) -> Result<Biquad, ActuatorError> {
    check_positive("the rate in Hz", rate.0)?;
    check_positive("the lowest frequency in Hz", lowest.0)?;
    for (what, hz) in [("the resonance", response.resonance().0), ("the lowest frequency", lowest.0)] {
        if 2.0 * hz >= rate.0 {
            return Err(ActuatorError::Rate { what, hz, rate_hz: rate.0 });
        }
    }
    // The real-time renderer uses the same function, so that displayed and driven filters agree.
    Ok(Biquad::bounded_inverse(response.into(), lowest.0, rate.0))
}

/// Upper bound of the gain of [`inverse`] at any frequency, in V/(m/s²): `max(1, 1/2Q) / K · √(1 + (f₀/f_h)⁴)`.
pub fn inverse_gain_bound(response: &Response, lowest: Hertz) -> f64 {
    let steep = (response.resonance().0 / lowest.0).powi(4);
    let wide = (0.5 / response.q()).max(1.0);
    // The Butterworth damping is rounded to four digits, which adds 2e-4.
    1.0002 * wide / response.gain_mps2_per_v() * (1.0 + steep).sqrt()
}
