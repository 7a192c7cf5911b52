//! Stored device setup that cannot be used.

use std::ops::RangeInclusive;

use crate::strings::devices::UNCALIBRATED;

/// The stored actuator cannot be used.
pub fn no_actuator(reason: &str) -> String {
    format!(
        "No output was opened: the last used actuator is unavailable ({reason}). Choose an actuator, or “{UNCALIBRATED}”, in “Devices…”."
    )
}

/// The stored actuator cannot be read from the settings.
pub fn unreadable(path: &str, reason: &str) -> String {
    format!(
        "No output was opened: the settings do not say which actuator is connected. Choose the actuator in “Devices…”, then an output. ({path}: {reason})"
    )
}

/// The stored actuator refers to a built-in profile that does not exist.
pub fn unknown_profile(id: &str) -> String {
    format!("this version has no built-in profile “{id}”")
}

/// The stored voltage at full scale is out of range.
pub fn full_scale_out_of_range(volts: f64, range: RangeInclusive<f64>) -> String {
    format!("the voltage at full scale, {volts} V, is outside {} to {} V", range.start(), range.end())
}
