//! Words about what is remembered of the machine.

/// The actuator of last time cannot be had.
pub fn no_actuator(reason: &str) -> String {
    format!(
        "No output was opened: the actuator of last time cannot be had ({reason}). Choose it again in “Devices…”, then an output."
    )
}

/// A built-in profile is gone.
pub fn unknown_profile(id: &str) -> String {
    format!("this version has no profile “{id}”")
}
