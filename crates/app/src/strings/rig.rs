//! Words about what is remembered of the machine.

use std::ops::RangeInclusive;

/// The actuator of last time cannot be had.
pub fn no_actuator(reason: &str) -> String {
    format!(
        "No output was opened: the actuator of last time cannot be had ({reason}). Choose it again in “Devices…”, or another, or none."
    )
}

/// What the settings say of the actuator cannot be read.
pub fn unreadable(path: &str, reason: &str) -> String {
    format!(
        "No output was opened, for the settings do not tell what hangs on it: choose the actuator in “Devices…”, then an output ({path}: {reason})"
    )
}

/// A built-in profile is gone.
pub fn unknown_profile(id: &str) -> String {
    format!("this version has no profile “{id}”")
}

/// What drives the actuator is not known.
pub fn full_scale_out_of_range(volts: f64, range: RangeInclusive<f64>) -> String {
    format!("{volts} V at full scale are not within {} to {} V", range.start(), range.end())
}
