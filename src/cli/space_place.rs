//! `shagreen space place`: places textures from a table.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow};
use serde_json::json;
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::write_library;
use shagreen_formats::places_csv::{PlacesCsvError, Scale, looks_rescaled, place_textures, read_places};
use shagreen_formats::space_report::FORMAT;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, warn_of_restricted};
use shagreen_studio::file;
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::replace::{has_format, is_library, refuse_foreign, refuse_inputs};

/// Places textures at the positions in a table.
///
/// The table has the columns `id`, `rs` (0 = roughest, 100 = smoothest) and `hs` (0 = hardest, 100 = softest). The ids
/// are those of the library: `shagreen library list --library L` shows them, and `shagreen library places --library L
/// --out A.csv` writes a table of them to edit. Without --library, they are the ids of the starter library. The table can
/// have columns of other attributes, each named by its two poles, such as `flat-bumpy`. For other axes, name the
/// columns of the position `x:` and `y:` with the attribute, such as `x:warm-cold` and `y:flat-bumpy`. Further axes, up to
/// six, have the columns `z:`, `u:`, `v:` and `w:`; a space with one axis has only `x:`. `--scale` states a scale other than
/// 0 to 100. A column `source` states the source of each position; otherwise `--source` states one for all. Textures that
/// the table does not contain lose their position, because positions from different sources cannot be compared.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// CSV file with the columns id, rs, hs; `shagreen library list` shows the ids.
    #[arg(long, value_name = "A.csv")]
    attributes: PathBuf,
    /// Library file to write.
    #[arg(long, value_name = "L2")]
    out: PathBuf,
    /// Source of the positions, if the table does not state it: human, simulated, physical or estimated.
    #[arg(long, value_name = "SOURCE", value_parser = parse_source)]
    source: Option<LabelSource>,
    /// Scale of all values in the table, if it is not 0,100; for example 1,7.
    #[arg(long, value_name = "LOW,HIGH", value_parser = parse_scale, allow_hyphen_values = true)]
    scale: Option<Scale>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

fn parse_source(text: &str) -> Result<LabelSource, String> {
    LabelSource::from_id(text).ok_or_else(|| "choose human, simulated, physical or estimated".to_owned())
}

/// Parses a scale, given as `LOW,HIGH`.
pub(crate) fn parse_scale(text: &str) -> Result<Scale, String> {
    let number = |part: &str| part.trim().parse::<f64>().map_err(|_| "write LOW,HIGH as in 1,7".to_owned());
    let (low, high) = text.split_once(',').ok_or("write LOW,HIGH as in 1,7")?;
    Scale::new(number(low)?, number(high)?).map_err(|error| error.to_string())
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(&args.attributes), args.library.path()])?;
    refuse_foreign(&args.out, "a library", is_library)?;
    let mut library = args.library.load()?;
    let bytes = file::read_file(&args.attributes, FileKind::Table)?;
    let read = read_places(&bytes, args.source, args.scale.unwrap_or(Scale::OF_SPACE))
        .map_err(|error| match error {
            PlacesCsvError::Range { .. } => anyhow!("{error} with --scale LOW,HIGH"),
            error => error.into(),
        })
        .with_context(|| file::in_file(&args.attributes))?;
    let (places, mut warnings) = (read.value, read.warnings);
    let placements = &places.placements;
    if let Some(unknown) = placements.iter().find(|p| library.index_of(&p.id).is_none()) {
        return Err(anyhow!(unknown_texture(&library, &unknown.id)))
            .with_context(|| file::in_file(&args.attributes));
    }
    if let Some((low, high)) = looks_rescaled(placements).filter(|_| args.scale.is_none()) {
        warnings.push(format!(
            "the scale is 0 to 100, but all positions lie between {low} and {high}; if people answered on another scale, state it, for example --scale 1,7"
        ));
    }
    let missing = place_textures(&mut library, &places);
    // The report describes other positions.
    library.space_report = None;
    output::CREATED_BY.clone_into(&mut library.created_by);
    if !missing.is_empty() {
        warnings.push(format!(
            "these textures are not in the table and have no position now: {}",
            missing.join(", ")
        ));
    }
    let sources = library.label_sources();
    if sources.len() > 1 {
        warnings.push(
            "the positions come from different sources and cannot be compared; use one source for all textures".to_owned(),
        );
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
            "axes": library.axis_names(),
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

/// Returns a warning if a report next to the library describes other positions. The report is kept: building it took
/// minutes, and this command writes none.
fn old_report(out: &Path) -> Option<String> {
    let report = out.with_extension("report.json");
    // A file that cannot be read is no report of this program.
    let bytes = bounded_file::read(&report, FileKind::Document).ok()?;
    has_format(&bytes, FORMAT).then(|| {
        format!(
            "the report next to the library describes a space that was built before, not these positions; move or remove it: {}",
            report.display()
        )
    })
}
