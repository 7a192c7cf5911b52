//! Right column: what must be ready before a participant begins.

use egui::{Button, ComboBox, Label, RichText, Ui};
use shagreen_core::people::study::plan::{Design, MaskingNoise, NoiseColor};
use shagreen_device::output::{NULL_ID, is_same_output};

use super::scale_ui::points_per_mm;
use super::{Shown, StudiesPage};
use crate::command::Command;
use crate::command::studies::StudiesCommand;
use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, tokens};
use crate::session::Session;
use crate::strings::studies as strings;
use crate::studies::runner::longest_line;

/// Width of the choice of an output, in points.
const OUTPUT_WIDTH: f32 = 220.0;

/// Draws the state of the devices; returns the requested commands.
pub(super) fn devices_ui(ui: &mut Ui, page: &mut StudiesPage, session: &Session) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let warning = |ui: &mut Ui, text: &str| {
        ui.add(Label::new(RichText::new(text).small().color(t.warning)).wrap());
    };
    let note = |ui: &mut Ui, text: String| {
        ui.add(Label::new(RichText::new(text).small().color(t.text_weak)).wrap());
    };
    ui.add(Label::new(RichText::new(strings::DEVICES).strong()).selectable(false));
    match (session.output_id(), session.output_name()) {
        (Some(NULL_ID), _) => warning(ui, strings::SILENT_OUTPUT),
        (Some(_), Some(name)) => note(ui, format!("{}: {name}", strings::OUTPUT_READY)),
        _ => warning(ui, strings::NO_OUTPUT),
    }
    match session.rig().actuator() {
        Some(actuator) => note(ui, actuator.name.clone()),
        None => warning(ui, strings::NO_ACTUATOR),
    }
    if let Some(noise) = page.open.as_ref().and_then(|open| open.study.plan.masking_noise) {
        ui.add_space(GAP);
        commands.extend(masking_ui(ui, page, session, noise));
    }
    if needs_scale(page) {
        ui.add_space(GAP);
        match page.settings.pixels_per_mm {
            Some(pixels_per_mm) => note(ui, strings::calibrated(pixels_per_mm)),
            None => warning(ui, strings::NOT_CALIBRATED),
        }
        let longest_mm = f64::from(
            longest_line(ui.ctx().content_rect().width())
                / points_per_mm(page.settings.pixels_per_mm, ui.ctx()),
        );
        if let Some(needed_mm) = line_mm(page).filter(|needed_mm| *needed_mm > longest_mm) {
            warning(ui, &strings::too_long(needed_mm, longest_mm));
        }
        let calibrate = ui.add(Button::new(strings::CALIBRATE)).on_hover_text(strings::CALIBRATE_HELP);
        if calibrate.clicked() {
            page.shown = Shown::Scale;
        }
    }
    commands
}

/// Whether the open plan has lines of a true length.
fn needs_scale(page: &StudiesPage) -> bool {
    let has_line = |design: &Design| {
        matches!(design, Design::Rating { .. } | Design::Mushra { .. } | Design::Anchors { .. })
    };
    page.open.as_ref().is_some_and(|open| open.study.plan.parts.iter().any(|part| has_line(&part.design)))
}

/// Length of the longest lines of the open plan, in mm, if it states any.
fn line_mm(page: &StudiesPage) -> Option<f64> {
    let parts = page.open.as_ref()?.study.plan.parts.iter();
    let of_design = |design: &Design| match design {
        Design::Rating { slider_mm, .. } => Some(*slider_mm),
        _ => None,
    };
    parts.filter_map(|part| of_design(&part.design)).max_by(f64::total_cmp)
}

/// Draws the choice of the output of the masking noise; returns the requested command.
fn masking_ui(ui: &mut Ui, page: &StudiesPage, session: &Session, noise: MaskingNoise) -> Option<Command> {
    let t = tokens(ui.ctx());
    let color = match noise.color {
        NoiseColor::White => strings::WHITE,
        NoiseColor::Pink => strings::PINK,
    };
    let text = format!("{}: {}", strings::MASKING, strings::masking(color, noise.level_db));
    ui.add(Label::new(RichText::new(text).small().color(t.text_weak)).wrap());
    let chosen = page.settings.masking_output.as_deref();
    let name_of = |id: &str| {
        let listed = session.outputs().iter().find(|output| output.id == id);
        listed.map_or(id.to_owned(), |output| output.name.clone())
    };
    let current = chosen.map_or(strings::NO_MASKING_OUTPUT.to_owned(), name_of);
    let mut asked = None;
    let select =
        |id: Option<&str>| Some(Command::Studies(StudiesCommand::SelectMaskingOutput(id.map(str::to_owned))));
    let combo = ComboBox::from_id_salt(strings::MASKING_OUTPUT).width(OUTPUT_WIDTH).truncate();
    let combo = combo.selected_text(current).show_list(ui, |ui| {
        if ui.selectable_label(chosen.is_none(), strings::NO_MASKING_OUTPUT).clicked() {
            asked = select(None);
        }
        for output in session.outputs() {
            let is_chosen = chosen == Some(output.id.as_str());
            if ui.selectable_label(is_chosen, &output.name).on_hover_text(&output.id).clicked() {
                asked = select(Some(&output.id));
            }
        }
    });
    if combo.response.clicked() {
        // Listed again, because a device may have been connected since.
        asked = Some(Command::ListOutputs);
    }
    combo.response.accessible_name(strings::MASKING_OUTPUT).on_hover_text(strings::MASKING_HELP);
    let is_same =
        chosen.zip(session.output_id()).is_some_and(|(id, main)| id != NULL_ID && is_same_output(id, main));
    let problem = match chosen {
        None => Some(strings::MASKING_MISSING),
        Some(_) if is_same => Some(strings::MASKING_SAME),
        Some(_) => None,
    };
    if let Some(problem) = problem {
        ui.add(Label::new(RichText::new(problem).small().color(t.warning)).wrap());
    }
    asked
}
