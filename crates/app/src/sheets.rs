//! What lies over the window: the sheet that is open, and where dropped files go.

use egui::{Align2, Context, FontId, Id, LayerId, Order, Stroke, StrokeKind};

use crate::command::Command;
use crate::devices::DevicesSheet;
use crate::import::sheet::{ImportSheet, Surroundings};
use crate::import::source::Source;
use crate::save::SaveSheet;
use crate::session::Session;
use crate::strings;
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

    /// Draws the sheet over the window, and where files would go that hover over it; returns what the user asked for.
    /// Files dropped on the workspace Build are judgments, others are imported.
    pub(crate) fn show(&mut self, ctx: &Context, session: &Session, workspace: Workspace) -> Vec<Command> {
        let mut commands = match self {
            Self::Closed => Vec::new(),
            Self::Import(sheet) => {
                let around =
                    Surroundings { library: session.library(), space_rate_hz: session.space_rate_hz() };
                sheet.show(ctx, around)
            }
            Self::Save(sheet) => sheet.show(ctx, session.library()),
            Self::Devices(sheet) => sheet.show(ctx, session),
        };
        if matches!(self, Self::Save(sheet) if sheet.is_saving()) {
            // It stays until its outcome has been shown.
            return commands;
        }
        let are_judgments = workspace == Workspace::Build && !matches!(self, Self::Import(_));
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        if !dropped.is_empty() {
            let sources = dropped.into_iter().map(Source::Dropped).collect();
            commands.push(if are_judgments {
                Command::ReadJudgments(sources)
            } else {
                Command::Import(sources)
            });
        }
        if ctx.input(|i| !i.raw.hovered_files.is_empty()) {
            let (here, kinds) = if are_judgments {
                (strings::build::DROP_HERE, strings::build::DROP_KINDS)
            } else {
                (strings::import::DROP_HERE, strings::import::DROP_KINDS)
            };
            drop_here(ctx, here, kinds);
        }
        commands
    }
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
