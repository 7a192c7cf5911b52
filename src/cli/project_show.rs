//! `shagreen project show`: shows the contents of a project.

use std::path::PathBuf;

use serde_json::{Value, json};
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_formats::library::Library;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::library_names;

use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;
use shagreen_studio::project::{load_project, textures_of};

/// Shows the contents of a project.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project file.
    #[arg(value_name = "PROJECT")]
    file: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let project = load_project(&args.file, &permitted_libraries(), &Printed)?;
    let textures = textures_of(&project)?;
    let kept = match &project.library {
        ProjectLibrary::BuiltIn(built_in) => json!({"built_in": built_in.id()}),
        ProjectLibrary::File(file) => json!({"file": file.path, "sha256": file.sha256}),
        ProjectLibrary::Inside(_) => json!({"inside": true}),
    };
    let name = library_names::name(&project.library);
    let of_library = || textures.axis_names().into_iter().map(str::to_owned).collect();
    let axes: Vec<String> = project.axes.clone().unwrap_or_else(of_library);
    let authored: Vec<Value> = project.authored.iter().map(|texture| describe(texture)).collect();
    let result = json!({
        "library": name,
        "library_kept": kept,
        "textures": textures.textures.len(),
        "axes": axes,
        "joined": project.joined.len(),
        "own": own_textures(&project, &textures),
        "authored": authored,
        "selected": project.texture().key,
        "snapshots": project.snapshots.len(),
        "notes": project.notes,
    });
    output::print(args.json, &result, || {
        let widest =
            project.authored.iter().map(|t| t.name.chars().count()).max().unwrap_or(0).min(output::MAX_WIDTH);
        let mut lines =
            vec![format!("{name}, {} textures; axes: {}", textures.textures.len(), axes.join(", "))];
        lines.extend(project.authored.iter().map(|texture| line(texture, widest)));
        lines.join("\n")
    });
    Ok(())
}

/// Identifiers of the added textures that take part only in the authored textures that pin them.
fn own_textures<'a>(project: &Project, textures: &'a Library) -> Vec<&'a str> {
    let own = project.left_out(&textures.textures, |_| false);
    own.into_iter().filter_map(|index| Some(textures.textures.get(index)?.id.as_str())).collect()
}

fn describe(texture: &AuthoredTexture) -> Value {
    let blend = &texture.blend;
    json!({
        "key": texture.key,
        "name": texture.name,
        "tags": texture.tags,
        "notes": texture.notes,
        "at": texture.at.coordinates(),
        "blend": blend.mode.id(),
        "natural": blend.weights == Weights::Natural,
        "extrapolate": blend.outside == Outside::Extrapolated,
        "locked": blend.locked,
        "shape": texture.shape.text(),
        "path_points": texture.path.as_ref().map(|path| path.points.len()),
        "has_picture": texture.picture.is_some(),
    })
}

fn line(texture: &AuthoredTexture, widest: usize) -> String {
    let tags =
        if texture.tags.is_empty() { String::new() } else { format!("  [{}]", texture.tags.join(", ")) };
    let shape = texture.shape.text().map_or_else(String::new, |shape| format!("  {shape}"));
    format!(
        "{:>3}  {:widest$}  at {}  {}{shape}{tags}",
        texture.key,
        texture.name,
        texture.at,
        texture.blend.mode.id()
    )
}
