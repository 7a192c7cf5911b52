//! `shagreen library relief`: a profile becomes what a texture has at each place.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, anyhow, bail};
use serde_json::json;
use shagreen_core::relief::Relief;
use shagreen_core::spectrum::rms;
use shagreen_core::units::Newtons;
use shagreen_formats::atomic;
use shagreen_formats::library::write_library;

use crate::cli::guard::{is_library, refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::motion::positive;
use crate::cli::near_names::unknown_texture;
use crate::cli::output::{self, Usage, warn_of_restricted};
use crate::cli::profile_source::ProfileArgs;

/// Gives a texture of a library a relief: bumps, gaps or a weave that lie at their places, and are played by where the tip is,
/// over the noise that it has already.
///
/// Values of a signal are accelerations in m/s². Heights, brightness and friction have no such unit: --level says how strong
/// they are felt. Beyond its end a relief comes back the way it went.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    profile: ProfileArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Identifier of the texture.
    #[arg(long, value_name = "ID")]
    texture: String,
    /// Root mean square that the relief gets, in m/s²; a signal keeps its own without it.
    #[arg(long, value_name = "MPS2", value_parser = positive)]
    level: Option<f64>,
    /// Force at which it has this level, in N; it grows with the force.
    #[arg(long, value_name = "N", value_parser = positive, default_value = "1")]
    force: f64,
    /// Library file to write.
    #[arg(short, long, value_name = "L2")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(args.profile.path()), args.library.path()])?;
    refuse_foreign(&args.out, "a library", is_library)?;
    let profile = args.profile.load_felt()?;
    if args.level.is_none() && !args.profile.is_signal() {
        return Err(Usage(
            "the values of a profile have no unit; say how strong it is felt with --level in m/s²".to_owned(),
        )
        .into());
    }
    let mut library = load(&args.library)?;
    let index =
        library.index_of(&args.texture).ok_or_else(|| anyhow!(unknown_texture(&library, &args.texture)))?;
    let force = Newtons(args.force);
    let relief = match args.level {
        Some(level_mps2) => Relief::of_level(&profile, level_mps2, force),
        None => Relief::new(profile, force),
    };
    let relief = relief.with_context(|| output::in_file(args.profile.path()))?;
    let (level_mps2, n_values) = (rms(relief.profile().values()), relief.profile().values().len());
    let (length_mm, step_mm) = (1e3 * relief.profile().length_m(), 1e3 * relief.profile().step_m());
    let entry = &mut library.textures[index];
    if entry.path.is_some() {
        bail!(
            "\"{}\" changes along a path and is played by its textures; give the relief to these, and make the path then",
            args.texture
        );
    }
    if entry.model.relief().is_some() {
        output::warn(&format!("\"{}\" had a relief already; this one takes its place", args.texture));
    }
    entry.model = entry.model.clone().with_relief(Some(Arc::new(relief)));
    output::CREATED_BY.clone_into(&mut library.created_by);
    warn_of_restricted(&library);
    atomic::write(&args.out, &write_library(&library))?;
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
                "\"{}\" has a relief of {length_mm:.2} mm in steps of {step_mm:.4} mm, {level_mps2:.3} m/s² at {} N: {}",
                args.texture,
                args.force,
                args.out.display()
            )
        },
    );
    Ok(())
}
