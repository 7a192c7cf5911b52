//! `shagreen study preview`: shows what a participant of a plan meets.

use std::path::PathBuf;

use serde_json::{Value, json};
use shagreen_core::words::counted;
use shagreen_formats::study_plan::has_placeholder_consent;
use shagreen_studio::study::plans::{StudyPlan, load_plan_with};
use shagreen_studio::study::preview::{PartPreview, StudyPreview, preview};

use crate::cli::output;
use crate::cli::study::textures::TextureArgs;

/// Checks a plan and shows what a participant meets: parts, trials, labels, and the estimated time.
///
/// All problems of the plan are reported at once, each with its line. The times are estimates.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Plan file.
    #[arg(value_name = "PLAN.toml")]
    plan: PathBuf,
    /// Number of the participant, from 1, which determines the orders.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = crate::cli::quantity::count(1..=1_000_000))]
    participant: usize,
    /// Show every trial.
    #[arg(long)]
    trials: bool,
    #[command(flatten)]
    textures: TextureArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Number of trials that are shown without --trials.
const N_SHOWN: usize = 5;

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let study = load_plan_with(&args.plan, &args.textures.load()?)?;
    let meets = preview(&study, args.participant)?;
    output::print(args.json, &as_json(&study, &meets), || in_words(&study, &meets, args.trials));
    Ok(())
}

fn as_json(study: &StudyPlan, meets: &StudyPreview) -> Value {
    let part = |part: &PartPreview| {
        json!({
            "id": part.id,
            "title": part.title,
            "design": part.design,
            "practice": part.n_practice,
            "trials": part.n_scored,
            "trials_are_estimated": part.is_estimated,
            "breaks": part.n_breaks,
            "touch_mm": part.touch_mm,
            "minutes": part.minutes,
            "stimuli": part.stimuli,
            "order": part.trials,
        })
    };
    let plan = &study.plan;
    json!({
        "study": plan.name,
        "n_participants": null,
        "simulated": false,
        "participant": meets.participant,
        "consent": !plan.consent.trim().is_empty(),
        "consent_is_placeholder": has_placeholder_consent(plan),
        "masking_noise": plan.masking_noise.is_some(),
        "trials": meets.n_trials,
        "minutes": meets.minutes,
        "balanced_multiple": meets.balanced_multiple,
        "parts": meets.parts.iter().map(part).collect::<Vec<_>>(),
    })
}

fn in_words(study: &StudyPlan, meets: &StudyPreview, shows_all: bool) -> String {
    let plan = &study.plan;
    let mut lines = vec![format!(
        "{}: participant {} meets {} in {}, about {:.0} minutes",
        plan.name,
        meets.participant,
        counted(meets.n_trials, "trial"),
        counted(meets.parts.len(), "part"),
        meets.minutes.max(1.0)
    )];
    if plan.consent.trim().is_empty() {
        lines.push("There is no consent text.".to_owned());
    }
    if has_placeholder_consent(plan) {
        lines.push(
            "The consent text is the placeholder of the built-in plan; replace `consent` before you invite people."
                .to_owned(),
        );
    }
    if plan.masking_noise.is_some() {
        lines.push("Masking noise plays on a second output, which the window asks for.".to_owned());
    }
    if meets.balanced_multiple > 1 {
        lines.push(format!(
            "The orders are balanced for a multiple of {} participants.",
            meets.balanced_multiple
        ));
    }
    for (index, part) in meets.parts.iter().enumerate() {
        lines.push(format!("\nPart {}: {}", index + 1, part_line(part)));
        let n_shown = if shows_all { usize::MAX } else { N_SHOWN };
        lines.extend(part.trials.iter().take(n_shown).map(|trial| format!("  {trial}")));
        let n_more = part.trials.len().saturating_sub(n_shown);
        if n_more > 0 {
            lines.push(format!("  and {n_more} more; --trials shows all"));
        }
    }
    lines.join("\n")
}

fn part_line(part: &PartPreview) -> String {
    let about = if part.is_estimated { "about " } else { "" };
    let line = format!(
        "{} ({}, {}): {} of practice, {about}{} that count, about {:.0} minutes",
        part.title,
        part.id,
        part.design,
        part.n_practice,
        part.n_scored,
        part.minutes.max(1.0)
    );
    let breaks =
        if part.n_breaks > 0 { format!(", {}", counted(part.n_breaks, "break")) } else { String::new() };
    let stimuli = if part.stimuli.is_empty() {
        String::new()
    } else {
        format!("\n  {} stimuli: {}", part.stimuli.len(), part.stimuli.join(", "))
    };
    let touch = part.touch_mm.map_or_else(String::new, |least_mm| {
        format!("\n  an answer needs a stroke of {least_mm} mm over each stimulus")
    });
    line + &breaks + &stimuli + &touch
}
