//! Author page: the canvas between the texture list and the inspector, above the stage.

use egui::{CentralPanel, Frame, Margin, Panel as Side, Ui};
use shagreen_core::space::heat_map::Quantity;

use super::Window;
use crate::author::canvas::{CanvasState, ShownMap, canvas_ui};
use crate::author::inspector::inspector_ui;
use crate::author::library_panel::{LibraryState, library_ui};
use crate::author::prompt::bar_ui::bar_ui;
use crate::author::prompt::card_ui::card_ui;
use crate::command::Command;
use crate::look::theme::{INSPECTOR_WIDTH, LIBRARY_WIDTH, map_color, tokens};
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
    guess_picture: OwnPicture,
}

impl Window {
    /// Draws the Author workspace.
    pub(super) fn author_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let map = self.follow_map(ctx);
        self.stage_ui(ui, ctx, commands);
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let library = &mut self.pages.author.library;
        Side::left("library").exact_size(LIBRARY_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(library_ui(ui, &panel, library));
        });
        Side::right("inspector").exact_size(INSPECTOR_WIDTH).resizable(false).show(ui, |ui| {
            self.tour.places[2] = ui.max_rect();
            commands.extend(inspector_ui(ui, &panel));
        });
        let frame = Frame::new().fill(tokens(ctx).panel).inner_margin(Margin::same(6));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            commands.extend(bar_ui(ui, &mut self.prompts, &self.files.settings.prompts));
            let guess = self.prompts.guess_of(self.project.texture());
            if let Some(guess) = guess {
                let picture = self
                    .pages
                    .author
                    .guess_picture
                    .follow(Some(&guess.picture), ctx)
                    .map(|(picture, _)| picture);
                commands.extend(card_ui(ui, &panel, guess, self.prompts.is_busy(), picture));
            }
            self.tour.places[0] = ui.available_rect_before_wrap();
            commands.extend(canvas_ui(ui, &panel, &mut self.pages.author.canvas, map.as_ref(), guess));
        });
    }

    /// Heat map behind the canvas, as far as it is computed.
    fn follow_map(&mut self, ctx: &egui::Context) -> Option<ShownMap> {
        let session = &self.session;
        let contact = self.pages.stage.pad.contact(session);
        let wanted = self.pages.author.map.map(|quantity| Wanted {
            quantity,
            blending: session.blending(&self.project.texture().blend),
            contact,
            generation: session.generation(),
        });
        self.pages.author.heat.follow(
            wanted,
            || (session.authoring().clone(), session.planes().to_vec()),
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
