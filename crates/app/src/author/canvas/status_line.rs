//! Strip below the canvas about the audible texture: the texture that plays alone, with the buttons that keep it or leave it,
//! the path, extrapolation, the convex hull or jumps.

use std::sync::Arc;

use egui::{Align, Button, Color32, FontId, Label, Layout, Rect, RichText, Ui, UiBuilder, pos2, vec2};
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
/// `axis_words`. With `asks_for_path`, it says how a path is drawn; with `is_narrow` and nothing else to say, it has the legend of
/// a slice. Returns the requested command.
pub(super) fn foot_ui(
    ui: &mut Ui,
    outer: Rect,
    axis_words: &[Rect],
    panel: &Panel<'_>,
    [asks_for_path, is_narrow]: [bool; 2],
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
    let (text, color) =
        asked.or_else(|| message(panel, is_path, t)).or_else(|| legend(panel, is_narrow, t))?;
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

/// Legend of a slice, if the canvas is too narrow for it elsewhere.
fn legend(panel: &Panel<'_>, is_narrow: bool, t: &Tokens) -> Option<(String, Color32)> {
    let is_shown = is_narrow && panel.session.is_sliced();
    is_shown.then(|| (strings::axes::slice(panel.session.n_axes()), t.text_weak))
}

fn message(panel: &Panel<'_>, is_path: bool, t: &Tokens) -> Option<(String, Color32)> {
    let authored = panel.session.authored()?;
    let says = |text: &str, color: Color32| Some((text.to_owned(), color));
    if is_path && panel.session.touch().contact.force_n <= 0.0 {
        says(strings::path::WAITS, t.accent)
    } else if authored.mode.makes_a_model() && authored.model.is_none() && !panel.session.is_preparing() {
        says(strings::NO_TEXTURE_HERE, t.error)
    } else if authored.is_extrapolated && authored.location.clamped {
        Some((strings::extrapolated_to(authored.location.at), t.warning))
    } else if authored.is_extrapolated {
        says(strings::EXTRAPOLATED_HERE, t.warning)
    } else if authored.location.clamped {
        says(strings::CLAMPED, t.warning)
    } else if authored.mode != Mode::Paper {
        None
    } else if is_near_an_edge(authored) {
        says(strings::JUMPS_HERE, t.warning)
    } else {
        says(strings::JUMPS, t.text_weak)
    }
}

/// Whether a small step leads into another triangle. At the position of a texture nothing jumps.
fn is_near_an_edge(authored: &Authored) -> bool {
    let shares = || authored.location.corners.iter().map(|(_, share)| *share);
    let n_far = shares().filter(|share| *share > NEAR_AN_EDGE).count();
    n_far == 2
}
