//! The run of a batch: its jobs on several threads.

use std::sync::atomic::{AtomicBool, Ordering};

use shagreen_core::maths::shard::Shard;

use super::BatchPlan;
use super::folder::prepare;
use super::job::perform;
use super::outcome::{BatchOptions, BatchOutcome};
use crate::parallel::in_parallel_by;

impl BatchPlan {
    /// Number of jobs that a run of this part has.
    pub fn n_jobs(&self, shard: Shard) -> usize {
        shard.indices(self.n_textures()).count() * self.n_jobs_each()
    }

    /// Makes the files that are not there yet. A job that fails does not stop the others. `on_job` is called after each job, from
    /// several threads; it returns whether to continue.
    ///
    /// # Errors
    /// The folder has files that no batch wrote, or cannot be written.
    pub fn run(
        &self,
        options: &BatchOptions<'_>,
        on_job: &(dyn Fn() -> bool + Sync),
    ) -> anyhow::Result<BatchOutcome> {
        let outputs: Vec<&str> = self.manifest.outputs.iter().map(|output| output.id.as_str()).collect();
        prepare(options.folder, &self.manifest.name, &outputs)?;
        let targets: Vec<usize> = options.shard.indices(self.n_textures()).collect();
        let is_stopped = AtomicBool::new(false);
        let goes_on = || {
            let goes_on = on_job() && !is_stopped.load(Ordering::Relaxed);
            if !goes_on {
                is_stopped.store(true, Ordering::Relaxed);
            }
            goes_on
        };
        let done = in_parallel_by(options.n_threads, targets.len(), |index| {
            if is_stopped.load(Ordering::Relaxed) {
                return Vec::new();
            }
            perform(self, &self.targets[targets[index]], options, &goes_on)
        });
        let jobs = done.into_iter().flatten().collect();
        Ok(BatchOutcome { jobs, n_jobs: self.n_jobs(options.shard) })
    }
}
