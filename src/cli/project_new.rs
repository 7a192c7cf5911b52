//! `shagreen project new`: writes a new project file.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_formats::gallery::GALLERY;
use shagreen_formats::project::{EXTENSION, write_project};
use shagreen_studio::project::new_project;

use crate::cli::output;

/// Writes a new project: an empty one, or a copy of an example project.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Example project to start from; `shagreen project gallery` lists them.
    #[arg(long, value_name = "ID")]
    from: Option<String>,
    /// Project file to write; an existing file is not replaced.
    #[arg(short, long, value_name = "PROJECT")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let project = match &args.from {
        None => new_project(),
        Some(id) => {
            let found = GALLERY.iter().find(|each| each.id == id);
            let known: Vec<&str> = GALLERY.iter().map(|each| each.id).collect();
            found
                .with_context(|| {
                    format!(
                        "there is no project \"{id}\" among the example projects; choose one of {}",
                        known.join(", ")
                    )
                })?
                .read()?
        }
    };
    if args.out.extension().is_none_or(|extension| extension != EXTENSION) {
        bail!(
            "the name of a project file must end with .{EXTENSION}; choose another name: {}",
            args.out.display()
        );
    }
    if args.out.symlink_metadata().is_ok() {
        bail!("a file of this name already exists; choose another name: {}", args.out.display());
    }
    let folder = args.out.parent().unwrap_or(Path::new(""));
    atomic::write(&args.out, &write_project(&project, folder, output::CREATED_BY))?;
    output::print(args.json, &json!({"file": args.out, "authored": project.authored.len()}), || {
        format!("{}: {} authored textures", args.out.display(), project.authored.len())
    });
    Ok(())
}
