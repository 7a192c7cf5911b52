//! Execution of commands about stroke recordings.

use egui::Context;

use super::Window;
use crate::command::stroke::StrokeCommand;
use crate::sheets::Sheet;
use crate::sheets::open_sheet::OpenSheet;
use crate::sheets::save::SaveSheet;
use crate::state::stroke_file::StrokeFile;
use crate::strings::stroke as strings;

impl Window {
    pub(super) fn carry_out_stroke(&mut self, command: StrokeCommand, ctx: &Context) {
        match command {
            StrokeCommand::Record if self.session.recording().is_some() => self.session.end_recording(),
            StrokeCommand::Record => self.session.begin_recording(),
            StrokeCommand::FinishByPointer => self.session.end_recording_by_pointer(),
            StrokeCommand::AskWhatToOpen => {
                self.sheet = Sheet::Open(OpenSheet::of_strokes(&self.usual_folder(), ctx));
            }
            StrokeCommand::Read(sources) => {
                self.readers.strokes.read(sources, self.session.rig().pressure_map, ctx);
            }
            StrokeCommand::Save => {
                if let Some(stroke) = self.session.stroke() {
                    let path = self.exports_folder.join(strings::FILE_NAME);
                    self.sheet = Sheet::Save(SaveSheet::stroke(StrokeFile::new(stroke), &path));
                }
            }
        }
    }

    /// Takes in a stroke recording that was read.
    pub(super) fn collect_strokes(&mut self) {
        match self.readers.strokes.collect() {
            Some(Ok((stroke, mut warnings))) => {
                if matches!(&self.sheet, Sheet::Open(sheet) if sheet.is_for_strokes()) {
                    self.sheet = Sheet::Closed;
                }
                if self.session.set_stroke(stroke) {
                    warnings.insert(0, strings::REPLACED.to_owned());
                }
                self.say_warnings(&warnings);
            }
            Some(Err(reason)) => match &mut self.sheet {
                Sheet::Open(sheet) if sheet.is_for_strokes() => sheet.say(reason),
                _ => self.session.say(reason),
            },
            None => {}
        }
    }
}
