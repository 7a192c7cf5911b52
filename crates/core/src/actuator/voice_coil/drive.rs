//! Drive of an actuator: conversion between sample values and volts.

use shagreen_synth::budget::Budget;
use shagreen_synth::drive::{DriveConfig, Inverse, MAX_LOOK_AHEAD_SECS};

use crate::actuator::voice_coil::check_positive;
use crate::actuator::{Actuator, ActuatorError, Limits};
use crate::units::Volts;

/// Voltage at the coil for a sample of 1.0: converter, volume and amplifier together. It belongs to the output device
/// and not to the actuator, so no actuator profile contains it.
///
/// If it was not measured, [`Drive::ASSUMED`] takes 1 V at digital full scale. A calibration with the same assumption
/// is still correct, because only the product of this voltage and the gain affects a recording. Limits in volts,
/// however, are correct only if it was measured. To measure it, play a full-scale sine, read the voltage at the coil
/// with a voltmeter, and multiply the reading (root mean square) by 1.414.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Voltage at the coil for a sample of 1.0, at the volume in use.
    pub full_scale: Volts,
}

impl Drive {
    /// Assumed drive of an output that was not measured.
    pub const ASSUMED: Self = Self { full_scale: Volts(1.0) };

    /// Creates a drive with this full-scale voltage, above zero.
    ///
    /// # Errors
    /// [`ActuatorError::Number`] if the voltage is not positive.
    pub fn new(full_scale: Volts) -> Result<Self, ActuatorError> {
        check_positive("the voltage of digital full scale in V", full_scale.0)?;
        Ok(Self { full_scale })
    }

    /// Sample value for a voltage; values beyond ±1 cannot be played.
    fn sample_of(self, volts: Volts) -> f64 {
        volts.0 / self.full_scale.0
    }
}

/// Configuration for driving an actuator with an acceleration signal, within its limits.
///
/// With `equalizes`, the inverse filter compensates the response. Otherwise the voltage is proportional to the
/// acceleration, with the gain far above the resonance.
///
/// # Errors
/// [`ActuatorError`] if the actuator has no response.
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

/// Configuration within these limits for signals that are drive signals already; acceleration counts as volts. A rated
/// current is not included; pass [`Actuator::limits_in_volts`].
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
