//! Results of a study from its logs: statistics by part, figures, and the tables from which a space is built.
//!
//! A result is either of people or of simulated participants, never of both: with logs of both kinds, the caller chooses one.
//! Each design has a file; `docs/notes/statistics.md` lists the tests. JSON of a result is under the identifier of its part; a
//! number that is infinite or does not exist is null.

mod abx;
mod comparison;
mod discrimination;
mod dissimilarity;
mod files;
mod limits;
mod measure;
mod mushra;
mod read;
mod relevance;
mod scales;
mod sorting;
mod text;
mod thresholds;
mod values;

use std::collections::BTreeSet;
use std::sync::Arc;

use anyhow::bail;
use serde_json::{Map, Value, json};
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::people::study::analysis::limits::{Limited, limited_answers};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Design, Part, Plan};
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::figure::Figure;
use shagreen_formats::library::free_id;
use shagreen_formats::study_plan::has_placeholder_consent;
use shagreen_formats::study_tables::{pairs_csv, tidy_csv};

pub use comparison::{ConditionComparison, SIGNIFICANT, UsedTest};
pub use files::{check_report_files, report_files};
pub use measure::Measure;
pub use read::{ParticipantKind, StudyLogs, read_logs, read_logs_with};
pub use text::report_text;

use self::read::Participant;

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-study-report";
/// Version of the report that this program writes.
pub const VERSION: &str = "1.0";

/// Results of a study.
#[derive(Clone, Debug)]
pub struct StudyReport {
    /// The plan.
    pub plan: Arc<Plan>,
    /// Whether the participants are simulated, or people.
    pub kind: ParticipantKind,
    /// Number of participants with answers.
    pub n_participants: usize,
    /// Number of participants who answered all trials.
    pub n_complete: usize,
    /// Number of further participants who did not agree to the consent text.
    pub n_refused: usize,
    /// Answers that say less than they seem to.
    pub limited: Vec<Limited>,
    /// Results of each part, in the order of the plan.
    pub parts: Vec<PartReport>,
    /// Judgments from which a space is built.
    pub judgments: StudyJudgments,
    /// Sentences about the conditions of the answers, damaged logs, missing answers, and participants who need a look.
    pub warnings: Vec<String>,
    /// Everything as a JSON object.
    pub json: Value,
    /// All answers as a tidy table (CSV).
    pub answers_csv: Vec<u8>,
    /// Counts and d′ of the same-different pairs (CSV), if the study has any.
    pub pairs_csv: Option<Vec<u8>>,
}

/// Results of one part.
#[derive(Clone, Debug)]
pub struct PartReport {
    /// Identifier of the part.
    pub id: String,
    /// Heading of the part, or its identifier.
    pub title: String,
    /// Identifier of the design.
    pub design: &'static str,
    /// Number of answers, without practice.
    pub n_answers: usize,
    /// Main results, in sentences.
    pub findings: Vec<String>,
    /// Tables and charts, each under a short name that serves for files.
    pub figures: Vec<(String, Arc<Figure>)>,
    /// Results by name.
    pub results: Value,
}

/// Judgments of a study in the form from which a space is built.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StudyJudgments {
    /// Sorts of all parts.
    pub sorts: Vec<Sort>,
    /// Ratings on adjective pairs of all parts.
    pub ratings: Vec<Rating>,
    /// Votes on adjectives of all parts.
    pub votes: Vec<RelevanceVote>,
}

/// What the analysis of one design yields.
#[derive(Debug, Default)]
struct Analyzed {
    findings: Vec<String>,
    warnings: Vec<String>,
    /// Each under a short name.
    figures: Vec<(String, Figure)>,
    results: Map<String, Value>,
}

/// Analyzes the logs of participants of one kind.
///
/// # Errors
/// There are logs of people and of simulated participants, and `kind` does not choose; there are none of the chosen kind; or no
/// log has answers.
pub fn analyze(logs: &StudyLogs, kind: Option<ParticipantKind>) -> anyhow::Result<StudyReport> {
    let kind = logs.chosen(kind)?;
    let (participants, of_logs) = logs.participants(kind);
    let n_refused = logs.n_refused(kind);
    if participants.is_empty() {
        let refused = (n_refused > 0).then(|| refused(n_refused));
        let why: Vec<String> = refused.into_iter().chain(of_logs).collect();
        bail!("no log has answers that can be analyzed: {}", why.join("; "));
    }
    let plan = Arc::clone(logs.plan());
    let records: Vec<Record> = participants.iter().map(|participant| participant.record.clone()).collect();
    let limited = limited_answers(&plan, &records);
    let mut warnings: Vec<String> = limited.iter().map(limits::warning).collect();
    if kind == ParticipantKind::People && has_placeholder_consent(&plan) {
        warnings.push("the participants agreed to the placeholder of the consent text".to_owned());
    }
    warnings.extend(of_logs);
    let source = source_of(records.len(), kind);
    let mut judgments = StudyJudgments::default();
    let mut parts = Vec::with_capacity(plan.parts.len());
    let mut names: BTreeSet<String> = BTreeSet::new();
    for (index, part) in plan.parts.iter().enumerate() {
        let mut analyzed = analyze_part(&plan, part, &records, &mut judgments);
        warnings.extend(analyzed.warnings.iter().map(|warning| format!("part \"{}\": {warning}", part.id)));
        let named = |(name, mut figure): (String, Figure)| {
            figure.set_source(&source);
            let name = values::file_name(index + 1, &part.id, &name);
            let name = free_id(&name, |name| names.contains(name));
            names.insert(name.clone());
            (name, Arc::new(figure))
        };
        let figures = std::mem::take(&mut analyzed.figures).into_iter().map(named).collect();
        parts.push(reported(part, &records, analyzed, figures));
    }
    let mut report = StudyReport {
        kind,
        n_participants: records.len(),
        n_complete: participants.iter().filter(|participant| participant.is_complete).count(),
        n_refused,
        limited,
        parts,
        judgments,
        warnings,
        json: Value::Null,
        answers_csv: tidy_csv(&plan, &records),
        pairs_csv: pairs_csv(&plan, &records),
        plan,
    };
    report.json = report_json(&report, &participants);
    Ok(report)
}

fn refused(n: usize) -> String {
    format!("{} did not agree to the consent text", counted(n, "participant"))
}

impl StudyReport {
    /// Number and kind of the participants, in words.
    pub fn who(&self) -> String {
        let n = counted(self.n_participants, "participant");
        match self.kind {
            ParticipantKind::People => {
                let of_answers = format!("{n}, {} with all answers", self.n_complete);
                if self.n_refused == 0 {
                    of_answers
                } else {
                    format!("{of_answers}; {}", refused(self.n_refused))
                }
            }
            ParticipantKind::Simulated => format!("{n}, all SIMULATED: the results say nothing about people"),
        }
    }
}

impl ParticipantKind {
    /// Source of judgments of these participants.
    pub fn label_source(self) -> LabelSource {
        match self {
            Self::People => LabelSource::HumanRatings,
            Self::Simulated => LabelSource::SimulatedRaters,
        }
    }
}

/// Number and kind of participants, for figures.
fn source_of(n: usize, kind: ParticipantKind) -> String {
    match kind {
        ParticipantKind::People => counted(n, "participant"),
        ParticipantKind::Simulated => counted(n, "SIMULATED participant"),
    }
}

fn analyze_part(plan: &Plan, part: &Part, records: &[Record], judgments: &mut StudyJudgments) -> Analyzed {
    match &part.design {
        Design::Sorting { .. } => sorting::analyze(plan, part, records, &mut judgments.sorts),
        Design::Relevance { .. } => relevance::analyze(plan, part, records, &mut judgments.votes),
        Design::Rating { .. } => scales::ratings(plan, part, records, &mut judgments.ratings),
        Design::Dissimilarity { .. } => dissimilarity::analyze(plan, part, records),
        Design::SameDifferent { .. } => discrimination::analyze(part, records),
        Design::Staircase { .. } => thresholds::analyze(part, records),
        Design::Similarity { .. } => scales::similarities(part, records),
        Design::Likert { .. } => scales::questionnaire(part, records),
        Design::Abx { .. } => abx::analyze(part, records),
        Design::Mushra { .. } => mushra::analyze(part, records),
        Design::Anchors { .. } => scales::positions(part, records),
    }
}

fn reported(
    part: &Part,
    records: &[Record],
    analyzed: Analyzed,
    figures: Vec<(String, Arc<Figure>)>,
) -> PartReport {
    let answers = records.iter().flat_map(|record| &record.answers);
    let n_answers =
        answers.filter(|answer| answer.trial.part == part.id && !answer.trial.is_practice).count();
    let Analyzed { findings, results, .. } = analyzed;
    PartReport {
        id: part.id.clone(),
        title: if part.title.is_empty() { part.id.clone() } else { part.title.clone() },
        design: part.design.id(),
        n_answers,
        findings,
        figures,
        results: Value::Object(results),
    }
}

fn report_json(report: &StudyReport, participants: &[Participant]) -> Value {
    let person = |participant: &Participant| {
        json!({
            "participant": participant.record.participant,
            "number": participant.record.number,
            "answers": participant.record.answers.len(),
            "complete": participant.is_complete,
            "log": participant.path.display().to_string(),
        })
    };
    let result = |part: &PartReport| {
        let mut of_part = part.results.clone();
        of_part["design"] = json!(part.design);
        of_part["title"] = json!(part.title);
        of_part["answers"] = json!(part.n_answers);
        of_part["findings"] = json!(part.findings);
        (part.id.clone(), of_part)
    };
    json!({
        "format": FORMAT,
        "version": VERSION,
        "created_by": super::program(),
        "study": report.plan.name,
        "n_participants": report.n_participants,
        "n_complete": report.n_complete,
        "n_refused": report.n_refused,
        "simulated": report.kind == ParticipantKind::Simulated,
        "label_source": report.kind.label_source().id(),
        "participants": participants.iter().map(person).collect::<Vec<_>>(),
        "limits": limits::json(&report.limited),
        "results": report.parts.iter().map(result).collect::<Map<String, Value>>(),
        "warnings": report.warnings,
    })
}

#[cfg(test)]
mod tests;
