//! `shagreen spatial reconstruct`: reconstructs a profile from its spatial spectrogram.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::signals::spatial_spectrogram::{
    SpatialSpectrogram, Transform, fidelity, profile_of, refine,
};
use shagreen_core::texture::profile::Profile;
use shagreen_formats::atomic;
use shagreen_formats::profile_csv::{is_profile_csv, profile_csv};

use crate::cli::output;
use crate::cli::profile_source::ProfileArgs;
use crate::cli::progress::Progress;
use crate::cli::quantity::positive;
use crate::cli::spatial_analyse::{line, row};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Computes the spatial spectrogram of a surface profile, reconstructs the profile from it, and prints the accuracy. A
/// spectrogram has no phases, so the position of a feature within a window is lost. The phases follow the rule of Meyer,
/// Peshkin and Colgate. --refine then adjusts the profile iteratively, so that its spectrogram matches.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    profile: ProfileArgs,
    /// Window width in mm.
    #[arg(long, value_name = "MM", value_parser = positive)]
    window: f64,
    /// Iterations of the fast Griffin-Lim algorithm. They reduce the error of the spectrogram, but do not always
    /// improve how well features are localized.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1000))]
    refine: u16,
    /// Table to write, with positions in mm and values.
    #[arg(short, long, value_name = "OUT.csv")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(args.profile.path())])?;
    refuse_foreign(&args.out, "the profile", is_profile_csv)?;
    let profile = args.profile.load()?;
    let (values, step_m) = (profile.values(), profile.step_m());
    let transform = Transform::new(args.profile.framing(&profile, args.window)?);
    let progress = Progress::endless("reconstructing the profile");
    let spectrogram = SpatialSpectrogram::of(values, &transform)?;
    let mut made = profile_of(&spectrogram, &transform);
    if args.refine > 0 {
        made = refine(&spectrogram, &made, usize::from(args.refine))?;
    }
    let found = fidelity(values, &made, step_m, &spectrogram, &transform)?;
    atomic::write(&args.out, profile_csv(&Profile::new(step_m, made)?).as_bytes())?;
    progress.finish();
    let mut answer = row(&found);
    answer["out"] = json!(args.out.display().to_string());
    answer["refined"] = json!(args.refine);
    output::print(args.json, &answer, || format!("{}: {}", line(&found).trim_start(), args.out.display()));
    Ok(())
}
