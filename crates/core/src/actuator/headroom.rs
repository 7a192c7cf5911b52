//! How loud a texture may be before the coil gets too warm.

use crate::actuator::{Actuator, ActuatorError, Response, check_positive};
use crate::units::Hertz;

/// What a flat texture costs an actuator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Headroom {
    /// Root mean square of the voltage for one of 1 m/s² of the acceleration, in V/(m/s²).
    pub volts_per_mps2: f64,
    /// Highest root mean square of the acceleration in the long run, in m/s², where a rated voltage or current is known.
    pub rated_mps2: Option<f64>,
}

impl Actuator {
    /// The headroom of a texture that is equally strong at all frequencies between `low` and `high`.
    ///
    /// # Errors
    /// [`ActuatorError`] without a response or where the band is none.
    pub fn headroom(&self, low: Hertz, high: Hertz) -> Result<Headroom, ActuatorError> {
        let volts_per_mps2 = volts_per_mps2(&self.response()?, low, high)?;
        let rated_mps2 = self.limits_in_volts().rated_volts_rms.map(|rated| rated.0 / volts_per_mps2);
        Ok(Headroom { volts_per_mps2, rated_mps2 })
    }
}

/// The root of the mean of `1/|G|²` between two frequencies: with `x = f₀/f`, `K²/|G|²` is `x⁴ + (1/Q² - 2) x² + 1`, whose
/// integral is closed.
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
