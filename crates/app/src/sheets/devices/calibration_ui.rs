//! Section that measures the actuator.

use egui::{Button, ComboBox, Context, DragValue, ProgressBar, Ui};

use super::calibration::{Job, Question, name_of};
use super::{DevicesSheet, heading, note, row, warning};
use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::session::Session;
use crate::strings::devices as strings;

/// State of the measurement section.
#[derive(Default)]
pub(super) struct Measurement {
    question: Question,
    stage: Stage,
    /// Result or error of the last measurement, as text.
    told: Option<Result<String, String>>,
    warnings: Vec<String>,
}

/// Stage of a measurement.
#[derive(Default)]
enum Stage {
    #[default]
    Idle,
    /// The output with this id is being closed.
    Releasing(String),
    Measuring(Job),
    /// The output may be opened again.
    Ended,
}

impl Measurement {
    /// Whether a measurement is running: the sheet then stays open.
    pub(super) fn is_running(&self) -> bool {
        matches!(self.stage, Stage::Releasing(_) | Stage::Measuring(_))
    }

    /// Whether a measurement has ended since the last call.
    pub(super) fn has_ended(&mut self) -> bool {
        let has_ended = matches!(self.stage, Stage::Ended);
        if has_ended {
            self.stage = Stage::Idle;
        }
        has_ended
    }
}

impl DevicesSheet {
    pub(super) fn calibration_ui(&mut self, ui: &mut Ui, session: &Session) -> Option<Command> {
        let mut command = None;
        heading(ui, strings::CALIBRATE);
        if self.measurement.is_running() {
            let job = if let Stage::Measuring(job) = &self.measurement.stage { Some(job) } else { None };
            let share = job.map_or(0.0, Job::share);
            ui.add(ProgressBar::new(share).desired_width(260.0)).accessible_name(strings::CALIBRATE);
            if ui.button(strings::CANCEL).clicked() {
                match job {
                    Some(job) => job.cancel(),
                    None => self.measurement.stage = Stage::Ended,
                }
            }
            return None;
        }
        let question = &mut self.measurement.question;
        let inputs = session.inputs();
        row(ui, strings::INPUT, |ui| {
            let chosen =
                question.input.as_deref().map_or(strings::CHOOSE_INPUT.to_owned(), |id| name_of(inputs, id));
            let combo = ComboBox::from_id_salt("input").width(260.0).truncate().selected_text(chosen);
            let shown = combo.show_list(ui, |ui| {
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
            (strings::MEASURED_LOAD, strings::LOAD_HELP, &mut question.load_g, 1.0..=2000.0, " g"),
            (strings::AMPLITUDE, strings::AMPLITUDE_HELP, &mut question.amplitude, 0.01..=1.0, ""),
        ] {
            row(ui, name, |ui| {
                let speed = 0.002 * *value;
                let value = DragValue::new(value).range(range).speed(speed).fixed_decimals(2).suffix(suffix);
                ui.add(value).accessible_name(name).on_hover_text(help);
            });
        }
        let output = session.output_id().filter(|_| question.input.is_some());
        let start = ui.add_enabled(output.is_some(), Button::new(strings::START));
        if start.on_hover_text(strings::CALIBRATE_HELP).clicked()
            && let Some(id) = output
        {
            self.measurement.told = None;
            self.measurement.warnings.clear();
            self.measurement.stage = Stage::Releasing(id.to_owned());
            command = Some(Command::LetGoOfOutput);
        }
        match &self.measurement.told {
            Some(Ok(text)) => note(ui, text),
            Some(Err(text)) => warning(ui, text),
            None => {}
        }
        for text in &self.measurement.warnings {
            warning(ui, text);
        }
        command
    }

    /// Starts the measurement once the output is free, and takes over its result.
    pub(super) fn carry_on_measuring(&mut self, ctx: &Context, session: &Session) {
        let measurement = &mut self.measurement;
        let outcome = match &measurement.stage {
            Stage::Releasing(id) if session.is_output_released() => {
                let question = measurement.question.clone();
                let job = Job::start(id.clone(), question, self.rig.clone(), ctx.clone());
                measurement.stage = Stage::Measuring(job);
                return;
            }
            Stage::Measuring(job) => job.outcome(),
            _ => None,
        };
        let Some(outcome) = outcome else { return };
        measurement.stage = Stage::Ended;
        match outcome {
            Ok(outcome) => {
                self.measurement.told = Some(Ok(strings::calibrated(outcome.fit_error_db)));
                self.measurement.warnings = outcome.warnings;
                self.take(Some(outcome.actuator), None);
            }
            Err(error) => self.measurement.told = Some(Err(format!("{error:#}"))),
        }
    }
}
