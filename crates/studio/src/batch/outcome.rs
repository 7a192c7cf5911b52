//! Options of the run of a batch, and what came of its jobs.

use std::path::Path;

use shagreen_core::maths::shard::Shard;
use shagreen_formats::batch_record::BatchRecordV1;

/// Where and how a batch runs.
#[derive(Clone, Copy, Debug)]
pub struct BatchOptions<'a> {
    /// Folder of all files. It is created if it does not exist.
    pub folder: &'a Path,
    /// Number of threads, at least 1.
    pub n_threads: usize,
    /// Part of the textures that this run makes.
    pub shard: Shard,
    /// Name and version of the program, for the files.
    pub created_by: &'a str,
}

/// What came of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobOutcome {
    /// Name of the job: its output and the name of its files, such as `wav/cork--slow`.
    pub name: String,
    /// Whether its files are there.
    pub state: JobState,
    /// Its record, if its files are there.
    pub record: Option<BatchRecordV1>,
}

/// Whether the files of a job are there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JobState {
    /// An earlier run has written them.
    Kept,
    /// This run has written them.
    Written,
    /// They could not be made, with the reason.
    Failed(String),
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BatchOutcome {
    /// The jobs of this run in their order. A run that was stopped has not begun some of them.
    pub jobs: Vec<JobOutcome>,
    /// Number of jobs of this run.
    pub n_jobs: usize,
}

impl BatchOutcome {
    /// Number of jobs whose files this run has written.
    pub fn n_written(&self) -> usize {
        self.jobs.iter().filter(|job| job.state == JobState::Written).count()
    }

    /// Number of jobs whose files were there already.
    pub fn n_kept(&self) -> usize {
        self.jobs.iter().filter(|job| job.state == JobState::Kept).count()
    }

    /// Names of the jobs that failed, and why.
    pub fn failed(&self) -> impl Iterator<Item = (&str, &str)> {
        self.jobs.iter().filter_map(|job| match &job.state {
            JobState::Failed(reason) => Some((job.name.as_str(), reason.as_str())),
            JobState::Kept | JobState::Written => None,
        })
    }
}
