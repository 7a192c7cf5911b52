//! Choice of the interpolation mode and its options.

use egui::{Button, Checkbox, ComboBox, Label, RichText, Ui, vec2};
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_core::texture::blend::Mode;

use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, axes};

/// Height of the options row, in points: equal for all modes, so that nothing below it moves.
const ROW_HEIGHT: f32 = 24.0;

/// Draws the mode and its options; returns the requested command.
pub fn blend_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Command> {
    let chosen = mode_ui(ui, panel);
    let size = vec2(ui.available_width(), ROW_HEIGHT);
    let row = ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_height(ROW_HEIGHT);
        options_ui(ui, panel)
    });
    waiting_ui(ui, panel);
    chosen.or(row.inner).map(Command::Edit)
}

/// States that the mode of the texture waits for a space with triangles, if it does.
fn waiting_ui(ui: &mut Ui, panel: &Panel<'_>) {
    let blend = &panel.inspected().blend;
    if blend.mode_in_space(panel.session.n_axes()) == blend.mode {
        return;
    }
    let waits = RichText::new(axes::waits(name(blend.mode))).small().color(tokens(ui.ctx()).warning);
    ui.add(Label::new(waits).wrap().selectable(false)).on_hover_text(axes::NEEDS_TRIANGLES);
}

fn name(mode: Mode) -> &'static str {
    match mode {
        Mode::Field => strings::FIELD,
        Mode::Parametric => strings::PARAMETRIC,
        Mode::Shared => strings::SHARED,
        Mode::Power => strings::POWER,
        Mode::Paper => strings::PAPER,
    }
}

/// Short and full explanation of a mode.
fn help(mode: Mode) -> [&'static str; 2] {
    match mode {
        Mode::Field => [strings::FIELD_SHORT, strings::FIELD_HELP],
        Mode::Parametric => [strings::PARAMETRIC_SHORT, strings::PARAMETRIC_HELP],
        Mode::Shared => [strings::SHARED_SHORT, strings::SHARED_HELP],
        Mode::Power => [strings::POWER_SHORT, strings::POWER_HELP],
        Mode::Paper => [strings::PAPER_SHORT, strings::PAPER_HELP],
    }
}

/// Menu entry of a mode: its name and short explanation.
pub fn mode_entry(mode: Mode) -> String {
    format!("{}: {}", name(mode), help(mode)[0])
}

/// Draws the choice of the mode. Without triangles, only Field can be chosen, and the others say why.
fn mode_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Edit> {
    let mode = panel.session.blend_in_space(&panel.inspected().blend).mode;
    let has_triangles = !panel.session.is_sliced();
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.add(Label::new(strings::BLEND).selectable(false));
        let width = ui.available_width();
        let combo =
            ComboBox::from_id_salt("blend mode").width(width).truncate().selected_text(mode_entry(mode));
        let shown = combo.show_list(ui, |ui| {
            for each in Mode::ALL {
                let can_choose = has_triangles || each == mode;
                let entry = ui.add_enabled(can_choose, Button::selectable(mode == each, mode_entry(each)));
                let entry = entry.on_hover_text(help(each)[1]);
                // The chosen mode of a space without triangles stays for one with them.
                if entry.on_disabled_hover_text(axes::NEEDS_TRIANGLES).clicked() && has_triangles {
                    chosen = Some(Edit::SetMode(each));
                }
            }
        });
        shown.response.accessible_name(strings::BLEND_MODE).on_hover_text(help(mode)[1]);
    });
    chosen
}

/// Draws the options of the selected mode.
fn options_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Edit> {
    let blending = panel.session.blend_in_space(&panel.inspected().blend);
    match blending.mode {
        Mode::Field => {
            let mut is_beyond = blending.outside == Outside::Extrapolated;
            let checkbox = ui.add(Checkbox::new(&mut is_beyond, strings::BEYOND));
            let outside = if is_beyond { Outside::Extrapolated } else { Outside::Clamped };
            checkbox.on_hover_text(strings::BEYOND_HELP).changed().then_some(Edit::SetOutside(outside))
        }
        Mode::Parametric => {
            let mut is_natural = blending.weights == Weights::Natural;
            let checkbox = ui.add(Checkbox::new(&mut is_natural, strings::NATURAL));
            let weights = if is_natural { Weights::Natural } else { Weights::Barycentric };
            checkbox.on_hover_text(strings::NATURAL_HELP).changed().then_some(Edit::SetWeights(weights))
        }
        Mode::Shared | Mode::Power | Mode::Paper => {
            let weak = RichText::new(strings::THREE_SIGNALS).small().color(tokens(ui.ctx()).text_weak);
            ui.add(Label::new(weak).selectable(false));
            None
        }
    }
}
