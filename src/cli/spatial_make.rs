//! `shagreen spatial make`: the profiles that people felt to find out how narrow windows must be.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::profile::Profile;
use shagreen_core::profile_stimuli::{GapPair, PaperTexture, STEP_M, gap_pair};
use shagreen_formats::atomic;
use shagreen_formats::profile_csv::{is_profile_csv, profile_csv};

use crate::cli::guard::refuse_foreign;
use crate::cli::motion::quantity;
use crate::cli::output;
use crate::cli::words::words;

/// Makes a profile of the experiments with spatial spectrograms, 0 to 1 as a display of friction can show it, in steps of
/// 0.01 mm.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A: noise that swells and fades every 13 mm; B: a square wave of 13 mm; C: bumps with noise; D: a square wave of 0.4 mm that
    /// comes and goes every 6 mm; gaps: noise with gaps in it; distractor: noise with the same spectrum and no gaps.
    #[arg(value_name = "WHAT", value_parser = words(Stimulus::ALL, Stimulus::id))]
    what: Stimulus,
    /// Length in mm.
    #[arg(long, value_name = "MM", value_parser = length, default_value = "80")]
    length: f64,
    /// Width of the gaps in mm.
    #[arg(long, value_name = "MM", value_parser = quantity, default_value = "5")]
    gap: f64,
    /// Which noise the gaps are in; the textures have one each.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Table of positions in mm and values to write.
    #[arg(short, long, value_name = "OUT.csv")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stimulus {
    Texture(PaperTexture),
    Gaps,
    Distractor,
}

impl Stimulus {
    const ALL: [Self; 6] = [
        Self::Texture(PaperTexture::A),
        Self::Texture(PaperTexture::B),
        Self::Texture(PaperTexture::C),
        Self::Texture(PaperTexture::D),
        Self::Gaps,
        Self::Distractor,
    ];

    fn id(self) -> &'static str {
        match self {
            Self::Texture(texture) => texture.name(),
            Self::Gaps => "gaps",
            Self::Distractor => "distractor",
        }
    }
}

/// Shortest and longest profile in mm: a window of the paper, and what is still quick.
const LENGTHS_MM: std::ops::RangeInclusive<f64> = 1.0..=2000.0;

fn length(text: &str) -> Result<f64, String> {
    let length = quantity(text)?;
    let (shortest, longest) = (LENGTHS_MM.start(), LENGTHS_MM.end());
    if LENGTHS_MM.contains(&length) {
        Ok(length)
    } else {
        Err(format!("a profile is {shortest} to {longest} mm long"))
    }
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_foreign(&args.out, "the profile", is_profile_csv)?;
    let n_samples = (1e-3 * args.length / STEP_M).round() as usize;
    // Nothing is narrower than a step.
    let gap_m = (1e-3 * args.gap).max(STEP_M);
    let gaps = || -> GapPair { gap_pair(gap_m, n_samples, STEP_M, args.seed) };
    let values = match args.what {
        Stimulus::Texture(texture) => texture.profile(n_samples),
        Stimulus::Gaps => gaps().gapped,
        Stimulus::Distractor => gaps().distractor,
    };
    atomic::write(&args.out, profile_csv(&Profile::new(STEP_M, values)?).as_bytes())?;
    output::print(
        args.json,
        &json!({
            "out": args.out.display().to_string(),
            "what": args.what.id(),
            "samples": n_samples,
            "step_mm": 1e3 * STEP_M,
            "length_mm": args.length,
        }),
        || format!("Made {} over {} mm: {}", args.what.id(), args.length, args.out.display()),
    );
    Ok(())
}
