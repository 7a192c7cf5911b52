//! `shagreen library places`: writes the positions of a library's textures to a table.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_formats::places_csv::{Scale, places_csv, read_places};

use crate::cli::axes_args::AxesArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Writes the positions and attributes of a library to a table that `space place` reads.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    axes: AxesArgs,
    /// CSV file to write.
    #[arg(long, value_name = "A.csv")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    refuse_foreign(&args.out, "the table of positions", |bytes| {
        read_places(bytes, None, Scale::OF_SPACE).is_ok()
    })?;
    let library = args.axes.place(args.library.load()?, None, &[])?;
    let n_placed = library.textures.iter().filter(|texture| texture.place.is_some()).count();
    if n_placed == 0 {
        bail!(
            "no texture of the library has a position; assign positions with `shagreen space build` or `space place`"
        );
    }
    atomic::write(&args.out, &places_csv(&library))?;
    let file = args.out.display().to_string();
    output::print(args.json, &json!({"placed": n_placed, "out": file}), || {
        format!("Wrote the positions of {n_placed} textures: {file}")
    });
    Ok(())
}
