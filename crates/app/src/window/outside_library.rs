//! Answers to the question about a library outside the folder of its project.

use egui::Context;

use super::Window;
use crate::command::LibraryAnswer;
use crate::sheets::Sheet;

impl Window {
    /// Opens the project as the user answered. The question stays until the project is open, because reading may fail.
    pub(super) fn answer_library(&mut self, answer: LibraryAnswer, ctx: &Context) {
        let Sheet::OutsideLibrary(asked) = &self.sheet else { return };
        let (project, reading) = (asked.project.clone(), asked.reading);
        match answer {
            LibraryAnswer::Read => {
                self.files.settings.permit_library(&project, &asked.library);
                self.files.open(project, reading, ctx);
            }
            LibraryAnswer::Instead(library) => self.files.open_on(project, Some(library), reading, ctx),
            LibraryAnswer::Without => self.files.open_on(project, None, reading, ctx),
        }
    }
}
