//! Author page: the canvas between the texture list and the inspector, above the stage.

use std::ops::RangeInclusive;

use egui::{CentralPanel, Frame, Margin, Panel as Side, Ui};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::heat_map::Quantity;
use shagreen_formats::settings::PanelSizes;

use super::Window;
use crate::author::canvas::{CanvasState, ShownMap, canvas_ui};
use crate::author::inspector::inspector_ui;
use crate::author::library_panel::{LibraryState, library_ui};
use crate::author::prompt::bar_ui::bar_ui;
use crate::author::prompt::card_ui::{CardPlace, card_ui};
use crate::command::Command;
use crate::look::border::{Edge, border_ui};
use crate::look::theme::{
    INSPECTOR_WIDTH, INSPECTOR_WIDTHS, LEAST_MAP_WIDTH, LIBRARY_WIDTH, LIBRARY_WIDTHS, map_color, tokens,
};
use crate::panel::Panel;
use crate::state::heat_map::{Grid, HeatMap, Wanted};
use crate::state::photo::OwnPicture;

/// View state of the Author page.
#[derive(Default)]
pub(super) struct AuthorPage {
    pub(super) canvas: CanvasState,
    pub(super) library: LibraryState,
    heat: HeatMap,
    /// Quantity of the heat map, if one is shown.
    pub(super) map: Option<Quantity>,
    /// Key of the authored texture whose export waits for its models.
    pub(super) to_export: Option<u32>,
    guess_picture: OwnPicture,
    card: CardPlace,
}

/// Widths of the texture list and of the inspector, in points, in a window that leaves `room` to them and the map.
fn widths(chosen: PanelSizes, room: f32) -> [f32; 2] {
    let within = |width: f32, range: RangeInclusive<f32>| width.clamp(*range.start(), *range.end());
    let library = chosen.library.map_or(LIBRARY_WIDTH, |width| within(width, LIBRARY_WIDTHS));
    let inspector = chosen.inspector.map_or(INSPECTOR_WIDTH, |width| within(width, INSPECTOR_WIDTHS));
    let library = library.min((room - LEAST_MAP_WIDTH - INSPECTOR_WIDTH).max(LIBRARY_WIDTH));
    [library, inspector.min((room - LEAST_MAP_WIDTH - library).max(INSPECTOR_WIDTH))]
}

impl Window {
    /// Draws the Author workspace.
    pub(super) fn author_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let map = self.follow_map(ctx);
        self.stage_ui(ui, ctx, commands);
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let [library_width, inspector_width] = widths(self.files.settings.panels, ui.available_width());
        let library = &mut self.pages.author.library;
        let library = Side::left("library").exact_size(library_width).resizable(false).show(ui, |ui| {
            commands.extend(library_ui(ui, &panel, library));
        });
        let inspector =
            Side::right("inspector").exact_size(inspector_width).resizable(false).show(ui, |ui| {
                self.tour.places[2] = ui.max_rect();
                commands.extend(inspector_ui(ui, &panel));
            });
        let frame = Frame::new().fill(tokens(ctx).panel).inner_margin(Margin::same(6));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            commands.extend(bar_ui(ui, &mut self.prompts, &self.files.settings.prompts));
            // An estimate on other axes is shown again when undo brings these back.
            let axes = self.session.axes();
            let guess = self.prompts.guess_of(self.project.texture()).filter(|guess| guess.names == axes);
            let area = ui.available_rect_before_wrap();
            self.tour.places[0] = area;
            let AuthorPage { canvas, card, guess_picture, .. } = &mut self.pages.author;
            commands.extend(canvas_ui(ui, &panel, canvas, map.as_ref(), guess));
            if let Some(guess) = guess {
                let picture = guess_picture.follow(Some(&guess.picture), ctx).map(|(picture, _)| picture);
                let is_busy = self.prompts.is_busy();
                commands.extend(card_ui(ui, area, card, &panel, guess, is_busy, picture));
            }
            card.block(ui);
        });
        let (library, inspector) = (library.response.rect, inspector.response.rect);
        let sizes = &mut self.files.settings.panels;
        border_ui(ui, "library", library, Edge::Right, &mut sizes.library);
        border_ui(ui, "inspector", inspector, Edge::Left, &mut sizes.inspector);
        if let Some(stage) = self.pages.stage.area {
            border_ui(ui, "stage", stage, Edge::Top, &mut sizes.stage);
        }
    }

    /// Heat map behind the canvas, as far as it is computed.
    fn follow_map(&mut self, ctx: &egui::Context) -> Option<ShownMap> {
        let session = &self.session;
        let contact = self.pages.stage.pad.contact(session);
        let texture = self.project.texture();
        let slice = Panel::new(&self.project, session, &self.compare, &self.pictures).slice_point();
        let wanted = self.pages.author.map.map(|quantity| Wanted {
            quantity,
            blending: session.blending(&texture.blend),
            contact,
            slice: slice.on_canvas_at(SpacePoint::default()),
            generation: session.generation_of(texture),
        });
        self.pages.author.heat.follow(
            wanted,
            || (session.authoring_of(texture).into_owned(), session.planes().to_vec()),
            ctx,
        );
        let quantity = self.pages.author.map?;
        let grid = self.pages.author.heat.grid();
        let (range, outline) = (grid.and_then(Grid::range), grid.and_then(|grid| grid.outline.clone()));
        Some(ShownMap {
            quantity,
            picture: self.pages.author.heat.picture(ctx, map_color).map(egui::TextureHandle::id),
            range,
            outline,
        })
    }
}
