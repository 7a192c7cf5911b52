//! Problems of a plan, all at once, each with the key of the plan file that it belongs to.

mod designs;

use std::collections::BTreeSet;
use std::fmt;

use crate::people::study::plan::{Design, Part, Plan, Source, Stimulus, Variant};
use crate::words::counted;

use self::designs::check_design;

/// Something that is wrong with a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Key in the plan file, such as `part[2].pairs`: the second `[[part]]`, its key `pairs`. Entries count from 1.
    pub key: String,
    /// What is wrong and what to do.
    pub text: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.key, self.text)
    }
}

/// A plan that cannot be run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the plan has {}: {}", counted(.problems.len(), "problem"), shown(.problems))]
pub struct PlanError {
    /// At least one problem.
    pub problems: Vec<Problem>,
}

/// Highest number of stimuli of a plan.
pub const MAX_STIMULI: usize = MANY;
/// Highest number of parts of a plan.
pub const MAX_PARTS: usize = 100;
/// Highest number of repeats, practice trials, and entries of a list.
const MANY: usize = 1000;
/// Highest number of trials of a participant.
const MOST_TRIALS: usize = 20_000;
/// Highest number of stimuli that a participant is presented with in one part.
const MOST_PRESENTED: usize = 200_000;
/// Longest time of presentation, in s.
const LONGEST_SECS: f64 = 3600.0;
/// Shortest and longest distance of a required touch, in mm.
const TOUCH_MM: (f64, f64) = (1.0, 1000.0);
/// Largest change of a level, in dB.
const LARGEST_DB: f64 = 60.0;

fn shown(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// Checks that a plan can be run.
///
/// # Errors
/// [`PlanError`] with all problems.
pub fn check_plan(plan: &Plan) -> Result<(), PlanError> {
    let problems = problems(plan);
    if problems.is_empty() { Ok(()) } else { Err(PlanError { problems }) }
}

/// Everything that is wrong with a plan, in the order of its keys; empty if it can be run.
pub fn problems(plan: &Plan) -> Vec<Problem> {
    let mut checks = Checks {
        stimuli: plan.stimuli.iter().map(|stimulus| stimulus.id.as_str()).collect(),
        at: String::new(),
        found: Vec::new(),
    };
    if plan.name.trim().is_empty() {
        checks.add("name", "the study has no name; give it one");
    }
    if i64::try_from(plan.seed).is_err() {
        checks.add(
            "seed",
            format!("{} is above the largest seed, {}; choose a smaller one", plan.seed, i64::MAX),
        );
    }
    if let Some(noise) = plan.masking_noise {
        checks.within("masking_noise.level_db", noise.level_db, -120.0, 0.0);
    }
    // A staircase of gaps needs no stimuli.
    checks.check_length("stimulus", plan.stimuli.len().max(1), "stimulus");
    checks.check_length("part", plan.parts.len(), "part");
    if plan.parts.len() > MAX_PARTS {
        checks.add("part", format!("there are more than {MAX_PARTS} parts; split the study"));
    }
    check_stimuli(&plan.stimuli, &mut checks);
    let mut ids = BTreeSet::new();
    for (index, part) in plan.parts.iter().enumerate() {
        checks.at = format!("part[{}].", index + 1);
        checks.check_id(&part.id, &mut ids);
        check_part(part, &mut checks);
    }
    checks.at.clear();
    let n_trials = plan.parts.iter().fold(0_usize, |sum, part| sum.saturating_add(n_trials(part)));
    if n_trials > MOST_TRIALS {
        let text =
            format!("{n_trials} trials exceed the maximum of {MOST_TRIALS}; reduce repeats or comparisons");
        checks.add("part", text);
    }
    checks.found
}

/// Stimuli whose texture or profile does not exist. A study with such stimuli must not begin. `advice` says what to do about
/// a source that does not exist, and nothing about one that does.
pub fn missing_sources(plan: &Plan, mut advice: impl FnMut(&Source) -> Option<String>) -> Vec<Problem> {
    let problem = |(index, stimulus): (usize, &Stimulus)| {
        let advice = advice(&stimulus.source)?;
        let (key, name) = source_key(&stimulus.source);
        let text = format!("there is no {key} \"{name}\"; {advice}");
        Some(Problem { key: format!("stimulus[{}].{key}", index + 1), text })
    };
    plan.stimuli.iter().enumerate().filter_map(problem).collect()
}

/// Key of a source in the plan file, and its name.
fn source_key(source: &Source) -> (&'static str, &str) {
    match source {
        Source::Texture(name) => ("texture", name),
        Source::Profile(name) => ("profile", name),
    }
}

fn check_stimuli(stimuli: &[Stimulus], checks: &mut Checks<'_>) {
    let mut ids = BTreeSet::new();
    for (index, stimulus) in stimuli.iter().enumerate() {
        checks.at = format!("stimulus[{}].", index + 1);
        checks.check_id(&stimulus.id, &mut ids);
        let (key, name) = source_key(&stimulus.source);
        if name.trim().is_empty() {
            checks.add(key, "the name is empty; name what the stimulus is made of");
        }
        match stimulus.variant {
            Variant::Original | Variant::Authored => {}
            Variant::Coded { kbps } => checks.within("kbps", kbps, 0.1, 1000.0),
            Variant::Reconstructed { window_mm } => checks.within("window_mm", window_mm, 0.01, 1000.0),
        }
        checks.within("level_db", stimulus.level_db, -LARGEST_DB, LARGEST_DB);
        let is_same = |other: &Stimulus| {
            (&other.source, other.variant, other.level_db)
                == (&stimulus.source, stimulus.variant, stimulus.level_db)
        };
        // A plan with more stimuli is refused in any case.
        let before = &stimuli[..index.min(MAX_STIMULI)];
        if let Some(twin) = before.iter().find(|other| other.id != stimulus.id && is_same(other)) {
            let text = format!("it is the same as \"{}\"; use one of the two, or change one", twin.id);
            checks.add("id", text);
        }
    }
}

fn check_part(part: &Part, checks: &mut Checks<'_>) {
    checks.count("repeats", part.n_repeats, 1, MANY);
    checks.count("practice", part.n_practice, 0, MANY);
    if part.break_every == Some(0) {
        checks.add("break_every", "a break cannot come after 0 trials; state 1 or more, or remove the key");
    }
    if part.max_plays == Some(0) {
        checks.add("max_plays", "0 plays leave nothing to feel; state 1 or more, or remove the key");
    }
    if let Some(least_mm) = part.touch_mm {
        checks.within("touch_mm", least_mm, TOUCH_MM.0, TOUCH_MM.1);
    }
    let timing = part.timing;
    let times = [("lead_s", timing.lead_secs), ("gap_s", timing.gap_secs), ("pause_s", timing.pause_secs)];
    for (key, secs) in times {
        checks.within(key, secs, 0.0, LONGEST_SECS);
    }
    if let Some(secs) = timing.stimulus_secs {
        checks.within("stimulus_s", secs, 0.05, LONGEST_SECS);
    }
    check_design(&part.design, checks);
    if matches!(part.design, Design::Relevance { .. }) && part.n_repeats > 1 {
        checks.add("repeats", "a participant votes once on each adjective and stimulus; set it to 1");
    }
    let n_presented = match &part.design {
        Design::Sorting { stimuli, .. } => stimuli.len(),
        Design::Mushra { pages } => {
            pages.iter().map(|page| page.tested.len() + page.anchors.len()).max().unwrap_or(0)
        }
        _ => 1,
    };
    if n_trials(part).saturating_mul(n_presented) > MOST_PRESENTED {
        checks.add("repeats", "the part presents too many stimuli; reduce repeats, practice or the lists");
    }
}

/// Number of trials of a part, without those of staircases that follow from the answers.
fn n_trials(part: &Part) -> usize {
    let scored = part.design.n_trials().map_or(0, |n| n.saturating_mul(part.n_repeats));
    scored.saturating_add(part.n_practice)
}

/// Problems found so far, and what later checks need.
struct Checks<'a> {
    /// Identifiers of the stimuli.
    stimuli: BTreeSet<&'a str>,
    /// Key of the table that is being checked, with its final dot.
    at: String,
    found: Vec<Problem>,
}

impl Checks<'_> {
    fn add(&mut self, key: &str, text: impl Into<String>) {
        self.found.push(Problem { key: format!("{}{key}", self.at), text: text.into() });
    }

    fn within(&mut self, key: &str, value: f64, low: f64, high: f64) {
        if !(low..=high).contains(&value) {
            self.add(key, format!("{value} is out of range; choose {low} to {high}"));
        }
    }

    fn count(&mut self, key: &str, n: usize, least: usize, most: usize) {
        if !(least..=most).contains(&n) {
            self.add(key, format!("{n} is out of range; choose {least} to {most}"));
        }
    }

    /// Checks that a list has entries, and not too many.
    fn check_length(&mut self, key: &str, n: usize, noun: &str) {
        if n == 0 {
            self.add(key, format!("there is no {noun}; add at least one"));
        } else if n > MANY {
            self.add(key, format!("there are more than {MANY} entries; split the study"));
        }
    }

    /// Checks an identifier, and that it is the first of its name.
    fn check_id<'b>(&mut self, id: &'b str, ids: &mut BTreeSet<&'b str>) {
        if id.trim().is_empty() || id.trim() != id || id.contains(['|', '\n']) {
            let text =
                format!("{id:?} is not an identifier; use letters, digits and hyphens, such as \"cork-2\"");
            self.add("id", text);
        }
        if !ids.insert(id) {
            self.add("id", format!("\"{id}\" is already used above; choose another identifier"));
        }
    }

    /// Checks that stimuli exist.
    fn check_known(&mut self, key: &str, ids: &[&str]) {
        let distinct: BTreeSet<&str> = ids.iter().copied().collect();
        for id in distinct {
            if !self.stimuli.contains(id) {
                self.add(
                    key,
                    format!("there is no stimulus \"{id}\"; correct the name, or add a [[stimulus]] for it"),
                );
            }
        }
    }

    /// Checks that a list of words has entries, none of them empty or twice.
    fn check_words(&mut self, key: &str, words: &[&str], noun: &str) {
        self.check_length(key, words.len(), noun);
        let mut seen = BTreeSet::new();
        for word in words.iter().copied() {
            if word.trim().is_empty() {
                self.add(key, format!("a {noun} is empty; fill it in, or remove it"));
            } else if !seen.insert(word) {
                self.add(key, format!("\"{word}\" is listed twice; remove one of the two"));
            }
        }
    }

    /// Checks that a list of stimuli has enough entries, none of them unknown or twice.
    fn check_stimuli(&mut self, stimuli: &[String], least: usize) {
        let ids = texts(stimuli);
        self.check_words("stimuli", &ids, "stimulus");
        if stimuli.len() < least && !stimuli.is_empty() {
            self.add(
                "stimuli",
                format!("{} of {least} stimuli that this design needs; add some", stimuli.len()),
            );
        }
        self.check_known("stimuli", &ids);
    }
}

fn texts(list: &[String]) -> Vec<&str> {
    list.iter().map(String::as_str).collect()
}
