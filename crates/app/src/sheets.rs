//! What lies over the window: the sheet that is open, and where dropped files go.

use std::path::Path;

use egui::{Align2, Context, DroppedFileHandle, FontId, Id, LayerId, Order, Popup, Stroke, StrokeKind};
use shagreen_formats::project::EXTENSION;

use crate::command::{Command, FileCommand};
use crate::devices::DevicesSheet;
use crate::document::Document;
use crate::gallery_sheet::GallerySheet;
use crate::import::sheet::{ImportSheet, Surroundings};
use crate::import::source::Source;
use crate::leaving::{Leave, leaving_ui};
use crate::open_sheet::OpenSheet;
use crate::panel::Panel;
use crate::prompt::PromptCommand;
use crate::recorded_stroke::{StrokeCommand, is_stroke_file};
use crate::recovered_ui::recovered_ui;
use crate::recovery::Leftover;
use crate::save::SaveSheet;
use crate::shortcuts_ui::shortcuts_ui;
use crate::signals::SignalsCommand;
use crate::strings;
use crate::texture_sheet::TextureSheet;
use crate::theme::{RADIUS, tokens};
use crate::workspace::Workspace;

/// The sheet that is open, if one is.
#[derive(Default)]
pub(crate) enum Sheet {
    /// None.
    #[default]
    Closed,
    /// Files become textures.
    Import(Box<ImportSheet>),
    /// The library or a figure goes into a file.
    Save(SaveSheet),
    /// The output, its actuator and the pen.
    Devices(Box<DevicesSheet>),
    /// A project or a library is looked for.
    Open(OpenSheet),
    /// A project of the gallery is looked for.
    Gallery(GallerySheet),
    /// What is known of a texture is shown.
    Texture(Box<TextureSheet>),
    /// The keys are shown.
    Shortcuts,
    /// Something would be lost.
    Leaving(Leave),
    /// What a program left behind is offered.
    Recovered(Vec<Leftover>),
}

impl Sheet {
    pub(crate) fn is_open(&self) -> bool {
        !matches!(self, Self::Closed)
    }

    /// Opens the import sheet, or adds to the one that is open.
    pub(crate) fn import(&mut self, sources: Vec<Source>, ctx: &Context) {
        if !matches!(self, Self::Import(_)) {
            *self = Self::Import(Box::new(ImportSheet::new(ctx)));
        }
        if let Self::Import(sheet) = self {
            sheet.load(sources);
        }
    }

    /// The same, and recordings find their places.
    pub(crate) fn import_here(&mut self, sources: Vec<Source>, ctx: &Context) {
        self.import(sources, ctx);
        if let Self::Import(sheet) = self {
            sheet.place_recordings();
        }
    }

    /// Draws the sheet over the window, and where files would go that hover over it; returns what the user asked for.
    /// Files dropped on the workspace Build are judgments, on Signals they are signals; elsewhere a stroke is repeated,
    /// photos find their places or become the picture of a texture, and others are imported.
    pub(crate) fn show(
        &mut self,
        ctx: &Context,
        panel: &Panel<'_>,
        document: &Document,
        workspace: Workspace,
    ) -> Vec<Command> {
        let session = panel.session;
        let mut commands = match self {
            Self::Closed => Vec::new(),
            Self::Import(sheet) => {
                let around =
                    Surroundings { library: session.library(), space_rate_hz: session.space_rate_hz() };
                sheet.show(ctx, around)
            }
            Self::Save(sheet) => sheet.show(ctx, session.library()),
            Self::Devices(sheet) => sheet.show(ctx, session),
            Self::Open(sheet) => sheet.show(ctx, document.is_opening()),
            Self::Gallery(sheet) => sheet.show(ctx),
            Self::Texture(sheet) => sheet.show(ctx, panel),
            Self::Shortcuts => shortcuts_ui(ctx).into_iter().collect(),
            Self::Leaving(leave) => leaving_ui(ctx, *leave, &document.name()),
            Self::Recovered(leftovers) => recovered_ui(ctx, leftovers),
        };
        if matches!(self, Self::Save(sheet) if sheet.is_saving()) {
            // It stays until its outcome has been shown.
            return commands;
        }
        let is_import = matches!(self, Self::Import(_));
        let are_judgments = workspace == Workspace::Build && !is_import;
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        let is_project = |file: &DroppedFileHandle| {
            let path = file.path();
            (path.extension()? == EXTENSION).then(|| path.to_owned())
        };
        let are_signals = workspace == Workspace::Signals && !is_import;
        let are_strokes = !are_judgments && !is_import;
        let (strokes, dropped): (Vec<_>, Vec<_>) =
            dropped.into_iter().partition(|file| are_strokes && is_stroke_file(file));
        if !strokes.is_empty() {
            let sources = strokes.into_iter().map(Source::Dropped).collect();
            commands.push(Command::Stroke(StrokeCommand::Read(sources)));
        }
        // Whoever looks at the details of a texture drops its picture; else photos are something to feel.
        let is_picture = workspace != Workspace::Author || Popup::is_any_open(ctx);
        let (photos, others): (Vec<_>, Vec<_>) =
            dropped.iter().cloned().partition(|file| is_photo(file.path()));
        let sources = |files: Vec<DroppedFileHandle>| files.into_iter().map(Source::Dropped).collect();
        if let Some(project) = dropped.iter().find_map(is_project) {
            commands.push(Command::File(FileCommand::Open(project)));
        } else if dropped.is_empty() {
            // Nothing was dropped, or only strokes.
        } else if are_signals {
            commands.push(Command::Signals(SignalsCommand::ReadAll(sources(dropped))));
        } else if are_judgments {
            commands.push(Command::ReadJudgments(sources(dropped)));
        } else if let Some(photo) = photos.first().filter(|_| is_picture) {
            commands.push(Command::ReadPhoto(Source::Dropped(photo.clone())));
        } else {
            if !photos.is_empty() {
                commands.push(Command::Prompt(PromptCommand::Look(sources(photos))));
            }
            if !others.is_empty() {
                let import = if is_import { Command::Import } else { Command::ImportHere };
                commands.push(import(sources(others)));
            }
        }
        if ctx.input(|i| !i.raw.hovered_files.is_empty()) {
            let (here, kinds) = if are_judgments {
                (strings::build::DROP_HERE, strings::build::DROP_KINDS)
            } else if are_signals {
                (strings::signals::DROP_HERE, strings::signals::DROP_KINDS)
            } else {
                (strings::import::DROP_HERE, strings::import::DROP_KINDS)
            };
            drop_here(ctx, here, kinds);
        }
        commands
    }
}

/// Whether a file is a photo by its name.
fn is_photo(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ["jpg", "jpeg", "png"].contains(&ending.as_str()))
}

/// Says over the whole window what may be dropped.
fn drop_here(ctx: &Context, here: &str, kinds: &str) {
    let t = tokens(ctx);
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("drop here")));
    let area = ctx.content_rect();
    painter.rect_filled(area, 0.0, t.background.gamma_multiply(0.88));
    let stroke = Stroke::new(2.0, t.accent);
    painter.rect_stroke(area.shrink(18.0), f32::from(RADIUS), stroke, StrokeKind::Inside);
    let center = area.center();
    painter.text(center, Align2::CENTER_BOTTOM, here, FontId::proportional(24.0), t.text);
    let below = center + egui::vec2(0.0, 12.0);
    painter.text(below, Align2::CENTER_TOP, kinds, FontId::proportional(13.5), t.text_weak);
}
