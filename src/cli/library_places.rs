//! `shagreen library places`: where the textures of a library lie, as a table.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_formats::places_csv::{Scale, places_csv, read_places};

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output;

/// Writes the places and attributes of a library as a table that `space place` takes.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// CSV to write.
    #[arg(long, value_name = "A.csv")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    refuse_foreign(&args.out, "the table of places", |bytes| {
        read_places(bytes, None, Scale::OF_SPACE).is_ok()
    })?;
    let library = load(&args.library)?;
    let n_placed = library.textures.iter().filter(|texture| texture.place.is_some()).count();
    if n_placed == 0 {
        bail!(
            "no texture of the library has a place; `shagreen space build` and `space place` give them one"
        );
    }
    atomic::write(&args.out, &places_csv(&library))?;
    let file = args.out.display().to_string();
    output::print(args.json, &json!({"placed": n_placed, "out": file}), || {
        format!("Wrote the places of {n_placed} textures: {file}")
    });
    Ok(())
}
