//! Analysis of the sessions of the open study, in the background.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_studio::figure_files::write_together;
use shagreen_studio::file::one_line;
use shagreen_studio::study::analysis::{
    ParticipantKind, StudyReport, analyze, check_report_files, read_logs_with, report_files,
};
use shagreen_studio::study::plans::StudyPlan;

use crate::state::background::in_background;
use crate::strings::studies as strings;

/// Results of people and of simulated participants, which are never mixed.
pub(super) struct Results {
    /// One report for each kind of participants that there are, people first.
    pub(super) reports: Vec<StudyReport>,
    /// Report that is shown.
    pub(super) shown: usize,
    /// Figure that is shown of each part, by the index of the part.
    pub(super) figures: Vec<usize>,
    /// Folder of the report, as it is typed.
    pub(super) folder: String,
    /// Outcome of saving the report: its folder, or why it is not saved.
    pub(super) saved: Option<Result<String, String>>,
    saving: Option<Receiver<Result<String, String>>>,
}

/// Analysis that runs.
pub(super) struct Analysis(Receiver<Result<Vec<StudyReport>, String>>);

impl Analysis {
    /// Begins to analyze the logs of a folder, which belong to a plan.
    pub(super) fn begin(folder: PathBuf, study: StudyPlan, ctx: &Context) -> Self {
        Self(in_background(ctx.clone(), move || reports(&folder, &study)))
    }

    /// The results once they are computed, or why there are none.
    pub(super) fn collect(&self) -> Option<Result<Vec<StudyReport>, String>> {
        match self.0.try_recv() {
            Ok(done) => Some(done),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(strings::BROKEN_OFF.to_owned())),
        }
    }
}

/// One report for each kind of participants.
fn reports(folder: &Path, study: &StudyPlan) -> Result<Vec<StudyReport>, String> {
    let in_words = |error: anyhow::Error| one_line(&error);
    // The plan recovers logs whose first line is damaged.
    let logs = read_logs_with(&[folder.to_owned()], Some(study)).map_err(in_words)?;
    let kinds = [ParticipantKind::People, ParticipantKind::Simulated];
    let present = kinds.into_iter().zip(logs.counts()).filter(|(_, n)| *n > 0);
    let mut present: Vec<Option<ParticipantKind>> = present.map(|(kind, _)| Some(kind)).collect();
    if present.is_empty() {
        // The analysis says why there is nothing to analyze.
        present.push(None);
    }
    present.into_iter().map(|kind| analyze(&logs, kind).map_err(in_words)).collect()
}

impl Results {
    /// Results with these reports, to be saved in a folder.
    pub(super) fn new(reports: Vec<StudyReport>, folder: &Path) -> Self {
        let folder = folder.display().to_string();
        Self { reports, shown: 0, figures: Vec::new(), folder, saved: None, saving: None }
    }

    /// Report that is shown.
    pub(super) fn report(&self) -> Option<&StudyReport> {
        self.reports.get(self.shown)
    }

    /// Whether a report is being saved.
    pub(super) fn is_saving(&self) -> bool {
        self.saving.is_some()
    }

    /// Saves the report that is shown in the background.
    pub(super) fn save(&mut self, ctx: &Context) {
        let Some(report) = self.report() else { return };
        let folder = PathBuf::from(self.folder.trim());
        let report = report.clone();
        self.saved = None;
        self.saving = Some(in_background(ctx.clone(), move || {
            let folder = std::path::absolute(&folder).map_err(|error| error.to_string())?;
            let files = report_files(&report, &folder);
            let written =
                check_report_files(&folder, &files).and_then(|()| write_together(&files, Some(&folder)));
            written.map(|()| folder.display().to_string()).map_err(|error| one_line(&error))
        }));
    }

    /// Takes in the outcome of saving.
    pub(super) fn collect(&mut self) {
        let Some(saving) = &self.saving else { return };
        self.saved = match saving.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => Some(Err(strings::BROKEN_OFF.to_owned())),
            Ok(saved) => Some(saved),
        };
        self.saving = None;
    }
}
