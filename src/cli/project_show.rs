//! `shagreen project show`: what somebody authored.

use std::path::PathBuf;

use serde_json::{Value, json};
use shagreen_app::libraries;
use shagreen_core::authoring::{Outside, Weights};
use shagreen_formats::project::{AuthoredTexture, ProjectLibrary};

use crate::cli::output;
use crate::cli::project_source::{load_project, textures_of};

/// Shows what a project holds.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The project.
    #[arg(value_name = "PROJECT")]
    file: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let project = load_project(&args.file)?;
    let textures = textures_of(&project)?;
    let kept = match &project.library {
        ProjectLibrary::BuiltIn(built_in) => json!({"built_in": built_in.id()}),
        ProjectLibrary::File(file) => json!({"file": file.path, "sha256": file.sha256}),
        ProjectLibrary::Inside(_) => json!({"inside": true}),
    };
    let name = libraries::name(&project.library);
    let authored: Vec<Value> = project.authored.iter().map(|texture| describe(texture)).collect();
    let result = json!({
        "library": name,
        "library_kept": kept,
        "textures": textures.textures.len(),
        "joined": project.joined.len(),
        "authored": authored,
        "selected": project.texture().key,
        "snapshots": project.snapshots.len(),
        "notes": project.notes,
    });
    output::print(args.json, &result, || {
        let widest = project.authored.iter().map(|t| t.name.chars().count()).max().unwrap_or(0);
        let mut lines = vec![format!("{name}, {} textures", textures.textures.len())];
        lines.extend(project.authored.iter().map(|texture| line(texture, widest)));
        lines.join("\n")
    });
    Ok(())
}

fn describe(texture: &AuthoredTexture) -> Value {
    let blend = &texture.blend;
    json!({
        "key": texture.key,
        "name": texture.name,
        "tags": texture.tags,
        "notes": texture.notes,
        "at": [texture.at.rough_smooth, texture.at.hard_soft],
        "blend": blend.mode.id(),
        "natural": blend.weights == Weights::Natural,
        "extrapolate": blend.outside == Outside::Extrapolated,
        "locked": blend.locked,
        "path_points": texture.path.as_ref().map(|path| path.points.len()),
        "has_picture": texture.picture.is_some(),
    })
}

fn line(texture: &AuthoredTexture, widest: usize) -> String {
    let tags =
        if texture.tags.is_empty() { String::new() } else { format!("  [{}]", texture.tags.join(", ")) };
    format!(
        "{:>3}  {:widest$}  at {}  {}{tags}",
        texture.key,
        texture.name,
        texture.at,
        texture.blend.mode.id()
    )
}
