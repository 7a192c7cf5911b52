//! `shagreen project new`: a project file to begin with.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::json;
use shagreen_app::window::new_project;
use shagreen_formats::atomic;
use shagreen_formats::gallery::GALLERY;
use shagreen_formats::project::{EXTENSION, write_project};

use crate::cli::output;

/// Writes a new project, empty or from the gallery.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project of the gallery to begin from; `shagreen project gallery` lists them.
    #[arg(long, value_name = "ID")]
    from: Option<String>,
    /// The file to write; one that is there is not replaced.
    #[arg(short, long, value_name = "PROJECT")]
    out: PathBuf,
    /// Print one JSON object.
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
                .with_context(|| format!("the gallery has no project \"{id}\"; it has {}", known.join(", ")))?
                .read()?
        }
    };
    if args.out.extension().is_none_or(|extension| extension != EXTENSION) {
        bail!("the name of a project ends with .{EXTENSION}; choose another: {}", args.out.display());
    }
    if args.out.symlink_metadata().is_ok() {
        bail!("there is a file of this name already; choose another: {}", args.out.display());
    }
    let folder = args.out.parent().unwrap_or(Path::new(""));
    atomic::write(&args.out, &write_project(&project, folder, output::CREATED_BY))?;
    output::print(args.json, &json!({"file": args.out, "authored": project.authored.len()}), || {
        format!("{}: {} authored textures", args.out.display(), project.authored.len())
    });
    Ok(())
}
