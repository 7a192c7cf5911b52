//! The part of the sheet that measures the actuator.

use egui::{Button, ComboBox, DragValue, ProgressBar, Ui};

use super::calibration::{Job, Question, name_of};
use super::{DevicesSheet, heading, note, row, warning};
use crate::command::Command;
use crate::session::Session;
use crate::strings::devices as strings;

/// Where a measurement stands.
#[derive(Default)]
pub(super) struct Measurement {
    question: Question,
    job: Option<Job>,
    /// What came of the last one.
    told: Option<Result<String, String>>,
    warnings: Vec<String>,
}

impl Measurement {
    /// Whether one runs: the sheet stays open then.
    pub(super) fn is_running(&self) -> bool {
        self.job.is_some()
    }
}

impl DevicesSheet {
    pub(super) fn calibration_ui(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        let mut commands = self.collect_measurement();
        heading(ui, strings::CALIBRATE);
        if let Some(job) = &self.measurement.job {
            ui.add(ProgressBar::new(job.share()).desired_width(260.0)).accessible_name(strings::CALIBRATE);
            if ui.button(strings::CANCEL).clicked() {
                job.cancel();
            }
            return commands;
        }
        let question = &mut self.measurement.question;
        let inputs = session.inputs();
        row(ui, strings::INPUT, |ui| {
            let chosen =
                question.input.as_deref().map_or(strings::CHOOSE_INPUT.to_owned(), |id| name_of(inputs, id));
            let combo = ComboBox::from_id_salt("input").width(260.0).truncate().selected_text(chosen);
            let shown = combo.show_ui(ui, |ui| {
                for input in inputs {
                    let label = ui.selectable_value(&mut question.input, Some(input.id.clone()), &input.name);
                    label.on_hover_text(&input.id);
                }
            });
            shown.response.accessible_name(strings::INPUT).on_hover_text(strings::CALIBRATE_HELP);
        });
        for (name, help, value, range, suffix) in [
            (
                strings::SENSITIVITY,
                strings::SENSITIVITY_HELP,
                &mut question.sensitivity_mps2,
                0.1..=10_000.0,
                " m/s²",
            ),
            (strings::LOAD, strings::LOAD_HELP, &mut question.load_g, 1.0..=2000.0, " g"),
            (strings::AMPLITUDE, strings::AMPLITUDE_HELP, &mut question.amplitude, 0.01..=1.0, ""),
        ] {
            row(ui, name, |ui| {
                let speed = 0.002 * *value;
                let value = DragValue::new(value).range(range).speed(speed).max_decimals(2).suffix(suffix);
                ui.add(value).accessible_name(name).on_hover_text(help);
            });
        }
        let output = session.output_id().filter(|_| question.input.is_some());
        let start = ui.add_enabled(output.is_some(), Button::new(strings::START));
        if start.on_hover_text(strings::CALIBRATE_HELP).clicked()
            && let Some(id) = output
        {
            let (id, question) = (id.to_owned(), question.clone());
            self.measurement.told = None;
            self.measurement.warnings.clear();
            self.measurement.job = Some(Job::start(id, question, self.rig.clone(), ui.ctx().clone()));
            commands.push(Command::LetGoOfOutput);
        }
        match &self.measurement.told {
            Some(Ok(text)) => note(ui, text),
            Some(Err(text)) => warning(ui, text),
            None => {}
        }
        for text in &self.measurement.warnings {
            warning(ui, text);
        }
        commands
    }

    /// Takes in what came of a measurement, and asks for the output back.
    fn collect_measurement(&mut self) -> Vec<Command> {
        let Some(outcome) = self.measurement.job.as_ref().and_then(Job::outcome) else { return Vec::new() };
        self.measurement.job = None;
        match outcome {
            Ok(outcome) => {
                self.measurement.told = Some(Ok(strings::calibrated(outcome.fit_error_db)));
                self.measurement.warnings = outcome.warnings;
                self.take(Some(outcome.actuator), None);
            }
            Err(error) => self.measurement.told = Some(Err(format!("{error:#}"))),
        }
        vec![Command::TakeOutputBack]
    }
}
