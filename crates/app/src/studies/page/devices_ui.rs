//! Right column: what must be ready before a participant begins.

use egui::{Button, Color32, ComboBox, Label, RichText, Sense, TextStyle, Ui, vec2};
use shagreen_core::people::study::plan::{Design, MaskingNoise, NoiseColor};
use shagreen_device::output::{NULL_ID, is_same_output};
use shagreen_device::status::{LinkState, STROKE_BUDGET_SECS};

use super::scale_ui::points_per_mm;
use super::{Shown, StudiesPage};
use crate::command::Command;
use crate::command::studies::StudiesCommand;
use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::session::Session;
use crate::strings::studies as strings;
use crate::studies::runner::longest_line;

/// Width of the choice of an output, in points.
const OUTPUT_WIDTH: f32 = 220.0;
/// Radius of the mark before a line, in points.
const MARK: f32 = 3.5;

/// Draws the checklist, with a warning for everything that is missing; returns the requested commands.
pub(super) fn devices_ui(ui: &mut Ui, page: &mut StudiesPage, session: &Session) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.add(Label::new(RichText::new(strings::DEVICES).strong()).selectable(false));
    output_ui(ui, session);
    match session.rig().actuator() {
        Some(actuator) => ready_ui(ui, &strings::actuator(&actuator.name)),
        None => missing_ui(ui, strings::NO_ACTUATOR),
    }
    if session.output_id().is_some_and(|id| id != NULL_ID) {
        latency_ui(ui, session);
    }
    let open = ui.button(strings::OPEN_DEVICES).on_hover_text(strings::OPEN_DEVICES_HELP);
    if open.clicked() {
        commands.push(Command::OpenDevices);
    }
    if let Some(noise) = page.open.as_ref().and_then(|open| open.study.plan.masking_noise) {
        ui.add_space(GAP);
        commands.extend(masking_ui(ui, page, session, noise));
    }
    if needs_scale(page) {
        ui.add_space(GAP);
        scale_line_ui(ui, page);
    }
    if page.has_placeholder_consent() {
        ui.add_space(GAP);
        missing_ui(ui, strings::PLACEHOLDER_CONSENT);
    }
    ui.add_space(2.0 * GROUP_GAP);
    commands
}

/// Draws a line of the checklist that is in order.
fn ready_ui(ui: &mut Ui, text: &str) {
    let t = tokens(ui.ctx());
    line_ui(ui, text, t.accent, t.text_weak);
}

/// Draws a line of the checklist about something that is missing.
fn missing_ui(ui: &mut Ui, text: &str) {
    let t = tokens(ui.ctx());
    line_ui(ui, text, t.warning, t.warning);
}

/// Draws a text after a mark.
fn line_ui(ui: &mut Ui, text: &str, mark: Color32, color: Color32) {
    ui.horizontal_top(|ui| {
        let height = ui.text_style_height(&TextStyle::Small);
        let (area, _) = ui.allocate_exact_size(vec2(2.0 * MARK, height), Sense::hover());
        ui.painter().circle_filled(area.center(), MARK, mark);
        ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
    });
}

fn output_ui(ui: &mut Ui, session: &Session) {
    let is_lost = session.status().is_some_and(|status| status.state == LinkState::Lost);
    match (session.output_id(), session.output_name()) {
        _ if session.is_muted() => missing_ui(ui, strings::OUTPUT_MUTED),
        (Some(NULL_ID), _) => missing_ui(ui, strings::SILENT_OUTPUT),
        (Some(_), Some(_)) if is_lost => missing_ui(ui, strings::OUTPUT_LOST),
        (Some(_), Some(name)) => ready_ui(ui, &strings::output(name)),
        _ => missing_ui(ui, strings::NO_OUTPUT),
    }
}

/// Draws the latency, which is measured whenever somebody strokes.
fn latency_ui(ui: &mut Ui, session: &Session) {
    let latency = session.status().map(|status| status.latency).filter(|latency| latency.n_touches > 0);
    match latency {
        Some(latency) if latency.is_stroke_late() => {
            missing_ui(ui, &strings::late(1e3 * latency.stroke_secs, 1e3 * STROKE_BUDGET_SECS));
        }
        Some(latency) => ready_ui(ui, &strings::latency(1e3 * latency.stroke_secs)),
        None => missing_ui(ui, strings::NO_LATENCY),
    }
}

/// Draws the scale of the screen, and the button that measures it.
fn scale_line_ui(ui: &mut Ui, page: &mut StudiesPage) {
    match page.settings.pixels_per_mm {
        Some(pixels_per_mm) => ready_ui(ui, &strings::calibrated(pixels_per_mm)),
        None => missing_ui(ui, strings::NOT_CALIBRATED),
    }
    let longest_mm = f64::from(
        longest_line(ui.ctx().content_rect().width()) / points_per_mm(page.settings.pixels_per_mm, ui.ctx()),
    );
    if let Some(needed_mm) = line_mm(page).filter(|needed_mm| *needed_mm > longest_mm) {
        missing_ui(ui, &strings::too_long(needed_mm, longest_mm));
    }
    let calibrate = ui.add(Button::new(strings::CALIBRATE)).on_hover_text(strings::CALIBRATE_HELP);
    if calibrate.clicked() {
        page.shown = Shown::Scale;
    }
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
    let color = match noise.color {
        NoiseColor::White => strings::WHITE,
        NoiseColor::Pink => strings::PINK,
    };
    let noise = format!("{}: {}", strings::MASKING, strings::masking(color, noise.level_db));
    let chosen = page.settings.masking_output.as_deref();
    let is_same =
        chosen.zip(session.output_id()).is_some_and(|(id, main)| id != NULL_ID && is_same_output(id, main));
    match chosen {
        None => missing_ui(ui, strings::MASKING_MISSING),
        Some(_) if is_same => missing_ui(ui, strings::MASKING_SAME),
        Some(_) => ready_ui(ui, &noise),
    }
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
    asked
}
