//! Trails on the stroke pad: of a recorded stroke, and behind the tip while it strokes.

use egui::{Align2, FontId, Rect, Shape, Stroke, Ui, vec2};
use shagreen_device::touch::Touch;
use shagreen_device::track::PenSample;

use super::PadState;
use super::surface::in_ui;
use crate::look::motion::is_reduced;
use crate::look::theme::tokens;
use crate::session::Session;
use crate::state::recorder::LONGEST_SECS;
use crate::strings::stroke as strings;

/// Approximate maximum number of drawn points of a trail.
const MOST_POINTS: usize = 2000;

/// Time after which the trail behind the tip has faded, in seconds.
const FADE_SECS: f64 = 0.7;

/// Last places of the tip, for the trail that fades behind it.
#[derive(Clone, Copy, Debug)]
pub(super) struct LiveTrail {
    /// Time in seconds and place in m, as a ring; a tip that does not touch has no place.
    places: [Option<(f64, [f32; 2])>; 64],
    next: usize,
}

impl Default for LiveTrail {
    fn default() -> Self {
        Self { places: [None; 64], next: 0 }
    }
}

impl LiveTrail {
    /// Adds the place of the tip at a time of the window.
    pub(super) fn follow(&mut self, now_secs: f64, touch: Touch) {
        let place = (touch.contact.force_n > 0.0).then_some((now_secs, [touch.x_m, touch.y_m]));
        self.places[self.next] = place;
        self.next = (self.next + 1) % self.places.len();
    }

    /// Draws the trail, unless motion is reduced.
    pub(super) fn show(&self, ui: &Ui, area: Rect, now_secs: f64) {
        if is_reduced(ui.ctx()) {
            return;
        }
        let t = tokens(ui.ctx());
        let painter = ui.painter().with_clip_rect(area);
        let n = self.places.len();
        let in_order = |i: usize| self.places[(self.next + i) % n];
        for i in 1..n {
            let (Some((_, from)), Some((secs, to))) = (in_order(i - 1), in_order(i)) else { continue };
            let left = 1.0 - ((now_secs - secs) / FADE_SECS) as f32;
            if left > 0.0 {
                ui.ctx().request_repaint();
                let stroke = Stroke::new(1.0 + 4.0 * left, t.accent.gamma_multiply(0.55 * left));
                painter.line_segment([in_ui(area, from[0], from[1]), in_ui(area, to[0], to[1])], stroke);
            }
        }
    }
}

/// Draws the trail of the recording in progress, or else of the repeated stroke.
pub(super) fn trail_ui(ui: &Ui, area: Rect, session: &Session, state: &PadState) {
    let t = tokens(ui.ctx());
    if let Some((samples, secs)) = session.recording() {
        way(ui, area, samples, Stroke::new(1.5, t.warning));
        let text = secs.map_or(strings::WAITS.to_owned(), |secs| strings::recording(secs, LONGEST_SECS));
        let painter = ui.painter().with_clip_rect(area);
        let galley = painter.layout_no_wrap(text, FontId::proportional(11.5), t.warning);
        let size = galley.size() + vec2(10.0, 4.0);
        let at = Align2::LEFT_BOTTOM.anchor_size(area.left_bottom() + vec2(6.0, -6.0), size);
        painter.rect_filled(at, 3.0, t.background.gamma_multiply(0.75));
        painter.galley(at.min + vec2(5.0, 2.0), galley, t.warning);
    } else if let Some(stroke) = session.stroke().filter(|_| state.repeats) {
        way(ui, area, stroke.samples(), Stroke::new(1.5, t.accent.gamma_multiply(0.85)));
    }
}

fn way(ui: &Ui, area: Rect, samples: &[PenSample], stroke: Stroke) {
    let painter = ui.painter().with_clip_rect(area);
    let every = samples.len() / MOST_POINTS + 1;
    let mut line = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        if sample.touching && (line.is_empty() || i % every == 0) {
            line.push(in_ui(area, sample.x_m as f32, sample.y_m as f32));
        } else if !sample.touching && !line.is_empty() {
            painter.add(Shape::line(std::mem::take(&mut line), stroke));
        }
    }
    painter.add(Shape::line(line, stroke));
}
