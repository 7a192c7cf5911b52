//! `shagreen study new`: writes the plan of a study.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_studio::file::ending_of;
use shagreen_studio::study::new_plan::{authored_names, plan_with_textures};
use shagreen_studio::study::plans::{StudyPlan, template};
use shagreen_studio::study::preview::preview;

use crate::cli::output;
use crate::cli::study::textures::TextureArgs;

/// Writes the plan of a study: a copy of a built-in plan, with its textures or with yours.
///
/// The plan is a TOML file with comments, which you can change. Replace its consent text before you invite people.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Built-in plan; `shagreen study templates` lists them.
    #[arg(value_name = "TEMPLATE")]
    template: String,
    /// Textures to use instead of those of the plan: ids of the library, or names of authored textures of the project,
    /// separated by commas. Default with --project: all its authored textures.
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    textures: Vec<String>,
    #[command(flatten)]
    from: TextureArgs,
    /// Plan file to write; an existing file is not replaced.
    #[arg(short, long, value_name = "PLAN.toml")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Ending of the name of a plan.
const ENDING: &str = "toml";

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    if ending_of(&args.out) != ENDING {
        bail!("the name of a plan must end with .{ENDING}; choose another name: {}", args.out.display());
    }
    if args.out.symlink_metadata().is_ok() {
        bail!("a file of this name already exists; choose another name: {}", args.out.display());
    }
    let study = study(args)?;
    let meets = preview(&study, 1)?;
    atomic::write(&args.out, study.text.as_bytes())?;
    let (n_stimuli, n_parts) = (study.plan.stimuli.len(), study.plan.parts.len());
    output::print(
        args.json,
        &json!({
            "study": study.plan.name,
            "template": args.template,
            "n_participants": null,
            "simulated": false,
            "stimuli": n_stimuli,
            "parts": n_parts,
            "trials": meets.n_trials,
            "minutes": meets.minutes,
            "out": args.out.display().to_string(),
        }),
        || {
            format!(
                "{}: {}, {}, {n_stimuli} stimuli, about {:.0} minutes for each participant: {}",
                study.plan.name,
                counted(n_parts, "part"),
                counted(meets.n_trials, "trial"),
                meets.minutes.max(1.0),
                args.out.display()
            )
        },
    );
    Ok(())
}

/// The built-in plan, with other textures if some are chosen.
fn study(args: &Args) -> anyhow::Result<StudyPlan> {
    let template = template(&args.template)?;
    if args.textures.is_empty() && !args.from.has_project() {
        return Ok(template.study);
    }
    let textures = args.from.load()?;
    let names = if args.textures.is_empty() { authored_names(&textures)? } else { args.textures.clone() };
    plan_with_textures(&template, &names, &textures)
}
