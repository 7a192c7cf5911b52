//! Tour of four places of the window, each with a card. The window stays usable.

use egui::{
    Area, Context, Id, Key, LayerId, Modifiers, Order, Pos2, Rect, RichText, Stroke, StrokeKind, vec2,
};

use crate::choices::tour::Step;
use crate::look::theme::{GAP, RADIUS, tokens};
use crate::strings::help as strings;

/// Width of the card, in points.
const WIDTH: f32 = 300.0;

impl Step {
    /// All steps, in order.
    pub const ALL: [Self; 4] = [Self::Drag, Self::Stroke, Self::Blend, Self::Keep];
}

/// Progress of the tour.
#[derive(Clone, Copy, Debug)]
pub struct Tour {
    /// Index of the shown step.
    step: Option<usize>,
    /// Rectangles of the steps in the last frame, in the order of [`Step::ALL`].
    pub(crate) places: [Rect; Step::ALL.len()],
}

impl Default for Tour {
    fn default() -> Self {
        Self { step: None, places: [Rect::NOTHING; Step::ALL.len()] }
    }
}

impl Tour {
    /// Starts at the first step.
    pub(crate) fn begin(&mut self) {
        self.step = Some(0);
    }

    /// Whether a step is shown.
    pub fn is_on(self) -> bool {
        self.step.is_some()
    }

    /// Draws the present step, if any. Returns true in the frame in which the tour ends.
    pub(crate) fn show(&mut self, ctx: &Context) -> bool {
        let Some(index) = self.step else { return false };
        let t = tokens(ctx);
        let place = self.places[index].intersect(ctx.content_rect());
        let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("tour place")));
        painter.rect_stroke(
            place.shrink(2.0),
            f32::from(RADIUS),
            Stroke::new(2.5, t.warning),
            StrokeKind::Inside,
        );
        let [heading, words] = strings::step(Step::ALL[index]);
        let card =
            Area::new(Id::unique("tour")).order(Order::Tooltip).fixed_pos(beside(place, ctx.content_rect()));
        let mut next = Some(index);
        card.show(ctx, |ui| {
            egui::Frame::popup(ui.style()).fill(t.raised).inner_margin(12.0).show(ui, |ui| {
                ui.set_width(WIDTH);
                ui.label(RichText::new(heading).heading().strong());
                ui.label(words);
                ui.add_space(GAP);
                ui.horizontal(|ui| {
                    let is_last = index + 1 == Step::ALL.len();
                    let name = if is_last { strings::DONE } else { strings::NEXT };
                    let button = egui::Button::new(RichText::new(name).color(t.on_accent)).fill(t.accent);
                    if ui.add(button).clicked() {
                        next = (!is_last).then_some(index + 1);
                    }
                    if !is_last && ui.button(strings::SKIP).clicked() {
                        next = None;
                    }
                    let progress = strings::progress(index + 1, Step::ALL.len());
                    ui.label(RichText::new(progress).small().color(t.text_weak));
                });
            });
        });
        // The keys apply only if no text field uses them.
        if !ctx.text_edit_focused() {
            let is_pressed = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
            if is_pressed(Key::Escape) {
                next = None;
            } else if is_pressed(Key::Enter) {
                next = (index + 1 < Step::ALL.len()).then_some(index + 1);
            }
        }
        self.step = next;
        next.is_none()
    }
}

/// Position of the card, beside its place and within the window.
fn beside(place: Rect, window: Rect) -> Pos2 {
    /// Approximate size of the card with its margins, in points.
    const ROOM: egui::Vec2 = vec2(WIDTH + 40.0, 190.0);
    let x = if place.width() > 2.0 * ROOM.x {
        place.left() + 24.0
    } else if place.right() + ROOM.x < window.right() {
        place.right() + 12.0
    } else {
        place.left() - ROOM.x
    };
    let y = if place.height() > ROOM.y + 40.0 { place.top() + 40.0 } else { place.top() - ROOM.y };
    let y = if y < window.top() { place.bottom() + 12.0 } else { y };
    egui::pos2(x.max(window.left() + 8.0), y)
}

#[cfg(test)]
mod tests {
    use super::beside;
    use egui::{Rect, pos2};

    /// The card is within the window for every place.
    #[test]
    fn the_card_is_seen_beside_every_place() {
        for (width, height) in [(960.0, 600.0), (1280.0, 720.0), (2560.0, 1440.0)] {
            let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(width, height));
            let places = [
                Rect::from_min_max(pos2(208.0, 38.0), pos2(width - 290.0, height - 240.0)),
                Rect::from_min_max(pos2(0.0, height - 240.0), pos2(0.36 * width, height - 32.0)),
                Rect::from_min_max(pos2(width - 290.0, 38.0), pos2(width, height - 240.0)),
                Rect::from_min_max(pos2(100.0, 4.0), pos2(150.0, 34.0)),
            ];
            for place in places {
                let corner = beside(place, window);
                let card = Rect::from_min_size(corner, egui::vec2(324.0, 170.0));
                assert!(window.contains_rect(card), "{card:?} beside {place:?} in {width} x {height}");
            }
        }
    }
}
