//! Progress of a background job, and whether it was stopped.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Shared by a job and its thread.
#[derive(Debug, Default)]
pub(crate) struct Course {
    n_done: AtomicUsize,
    n_steps: AtomicUsize,
    is_stopped: AtomicBool,
}

impl Course {
    /// Sets the number of steps; without one, the job reports no progress.
    pub(crate) fn set_steps(&self, n_steps: usize) {
        self.n_steps.store(n_steps, Ordering::Relaxed);
    }

    /// Counts a step; returns whether to continue.
    pub(crate) fn step(&self, ctx: &egui::Context) -> bool {
        self.n_done.fetch_add(1, Ordering::Relaxed);
        ctx.request_repaint();
        !self.is_stopped.load(Ordering::Relaxed)
    }

    /// Sets the number of finished steps and of all steps; returns whether to continue.
    pub(crate) fn reach(&self, n_done: usize, n_steps: usize, ctx: &egui::Context) -> bool {
        self.n_done.store(n_done, Ordering::Relaxed);
        self.set_steps(n_steps);
        ctx.request_repaint();
        !self.is_stopped.load(Ordering::Relaxed)
    }

    /// Progress, 0 to 1, if the job has steps.
    pub(crate) fn progress(&self) -> Option<f32> {
        let n_steps = self.n_steps.load(Ordering::Relaxed);
        (n_steps > 0).then(|| self.n_done.load(Ordering::Relaxed) as f32 / n_steps as f32)
    }

    /// Stops the job at its next step.
    pub(crate) fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }
}
