//! Steps of building a space, for progress reports from several threads.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::space::space_build::SpaceBuildError;

/// Step of building a space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Computing similarities from the sorts.
    Sorting,
    /// Scaling the perceptual space.
    Scaling,
    /// Fitting the adjective directions. It is the first step if there are no sorts, and then averages the ratings.
    Adjectives,
    /// Rendering stroke patterns and extracting features.
    Features,
    /// Predicting and validating an axis: 0 or 1.
    Axis(usize),
    /// Bootstrapping over participants, if there are sorts.
    Stability,
}

impl Step {
    /// Number of steps.
    pub const COUNT: usize = 7;

    /// Index of the step, from 0.
    pub fn index(self) -> usize {
        match self {
            Self::Sorting => 0,
            Self::Scaling => 1,
            Self::Adjectives => 2,
            Self::Features => 3,
            Self::Axis(axis) => 4 + axis.min(1),
            Self::Stability => 6,
        }
    }
}

/// Current step of a build. Work that runs in parallel with the main sequence has no step of its own: it repeats the
/// report of the current step to ask whether to continue.
pub(super) struct Progress<'a> {
    on_step: &'a (dyn Fn(Step) -> bool + Sync),
    now: Mutex<Step>,
    is_stopped: AtomicBool,
}

impl<'a> Progress<'a> {
    /// Progress before the first step.
    pub(super) fn new(on_step: &'a (dyn Fn(Step) -> bool + Sync)) -> Self {
        Self { on_step, now: Mutex::new(Step::Sorting), is_stopped: AtomicBool::new(false) }
    }

    /// Starts a step and reports it. Returns an error if the build is to stop.
    pub(super) fn begin(&self, step: Step) -> Result<(), SpaceBuildError> {
        // The lock is held during the report. Otherwise another thread could report the previous step after this one.
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        *now = step;
        if self.report(step) { Ok(()) } else { Err(SpaceBuildError::Stopped) }
    }

    /// Reports the current step again and returns whether to continue.
    pub(super) fn go_on(&self) -> bool {
        let now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        self.report(*now)
    }

    /// Stops all work of the build.
    pub(super) fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }

    /// Reports a step unless the build was stopped, and returns whether to continue. If the caller's function returns
    /// `false` once, all threads stop.
    fn report(&self, step: Step) -> bool {
        let goes_on = !self.is_stopped.load(Ordering::Relaxed) && (self.on_step)(step);
        if !goes_on {
            self.stop();
        }
        goes_on
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::{Progress, Step};
    use crate::space::space_build::SpaceBuildError;

    #[test]
    fn work_beside_the_sequence_repeats_the_present_step_and_a_stop_stops_all() {
        let told = Mutex::new(Vec::new());
        let on_step = |step| {
            told.lock().unwrap().push(step);
            step != Step::Stability
        };
        let progress = Progress::new(&on_step);
        assert_eq!(progress.begin(Step::Features), Ok(()));
        assert!(progress.go_on());
        // The first `false` stops all work, and the function is not called again.
        assert_eq!(progress.begin(Step::Stability), Err(SpaceBuildError::Stopped));
        assert!(!progress.go_on());
        assert_eq!(progress.begin(Step::Scaling), Err(SpaceBuildError::Stopped));
        assert_eq!(told.into_inner().unwrap(), [Step::Features, Step::Features, Step::Stability]);
    }
}
