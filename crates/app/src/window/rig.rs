//! The rig that is remembered from one start to the next.

use egui::Context;
use shagreen_device::output::NULL_ID;

use super::Window;
use crate::files::Files;
use crate::rig::Rig;
use crate::rig_memory::{remembered, restored, with_pen_of};
use crate::session::{OutputChoice, Session};

/// Opens the output as it was left: the one that was chosen last unless `output` says another, and none in its place. On a
/// first start it is `output`. Without the limits of what hangs on it none is opened.
pub(super) fn open_as_left(session: &mut Session, output: OutputChoice, files: &Files, ctx: &Context) {
    if let Some(problem) = files.settings_problem() {
        session.say(problem.to_owned());
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
    /// Remembers how the output is opened, what hangs on it, and which pen is held. Where it is not known for which output
    /// that was set, only the pen is remembered: the next output may be somebody's headphones.
    pub(super) fn remember_rig(&mut self, rig: &Rig) {
        let output = if rig.opens_unlike(self.session.rig()) { self.output_of_rig() } else { None };
        let before = self.files.settings.rig.as_ref();
        self.files.settings.rig = Some(match output {
            Some(output) => remembered(rig, output, before),
            None => with_pen_of(rig, before),
        });
    }

    /// The output that the rig is set for: the one that is remembered, else the one that the system prefers. One that was
    /// only named for this start is not remembered, so neither is what is set for it.
    fn output_of_rig(&self) -> Option<String> {
        if self.is_output_given {
            return None;
        }
        let left = self.files.settings.rig.as_ref().and_then(|left| left.output.clone());
        left.or_else(|| self.session.output_id().filter(|id| *id != NULL_ID).map(str::to_owned))
    }

    /// Once a frame: remembers the output that was chosen, once it is open, with the rig that it is opened with.
    pub(super) fn remember_output(&mut self) {
        let is_open = |id: &mut String| self.session.output_id() == Some(id.as_str());
        if let Some(id) = self.asked_output.take_if(is_open) {
            self.is_output_given = false;
            let before = self.files.settings.rig.as_ref();
            self.files.settings.rig = Some(remembered(self.session.rig(), id, before));
        }
    }
}
