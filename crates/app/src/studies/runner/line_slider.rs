//! Line without marks on which a participant places a mark: the slider of rating scales.
//!
//! There is no mark before the participant places it, so that nothing suggests a value.

use egui::accesskit::{Action as AccessAction, ActionData};
use egui::{
    CursorIcon, EventFilter, Id, Key, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::look::drag::dragged_to;
use crate::look::theme::tokens;

/// Length of lines whose length the plan does not state, in mm.
pub(super) const USUAL_MM: f32 = 100.0;
/// Height of the area that takes the pointer, in points.
pub(super) const HEIGHT: f32 = 44.0;
/// Length of the mark, in points.
const MARK: f32 = 22.0;
/// Space at both ends, so that a mark at an end is whole and can be hit, in points.
const MARGIN: f32 = 10.0;
/// Step of an arrow key, and of an arrow key with Shift, in points of the scale of 0 to 100.
const STEP: f64 = 1.0;
const BIG_STEP: f64 = 10.0;

/// Draws a line of this length in points with its mark; returns the response and the new position from 0 to 100, if it was
/// moved. `name` is for screen readers.
pub(super) fn line_slider(
    ui: &mut Ui,
    name: &str,
    value: Option<f64>,
    length: f32,
) -> (Response, Option<f64>) {
    let size = vec2(length + 2.0 * MARGIN, HEIGHT);
    let (area, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let line = Rect::from_min_max(
        pos2(area.left() + MARGIN, area.top()),
        pos2(area.left() + MARGIN + length, area.bottom()),
    );
    let moved = moved(ui, &response, line, value);
    let now = moved.or(value);
    let is_enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo { value: now, ..WidgetInfo::labeled(Role::Slider, is_enabled, name) });
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(100.0);
        node.add_action(AccessAction::SetValue);
    });
    paint(ui, &response, line, now);
    let response = response.on_hover_and_drag_cursor(CursorIcon::PointingHand);
    (response, moved)
}

/// New position after the pointer, a key or a screen reader.
fn moved(ui: &Ui, response: &Response, line: Rect, value: Option<f64>) -> Option<f64> {
    if !ui.is_enabled() {
        return None;
    }
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let clicked_at = response.interact_pointer_pos().filter(|_| response.clicked());
    let pressed_at = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on());
    if let Some(pos) = dragged_to(ui, response).or(clicked_at).or(pressed_at) {
        let share = f64::from((pos.x - line.left()) / line.width());
        return Some(100.0 * share.clamp(0.0, 1.0));
    }
    set_by_reader(ui, response.id).or_else(|| nudged(ui, response.id, value))
}

/// Value that a screen reader sets.
fn set_by_reader(ui: &Ui, id: Id) -> Option<f64> {
    ui.input(|i| {
        let requests = i.accesskit_action_requests(id, AccessAction::SetValue);
        let values = requests.filter_map(|request| match request.data {
            Some(ActionData::NumericValue(value)) => Some(value.clamp(0.0, 100.0)),
            _ => None,
        });
        values.last()
    })
}

/// Position after the keys left and right, Home and End. The first one places the mark in the middle.
fn nudged(ui: &Ui, id: Id, value: Option<f64>) -> Option<f64> {
    if !ui.memory(|memory| memory.has_focus(id)) {
        return None;
    }
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
    ui.input(|i| {
        if i.key_pressed(Key::Home) {
            return Some(0.0);
        }
        if i.key_pressed(Key::End) {
            return Some(100.0);
        }
        let n_presses = |key: Key| i.num_presses(key) as f64;
        let steps = n_presses(Key::ArrowRight) - n_presses(Key::ArrowLeft);
        if steps == 0.0 {
            return None;
        }
        let step = if i.modifiers.shift { BIG_STEP } else { STEP };
        Some(value.map_or(50.0, |value| (value + step * steps).clamp(0.0, 100.0)))
    })
}

fn paint(ui: &Ui, response: &Response, line: Rect, value: Option<f64>) {
    let t = tokens(ui.ctx());
    let painter = ui.painter();
    let has_focus = response.has_focus();
    let color = if has_focus || response.hovered() { t.text } else { t.text_weak };
    painter.hline(line.x_range(), line.center().y, Stroke::new(2.0, color));
    if let Some(value) = value {
        let x = line.left() + line.width() * (value / 100.0) as f32;
        let (top, bottom) = (line.center().y - 0.5 * MARK, line.center().y + 0.5 * MARK);
        painter.vline(x, top..=bottom, Stroke::new(4.0, t.accent));
    }
    if has_focus {
        let ring =
            Rect::from_center_size(line.center(), vec2(line.width() + 2.0 * MARGIN - 2.0, MARK + 12.0));
        painter.rect_stroke(ring, 4.0, Stroke::new(1.5, t.accent), egui::StrokeKind::Inside);
    }
}
