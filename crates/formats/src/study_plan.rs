//! Plans of studies, as TOML files.
//!
//! A plan has keys of the whole study, a table `[[stimulus]]` for each thing that is presented, and a table `[[part]]` for each
//! design, in the order of the study:
//!
//! ```
//! let plan = shagreen_formats::study_plan::read_study_plan(br#"
//! format = "shagreen-study"
//! version = "1.0"
//! name = "Two textures on one scale"
//! seed = 1                        # of all orders and of the noise in stimuli
//!
//! [[stimulus]]
//! id = "cork"                     # in tables; participants do not see it
//! texture = "cork"                # id in the library, or: profile = "A"
//! variant = "original"            # original, authored, coded (with kbps) or reconstructed (with window_mm)
//!
//! [[stimulus]]
//! id = "felt"
//! texture = "felt"
//!
//! [[part]]
//! id = "rating"
//! design = "rating"
//! stimuli = ["cork", "felt"]      # all, if the key is missing
//! scales = ["rough-smooth"]       # or: questionnaire = "vrst-2023"; pairs of your own also in own_scales
//! slider_mm = 127
//! "#)?;
//! assert_eq!(plan.parts[0].design.id(), "rating");
//! # Ok::<(), shagreen_formats::study_plan::StudyPlanError>(())
//! ```
//!
//! Every part can also state `title`, `instructions`, `order`, `repeats`, `practice`, `break_every`, `max_plays`,
//! `require_touch` with `touch_mm`, `lead_s`, `stimulus_s`, `gap_s` and `pause_s`.
//!
//! `assets/studies` has a commented plan for each published experiment ([`study_templates`]). An unknown key is an error,
//! because its value would have no effect. All problems are reported at once, each with its line and key: of keys, of what
//! they mean, and of textures that do not exist ([`read_study_plan_with`]).

mod key_problem;
mod keys;
mod read;
mod tables;
mod templates;
mod wire;
mod write;

use shagreen_core::people::study::plan::{Plan, Problem, Source, missing_sources, problems};
use shagreen_core::words::counted;

use crate::text_limits::TooLong;
use crate::toml_lines::{Lines, listed};
use crate::toml_text;

pub use crate::toml_lines::LocatedProblem as PlanProblem;
pub use templates::{StudyTemplate, has_placeholder_consent, study_template, study_templates};
pub use write::write_study_plan;

use self::key_problem::KeyProblem;
use self::read::{Draft, draft};
use self::wire::{HeaderV1, Tables};

/// Value of the `format` key.
pub const FORMAT: &str = "shagreen-study";
/// Version that this program reads and writes.
pub const VERSION: &str = "1.0";

/// Number of problems that are reported; of more, the first ones.
const MOST_PROBLEMS: usize = 100;

/// Why bytes are not a plan that can be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyPlanError {
    /// The file is not UTF-8.
    #[error("the plan is not valid UTF-8 at byte {at}; save the file as UTF-8")]
    NotText {
        /// Offset of the first invalid byte, from zero.
        at: usize,
    },
    /// Not TOML, or not with the keys of any plan.
    #[error("cannot read the plan: {reason}; correct that line of the file")]
    Damaged {
        /// The parser's message with its line number, on one line.
        reason: String,
    },
    /// The file has another format.
    #[error(
        "the file is not a plan of a study: `format` is \"{found}\", not \"{FORMAT}\"; choose another file"
    )]
    Format {
        /// Value of the `format` key.
        found: String,
    },
    /// The file has an unsupported version.
    #[error(
        "the plan has version {found}, but this program reads version {VERSION}; use a newer version of Shagreen"
    )]
    Version {
        /// Value of the `version` key.
        found: String,
    },
    /// A text is too long.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// The plan cannot be run.
    #[error("the plan has {}: {}", counted(.0.len(), "problem"), listed(.0))]
    Problems(Vec<PlanProblem>),
}

/// Reads a plan that can be run. Whether its textures exist is not known here.
///
/// # Errors
/// See [`StudyPlanError`].
pub fn read_study_plan(bytes: &[u8]) -> Result<Plan, StudyPlanError> {
    read_study_plan_with(bytes, |_| None)
}

/// Reads a plan that can be run with textures and profiles that exist. `advice` says what to do about one that does not exist,
/// and nothing about one that does.
///
/// # Errors
/// See [`StudyPlanError`]; what does not exist is among the problems.
pub fn read_study_plan_with(
    bytes: &[u8],
    advice: impl FnMut(&Source) -> Option<String>,
) -> Result<Plan, StudyPlanError> {
    let text = text_of(bytes)?;
    let Draft { plan, problems: mut of_keys, undeclared } = draft_of(text)?;
    of_keys.extend(undeclared);
    let missing = missing_sources(&plan, advice);
    checked(text, plan, of_keys, missing)
}

/// Reads the plan in a log, which may be of an earlier version: adjective pairs need not be declared.
///
/// # Errors
/// See [`StudyPlanError`].
pub(crate) fn read_logged_plan(bytes: &[u8]) -> Result<Plan, StudyPlanError> {
    let text = text_of(bytes)?;
    let Draft { plan, problems: of_keys, .. } = draft_of(text)?;
    checked(text, plan, of_keys, Vec::new())
}

fn text_of(bytes: &[u8]) -> Result<&str, StudyPlanError> {
    std::str::from_utf8(bytes).map_err(|error| StudyPlanError::NotText { at: error.valid_up_to() })
}

/// What a file says, with what is wrong with its keys.
fn draft_of(text: &str) -> Result<Draft, StudyPlanError> {
    let damaged =
        |error: toml::de::Error| StudyPlanError::Damaged { reason: toml_text::reason(&error, text) };
    // The header is checked first: in a newer version, unknown keys are not an error.
    let header: HeaderV1 = toml::from_str(text).map_err(damaged)?;
    if header.format != FORMAT {
        return Err(StudyPlanError::Format { found: header.format });
    }
    if header.version != VERSION {
        return Err(StudyPlanError::Version { found: header.version });
    }
    let mut problems = Vec::new();
    let tables = Tables::of(toml::from_str(text).map_err(damaged)?, &mut problems);
    tables.check_lengths()?;
    Ok(draft(tables, problems))
}

/// The plan if nothing is wrong with it. `missing` are problems of textures that do not exist.
fn checked(
    text: &str,
    plan: Plan,
    of_keys: Vec<KeyProblem>,
    missing: Vec<Problem>,
) -> Result<Plan, StudyPlanError> {
    // A problem of the keys of a table hides those that follow from it.
    let is_new = |key: &str| of_keys.iter().all(|of| of.key != key && !of.hides(key));
    let mut further: Vec<Problem> = problems(&plan).into_iter().filter(|of| is_new(&of.key)).collect();
    for problem in missing.into_iter().filter(|of| is_new(&of.key)) {
        if further.iter().all(|of| of.key != problem.key) {
            further.push(problem);
        }
    }
    let of_keys = of_keys.into_iter().map(|of| Problem { key: of.key, text: of.text });
    let all: Vec<Problem> = of_keys.chain(further).take(MOST_PROBLEMS).collect();
    if all.is_empty() {
        return Ok(plan);
    }
    let mut located = located_problems(text, all);
    // As they stand in the file; what stands nowhere comes first.
    located.sort_by_key(|problem| problem.line);
    Err(StudyPlanError::Problems(located))
}

/// Problems of a plan with the lines of their keys in the text of its file.
pub fn located_problems(text: &str, problems: Vec<Problem>) -> Vec<PlanProblem> {
    let lines = Lines::of(text);
    let located = |Problem { key, text }: Problem| PlanProblem { line: lines.line_of(&key), key, text };
    problems.into_iter().map(located).collect()
}

#[cfg(test)]
mod tests;
