//! Stage: the lower row of a page, with the stroke pad and the scope.

use std::sync::Arc;

use egui::{Panel as Side, Rect, Ui};
use shagreen_core::space::authoring::Voice;
use shagreen_core::units::Radians;
use shagreen_device::touch::Touch;
use shagreen_formats::picture::Picture;

use super::Window;
use crate::author::pad::{PadPicture, PadState, pad_ui};
use crate::author::scope::{ScopeState, scope_ui};
use crate::command::Command;
use crate::look::theme::{LARGEST_STAGE_SHARE, LEAST_STAGE_HEIGHT, PAD_WIDTH, STAGE_HEIGHTS, STAGE_SHARE};
use crate::panel::Panel;
use crate::session::Session;
use crate::state::own_surface::{OwnSurface, SurfacePicture};
use crate::state::pad_surface::{N_LIGHTS, USUAL_LIGHT};
use crate::workspace::Workspace;

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
    /// Picture of the audible texture of the list that is felt where the picture shows it.
    felt: Option<Arc<Picture>>,
    /// Area in the last frame.
    pub(super) area: Option<Rect>,
}

impl Window {
    /// Draws the lower row with pad and scope.
    pub(super) fn stage_ui(&mut self, ui: &mut Ui, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let parents = pictured(self.session.parents());
        let is_bare = has_no_picture(&self.session);
        let turn = self.session.turn();
        let light = light_of(self.session.touch(), turn);
        let blended = if parents.is_empty() { None } else { self.pictures.blend(ctx, &parents, light) };
        let plays_signal = self.session.felt_name().is_some();
        let heard = self.heard_texture().or_else(|| self.simulated_texture());
        let own = heard.filter(|_| !self.compare.is_hidden() && !plays_signal);
        let own = own.and_then(|texture| texture.picture.clone());
        let felt = felt_picture(&self.session);
        let felt = felt.filter(|(picture, _)| own.as_deref().is_none_or(|own| own == *picture));
        let picture = own.or_else(|| shared(&mut self.pages.stage.felt, felt.map(|(picture, _)| picture)));
        // A picture that is not felt in place grows with the grain of the texture.
        let grain = self.session.authored().map_or(1.0, |authored| authored.shape.grain);
        let (scale, is_felt) = (felt.map_or(grain, |(_, scale)| scale), felt.is_some());
        let own = picture.map(|picture| SurfacePicture { picture, is_felt });
        let own = self.pages.stage.own_surface.follow(own, ctx, light).map(|(texture, size_mm)| {
            let size_mm = size_mm.map(|side_mm| scale * side_mm);
            PadPicture { texture, size_mm, is_felt, turn }
        });
        let blended = blended.map(|(texture, size_mm)| {
            let size_mm = size_mm.map(|side_mm| grain * side_mm);
            PadPicture { texture, size_mm, is_felt: false, turn }
        });
        // The blended picture is kept from the last texture with a picture.
        let picture = own.or(blended.filter(|_| !is_bare));
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let (pad, scope, place) =
            (&mut self.pages.stage.pad, &mut self.pages.stage.scope, &mut self.tour.places[1]);
        let mut mouse = None;
        let window_height = ctx.content_rect().height();
        let usual = (STAGE_SHARE * window_height).clamp(*STAGE_HEIGHTS.start(), *STAGE_HEIGHTS.end());
        let is_author = self.pages.workspace == Workspace::Author;
        let largest = (LARGEST_STAGE_SHARE * window_height).max(usual);
        let chosen = self.files.settings.panels.stage.filter(|_| is_author);
        let stage_height = chosen.map_or(usual, |height| height.clamp(LEAST_STAGE_HEIGHT, largest));
        let shown = Side::bottom("stage").exact_size(stage_height).resizable(false).show(ui, |ui| {
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
        self.pages.stage.area = Some(shown.response.rect);
        if let Some(report) = mouse {
            self.session.mouse(report, self.pages.stage.pad.hand.force_n);
        }
        if self.session.hand_is_running() {
            self.session.set_hand(Some(self.pages.stage.pad.input()));
        }
    }
}

/// Whether the only audible texture of the list has no picture.
fn has_no_picture(session: &Session) -> bool {
    let [(texture, _)] = session.parents()[..] else { return false };
    session.textures().get(texture).is_some_and(|entry| entry.picture.is_none())
}

/// Picture of the only audible texture of the list, if its height map covers the picture, and how many times as wide as the
/// picture it is felt.
fn felt_picture(session: &Session) -> Option<(&Picture, f64)> {
    let authored = session.authored()?;
    let [(texture, _)] = authored.parents[..] else { return None };
    let entry = session.textures().get(texture)?;
    let (map, picture) = (entry.model.height_map()?, entry.picture.as_ref()?);
    let side_mm = 1e3 * map.side_m();
    if (side_mm - picture.millimeters).abs() >= SAME * side_mm {
        return None;
    }
    let scale = match authored.voices()[..] {
        // An interpolated texture has the shape of the result; a texture of the list gets it when it plays.
        [(Voice::Made(model), _)] => model.height_map()?.side_m() / map.side_m(),
        _ => map.stretched_side_m(authored.shape.grain) / map.side_m(),
    };
    Some((picture, scale))
}

/// A shared copy of a picture: the kept one if it is the same.
fn shared(kept: &mut Option<Arc<Picture>>, picture: Option<&Picture>) -> Option<Arc<Picture>> {
    if kept.as_deref() != picture {
        *kept = picture.map(|picture| Arc::new(picture.clone()));
    }
    kept.clone()
}

/// Textures with the largest weights, and their weights normalized to a sum of one, for the blended picture.
fn pictured(parents: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let largest = &parents[..parents.len().min(MAX_PICTURED)];
    let sum: f64 = largest.iter().map(|(_, weight)| weight.max(0.0)).sum();
    let share = |(texture, weight): &(usize, f64)| (*texture, weight.max(0.0) / sum);
    largest.iter().map(share).filter(|(_, share)| *share > 0.0).collect()
}

/// Direction of the light in the picture on the pad, which is turned: while the tip touches, it moves with the tip, which shows
/// the relief.
fn light_of(touch: Touch, turn: Radians) -> u8 {
    let is_at_rest = touch.contact.force_n <= 0.0 || touch.x_m.hypot(touch.y_m) < LIGHT_FROM_M;
    let on_pad = if is_at_rest {
        f32::from(USUAL_LIGHT) / f32::from(N_LIGHTS)
    } else {
        touch.y_m.atan2(touch.x_m) / std::f32::consts::TAU
    };
    let in_picture = on_pad - (turn.0 / std::f64::consts::TAU) as f32;
    ((in_picture.rem_euclid(1.0) * f32::from(N_LIGHTS)) as u8).min(N_LIGHTS - 1)
}
