//! Message below the canvas about the current texture: solo, path, extrapolation, convex hull or jumps.

use std::sync::Arc;

use egui::{Color32, FontId, Ui, pos2};
use shagreen_core::space::authoring::Authored;
use shagreen_core::texture::blend::Mode;

use crate::look::axes::Axes;
use crate::look::theme::{RADIUS, Tokens};
use crate::panel::Panel;
use crate::strings;

/// Space for the axis end labels on each side, in points.
const SIDE_ROOM: f32 = 62.0;
/// Distance from the axes down to the lower edge of the message, in points.
const DEPTH: f32 = 43.0;
/// Barycentric weight up to which the point counts as near the opposite edge of the triangle.
const NEAR_AN_EDGE: f64 = 0.05;

/// Draws the message, if there is one. With `asks_for_path`, it says how a path is drawn.
pub(super) fn foot_ui(ui: &Ui, axes: Axes, panel: &Panel<'_>, asks_for_path: bool, t: &Tokens) {
    let asked = asks_for_path.then(|| (strings::path::DRAW_ONE.to_owned(), t.accent));
    let Some((text, color)) = asked.or_else(|| foot(panel, t)) else { return };
    let width = (axes.rect.width() - 2.0 * SIDE_ROOM).max(SIDE_ROOM);
    let mut job = egui::text::LayoutJob::simple(text, FontId::proportional(12.5), color, width);
    job.halign = egui::Align::Center;
    let galley = ui.painter().layout_job(job);
    let top = axes.rect.bottom() + DEPTH - galley.size().y;
    let place = pos2(axes.rect.center().x, top);
    // In a small window, names of textures lie there.
    let area = galley.rect.translate(place.to_vec2()).expand(3.0);
    ui.painter().rect_filled(area, f32::from(RADIUS), t.background);
    ui.painter().galley(place, Arc::clone(&galley), color);
}

fn foot(panel: &Panel<'_>, t: &Tokens) -> Option<(String, Color32)> {
    let is_path = panel.session.path_point().is_some();
    if let Some(texture) =
        panel.solo().filter(|_| !is_path).and_then(|solo| panel.session.textures().get(solo))
    {
        return Some((strings::plays_alone(&texture.name), t.accent));
    }
    let authored = panel.session.authored()?;
    let says = |text: &str, color: Color32| Some((text.to_owned(), color));
    if is_path && panel.session.touch().contact.force_n <= 0.0 {
        says(strings::path::WAITS, t.accent)
    } else if authored.mode.makes_a_model() && authored.model.is_none() && !panel.session.is_preparing() {
        says(strings::NO_TEXTURE_HERE, t.error)
    } else if authored.is_extrapolated && authored.location.clamped {
        Some((strings::extrapolated_to(authored.location.at), t.warning))
    } else if authored.is_extrapolated {
        says(strings::EXTRAPOLATED_HERE, t.warning)
    } else if authored.location.clamped {
        says(strings::CLAMPED, t.warning)
    } else if authored.mode != Mode::Paper {
        None
    } else if is_near_an_edge(authored) {
        says(strings::JUMPS_HERE, t.warning)
    } else {
        says(strings::JUMPS, t.text_weak)
    }
}

/// Whether a small step leads into another triangle. At the position of a texture nothing jumps.
fn is_near_an_edge(authored: &Authored) -> bool {
    let shares = || authored.location.corners.iter().map(|(_, share)| *share);
    let n_far = shares().filter(|share| *share > NEAR_AN_EDGE).count();
    n_far == 2
}
