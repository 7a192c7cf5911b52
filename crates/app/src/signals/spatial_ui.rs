//! Spatial spectrogram that the pointer edits with the tool of the editor.

use std::f32::consts::TAU;
use std::sync::Arc;

use egui::{CursorIcon, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2};
use egui_plot::{PlotPoint, PlotResponse, PlotTransform};
use shagreen_core::signals::spatial_spectrogram::edit::Region;
use shagreen_formats::figure::{Figure, Map};

use super::editor::Editor;
use crate::choices::signals::Slot;
use crate::choices::signals::Tool;
use crate::command::Command;
use crate::figure_ui::figure_head_ui;
use crate::look::drag::dragged_to;
use crate::look::map_plot::labeled_map_plot;
use crate::look::theme::tokens;
use crate::state::bench_signal::BenchSignal;
use crate::strings::signals as strings;

/// Number of vertices of a brush outline.
const N_CORNERS: usize = 48;

/// Range of positions that is shown, in mm; `None` shows all.
pub(super) type ShownMm = Option<(f64, f64)>;

/// Minimum length that is shown, in mm.
const LEAST_SHOWN_MM: f64 = 1.0;
/// Zoom per point of scrolling, as the natural logarithm of the factor.
const ZOOM_PER_POINT: f64 = 0.004;

/// First corner of a rectangle, and the range of positions that is shown.
#[derive(Default)]
pub(super) struct Spatial {
    from: Option<(f64, f64)>,
    pub(super) shown_mm: ShownMm,
}

/// Result of one frame.
#[derive(Default)]
pub(super) struct Shown {
    /// Command that saves the figure.
    pub(super) save: Option<Command>,
    /// Result of an edit in this frame. The inner `None` means that the signal has not changed.
    pub(super) painted: Option<Result<Option<Arc<BenchSignal>>, String>>,
}

/// Draws a map over position, which scrolling zooms; returns the requested command and the map on the screen.
pub(super) fn places_map_ui(
    ui: &mut Ui,
    slot: Slot,
    figure: &Arc<Figure>,
    stem: &str,
    state: &mut Spatial,
    length_mm: f64,
) -> (Option<Command>, Option<PlotResponse<()>>) {
    let save = figure_head_ui(ui, figure, stem);
    let Figure::Map(map) = &**figure else { return (save, None) };
    let plot = labeled_map_plot(ui, strings::map_name(slot), map);
    // A sheet may cover the map.
    let pointed = ui.input(|i| i.pointer.hover_pos()).filter(|_| plot.response.contains_pointer());
    if let Some(pos) = pointed {
        let scrolled = ui.input(|i| i.smooth_scroll_delta.y);
        if scrolled != 0.0 {
            let at_mm = plot.transform.value_from_position(pos).x;
            state.shown_mm = zoomed(map.x, length_mm, at_mm, f64::from(scrolled));
        }
    }
    (save, Some(plot))
}

/// Range that is shown after `scrolled` points of scrolling at `at_mm`; that position stays where it is.
fn zoomed((from, to): (f64, f64), length_mm: f64, at_mm: f64, scrolled: f64) -> ShownMm {
    let factor = (-ZOOM_PER_POINT * scrolled).exp();
    let shown = (factor * (to - from)).max(LEAST_SHOWN_MM.min(length_mm));
    if shown >= length_mm {
        return None;
    }
    let share = ((at_mm - from) / (to - from)).clamp(0.0, 1.0);
    let from = (at_mm - share * shown).clamp(0.0, length_mm - shown);
    Some((from, from + shown))
}

/// Draws the spectrogram of `signal`, and lets the tool of the editor work on it.
pub(super) fn spatial_ui(
    ui: &mut Ui,
    figure: &Arc<Figure>,
    stem: &str,
    state: &mut Spatial,
    editor: &mut Editor,
    signal: &Arc<BenchSignal>,
    window_m: f64,
) -> Shown {
    let length_mm = 1e3 * signal.profile.length_m();
    let (save, plot) = places_map_ui(ui, Slot::B, figure, stem, state, length_mm);
    let mut shown = Shown { save, painted: None };
    let (Figure::Map(map), Some(plot)) = (&**figure, plot) else { return shown };
    let (area, transform) = (plot.response.rect, plot.transform);
    let response = ui.interact(area, ui.scope_id().with("painting"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, strings::PAINTED_MAP));
    let at = |pos: Pos2| on_map(&transform, map, length_mm, pos);
    let pressed_at = ui.input(|i| i.pointer.press_origin()).filter(|_| response.is_pointer_button_down_on());
    let is_other_button = ui.input(|i| i.pointer.secondary_down() || i.pointer.middle_down());
    let held = dragged_to(ui, &response).or(pressed_at).filter(|_| !is_other_button).map(at);
    if editor.tool.is_brush() {
        if let Some(point) = held {
            shown.painted = Some(editor.brush_at(signal, window_m, point));
        }
        if !response.is_pointer_button_down_on() {
            editor.lift();
        }
    } else if editor.tool == Tool::Paste {
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked()).map(at);
        if let Some((place_m, _)) = clicked {
            shown.painted = Some(editor.paste(signal, window_m, place_m).map(Some));
        }
    } else if let Some(to) = held.filter(|_| editor.tool.takes_region()) {
        let from = *state.from.get_or_insert(to);
        if response.drag_stopped() {
            state.from = None;
            let region = region(from, to, (1e-3 * length_mm, 1e3 * map.y.1));
            shown.painted = Some(if editor.tool == Tool::Erase {
                editor.erase(signal, window_m, &region).map(Some)
            } else {
                editor.copy(signal, window_m, &region).map(|()| None)
            });
        } else {
            outline_region(ui, area, &transform, from, to);
        }
    } else {
        state.from = None;
    }
    if let Some(pos) = response.hover_pos() {
        if editor.tool.is_brush() {
            outline_brush(ui, area, &transform, editor, at(pos));
        }
        response.on_hover_cursor(CursorIcon::Crosshair);
    }
    shown
}

/// Position in m and spatial frequency in 1/m at a screen position, limited to the map.
fn on_map(transform: &PlotTransform, map: &Map, length_mm: f64, pos: Pos2) -> (f64, f64) {
    let value = transform.value_from_position(pos);
    let within = |x: f64, (low, high): (f64, f64), least: f64, most: f64| {
        x.clamp(low, high.max(low)).clamp(least, most)
    };
    (1e-3 * within(value.x, map.x, 0.0, length_mm), 1e3 * within(value.y, map.y, 0.0, f64::INFINITY))
}

/// Region between two corners in any order. At an end of the signal it includes the windows centered beyond that end.
/// At the upper edge of the map it includes all higher frequencies.
fn region(from: (f64, f64), to: (f64, f64), (end_m, top_per_m): (f64, f64)) -> Region {
    let reaching = |a: f64, b: f64, end: f64, before: f64| {
        let (low, high) = (a.min(b), a.max(b));
        let low = if low <= 0.0 { before } else { low };
        low..if high >= 0.9999 * end { f64::INFINITY } else { high }
    };
    Region {
        places_m: reaching(from.0, to.0, end_m, f64::NEG_INFINITY),
        per_m: reaching(from.1, to.1, top_per_m, 0.0),
    }
}

fn on_screen(transform: &PlotTransform, (place_m, per_m): (f64, f64)) -> Pos2 {
    let pos = transform.position_from_point(&PlotPoint::new(1e3 * place_m, 1e-3 * per_m));
    pos2(pos.x, pos.y)
}

fn outline_region(ui: &Ui, area: Rect, transform: &PlotTransform, from: (f64, f64), to: (f64, f64)) {
    let rect = Rect::from_two_pos(on_screen(transform, from), on_screen(transform, to));
    let stroke = Stroke::new(1.5, tokens(ui.ctx()).accent);
    ui.painter_at(area).rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
}

/// Draws the extent of a brush around a point. It is symmetric in octaves, and therefore not on a linear frequency
/// axis.
fn outline_brush(ui: &Ui, area: Rect, transform: &PlotTransform, editor: &Editor, at: (f64, f64)) {
    let corner = |i: usize| {
        let (up, across) = (TAU * i as f32 / N_CORNERS as f32).sin_cos();
        let place_m = at.0 + 1e-3 * editor.radius_mm * f64::from(across);
        on_screen(transform, (place_m, at.1 * (editor.radius_octaves * f64::from(up)).exp2()))
    };
    let painter = ui.painter_at(area);
    // A light line on a dark one is visible on every color of the map.
    let corners: Vec<Pos2> = (0..=N_CORNERS).map(corner).collect();
    painter.line(corners.clone(), Stroke::new(3.0, egui::Color32::from_black_alpha(160)));
    painter.line(corners, Stroke::new(1.5, egui::Color32::WHITE));
}

#[cfg(test)]
mod tests {
    use super::{region, zoomed};

    #[test]
    fn zooming_keeps_what_is_pointed_at_and_ends_with_the_whole() {
        let (from, to) = zoomed((0.0, 100.0), 100.0, 25.0, 100.0).unwrap();
        assert!(((25.0 - from) / (to - from) - 0.25).abs() < 1e-12 && to - from < 70.0);
        let back = zoomed((from, to), 100.0, 25.0, -60.0).unwrap();
        assert!(back.1 - back.0 > to - from && back.0 >= 0.0);
        assert_eq!(zoomed((from, to), 100.0, 25.0, -500.0), None);
        let (from, to) = zoomed((99.0, 100.0), 100.0, 99.9, 1e4).unwrap();
        assert!((to - from - 1.0).abs() < 1e-9 && to <= 100.0);
        assert_eq!(zoomed((0.0, 0.5), 0.5, 0.1, 100.0), None, "shorter than what can be shown");
    }

    #[test]
    fn a_rectangle_is_the_same_from_every_corner() {
        let end = (0.1, 5000.0);
        let one = region((0.01, 100.0), (0.03, 900.0), end);
        assert_eq!(one, region((0.03, 100.0), (0.01, 900.0), end));
        assert_eq!((one.places_m, one.per_m), (0.01..0.03, 100.0..900.0));
        let all = region((0.0, 0.0), end, end);
        assert_eq!((all.places_m, all.per_m), (f64::NEG_INFINITY..f64::INFINITY, 0.0..f64::INFINITY));
    }
}
