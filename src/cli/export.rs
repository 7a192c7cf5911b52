//! `shagreen export`: a texture for other programs.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_formats::hatt::{lost_in_hatt, write_hatt};
use shagreen_formats::library::Provenance;

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::near_names::unknown_texture;
use crate::cli::output;

/// Writes a texture in the format of another program, and says what that format cannot hold.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Texture of the library, by its id.
    #[arg(long, value_name = "ID")]
    texture: String,
    #[command(flatten)]
    library: LibraryArgs,
    /// Format: hatt is the XML of the Penn Haptic Texture Toolkit.
    #[arg(long, value_parser = ["hatt"])]
    format: String,
    /// File to write.
    #[arg(short = 'o', long = "out", value_name = "OUT")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    let library = load(&args.library)?;
    let Some(index) = library.index_of(&args.texture) else {
        bail!(unknown_texture(&library, &args.texture))
    };
    let texture = &library.textures[index];
    let restricted = (texture.provenance == Provenance::Restricted).then_some(texture.name.as_str());
    let warning = Provenance::warning(&restricted.into_iter().collect::<Vec<_>>());
    if let Some(warning) = &warning {
        output::warn(warning);
    }
    refuse_foreign(&args.out, "a HaTT model", |bytes| contains(bytes, b"<modelSet"))?;
    let bytes = write_hatt(texture, output::CREATED_BY)?;
    atomic::write(&args.out, &bytes)?;
    let lost = lost_in_hatt(texture);
    for lost in &lost {
        output::note(&format!("not in the file: {lost}"));
    }
    let file = args.out.display().to_string();
    output::print(
        args.json,
        &json!({"files": [file], "lost": lost, "warnings": warning.into_iter().collect::<Vec<_>>(), "licence": library.license_of(texture)}),
        || format!("Wrote \"{}\" as {}: {file}", texture.name, args.format),
    );
    Ok(())
}

/// Whether `bytes` hold `part`.
fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}
