//! Color map of the level of a texture over speed and force.

use egui::{Align2, FontId, Mesh, Rect, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};
use shagreen_core::texture::TextureModel;
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};

use super::at_share;
use super::curves::{Curves, SIDE};
use crate::look::theme::{map_color, tokens};
use crate::strings::textures as words;

/// Space for the labels beside and below the map, in points.
const WORDS: egui::Vec2 = vec2(40.0, 16.0);
/// Maximum number of nodes drawn as dots: more would hide the map.
const MOST_DOTS: usize = 400;

/// Draws the level map and the nodes of the model; shows the values under the pointer.
pub(super) fn levels_ui(ui: &mut Ui, curves: &Curves, model: &TextureModel, height: f32) {
    let t = tokens(ui.ctx());
    let (outer, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let name = format!("{}, {}", words::LEVELS, words::levels_unit(curves.range_db));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    let area = Rect::from_min_max(
        pos2(outer.left() + WORDS.x, outer.top() + 2.0),
        pos2(outer.right() - 2.0, outer.bottom() - WORDS.y),
    );
    ui.painter().add(Shape::mesh(mesh(curves, area)));
    ui.painter().rect_stroke(area, 0.0, Stroke::new(1.0, t.line), StrokeKind::Outside);
    if model.n_nodes() <= MOST_DOTS {
        for contact in model.contacts() {
            let at = at_share(
                area,
                (contact.speed.0 / curves.highest.speed.0) as f32,
                (contact.force.0 / curves.highest.force.0) as f32,
            );
            ui.painter().circle(at, 2.5, t.text, Stroke::new(1.0, t.background));
        }
    }
    let label = |at: egui::Pos2, align: Align2, text: String| {
        ui.painter().text(at, align, text, FontId::proportional(11.5), t.text_weak);
    };
    let highest = curves.highest;
    label(area.left_bottom() + vec2(0.0, 3.0), Align2::LEFT_TOP, words::speed(0.0));
    label(area.right_bottom() + vec2(0.0, 3.0), Align2::RIGHT_TOP, words::speed(highest.speed.mm_per_s()));
    label(area.left_bottom() - vec2(5.0, 0.0), Align2::RIGHT_BOTTOM, words::force(0.0));
    label(area.left_top() - vec2(5.0, 0.0), Align2::RIGHT_TOP, words::force(highest.force.0));
    let pointed = response.hover_pos().filter(|at| area.contains(*at)).map(|at| {
        let across = f64::from((at.x - area.left()) / area.width());
        let up = f64::from((area.bottom() - at.y) / area.height());
        Contact { speed: MetersPerSecond(across * highest.speed.0), force: Newtons(up * highest.force.0) }
    });
    let help = match pointed {
        Some(at) => format!("{}\n{}", words::level_at(at, curves.level_mps2(at)), words::LEVELS_HELP),
        None => words::LEVELS_HELP.to_owned(),
    };
    response.on_hover_text_at_pointer(help);
}

/// Mesh of the map: each grid point is a vertex of its adjacent squares.
fn mesh(curves: &Curves, area: Rect) -> Mesh {
    let mut mesh = Mesh::default();
    let last = (SIDE - 1) as f32;
    for (i, level) in curves.levels.iter().enumerate() {
        let at = at_share(area, (i % SIDE) as f32 / last, (i / SIDE) as f32 / last);
        mesh.colored_vertex(at, map_color(*level));
    }
    let side = SIDE as u32;
    for row in 0..side - 1 {
        for column in 0..side - 1 {
            let corner = row * side + column;
            mesh.add_triangle(corner, corner + 1, corner + side);
            mesh.add_triangle(corner + 1, corner + side, corner + side + 1);
        }
    }
    mesh
}
