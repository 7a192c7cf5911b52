//! Row about the last estimate: its picture, its position with uncertainty, and how the prompt was interpreted.

use egui::{
    Align, Button, Label, Layout, Rect, RichText, Role, Sense, TextureHandle, Ui, WidgetInfo, pos2, vec2,
};

use super::{Origin, PositionEstimate};
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::look::icons::close_button;
use crate::look::theme::{GAP, RADIUS, tokens};
use crate::panel::Panel;
use crate::strings::prompt as words;

/// Height of the row, in points.
const HEIGHT: f32 = 58.0;
/// Number of nearest textures that are named.
const N_NEAR: usize = 3;

/// Draws the row; returns the requested command. `picture` is the picture on the graphics card, once uploaded.
pub(crate) fn card_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    guess: &PositionEstimate,
    is_busy: bool,
    picture: Option<&TextureHandle>,
) -> Option<Command> {
    let t = tokens(ui.ctx());
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words::guessed(&guess.name)));
    ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
    let side = HEIGHT - 8.0;
    let frame = Rect::from_min_size(area.min + vec2(4.0, 4.0), vec2(side, side));
    if let Some(picture) = picture {
        // Only the middle of a picture that is not square.
        let [width, height] = picture.size().map(|pixels| pixels as f32);
        let (x, y) = (0.5 * (width / height).recip().min(1.0), 0.5 * (width / height).min(1.0));
        let part = Rect::from_min_max(pos2(0.5 - x, 0.5 - y), pos2(0.5 + x, 0.5 + y));
        ui.painter().image(picture.id(), frame, part, egui::Color32::WHITE);
    } else {
        ui.painter().rect_filled(frame, f32::from(RADIUS) - 1.0, t.background);
    }
    let mut asked = None;
    let right = Rect::from_min_max(pos2(area.right() - 118.0, area.top()), area.max - vec2(6.0, 0.0));
    let mut buttons =
        ui.new_child(egui::UiBuilder::new().max_rect(right).layout(Layout::right_to_left(Align::Center)));
    let close = close_button(buttons.ctx());
    if buttons.add(close).accessible_name(words::DISMISS).on_hover_text(words::DISMISS).clicked() {
        asked = Some(PromptCommand::Dismiss);
    }
    if matches!(guess.origin, Origin::Words { .. }) {
        let another = buttons.add_enabled(!is_busy, Button::new(words::ANOTHER));
        if another.on_hover_text(words::ANOTHER_HELP).clicked() {
            asked = Some(PromptCommand::Another);
        }
    }
    let text = Rect::from_min_max(
        pos2(frame.right() + GAP + 2.0, area.top() + 5.0),
        pos2(right.left(), area.bottom()),
    );
    let mut lines = ui.new_child(egui::UiBuilder::new().max_rect(text));
    lines.spacing_mut().item_spacing.y = 2.0;
    let poles = panel.session.poles();
    let along = |axis: usize| words::along(&poles[axis], guess.axes[axis].mean, guess.axes[axis].deviation);
    let place = format!("{} · {}", along(0), along(1));
    lines.add(Label::new(RichText::new(place).strong()).truncate().selectable(false));
    let near = words::near(&nearest(panel, guess));
    lines.add(Label::new(RichText::new(near).small()).truncate().selectable(false));
    let all = guess.said.join(" ");
    let color = if guess.is_disputed { t.warning } else { t.text_weak };
    let said = Label::new(RichText::new(&all).small().color(color)).truncate().selectable(false);
    lines.add(said).on_hover_text(guess.said.join("\n"));
    asked.map(Command::Prompt)
}

/// Names of the nearest textures, nearest first.
fn nearest(panel: &Panel<'_>, guess: &PositionEstimate) -> Vec<String> {
    let at = guess.at();
    let mut near: Vec<(f64, usize)> =
        panel.session.space().sites().iter().map(|(texture, site)| (site.distance(at), *texture)).collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let name = |(_, texture): &(f64, usize)| panel.session.textures()[*texture].name.clone();
    near.iter().take(N_NEAR).map(name).collect()
}
