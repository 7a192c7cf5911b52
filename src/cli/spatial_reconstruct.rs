//! `shagreen spatial reconstruct`: a profile made anew from its spatial spectrogram.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::profile::Profile;
use shagreen_core::spatial_spectrogram::{SpatialSpectrogram, Transform, fidelity, profile_of, refine};
use shagreen_formats::atomic;
use shagreen_formats::profile_csv::{is_profile_csv, profile_csv};

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::motion::positive;
use crate::cli::output;
use crate::cli::profile_source::ProfileArgs;
use crate::cli::spatial_analyse::{line, row};

/// Throws away where things are within windows of a profile, and makes a profile of what is left: by the phase rule of the
/// paper, and where that is asked for by steps that bring its spectrogram nearer.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    profile: ProfileArgs,
    /// Width of the windows in mm.
    #[arg(long, value_name = "MM", value_parser = positive)]
    window: f64,
    /// Steps of the fast Griffin-Lim algorithm; the spectrogram gets nearer, the places of things not always.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1000))]
    refine: u16,
    /// Table of positions in mm and values to write.
    #[arg(short, long, value_name = "OUT.csv")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(args.profile.path())])?;
    refuse_foreign(&args.out, "the profile", is_profile_csv)?;
    let profile = args.profile.load()?;
    let (values, step_m) = (profile.values(), profile.step_m());
    let transform = Transform::new(args.profile.framing(&profile, args.window)?);
    let spectrogram = SpatialSpectrogram::of(values, &transform)?;
    let mut made = profile_of(&spectrogram, &transform);
    if args.refine > 0 {
        made = refine(&spectrogram, &made, usize::from(args.refine))?;
    }
    let found = fidelity(values, &made, step_m, &spectrogram, &transform)?;
    atomic::write(&args.out, profile_csv(&Profile::new(step_m, made)?).as_bytes())?;
    let mut answer = row(&found);
    answer["out"] = json!(args.out.display().to_string());
    answer["refined"] = json!(args.refine);
    output::print(args.json, &answer, || format!("{}: {}", line(&found).trim_start(), args.out.display()));
    Ok(())
}
