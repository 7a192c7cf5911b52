//! Opens the export sheet.

use shagreen_core::space::texture_path::UserPath;
use shagreen_formats::library::id_from_name;
use shagreen_studio::export::{FormatInfo, listed, signal_format};

use super::Window;
use crate::panel::Panel;
use crate::sheets::Sheet;
use crate::sheets::export::{ExportSheet, ExportSubject};
use crate::state::audible_texture::AudibleTexture;

impl Window {
    /// Opens the export sheet with the format of this id. If the texture cannot be exported in it, the sheet opens with a
    /// format that can, and says why; if it can be exported in none, the status bar says why.
    pub(super) fn open_export(&mut self, format: &str) {
        let Some(format) = listed().find(|listed| listed.id == format) else { return };
        let compared = self.compared_texture();
        let contact = self.pages.stage.pad.contact(&self.session);
        let signal = self.session.signal(&self.project, compared.as_deref(), contact);
        let entry = self.session.texture_entry(&self.project, compared.as_deref());
        let is_of_signals = |format: FormatInfo| signal_format(format.id).is_some();
        let problem_of =
            |format| if is_of_signals(format) { signal.as_ref().err() } else { entry.as_ref().err() };
        let possible = std::iter::once(format).chain(listed()).find(|format| problem_of(*format).is_none());
        let Some(possible) = possible else {
            if let Some(reason) = problem_of(format) {
                self.session.say(reason.clone());
            }
            return;
        };
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let name = panel.heard_name();
        let is_solo = panel.solo().is_some() && self.session.felt_name().is_none();
        let id = id_from_name(&name);
        let signal = signal.map(|mut file| {
            file.sidecar.name = Some(name.clone());
            file
        });
        // A blind comparison hides the authored textures, and a signal of the Signals workspace takes their place.
        let n_authored = if self.session.authored().is_some() { self.project.authored.len() } else { 0 };
        let texture = compared.as_deref().unwrap_or(self.project.texture());
        let route = texture.path.as_ref().and_then(UserPath::route);
        let has_path = route.is_some() && !is_solo && self.session.felt_name().is_none();
        let audible = AudibleTexture { name, signal, entry, has_path };
        let subject = ExportSubject { audible, is_solo, n_authored, contact };
        let sheet = ExportSheet::new(subject, possible, &self.exports_folder, &id);
        self.sheet = Sheet::Export(Box::new(sheet));
        self.offer_folders();
    }
}
