//! `shagreen space place`: textures are put where a table says.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use serde_json::json;
use shagreen_core::space::LabelSource;
use shagreen_formats::atomic;
use shagreen_formats::library::write_library;
use shagreen_formats::places_csv::{place_textures, read_places_csv};

use crate::cli::guard::{is_library, refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output::{self, warn_of_restricted};

/// Places textures where a table says.
///
/// The table has the columns `id`, `rs` and `hs` (0 to 100, 0 = roughest, 0 = hardest) and may have further attributes,
/// each named by its two poles, as `flat-bumpy`. A column `source` says what the places were derived from; without it
/// `--source` says so for all of them. Textures that the table does not name lose their place: a space of two origins
/// means little.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// CSV with the columns id, rs, hs.
    #[arg(long, value_name = "A.csv")]
    attributes: PathBuf,
    /// Library file to write.
    #[arg(long, value_name = "L2")]
    out: PathBuf,
    /// What the places were derived from, where the table does not say it.
    #[arg(long, value_name = "SOURCE", value_parser = parse_source)]
    source: Option<LabelSource>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

fn parse_source(text: &str) -> Result<LabelSource, String> {
    LabelSource::from_id(text).ok_or_else(|| "say human, simulated or physical".to_owned())
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(&args.attributes), args.library.path()])?;
    refuse_foreign(&args.out, "a library", is_library)?;
    let mut library = load(&args.library)?;
    let bytes = output::read_file(&args.attributes)?;
    let placements =
        read_places_csv(&bytes, args.source).with_context(|| output::in_file(&args.attributes))?;
    if let Some(unknown) = placements.iter().find(|p| library.index_of(&p.id).is_none()) {
        bail!(
            "the library has no texture \"{}\"; `shagreen library list` shows their ids: {}",
            unknown.id,
            args.attributes.display()
        );
    }
    let missing = place_textures(&mut library, &placements);
    // The report was on other places.
    library.space_report = None;
    output::CREATED_BY.clone_into(&mut library.created_by);
    if !missing.is_empty() {
        output::warn(&format!("not in the table, and so without a place: {}", missing.join(", ")));
    }
    let sources = library.label_sources();
    if sources.len() > 1 {
        output::warn("the places come from different sources; what lies between them means little");
    }
    warn_of_restricted(&library);
    atomic::write(&args.out, &write_library(&library))?;
    let n_placed = placements.len();
    output::print(
        args.json,
        &json!({"placed": n_placed, "missing": missing, "out": args.out.display().to_string()}),
        || format!("Placed {n_placed} of {} textures: {}", library.textures.len(), args.out.display()),
    );
    Ok(())
}
