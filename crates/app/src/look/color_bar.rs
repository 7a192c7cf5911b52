//! Bar with the colors of a map.

use egui::{Color32, Mesh, Rect, pos2};

/// Number of parts of the bar. The color changes linearly within each.
const N_PARTS: u32 = 64;

/// Returns a bar over `area` whose colors change from left to right; `color` returns the color at a share of the range
/// (0 to 1). The parts share their edges, so that no gap is visible at any scale of the window.
pub(crate) fn color_bar(area: Rect, color: impl Fn(f32) -> Color32) -> Mesh {
    let mut bar = Mesh::default();
    for edge in 0..=N_PARTS {
        let share = edge as f32 / N_PARTS as f32;
        let x = area.left() + share * area.width();
        for y in [area.top(), area.bottom()] {
            bar.colored_vertex(pos2(x, y), color(share));
        }
    }
    for corner in (0..N_PARTS).map(|part| 2 * part) {
        bar.add_triangle(corner, corner + 1, corner + 2);
        bar.add_triangle(corner + 1, corner + 2, corner + 3);
    }
    bar
}

#[cfg(test)]
mod tests {
    use super::color_bar;
    use crate::look::theme::map_color;
    use egui::{Rect, pos2};

    /// The triangles add up to the whole area, and the ends have the colors of the lowest and the highest value.
    #[test]
    fn a_bar_has_no_gaps_and_every_color() {
        let area = Rect::from_min_max(pos2(10.25, 5.0), pos2(54.25, 13.0));
        let bar = color_bar(area, map_color);
        let size = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|i| bar.vertices[i as usize].pos);
            let (u, v) = (b - a, c - a);
            0.5 * (u.x * v.y - u.y * v.x).abs()
        };
        let covered: f32 = bar.indices.as_chunks::<3>().0.iter().map(size).sum();
        assert!((covered - area.area()).abs() < 1e-2, "{covered} of {}", area.area());
        let (first, last) = (bar.vertices[0], bar.vertices[bar.vertices.len() - 1]);
        assert_eq!((first.pos, first.color), (area.left_top(), map_color(0.0)));
        assert_eq!((last.pos, last.color), (area.right_bottom(), map_color(1.0)));
    }
}
