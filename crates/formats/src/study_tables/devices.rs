//! Fields of the devices at an answer.

use shagreen_core::people::study::setup::Setup;

use crate::study_log::NO_OUTPUT;

/// Word for a device that was not used.
const NONE: &str = "none";

/// Output, actuator profile, output of the masking noise, pen, scale of the screen, program; all empty if they are not known.
pub(super) fn device_fields(setup: Option<&Setup>) -> [String; 6] {
    let Some(Setup { output, actuator, masking, pen, screen, program }) = setup else {
        return std::array::from_fn(|_| String::new());
    };
    let scale = if screen.is_measured() { "measured" } else { "assumed" };
    [
        output.as_ref().map_or(NO_OUTPUT, |output| output.name.as_str()).to_owned(),
        actuator.as_deref().unwrap_or(NONE).to_owned(),
        masking.as_deref().unwrap_or(NONE).to_owned(),
        pen.as_deref().unwrap_or("pointer").to_owned(),
        scale.to_owned(),
        program.clone(),
    ]
}
