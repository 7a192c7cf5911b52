//! Button that asks for a file with the dialog of the operating system. A path can always be typed instead: on a system
//! without such a dialog, the button says so.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant};

use egui::{Button, Context, Id, Ui};

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
}

/// Width that the button needs beside a path field, in points.
pub(crate) const BROWSE_WIDTH: f32 = 92.0;

/// State of the button.
#[derive(Default)]
pub(crate) struct Browse {
    choosing: Option<(Receiver<Vec<PathBuf>>, Instant)>,
    is_missing: bool,
}

/// Lets sheets open the dialog of the system by themselves. Tests, which have no dialogs, do not call it.
pub(crate) fn allow_dialogs(ctx: &Context) {
    ctx.data_mut(|data| data.insert_temp(allowed(), true));
}

fn allowed() -> Id {
    Id::unique("dialogs of the system")
}

impl Browse {
    /// Opens the dialog at once, where the program may.
    pub(crate) fn begin(&mut self, ctx: &Context, asked: &Asked<'_>) {
        if ctx.data(|data| data.get_temp::<bool>(allowed())) == Some(true) {
            self.ask(ctx, asked);
        }
    }

    /// Draws the button, named `of` for screen readers; returns the files that were chosen.
    pub(crate) fn show(&mut self, ui: &mut Ui, of: &str, asked: &Asked<'_>) -> Vec<PathBuf> {
        let chosen = self.collect();
        let button = ui.add_enabled(self.choosing.is_none(), Button::new(strings::BROWSE));
        let help = if self.is_missing { strings::MISSING } else { strings::BROWSE_HELP };
        let button = button.accessible_name(strings::browse_for(of)).on_hover_text(help);
        if button.clicked() {
            self.ask(ui.ctx(), asked);
        }
        if self.is_missing {
            button.show_tooltip_text(strings::MISSING);
        }
        chosen
    }

    fn ask(&mut self, ctx: &Context, asked: &Asked<'_>) {
        if self.choosing.is_some() {
            return;
        }
        self.is_missing = false;
        let mut dialog = rfd::AsyncFileDialog::new().set_title(asked.title);
        if !asked.endings.is_empty() {
            dialog = dialog.add_filter(asked.kind, asked.endings);
        }
        if let Some(folder) = asked.folder.filter(|folder| folder.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        // Made here, because some systems open dialogs from the main thread only.
        let ctx = ctx.clone();
        let receiver = if let Some(name) = asked.name {
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
