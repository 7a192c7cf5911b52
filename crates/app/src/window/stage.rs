//! Stage: the lower row of a page, with the stroke pad and the scope.

use egui::{Panel as Side, Ui};

use super::Window;
use crate::author::pad::{PadState, pad_ui};
use crate::author::scope::{ScopeState, scope_ui};
use crate::command::Command;
use crate::look::theme::{PAD_WIDTH, STAGE_HEIGHTS, STAGE_SHARE};
use crate::panel::Panel;
use crate::state::photo::OwnPicture;

/// Maximum number of pictures that are blended for the pad. More take longer without a visible difference.
const MAX_PICTURED: usize = 6;

/// View state of the stage.
#[derive(Default)]
pub(super) struct Stage {
    pub(super) pad: PadState,
    pub(super) scope: ScopeState,
    own_picture: OwnPicture,
}

impl Window {
    /// Draws the lower row with pad and scope.
    pub(super) fn stage_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let parents = self.session.authored().map_or(&[][..], |authored| &authored.parents);
        let parents = pictured(parents);
        let blended = if parents.is_empty() { None } else { self.pictures.blend(ctx, &parents) };
        let blended = blended.map(|(texture, mm)| (texture.id(), [mm, mm]));
        let is_felt = self.session.felt_name().is_some();
        let heard = self.heard_texture().filter(|_| !self.compare.is_hidden() && !is_felt);
        let own = heard.and_then(|texture| texture.picture.clone());
        let own =
            self.pages.stage.own_picture.follow(own.as_ref(), ctx).map(|(texture, mm)| (texture.id(), mm));
        let picture = own.or(blended);
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let (pad, scope, place) =
            (&mut self.pages.stage.pad, &mut self.pages.stage.scope, &mut self.tour.places[1]);
        let mut mouse = None;
        let stage_height =
            (STAGE_SHARE * ctx.content_rect().height()).clamp(*STAGE_HEIGHTS.start(), *STAGE_HEIGHTS.end());
        Side::bottom("stage").exact_size(stage_height).resizable(false).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let (width, height) = (ui.available_width(), ui.available_height());
                let top_down = egui::Layout::top_down(egui::Align::Min);
                let pad_width = (0.36 * width).max(PAD_WIDTH.min(0.5 * width));
                ui.allocate_ui_with_layout(egui::vec2(pad_width, height), top_down, |ui| {
                    *place = ui.max_rect();
                    let outcome = pad_ui(ui, &panel, pad, picture);
                    commands.extend(outcome.commands);
                    mouse = outcome.mouse;
                });
                ui.allocate_ui_with_layout(ui.available_size(), top_down, |ui| {
                    commands.extend(scope_ui(ui, &panel, scope));
                });
            });
        });
        if let Some(report) = mouse {
            self.session.mouse(report, self.pages.stage.pad.hand.force_n);
        }
        if self.session.hand_is_running() {
            self.session.set_hand(Some(self.pages.stage.pad.input()));
        }
    }
}

/// Textures with the largest weights, and their weights normalized to a sum of one, for the blended picture.
fn pictured(parents: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let largest = &parents[..parents.len().min(MAX_PICTURED)];
    let sum: f64 = largest.iter().map(|(_, weight)| weight.max(0.0)).sum();
    let share = |(texture, weight): &(usize, f64)| (*texture, weight.max(0.0) / sum);
    largest.iter().map(share).filter(|(_, share)| *share > 0.0).collect()
}
