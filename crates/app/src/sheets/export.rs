//! Sheet that exports the audible texture, or all authored ones, for other programs. It lists the formats, the options of
//! the chosen one and what it cannot store, and asks once before it replaces files.

mod job;
mod signal_ui;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Button, Color32, Context, Id, Key, Label, RichText, ScrollArea, TextStyle, Ui, vec2};
use shagreen_core::units::Contact;
use shagreen_formats::library::Provenance;
use shagreen_formats::wav_encoding::Level;
use shagreen_studio::export::{self, FormatInfo, WAV};

use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, Tokens, tokens};
use crate::look::together::at_right_ui;
use crate::panel::Panel;
use crate::session::authored_sources::AuthoredSources;
use crate::sheets::export::job::{Format, Job, Outcome, Summary, What};
use crate::sheets::export::signal_ui::options_ui;
use crate::sheets::path_field::{PathField, PathTexts, completed};
use crate::state::audible_texture::AudibleTexture;
use crate::state::background::{JobPanicked, LatestJob, in_background};
use crate::state::bench_signal::BenchSignal;
use crate::state::signal_file::{SignalOptions, Sounding};
use crate::strings::{export as strings, import, signal};

/// Width of the sheet, in points.
const WIDTH: f32 = 560.0;
/// Number of lines in the list of what is not stored.
const LOST_LINES: f32 = 5.0;
/// Number of lines of the message above the buttons.
const MESSAGE_LINES: f32 = 2.0;
/// Height of the options of a signal, in points, until it is measured.
const OPTIONS_HEIGHT: f32 = 84.0;
/// Largest number of files whose names are listed.
const MOST_NAMED: usize = 4;

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

/// What a summary depends on.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Choice {
    format: FormatInfo,
    is_all: bool,
    follows_stroke: bool,
    level: Level,
    shares_scale: bool,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// These files would be replaced.
    Exists(Vec<PathBuf>),
    Saving(Receiver<Outcome>, Option<Arc<BenchSignal>>),
    Saved(Vec<PathBuf>),
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
        let State::Saved(paths) = &self.state else { return None };
        paths.first()?.parent()
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

    /// Takes over the options of the last export, as far as this signal has them.
    fn recall_options(&mut self, ctx: &Context) {
        if std::mem::replace(&mut self.has_recalled, true) {
            return;
        }
        let Ok(signal) = &self.audible.signal else { return };
        let last: Option<SignalOptions> = ctx.data(|data| data.get_temp(last_options()));
        if let Some(last) = last.filter(|last| f64::from(last.rate_hz) >= signal.model_rate.0) {
            self.options = SignalOptions { follows_stroke: false, ..last };
        }
    }

    /// Draws the content; returns whether the sheet was closed.
    fn content_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> bool {
        let t = tokens(ui.ctx());
        let is_enabled = !self.is_saving();
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        let mut subject =
            strings::subject(&self.audible.name, self.is_solo, self.is_all.then_some(self.n_authored));
        if !self.is_all && self.format == WAV && self.audible.plays_path() {
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

    /// Draws the options of a signal, or leaves their room; returns whether any has changed.
    fn options_ui(&mut self, ui: &mut Ui) -> bool {
        let top = ui.cursor().top();
        match &self.audible.signal {
            Ok(signal) if self.format == WAV => {
                let is_all = (self.n_authored > 1).then_some(self.is_all);
                let is_changed = options_ui(ui, signal, &mut self.options, is_all);
                self.options_height = ui.min_rect().bottom() - top;
                is_changed
            }
            Ok(_) => {
                ui.allocate_space(vec2(0.0, self.options_height));
                false
            }
            Err(_) => false,
        }
    }

    /// Turns the path of a file into that of its folder if all textures are exported, and the other way round.
    fn follow_number(&mut self) {
        let path = if self.is_all {
            let path = self.folder();
            if let Some(name) = Path::new(self.path.text()).file_stem().filter(|_| path.is_some()) {
                self.name = name.to_string_lossy().into_owned();
            }
            path.unwrap_or_else(|| PathBuf::from(self.path.text()))
        } else {
            // A name may have dots.
            Path::new(self.path.text()).join(format!("{}.{}", self.name, self.format.ending))
        };
        self.path.set(&path);
    }

    /// Folder of the typed path if that is the path of a file: one with the ending of a format.
    fn folder(&self) -> Option<PathBuf> {
        let path = Path::new(self.path.text());
        let is_listed =
            |ending: &OsStr| export::listed().any(|format| ending.eq_ignore_ascii_case(format.ending));
        let is_file = path.extension().is_some_and(is_listed) && !path.is_dir();
        if is_file { path.parent().map(Path::to_owned) } else { None }
    }

    /// Draws the message in a fixed height. The names of all files are in its tooltip.
    fn message_ui(&self, ui: &mut Ui, panel: &Panel<'_>) {
        let (text, color) = self.message(tokens(ui.ctx()), panel);
        let height = height_of(ui, MESSAGE_LINES);
        let area = ScrollArea::vertical().id_salt("message").max_height(height).min_scrolled_height(height);
        area.auto_shrink(false).show(ui, |ui| {
            let label = ui.add(Label::new(RichText::new(text).color(color)).wrap());
            if self.is_all && matches!(self.state, State::Asking) {
                label.on_hover_text(self.file_names(panel).join("\n"));
            }
        });
    }

    /// Names of the files of all authored textures.
    fn file_names(&self, panel: &Panel<'_>) -> Vec<String> {
        let names = panel.project.authored.iter().map(|texture| texture.name.as_str());
        let paths = export::paths_in(Path::new(""), names, self.format.ending);
        paths.iter().map(|path| path.display().to_string()).collect()
    }

    /// Draws the list of formats; returns whether another one was chosen.
    fn formats_ui(&mut self, ui: &mut Ui, t: &Tokens) -> bool {
        let before = self.format;
        for format in export::listed() {
            let problem = if format == WAV {
                self.audible.signal.as_ref().err()
            } else {
                self.audible.entry.as_ref().err()
            };
            let text = strings::format(format.name, format.ending);
            let button = Button::selectable(self.format == format, text);
            if ui.add_enabled(problem.is_none(), button).accessible_name(format.name).clicked() {
                self.format = format;
            }
            let (below, color) =
                problem.map_or((format.help, t.text_weak), |problem| (problem.as_str(), t.warning));
            ui.add(Label::new(RichText::new(below).small().color(color)).wrap().selectable(false));
        }
        if self.format == before {
            return false;
        }
        let path = Path::new(self.path.text());
        if path.extension().is_some_and(|ending| ending == before.ending) {
            let path = path.with_extension(self.format.ending);
            self.path.set(&path);
        }
        true
    }

    /// Draws what the files cannot store, and a warning about textures that must not be redistributed, in a fixed height:
    /// the list comes later and has any length, and nothing else must move then.
    fn lost_ui(&self, ui: &mut Ui, t: &Tokens) {
        let height = height_of(ui, LOST_LINES);
        let area = ScrollArea::vertical().id_salt("lost").max_height(height).min_scrolled_height(height);
        area.auto_shrink(false).show(ui, |ui| {
            // Leaves room for the scroll bar.
            ui.set_max_width(ui.available_width() - 2.0 * GAP);
            let label = |text: &str, color| Label::new(RichText::new(text).color(color)).wrap();
            match &self.summary {
                None => {
                    ui.add(label(strings::CHECKING, t.text_weak));
                }
                Some(Err(reason)) => {
                    ui.add(label(reason, t.error));
                }
                Some(Ok(summary)) => {
                    let restricted: Vec<&str> = summary.restricted.iter().map(String::as_str).collect();
                    if let Some(warning) = Provenance::warning(&restricted) {
                        ui.add(label(&warning, t.warning));
                    }
                    let heading = if summary.lost.is_empty() { strings::NOTHING_LOST } else { strings::LOST };
                    ui.add(label(heading, t.text_weak));
                    for property in &summary.lost {
                        ui.add(label(&strings::lost(property), t.text_weak));
                    }
                }
            }
        });
    }

    /// What would happen, or has happened.
    fn message(&self, t: &Tokens, panel: &Panel<'_>) -> (String, Color32) {
        match &self.state {
            State::Asking => (self.to_save(panel), t.text_weak),
            State::Exists(paths) => (strings::exists(&listed(&names_of(paths)), paths.len()), t.warning),
            State::Saving(..) => (import::SAVING.to_owned(), t.text_weak),
            State::Saved(paths) => {
                let shown = |path: Option<&Path>| path.unwrap_or(Path::new("")).display().to_string();
                let first = paths.first().map(PathBuf::as_path);
                let text = if self.is_all {
                    strings::saved_all(paths.len(), &shown(first.and_then(Path::parent)))
                } else {
                    import::saved(&shown(first))
                };
                (text, t.accent)
            }
            State::Failed(reason) => (reason.clone(), t.error),
        }
    }

    fn to_save(&self, panel: &Panel<'_>) -> String {
        if self.is_all {
            let names = self.file_names(panel);
            let text = strings::all_to_save(&listed(&names), names.len(), self.format.name);
            let folder = self.folder().unwrap_or_else(|| completed(self.path.text(), ""));
            let is_new = !folder.exists();
            return if is_new { text + strings::NEW_FOLDER } else { text };
        }
        match &self.audible.signal {
            Ok(file) if self.format == WAV => match &file.sounding {
                Sounding::Bench(of) => signal::bench_to_save(&of.name, of.seconds()),
                Sounding::Mix(..) | Sounding::Path(_) => {
                    let Contact { speed, force } = file.contact;
                    let steady = (!self.options.follows_stroke).then_some((speed.mm_per_s(), force.0));
                    signal::to_save(file.seconds(&self.options), steady)
                }
            },
            _ => strings::texture_to_save(&self.audible.name, self.format.name),
        }
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
        // The only format in the list that is not one of texture models is WAV.
        let model = export::format(self.format.id).map(Format::Model);
        Ok(Job { what, format: model.unwrap_or_else(|| Format::Wav(self.options.clone())), path })
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
                ctx.data_mut(|data| data.insert_temp(last_options(), self.options.clone()));
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
            Ok(Outcome::Saved(paths)) => {
                command = signal.map(|signal| Command::Signals(SignalsCommand::NoteExported(signal)));
                State::Saved(paths)
            }
            Ok(Outcome::Exists(paths)) => State::Exists(paths),
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
        self.path.refocus();
        command
    }

    /// Takes in a summary, and asks for another one when the choices have changed.
    fn follow_summary(&mut self, ctx: &Context, panel: &Panel<'_>) {
        let SignalOptions { follows_stroke, shares_scale, encoding, .. } = &self.options;
        let choice = Choice {
            format: self.format,
            is_all: self.is_all,
            follows_stroke: *follows_stroke,
            level: encoding.level,
            shares_scale: *shares_scale,
        };
        if self.summarized != Some(choice) {
            (self.summarized, self.summary) = (Some(choice), None);
            let job = self.job(panel, PathBuf::new());
            self.summaries.ask(ctx, move || job?.summary());
        }
        if let Some(done) = self.summaries.collect(ctx) {
            self.summary = Some(done.unwrap_or_else(|JobPanicked| Err(import::SAVE_BROKEN.to_owned())));
        }
    }
}

fn last_options() -> Id {
    Id::unique("options of the last exported signal")
}

/// Height of this number of lines of text with the gaps between them, in points.
fn height_of(ui: &Ui, n_lines: f32) -> f32 {
    n_lines * (ui.text_style_height(&TextStyle::Body) + ui.spacing().item_spacing.y)
}

/// File names of paths.
fn names_of(paths: &[PathBuf]) -> Vec<String> {
    let names = paths.iter().map(|path| path.file_name().unwrap_or(path.as_os_str()));
    names.map(|name| name.to_string_lossy().into_owned()).collect()
}

/// The first names, and the number of the others.
fn listed(names: &[String]) -> String {
    let mut listed = names.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > MOST_NAMED {
        listed += &strings::and_more(names.len() - MOST_NAMED);
    }
    listed
}

#[cfg(test)]
mod tests;
