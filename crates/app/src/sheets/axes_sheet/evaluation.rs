//! Background job that evaluates what axes add to a space.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::space::axis_evaluation::AxisStep;
use shagreen_formats::axes_report::nothing_helps;
use shagreen_formats::library::Library;
use shagreen_studio::axes::{EvaluatedAxes, evaluate};

use crate::state::background::in_background;
use crate::state::course::Course;
use crate::strings::axes as strings;

/// One axis more, and what it adds.
pub(super) struct Step {
    /// Name of the axis.
    pub(super) name: String,
    /// Error without the axis, in dB; `None` for the first one.
    pub(super) before_db: Option<f64>,
    /// Error with the axis, in dB.
    pub(super) after_db: f64,
    /// Share of the textures whose original is the most similar to its prediction.
    pub(super) rank1: f64,
    /// Gain by the axis and its standard error, in dB.
    pub(super) gain_db: Option<[f64; 2]>,
    /// Whether the gain is more than chance explains; `None` for the first one.
    pub(super) helps: Option<bool>,
}

/// Result of an evaluation.
pub(super) struct Outcome {
    /// The axes in the order of what they add, after those that were given.
    pub(super) steps: Vec<Step>,
    pub(super) n_textures: usize,
    /// Names of the axes that too few textures have.
    pub(super) left_out: Vec<String>,
    /// Sentence for the case that no axis helps.
    pub(super) nothing: Option<&'static str>,
}

/// Running job; dropping it stops it.
struct Job {
    course: Arc<Course>,
    arriving: Receiver<Result<Outcome, String>>,
}

impl Drop for Job {
    fn drop(&mut self) {
        self.course.stop();
    }
}

/// Evaluation that runs, and the result of the last one.
#[derive(Default)]
pub(super) struct Evaluation {
    job: Option<Job>,
    outcome: Option<Result<Outcome, String>>,
}

impl Evaluation {
    /// Begins an evaluation with these axes first.
    pub(super) fn begin(&mut self, library: &Arc<Library>, first: &[String], ctx: &Context) {
        let course = Arc::new(Course::default());
        let (on_the_way, screen) = (Arc::clone(&course), ctx.clone());
        let (library, first) = (Arc::clone(library), first.to_vec());
        let work = move || -> Result<Outcome, String> {
            let mut go_on = |n_done, n_steps| on_the_way.reach(n_done, n_steps, &screen);
            let report =
                evaluate(&library, &first, None, &mut go_on).map_err(|error| format!("{error:#}"))?;
            Ok(Outcome::of(&report))
        };
        self.outcome = None;
        self.job = Some(Job { course, arriving: in_background(ctx.clone(), work) });
    }

    /// Stops the evaluation that runs.
    pub(super) fn stop(&mut self) {
        self.job = None;
    }

    /// Takes in the result of the worker.
    pub(super) fn collect(&mut self) {
        let Some(job) = &self.job else { return };
        let outcome = match job.arriving.try_recv() {
            Ok(outcome) => outcome,
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => Err(strings::EVALUATION_BROKEN.to_owned()),
        };
        (self.job, self.outcome) = (None, Some(outcome));
    }

    /// Progress of the evaluation that runs, 0 to 1.
    pub(super) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.course.progress().unwrap_or(0.0))
    }

    /// Result of the last evaluation, or why it failed.
    pub(super) fn outcome(&self) -> Option<&Result<Outcome, String>> {
        self.outcome.as_ref()
    }
}

impl Outcome {
    fn of(report: &EvaluatedAxes) -> Self {
        let EvaluatedAxes { names, found: evaluation } = report;
        let name = |index: &usize| names.get(*index).cloned().unwrap_or_default();
        let step = |step: &AxisStep| Step {
            name: name(&step.added),
            before_db: step.gain_db.map(|[gain, _]| step.error_db_mean + gain),
            after_db: step.error_db_mean,
            rank1: step.rank1,
            gain_db: step.gain_db,
            helps: step.helps(),
        };
        Self {
            steps: evaluation.steps.iter().map(step).collect(),
            n_textures: evaluation.textures.len(),
            left_out: evaluation.left_out.iter().map(name).collect(),
            nothing: nothing_helps(evaluation),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Outcome;
    use shagreen_core::space::axis_evaluation::{AxisEvaluation, AxisStep};
    use shagreen_studio::axes::EvaluatedAxes;

    #[test]
    fn steps_have_the_errors_before_and_after() {
        let step = |added: usize, error_db_mean: f64, gain_db| AxisStep {
            n_axes: 1,
            added,
            agreement: 1.0,
            error_db_mean,
            rank1: 0.5,
            nearest_db_mean: 3.0,
            nearest_rank1: 0.2,
            gain_db,
        };
        let steps =
            vec![step(2, 3.0, None), step(0, 2.5, Some([0.5, 0.1])), step(3, 2.25, Some([0.25, 0.2]))];
        let report = EvaluatedAxes {
            names: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
            found: AxisEvaluation { textures: vec![0; 12], left_out: vec![1], steps },
        };
        let outcome = Outcome::of(&report);
        let errors: Vec<(&str, Option<f64>, f64, Option<bool>)> = outcome
            .steps
            .iter()
            .map(|step| (step.name.as_str(), step.before_db, step.after_db, step.helps))
            .collect();
        assert_eq!(
            errors,
            [("c", None, 3.0, None), ("a", Some(3.0), 2.5, Some(true)), ("d", Some(2.5), 2.25, Some(false))]
        );
        assert_eq!((outcome.n_textures, &outcome.left_out[..]), (12, &["b".to_owned()][..]));
        assert_eq!(outcome.nothing, None);
    }
}
