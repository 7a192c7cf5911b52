//! Stage: the lower row of a page, with the stroke pad and the scope.

use egui::{Panel as Side, Ui};
use shagreen_core::texture::shape::Shape;
use shagreen_device::touch::Touch;
use shagreen_formats::picture::Picture;

use super::Window;
use crate::author::pad::{PadPicture, PadState, pad_ui};
use crate::author::scope::{ScopeState, scope_ui};
use crate::command::Command;
use crate::look::theme::{PAD_WIDTH, STAGE_HEIGHTS, STAGE_SHARE};
use crate::panel::Panel;
use crate::session::Session;
use crate::state::own_surface::{OwnSurface, SurfacePicture};
use crate::state::pad_surface::{N_LIGHTS, USUAL_LIGHT};

/// Distance from the middle of the pad within which the tip does not move the light, in m.
const LIGHT_FROM_M: f32 = 0.004;
/// Relative difference up to which a picture and a height map have the same width.
const SAME: f64 = 1e-3;
/// Maximum number of pictures that are blended for the pad. More take longer without a visible difference.
const MAX_PICTURED: usize = 6;

/// View state of the stage.
#[derive(Default)]
pub(super) struct Stage {
    pub(super) pad: PadState,
    pub(super) scope: ScopeState,
    own_surface: OwnSurface,
}

impl Window {
    /// Draws the lower row with pad and scope.
    pub(super) fn stage_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let parents = self.session.authored().map_or(&[][..], |authored| &authored.parents);
        let parents = pictured(parents);
        let light = light_of(self.session.touch());
        let blended = if parents.is_empty() { None } else { self.pictures.blend(ctx, &parents, light) };
        let plays_signal = self.session.felt_name().is_some();
        let heard = self.heard_texture().or_else(|| self.simulated_texture());
        let own = heard.filter(|_| !self.compare.is_hidden() && !plays_signal);
        let own = own.and_then(|texture| texture.picture.clone()).map(|picture| {
            let is_felt = felt_picture(&self.session) == Some(&*picture);
            SurfacePicture { picture, is_felt }
        });
        let is_felt = own.as_ref().is_some_and(|own| own.is_felt);
        let own = self.pages.stage.own_surface.follow(own, ctx, light);
        let own = own.map(|(texture, size_mm)| PadPicture { texture, size_mm, is_felt });
        let blended = blended.map(|(texture, size_mm)| PadPicture { texture, size_mm, is_felt: false });
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

/// Picture of the only audible texture of the list, if its height map is felt where the picture shows it: neither turned nor
/// stretched.
fn felt_picture(session: &Session) -> Option<&Picture> {
    let authored = session.authored()?;
    let [(texture, _)] = authored.parents[..] else { return None };
    let entry = session.textures().get(texture)?;
    // An interpolated texture has the shape of the result; a texture of the list gets it when it plays.
    let (model, shape) = match &authored.model {
        Some(model) => (model, Shape::default()),
        None => (&entry.model, authored.shape),
    };
    let (map, picture) = (model.height_map()?, entry.picture.as_ref()?);
    let side_mm = 1e3 * map.side_m() * shape.grain;
    let is_turned = model.turn_rad() != 0.0 || shape.direction_deg != 0.0;
    (!is_turned && (side_mm - picture.millimeters).abs() < SAME * side_mm).then_some(picture)
}

/// Textures with the largest weights, and their weights normalized to a sum of one, for the blended picture.
fn pictured(parents: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let largest = &parents[..parents.len().min(MAX_PICTURED)];
    let sum: f64 = largest.iter().map(|(_, weight)| weight.max(0.0)).sum();
    let share = |(texture, weight): &(usize, f64)| (*texture, weight.max(0.0) / sum);
    largest.iter().map(share).filter(|(_, share)| *share > 0.0).collect()
}

/// Direction of the light on the pad: while the tip touches, it moves with the tip, which shows the relief.
fn light_of(touch: Touch) -> u8 {
    let is_at_rest = touch.contact.force_n <= 0.0 || touch.x_m.hypot(touch.y_m) < LIGHT_FROM_M;
    if is_at_rest {
        return USUAL_LIGHT;
    }
    let turns = touch.y_m.atan2(touch.x_m) / std::f32::consts::TAU;
    ((turns.rem_euclid(1.0) * f32::from(N_LIGHTS)) as u8).min(N_LIGHTS - 1)
}
