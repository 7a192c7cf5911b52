//! Tour of four places of the window, each with a card beside it. Only the place of the card takes clicks.

use egui::{
    Area, Button, Color32, Context, Frame, Id, Key, LayerId, Modifiers, Order, Pos2, Rect, RichText, Sense,
    Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2,
};

use super::STATUS_HEIGHT;
use crate::choices::tour::Step;
use crate::look::primary::primary_button;
use crate::look::theme::{GAP, LIBRARY_WIDTH, RADIUS, tokens};
use crate::strings::help as strings;

/// Width of the content of a card, in points. The card fits into the right column.
const WIDTH: f32 = 256.0;
/// Minimum height of the text of a card, in points. The longest text determines it, so that the buttons of all cards
/// stand at the same place.
const TEXT_HEIGHT: f32 = 160.0;
/// Size of a card in its first frame, in points.
const CARD: Vec2 = vec2(282.0, 230.0);
/// Distance between the place of a card and its frame, in points: the frame crosses no control.
const AROUND_PLACE: f32 = 4.0;
/// Distance of a card from the edges of the window, in points.
const EDGE: f32 = 2.0;
/// Minimum width of the buttons that lead to another card, in points.
const BUTTON: Vec2 = vec2(52.0, 24.0);
/// Width that stays free for the file menu, in points.
const MENU_WIDTH: f32 = 264.0;
/// Distance between a card and its place from which a line connects them, in points.
const FAR: f32 = 24.0;
/// Distance of the end of this line from the top of the card, in points.
const LINE_DROP: f32 = 24.0;
/// Time after a click on a card in which a second click at the same place does nothing, in seconds.
const DOUBLE_CLICK_SECS: f64 = 0.6;
/// Darkening of everything outside the place of a card.
const SHADE: Color32 = Color32::from_black_alpha(90);

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
    /// Rectangle of the card in the last frame.
    card: Rect,
    /// Rectangle of the card that was left, and the time when it was left, in seconds.
    left: Option<(Rect, f64)>,
}

/// What the user asks of a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Back,
    Next,
    End,
}

impl Default for Tour {
    fn default() -> Self {
        let card = Rect::from_min_size(Pos2::ZERO, CARD);
        Self { step: None, places: [Rect::NOTHING; Step::ALL.len()], card, left: None }
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
        let now_secs = ctx.input(|i| i.time);
        self.left = self.left.filter(|(_, since)| now_secs - since < DOUBLE_CLICK_SECS);
        if self.step.is_some() || self.left.is_some() {
            // It is there before the card moves away, so that it works at once.
            let card = self.left.map_or(self.card, |(card, _)| card);
            block(ctx, "tour card left", card, Color32::TRANSPARENT);
        }
        let Some(index) = self.step else { return false };
        let window = ctx.content_rect();
        let place = self.places[index].intersect(window);
        if !place.is_positive() {
            // The place is not laid out yet.
            return false;
        }
        highlight(ctx, place.expand(AROUND_PLACE).intersect(window), window);
        let corner = beside(Step::ALL[index], place, window, self.card.size());
        let (card, asked) = card_ui(ctx, index, corner);
        self.card = card;
        lead(ctx, place.expand(AROUND_PLACE), card);
        let Some(asked) = asked.or_else(|| pressed(ctx)) else { return false };
        self.left = Some((card, now_secs));
        ctx.request_repaint_after_secs(DOUBLE_CLICK_SECS as f32);
        self.step = match asked {
            Asked::Back => Some(index.saturating_sub(1)),
            Asked::Next => Some(index + 1).filter(|next| *next < Step::ALL.len()),
            Asked::End => None,
        };
        self.step.is_none()
    }
}

/// Draws the card of a step with its upper left corner at `corner`; returns its rectangle and what was asked.
fn card_ui(ctx: &Context, index: usize, corner: Pos2) -> (Rect, Option<Asked>) {
    let mut asked = None;
    let card = Area::new(Id::unique("tour")).order(Order::Foreground).fixed_pos(corner);
    let shown = card.show(ctx, |ui| {
        let t = tokens(ui.ctx());
        Frame::popup(ui.style()).fill(t.raised).inner_margin(12.0).show(ui, |ui| {
            ui.set_width(WIDTH);
            ui.vertical(|ui| {
                ui.set_min_height(TEXT_HEIGHT);
                let [heading, words] = strings::step(Step::ALL[index]);
                ui.label(RichText::new(heading).heading().strong());
                ui.label(words);
            });
            ui.add_space(GAP);
            ui.horizontal(|ui| asked = buttons_ui(ui, index));
        });
    });
    (shown.response.rect, asked)
}

fn buttons_ui(ui: &mut Ui, index: usize) -> Option<Asked> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    let is_last = index + 1 == Step::ALL.len();
    if ui.add_enabled(index > 0, Button::new(strings::BACK).min_size(BUTTON)).clicked() {
        asked = Some(Asked::Back);
    }
    let name = if is_last { strings::DONE } else { strings::NEXT };
    if ui.add(primary_button(t, name, true).min_size(BUTTON)).clicked() {
        asked = Some(Asked::Next);
    }
    if !is_last && ui.button(strings::SKIP).clicked() {
        asked = Some(Asked::End);
    }
    let progress = strings::progress(index + 1, Step::ALL.len());
    ui.label(RichText::new(progress).small().color(t.text_weak));
    asked
}

/// What the keys ask; they apply only if no text field uses them.
fn pressed(ctx: &Context) -> Option<Asked> {
    if ctx.text_edit_focused() {
        return None;
    }
    let is_pressed = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    if is_pressed(Key::Escape) { Some(Asked::End) } else { is_pressed(Key::Enter).then_some(Asked::Next) }
}

/// Frames the place of a card, with its margin. Everything around it is darkened and takes no clicks. Menus stay above.
fn highlight(ctx: &Context, place: Rect, window: Rect) {
    let rect = |left, top, right, bottom| Rect::from_min_max(pos2(left, top), pos2(right, bottom));
    for (name, part) in [
        ("tour above", rect(window.left(), window.top(), window.right(), place.top())),
        ("tour below", rect(window.left(), place.bottom(), window.right(), window.bottom())),
        ("tour before", rect(window.left(), place.top(), place.left(), place.bottom())),
        ("tour after", rect(place.right(), place.top(), window.right(), place.bottom())),
    ] {
        if part.is_positive() {
            block(ctx, name, part, SHADE);
        }
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Middle, Id::unique("tour place")));
    let stroke = Stroke::new(2.5, tokens(ctx).warning);
    painter.rect_stroke(place, f32::from(RADIUS), stroke, StrokeKind::Inside);
}

/// Draws a line from the frame of a place down and to the right, to a card that does not lie beside the place.
fn lead(ctx: &Context, place: Rect, card: Rect) {
    if place.expand(FAR).intersects(card) {
        return;
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Middle, Id::unique("tour place")));
    let (from, to) = (place.center_bottom(), pos2(card.left(), card.top() + LINE_DROP));
    let stroke = Stroke::new(2.5, tokens(ctx).warning);
    painter.add(Shape::line(vec![from, pos2(from.x, to.y), to], stroke));
}

/// Covers a part of the window, which then takes no clicks.
fn block(ctx: &Context, name: &str, part: Rect, color: Color32) {
    let cover = Area::new(Id::unique(name))
        .order(Order::Middle)
        .fixed_pos(part.min)
        .constrain(false)
        .fade_in(false)
        // Without the keyboard focus.
        .sense(Sense::CLICK | Sense::DRAG);
    cover.show(ctx, |ui| {
        ui.painter().rect_filled(part, 0.0, color);
        ui.allocate_space(part.size());
    });
}

/// Upper left corner of a card of this size: beside its place and within the window, above the status bar.
fn beside(step: Step, place: Rect, window: Rect, size: Vec2) -> Pos2 {
    let within = window.with_max_y(window.bottom() - STATUS_HEIGHT).shrink(EDGE);
    let free = kept_free(step, place, window);
    let top = if step == Step::Keep { place.bottom() + GAP } else { place.top() };
    let y = top.min(within.bottom() - size.y).max(within.top());
    let x = place.left().min(within.right() - size.x).max(within.left());
    let corners = [
        pos2(free.right() + GAP, y),
        pos2(free.left() - GAP - size.x, y),
        pos2(x, free.top() - GAP - size.y),
        pos2(x, free.bottom() + GAP),
    ];
    let fits = |corner: &Pos2| within.contains_rect(Rect::from_min_size(*corner, size));
    corners.into_iter().find(fits).unwrap_or(pos2(x, y))
}

/// Part of the window that the card of a step does not cover: its place, and all else that its text names.
fn kept_free(step: Step, place: Rect, window: Rect) -> Rect {
    match step {
        Step::Drag | Step::Stroke | Step::Blend => place,
        Step::Keep => {
            // The file menu, and the button Add of the left column.
            let right = (place.left() + MENU_WIDTH).max(LIBRARY_WIDTH);
            Rect::from_min_max(window.min, pos2(right, window.bottom()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CARD, STATUS_HEIGHT, Step, beside, kept_free};
    use egui::{Rect, pos2};

    /// Every card is within the window and covers neither its place, nor what its text names, nor the status bar. The last
    /// one is as near to its menu as the open menu allows.
    #[test]
    fn the_card_is_seen_beside_every_place() {
        for (width, height) in [(960.0, 600.0), (1280.0, 720.0), (2560.0, 1440.0)] {
            let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(width, height));
            let places = [
                Rect::from_min_max(pos2(214.0, 74.0), pos2(width - 296.0, height - 240.0)),
                Rect::from_min_max(pos2(0.0, height - 240.0), pos2(0.46 * width, height - 32.0)),
                Rect::from_min_max(pos2(width - 290.0, 38.0), pos2(width, height - 240.0)),
                Rect::from_min_max(pos2(100.0, 4.0), pos2(150.0, 34.0)),
            ];
            for (step, place) in Step::ALL.into_iter().zip(places) {
                let card = Rect::from_min_size(beside(step, place, window, CARD), CARD);
                let seen = window.with_max_y(height - STATUS_HEIGHT);
                assert!(seen.contains_rect(card), "{card:?} beside {place:?} in {width} x {height}");
                assert!(step != Step::Keep || card.left() < place.left() + 275.0, "{card:?}");
                let free = kept_free(step, place, window);
                assert!(!card.intersects(free), "{card:?} covers {free:?} in {width} x {height}");
            }
        }
    }
}
