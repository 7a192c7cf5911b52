//! Background job that evaluates what axes add to a space, and its last result, which stays when the sheet is closed.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Context, Id};
use shagreen_core::space::axis_evaluation::AxisStep;
use shagreen_formats::axes_report::{nothing_helps, signal_axes_note};
use shagreen_formats::library::Library;
use shagreen_studio::axes::{EvaluatedAxes, evaluate};

use super::is_chosen;
use crate::state::background::in_background;
use crate::state::course::Course;
use crate::strings::axes as strings;

/// One axis more, and what it adds. The first step has all axes with which the evaluation began.
pub(super) struct Step {
    /// Name of the axis, the last one of the first step.
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
    /// Names of the axes with which the evaluation began.
    pub(super) first: Vec<String>,
    /// The axes in the order of what they add, after those that were given.
    pub(super) steps: Vec<Step>,
    pub(super) n_textures: usize,
    /// Names of the axes that too few textures have.
    pub(super) left_out: Vec<String>,
    /// Sentence for the case that no axis helps.
    pub(super) nothing: Option<&'static str>,
    /// Limit of the result, if an axis is computed from the vibration.
    pub(super) signal_note: Option<&'static str>,
}

/// Result for these textures.
#[derive(Clone)]
struct Kept {
    library: Arc<Library>,
    outcome: Arc<Outcome>,
}

fn key() -> Id {
    Id::unique("last evaluation of axes")
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
    outcome: Option<Result<Arc<Outcome>, String>>,
}

impl Evaluation {
    /// The last result, if it is about the same textures.
    pub(super) fn last(library: &Library, ctx: &Context) -> Self {
        let kept: Option<Kept> = ctx.data(|data| data.get_temp(key()));
        let is_same =
            |kept: &Kept| kept.library.axes == library.axes && kept.library.textures == library.textures;
        Self { job: None, outcome: kept.filter(is_same).map(|kept| Ok(kept.outcome)) }
    }

    /// Begins an evaluation with these axes first.
    pub(super) fn begin(&mut self, library: &Arc<Library>, first: &[String], ctx: &Context) {
        let course = Arc::new(Course::default());
        let (on_the_way, screen) = (Arc::clone(&course), ctx.clone());
        let (library, first) = (Arc::clone(library), first.to_vec());
        let work = move || -> Result<Outcome, String> {
            let mut go_on = |n_done, n_steps| on_the_way.reach(n_done, n_steps, &screen);
            let report =
                evaluate(&library, &first, None, &mut go_on).map_err(|error| format!("{error:#}"))?;
            Ok(Outcome::of(&library, &report, first))
        };
        self.outcome = None;
        self.job = Some(Job { course, arriving: in_background(ctx.clone(), work) });
    }

    /// Stops the evaluation that runs.
    pub(super) fn stop(&mut self) {
        self.job = None;
    }

    /// Takes in the result of the worker about these textures.
    pub(super) fn collect(&mut self, library: &Arc<Library>, ctx: &Context) {
        let Some(job) = &self.job else { return };
        let outcome = match job.arriving.try_recv() {
            Ok(outcome) => outcome.map(Arc::new),
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => Err(strings::EVALUATION_BROKEN.to_owned()),
        };
        if let Ok(outcome) = &outcome {
            let kept = Kept { library: Arc::clone(library), outcome: Arc::clone(outcome) };
            ctx.data_mut(|data| data.insert_temp(key(), kept));
        }
        (self.job, self.outcome) = (None, Some(outcome));
    }

    /// Progress of the evaluation that runs, 0 to 1.
    pub(super) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.course.progress().unwrap_or(0.0))
    }

    /// Result of the last evaluation, or why it failed.
    pub(super) fn outcome(&self) -> Option<&Result<Arc<Outcome>, String>> {
        self.outcome.as_ref()
    }
}

impl Outcome {
    fn of(library: &Library, report: &EvaluatedAxes, first: Vec<String>) -> Self {
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
            first,
            steps: evaluation.steps.iter().map(step).collect(),
            n_textures: evaluation.textures.len(),
            left_out: evaluation.left_out.iter().map(name).collect(),
            nothing: nothing_helps(evaluation),
            signal_note: signal_axes_note(library, names.iter().map(String::as_str)),
        }
    }

    /// Number of the steps after the first one whose axes are chosen, if the choice consists of the first axes and of these, in any
    /// order. `None` for another choice, about which the steps say nothing.
    pub(super) fn n_added(&self, chosen: &[String]) -> Option<usize> {
        let n_added = chosen.len().checked_sub(self.first.len())?;
        let added = self.steps.iter().skip(1).take(n_added).map(|step| &step.name);
        let known: Vec<&String> = self.first.iter().chain(added).collect();
        let is_same = known.len() == chosen.len() && known.iter().all(|name| is_chosen(chosen, name));
        is_same.then_some(n_added)
    }
}

#[cfg(test)]
mod tests {
    use super::{Evaluation, Job, Outcome};
    use crate::state::course::Course;
    use egui::Context;
    use shagreen_core::space::axis_evaluation::{AxisEvaluation, AxisStep};
    use shagreen_formats::library::Library;
    use shagreen_formats::starter::starter_library;
    use shagreen_studio::axes::EvaluatedAxes;
    use std::sync::Arc;

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn the_last_result_stays_for_the_same_textures() {
        let (ctx, library) = (Context::default(), Arc::new(starter_library().unwrap()));
        let (sender, arriving) = std::sync::mpsc::channel();
        let course = Arc::new(Course::default());
        let mut evaluation = Evaluation { job: Some(Job { course, arriving }), outcome: None };
        let report = EvaluatedAxes {
            names: Vec::new(),
            found: AxisEvaluation { textures: vec![0; 12], left_out: Vec::new(), steps: Vec::new() },
        };
        sender.send(Ok(Outcome::of(&library, &report, names(&["hard-soft"])))).unwrap();
        evaluation.collect(&library, &ctx);
        assert!(evaluation.progress().is_none());
        let first = |library: &Library| {
            let last = Evaluation::last(library, &ctx);
            last.outcome().and_then(|outcome| outcome.as_ref().ok()).map(|outcome| outcome.first.clone())
        };
        assert_eq!(first(&library), Some(names(&["hard-soft"])));
        let mut other = Library::clone(&library);
        other.textures.pop();
        assert_eq!(first(&other), None);
    }

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
        let mut report = EvaluatedAxes {
            names: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
            found: AxisEvaluation { textures: vec![0; 12], left_out: vec![1], steps },
        };
        let first = names(&["c"]);
        let outcome = Outcome::of(&Library::default(), &report, first.clone());
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
        assert_eq!((outcome.nothing, outcome.signal_note), (None, None));
        report.names[3] = "centroid".to_owned();
        assert!(Outcome::of(&Library::default(), &report, first).signal_note.is_some());
        // Each row has the axes of all rows above it.
        let n_added = |chosen: &[&str]| outcome.n_added(&names(chosen));
        assert_eq!(
            [n_added(&["c"]), n_added(&["a", "c"]), n_added(&["c", "d", "a"])],
            [Some(0), Some(1), Some(2)]
        );
        assert_eq!(
            [n_added(&[]), n_added(&["a"]), n_added(&["c", "d"]), n_added(&["c", "a", "x"])],
            [None; 4]
        );
        assert_eq!(n_added(&["c", "a", "d", "b"]), None);
    }
}
