//! `shagreen render`: renders a texture to a WAV file.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::units::Hertz;
use shagreen_formats::wav::{sidecar_path, write_wav_as};
use shagreen_studio::export::{Rendered, lost_of_stroke, lost_of_tap};
use shagreen_studio::levels::{Levels, WINDOW_SECS, levels};
use shagreen_studio::replace::{refuse_foreign_signal, refuse_signal_over_inputs};
use shagreen_studio::report::Reporter as _;

use crate::cli::motion::{MotionArgs, motion};
use crate::cli::out_name::refuse_dash;
use crate::cli::output::{self, Printed};
use crate::cli::point::named_json;
use crate::cli::sample_args::SampleArgs;
use crate::cli::stroke_signal::{StrokeSamples, stroke_samples};
use crate::cli::target::SoundArgs;
use crate::cli::wav_name::check_wav_name;

/// Renders the acceleration of a texture at the tip of a tool to a mono WAV file of 32-bit floats in m/s², with a
/// sidecar file (.json) that describes it.
///
/// Each landing in a recorded stroke adds a tap transient if the texture has one, as in playback.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    #[command(flatten)]
    samples: SampleArgs,
    /// WAV file to write; its sidecar has the same name with .json.
    #[arg(short, long, value_name = "OUT.wav")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    motion: MotionArgs,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_dash(&args.out)?;
    check_wav_name(&args.out)?;
    let motion = motion(&args.motion, None)?;
    let (library, chosen) = args.sound.load()?;
    let rendering = args.samples.rendering(&library, &chosen)?;
    let rate_hz = rendering.rate_hz;
    let beside = sidecar_path(&args.out);
    refuse_signal_over_inputs(&args.out, &[motion.stroke_path(), args.sound.library_path()])?;
    refuse_foreign_signal(&args.out)?;
    let StrokeSamples { samples, sidecar, contact_rms, taps, .. } =
        stroke_samples(&library, &chosen, &motion, rendering, &Printed)?;
    let seconds = samples.len() as f64 / f64::from(rate_hz);
    let follows_stroke = motion.stroke_path().is_some();
    let Levels { rms, peak } = levels(&samples);
    let encoding = args.samples.encoding();
    let full_scale = encoding.full_scale(&samples);
    write_wav_as(&args.out, &samples, &sidecar, encoding)?;
    if full_scale == 1.0 && peak > 1.0 {
        Printed.note("players clip what exceeds 1 m/s²; --normalize scales the signal for them");
    }
    let rendered = Rendered::of_sound(&library, &chosen, Hertz(f64::from(rate_hz)), follows_stroke);
    if let Some(lost) = lost_of_tap(rendered) {
        Printed.note(&format!("not stored in the file: {lost}"));
    }
    output::print(
        args.json,
        &json!({
            "out": args.out.display().to_string(),
            "sidecar": beside.display().to_string(),
            "rms": rms,
            "peak": peak,
            "peak_landing_s": taps.peak_landing_secs,
            "contact_rms_median": contact_rms,
            "full_scale": full_scale,
            "rate_hz": rate_hz,
            "seconds": seconds,
            "parents": chosen.parents_json(&library),
            "at": chosen.at_json(),
            "at_named": named_json(&library, chosen.at),
            "clamped": chosen.clamped,
            "extrapolated": chosen.extrapolated,
            "blend": chosen.mode.id(),
            "shape": chosen.shape.text(),
            "seed": rendering.seed,
            "lost": lost_of_stroke(rendered),
        }),
        || {
            format!(
                "Rendered {seconds:.3} s at {rate_hz} Hz of {}: rms {rms:.4} m/s², peak {peak:.4} m/s²{}{}\n{}\n{}",
                chosen.parents_text(&library),
                taps.peak_landing_secs.map_or(String::new(), |secs| format!(" at a landing at {secs:.2} s")),
                contact_text(contact_rms.filter(|_| follows_stroke)),
                args.out.display(),
                beside.display()
            )
        },
    );
    Ok(())
}

/// Returns the level of the texture without its tap transients, as text.
fn contact_text(contact_rms: Option<f64>) -> String {
    contact_rms.map_or(String::new(), |rms| {
        format!("; median rms of {WINDOW_SECS} s in contact, without taps: {rms:.4} m/s²")
    })
}
