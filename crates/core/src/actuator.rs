//! Actuators: the response of a voice coil to a voltage, the compensated drive signal, and calibration.
//!
//! Input: data sheet values, or a recorded sweep ([`calibration`]). Output: an [`Actuator`] with response, limits,
//! headroom and inverse filter.

pub mod calibration;
mod friction_display;
mod named_channel;
mod voice_coil;

pub use crate::actuator::friction_display::{FRICTION_CARRIERS_HZ, FRICTION_CHANNELS, FrictionDisplay};
pub use crate::actuator::named_channel::{MAX_CHANNEL, NamedChannel};
pub use crate::actuator::voice_coil::{
    Actuator, ActuatorError, Calibrated, DataSheet, Drive, Headroom, Limits, LimitsWarning, Measured,
    Mechanics, Physical, Response, USUAL_LOWEST, USUAL_THERMAL_SECS, drive_config, inverse,
    inverse_gain_bound, limited_drive, validate,
};
