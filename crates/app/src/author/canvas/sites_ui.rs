//! The textures on the canvas.

use egui::epaint::RectShape;
use egui::{Color32, Popup, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};
use shagreen_core::space::SpacePoint;

use super::path_tool::{PathTool, added};
use super::site_labels::{Around, site_labels};
use super::{POINT_SIZE, SITE_RADIUS, site_radius};
use crate::author::context_menu::{context_menu, had_open_menu};
use crate::author::exact::taken;
use crate::author::locks::lock_mark;
use crate::author::texture_menu::texture_menu;
use crate::author::texture_picture::place_in_words;
use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::theme::Tokens;
use crate::panel::Panel;
use crate::strings::{self};

/// Maximum number of textures shown as pictures; if there are more, each texture is a dot.
const MAX_PICTURES: usize = 60;

/// Draws the textures; a click chooses one. Returns the commands, and the texture under the pointer. Texture names avoid
/// the axis labels in `words`.
pub(super) fn sites_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    words: &[Rect],
    on_map: bool,
    t: &Tokens,
) -> (Vec<Command>, Option<usize>) {
    let (mut commands, mut under_pointer) = (Vec::new(), None);
    let sites = panel.session.space().sites();
    let with_pictures = sites.len() <= MAX_PICTURES;
    let radius = if with_pictures { site_radius(axes) } else { 3.0 };
    // Contributing textures are drawn last, on top of the others.
    let rank = |texture: usize| panel.session.parent_rank(texture);
    let mut order: Vec<&(usize, SpacePoint)> = sites.iter().collect();
    order.sort_by_key(|(texture, _)| rank(*texture).is_some());
    let mut pointed = None;
    let has_open_menu = Popup::is_any_open(ui.ctx());
    for (texture, at) in order {
        let pos = axes.ui_from_space(*at);
        let entry = &panel.session.textures()[*texture];
        let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
        let response = ui.interact(area, ui.scope_id().with(("site", texture)), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::go_to(&entry.name)));
        if response.clicked() && !had_open_menu(ui.ctx()) {
            let chosen = || taken(panel, *texture).map(Command::Edit);
            commands.extend(if tool.is_on { added(panel, *at) } else { chosen() });
        }
        site(ui, panel, *texture, pos, radius, &response, t);
        if response.hovered() {
            under_pointer = Some(*texture);
        }
        if response.hovered() || response.has_focus() {
            pointed = Some(*texture);
        }
        // With a thousand textures, tooltips and menus are built only where they can be needed.
        if response.hovered() || response.has_focus() || has_open_menu {
            context_menu(&response, |ui| commands.extend(texture_menu(ui, panel, *texture)));
            response.on_hover_text(site_help(panel, *texture, *at));
        }
    }
    let named: Vec<(usize, Pos2)> = sites
        .iter()
        .filter(|(texture, _)| with_pictures || rank(*texture).is_some() || pointed == Some(*texture))
        .map(|(texture, at)| (*texture, axes.ui_from_space(*at)))
        .collect();
    let point = Rect::from_center_size(axes.ui_from_space(panel.project.texture().at), POINT_SIZE);
    site_labels(ui, panel, &named, radius, &Around { words, point, on_map }, pointed, t);
    (commands, under_pointer)
}

/// Tooltip of a texture: its name, position and source, and how the field treats it there.
fn site_help(panel: &Panel<'_>, texture: usize, at: SpacePoint) -> String {
    let name = &panel.session.textures()[texture].name;
    let help = format!("{name}\n{}", place_in_words(panel, texture, at));
    if !panel.project.texture().blend.can_lock() {
        return help;
    }
    let is_locked = panel.is_locked(texture);
    format!("{help}\n{}", if is_locked { strings::LOCKED } else { strings::SMOOTHED })
}

/// Picture of a texture as a disc around `pos`, or `None` while there is none.
pub(super) fn picture_disc(panel: &Panel<'_>, texture: usize, pos: Pos2, radius: f32) -> Option<RectShape> {
    let picture = panel.pictures.thumbnail(texture)?;
    let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
    // The middle 40 % of the picture in each direction: at this size its grain remains visible.
    let uv = Rect::from_min_max(pos2(0.3, 0.3), pos2(0.7, 0.7));
    Some(RectShape::filled(area, radius, Color32::WHITE).with_texture(picture.id(), uv))
}

fn site(ui: &Ui, panel: &Panel<'_>, texture: usize, pos: Pos2, radius: f32, response: &Response, t: &Tokens) {
    let painter = ui.painter();
    let rank = panel.session.parent_rank(texture);
    let has_picture = radius >= SITE_RADIUS;
    let disc = if has_picture { picture_disc(panel, texture, pos, radius) } else { None };
    match disc {
        Some(disc) => {
            painter.add(disc);
        }
        // A dot is one textured disc. Rings around a thousand dots would make up most of all drawn triangles.
        None => {
            painter.circle_filled(pos, radius, t.text_weak);
        }
    }
    let ring = match rank {
        Some(rank) => Some(Stroke::new(3.0, t.parents[rank.min(2)])),
        None if response.hovered() || response.has_focus() => Some(Stroke::new(2.0, t.text)),
        None => has_picture.then(|| Stroke::new(1.0, t.text_weak.gamma_multiply(0.8))),
    };
    if let Some(ring) = ring {
        painter.circle_stroke(pos, radius, ring);
    }
    if panel.is_locked(texture) {
        let corner = pos + Vec2::angled(-std::f32::consts::FRAC_PI_4) * (radius + 2.0);
        painter.circle_filled(corner, 8.0, t.background);
        lock_mark(painter, corner, true, t.text);
    }
}
