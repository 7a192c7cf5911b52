//! From numbers to volts.

use crate::actuator::{ActuatorError, check_positive};
use crate::units::Volts;

/// What stands between the numbers that are played and the coil: converter, volume and amplifier together. It belongs to
/// the desk and not to the actuator, so no profile holds it.
///
/// Where nobody measured it, [`Drive::ASSUMED`] takes a volt for digital full scale. A calibration that assumed the same
/// is right nevertheless, since only the product of this and the gain shows in a recording; but limits in volts
/// mean what they say only where it was measured: play a sine of full scale, put a voltmeter to the coil, and take 1.414
/// times what it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Voltage at the coil for a sample of 1.0, at the volume that is used.
    pub full_scale: Volts,
}

impl Drive {
    /// Where nobody measured it.
    pub const ASSUMED: Self = Self { full_scale: Volts(1.0) };

    /// A drive of this full scale, above zero.
    ///
    /// # Errors
    /// [`ActuatorError::Number`].
    pub fn new(full_scale: Volts) -> Result<Self, ActuatorError> {
        check_positive("the voltage of digital full scale in V", full_scale.0)?;
        Ok(Self { full_scale })
    }

    /// The sample that makes a voltage; beyond ±1 it cannot be played.
    pub fn sample_of(&self, volts: Volts) -> f64 {
        volts.0 / self.full_scale.0
    }
}
