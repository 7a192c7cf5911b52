//! Headroom: maximum texture level within the thermal limit of the coil.

use crate::actuator::voice_coil::check_positive;
use crate::actuator::{Actuator, ActuatorError, Response};
use crate::units::Hertz;

/// Voltage demand of a texture with a flat spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Headroom {
    /// Ratio of root mean square voltage to root mean square acceleration, in V/(m/s²).
    pub volts_per_mps2: f64,
    /// Maximum continuous root mean square acceleration in m/s², if a rated voltage or current is known.
    pub rated_mps2: Option<f64>,
}

impl Actuator {
    /// Headroom for a texture with a flat spectrum between `low` and `high`.
    ///
    /// # Errors
    /// [`ActuatorError`] if the response is unknown or the band is empty.
    pub fn headroom(&self, low: Hertz, high: Hertz) -> Result<Headroom, ActuatorError> {
        let volts_per_mps2 = volts_per_mps2(&self.response()?, low, high)?;
        let rated_mps2 = self.limits_in_volts().rated_volts_rms.map(|rated| rated.0 / volts_per_mps2);
        Ok(Headroom { volts_per_mps2, rated_mps2 })
    }
}

/// Root mean square of `1/|G|` between two frequencies. With `x = f₀/f`, `K²/|G|²` is `x⁴ + (1/Q² - 2) x² + 1`, whose
/// integral has a closed form.
fn volts_per_mps2(response: &Response, low: Hertz, high: Hertz) -> Result<f64, ActuatorError> {
    check_positive("the lower end of the band in Hz", low.0)?;
    check_positive("the width of the band in Hz", high.0 - low.0)?;
    let resonance = response.resonance().0;
    let x = |hz: f64| resonance / hz;
    let fourth = resonance * (x(low.0).powi(3) - x(high.0).powi(3)) / 3.0;
    let second = resonance * (x(low.0) - x(high.0));
    let width = high.0 - low.0;
    let mean = (fourth + (response.q().powi(-2) - 2.0) * second + width) / width;
    Ok(mean.sqrt() / response.gain_mps2_per_v())
}
