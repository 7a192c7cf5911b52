//! The rig that is remembered from one start to the next.

use egui::Context;
use shagreen_device::output::NULL_ID;
use shagreen_formats::rig_settings::RigSettings;
use shagreen_formats::settings::Settings;

use super::Window;
use crate::rig::Rig;
use crate::rig_memory::{remembered, restored};
use crate::session::{OutputChoice, Session};
use crate::strings::rig as strings;

/// Opens the output as it was left: the one that was chosen last unless `output` says another, and none in its place. On a
/// first start it is `output`.
pub(super) fn open_as_left(session: &mut Session, output: OutputChoice, settings: &Settings, ctx: &Context) {
    let left = settings.rig.as_ref();
    match left.map(restored).transpose() {
        Ok(rig) => {
            session.set_rig(rig.unwrap_or_default(), ctx);
            let chosen = left.and_then(|left| left.output.clone());
            let output = match (output, chosen) {
                (OutputChoice::SystemDefault, Some(id)) => OutputChoice::Id(id),
                (output, _) => output,
            };
            session.open_output(output, ctx);
        }
        // Without its limits nothing is driven.
        Err(error) => session.say(strings::no_actuator(&format!("{error:#}"))),
    }
}

impl Window {
    /// Remembers how the output is opened, what hangs on it, and which pen is held. Where that was set for the output that
    /// the system prefers, it is remembered too: the next one may be somebody's headphones.
    pub(super) fn remember_rig(&mut self, rig: &Rig) {
        let mut settings = remembered(rig, self.files.settings.rig.as_ref());
        let is_set_for_output = !self.is_output_given && rig.opens_unlike(self.session.rig());
        if settings.output.is_none() && is_set_for_output {
            settings.output = self.session.output_id().filter(|id| *id != NULL_ID).map(str::to_owned);
        }
        self.files.settings.rig = Some(settings);
    }

    /// Once a frame: remembers the output that was chosen, once it is open.
    pub(super) fn remember_output(&mut self) {
        let is_open = |id: &mut String| self.session.output_id() == Some(id.as_str());
        if let Some(id) = self.asked_output.take_if(is_open) {
            self.files.settings.rig.get_or_insert_with(RigSettings::default).output = Some(id);
        }
    }
}
