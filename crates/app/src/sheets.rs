//! Modal sheets (dialogs) over the window, and the target of dropped files.

pub(crate) mod about_sheet;
pub(crate) mod axes_sheet;
pub(crate) mod conflict_ui;
pub mod devices;
pub(crate) mod export;
pub(crate) mod folders_ui;
pub(crate) mod gallery_sheet;
pub(crate) mod guide_sheet;
pub mod import;
pub(crate) mod networks_sheet;
pub(crate) mod open_sheet;
pub(crate) mod outside_library;
pub(crate) mod palette;
pub(crate) mod papers_sheet;
pub(crate) mod path_field;
pub(crate) mod recovered_ui;
pub(crate) mod relief_choice;
pub(crate) mod relief_sheet;
pub mod save;
pub(crate) mod shortcuts_ui;
pub(crate) mod unsaved_changes;

use std::path::Path;

use egui::{Align2, Context, DroppedFileHandle, FontId, Id, LayerId, Order, Popup, Stroke, StrokeKind};
use shagreen_formats::picture::PHOTO_ENDINGS;
use shagreen_formats::project::EXTENSION;
use shagreen_studio::file::ending_of;
use shagreen_studio::open::{is_other_kind, is_study_plan};

use crate::author::texture_sheet::TextureSheet;
use crate::command::prompt::PromptCommand;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::command::stroke::StrokeCommand;
use crate::command::studies::StudiesCommand;
use crate::command::{Command, FileCommand};
use crate::look::sheet_frame::is_left;
use crate::look::theme::{RADIUS, tokens};
use crate::panel::Panel;
use crate::sheets::about_sheet::AboutSheet;
use crate::sheets::axes_sheet::AxesSheet;
use crate::sheets::conflict_ui::conflict_ui;
use crate::sheets::devices::DevicesSheet;
use crate::sheets::export::ExportSheet;
use crate::sheets::gallery_sheet::GallerySheet;
use crate::sheets::guide_sheet::GuideSheet;
use crate::sheets::import::import_context::ImportContext;
use crate::sheets::import::sheet::ImportSheet;
use crate::sheets::networks_sheet::NetworksSheet;
use crate::sheets::open_sheet::OpenSheet;
use crate::sheets::outside_library::OutsideLibrarySheet;
use crate::sheets::palette::PaletteSheet;
use crate::sheets::papers_sheet::PapersSheet;
use crate::sheets::recovered_ui::recovered_ui;
use crate::sheets::relief_choice::ReliefChoice;
use crate::sheets::relief_sheet::ReliefSheet;
use crate::sheets::save::SaveSheet;
use crate::sheets::shortcuts_ui::shortcuts_ui;
use crate::sheets::unsaved_changes::leaving_ui;
use crate::state::conflict::Conflict;
use crate::state::document::Document;
use crate::state::leave::Leave;
use crate::state::recorded_stroke::{is_stroke_file, is_stroke_path};
use crate::state::recovery::Leftover;
use crate::state::source::Source;
use crate::strings;
use crate::workspace::Workspace;

/// Sheet that is open, if any.
#[derive(Default)]
pub(crate) enum Sheet {
    #[default]
    Closed,
    /// Imports files as textures.
    Import(Box<ImportSheet>),
    /// Saves a library, figure, stroke or project.
    Save(SaveSheet),
    /// Exports textures and signals for other programs.
    Export(Box<ExportSheet>),
    /// Chooses the axes of the space.
    Axes(Box<AxesSheet>),
    /// Settings of the output, its actuator and the pen.
    Devices(Box<DevicesSheet>),
    /// Networks that predict attributes from photos.
    Networks(Box<NetworksSheet>),
    /// Opens a project, library, stroke, signal or model of d'.
    Open(OpenSheet),
    /// Opens an example project.
    Gallery(GallerySheet),
    /// Details of a texture.
    Texture(Box<TextureSheet>),
    /// Asks what a picture is for.
    ReliefChoice(ReliefChoice),
    /// Makes the relief of a texture from a picture.
    Relief(Box<ReliefSheet>),
    /// Keyboard shortcuts.
    Shortcuts,
    Guide(Box<GuideSheet>),
    /// Repeats the procedures of papers.
    Papers(Box<PapersSheet>),
    /// Version, licenses, and paths of files.
    About(AboutSheet),
    /// Searches for a command.
    Palette(PaletteSheet),
    /// Asks before unsaved work would be lost.
    Leaving(Leave),
    /// Asks before saving over a project file that was changed by another window or program.
    Conflict(Conflict),
    /// Asks whether a project may read a library outside its folder.
    OutsideLibrary(OutsideLibrarySheet),
    /// Offers projects that a crashed program left behind.
    Recovered(Vec<Leftover>),
}

/// Target of files dropped on a workspace with file types of its own.
#[derive(Clone, Copy)]
pub(crate) struct DropTarget {
    pub(crate) command: fn(Vec<Source>) -> Command,
    /// Whether stroke recordings are still accepted as strokes.
    pub(crate) takes_strokes: bool,
    /// Text that says what dropping does.
    pub(crate) here: &'static str,
    /// Text that says which files are accepted.
    pub(crate) kinds: &'static str,
}

impl Sheet {
    pub(crate) fn is_open(&self) -> bool {
        !matches!(self, Self::Closed)
    }

    /// Opens the import sheet, or adds the files to the one that is open.
    pub(crate) fn import(&mut self, sources: Vec<Source>, ctx: &Context) {
        if !matches!(self, Self::Import(_)) {
            *self = Self::Import(Box::new(ImportSheet::new(ctx)));
        }
        if let Self::Import(sheet) = self {
            sheet.load(sources);
        }
    }

    /// Same as [`Sheet::import`], but also estimates positions for recordings.
    pub(crate) fn import_here(&mut self, sources: Vec<Source>, ctx: &Context) {
        self.import(sources, ctx);
        if let Self::Import(sheet) = self {
            sheet.place_recordings();
        }
    }

    /// Draws the sheet over the window, and the target of files that hover over it. Returns the requested commands.
    /// Dropped files are judgments in the Build workspace and signals in the Signals workspace. Elsewhere a stroke
    /// recording is repeated. A project, and the plan of a study, are opened. A photo becomes the picture of a texture
    /// or, after a question, a prompt or a relief; several photos are prompts. Other files are imported. An open import
    /// sheet reads all files.
    pub(crate) fn show(
        &mut self,
        ctx: &Context,
        panel: &Panel<'_>,
        document: &Document,
        workspace: Workspace,
        target: Option<DropTarget>,
    ) -> Vec<Command> {
        let session = panel.session;
        let mut commands = match self {
            Self::Closed => Vec::new(),
            Self::Import(sheet) => {
                let around =
                    ImportContext { library: session.library(), space_rate_hz: session.space_rate_hz() };
                sheet.show(ctx, around)
            }
            Self::Save(sheet) => sheet.show(ctx, session.library()),
            Self::Export(sheet) => sheet.show(ctx, panel),
            Self::Devices(sheet) => sheet.show(ctx, session),
            Self::Axes(sheet) => sheet.show(ctx),
            Self::Networks(sheet) => sheet.show(ctx),
            Self::Open(sheet) => sheet.show(ctx, document.is_opening()),
            Self::Gallery(sheet) => sheet.show(ctx),
            Self::Texture(sheet) => sheet.show(ctx, panel),
            Self::ReliefChoice(choice) => choice.show(ctx),
            Self::Relief(sheet) => sheet.show(ctx),
            Self::Shortcuts => shortcuts_ui(ctx).into_iter().collect(),
            Self::Guide(sheet) => sheet.show(ctx),
            Self::Papers(sheet) => sheet.show(ctx).into_iter().collect(),
            Self::About(sheet) => sheet.show(ctx).into_iter().collect(),
            Self::Palette(sheet) => sheet.show(ctx),
            Self::Leaving(leave) => leaving_ui(ctx, *leave, &document.name(), document.is_changed()),
            Self::Conflict(conflict) => conflict_ui(ctx, conflict, &document.name()),
            Self::OutsideLibrary(sheet) => sheet.show(ctx, document.is_opening()),
            Self::Recovered(leftovers) => recovered_ui(ctx, leftovers),
        };
        let is_saving = match self {
            Self::Save(sheet) => sheet.is_saving(),
            Self::Export(sheet) => sheet.is_saving(),
            _ => false,
        };
        let is_measuring = matches!(self, Self::Devices(sheet) if sheet.is_measuring());
        if self.is_open() && !is_measuring && is_left(ctx) && !is_saving {
            commands.push(Command::CloseSheet);
        }
        if is_saving {
            // The sheet stays until the outcome has been shown.
            return commands;
        }
        let is_import = matches!(self, Self::Import(_));
        let target = target.filter(|_| !is_import && !matches!(self, Self::Relief(_)));
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        let is_project = |file: &DroppedFileHandle| {
            let path = file.path();
            (path.extension()? == EXTENSION).then(|| path.to_owned())
        };
        let are_strokes = !is_import && target.is_none_or(|target| target.takes_strokes);
        let (strokes, dropped): (Vec<_>, Vec<_>) =
            dropped.into_iter().partition(|file| are_strokes && is_stroke_file(file));
        if !strokes.is_empty() {
            let sources = strokes.into_iter().map(Source::Dropped).collect();
            commands.push(Command::Stroke(StrokeCommand::Read(sources)));
        }
        // With the details of a texture open, a photo becomes its picture; otherwise the photo is a prompt.
        let is_picture = workspace != Workspace::Author || Popup::is_any_open(ctx);
        let (photos, others): (Vec<_>, Vec<_>) =
            dropped.iter().cloned().partition(|file| is_photo(file.path()));
        let sources = |files: Vec<DroppedFileHandle>| files.into_iter().map(Source::Dropped).collect();
        if let Some(project) = dropped.iter().find_map(is_project) {
            commands.push(Command::File(FileCommand::Open(project)));
        } else if let Some(plan) = dropped.iter().find(|file| !is_import && is_study_plan(file.path())) {
            let plan = Source::Dropped(plan.clone());
            commands.push(Command::Studies(StudiesCommand::Open(vec![plan])));
        } else if dropped.is_empty() {
            // Nothing was dropped, or strokes only.
        } else if let Self::Import(sheet) = &mut *self {
            sheet.load(sources(dropped));
        } else if let (Self::Relief(sheet), Some(photo)) = (&mut *self, photos.first()) {
            sheet.read(Source::Dropped(photo.clone()), ctx);
        } else if let Some(target) = target {
            commands.push((target.command)(sources(dropped)));
        } else if let Some(photo) = photos.first().filter(|_| is_picture) {
            commands.push(Command::ReadPhoto(Source::Dropped(photo.clone())));
        } else if let ([photo], [], Self::Closed | Self::Texture(_) | Self::ReliefChoice(_)) =
            (&photos[..], &others[..], &*self)
        {
            let of = if let Self::Texture(sheet) = &*self { Some(sheet.id()) } else { None };
            let of = of.map(|id| ReliefOf::Listed(id.to_owned()));
            let ask = ReliefCommand::AskWhatFor(of, Source::Dropped(photo.clone()));
            commands.push(Command::Relief(ask));
        } else {
            if !photos.is_empty() {
                commands.push(Command::Prompt(PromptCommand::Look(sources(photos))));
            }
            if !others.is_empty() {
                commands.push(Command::ImportHere(sources(others)));
            }
        }
        if ctx.input(|i| !i.raw.hovered_files.is_empty()) {
            let (here, kinds) = target
                .map_or((strings::import::DROP_HERE, strings::import::DROP_KINDS), |target| {
                    (target.here, target.kinds)
                });
            drop_here(ctx, here, kinds);
        }
        commands
    }
}

/// Command that takes a file that is neither a project nor a library; `None` for those.
pub(crate) fn command_for(path: &Path) -> Option<Command> {
    if is_study_plan(path) {
        let source = Source::Path(path.to_owned());
        return Some(Command::Studies(StudiesCommand::Open(vec![source])));
    }
    if !is_other_kind(path) {
        return None;
    }
    let source = Source::Path(path.to_owned());
    Some(if is_photo(path) {
        Command::Relief(ReliefCommand::AskWhatFor(None, source))
    } else if is_stroke_path(path, || false) {
        Command::Stroke(StrokeCommand::Read(vec![source]))
    } else {
        Command::ImportHere(vec![source])
    })
}

/// Whether a file is a photo, from the ending of its name.
pub(crate) fn is_photo(path: &Path) -> bool {
    PHOTO_ENDINGS.contains(&ending_of(path).as_str())
}

/// Draws over the whole window which files may be dropped.
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
