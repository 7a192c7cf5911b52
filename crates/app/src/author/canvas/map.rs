//! Map behind the canvas: choice of its quantity, image and color scale.

use std::sync::Arc;

use egui::epaint::Vertex;
use egui::{
    Color32, ComboBox, FontId, Mesh, Pos2, Rect, Role, Sense, TextureId, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::heat_map::Quantity;

use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::color_bar::color_bar;
use crate::look::list::ShowList as _;
use crate::look::theme::{Tokens, map_color};
use crate::strings::map as strings;

/// Opacity of the map.
const OPACITY: f32 = 0.62;
/// Size of the color scale, in points.
const SCALE: Vec2 = vec2(80.0, 8.0);

/// Map behind the canvas, shown or still being computed.
#[derive(Clone, Debug)]
pub struct ShownMap {
    /// Quantity that the map shows.
    pub quantity: Quantity,
    /// Image of the map; `None` until it is computed.
    pub picture: Option<TextureId>,
    /// Lowest and highest value, in the unit of the quantity.
    pub range: Option<(f64, f64)>,
    /// Outline of the region with values; `None` if the whole space has values, or those without one are transparent.
    pub outline: Option<Arc<[SpacePoint]>>,
}

/// Draws the choice of the quantity; returns the requested command.
pub(super) fn map_choice_ui(ui: &mut Ui, map: Option<&ShownMap>) -> Option<Command> {
    let shown = map.map(|map| map.quantity);
    let mut chosen = None;
    let combo = ComboBox::from_id_salt("map").width(104.0).truncate().selected_text(strings::name(shown));
    let response = combo.show_list(ui, |ui| {
        for each in std::iter::once(None).chain(Quantity::ALL.map(Some)) {
            let entry = ui.selectable_label(shown == each, strings::name(each));
            if entry.on_hover_text(strings::help(each)).clicked() {
                chosen = Some(Command::ShowMap(each));
            }
        }
    });
    response.response.accessible_name(strings::MAP).on_hover_text(strings::help(shown));
    chosen
}

/// Draws the map within its outline, or over the square of the whole space.
pub(super) fn map_ui(ui: &Ui, axes: Axes, map: &ShownMap) {
    let Some(picture) = map.picture else { return };
    let color = Color32::WHITE.gamma_multiply(OPACITY);
    let mut mesh = Mesh::with_texture(picture);
    if let Some(outline) = &map.outline {
        let mut corners: Vec<Pos2> = outline.iter().map(|point| axes.ui_from_space(*point)).collect();
        // An edge without length has no direction.
        corners.dedup_by(|a, b| a.distance(*b) < 0.1);
        let pixel = 1.0 / ui.ctx().pixels_per_point();
        add_polygon(&mut mesh, &corners, axes.whole(), pixel, color);
    } else {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        mesh.add_rect_with_uv(axes.whole(), whole, color);
    }
    ui.painter_at(axes.rect).add(mesh);
}

/// Adds a polygon that contains the segments from its center to its corners. `picture` is the rectangle of the whole
/// texture. The edge fades over `soft` points. Fewer than three corners add nothing.
fn add_polygon(mesh: &mut Mesh, corners: &[Pos2], picture: Rect, soft: f32, color: Color32) {
    /// Maximum length of the soft edge at a sharp corner, relative to its width.
    const MAX_MITER: f32 = 3.0;
    let n = corners.len();
    if n < 3 {
        return;
    }
    let corner = |i: usize| corners[i % n];
    let turn: f32 = (0..n).map(|i| corner(i).x * corner(i + 1).y - corner(i).y * corner(i + 1).x).sum();
    // Points outward from the edge after a corner.
    let normal = |i: usize| turn.signum() * (corner(i + 1) - corner(i)).normalized().rot90();
    let mut add = |pos: Pos2, color: Color32| {
        let uv = ((pos - picture.min) / picture.size()).to_pos2();
        mesh.vertices.push(Vertex { pos, uv, color });
    };
    let sum = corners.iter().fold(Vec2::ZERO, |sum, corner| sum + corner.to_vec2());
    add((sum / n as f32).to_pos2(), color);
    for (i, corner) in corners.iter().enumerate() {
        let (before, after) = (normal(i + n - 1), normal(i));
        let miter = (before + after).normalized();
        let outward = 0.5 * soft * (1.0 / miter.dot(after).max(1.0 / MAX_MITER)) * miter;
        add(*corner - outward, color);
        add(*corner + outward, Color32::TRANSPARENT);
    }
    for i in 0..n {
        let [inner, outer] = [1, 2].map(|k| (2 * i + k) as u32);
        let [next_inner, next_outer] = [1, 2].map(|k| (2 * ((i + 1) % n) + k) as u32);
        mesh.add_triangle(0, inner, next_inner);
        mesh.add_triangle(inner, outer, next_outer);
        mesh.add_triangle(inner, next_outer, next_inner);
    }
}

/// Color of the map on the canvas at a share of its range, 0 to 1: the canvas below it is visible.
fn shown_color(share: f32, t: &Tokens) -> Color32 {
    t.background.blend(map_color(share).gamma_multiply(OPACITY))
}

/// Draws the color scale between the lowest and the highest value.
pub(super) fn scale_ui(ui: &mut Ui, map: &ShownMap, t: &Tokens) {
    let (low, high) = match map.range {
        Some((low, high)) => (strings::value(map.quantity, low), strings::value(map.quantity, high)),
        None if map.picture.is_some() => (strings::NO_VALUES.to_owned(), String::new()),
        None => (strings::WAITING.to_owned(), String::new()),
    };
    let font = FontId::proportional(11.5);
    let [low_text, high_text] =
        [&low, &high].map(|text| ui.painter().layout_no_wrap(text.clone(), font.clone(), t.text_weak));
    let width = low_text.size().x + SCALE.x + high_text.size().x + 10.0;
    let (area, response) = ui.allocate_exact_size(vec2(width, ui.spacing().interact_size.y), Sense::hover());
    let title = strings::name(Some(map.quantity));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::scale(title, &low, &high)));
    let line = area.center().y;
    let left = area.left() + low_text.size().x + 5.0;
    ui.painter().galley(pos2(area.left(), line - 0.5 * low_text.size().y), low_text, t.text_weak);
    let bar = Rect::from_min_size(pos2(left, line - 0.5 * SCALE.y), SCALE);
    ui.painter().add(color_bar(bar, |share| shown_color(share, t)));
    let corner = pos2(left + SCALE.x + 5.0, line - 0.5 * high_text.size().y);
    ui.painter().galley(corner, high_text, t.text_weak);
    let help = strings::help(Some(map.quantity));
    let has_no_values = map.picture.is_some() && map.range.is_none();
    response.on_hover_text(if has_no_values {
        format!("{help}. {}", strings::NO_VALUES_HELP)
    } else {
        help.to_owned()
    });
}

#[cfg(test)]
mod tests {
    use super::{OPACITY, add_polygon, shown_color};
    use crate::look::theme::{DARK, LIGHT, map_color};
    use egui::{Color32, Mesh, Pos2, Rect, pos2};

    /// Area of all triangles whose corners have a color, and of all triangles.
    fn areas(mesh: &Mesh) -> [f32; 2] {
        let mut areas = [0.0; 2];
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|i| mesh.vertices[i as usize]);
            let (u, v) = (b.pos - a.pos, c.pos - a.pos);
            let area = 0.5 * (u.x * v.y - u.y * v.x).abs();
            areas[1] += area;
            if [a, b, c].iter().all(|vertex| vertex.color != Color32::TRANSPARENT) {
                areas[0] += area;
            }
        }
        areas
    }

    /// The scale has the colors that the translucent map has on the canvas.
    #[test]
    fn the_scale_has_the_colors_of_the_map() {
        for (t, share) in [(&DARK, 0.0), (&DARK, 1.0), (&LIGHT, 0.3), (&LIGHT, 1.0)] {
            let (map, canvas) = (map_color(share).to_array(), t.background.to_array());
            let shown = shown_color(share, t).to_array();
            for channel in 0..3 {
                let [map, canvas] = [map, canvas].map(|color| f32::from(color[channel]));
                let expected = OPACITY * map + (1.0 - OPACITY) * canvas;
                // Each of the two steps rounds to a whole number.
                assert!((f32::from(shown[channel]) - expected).abs() <= 2.0, "{shown:?}, {expected}");
            }
            assert_eq!(shown[3], 255);
        }
    }

    /// The polygon is filled up to half a pixel inside its edge and fades until half a pixel outside, whichever way its
    /// corners are listed.
    #[test]
    fn the_edge_of_a_map_is_one_pixel_wide() {
        let square = [pos2(10.0, 10.0), pos2(110.0, 10.0), pos2(110.0, 60.0), pos2(10.0, 60.0)];
        let backward = [square[3], square[2], square[1], square[0]];
        let picture = Rect::from_min_max(pos2(0.0, 0.0), pos2(200.0, 100.0));
        for corners in [square, backward] {
            let mut mesh = Mesh::default();
            add_polygon(&mut mesh, &corners, picture, 1.0, Color32::WHITE);
            let [filled, all] = areas(&mesh);
            assert!((filled - 99.0 * 49.0).abs() < 1.0 && (all - 101.0 * 51.0).abs() < 1.0, "{filled} {all}");
            for vertex in &mesh.vertices {
                let expected = pos2(vertex.pos.x / 200.0, vertex.pos.y / 100.0);
                assert!(vertex.uv.distance(expected) < 1e-6);
            }
        }
        let mut mesh = Mesh::default();
        let line: [Pos2; 2] = [square[0], square[1]];
        add_polygon(&mut mesh, &line, picture, 1.0, Color32::WHITE);
        assert!(mesh.is_empty());
    }
}
