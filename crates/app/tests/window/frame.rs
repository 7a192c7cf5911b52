//! Shapes and texts of the last frame, in painting order.

use egui::emath::Rot2;
use egui::epaint::TextShape;
use egui::{Rect, Shape};
use egui_kittest::Harness;

/// A shape of a frame, and its visible part.
#[derive(Clone, Copy)]
pub(crate) struct Painted<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) clip: Rect,
}

/// All shapes of the last frame. Later ones cover earlier ones.
pub(crate) fn painted<'a, State>(harness: &'a Harness<'_, State>) -> Vec<Painted<'a>> {
    let window = harness.ctx.content_rect();
    let mut found = Vec::new();
    for clipped in &harness.output().shapes {
        flatten(&clipped.shape, clipped.clip_rect.intersect(window), &mut found);
    }
    found
}

fn flatten<'a>(shape: &'a Shape, clip: Rect, found: &mut Vec<Painted<'a>>) {
    match shape {
        Shape::Noop => {}
        Shape::Vec(parts) => {
            for part in parts {
                flatten(part, clip, found);
            }
        }
        shape => found.push(Painted { shape, clip }),
    }
}

/// Areas of the letters in each row of a text, without empty rows. The rows are separate, because the first row of a
/// wrapped paragraph may begin far to the right.
pub(crate) fn rows(text: &TextShape) -> Vec<Rect> {
    let turn = Rot2::from_angle(text.angle);
    let letters = text.galley.rows.iter().map(|row| row.row.visuals.mesh_bounds.translate(row.pos.to_vec2()));
    let letters = letters.filter(Rect::is_positive);
    letters.map(|area| area.rotate_bb(turn).translate(text.pos.to_vec2())).collect()
}
