//! `shagreen study run`: simulated participants answer a plan.

use std::path::PathBuf;

use anyhow::anyhow;
use serde_json::{Map, Value, json};
use shagreen_core::people::study::plan::{Part, Plan};
use shagreen_core::people::study::simulated::{Observers, World};
use shagreen_core::words::counted;
use shagreen_studio::study::logs::usual_simulated_log_folder;
use shagreen_studio::study::plans::load_plan_with;
use shagreen_studio::study::simulation::{
    ReplacesLogs, Simulation, replace_simulated_logs, simulated_logs, write_simulated_logs,
};

use crate::cli::output::{self, Usage};
use crate::cli::progress::Progress;
use crate::cli::quantity::{count, within};
use crate::cli::study::observers::{ObserverArgs, observers_json};
use crate::cli::study::textures::TextureArgs;

/// Lets simulated participants answer a plan, to test it and its analysis. People answer in the window: shagreen PLAN.toml.
///
/// Each participant gets a log in the folder, named simulated-01 and so on. Positions of the stimuli are random, and the
/// participants perceive them with noise; --json states the positions. The answers say nothing about people.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Plan file.
    #[arg(value_name = "PLAN.toml")]
    plan: PathBuf,
    /// Number of simulated participants.
    #[arg(long, value_name = "N", value_parser = count(1..=10_000))]
    simulated: Option<usize>,
    /// Difference between what is compared, in points of a scale of 0 to 100. Default: random positions, and conditions of a
    /// questionnaire that differ by 40 points.
    #[arg(long, value_name = "POINTS", value_parser = points)]
    effect: Option<f64>,
    #[command(flatten)]
    observers: ObserverArgs,
    /// Random seed; the same seed gives the same logs.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for the logs. Default: beside the plan, with its name and "-logs-simulated".
    #[arg(short, long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Replace logs of simulated participants in the folder. Logs of people are never replaced.
    #[arg(long)]
    replace: bool,
    #[command(flatten)]
    textures: TextureArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(super) fn points(text: &str) -> Result<f64, String> {
    within(text, &(0.0..=100.0), "points")
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let Some(n_participants) = args.simulated else {
        let text = format!(
            "people answer in the window: open the plan with `shagreen {}`; or give --simulated N for simulated participants",
            args.plan.display()
        );
        return Err(Usage(text).into());
    };
    let study = load_plan_with(&args.plan, &args.textures.load()?)?;
    let folder = args.out.clone().unwrap_or_else(|| usual_simulated_log_folder(&args.plan));
    let simulation = Simulation {
        n_participants,
        seed: args.seed,
        observers: args.observers.observers(),
        effect_points: args.effect,
    };
    let progress = Progress::new("simulating participants", n_participants);
    let simulated = simulated_logs(&study, &simulation, &mut |n_done, _| {
        if n_done > 0 {
            progress.step();
        }
        true
    })?;
    progress.finish();
    let files = if args.replace {
        replace_simulated_logs(&study, &simulated, &folder)?
    } else {
        write_simulated_logs(&study, &simulated, &folder).map_err(with_option)?
    };
    let names: Vec<String> = files.iter().map(|path| path.display().to_string()).collect();
    output::print(
        args.json,
        &json!({
            "study": study.plan.name,
            "n_participants": n_participants,
            "simulated": true,
            "seed": args.seed,
            "answers": simulated.n_answers,
            "folder": folder.display().to_string(),
            "files": names,
            "hidden": hidden_json(&study.plan, &simulated.world, &simulation.observers),
        }),
        || {
            format!(
                "{}: {} gave {}, which say nothing about people: {}",
                study.plan.name,
                counted(n_participants, "SIMULATED participant"),
                counted(simulated.n_answers, "answer"),
                folder.display()
            )
        },
    );
    Ok(())
}

/// Names the option that replaces logs, where it is missing.
fn with_option(error: anyhow::Error) -> anyhow::Error {
    match error.downcast_ref::<ReplacesLogs>() {
        Some(ReplacesLogs { path }) => anyhow!(
            "the folder has logs of simulated participants; choose another folder with --out, or replace them with --replace: {}",
            path.display()
        ),
        None => error,
    }
}

/// What the participants perceived. Positions between anchors are the answers without noise and guesses.
fn hidden_json(plan: &Plan, world: &World, observers: &Observers) -> Value {
    let placed = |part: &Part| Some((part.id.clone(), json!(world.positions_between_anchors(part)?)));
    json!({
        "dimensions": world.dimensions,
        "positions": world.positions,
        "conditions": world.conditions,
        "between_anchors": plan.parts.iter().filter_map(placed).collect::<Map<String, Value>>(),
        "observers": observers_json(observers),
    })
}
