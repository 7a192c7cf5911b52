//! Button that evaluates axes, and the table of the result.

use std::sync::Arc;

use egui::{Button, Grid, Label, ProgressBar, RichText, Ui};
use shagreen_formats::library::Library;

use super::Change;
use super::evaluation::{Evaluation, Outcome, Step};
use crate::look::theme::{GAP, tokens};
use crate::strings::{axes as strings, sentence};

/// Width of the progress bar, in points.
const BAR_WIDTH: f32 = 160.0;
/// Distance between rows, in points.
const ROW_GAP: f32 = 2.0;

/// Draws the button that begins an evaluation with the chosen axes first, or its progress and the button that stops it.
pub(super) fn evaluate_ui(
    ui: &mut Ui,
    evaluation: &mut Evaluation,
    library: &Arc<Library>,
    chosen: &[String],
    can_begin: bool,
) {
    ui.horizontal(|ui| {
        if let Some(share) = evaluation.progress() {
            if ui.button(strings::STOP).clicked() {
                evaluation.stop();
            }
            ui.add(ProgressBar::new(share).desired_width(BAR_WIDTH).text(strings::EVALUATING));
        } else {
            let button = ui.add_enabled(can_begin, Button::new(strings::EVALUATE));
            if button.on_hover_text(strings::EVALUATE_HELP).clicked() {
                evaluation.begin(library, chosen, ui.ctx());
            }
        }
    });
}

/// Draws the result of an evaluation, or why it failed; returns the requested change.
pub(super) fn outcome_ui(
    ui: &mut Ui,
    outcome: &Result<Arc<Outcome>, String>,
    chosen: &[String],
) -> Option<Change> {
    let t = tokens(ui.ctx());
    let mut change = None;
    ui.add_space(GAP);
    ui.separator();
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(reason) => {
            ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
            return None;
        }
    };
    let n_added = outcome.n_added(chosen);
    Grid::new("evaluated axes").num_columns(6).spacing([2.0 * GAP, ROW_GAP]).show(ui, |ui| {
        for (name, help) in [
            (strings::ADDED, strings::EVALUATE_HELP),
            (strings::ERROR, strings::ERROR_HELP),
            (strings::GAIN, strings::GAIN_HELP),
            (strings::RANK1, strings::RANK1_HELP),
        ] {
            let heading = RichText::new(name).small().color(t.text_weak);
            ui.add(Label::new(heading).selectable(false)).on_hover_text(help);
        }
        ui.end_row();
        for (row, step) in outcome.steps.iter().enumerate() {
            let label =
                if row == 0 { strings::first_axes(&outcome.first) } else { strings::added(&step.name) };
            step_ui(ui, &label, step);
            // Each row has the axes of all rows above it.
            if let Some(n_added) = n_added.filter(|n_added| row > *n_added)
                && add_ui(ui, &step.name)
            {
                let added = outcome.steps[n_added + 1..=row].iter().map(|step| step.name.clone());
                change = Some(Change::Choose(chosen.iter().cloned().chain(added).collect()));
            }
            ui.end_row();
        }
    });
    if n_added.is_none() {
        let note = RichText::new(strings::of_another_choice(&outcome.first)).color(t.warning);
        ui.add(Label::new(note).wrap());
    }
    let mut notes = vec![strings::evaluated(outcome.n_textures)];
    notes.extend(outcome.nothing.map(str::to_owned));
    if !outcome.left_out.is_empty() {
        notes.push(strings::left_out(&outcome.left_out.iter().map(String::as_str).collect::<Vec<_>>()));
    }
    notes.extend(outcome.signal_note.map(str::to_owned));
    for note in notes {
        ui.add(Label::new(RichText::new(note).small().color(t.text_weak)).wrap());
    }
    change
}

/// Draws the figures of a step.
fn step_ui(ui: &mut Ui, label: &str, step: &Step) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(label).selectable(false));
    for figure in [
        strings::errors(step.before_db, step.after_db),
        strings::gain(step.gain_db),
        strings::percent(step.rank1),
    ] {
        ui.add(Label::new(figure).selectable(false));
    }
    let (verdict, color) = match step.helps {
        Some(true) => (strings::HELPS, t.accent),
        Some(false) => (strings::NO_HELP, t.text_weak),
        None => ("", t.text_weak),
    };
    ui.add(Label::new(RichText::new(verdict).color(color)).selectable(false));
}

/// Draws the button that adds an axis and those of the rows above; returns whether it was clicked.
fn add_ui(ui: &mut Ui, axis: &str) -> bool {
    let button = ui.add(Button::new(strings::ADD).small()).accessible_name(strings::add(axis));
    button.on_hover_text(strings::ADD_HELP).clicked()
}
