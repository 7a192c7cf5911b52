//! Results of the sessions: findings, tables and figures of each part, and what becomes of them.

use egui::{Align, Button, Label, Layout, RichText, ScrollArea, TextEdit, Ui, vec2};
use shagreen_studio::study::analysis::{PartReport, ParticipantKind, StudyJudgments, StudyReport};

use super::StudiesPage;
use crate::command::Command;
use crate::command::studies::StudiesCommand;
use crate::figure_ui::framed_figure_ui;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::results::Results;

/// Height of a figure, in points.
const FIGURE_HEIGHT: f32 = 300.0;

/// Draws the results; returns the requested commands.
pub(super) fn results_ui(ui: &mut Ui, page: &mut StudiesPage) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let Some(results) = &mut page.results else {
        ui.add(Label::new(RichText::new(strings::NO_RESULTS).color(t.text_weak)).wrap());
        return Vec::new();
    };
    let mut commands = Vec::new();
    kinds_ui(ui, results);
    commands.extend(actions_ui(ui, results));
    ui.add_space(GAP);
    let Results { reports, shown, figures, .. } = results;
    if let Some(report) = reports.get(*shown) {
        figures.resize(report.parts.len(), 0);
        ScrollArea::vertical().id_salt("results of a study").auto_shrink(false).show(ui, |ui| {
            report_ui(ui, report);
            for (part, shown) in report.parts.iter().zip(figures) {
                commands.extend(part_ui(ui, report, part, shown));
            }
        });
    }
    commands
}

/// Draws the choice between people and simulated participants, if there are both.
fn kinds_ui(ui: &mut Ui, results: &mut Results) {
    if results.reports.len() < 2 {
        return;
    }
    let kinds: Vec<ParticipantKind> = results.reports.iter().map(|report| report.kind).collect();
    ui.horizontal(|ui| {
        for (index, kind) in kinds.into_iter().enumerate() {
            let name = match kind {
                ParticipantKind::People => strings::PEOPLE,
                ParticipantKind::Simulated => strings::SIMULATED_PEOPLE,
            };
            ui.selectable_value(&mut results.shown, index, name);
        }
    });
}

/// Draws the buttons that hand the judgments to Build and save the report; returns the requested command.
fn actions_ui(ui: &mut Ui, results: &mut Results) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    let has_judgments = results.report().is_some_and(|report| report.judgments != StudyJudgments::default());
    ui.horizontal(|ui| {
        let button = ui.add_enabled(has_judgments, Button::new(strings::USE_IN_BUILD));
        let help = if has_judgments { strings::USE_IN_BUILD_HELP } else { strings::NOTHING_FOR_BUILD };
        if button.on_hover_text(help).on_disabled_hover_text(help).clicked() {
            asked = Some(Command::Studies(StudiesCommand::UseInBuild));
        }
        ui.add_space(GAP);
        let can_save = !results.is_saving() && !results.folder.trim().is_empty();
        let save = ui.add_enabled(can_save, Button::new(strings::SAVE_REPORT));
        if save.on_hover_text(strings::REPORT_HELP).clicked() {
            results.save(ui.ctx());
        }
        let field = TextEdit::singleline(&mut results.folder).desired_width(ui.available_width());
        if ui.add(field).accessible_name(strings::REPORT_FOLDER).changed() {
            results.saved = None;
        }
    });
    match &results.saved {
        Some(Ok(folder)) => {
            let text = RichText::new(strings::report_saved(folder)).color(t.accent);
            ui.add(Label::new(text).wrap());
        }
        Some(Err(reason)) => {
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
        }
        None => {}
    }
    asked
}

/// Draws who was analyzed, and the warnings.
fn report_ui(ui: &mut Ui, report: &StudyReport) {
    let t = tokens(ui.ctx());
    let heading = RichText::new(strings::results_of(&report.plan.name, &report.who())).heading();
    let is_simulated = report.kind == ParticipantKind::Simulated;
    let heading = if is_simulated { heading.color(t.warning) } else { heading };
    ui.add(Label::new(heading).wrap());
    for warning in &report.warnings {
        ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
    }
    ui.add_space(GROUP_GAP);
}

/// Draws the findings of a part and one of its figures, with the index `shown`; returns the requested command.
fn part_ui(ui: &mut Ui, report: &StudyReport, part: &PartReport, shown: &mut usize) -> Option<Command> {
    let mut asked = None;
    ui.add(Label::new(RichText::new(&part.title).strong()).wrap());
    for finding in &part.findings {
        ui.add(Label::new(finding).wrap());
    }
    ui.horizontal_wrapped(|ui| {
        if part.figures.len() > 1 {
            for (index, (_, figure)) in part.figures.iter().enumerate() {
                ui.selectable_value(shown, index, figure.title());
            }
        }
    });
    if let Some((name, figure)) = part.figures.get(*shown).or(part.figures.first()) {
        let size = vec2(ui.available_width(), FIGURE_HEIGHT);
        let stem = if report.kind == ParticipantKind::Simulated {
            format!("{}-{name}", report.kind.label_source().id())
        } else {
            name.clone()
        };
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
            ui.set_min_size(size);
            asked = framed_figure_ui(ui, name, figure, &stem);
        });
    }
    ui.add_space(GROUP_GAP);
    asked
}
