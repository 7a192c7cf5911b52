//! `shagreen space place`: textures are put where a table says.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow};
use serde_json::json;
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::library::write_library;
use shagreen_formats::places_csv::{PlacesCsvError, Scale, looks_rescaled, place_textures, read_places};
use shagreen_formats::space_report::FORMAT;

use crate::cli::guard::{has_format, is_library, refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::near_names::unknown_texture;
use crate::cli::output::{self, warn_of_restricted};

/// Places textures where a table says.
///
/// The table has the columns `id`, `rs` and `hs` (0 to 100, 0 = roughest, 0 = hardest) and may have further attributes,
/// each named by its two poles, as `flat-bumpy`. Where the axes are other attributes, the columns of the place are named
/// by them, as `x:warm-cold` and `y:flat-bumpy`. `--scale` says where values run otherwise than from 0 to 100. A column
/// `source` says what the places were derived from; without it `--source` says so for all of them. Textures that the
/// table does not name lose their place: a space of two origins means little.
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
    /// The scale of all values of the table, where it is not 0,100: as 1,7.
    #[arg(long, value_name = "LOW,HIGH", value_parser = parse_scale, allow_hyphen_values = true)]
    scale: Option<Scale>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

fn parse_source(text: &str) -> Result<LabelSource, String> {
    LabelSource::from_id(text).ok_or_else(|| "say human, simulated, physical or estimated".to_owned())
}

/// The scale that `LOW,HIGH` names.
pub(crate) fn parse_scale(text: &str) -> Result<Scale, String> {
    let number = |part: &str| part.trim().parse::<f64>().map_err(|_| "write LOW,HIGH as in 1,7".to_owned());
    let (low, high) = text.split_once(',').ok_or("write LOW,HIGH as in 1,7")?;
    Scale::new(number(low)?, number(high)?).map_err(|error| error.to_string())
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(&args.attributes), args.library.path()])?;
    refuse_foreign(&args.out, "a library", is_library)?;
    let mut library = load(&args.library)?;
    let bytes = output::read_file(&args.attributes)?;
    let read = read_places(&bytes, args.source, args.scale.unwrap_or(Scale::OF_SPACE))
        .map_err(|error| match error {
            PlacesCsvError::Range { .. } => anyhow!("{error} by --scale LOW,HIGH"),
            error => error.into(),
        })
        .with_context(|| output::in_file(&args.attributes))?;
    let (places, mut warnings) = (read.value, read.warnings);
    let placements = &places.placements;
    if let Some(unknown) = placements.iter().find(|p| library.index_of(&p.id).is_none()) {
        return Err(anyhow!(unknown_texture(&library, &unknown.id)))
            .with_context(|| output::in_file(&args.attributes));
    }
    if let Some((low, high)) = looks_rescaled(placements).filter(|_| args.scale.is_none()) {
        warnings.push(format!(
            "the scale is 0 to 100, and all positions lie between {low} and {high}, in one corner; if people answered on another scale, say so, as --scale 1,7"
        ));
    }
    let missing = place_textures(&mut library, &places);
    // The report was on other places.
    library.space_report = None;
    output::CREATED_BY.clone_into(&mut library.created_by);
    if !missing.is_empty() {
        warnings.push(format!("not in the table, and so without a place: {}", missing.join(", ")));
    }
    let sources = library.label_sources();
    if sources.len() > 1 {
        warnings
            .push("the places come from different sources; what lies between them means little".to_owned());
    }
    warnings.extend(old_report(&args.out));
    for warning in &warnings {
        output::warn(warning);
    }
    warn_of_restricted(&library);
    atomic::write(&args.out, &write_library(&library))?;
    let n_placed = placements.len();
    output::print(
        args.json,
        &json!({
            "placed": n_placed,
            "missing": missing,
            "warnings": warnings,
            "out": args.out.display().to_string(),
        }),
        || {
            format!(
                "Placed {n_placed} of {}: {}",
                counted(library.textures.len(), "texture"),
                args.out.display()
            )
        },
    );
    Ok(())
}

/// That a report beside the library is of other places. It stays: building it took minutes, and this command writes none.
fn old_report(out: &Path) -> Option<String> {
    let report = out.with_extension("report.json");
    // What cannot be read is not ours to speak of.
    let bytes = std::fs::read(&report).ok()?;
    has_format(&bytes, FORMAT).then(|| {
        format!(
            "the report beside the library is of a space that was built before, not of these places; move or remove it: {}",
            report.display()
        )
    })
}
