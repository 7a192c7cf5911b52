//! `shagreen study power`: estimates how many participants a plan needs.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::people::study::power::Power;
use shagreen_studio::study::plans::load_plan;
use shagreen_studio::study::power::{PowerOptions, PowerReport, USUAL_NUMBERS, study_power};

use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::quantity::{count, within};
use crate::cli::study::observers::{ObserverArgs, observers_json};
use crate::cli::study::run::points;

/// Estimates how many participants a plan needs, from simulations of one of its parts.
///
/// The power is the share of simulated studies in which the decision of the design holds, for example that the stimuli differ
/// (p < 0.05). It depends on the stated effect and on what the simulated participants are, not on people.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Plan file.
    #[arg(value_name = "PLAN.toml")]
    plan: PathBuf,
    /// Part to simulate, by id. Default: the first one.
    #[arg(long, value_name = "ID")]
    part: Option<String>,
    /// Difference between what is compared, in points of a scale of 0 to 100. A staircase has no effect, but --precision.
    #[arg(long, value_name = "POINTS", default_value_t = 20.0, value_parser = points)]
    effect: f64,
    /// Wanted precision of the threshold of a staircase, in percent of it.
    #[arg(long, value_name = "PERCENT", default_value_t = 20.0, value_parser = percent)]
    precision: f64,
    /// Numbers of participants, separated by commas.
    #[arg(long, value_name = "N,M", value_delimiter = ',', default_values_t = USUAL_NUMBERS, value_parser = count(1..=1000))]
    participants: Vec<usize>,
    /// Number of simulated studies for each number of participants.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = count(1..=100_000))]
    studies: usize,
    /// Wanted power, in percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 80.0, value_parser = percent)]
    power: f64,
    #[command(flatten)]
    observers: ObserverArgs,
    /// Random seed; the same seed gives the same result.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Steps of the progress.
const N_STEPS: usize = 100;

fn percent(text: &str) -> Result<f64, String> {
    within(text, &(0.0..=100.0), "percent")
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let study = load_plan(&args.plan)?;
    let options = PowerOptions {
        part: args.part.clone(),
        numbers: args.participants.clone(),
        n_studies: args.studies,
        effect_points: args.effect,
        precision: 0.01 * args.precision,
        wanted: 0.01 * args.power,
        observers: args.observers.observers(),
        seed: args.seed,
    };
    let progress = Progress::new("simulating studies", N_STEPS);
    let report = study_power(&study, &options, &|_, n_groups| {
        progress.steps(N_STEPS / n_groups.max(1));
        true
    })?;
    progress.finish();
    let row = |power: &Power| {
        json!({
            "participants": power.n_participants,
            "power": power.share(),
            "standard_error": power.standard_error(),
            "studies": power.n_studies,
        })
    };
    output::print(
        args.json,
        &json!({
            "study": study.plan.name,
            "n_participants": report.needed,
            "simulated": true,
            "part": report.part,
            "design": report.design,
            "decision": report.decision,
            "effect_points": options.effect_points,
            "precision": options.precision,
            "wanted": options.wanted,
            "power": report.powers.iter().map(row).collect::<Vec<_>>(),
            "observers": observers_json(&options.observers),
            "seed": options.seed,
        }),
        || in_words(&study.plan.name, &report, &options),
    );
    Ok(())
}

fn in_words(name: &str, report: &PowerReport, options: &PowerOptions) -> String {
    let mut lines = vec![
        format!("{name}, part {} ({}), with SIMULATED participants", report.part, report.design),
        format!("Decision: {}", report.decision),
        format!("Effect: {} points", options.effect_points),
        format!("{:>12} {:>8} {:>16}", "participants", "power", "standard error"),
    ];
    lines.extend(report.powers.iter().map(|power| {
        format!(
            "{:>12} {:>6.0} % {:>14.1} %",
            power.n_participants,
            100.0 * power.share(),
            100.0 * power.standard_error()
        )
    }));
    let wanted = 100.0 * options.wanted;
    lines.push(match report.needed {
        Some(n) => format!(
            "A power of {wanted:.0} % needs {n} participants of these numbers, if people are like the simulated ones."
        ),
        None => format!("None of these numbers has a power of {wanted:.0} %; try more with --participants."),
    });
    lines.join("\n")
}
