//! Sheet that exports the audible texture, or all authored ones, for other programs. It lists the formats, the options of
//! the chosen one and what it cannot store, and asks once before it replaces files.

mod formats_ui;
mod job;
mod lost_ui;
mod message_ui;
mod options;
mod paths;
mod signal_ui;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Button, Context, Key, Label, RichText, TextStyle, Ui};
use shagreen_core::units::Contact;
use shagreen_studio::export::{self, FormatInfo, SignalFormat, signal_format};

use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, tokens};
use crate::look::together::at_right_ui;
use crate::panel::Panel;
use crate::session::authored_sources::AuthoredSources;
use crate::sheets::export::job::{Format, Job, Outcome, Saved, Summary, What};
use crate::sheets::export::lost_ui::Choice;
use crate::sheets::path_field::{PathField, PathTexts, completed};
use crate::state::audible_texture::AudibleTexture;
use crate::state::background::{LatestJob, in_background};
use crate::state::bench_signal::BenchSignal;
use crate::state::signal_file::SignalOptions;
use crate::strings::{export as strings, import};

/// Width of the sheet, in points.
const WIDTH: f32 = 560.0;
/// Height of the options of a signal, in points, until it is measured.
const OPTIONS_HEIGHT: f32 = 84.0;

/// Files to export.
pub(crate) struct ExportSubject {
    pub(crate) audible: AudibleTexture,
    /// Whether the audible texture is one of the list that plays alone.
    pub(crate) is_solo: bool,
    /// Number of authored textures; zero if only the audible one can be exported.
    pub(crate) n_authored: usize,
    /// Steady contact of the signals.
    pub(crate) contact: Contact,
}

/// State of the open sheet.
pub(crate) struct ExportSheet {
    audible: Arc<AudibleTexture>,
    is_solo: bool,
    n_authored: usize,
    contact: Contact,
    /// All authored textures, once they are asked for.
    authored: Option<Arc<AuthoredSources>>,
    format: FormatInfo,
    options: SignalOptions,
    /// Whether the options of the last export have been taken over.
    has_recalled: bool,
    /// Whether all authored textures are exported.
    is_all: bool,
    /// Name of the file of the audible texture, without its ending.
    name: String,
    /// Height of the options of a signal, in points: other formats leave this room, so that nothing moves.
    options_height: f32,
    path: PathField,
    state: State,
    /// Choice whose summary is known or being computed.
    summarized: Option<Choice>,
    summary: Option<Result<Summary, String>>,
    summaries: LatestJob<Result<Summary, String>>,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// These files would be replaced.
    Exists(Vec<PathBuf>),
    Saving(Receiver<Outcome>, Option<Arc<BenchSignal>>),
    Saved(Saved),
    Failed(String),
}

impl ExportSheet {
    /// Sheet with this format selected; the file lies in `folder` by default, and its name is `name`.
    pub(crate) fn new(subject: ExportSubject, format: FormatInfo, folder: &Path, name: &str) -> Self {
        let path = folder.join(name).with_extension(format.ending);
        Self {
            audible: Arc::new(subject.audible),
            is_solo: subject.is_solo,
            n_authored: subject.n_authored,
            contact: subject.contact,
            authored: None,
            format,
            options: SignalOptions::default(),
            has_recalled: false,
            is_all: false,
            name: name.to_owned(),
            options_height: OPTIONS_HEIGHT,
            path: PathField::new(path.display().to_string()),
            state: State::default(),
            summarized: None,
            summary: None,
            summaries: LatestJob::default(),
        }
    }

    /// Offers folders that were used last.
    pub(crate) fn offer(&mut self, folders: Vec<PathBuf>) {
        self.path.offer(folders);
    }

    /// Folder of the exported files.
    pub(crate) fn folder_of_export(&self) -> Option<&Path> {
        let State::Saved(saved) = &self.state else { return None };
        saved.paths.first()?.parent()
    }

    /// Whether files are being written: the sheet stays until the outcome has been shown.
    pub(crate) fn is_saving(&self) -> bool {
        matches!(self.state, State::Saving(..))
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context, panel: &Panel<'_>) -> Vec<Command> {
        self.recall_options(ctx);
        let mut commands: Vec<Command> = self.collect().into_iter().collect();
        self.follow_summary(ctx, panel);
        let shown = sheet(ctx, "export sheet", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui, panel)
        });
        commands.extend(shown.inner.then_some(Command::CloseSheet));
        let is_done = matches!(self.state, State::Saved(_)) && ctx.input(|i| i.key_pressed(Key::Enter));
        if is_done {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    /// Draws the content; returns whether the sheet was closed.
    fn content_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> bool {
        let t = tokens(ui.ctx());
        let is_enabled = !self.is_saving();
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        let mut subject =
            strings::subject(&self.audible.name, self.is_solo, self.is_all.then_some(self.n_authored));
        if !self.is_all && self.signal_format().is_some() && self.audible.plays_path() {
            subject = strings::along_path(&subject);
        }
        ui.add(Label::new(RichText::new(subject).color(t.text_weak)).truncate().selectable(false));
        ui.add_space(GAP);
        let mut is_changed = false;
        ui.add_enabled_ui(is_enabled, |ui| {
            is_changed |= self.formats_ui(ui, t);
            ui.add_space(GAP);
            is_changed |= self.options_ui(ui);
            if self.n_authored > 1 {
                let all = ui.checkbox(&mut self.is_all, strings::all_of(self.n_authored));
                if all.on_hover_text(strings::ALL_HELP).changed() {
                    is_changed = true;
                    self.follow_number();
                }
            }
        });
        ui.add_space(GAP);
        let (hint, ending) =
            if self.is_all { (strings::FOLDER_HINT, "") } else { (strings::HINT, self.format.ending) };
        let texts = PathTexts { title: strings::TITLE, name: strings::PATH, hint, ending };
        let input = self.path.show(ui, texts, is_enabled);
        if is_changed || input.is_changed {
            // A folder is chosen without a question about its files.
            let path = Path::new(self.path.text());
            let is_asked = input.is_chosen && !self.is_all && path.exists();
            self.state = if is_asked { State::Exists(vec![path.to_owned()]) } else { State::Asking };
        }
        self.lost_ui(ui, t);
        self.message_ui(ui, panel);
        ui.add_space(GAP);
        ui.horizontal(|ui| {
            let exists = matches!(self.state, State::Exists(_));
            let is_saved = matches!(self.state, State::Saved(_));
            let can_save = !self.path.text().is_empty() && is_enabled && !is_saved && !exists;
            // Not where the button before was, or a double click would replace files.
            let replaces = exists && ui.button(import::REPLACE).clicked();
            let (save, is_closed) = at_right_ui(ui, |ui| {
                let save = primary_ui(ui, strings::EXPORT_NOW, can_save);
                let close = Button::new(if is_saved { import::CLOSE } else { import::CANCEL });
                (save, ui.add_enabled(is_enabled, close).clicked())
            });
            if save.clicked() || (can_save && input.is_entered) || replaces {
                self.save(panel, replaces, ui.ctx());
            }
            is_closed
        })
        .inner
    }

    /// The selected format if it is one of signals.
    fn signal_format(&self) -> Option<&'static dyn SignalFormat> {
        signal_format(self.format.id)
    }

    /// The export with the present choices.
    ///
    /// # Errors
    /// States why the authored textures are not available.
    fn job(&mut self, panel: &Panel<'_>, path: PathBuf) -> Result<Job, String> {
        let what = if self.is_all {
            let authored = match &self.authored {
                Some(authored) => Arc::clone(authored),
                None => Arc::new(panel.session.authored_sources(panel.project, self.contact)?),
            };
            self.authored = Some(Arc::clone(&authored));
            What::All(authored)
        } else {
            What::Audible(Arc::clone(&self.audible))
        };
        let signal = self.signal_format().map(|format| Format::Signal(format, self.options.clone()));
        let format = signal.or_else(|| export::format(self.format.id).map(Format::Model));
        let format = format.ok_or_else(|| import::SAVE_BROKEN.to_owned())?;
        Ok(Job { what, format, path })
    }

    /// Exports in the background. Existing files are replaced only with `replaces`.
    fn save(&mut self, panel: &Panel<'_>, replaces: bool, ctx: &Context) {
        let path = match self.folder().filter(|_| self.is_all) {
            Some(folder) => completed(&folder.display().to_string(), ""),
            None if self.is_all => completed(self.path.text(), ""),
            None => completed(self.path.text(), self.format.ending),
        };
        self.path.set(&path);
        self.state = match self.job(panel, path) {
            Ok(job) => {
                self.note_options(ctx);
                let signal = job.bench_signal();
                State::Saving(in_background(ctx.clone(), move || job.run(replaces)), signal)
            }
            Err(reason) => State::Failed(reason),
        };
    }

    /// Takes in the outcome of an export. Returns the command that notes an exported signal of the Signals workspace.
    fn collect(&mut self) -> Option<Command> {
        let State::Saving(receiver, signal) = &mut self.state else { return None };
        let outcome = receiver.try_recv();
        let signal = if outcome.is_ok() { signal.take() } else { None };
        let mut command = None;
        self.state = match outcome {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => State::Failed(import::SAVE_BROKEN.to_owned()),
            Ok(Outcome::Saved(saved)) => {
                command = signal.map(|signal| Command::Signals(SignalsCommand::NoteExported(signal)));
                State::Saved(saved)
            }
            Ok(Outcome::Exists(paths)) => State::Exists(paths),
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
        self.path.refocus();
        command
    }
}

/// Height of this number of lines of text with the gaps between them, in points.
fn height_of(ui: &Ui, n_lines: f32) -> f32 {
    n_lines * (ui.text_style_height(&TextStyle::Body) + ui.spacing().item_spacing.y)
}

#[cfg(test)]
mod tests;
