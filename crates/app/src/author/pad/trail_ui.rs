//! Trail of a recorded stroke on the stroke pad.

use egui::{Align2, FontId, Rect, Shape, Stroke, Ui, vec2};
use shagreen_device::track::PenSample;

use super::{PadState, in_ui};
use crate::look::theme::tokens;
use crate::session::Session;
use crate::state::recorder::LONGEST_SECS;
use crate::strings::stroke as strings;

/// Approximate maximum number of drawn points of a trail.
const MOST_POINTS: usize = 2000;

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
