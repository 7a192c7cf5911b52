//! Contrast of texts to the backgrounds on which they are painted, according to WCAG 2.1.

use egui::accesskit::Role;
use egui::epaint::TextShape;
use egui::{Color32, Pos2, Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;

use crate::frame::{Painted, painted, rows};

/// Least contrast of a text.
const LEAST: f64 = 4.5;
/// Least contrast of a large text.
const LEAST_OF_LARGE: f64 = 3.0;
/// Size from which a text is large, in points (18 pt in print).
const LARGE: f32 = 24.0;
/// Opacity from which a surface hides what lies below it, 0 to 255: the backing of names on pictures.
const HIDING: u8 = 225;

/// Relative luminance.
fn luminance(color: Color32) -> f64 {
    let linear = |c: u8| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

/// Contrast of two opaque colors, 1 to 21.
pub(super) fn contrast(a: Color32, b: Color32) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// Area with one color; `None` is a picture, whose colors are not known here.
struct Surface {
    area: Rect,
    color: Option<Color32>,
}

/// Texts of the last frame whose contrast is too low. Disabled controls are exempt, and so are texts directly on a
/// picture.
pub(super) fn illegible<State>(harness: &Harness<'_, State>) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    let disabled = nodes.filter(|node| {
        let inner = node.accesskit_node();
        inner.is_disabled() && inner.role() != Role::Window && inner.raw_bounds().is_some()
    });
    let disabled: Vec<Rect> = disabled.map(|node| node.rect().expand(1.0)).collect();
    let (mut surfaces, mut found) = (Vec::<Surface>::new(), Vec::new());
    for Painted { shape, clip } in painted(harness) {
        if let Shape::Text(text) = shape {
            for row in rows(text) {
                let is_read = clip.contains(row.center())
                    && text.opacity_factor > 0.0
                    && !disabled.iter().any(|area| area.contains(row.center()));
                if is_read && let Some(below) = background(&surfaces, row.center()) {
                    found.extend(faint_parts(text, below, row));
                }
            }
        } else if let Some(surface) = surface_of(shape, clip) {
            surfaces.push(surface);
        }
    }
    found
}

/// Area and color that a shape covers; `None` if it is only a line.
fn surface_of(shape: &Shape, clip: Rect) -> Option<Surface> {
    let surface = |area: Rect, color| Some(Surface { area: area.intersect(clip), color });
    match shape {
        Shape::Rect(rect) if rect.brush.is_some() => surface(rect.rect, None),
        // Blurred rectangles are shadows.
        Shape::Rect(rect) if rect.fill.a() > 0 && rect.blur_width == 0.0 => {
            surface(rect.rect, Some(rect.fill))
        }
        // The square in the circle.
        Shape::Circle(circle) if circle.fill.a() > 0 => {
            let side = std::f32::consts::SQRT_2 * circle.radius;
            surface(Rect::from_center_size(circle.center, egui::Vec2::splat(side)), Some(circle.fill))
        }
        Shape::Path(path) if path.fill.a() > 0 => surface(Rect::from_points(&path.points), None),
        Shape::Mesh(mesh) => surface(mesh.calc_bounds(), None),
        Shape::Callback(callback) => surface(callback.rect, None),
        _ => None,
    }
}

/// Color that is visible at a position, or `None` on a picture.
fn background(surfaces: &[Surface], at: Pos2) -> Option<Color32> {
    let below = surfaces.iter().filter(|surface| surface.area.contains(at));
    below.fold(None, |below, surface| match surface.color? {
        color if color.is_opaque() => Some(color),
        color if below.is_none() && color.a() >= HIDING => Some(color.to_opaque()),
        color => below.map(|below: Color32| below.blend(color)),
    })
}

/// Colors of a text that are too faint on this background.
fn faint_parts(text: &TextShape, below: Color32, row: Rect) -> Vec<String> {
    let words = text.galley.text();
    let sections = text.galley.job.sections.iter().filter_map(|section| {
        let format = &section.format;
        let below = below.blend(format.background);
        let own = if format.color == Color32::PLACEHOLDER { text.fallback_color } else { format.color };
        let color = text.override_text_color.unwrap_or(own).gamma_multiply(text.opacity_factor);
        let reached = contrast(below.blend(color), below);
        let least = if format.font_id.size >= LARGE { LEAST_OF_LARGE } else { LEAST };
        (reached < least)
            .then(|| format!("{words:?}, {color:?} on {below:?}: {reached:.2} of {least}, at {:?}", row.min))
    });
    sections.collect()
}
