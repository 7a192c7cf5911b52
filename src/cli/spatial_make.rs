//! `shagreen spatial make`: writes the test profiles of the experiments on window width.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::signals::profile_stimuli::{GapPair, PaperTexture, STEP_M, gap_pair};
use shagreen_core::texture::profile::Profile;
use shagreen_formats::atomic;
use shagreen_formats::profile_csv::{is_profile_csv, profile_csv};

use crate::cli::output::{self, Usage};
use crate::cli::quantity::within;
use crate::cli::words::words;
use shagreen_studio::replace::refuse_foreign;

/// Writes a test profile of the experiments on spatial spectrograms by Meyer, Peshkin and Colgate: values from 0 to 1,
/// the range of a variable-friction display, in steps of 0.01 mm.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A: 1/f noise, amplitude-modulated with a period of 13 mm; B: square wave with a period of 13 mm; C: bumps with
    /// 1/f noise; D: square wave with a period of 0.4 mm, amplitude-modulated with a period of 6 mm; gaps: 1/f noise
    /// with gaps; distractor: noise without gaps, with the same amplitude spectrum.
    #[arg(value_name = "WHAT", value_parser = words(Stimulus::ALL, Stimulus::id))]
    what: Stimulus,
    /// Length of the profile, in mm.
    #[arg(long, value_name = "MM", value_parser = length, default_value = "80")]
    length: f64,
    /// Width of the gaps in mm, for gaps and distractor. Default: 5.
    #[arg(long, value_name = "MM", value_parser = gap)]
    gap: Option<f64>,
    /// Random seed of the noise, for gaps and distractor; profiles A to D are always the same. Default: 1.
    #[arg(long)]
    seed: Option<u64>,
    /// Table to write, with positions in mm and values.
    #[arg(short, long, value_name = "OUT.csv")]
    out: PathBuf,
    /// Print the result as one JSON object.
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

/// Shortest and longest profile in mm: one window of the paper, and a limit on computing time.
const LENGTHS_MM: std::ops::RangeInclusive<f64> = 1.0..=2000.0;

/// Narrowest and widest gap in mm (a few steps, and half the longest profile), and the default gap.
const GAPS_MM: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
const USUAL_GAP_MM: f64 = 5.0;

fn gap(text: &str) -> Result<f64, String> {
    within(text, &GAPS_MM, "mm")
}

fn length(text: &str) -> Result<f64, String> {
    within(text, &LENGTHS_MM, "mm")
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_foreign(&args.out, "the profile", is_profile_csv)?;
    let n_samples = (1e-3 * args.length / STEP_M).round() as usize;
    if matches!(args.what, Stimulus::Texture(_)) && (args.gap.is_some() || args.seed.is_some()) {
        return Err(Usage(
            "profiles A to D have no gaps and no random seed; leave out --gap and --seed".to_owned(),
        )
        .into());
    }
    let gap_mm = args.gap.unwrap_or(USUAL_GAP_MM);
    if !matches!(args.what, Stimulus::Texture(_)) && 2.0 * gap_mm > args.length {
        return Err(Usage(format!(
            "a profile of {} mm is too short for a gap of {gap_mm} mm; give a narrower --gap or a longer --length",
            args.length
        ))
        .into());
    }
    let gap_m = 1e-3 * gap_mm;
    let gaps = || -> GapPair { gap_pair(gap_m, n_samples, STEP_M, args.seed.unwrap_or(1)) };
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
        || format!("Wrote profile {} of {} mm: {}", args.what.id(), args.length, args.out.display()),
    );
    Ok(())
}
