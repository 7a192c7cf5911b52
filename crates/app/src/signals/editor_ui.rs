//! Tools of the editor.

use egui::{Button, DragValue, Label, RichText, Ui};
use shagreen_core::signals::spatial_spectrogram::edit::STRETCHES;

use super::editor::{Editor, GAINS_DB, RADII_MM, RADII_OCTAVES};
use super::number_ui::number_ui;
use crate::choices::signals::Tool;
use crate::look::theme::{GROUP_GAP, tokens};
use crate::look::together::together_ui;
use crate::strings::signals as strings;

/// Draws the tools; returns whether B is to be stretched.
pub(super) fn tools_ui(ui: &mut Ui, editor: &mut Editor) -> bool {
    let t = tokens(ui.ctx());
    let mut is_stretched = false;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let words = RichText::new(strings::PAINT_B).color(t.text_weak);
        ui.add(Label::new(words).selectable(false)).on_hover_text(strings::PAINT_B_HELP);
        for tool in Tool::ALL {
            let can_be_used = tool != Tool::Paste || editor.has_copy();
            let button = Button::selectable(editor.tool == tool, strings::tool(tool));
            let button = ui.add_enabled(can_be_used, button).on_hover_text(strings::tool_help(tool));
            if button.on_disabled_hover_text(strings::NOTHING_TO_PASTE).clicked() {
                editor.tool = tool;
            }
        }
        ui.add_space(GROUP_GAP);
        // Shown with every tool, so that the controls beside them do not move.
        let is_brush = editor.tool.is_brush();
        let width = DragValue::new(&mut editor.radius_mm).range(RADII_MM).speed(0.05).fixed_decimals(2);
        let width = width.prefix("± ").suffix(" mm");
        brush_ui(ui, is_brush, strings::BRUSH_WIDTH, strings::BRUSH_WIDTH_HELP, width);
        let height = DragValue::new(&mut editor.radius_octaves).range(RADII_OCTAVES).speed(0.01);
        let height = height.prefix("± ").suffix(" oct").fixed_decimals(2);
        brush_ui(ui, is_brush, strings::BRUSH_HEIGHT, strings::BRUSH_HEIGHT_HELP, height);
        let gain = DragValue::new(&mut editor.gain_db).range(GAINS_DB).speed(0.1).suffix(" dB");
        let gain = gain.fixed_decimals(1);
        brush_ui(ui, is_brush, strings::BRUSH_GAIN, strings::BRUSH_GAIN_HELP, gain);
        ui.add_space(GROUP_GAP);
        together_ui(ui, "stretch", |ui| {
            is_stretched = ui.button(strings::STRETCH).on_hover_text(strings::STRETCH_HELP).clicked();
            let stretch = DragValue::new(&mut editor.stretch).range(STRETCHES).speed(0.02).prefix("× ");
            let stretch = stretch.fixed_decimals(2);
            ui.add(stretch).accessible_name(strings::STRETCH_FACTOR).on_hover_text(strings::STRETCH_HELP);
        });
    });
    is_stretched
}

/// Draws a setting of the brush, which is enabled only while the tool is a brush. Its name and its number stay together.
fn brush_ui(ui: &mut Ui, is_brush: bool, name: &str, help: &str, value: DragValue<'_>) {
    together_ui(ui, name, |ui| {
        ui.add_enabled_ui(is_brush, |ui| number_ui(ui, name, name, help, value));
    });
}
