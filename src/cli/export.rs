//! `shagreen export`: exports a texture for other programs.

use std::path::PathBuf;

use anyhow::bail;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde_json::json;
use shagreen_core::texture::shape::Shape;
use shagreen_studio::export::{self, ExportFormat, ExportOutcome};
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::replace::refuse_inputs;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::shape_args::ShapeArgs;

/// Exports a texture in the format of another program, and reports what that format cannot store.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Texture of the library, by id.
    #[arg(long, value_name = "ID")]
    texture: String,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    shape: ShapeArgs,
    /// File format. `shagreen render` writes the WAV file of a stroke.
    #[arg(long, value_parser = parser())]
    format: Format,
    /// File to write.
    #[arg(short = 'o', long = "out", value_name = "OUT")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    let library = args.library.load()?;
    let Some(index) = library.index_of(&args.texture) else {
        bail!(unknown_texture(&library, &args.texture))
    };
    let texture = &export::shaped(&library.textures[index], &args.shape.or(Shape::default()))?;
    let out = (args.out.as_path(), output::CREATED_BY);
    let ExportOutcome { files, lost, license, warnings } =
        export::export(&library, texture, args.format.0, out, &Printed)?;
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    output::print(
        args.json,
        &json!({"files": files, "lost": lost, "warnings": warnings, "licence": license}),
        || format!("Wrote \"{}\" as {}: {}", texture.name, args.format.0.id(), files.join(", ")),
    );
    Ok(())
}

/// Format selected from [`export::FORMATS`].
#[derive(Clone, Copy)]
struct Format(&'static dyn ExportFormat);

/// Parses the id of a format; the help lists all of them.
fn parser() -> impl TypedValueParser<Value = Format> {
    let ids = export::FORMATS.map(|format| PossibleValue::new(format.id()).help(format.help()));
    PossibleValuesParser::new(ids)
        .try_map(|id| export::format(&id).map(Format).ok_or_else(|| format!("{id} is not a format")))
}
