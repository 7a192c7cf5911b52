//! `shagreen project gallery`: lists the example projects of the program.

use serde_json::json;
use shagreen_formats::gallery::{GALLERY, GalleryProject};
use shagreen_formats::project::Project;

use crate::cli::output;

/// Lists the example projects that come with the program.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the result as one JSON object.
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
