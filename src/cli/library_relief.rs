//! `shagreen library relief`: adds a relief to a texture.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, anyhow, bail};
use serde_json::json;
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::texture::height_map::HeightMapOptions;
use shagreen_core::texture::relief::Relief;
use shagreen_core::units::Newtons;
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, write_library};

use crate::cli::generate::range_um;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed, Usage, warn_of_restricted};
use crate::cli::profile_source::ProfileArgs;
use crate::cli::quantity::{positive, within};
use shagreen_studio::file;
use shagreen_studio::height_map::{self, HEIGHTS_UM, ReliefSize, ReliefSizeError, SIDES_MM};
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::replace::{is_library, refuse_foreign, refuse_inputs};

/// Adds a relief to a texture of a library: acceleration as a function of tip position, such as bumps, gaps or a weave,
/// in addition to the texture's noise.
///
/// The values of a WAV file are accelerations in m/s². Heights, brightness and friction are not accelerations: for
/// them, --level states the level of the relief. Beyond its end, the relief continues as its mirror image.
///
/// With --side-mm and --height-um, a whole photo or picture of heights becomes a height map, which is felt in two
/// dimensions: brightness is height, and the tile repeats without a seam.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    profile: ProfileArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Texture of the library, by id.
    #[arg(long, value_name = "ID")]
    texture: String,
    /// RMS acceleration of the relief, in m/s². A WAV file keeps its own level by default; other profiles need this
    /// option.
    #[arg(long, value_name = "MPS2", value_parser = positive)]
    level: Option<f64>,
    /// Force at which the relief has this level, in N; the level is proportional to force. For a height map, the force of
    /// its contact patch; its level grows with the cube root of force.
    #[arg(long, value_name = "N", value_parser = positive, default_value = "1")]
    force: f64,
    /// Side of the surface in the central square of the picture, in mm: the picture becomes a height map.
    #[arg(
        long,
        value_name = "MM",
        value_parser = side_mm,
        requires = "height_um",
        conflicts_with_all = ["width", "row", "speed", "full_scale", "channel", "level"]
    )]
    side_mm: Option<f64>,
    /// Height of white above black in the picture, in µm. For a photo, it is your estimate. For a TIFF with floating-point
    /// numbers, signed numbers or numbers of more than 16 bits, the height of the highest above the lowest.
    #[arg(long, value_name = "UM", value_parser = height_um, requires = "side_mm")]
    height_um: Option<f64>,
    /// Library file to write.
    #[arg(short, long, value_name = "L2")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(args.profile.path()), args.library.path()])?;
    refuse_foreign(&args.out, "a library", is_library)?;
    match (args.side_mm, args.height_um) {
        (Some(side_mm), Some(height_um)) => add_height_map(args, ReliefSize { side_mm, height_um }),
        _ => add_profile(args),
    }
}

fn add_profile(args: &Args) -> anyhow::Result<()> {
    let profile = args.profile.load_felt()?;
    if args.level.is_none() && !args.profile.is_signal() {
        return Err(Usage(
            "the values of this profile are not accelerations; state the level of the relief with --level, in m/s²".to_owned(),
        )
        .into());
    }
    let mut library = args.library.load()?;
    let index =
        library.index_of(&args.texture).ok_or_else(|| anyhow!(unknown_texture(&library, &args.texture)))?;
    let force = Newtons(args.force);
    let relief = match args.level {
        Some(level_mps2) => Relief::of_level(&profile, level_mps2, force),
        None => Relief::new(profile, force),
    };
    let relief = relief.with_context(|| file::in_file(args.profile.path()))?;
    let (level_mps2, n_values) = (rms(relief.profile().values()), relief.profile().values().len());
    let (length_mm, step_mm) = (1e3 * relief.profile().length_m(), 1e3 * relief.profile().step_m());
    let entry = &mut library.textures[index];
    if entry.path.is_some() {
        bail!(
            "\"{}\" is a texture path, which cannot have a relief; add the relief to the textures that the path is made from, then make the path again",
            args.texture
        );
    }
    if entry.model.relief().is_some() {
        output::warn(&format!("\"{}\" already has a relief, which is replaced", args.texture));
    }
    entry.model = entry.model.clone().with_relief(Some(Arc::new(relief)));
    write(library, args)?;
    output::print(
        args.json,
        &json!({
            "texture": args.texture,
            "values": n_values,
            "length_mm": length_mm,
            "step_mm": step_mm,
            "level_mps2": level_mps2,
            "force_n": args.force,
            "out": args.out.display().to_string(),
        }),
        || {
            format!(
                "Added to \"{}\" a relief of {length_mm:.2} mm in steps of {step_mm:.4} mm, {level_mps2:.3} m/s² rms at {} N: {}",
                args.texture,
                args.force,
                args.out.display()
            )
        },
    );
    Ok(())
}

fn add_height_map(args: &Args, size: ReliefSize) -> anyhow::Result<()> {
    let options = HeightMapOptions { force: Newtons(args.force), ..HeightMapOptions::HARD_PLASTIC };
    let relief = height_map::of_picture(args.profile.path(), size, options, &Printed)
        .map_err(|error| with_options(error, size))?;
    let map = &relief.map;
    let [low_um, high_um] = range_um(map.heights_m());
    let (n, side_mm) = (map.n(), 1e3 * map.side_m());
    let mut library = args.library.load()?;
    height_map::add_to_texture(&mut library, &args.texture, &relief, &Printed)?;
    write(library, args)?;
    output::print(
        args.json,
        &json!({
            "texture": args.texture,
            "heights": n,
            "side_mm": side_mm,
            "low_um": low_um,
            "high_um": high_um,
            "seamless": relief.is_seamless,
            "assumed": relief.is_colored,
            "impossible": relief.warning,
            "force_n": args.force,
            "out": args.out.display().to_string(),
        }),
        || {
            format!(
                "Added to \"{}\" a height map of {side_mm:.2} mm x {side_mm:.2} mm with {n} x {n} heights, {low_um:.1} to {high_um:.1} µm: {}",
                args.texture,
                args.out.display()
            )
        },
    );
    Ok(())
}

fn side_mm(text: &str) -> Result<f64, String> {
    within(text, &SIDES_MM, "mm")
}

fn height_um(text: &str) -> Result<f64, String> {
    within(text, &HEIGHTS_UM, "µm")
}

/// Names the options of a size that gives no height map.
fn with_options(error: anyhow::Error, size: ReliefSize) -> anyhow::Error {
    if error.downcast_ref::<ReliefSizeError>().is_none() {
        return error;
    }
    let ReliefSize { side_mm, height_um } = size;
    error.context(format!("--height-um {height_um} does not fit --side-mm {side_mm}"))
}

fn write(mut library: Library, args: &Args) -> anyhow::Result<()> {
    output::CREATED_BY.clone_into(&mut library.created_by);
    warn_of_restricted(&library);
    atomic::write(&args.out, &write_library(&library))?;
    Ok(())
}
