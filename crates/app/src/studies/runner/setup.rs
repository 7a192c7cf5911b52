//! Devices of a session, for its log.

use shagreen_core::people::study::setup::{OutputDevice, Setup};
use shagreen_device::output::NULL_ID;
use shagreen_device::status::LinkState;

use super::RunnerInput;
use crate::session::Session;

/// The devices as they are now.
pub(super) fn setup(input: &RunnerInput<'_>) -> Setup {
    let session = input.session;
    Setup {
        output: output(session),
        actuator: session.rig().actuator().map(|actuator| actuator.id.clone()),
        masking: input.masking.map(str::to_owned),
        pen: session.pen_facts().map(|facts| facts.name.clone()),
        screen: input.screen,
        // The session states it.
        program: String::new(),
    }
}

/// The output that plays; `None` for the silent one, and for one that is closed, lost or muted.
fn output(session: &Session) -> Option<OutputDevice> {
    let is_lost = session.status().is_some_and(|status| status.state == LinkState::Lost);
    if is_lost || session.is_output_released() || session.is_muted() {
        return None;
    }
    let id = session.output_id().filter(|id| *id != NULL_ID)?;
    Some(OutputDevice { id: id.to_owned(), name: session.output_name().unwrap_or(id).to_owned() })
}
