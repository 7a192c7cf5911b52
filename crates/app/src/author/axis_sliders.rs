//! Sliders of the axes: those of the canvas, and a group of the further ones, each with a button that moves the point to the
//! local mean of the textures.

use egui::{Align, CollapsingHeader, Label, Layout, RichText, Slider, Ui, vec2};

use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::look::icons::{ICON_RESTART_ALT, ICON_TUNE, icon_button};
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, axes as words};

/// Width of the number of a slider, in points.
const NUMBER_WIDTH: f32 = 66.0;
/// Width of the button that opens the choice of axes, in points.
const CHOICE_WIDTH: f32 = 22.0;

/// Draws the sliders, which show the authored point and move it. Returns the requested commands.
pub(crate) fn axis_sliders(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    let at = panel.session.fitted(panel.inspected().at);
    let mut moved = at;
    let poles = panel.session.poles();
    for (axis, ends) in poles.iter().enumerate().take(2) {
        let mut value = at.get(axis).unwrap_or_default();
        commands.extend(ends_ui(ui, ends, axis == 0));
        if slider_ui(ui, &mut value, ends) {
            moved = moved.with(axis, value);
        }
    }
    let n_further = poles.len().saturating_sub(2);
    if n_further > 0 {
        let header = CollapsingHeader::new(words::further(n_further)).id_salt("further axes");
        let shown = header.default_open(true).show_unindented(ui, |ui| {
            for (axis, ends) in poles.iter().enumerate().skip(2) {
                let mut value = at.get(axis).unwrap_or_default();
                commands.extend(name_ui(ui, panel, axis));
                ends_ui(ui, ends, false);
                if slider_ui(ui, &mut value, ends) {
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

/// Draws the name of a further axis, and the button that moves the point to its local mean.
fn name_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize) -> Option<Command> {
    let name = panel.session.axes().get(axis)?;
    let mut is_reset = false;
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        let button = ui.add(icon_button(ICON_RESTART_ALT).small().frame(false));
        let button = button.accessible_name(words::reset(name)).on_hover_text(words::reset_help(name));
        is_reset = button.clicked();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.add(Label::new(words::name(name)).truncate().selectable(false));
        });
    });
    ui.add_space(-ui.spacing().item_spacing.y);
    is_reset.then_some(Command::Axes(AxesCommand::Reset(axis)))
}

/// Draws the words at both ends of an axis, with the button that opens the choice of axes between them if it is wanted.
fn ends_ui(ui: &mut Ui, ends: &[String; 2], with_choice: bool) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut is_asked = false;
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(&ends[0]).color(t.text_weak)).selectable(false));
        if with_choice {
            // Centered, whatever the length of the words.
            let row = ui.max_rect();
            ui.add_space((row.center().x - 0.5 * CHOICE_WIDTH - ui.cursor().left()).max(0.0));
            let button = ui.add(icon_button(ICON_TUNE).small().frame(false));
            let button = button.accessible_name(words::BUTTON);
            is_asked = button.on_hover_text(format!("{}\n{}", words::BUTTON, words::BUTTON_HELP)).clicked();
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add(Label::new(RichText::new(&ends[1]).color(t.text_weak)).selectable(false));
        });
    });
    // The labels belong to the slider.
    ui.add_space(-ui.spacing().item_spacing.y);
    is_asked.then_some(Command::Axes(AxesCommand::Open))
}

/// Draws the slider of one axis; returns whether it was moved.
fn slider_ui(ui: &mut Ui, value: &mut f64, ends: &[String; 2]) -> bool {
    let width = ui.available_width();
    ui.spacing_mut().slider_width = width - NUMBER_WIDTH;
    // Displayed with one decimal but not rounded to it: a slider that rounds would edit the project by itself.
    let one_decimal = |value: f64, _| format!("{value:.1}");
    let slider = Slider::new(value, 0.0..=100.0).custom_formatter(one_decimal).smart_aim(false);
    let slider = ui.add(slider).accessible_name(strings::axis(ends));
    slider.on_hover_text(strings::axis_help(ends)).changed()
}
