//! Progress of a background job, and whether it was stopped.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Shared by a job and its thread.
#[derive(Debug, Default)]
pub(super) struct Course {
    n_done: AtomicUsize,
    n_steps: AtomicUsize,
    is_stopped: AtomicBool,
}

impl Course {
    /// Sets the number of steps; without one, the job reports no progress.
    pub(super) fn set_steps(&self, n_steps: usize) {
        self.n_steps.store(n_steps, Ordering::Relaxed);
    }

    /// Counts a step; returns whether to continue.
    pub(super) fn step(&self, ctx: &egui::Context) -> bool {
        self.n_done.fetch_add(1, Ordering::Relaxed);
        ctx.request_repaint();
        !self.is_stopped.load(Ordering::Relaxed)
    }

    /// Progress, 0 to 1, if the job has steps.
    pub(super) fn progress(&self) -> Option<f32> {
        let n_steps = self.n_steps.load(Ordering::Relaxed);
        (n_steps > 0).then(|| self.n_done.load(Ordering::Relaxed) as f32 / n_steps as f32)
    }

    /// Stops the job at its next step.
    pub(super) fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }
}
