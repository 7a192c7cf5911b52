//! Slice that the canvas shows of a space with more axes: textures fade and shrink with their distance from it.

use egui::{Align2, FontId, Pos2, Rect, Role, Sense, Ui, WidgetInfo, pos2};
use shagreen_core::space::heat_map::Quantity;
use shagreen_core::space::{MOST_AXES, SpacePoint};

use super::map::ShownMap;
use crate::look::theme::Tokens;
use crate::panel::Panel;
use crate::strings::{axes as strings, map as words};

/// Distance from the slice at which a texture has about 60 % of the difference in size and opacity between one on the slice and
/// one far away, relative to the spread of the textures on the further axes: with more axes, all textures are farther away.
const RELATIVE_WIDTH: f64 = 0.8;
/// Smallest such distance, in points of the axes: textures that hardly differ stay visible.
const LEAST_WIDTH: f64 = 4.0;
/// Size and opacity of a texture far away, relative to one on the slice: a small faint dot.
const LEAST_SIZE: f32 = 0.25;
const LEAST_OPACITY: f32 = 0.3;
/// Nearness up to which a texture has neither a name nor the ellipse of an estimate.
const LEAST_NAMED: f32 = 0.4;
/// Font size of the legend, in points.
const SIZE: f32 = 11.5;

/// Slice through the further coordinates of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    at: SpacePoint,
    width: f64,
}

impl Slice {
    /// Slice that the canvas shows ([`Panel::slice_point`]).
    pub(super) fn of(panel: &Panel<'_>) -> Self {
        let sites: Vec<SpacePoint> = panel.session.placed().map(|(_, at)| at).collect();
        Self::through(panel.slice_point(), &sites)
    }

    /// Slice through a point between textures at these positions.
    fn through(at: SpacePoint, sites: &[SpacePoint]) -> Self {
        Self { at, width: (RELATIVE_WIDTH * spread(sites)).max(LEAST_WIDTH) }
    }

    /// Nearness of a texture to the slice: 1 on it, and toward 0 far from it on the further axes. In a space with two axes, all
    /// textures are on it.
    pub(super) fn nearness(self, site: SpacePoint) -> f32 {
        let distance = site.distance(self.at.on_canvas_at(site)) / self.width;
        (-0.5 * distance * distance).exp() as f32
    }
}

/// Root mean square distance of positions from their mean on the further axes, in points of the axes; 0 without positions.
fn spread(sites: &[SpacePoint]) -> f64 {
    let n = sites.len().max(1) as f64;
    let variance = |axis: usize| {
        let values = || sites.iter().filter_map(|site| site.get(axis));
        let mean = values().sum::<f64>() / n;
        values().map(|value| (value - mean).powi(2)).sum::<f64>() / n
    };
    (2..MOST_AXES).map(variance).sum::<f64>().sqrt()
}

/// Size of a texture with this nearness, relative to one on the slice.
pub(super) fn size(nearness: f32) -> f32 {
    LEAST_SIZE + (1.0 - LEAST_SIZE) * nearness
}

/// Opacity of a texture with this nearness, relative to one on the slice. It falls more slowly than the size, so that textures with
/// a name stand out from the background.
pub(super) fn opacity(nearness: f32) -> f32 {
    LEAST_OPACITY + (1.0 - LEAST_OPACITY) * nearness.max(0.0).sqrt()
}

/// Whether a texture with this nearness is named.
pub(super) fn is_named(nearness: f32) -> bool {
    nearness > LEAST_NAMED
}

/// Lines of the legend of a space with more axes than the canvas; none in other spaces. The convex hull is not drawn in such a
/// space, so a line says which values a map has outside it.
pub(super) fn legend(panel: &Panel<'_>, map: Option<&ShownMap>) -> Vec<String> {
    if !panel.session.is_sliced() {
        return Vec::new();
    }
    let mut lines = vec![strings::slice(panel.session.n_axes())];
    if map.is_some_and(|map| map.quantity != Quantity::Distance) {
        lines.push(words::outside(panel.project.texture().blend.outside).to_owned());
    }
    lines
}

/// Draws the lines of the legend with their upper right corner at `corner`; returns their rectangle.
pub(super) fn legend_ui(ui: &Ui, corner: Pos2, lines: &[String], t: &Tokens) -> Option<Rect> {
    let mut area: Option<Rect> = None;
    for line in lines {
        let corner = pos2(corner.x, area.map_or(corner.y, |above| above.bottom()));
        let font = FontId::proportional(SIZE);
        let line = ui.painter().text(corner, Align2::RIGHT_TOP, line, font, t.text_weak);
        area = Some(area.map_or(line, |above| above.union(line)));
    }
    let area = area?;
    let response = ui.interact(area, ui.scope_id().with("slice of the space"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, lines.join(". ")));
    let help = if lines.len() > 1 { words::OUTSIDE_HELP } else { "" };
    response.on_hover_text(format!("{}{help}", strings::SLICE_HELP));
    Some(area)
}

#[cfg(test)]
mod tests {
    use super::{LEAST_NAMED, LEAST_OPACITY, LEAST_SIZE, LEAST_WIDTH, Slice, is_named, opacity, size};
    use crate::look::theme::{DARK, LIGHT, contrast};
    use shagreen_core::space::SpacePoint;

    fn at(coordinates: &[f64]) -> SpacePoint {
        SpacePoint::of(coordinates).unwrap()
    }

    #[test]
    fn a_plane_is_a_whole_slice() {
        let slice = Slice::through(at(&[10.0, 20.0]), &[at(&[0.0, 5.0]), at(&[90.0, 80.0])]);
        let nearness = slice.nearness(at(&[90.0, 80.0]));
        assert_eq!((nearness, size(nearness), opacity(nearness)), (1.0, 1.0, 1.0));
        let line = Slice::through(at(&[10.0]), &[at(&[90.0])]);
        assert_eq!(line.nearness(at(&[90.0])), 1.0);
    }

    /// The distance on the canvas does not count, and the sizes fall smoothly to those of a small dot.
    #[test]
    fn textures_fade_with_their_distance_on_the_further_axes() {
        // A root mean square distance of 25 on the further axes.
        let sites = [at(&[1.0, 2.0, 30.0, 20.0]), at(&[90.0, 3.0, 60.0, 60.0])];
        let slice = Slice::through(at(&[10.0, 20.0, 30.0, 40.0]), &sites);
        assert!((slice.width - 20.0).abs() < 1e-9, "{slice:?}");
        let near = |third: f64, fourth: f64| slice.nearness(at(&[90.0, 80.0, third, fourth]));
        assert_eq!(near(30.0, 40.0), 1.0);
        assert!((near(30.0 + 12.0, 40.0 - 9.0) - near(45.0, 40.0)).abs() < 1e-6, "a distance of 15");
        let all: Vec<f32> = (0..=70).map(|step| near(30.0 + f64::from(step), 40.0)).collect();
        assert!(all.windows(2).all(|pair| pair[0] > pair[1] && pair[0] - pair[1] < 0.035), "{all:?}");
        assert!(is_named(all[0]) && !is_named(all[70]));
        assert!((size(all[70]) - LEAST_SIZE).abs() < 0.01 && (opacity(all[70]) - LEAST_OPACITY).abs() < 0.04);
        assert_eq!(Slice::through(at(&[10.0, 20.0, 30.0]), &[]).width, LEAST_WIDTH);
    }

    /// A name beside a mark that cannot be seen would name nothing (WCAG 2.1, criterion 1.4.11).
    #[test]
    fn the_mark_of_a_named_texture_stands_out_in_both_themes() {
        for t in [&DARK, &LIGHT] {
            let faintest = t.text_weak.gamma_multiply(opacity(LEAST_NAMED));
            let reached = contrast(t.background.blend(faintest), t.background);
            assert!(reached >= 3.0, "{reached}");
            assert!(contrast(t.text_weak, t.background) >= 4.5, "the name itself");
        }
    }
}
