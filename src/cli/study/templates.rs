//! `shagreen study templates`: lists the built-in plans.

use serde_json::{Value, json};
use shagreen_core::words::counted;
use shagreen_studio::study::plans::{ListedTemplate, templates};

use crate::cli::output;

/// Lists the built-in plans: one for each published experiment, and one for each further design.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let all = templates()?;
    let described: Vec<Value> = all.iter().map(described).collect();
    output::print(args.json, &json!({ "studies": described }), || {
        all.iter().map(line).collect::<Vec<_>>().join("\n")
    });
    Ok(())
}

fn described(template: &ListedTemplate) -> Value {
    let plan = &template.study.plan;
    let designs: Vec<&str> = plan.parts.iter().map(|part| part.design.id()).collect();
    json!({
        "id": template.id,
        "study": plan.name,
        "description": plan.description.trim(),
        "designs": designs,
        "stimuli": plan.stimuli.len(),
    })
}

fn line(template: &ListedTemplate) -> String {
    let plan = &template.study.plan;
    format!(
        "{:26} {}: {}, {}",
        template.id,
        plan.name,
        counted(plan.parts.len(), "part"),
        if plan.stimuli.is_empty() {
            "stimuli made in each trial".to_owned()
        } else {
            format!("{} stimuli", plan.stimuli.len())
        }
    )
}
