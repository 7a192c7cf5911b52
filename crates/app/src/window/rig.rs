//! Device setup that is kept between program starts.

use egui::Context;
use shagreen_device::output::NULL_ID;

use super::Window;
use crate::session::{OutputChoice, Session};
use crate::state::files::Files;
use crate::state::rig::Rig;
use crate::state::rig_memory::{remembered, restored, with_pen_of};

/// Output that the user selected.
#[derive(Default)]
pub(super) struct SelectedOutput {
    /// Output that the user selected in this window, until it is open.
    pub(super) asked: Option<String>,
    /// Whether the output was given at program start and no other has been selected since.
    is_given: bool,
}

impl SelectedOutput {
    /// Output that the program was started with.
    pub(super) fn at_start(output: &OutputChoice) -> Self {
        Self { asked: None, is_given: *output != OutputChoice::SystemDefault }
    }
}

/// Opens `output` if it names one, otherwise the stored output, otherwise the system default. If a named or stored
/// output is unavailable, no other one is opened. If the stored device setup is unreadable, the limits of the actuator
/// are unknown and no output is opened.
pub(super) fn open_as_left(session: &mut Session, output: OutputChoice, files: &Files, ctx: &Context) {
    if let Some(problem) = files.settings_problem() {
        session.say_of_output(problem.to_owned());
        return;
    }
    let left = files.settings.rig.as_ref();
    session.set_rig(left.map(restored).unwrap_or_default(), ctx);
    let output = match (output, left.and_then(|left| left.output.clone())) {
        (OutputChoice::SystemDefault, Some(id)) => OutputChoice::Id(id),
        (output, _) => output,
    };
    session.open_output(output, ctx);
}

impl Window {
    /// Stores the device setup. If it is unknown for which output the user set it, only the pen is stored: the next
    /// output may be headphones.
    pub(super) fn remember_rig(&mut self, rig: &Rig) {
        let output = if rig.opens_unlike(self.session.rig()) { self.output_of_rig() } else { None };
        let before = self.files.settings.rig.as_ref();
        self.files.settings.rig = Some(match output {
            Some(output) => remembered(rig, output, before),
            None => with_pen_of(rig, before),
        });
    }

    /// Output that the device setup applies to: the stored one, otherwise the open one unless it is the silent output.
    /// `None` for an output that was given at program start, which is not stored.
    fn output_of_rig(&self) -> Option<String> {
        if self.output.is_given {
            return None;
        }
        let left = self.files.settings.rig.as_ref().and_then(|left| left.output.clone());
        left.or_else(|| self.session.output_id().filter(|id| *id != NULL_ID).map(str::to_owned))
    }

    /// Stores an output that the user selected, with its device setup, as soon as it is open. Called once a frame.
    pub(super) fn remember_output(&mut self) {
        let is_open = |id: &mut String| self.session.output_id() == Some(id.as_str());
        if let Some(id) = self.output.asked.take_if(is_open) {
            self.output.is_given = false;
            let before = self.files.settings.rig.as_ref();
            self.files.settings.rig = Some(remembered(self.session.rig(), id, before));
        }
    }
}
