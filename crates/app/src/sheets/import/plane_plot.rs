//! Speed–force plane: segments or nodes as dots, and their convex hull.

use egui::{Color32, Ui};
use egui_plot::{HoverPosition, Line, Plot, PlotPoint, PlotPoints, Points, uniform_grid_spacer};

use crate::look::plot::{fixed, nice_step, short};
use crate::look::theme::{Tokens, tokens};
use crate::strings::import as strings;

pub(super) struct Dot {
    pub(super) speed_mm_per_s: f64,
    pub(super) force_n: f64,
    pub(super) color: Color32,
}

/// Maximum distance of a click from a dot, in points.
const REACH: f32 = 14.0;

/// Draws the plane; returns the index of the dot that was clicked. The title above it states the units of both axes.
pub(super) fn plane_plot(
    ui: &mut Ui,
    name: &str,
    dots: &[Dot],
    selected: usize,
    height: f32,
) -> Option<usize> {
    let t = tokens(ui.ctx());
    let highest = |value: fn(&Dot) -> f64| dots.iter().map(value).fold(0.0, f64::max).max(1e-3);
    let (speed_max, force_max) = (highest(|d| d.speed_mm_per_s), highest(|d| d.force_n));
    let (across, up) = (nice_step(speed_max), nice_step(force_max));
    let plot = fixed(Plot::new(name.to_owned()), t.line)
        .height(height)
        .sense(egui::Sense::click())
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { position, .. } => {
                Some(format!("{:.0} mm/s, {:.2} N", position.x, position.y))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .x_grid_spacer(uniform_grid_spacer(move |_| [2.0 * across, across, across]))
        .y_grid_spacer(uniform_grid_spacer(move |_| [2.0 * up, up, up]))
        .x_axis_formatter(|mark, _| short(mark.value))
        .y_axis_formatter(|mark, _| short(mark.value))
        .show(ui, |plot| {
            plot.set_plot_bounds_x(-0.03 * speed_max..=1.08 * speed_max);
            plot.set_plot_bounds_y(-0.05 * force_max..=1.1 * force_max);
            let outline = hull(dots);
            if outline.len() > 2 {
                let line = Line::new("", PlotPoints::from(outline)).color(t.text_weak.gamma_multiply(0.6));
                plot.line(line.width(1.2).allow_hover(false));
            }
            for dot in dots {
                plot.points(
                    Points::new("", vec![[dot.speed_mm_per_s, dot.force_n]]).color(dot.color).radius(3.5),
                );
            }
            if let Some(dot) = dots.get(selected) {
                let ring = Points::new("", vec![[dot.speed_mm_per_s, dot.force_n]]);
                plot.points(ring.color(t.text).radius(7.0).filled(false).allow_hover(false));
            }
        });
    plot.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, name));
    let at = plot.response.interact_pointer_pos().filter(|_| plot.response.clicked())?;
    let distance = |dot: &Dot| {
        let pos = plot.transform.position_from_point(&PlotPoint::new(dot.speed_mm_per_s, dot.force_n));
        pos.distance(at)
    };
    let nearest = (0..dots.len()).min_by(|a, b| distance(&dots[*a]).total_cmp(&distance(&dots[*b])))?;
    (distance(&dots[nearest]) < REACH).then_some(nearest)
}

/// Color of a goodness of fit (GFC, 0 to 1).
pub(super) fn color_of_gfc(gfc: f64, t: &Tokens) -> Color32 {
    if gfc >= 0.95 {
        t.accent
    } else if gfc >= 0.8 {
        t.warning
    } else {
        t.error
    }
}

/// Draws the legend of the segment colors.
pub(super) fn gfc_legend_ui(ui: &mut Ui) {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        for (text, color) in [(strings::GOOD, t.accent), (strings::FAIR, t.warning), (strings::BAD, t.error)]
        {
            ui.spacing_mut().item_spacing.x = 4.0;
            let (area, _) = ui.allocate_exact_size(egui::vec2(8.0, 8.0), egui::Sense::hover());
            ui.painter().circle_filled(area.center(), 3.5, color);
            ui.add(egui::Label::new(egui::RichText::new(text).small().color(t.text_weak)).selectable(false));
            ui.add_space(6.0);
        }
    });
}

/// Convex hull of the dots as a closed line, by Andrew's monotone chain.
fn hull(dots: &[Dot]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = dots.iter().map(|d| [d.speed_mm_per_s, d.force_n]).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let turns_left = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while chain.len() > 1 && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], point) {
                chain.pop();
            }
            chain.push(point);
        }
        chain
    };
    let mut outline = chain(&mut points.iter().copied());
    outline.pop();
    outline.extend(chain(&mut points.iter().rev().copied()));
    outline
}

#[cfg(test)]
mod tests {
    use super::{Dot, hull};

    #[test]
    fn the_hull_goes_around_and_is_closed() {
        let dot = |[speed_mm_per_s, force_n]: [f64; 2]| Dot {
            speed_mm_per_s,
            force_n,
            color: egui::Color32::WHITE,
        };
        let check = |points: &[[f64; 2]], expected: &[[f64; 2]]| {
            assert_eq!(hull(&points.iter().copied().map(dot).collect::<Vec<_>>()), expected);
        };
        let square = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0]];
        check(&square, &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]]);
        check(&[[1.0, 1.0]], &[[1.0, 1.0]]);
        check(&[], &[]);
    }
}
