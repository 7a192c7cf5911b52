//! Sheet that exports the audible texture, or all authored ones, for other programs. It lists the formats, the options of
//! the chosen one and what it cannot store, and asks once before it replaces files.

mod job;
mod signal_ui;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Button, Color32, Context, Key, Label, RichText, ScrollArea, TextStyle, Ui};
use shagreen_core::units::Contact;
use shagreen_formats::library::Provenance;
use shagreen_studio::export::{self, FormatInfo, WAV};

use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::sheet_frame::{is_left, sheet};
use crate::look::theme::{GAP, Tokens, tokens};
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
/// Greatest height of the list of what is not stored, in points.
const LOST_HEIGHT: f32 = 110.0;

/// Files to export.
pub(crate) struct ExportSubject {
    pub(crate) audible: AudibleTexture,
    /// Number of authored textures; zero if only the audible one can be exported.
    pub(crate) n_authored: usize,
    /// Steady contact of the signals.
    pub(crate) contact: Contact,
}

/// State of the open sheet.
pub(crate) struct ExportSheet {
    audible: Arc<AudibleTexture>,
    n_authored: usize,
    contact: Contact,
    /// All authored textures, once they are asked for.
    authored: Option<Arc<AuthoredSources>>,
    format: FormatInfo,
    options: SignalOptions,
    /// Whether all authored textures are exported.
    is_all: bool,
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
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// This number of files would be replaced.
    Exists(usize),
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
            n_authored: subject.n_authored,
            contact: subject.contact,
            authored: None,
            format,
            options: SignalOptions::default(),
            is_all: false,
            path: PathField::new(path.display().to_string()),
            state: State::default(),
            summarized: None,
            summary: None,
            summaries: LatestJob::default(),
        }
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
        let mut commands: Vec<Command> = self.collect().into_iter().collect();
        self.follow_summary(ctx, panel);
        let shown = sheet(ctx, "export sheet", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui, panel)
        });
        commands.extend(shown.inner.then_some(Command::CloseSheet));
        let is_done = matches!(self.state, State::Saved(_)) && ctx.input(|i| i.key_pressed(Key::Enter));
        if (is_left(ctx) || is_done) && !self.is_saving() {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    /// Draws the content; returns whether the sheet was closed.
    fn content_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> bool {
        let t = tokens(ui.ctx());
        let is_enabled = !self.is_saving();
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let mut is_changed = false;
        ui.add_enabled_ui(is_enabled, |ui| {
            is_changed |= self.formats_ui(ui, t);
            ui.add_space(GAP);
            if let Ok(signal) = &self.audible.signal
                && self.format == WAV
            {
                is_changed |= options_ui(ui, signal, &mut self.options);
            }
            if self.n_authored > 1 {
                let all = ui.checkbox(&mut self.is_all, strings::all_of(self.n_authored));
                is_changed |= all.on_hover_text(strings::ALL_HELP).changed();
            }
        });
        ui.add_space(GAP);
        let texts = PathTexts {
            title: strings::TITLE,
            name: strings::PATH,
            hint: strings::HINT,
            ending: self.format.ending,
        };
        let input = self.path.show(ui, texts, is_enabled);
        if is_changed || input.is_changed {
            // For several files the dialog of the system has asked about one only.
            let is_asked = input.is_chosen && !self.is_all && Path::new(self.path.text()).exists();
            self.state = if is_asked { State::Exists(1) } else { State::Asking };
        }
        // The list comes later and has any length; what is above it must not move then.
        ui.vertical(|ui| {
            ui.set_min_height(LOST_HEIGHT + ui.text_style_height(&TextStyle::Body) + GAP);
            self.lost_ui(ui, t);
        });
        let (text, color) = self.message(t);
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
        ui.add_space(GAP);
        ui.horizontal(|ui| {
            let replaces = matches!(self.state, State::Exists(_));
            let is_saved = matches!(self.state, State::Saved(_));
            let can_save = !self.path.text().is_empty() && is_enabled && !is_saved;
            let save = Button::new(if replaces { import::REPLACE } else { strings::EXPORT_NOW });
            let is_entered = input.is_entered && !replaces;
            if ui.add_enabled(can_save, save).clicked() || (can_save && is_entered) {
                self.save(panel, replaces, ui.ctx());
            }
            let close = Button::new(if is_saved { import::CLOSE } else { import::CANCEL });
            ui.add_enabled(!self.is_saving(), close).clicked()
        })
        .inner
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
            let mut response = ui.add_enabled(problem.is_none(), button).accessible_name(format.name);
            if let Some(problem) = problem {
                response = response.on_disabled_hover_text(problem.as_str());
            }
            if response.clicked() {
                self.format = format;
            }
            ui.add(Label::new(RichText::new(format.help).small().color(t.text_weak)).selectable(false));
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

    /// Draws what the files cannot store, and a warning about textures that must not be redistributed.
    fn lost_ui(&self, ui: &mut Ui, t: &Tokens) {
        let weak = |text: &str| Label::new(RichText::new(text).color(t.text_weak)).wrap();
        let summary = match &self.summary {
            None => {
                ui.add(weak(strings::CHECKING));
                return;
            }
            Some(Err(reason)) => {
                ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
                return;
            }
            Some(Ok(summary)) => summary,
        };
        ui.add(weak(if summary.lost.is_empty() { strings::NOTHING_LOST } else { strings::LOST }));
        ScrollArea::vertical().max_height(LOST_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
            for property in &summary.lost {
                ui.add(weak(&strings::lost(property)));
            }
        });
        let restricted: Vec<&str> = summary.restricted.iter().map(String::as_str).collect();
        if let Some(warning) = Provenance::warning(&restricted) {
            ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
        }
    }

    /// What would happen, or has happened.
    fn message(&self, t: &Tokens) -> (String, Color32) {
        match &self.state {
            State::Asking => (self.to_save(), t.text_weak),
            State::Exists(n) => (strings::exists(*n, self.is_all), t.warning),
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

    fn to_save(&self) -> String {
        if self.is_all {
            return strings::all_to_save(self.n_authored, self.format.name);
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
        let path = completed(self.path.text(), self.format.ending);
        self.path.set(&path);
        self.state = match self.job(panel, path) {
            Ok(job) => {
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
            Ok(Outcome::Exists(n)) => State::Exists(n),
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
        self.path.refocus();
        command
    }

    /// Takes in a summary, and asks for another one when the choices have changed.
    fn follow_summary(&mut self, ctx: &Context, panel: &Panel<'_>) {
        let choice =
            Choice { format: self.format, is_all: self.is_all, follows_stroke: self.options.follows_stroke };
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
