//! Strip below the canvas about the audible texture: the texture that plays alone, with the buttons that keep it or leave it,
//! the path, extrapolation, the convex hull or jumps.

use std::sync::Arc;

use egui::{Align, Button, Color32, FontId, Label, Layout, Rect, RichText, Ui, UiBuilder, pos2, vec2};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Authored;
use shagreen_core::texture::blend::Mode;

use super::FOOT;
use crate::author::exact::{is_own_exactly, taken};
use crate::command::Command;
use crate::look::theme::{GAP, RADIUS, Tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, textures as words};

/// Smallest width of the strip, in points. If the words of the x axis leave less, the strip covers them.
const LEAST_WIDTH: f32 = 240.0;
/// Width of the buttons of the strip, in points.
const BUTTONS: f32 = 160.0;
/// Height of these buttons, in points.
const BUTTON: f32 = 20.0;
/// Font size of the message, in points.
const SIZE: f32 = 12.5;
/// Barycentric weight up to which the point counts as near the opposite edge of the triangle.
const NEAR_AN_EDGE: f64 = 0.05;

/// Draws the strip at the lower edge of the canvas `outer`, between the words of the x axis, which are the first two of
/// `axis_words`. With `asks_for_path`, it says how a path is drawn; with nothing else to say, it has the lines of a `legend`. Returns
/// the requested command.
pub(super) fn foot_ui(
    ui: &mut Ui,
    outer: Rect,
    axis_words: &[Rect],
    panel: &Panel<'_>,
    (asks_for_path, legend): (bool, &[String]),
    t: &Tokens,
) -> Option<Command> {
    let [low, high, ..] = axis_words[..] else { return None };
    let mut row = Rect::from_min_max(
        pos2(low.right() + GAP, outer.bottom() - FOOT + 1.0),
        pos2(high.left() - GAP, outer.bottom() - 2.0),
    );
    if row.width() < LEAST_WIDTH {
        row = Rect::from_x_y_ranges(outer.shrink(GAP).x_range(), row.y_range());
    }
    let is_path = panel.session.path_point().is_some();
    // A generated texture that is the authored one leaves nothing to be chosen.
    let alone = panel.solo().filter(|texture| !is_own_exactly(panel, *texture));
    if let Some(texture) = alone.filter(|_| !is_path && !asks_for_path) {
        return solo_ui(ui, row, panel, texture, t);
    }
    let asked = asks_for_path.then(|| (strings::path::DRAW_ONE.to_owned(), t.accent));
    let legend = (!legend.is_empty()).then(|| (legend.join(". "), t.text_weak));
    let (text, color) = asked.or_else(|| message(panel, is_path, t)).or(legend)?;
    let mut job = egui::text::LayoutJob::simple(text, FontId::proportional(SIZE), color, row.width());
    job.halign = Align::Center;
    let galley = ui.painter().layout_job(job);
    let place = pos2(row.center().x, row.bottom() - 2.0 - galley.size().y);
    // Several lines reach up to where names of textures lie.
    let area = galley.rect.translate(place.to_vec2()).expand(3.0);
    ui.painter().rect_filled(area, f32::from(RADIUS), t.background);
    ui.painter().galley(place, Arc::clone(&galley), color);
    None
}

/// Draws which texture plays alone, and the buttons that make the authored texture exactly this one or return to it.
fn solo_ui(ui: &mut Ui, row: Rect, panel: &Panel<'_>, texture: usize, t: &Tokens) -> Option<Command> {
    let mut asked = None;
    let text = strings::plays_alone(&panel.session.textures().get(texture)?.name);
    let written = ui.painter().layout_no_wrap(text.clone(), FontId::proportional(SIZE), t.accent).size().x;
    let width = (written + BUTTONS + 2.0 * GAP).min(row.width());
    let area = Rect::from_center_size(row.center(), vec2(width, row.height()));
    ui.painter().rect_filled(area, f32::from(RADIUS), t.background);
    let layout = Layout::right_to_left(Align::Center);
    let mut strip = ui.new_child(UiBuilder::new().max_rect(area).layout(layout));
    strip.spacing_mut().item_spacing.x = 4.0;
    strip.spacing_mut().button_padding = vec2(6.0, 1.0);
    strip.spacing_mut().interact_size.y = BUTTON;
    let back = strip.add(Button::new(RichText::new(words::BACK).small())).accessible_name(words::BACK_NAME);
    if back.on_hover_text(words::BACK_HELP).clicked() {
        asked = Some(Edit::Solo(None));
    }
    let taken = taken(panel, texture);
    let choose = strip.add_enabled(taken.is_some(), Button::new(RichText::new(words::CHOOSE).small()));
    let choose = choose.on_hover_text(words::CHOOSE_HELP).on_disabled_hover_text(words::NO_POSITION);
    if choose.clicked() {
        asked = taken;
    }
    strip.add(Label::new(RichText::new(text).size(SIZE).color(t.accent)).truncate().selectable(false));
    asked.map(Command::Edit)
}

fn message(panel: &Panel<'_>, is_path: bool, t: &Tokens) -> Option<(String, Color32)> {
    let authored = panel.session.authored()?;
    let says = |text: &str, color: Color32| Some((text.to_owned(), color));
    let moved = moved_axis(panel, authored);
    if is_path && panel.session.touch().contact.force_n <= 0.0 {
        says(strings::path::WAITS, t.accent)
    } else if authored.mode.makes_a_model() && authored.model.is_none() && !panel.session.is_preparing() {
        says(strings::NO_TEXTURE_HERE, t.error)
    } else if authored.is_extrapolated && moved.is_some() {
        Some((strings::extrapolated_to(authored.location.at), t.warning))
    } else if authored.is_extrapolated {
        says(strings::EXTRAPOLATED_HERE, t.warning)
    } else if let Some(axis) = moved {
        Some((outside(panel, authored.location.at, axis), t.warning))
    } else if authored.mode != Mode::Paper {
        None
    } else if is_near_an_edge(authored) {
        says(strings::JUMPS_HERE, t.warning)
    } else {
        says(strings::JUMPS, t.text_weak)
    }
}

/// Point that plays: that of the texture that the inspector shows, or of the path.
pub(super) fn played_point(panel: &Panel<'_>) -> SpacePoint {
    panel.session.fitted(panel.session.path_point().unwrap_or(panel.inspected().at))
}

/// Axis on which the point that plays differs most from the one that was authored, because the latter lies outside the convex hull;
/// `None` inside, and if the two look the same.
pub(super) fn moved_axis(panel: &Panel<'_>, authored: &Authored) -> Option<usize> {
    if authored.location.clamped {
        played_point(panel).most_different_axis(authored.location.at)
    } else {
        None
    }
}

/// Says that the nearest point of the hull plays. Where the canvas does not show the hull, it says which coordinate differs most.
fn outside(panel: &Panel<'_>, used: SpacePoint, axis: usize) -> String {
    let values = || Some((panel.session.axes().get(axis)?, used.get(axis)?, played_point(panel).get(axis)?));
    match values().filter(|_| panel.session.is_sliced()) {
        Some((name, used, wanted)) => strings::axes::nearest(name, used, wanted),
        None => strings::CLAMPED.to_owned(),
    }
}

/// Whether a small step leads into another triangle. At the position of a texture nothing jumps.
fn is_near_an_edge(authored: &Authored) -> bool {
    let shares = || authored.location.corners.iter().map(|(_, share)| *share);
    let n_far = shares().filter(|share| *share > NEAR_AN_EDGE).count();
    n_far == 2
}
