//! Sliders of the axes: those of the canvas, and a group of the further ones, each with a button that moves the point to the
//! local mean of the textures.

use egui::{Align, Button, CollapsingHeader, Label, Layout, RichText, Slider, TextStyle, Ui, vec2};

use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::look::icons::{ICON_RESTART_ALT, ICON_TUNE, icon_button};
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, axes as words};

/// Width of the number of a slider, in points.
const NUMBER_WIDTH: f32 = 66.0;
/// Width of the button that opens the choice of axes where only its icon fits, in points.
const ICON_WIDTH: f32 = 22.0;
/// Heights of the words and of the slider of an axis, and distance between rows, in a space with further axes, in points: with
/// three of them, the mode and the contributions begin above the lower edge of a window of 1280 by 720.
const COMPACT_WORDS: f32 = 16.0;
const COMPACT_SLIDER: f32 = 20.0;
const COMPACT_GAP: f32 = 3.0;

/// Draws the sliders, which show the authored point and move it. Returns the requested commands.
pub(crate) fn axis_sliders(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let sliders = ui.scope(|ui| {
        if !panel.session.is_sliced() {
            let height = ui.spacing().interact_size.y;
            return sliders_ui(ui, panel, height);
        }
        ui.spacing_mut().item_spacing.y = COMPACT_GAP;
        ui.spacing_mut().interact_size.y = COMPACT_SLIDER;
        ui.spacing_mut().button_padding.y = 1.0;
        sliders_ui(ui, panel, COMPACT_WORDS)
    });
    sliders.inner
}

/// Draws all sliders, each below a row of words of this height.
fn sliders_ui(ui: &mut Ui, panel: &Panel<'_>, words_height: f32) -> Vec<Command> {
    let mut commands = Vec::new();
    let at = panel.session.fitted(panel.inspected().at);
    let mut moved = at;
    let poles = panel.session.poles();
    for (axis, ends) in poles.iter().enumerate().take(2) {
        let mut value = at.get(axis).unwrap_or_default();
        commands.extend(ends_ui(ui, ends, words_height, axis == 0));
        if slider_ui(ui, panel, axis, &mut value) {
            moved = moved.with(axis, value);
        }
    }
    let n_further = poles.len().saturating_sub(2);
    if n_further > 0 {
        let header = CollapsingHeader::new(words::further(n_further)).id_salt("further axes");
        let shown = header.default_open(true).show_unindented(ui, |ui| {
            for axis in 2..poles.len() {
                let mut value = at.get(axis).unwrap_or_default();
                commands.extend(name_ui(ui, panel, axis, words_height));
                if slider_ui(ui, panel, axis, &mut value) {
                    moved = moved.with(axis, value);
                }
            }
        });
        shown.header_response.on_hover_text(words::FURTHER_HELP);
    }
    if moved != at {
        commands.push(Command::Edit(Edit::MovePoint(moved)));
    }
    commands
}

/// Draws the name of a further axis, the words at its ends if there is room and the name does not say them, and the button that moves
/// the point to its local mean.
fn name_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize, height: f32) -> Option<Command> {
    let t = tokens(ui.ctx());
    let (name, ends) = (panel.session.axes().get(axis)?, panel.session.poles().get(axis)?);
    let mut is_reset = false;
    let row = vec2(ui.available_width(), height);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        let button = ui.add(icon_button(ICON_RESTART_ALT).small().frame(false));
        let button = button.accessible_name(words::reset(name)).on_hover_text(words::reset_help(name));
        is_reset = button.clicked();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let label = |text: RichText| Label::new(text.small()).truncate().selectable(false);
            ui.add(label(RichText::new(words::name(name)))).on_hover_ui(|ui| help_ui(ui, panel, axis));
            // The tooltip has the words that do not fit.
            let ends = words::ends(name, ends);
            if let Some(ends) =
                ends.filter(|ends| text_width(ui, ends, &TextStyle::Small) <= ui.available_width())
            {
                let ends = label(RichText::new(ends).color(t.text_weak));
                ui.add(ends).on_hover_ui(|ui| help_ui(ui, panel, axis));
            }
        });
    });
    ui.add_space(-ui.spacing().item_spacing.y);
    is_reset.then_some(Command::Axes(AxesCommand::Reset(axis)))
}

/// Draws the words at both ends of an axis in a row of this height, with the button that opens the choice of axes between them if it
/// is wanted.
fn ends_ui(ui: &mut Ui, ends: &[String; 2], height: f32, with_choice: bool) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut is_asked = false;
    let row = vec2(ui.available_width(), height);
    ui.allocate_ui_with_layout(row, Layout::left_to_right(Align::Center), |ui| {
        ui.add(Label::new(RichText::new(&ends[0]).color(t.text_weak)).selectable(false));
        if with_choice {
            is_asked = choice_ui(ui, &ends[1]);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add(Label::new(RichText::new(&ends[1]).color(t.text_weak)).selectable(false));
        });
    });
    // The labels belong to the slider.
    ui.add_space(-ui.spacing().item_spacing.y);
    is_asked.then_some(Command::Axes(AxesCommand::Open))
}

/// Draws the button that opens the choice of axes in the middle of a row that ends with a word. It has its name, or only an icon if
/// the words leave no room. Returns whether it was clicked.
fn choice_ui(ui: &mut Ui, high_end: &str) -> bool {
    let named = text_width(ui, words::BUTTON, &TextStyle::Small) + 2.0 * ui.spacing().button_padding.x;
    let (row, left) = (ui.max_rect(), ui.cursor().left());
    let right = row.right() - text_width(ui, high_end, &TextStyle::Body) - ui.spacing().item_spacing.x;
    // Centered, whatever the length of the words.
    let fits = |width: f32| row.center().x - 0.5 * width >= left && row.center().x + 0.5 * width <= right;
    let (button, width) = if fits(named) {
        (Button::new(RichText::new(words::BUTTON).small()).small(), named)
    } else {
        (icon_button(ICON_TUNE).small().frame(false), ICON_WIDTH)
    };
    ui.add_space((row.center().x - 0.5 * width - left).max(0.0));
    let button = ui.add(button).accessible_name(words::BUTTON);
    button.on_hover_text(format!("{}\n{}", words::BUTTON, words::BUTTON_HELP)).clicked()
}

/// Width of a text in one line, in points.
fn text_width(ui: &Ui, text: &str, style: &TextStyle) -> f32 {
    let (font, color) = (style.resolve(ui.style()), ui.visuals().text_color());
    ui.painter().layout_no_wrap(text.to_owned(), font, color).size().x
}

/// Draws the slider of an axis of the space; returns whether it was moved.
fn slider_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize, value: &mut f64) -> bool {
    let Some(ends) = panel.session.poles().get(axis) else { return false };
    let width = ui.available_width();
    ui.spacing_mut().slider_width = width - NUMBER_WIDTH;
    // Displayed with one decimal but not rounded to it: a slider that rounds would edit the project by itself. So would its number
    // when it loses the focus, unless a text that nobody has changed is the value itself.
    let exact = *value;
    let parser = move |text: &str| if text == shown(exact) { Some(exact) } else { parsed(text) };
    let slider = Slider::new(value, 0.0..=100.0).custom_formatter(|value, _| shown(value));
    let slider = ui.add(slider.custom_parser(parser).smart_aim(false)).accessible_name(strings::axis(ends));
    slider.on_hover_ui(|ui| help_ui(ui, panel, axis)).changed()
}

/// A coordinate as the number of a slider shows it.
fn shown(value: f64) -> String {
    format!("{value:.1}")
}

/// A number that a user has written; a decimal comma is a point.
fn parsed(text: &str) -> Option<f64> {
    text.trim().replace(',', ".").parse().ok()
}

/// Draws the help of an axis of the space, in a tooltip.
fn help_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize) {
    ui.set_max_width(ui.spacing().tooltip_width);
    ui.label(help(panel, axis));
}

/// Words at both ends of an axis, their meaning, and the range of the textures.
fn help(panel: &Panel<'_>, axis: usize) -> String {
    let (axes, poles) = (panel.session.axes(), panel.session.poles());
    let (Some(name), Some(ends)) = (axes.get(axis), poles.get(axis)) else { return String::new() };
    let mut lines = vec![strings::axis(ends), words::help(name, ends)];
    let around = |range: Option<[f64; 2]>, value: f64| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    };
    let values = panel.session.placed().filter_map(|(_, at)| at.get(axis));
    lines.extend(values.fold(None, around).map(words::range));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::parsed;

    #[test]
    fn written_numbers_have_a_decimal_point_or_comma() {
        let numbers = ["48.9", " 48,9 ", "7", "rough", ""].map(parsed);
        assert_eq!(numbers, [Some(48.9), Some(48.9), Some(7.0), None, None]);
    }
}
