//! The textures on the canvas.

use egui::epaint::RectShape;
use egui::{Color32, Popup, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};
use shagreen_core::space::SpacePoint;

use super::path_tool::{PathTool, added};
use super::points_ui::point_areas;
use super::site_labels::{Around, site_labels};
use super::slice::{Slice, is_named, opacity, size};
use super::{SITE_RADIUS, site_radius};
use crate::author::context_menu::context_menu;
use crate::author::exact::clicked;
use crate::author::locks::lock_mark;
use crate::author::texture_menu::texture_menu;
use crate::author::texture_picture::{picture_ui, place_in_words};
use crate::author::whole_space::only_in;
use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::theme::Tokens;
use crate::panel::Panel;
use crate::strings::{self, textures};

/// Side of the picture in a tooltip, in points.
const HOVER_SIDE: f32 = 96.0;
/// Radius of a texture that takes no part in the authored texture, as a fraction of that of the others.
const LEFT_OUT: f32 = 0.5;
/// Maximum number of textures shown as pictures; if there are more, each texture is a dot.
const MAX_PICTURES: usize = 60;

/// Maximum opacity of the ring around a texture.
const MOST_OF_RING: f32 = 0.8;

/// What [`sites_ui`] has drawn.
pub(super) struct DrawnSites {
    pub(super) commands: Vec<Command>,
    /// Texture under the pointer.
    pub(super) pointed: Option<usize>,
    /// Areas that pictures, names and axis labels cover.
    pub(super) covered: Vec<Rect>,
}

/// A texture with a position, and what decides how it is drawn.
#[derive(Clone, Copy, Debug)]
struct Site {
    texture: usize,
    at: SpacePoint,
    /// Rank among the contributing textures; `None` for others.
    rank: Option<usize>,
    /// Nearness to the slice that the canvas shows; 1 in a space without a slice.
    nearness: f32,
    /// Whether it takes no part in the authored texture.
    is_left_out: bool,
    /// Whether the field passes through it.
    is_pinned: bool,
}

/// Draws the textures; a click plays one alone. Far from the slice that the canvas shows, they are small and faint. Texture names
/// avoid the axis labels in `words` and the authored points that are not selected.
pub(super) fn sites_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    words: &[Rect],
    t: &Tokens,
) -> DrawnSites {
    let (mut commands, mut under_pointer) = (Vec::new(), None);
    let sites = placed_sites(panel);
    let with_pictures = sites.len() <= MAX_PICTURES;
    let radius = if with_pictures { site_radius(axes) } else { 3.0 };
    let mut pointed = None;
    let has_open_menu = Popup::is_any_open(ui.ctx());
    for site in &drawing_order(&sites) {
        let Site { texture, at, is_left_out, .. } = *site;
        let pos = axes.ui_from_space(at);
        let entry = &panel.session.textures()[texture];
        let look = Look::of(if is_left_out { LEFT_OUT * radius } else { radius }, site.nearness);
        let radius = look.radius;
        let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
        let response = ui.interact(area, ui.scope_id().with(("site", texture)), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::play_texture(&entry.name)));
        if let Some(edit) = clicked(&response, panel, texture) {
            commands.extend(if tool.is_on { added(panel, at) } else { Some(Command::Edit(edit)) });
        }
        if is_left_out {
            left_out_site(ui, pos, look, &response, t);
        } else {
            site_ui(ui, panel, site, pos, look, &response, t);
        }
        if response.hovered() {
            under_pointer = Some(texture);
        }
        if response.hovered() || response.has_focus() {
            pointed = Some(texture);
        }
        // With a thousand textures, tooltips and menus are built only where they can be needed.
        if response.hovered() || response.has_focus() || has_open_menu {
            context_menu(&response, |ui| commands.extend(texture_menu(ui, panel, texture)));
            response.on_hover_ui(|ui| site_hover_ui(ui, panel, texture, at));
        }
    }
    let named: Vec<(usize, Pos2)> = sites
        .iter()
        .filter(|site| {
            let is_shown = with_pictures && !site.is_left_out && is_named(site.nearness);
            is_shown || site.rank.is_some() || pointed == Some(site.texture)
        })
        .map(|site| (site.texture, axes.ui_from_space(site.at)))
        .collect();
    let points = point_areas(axes, panel);
    let point = points.get(panel.project.selected).copied().unwrap_or(Rect::NOTHING);
    let other_points = points.iter().enumerate().filter(|(index, _)| *index != panel.project.selected);
    let words: Vec<Rect> = words.iter().chain(other_points.map(|(_, area)| area)).copied().collect();
    let around = Around { words: &words, point };
    let mut covered = site_labels(ui, panel, &named, radius, &around, pointed, t);
    covered.extend(words);
    let disc = |site: &Site| {
        let side = 2.0 * Look::of(radius, site.nearness).radius;
        Rect::from_center_size(axes.ui_from_space(site.at), vec2(side, side))
    };
    covered.extend(sites.iter().map(disc));
    DrawnSites { commands, pointed: under_pointer, covered }
}

/// Textures with a position, in the order of the list.
fn placed_sites(panel: &Panel<'_>) -> Vec<Site> {
    let blend = panel.session.blend_in_space(&panel.inspected().blend);
    let left_out = panel.session.left_out(&blend);
    let slice = panel.session.is_sliced().then(|| Slice::of(panel));
    let site = |(texture, at): (usize, SpacePoint)| Site {
        texture,
        at,
        rank: panel.session.parent_rank(texture),
        nearness: slice.map_or(1.0, |slice| slice.nearness(at)),
        is_left_out: left_out.contains(&texture),
        is_pinned: blend.is_locked(&panel.session.textures()[texture].id),
    };
    panel.session.placed().map(site).collect()
}

/// Textures in the order in which they are drawn: contributing ones last, on top of the others, and otherwise those that are far
/// from the slice first.
fn drawing_order(sites: &[Site]) -> Vec<Site> {
    let mut sites = sites.to_vec();
    sites.sort_by(|a, b| {
        let near = || a.nearness.total_cmp(&b.nearness);
        a.rank.is_some().cmp(&b.rank.is_some()).then_with(near)
    });
    sites
}

/// Size and opacity of a texture on the canvas.
#[derive(Clone, Copy)]
struct Look {
    radius: f32,
    opacity: f32,
    /// Whether it is large enough on the slice to show its picture.
    has_picture: bool,
}

impl Look {
    /// Look of a texture with this radius on the slice and this nearness to it.
    fn of(radius: f32, nearness: f32) -> Self {
        let has_picture = radius >= SITE_RADIUS;
        Self { radius: size(nearness) * radius, opacity: opacity(nearness), has_picture }
    }
}

/// Draws the tooltip of a texture: its picture, and the text below it.
fn site_hover_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize, at: SpacePoint) {
    ui.set_max_width(ui.spacing().tooltip_width);
    let (picture, _) = ui.allocate_exact_size(vec2(HOVER_SIDE, HOVER_SIDE), Sense::hover());
    picture_ui(ui, panel, texture, picture);
    ui.label(site_help(panel, texture, at));
}

/// Text of the tooltip: the texture's name, position and source, and how the field treats it there.
fn site_help(panel: &Panel<'_>, texture: usize, at: SpacePoint) -> String {
    let name = &panel.session.textures()[texture].name;
    let mut help = format!("{name}\n{}", place_in_words(panel, texture, at));
    if let Some(only_in) = only_in(panel, texture) {
        help = format!("{help}\n{only_in}");
    }
    let blend = panel.session.blend_in_space(&panel.inspected().blend);
    if !blend.can_lock() || panel.session.left_out(&blend).contains(&texture) {
        return format!("{help}\n{}", textures::CLICK_HELP);
    }
    let is_locked = blend.is_locked(&panel.session.textures()[texture].id);
    let pinned = if is_locked { strings::LOCKED } else { strings::SMOOTHED };
    format!("{help}\n{pinned}\n{}", textures::CLICK_HELP)
}

/// Picture of a texture as a disc around `pos`, or `None` while there is none.
pub(super) fn picture_disc(panel: &Panel<'_>, texture: usize, pos: Pos2, radius: f32) -> Option<RectShape> {
    let picture = panel.pictures.thumbnail(texture)?;
    let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
    // The middle 40 % of the picture in each direction: at this size its grain remains visible.
    let uv = Rect::from_min_max(pos2(0.3, 0.3), pos2(0.7, 0.7));
    Some(RectShape::filled(area, radius, Color32::WHITE).with_texture(picture.id(), uv))
}

/// Draws a texture that takes no part in the authored texture.
fn left_out_site(ui: &Ui, pos: Pos2, look: Look, response: &Response, t: &Tokens) {
    let is_pointed = response.hovered() || response.has_focus();
    let color = if is_pointed { t.text } else { t.text_weak.gamma_multiply(look.opacity) };
    ui.painter().circle_stroke(pos, look.radius, Stroke::new(1.5, color));
}

/// Draws a texture that takes part in the authored texture, or can do so.
fn site_ui(ui: &Ui, panel: &Panel<'_>, site: &Site, pos: Pos2, look: Look, response: &Response, t: &Tokens) {
    let painter = ui.painter();
    let Look { radius, opacity, has_picture } = look;
    let disc = if has_picture { picture_disc(panel, site.texture, pos, radius) } else { None };
    match disc {
        Some(mut disc) => {
            disc.fill = disc.fill.gamma_multiply(opacity);
            painter.add(disc);
        }
        // A dot is one textured disc. Rings around a thousand dots would make up most of all drawn triangles.
        None => {
            painter.circle_filled(pos, radius, t.text_weak.gamma_multiply(opacity));
        }
    }
    let ring = match site.rank {
        Some(rank) => Some(Stroke::new(3.0, t.parents[rank.min(2)])),
        None if response.hovered() || response.has_focus() => Some(Stroke::new(2.0, t.text)),
        None => has_picture.then(|| Stroke::new(1.0, t.text_weak.gamma_multiply(opacity.min(MOST_OF_RING)))),
    };
    if let Some(ring) = ring {
        painter.circle_stroke(pos, radius, ring);
    }
    if site.is_pinned {
        let corner = pos + Vec2::angled(-std::f32::consts::FRAC_PI_4) * (radius + 2.0);
        painter.circle_filled(corner, 8.0, t.background);
        lock_mark(painter, corner, true, t.text);
    }
}

#[cfg(test)]
mod tests {
    use super::{Site, drawing_order};
    use shagreen_core::space::SpacePoint;

    #[test]
    fn contributing_and_near_textures_are_drawn_over_the_others() {
        let site = |(texture, (rank, nearness)): (usize, (Option<usize>, f32))| Site {
            texture,
            at: SpacePoint::plane(50.0, 50.0),
            rank,
            nearness,
            is_left_out: false,
            is_pinned: false,
        };
        let order = |sites: &[(Option<usize>, f32)]| -> Vec<usize> {
            let sites: Vec<Site> = sites.iter().copied().enumerate().map(site).collect();
            drawing_order(&sites).into_iter().map(|site| site.texture).collect()
        };
        let sliced = [(Some(0), 0.3), (None, 0.9), (None, 0.2), (Some(1), 0.1), (None, 0.5)];
        assert_eq!(order(&sliced), [2, 4, 1, 3, 0]);
        // Without a slice, the order of the list remains.
        assert_eq!(order(&[(None, 1.0), (Some(0), 1.0), (None, 1.0), (Some(1), 1.0)]), [0, 2, 1, 3]);
    }
}
