//! Button that asks for a file with the dialog of the operating system. A path can always be typed instead: on a system
//! without such a dialog, a line below the button says so.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant};

use egui::{Button, Context, Id, Label, RichText, Ui};

use crate::look::theme::tokens;
use crate::state::background::in_background;
use crate::strings::browse as strings;

/// A person needs longer than this to close a dialog; an answer that comes sooner is that of a system without dialogs.
const TOO_SOON: Duration = Duration::from_millis(400);

/// What the dialog asks for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Asked<'a> {
    pub(crate) title: &'a str,
    /// Name of the kind of file, and the endings of its names.
    pub(crate) kind: &'a str,
    pub(crate) endings: &'a [&'a str],
    /// Folder that is shown first.
    pub(crate) folder: Option<&'a Path>,
    /// Suggested name of a file to write; `None` asks for files to read.
    pub(crate) name: Option<&'a str>,
    /// Whether several files may be chosen.
    pub(crate) several: bool,
    /// Whether a folder is asked for, and not a file.
    pub(crate) is_folder: bool,
}

/// Width that the button needs beside a path field, in points.
pub(crate) const BROWSE_WIDTH: f32 = 92.0;

/// State of the button.
#[derive(Default)]
pub(crate) struct Browse {
    choosing: Option<(Receiver<Vec<PathBuf>>, Instant)>,
    is_missing: bool,
}

/// Lets the window use the dialogs of the system. Without this call, as in tests, it behaves as on a system without them.
pub(crate) fn allow_dialogs(ctx: &Context) {
    ctx.data_mut(|data| data.insert_temp(allowed(), true));
}

fn allowed() -> Id {
    Id::unique("dialogs of the system")
}

fn are_allowed(ctx: &Context) -> bool {
    ctx.data(|data| data.get_temp(allowed())).unwrap_or(false)
}

impl Browse {
    /// Opens the dialog at once, where the program may.
    pub(crate) fn begin(&mut self, ctx: &Context, asked: &Asked<'_>) {
        if are_allowed(ctx) {
            self.ask(ctx, asked);
        }
    }

    /// Draws the button, named `of` for screen readers; returns the files that were chosen.
    pub(crate) fn show(&mut self, ui: &mut Ui, of: &str, asked: &Asked<'_>) -> Vec<PathBuf> {
        let chosen = self.collect();
        let button = ui.add_enabled(self.choosing.is_none(), Button::new(strings::BROWSE));
        let button = button.accessible_name(strings::browse_for(of)).on_hover_text(strings::BROWSE_HELP);
        if button.clicked() {
            if are_allowed(ui.ctx()) {
                self.ask(ui.ctx(), asked);
            } else {
                self.is_missing = true;
            }
        }
        chosen
    }

    /// Draws the line that says that the system has no dialog, if it turned out to have none. It belongs below the row of
    /// the button.
    pub(crate) fn missing_ui(&self, ui: &mut Ui) {
        if self.is_missing {
            let text = RichText::new(strings::MISSING).color(tokens(ui.ctx()).warning);
            ui.add(Label::new(text).wrap());
        }
    }

    fn ask(&mut self, ctx: &Context, asked: &Asked<'_>) {
        if self.choosing.is_some() {
            return;
        }
        self.is_missing = false;
        let mut dialog = rfd::AsyncFileDialog::new().set_title(asked.title);
        if !asked.endings.is_empty() && !asked.is_folder {
            dialog = dialog.add_filter(asked.kind, asked.endings);
        }
        if let Some(folder) = asked.folder.filter(|folder| folder.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        // Made here, because some systems open dialogs from the main thread only.
        let ctx = ctx.clone();
        let receiver = if asked.is_folder {
            let chosen = dialog.pick_folder();
            in_background(ctx, move || paths_of(pollster::block_on(chosen)))
        } else if let Some(name) = asked.name {
            let chosen = dialog.set_file_name(name).save_file();
            in_background(ctx, move || paths_of(pollster::block_on(chosen)))
        } else if asked.several {
            let chosen = dialog.pick_files();
            in_background(ctx, move || paths_of(pollster::block_on(chosen).into_iter().flatten()))
        } else {
            let chosen = dialog.pick_file();
            in_background(ctx, move || paths_of(pollster::block_on(chosen)))
        };
        self.choosing = Some((receiver, Instant::now()));
    }

    fn collect(&mut self) -> Vec<PathBuf> {
        let Some((receiver, begun)) = &self.choosing else { return Vec::new() };
        let chosen = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return Vec::new(),
            Ok(chosen) => chosen,
            Err(TryRecvError::Disconnected) => Vec::new(),
        };
        self.is_missing = chosen.is_empty() && begun.elapsed() < TOO_SOON;
        self.choosing = None;
        chosen
    }
}

fn paths_of(files: impl IntoIterator<Item = rfd::FileHandle>) -> Vec<PathBuf> {
    files.into_iter().map(|file| file.path().to_owned()).collect()
}
