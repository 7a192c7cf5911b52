//! Why a session does not go on.

use shagreen_core::people::study::answer::ResponseError;
use shagreen_core::people::study::progress::ProgressError;
use shagreen_formats::study_log::LogError;

/// Why a session does not go on. Everything before stays on the disk.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The event is not saved. The session keeps it; see [`retry`](super::StudySession::retry).
    #[error(transparent)]
    Log(#[from] LogError),
    /// An event before is not saved yet.
    #[error("the last answer is not saved yet; save it again before you go on")]
    Unsaved,
    /// The session does not ask for consent.
    #[error("the session does not ask for consent now; continue with its next step")]
    NoConsent,
    /// The session is not at a trial.
    #[error("the session does not wait for an answer; continue with its next step")]
    NoTrial,
    /// The response does not answer the trial.
    #[error(transparent)]
    Response(#[from] ResponseError),
    /// The answer does not belong to the session.
    #[error(transparent)]
    Progress(#[from] ProgressError),
}
