//! `shagreen library make`: simulates a library from physical parameters of materials.

use std::path::PathBuf;

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::space::LabelSource;
use shagreen_core::surfaces::material::Material;
use shagreen_core::surfaces::starter::{self, StarterTexture};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::{Library, PhysicalLabels, Place, TextureEntry, write_library};
use shagreen_formats::materials_toml::{Materials, read_materials};
use shagreen_formats::{atomic, picture};

use crate::cli::output;
use crate::cli::progress::Progress;
use shagreen_studio::file;
use shagreen_studio::parallel::in_parallel;
use shagreen_studio::replace::{refuse_inputs, refuse_lost_textures};

/// Statement of origin in a simulated library.
const ORIGIN: &str =
    "Simulated from physical parameters by Shagreen: no surface was recorded and nobody rated one.";

/// Simulates a library of textures from the physical parameters of materials.
///
/// A simulated pen strokes each material at five speeds and five forces; the picture shows the same surface heights.
/// Positions are physical labels: roughness is computed from the vibration level, hardness from the contact stiffness.
/// No person rated them.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// TOML file with a `seed` and one `[[material]]` table for each material.
    materials: PathBuf,
    /// Library file to write.
    #[arg(long, value_name = "L")]
    out: PathBuf,
    /// Replace a library that has other textures.
    #[arg(long)]
    replace: bool,
    /// Name of the library.
    #[arg(long, default_value = "Starter")]
    name: String,
    /// License of the library, for example an SPDX expression.
    #[arg(long, default_value = "", hide_default_value = true)]
    licence: String,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(&args.materials)])?;
    let bytes = file::read_file(&args.materials, FileKind::Document)?;
    let materials = read_materials(&bytes).with_context(|| file::in_file(&args.materials))?;
    let progress = Progress::new("simulating the materials", materials.materials.len());
    let mut library = make_library(&materials, &|| progress.step())?;
    progress.finish();
    library.name.clone_from(&args.name);
    library.license.clone_from(&args.licence);
    if !args.replace {
        refuse_lost_textures(&args.out, &library)
            .context("nothing was written; --replace replaces it all the same")?;
    }
    let bytes = write_library(&library);
    atomic::write(&args.out, &bytes)?;
    let n_textures = library.textures.len();
    output::print(
        args.json,
        &json!({"out": args.out.display().to_string(), "textures": n_textures, "bytes": bytes.len(), "seed": materials.seed}),
        || format!("Simulated {n_textures} textures, {} kB: {}", bytes.len() / 1000, args.out.display()),
    );
    Ok(())
}

/// Returns the library of the materials, in their order; `step` is called after each texture.
fn make_library(materials: &Materials, step: &(dyn Fn() + Sync)) -> anyhow::Result<Library> {
    let made = make_textures(materials, step)?;
    let labels: Vec<starter::Labels> = made.iter().map(|texture| texture.labels).collect();
    let places = starter::places(&labels);
    let textures = materials
        .materials
        .iter()
        .zip(made)
        .zip(places)
        .map(|((material, made), at)| entry(material, made, Place::new(at, LabelSource::PhysicalLabels)))
        .collect::<anyhow::Result<_>>()?;
    Ok(Library {
        description: "Everyday surfaces under the plastic ball of a 40 g pen.".to_owned(),
        origin: ORIGIN.to_owned(),
        created_by: output::CREATED_BY.to_owned(),
        seed: Some(materials.seed),
        textures,
        ..Library::default()
    })
}

/// Returns the textures in the order of the materials. All processors share the work; the result does not depend on the
/// thread.
fn make_textures(materials: &Materials, step: &(dyn Fn() + Sync)) -> anyhow::Result<Vec<StarterTexture>> {
    let list = &materials.materials;
    let made = in_parallel(list.len(), |index| {
        let made = starter::make(&list[index], materials.seed);
        step();
        made
    });
    made.into_iter()
        .zip(list)
        .map(|(texture, material)| {
            texture.with_context(|| {
                format!("the material \"{}\" cannot be simulated; correct its parameters", material.id)
            })
        })
        .collect()
}

fn entry(material: &Material, made: StarterTexture, place: Place) -> anyhow::Result<TextureEntry> {
    let picture = picture::encode_jpeg(&picture::Rgb::from(&made.picture), made.picture.millimeters)
        .with_context(|| format!("the picture of \"{}\" cannot be encoded", material.id))?;
    Ok(TextureEntry {
        tags: material.tags.clone(),
        place: Some(place),
        physical: Some(PhysicalLabels {
            roughness_log10_mps2: made.labels.roughness_log10_mps2,
            hardness_log10_n_per_m: made.labels.hardness_log10_n_per_m,
        }),
        picture: Some(picture),
        ..TextureEntry::new(&material.id, &material.name, made.model)
    })
}
