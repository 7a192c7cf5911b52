//! From numbers to volts.

use shagreen_synth::budget::Budget;
use shagreen_synth::drive::{DriveConfig, Inverse, MAX_LOOK_AHEAD_SECS};

use crate::actuator::{Actuator, ActuatorError, Limits, check_positive};
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
    fn sample_of(self, volts: Volts) -> f64 {
        volts.0 / self.full_scale.0
    }
}

/// How acceleration becomes the drive of an actuator: its response undone where `equalizes`, else in proportion to what it
/// does far above its resonance; within what it stands in any case.
///
/// # Errors
/// [`ActuatorError`] where the actuator has no response.
pub fn drive_config(
    actuator: &Actuator,
    drive: Drive,
    equalizes: bool,
) -> Result<DriveConfig, ActuatorError> {
    let response = actuator.response()?;
    let inverse = Inverse { resonance: (&response).into(), lowest_hz: actuator.lowest.0 };
    let gain = if equalizes { 1.0 } else { response.gain_mps2_per_v() };
    Ok(DriveConfig {
        inverse: equalizes.then_some(inverse),
        full_scale: (drive.full_scale.0 * gain) as f32,
        ..limited_drive(&actuator.limits_in_volts(), drive)
    })
}

/// Drive within these limits, for signals that are drive already; acceleration counts as volts. A rated current is none of
/// them: give [`Actuator::limits_in_volts`].
pub fn limited_drive(limits: &Limits, drive: Drive) -> DriveConfig {
    let share = |volts: Volts| drive.sample_of(volts) as f32;
    DriveConfig {
        inverse: None,
        full_scale: drive.full_scale.0 as f32,
        ceiling: limits.peak_volts.map_or(1.0, share).min(1.0),
        look_ahead_secs: MAX_LOOK_AHEAD_SECS,
        budget: limits
            .rated_volts_rms
            .map(|volts| Budget { rms: share(volts), time_secs: limits.thermal_secs as f32 }),
    }
}
