//! Surface that the tip strokes: positions on it, strokes of the mouse, a pen or a finger, and the tip as the output reports it.

use egui::{
    Align2, CursorIcon, Event, FontId, PointerButton, Pos2, Rect, Response, Stroke, TouchPhase, Ui, pos2,
    vec2,
};
use shagreen_device::touch::Touch;

use crate::look::drag::dragged_to;
use crate::look::theme::tokens;
use crate::state::mouse_report::MouseReport;
use crate::strings;

/// Scale of a surface, in points per millimeter.
const POINTS_PER_MM: f32 = 3.0;

/// Pressure of a pen or finger, as the window system reports it, 0 to 1.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ReportedPressure(Option<f64>);

impl ReportedPressure {
    /// A pressure stays valid until the next report or until release: a pen held still reports nothing.
    pub(crate) fn follow(&mut self, events: &[Event]) {
        for event in events {
            match event {
                Event::Touch { phase: TouchPhase::End | TouchPhase::Cancel, .. } => self.0 = None,
                Event::Touch { force: Some(force), .. } => self.0 = Some(f64::from(*force)),
                _ => {}
            }
        }
    }
}

/// Position of the pointer while it strokes a surface, and once more on release. The secondary button opens menus and
/// strokes nothing.
pub(crate) fn stroke_report(
    ui: &Ui,
    area: Rect,
    response: &Response,
    pressure: ReportedPressure,
) -> Option<MouseReport> {
    let is_secondary = ui.input(|i| {
        let secondary = PointerButton::Secondary;
        let is_primary = i.pointer.primary_down() || i.pointer.primary_released();
        !is_primary && (i.pointer.button_down(secondary) || i.pointer.button_released(secondary))
    });
    if is_secondary {
        return None;
    }
    let pressed = response.is_pointer_button_down_on();
    let held_at = response.interact_pointer_pos().filter(|_| pressed || response.clicked());
    let pos = dragged_to(ui, response).or(held_at)?;
    // The output reports the tip after this frame, and a pointer that rests asks for none.
    ui.ctx().request_repaint();
    let [x_m, y_m] = on_pad_m(area, pos);
    Some(MouseReport { x_m, y_m, pressed, pressure: pressure.0 })
}

/// Cursor over a surface.
pub(crate) const CURSOR: CursorIcon = CursorIcon::Crosshair;

/// Screen position of a point on a surface, given in m from its center with y upwards.
pub(super) fn in_ui(area: Rect, x_m: f32, y_m: f32) -> Pos2 {
    area.center() + vec2(x_m, -y_m) * (POINTS_PER_MM * 1e3)
}

/// Position on a surface of a point of the screen, in m from the center of the surface with y upwards.
pub(super) fn on_pad_m(area: Rect, pos: Pos2) -> [f64; 2] {
    let from_middle = (pos - area.center()) / (POINTS_PER_MM * 1e3);
    [f64::from(from_middle.x), f64::from(-from_middle.y)]
}

/// Draws a bar of 10 mm in the lower right corner.
pub(super) fn scale_bar(ui: &Ui, area: Rect) {
    let t = tokens(ui.ctx());
    let (length, inset) = (10.0 * POINTS_PER_MM, 9.0);
    let back = Rect::from_min_max(
        area.right_bottom() - vec2(length + 2.0 * inset, 28.0),
        area.right_bottom() - vec2(4.0, 4.0),
    );
    ui.painter().rect_filled(back, 3.0, t.background.gamma_multiply(0.75));
    let y = back.bottom() - 6.0;
    let x = back.center().x;
    ui.painter().hline(x - length / 2.0..=x + length / 2.0, y, Stroke::new(2.0, t.text));
    ui.painter().text(
        pos2(x, y - 3.0),
        Align2::CENTER_BOTTOM,
        strings::TEN_MM,
        FontId::proportional(10.5),
        t.text,
    );
}

/// Draws the tip as reported by the audio callback: a ring whose disc grows with the normal force, in a dent that deepens
/// with it.
pub(crate) fn tip_ui(ui: &Ui, area: Rect, touch: Touch) {
    if touch.contact.force_n <= 0.0 {
        return;
    }
    let t = tokens(ui.ctx());
    let pos = in_ui(area, touch.x_m, touch.y_m);
    let painter = ui.painter().with_clip_rect(area);
    let pressed = (touch.contact.force_n / 2.0).min(1.0);
    for ring in 0..6 {
        let share = 1.0 - ring as f32 / 6.0;
        let shadow = egui::Color32::from_black_alpha((10.0 + 22.0 * pressed) as u8);
        painter.circle_filled(pos, 7.0 + (6.0 + 12.0 * pressed) * share, shadow);
    }
    painter.circle_filled(pos, 7.0, t.background.gamma_multiply(0.6));
    painter.circle_filled(pos, 2.0 + 3.0 * pressed, t.accent);
    painter.circle_stroke(pos, 7.0, Stroke::new(2.0, t.accent));
}

#[cfg(test)]
mod tests {
    use egui::{Event, TouchPhase};

    use super::ReportedPressure;

    #[test]
    fn a_pressure_holds_until_the_pen_is_lifted() {
        let touch = |phase, force| Event::Touch {
            device_id: egui::TouchDeviceId(0),
            id: egui::TouchId(0),
            phase,
            pos: egui::Pos2::ZERO,
            force,
        };
        let mut pressure = ReportedPressure::default();
        let mut after = |events: &[Event]| {
            pressure.follow(events);
            pressure.0
        };
        assert_eq!(after(&[]), None);
        assert_eq!(
            after(&[touch(TouchPhase::Start, Some(0.25)), touch(TouchPhase::Move, Some(0.5))]),
            Some(0.5)
        );
        assert_eq!(after(&[]), Some(0.5));
        assert_eq!(after(&[touch(TouchPhase::Move, None)]), Some(0.5));
        assert_eq!(after(&[touch(TouchPhase::End, Some(0.1))]), None);
    }
}
