//! `shagreen project gallery`: the projects that come with the program.

use serde_json::json;
use shagreen_formats::gallery::{GALLERY, GalleryProject};
use shagreen_formats::project::Project;

use crate::cli::output;

/// Lists the projects that come with the program, to begin from.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let all: Vec<(GalleryProject, Project)> =
        GALLERY.iter().map(|each| Ok((*each, each.read()?))).collect::<anyhow::Result<_>>()?;
    let describe = |(each, project): &(GalleryProject, Project)| {
        let names: Vec<&str> = project.authored.iter().map(|texture| texture.name.as_str()).collect();
        json!({"id": each.id, "title": each.title, "notes": project.notes, "authored": names})
    };
    let projects: Vec<_> = all.iter().map(describe).collect();
    output::print(args.json, &json!({ "projects": projects }), || {
        let line = |(each, project): &(GalleryProject, Project)| {
            format!("{:14}  {:2} textures  {}", each.id, project.authored.len(), project.notes)
        };
        all.iter().map(line).collect::<Vec<_>>().join("\n")
    });
    Ok(())
}
