//! Row with the prompt box.

use egui::{Align, Button, ComboBox, Key, Layout, ProgressBar, Role, TextEdit, Ui, WidgetInfo, vec2};
use shagreen_formats::settings::KeptPrompt;

use super::Prompts;
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::look::list::ShowList as _;
use crate::look::motion::busy_ui;
use crate::strings::prompt as words;

/// Height of the row, in points.
pub(crate) const BAR_HEIGHT: f32 = 30.0;
/// Maximum length of a prompt, in characters (about one page).
const LONGEST: usize = 4000;

/// Draws the row; returns the requested command. `earlier` are earlier prompts, newest first.
pub(crate) fn bar_ui(ui: &mut Ui, prompts: &mut Prompts, earlier: &[KeptPrompt]) -> Option<Command> {
    let mut asked = None;
    let row = vec2(ui.available_width(), BAR_HEIGHT - 4.0);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        asked = earlier_ui(ui, prompts, earlier);
        if prompts.is_busy() {
            if ui.button(words::STOP).clicked() {
                asked = Some(PromptCommand::Stop);
            }
            match prompts.progress() {
                Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(90.0).show_percentage())),
                None => busy_ui(ui),
            }
            if prompts.n_waiting() > 0 {
                ui.label(words::waiting(prompts.n_waiting()));
            }
        } else if ui.button(words::MAKE).on_hover_text(words::MAKE_HELP).clicked() {
            asked = Some(make(prompts));
        }
        if let Some(command) = simulation_ui(ui, prompts) {
            asked = Some(command);
        }
        generator_ui(ui, prompts);
        // An id of its own: the widgets before it change while a texture is made, and its focus must not.
        let field = TextEdit::singleline(&mut prompts.text)
            .id_salt("prompt")
            .hint_text(words::HINT)
            .char_limit(LONGEST)
            .desired_width(f32::INFINITY);
        let field = ui.add(field).on_hover_text(words::FIELD_HELP);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, words::FIELD));
        if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
            // The button makes an arbitrary surface without words, too.
            if !prompts.text.trim().is_empty() {
                asked = Some(make(prompts));
            }
            // The next words are typed while the texture is made. Without the focus, their letters would be shortcuts.
            field.request_focus();
        }
    });
    asked.map(Command::Prompt)
}

fn make(prompts: &Prompts) -> PromptCommand {
    PromptCommand::Make { prompt: prompts.text.clone(), seed: 1 }
}

/// Draws the progress of a simulation, if one runs.
fn simulation_ui(ui: &mut Ui, prompts: &Prompts) -> Option<PromptCommand> {
    let share = prompts.simulated_share()?;
    let stop = ui.button(words::STOP_SIMULATION).on_hover_text(words::STOP_SIMULATION_HELP);
    let bar = ProgressBar::new(share).desired_width(90.0).text(words::SIMULATING);
    ui.add(bar).on_hover_text(words::SIMULATING_HELP);
    stop.clicked().then_some(PromptCommand::StopSimulation)
}

/// Draws the choice of the picture generator, if a diffusion model is installed.
fn generator_ui(ui: &mut Ui, prompts: &mut Prompts) {
    if prompts.added().is_none() {
        return;
    }
    let chosen = if prompts.by_diffusion { words::DIFFUSION } else { words::PROCEDURAL };
    let choice = ComboBox::from_id_salt("generator").selected_text(chosen).show_list(ui, |ui| {
        ui.selectable_value(&mut prompts.by_diffusion, false, words::PROCEDURAL);
        ui.selectable_value(&mut prompts.by_diffusion, true, words::DIFFUSION);
    });
    choice.response.on_hover_text(words::GENERATOR_HELP);
}

/// Draws the menu of earlier prompts. Choosing one makes the same picture again.
fn earlier_ui(ui: &mut Ui, prompts: &mut Prompts, earlier: &[KeptPrompt]) -> Option<PromptCommand> {
    let mut asked = None;
    let menu = ui.menu_button(words::EARLIER, |ui| {
        ui.set_max_width(360.0);
        if earlier.is_empty() {
            ui.label(words::NO_EARLIER);
        }
        for KeptPrompt { prompt, seed, by_diffusion } in earlier {
            let entry = Button::new(words::earlier(prompt, *seed, *by_diffusion)).truncate();
            let can_make = !by_diffusion || prompts.added().is_some();
            if ui.add_enabled(can_make, entry).on_disabled_hover_text(words::NO_DIFFUSION).clicked() {
                prompts.text.clone_from(prompt);
                prompts.by_diffusion = *by_diffusion;
                asked = Some(PromptCommand::Make { prompt: prompt.clone(), seed: *seed });
                ui.close();
            }
        }
    });
    menu.response.on_hover_text(words::EARLIER_HELP);
    asked
}
