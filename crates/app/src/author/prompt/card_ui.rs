//! Card about the last estimate, over the map: its picture, its position with uncertainty, and how the prompt was interpreted.

use egui::{
    Align, Button, Color32, Label, Layout, Rect, RichText, Role, Sense, Stroke, StrokeKind, TextureHandle,
    Ui, WidgetInfo, pos2, vec2,
};

use super::{Origin, PositionEstimate};
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::look::icons::close_button;
use crate::look::theme::{GAP, RADIUS, tokens};
use crate::panel::Panel;
use crate::strings::{axes, prompt as words};

/// Height of the picture and its margin, in points: the least height of the card.
const HEIGHT: f32 = 58.0;
/// Maximum width of the card, in points.
const WIDTH: f32 = 640.0;
/// Distance of the card from the upper edge of the map, below the controls of the map, in points.
const BELOW_BAR: f32 = 34.0;
/// Distance of the card from the other edges of the map, in points.
const MARGIN: f32 = 10.0;
/// Distance of the card from the lower edge of the map, above the words of the axis, in points.
const ABOVE_FOOT: f32 = 30.0;
/// Time after a click that closes or moves the card in which clicks at its former place do nothing, in seconds.
const DOUBLE_CLICK_SECS: f64 = 0.6;
/// Number of nearest textures that are named.
const N_NEAR: usize = 3;

/// Place of the card.
#[derive(Clone, Copy, Default)]
pub(crate) struct CardPlace {
    /// Height in the last frame, in points.
    height: Option<f32>,
    /// Area in the last frame in which the card was drawn.
    area: Option<Rect>,
    /// Area of a card that was just closed, or has just moved to the other edge, and the time of that, in seconds.
    closed: Option<(Rect, f64)>,
}

impl CardPlace {
    /// Takes the clicks at the place that a card has just left, so that a second click changes nothing below it.
    /// Called after the map is drawn.
    pub(crate) fn block(&mut self, ui: &Ui) {
        let now_secs = ui.input(|i| i.time);
        self.closed = self.closed.filter(|(_, since)| now_secs - since < DOUBLE_CLICK_SECS);
        if let Some((area, _)) = self.closed {
            ui.interact(area, ui.scope_id().with("closed card"), Sense::CLICK | Sense::DRAG);
        }
    }
}

/// Draws the card over the map, so that the map does not move: at the edge that is farther from the estimated position.
/// Returns the requested command. `picture` is the picture on the graphics card, once uploaded.
pub(crate) fn card_ui(
    ui: &mut Ui,
    map: Rect,
    place: &mut CardPlace,
    panel: &Panel<'_>,
    guess: &PositionEstimate,
    is_busy: bool,
    picture: Option<&TextureHandle>,
) -> Option<Command> {
    let t = tokens(ui.ctx());
    let height = place.height.unwrap_or(HEIGHT);
    let width = (map.width() - 2.0 * MARGIN).min(WIDTH);
    let is_above = guess.at().y() < 50.0;
    let top = if is_above { map.top() + BELOW_BAR } else { map.bottom() - ABOVE_FOOT - height };
    let area = Rect::from_min_size(pos2(map.center().x - 0.5 * width, top), vec2(width, height));
    let now_secs = ui.input(|i| i.time);
    if let Some(before) = place.area.replace(area).filter(|before| !before.intersects(area)) {
        place.closed = Some((before, now_secs));
    }
    // Below the card, nothing is pointed at or clicked.
    let response = ui.interact(area, ui.scope_id().with("card"), Sense::CLICK | Sense::DRAG);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words::guessed(&guess.name)));
    ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
    ui.painter().rect_stroke(area, f32::from(RADIUS), Stroke::new(1.0, t.line), StrokeKind::Inside);
    let side = HEIGHT - 8.0;
    let frame = Rect::from_min_size(area.min + vec2(4.0, 4.0), vec2(side, side));
    if let Some(picture) = picture {
        // Only the middle of a picture that is not square.
        let [width, height] = picture.size().map(|pixels| pixels as f32);
        let (x, y) = (0.5 * (width / height).recip().min(1.0), 0.5 * (width / height).min(1.0));
        let part = Rect::from_min_max(pos2(0.5 - x, 0.5 - y), pos2(0.5 + x, 0.5 + y));
        ui.painter().image(picture.id(), frame, part, Color32::WHITE);
    } else {
        ui.painter().rect_filled(frame, f32::from(RADIUS) - 1.0, t.background);
    }
    let mut asked = None;
    let right = Rect::from_min_max(
        pos2(area.right() - 118.0, area.top()),
        pos2(area.right() - 6.0, area.top() + HEIGHT),
    );
    let mut buttons =
        ui.new_child(egui::UiBuilder::new().max_rect(right).layout(Layout::right_to_left(Align::Center)));
    let close = close_button(buttons.ctx());
    if buttons.add(close).accessible_name(words::DISMISS).on_hover_text(words::DISMISS).clicked() {
        asked = Some(PromptCommand::Dismiss);
        (place.area, place.closed) = (None, Some((area, now_secs)));
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
    position_ui(&mut lines, panel, guess);
    // The prompt box may hold other words by now.
    let near = format!("{} · {}", guess.name, words::near(&nearest(panel, guess)));
    lines.add(Label::new(RichText::new(near).small()).truncate().selectable(false));
    if let Some(command) = materials_ui(&mut lines, guess) {
        asked = Some(command);
    }
    let mut sentences = |said: &[String], color: Color32| {
        if !said.is_empty() {
            let text = RichText::new(said.join(" ")).small().color(color);
            lines.add(Label::new(text).wrap().selectable(false));
        }
    };
    sentences(&guess.doubts, t.warning);
    sentences(&guess.said, if guess.is_disputed { t.warning } else { t.text_weak });
    let needed = (lines.min_rect().bottom() + 5.0 - area.top()).max(HEIGHT);
    if (needed - height).abs() > 0.5 {
        ui.ctx().request_discard("the height of the card has changed");
    }
    place.height = Some(needed);
    asked.map(Command::Prompt)
}

/// Draws the estimated coordinates, and the axes without an estimate.
fn position_ui(ui: &mut Ui, panel: &Panel<'_>, guess: &PositionEstimate) {
    let (names, poles) = (panel.session.axes(), panel.session.poles());
    let (mut told, mut untold) = (Vec::new(), Vec::new());
    for (axis, ((ends, name), estimate)) in poles.iter().zip(names).zip(&guess.axes).enumerate() {
        match guess.mean(axis) {
            Some(mean) => untold.push(axes::untold(name, mean)),
            None => told.push(words::along(ends, estimate.mean, estimate.deviation)),
        }
    }
    let help: Vec<String> = names.iter().zip(poles).map(|(name, ends)| axes::help(name, ends)).collect();
    let position = Label::new(RichText::new(told.join(" · ")).strong()).selectable(false);
    let is_long = panel.session.is_sliced();
    let position = if is_long { position.wrap() } else { position.truncate() };
    if !told.is_empty() {
        ui.add(position).on_hover_text(help.join("\n"));
    }
    if !untold.is_empty() {
        let text = RichText::new(untold.join(" · ")).small().color(tokens(ui.ctx()).text_weak);
        ui.add(Label::new(text).wrap().selectable(false)).on_hover_text(words::UNTOLD_HELP);
    }
}

/// Draws the materials that the picture is likely to show. A click on one takes its lexicon entry; a click on the taken one
/// takes the estimate from the picture again.
fn materials_ui(ui: &mut Ui, guess: &PositionEstimate) -> Option<PromptCommand> {
    if guess.materials.is_empty() {
        return None;
    }
    let mut asked = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.add(Label::new(RichText::new(words::LOOKS_LIKE).small()).selectable(false));
        for material in &guess.materials {
            let is_taken = guess.taken.as_ref() == Some(&material.name);
            let button = Button::new(RichText::new(&material.label).small()).small().selected(is_taken);
            let help =
                if is_taken { words::UNTAKE_HELP.to_owned() } else { words::take_help(&material.name) };
            let button = ui.add_enabled(material.axes.is_some(), button);
            if button.on_hover_text(help).on_disabled_hover_text(words::NO_ENTRY).clicked() {
                asked = Some(PromptCommand::TakeMaterial((!is_taken).then(|| material.name.clone())));
            }
        }
    });
    asked
}

/// Names of the nearest textures of the selected authored texture, nearest first, without the one that was simulated from the picture.
fn nearest(panel: &Panel<'_>, guess: &PositionEstimate) -> Vec<String> {
    let at = guess.at();
    let textures = panel.session.textures();
    let sites = panel.session.placed_for(&panel.project.texture().blend).into_iter();
    let others = sites.filter(|(texture, _)| textures[*texture].picture.as_ref() != Some(&*guess.picture));
    let mut near: Vec<(f64, usize)> = others.map(|(texture, site)| (site.distance(at), texture)).collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let name = |(_, texture): &(f64, usize)| textures[*texture].name.clone();
    near.iter().take(N_NEAR).map(name).collect()
}
