//! `shagreen spatial analyse`: measures how much of a profile its spatial spectrogram preserves, by window width.

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::bail;
use serde_json::{Value, json};
use shagreen_core::maths::statistics::is_constant;
use shagreen_core::signals::spatial_spectrogram::{
    Framing, PAPER_WINDOWS_M, ProfileFidelity, Transform, fidelity_by_window, offset_of,
};
use shagreen_formats::atomic;

use crate::cli::output::{self, Usage};
use crate::cli::profile_source::ProfileArgs;
use crate::cli::progress::Progress;
use crate::cli::quantity::positive;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Reconstructs a surface profile from its spatial spectrogram alone, for several window widths, and reports the
/// accuracy of the reconstruction.
///
/// A spatial spectrogram contains the power in each window along the profile, by spatial frequency, but not the phases.
/// Positions within a window are lost: narrower windows preserve more of them. Power has no sign, so a profile with
/// negative values is raised by minus its lowest value before it is reconstructed; the table of --out is the spectrogram
/// of the profile as it is.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    profile: ProfileArgs,
    /// Window width in mm; can be given several times. Default: the seven widths of Meyer, Peshkin and Colgate from 20
    /// to 0.2 mm, as far as they fit the profile.
    #[arg(long = "window", value_name = "MM", value_parser = positive)]
    windows_mm: Vec<f64>,
    /// Table to write with the spectrogram for one window width: position in mm, spatial frequency in 1/mm, and power in
    /// the squared unit of the profile, `|Σ w f e^(-2πikn/N)|²` with the Hann window w.
    #[arg(short, long, value_name = "OUT.csv")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// First line of the table of a spectrogram.
const HEADER: &str = "x_mm,per_mm,power\n";

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    if args.out.is_some() && args.windows_mm.len() != 1 {
        return Err(Usage(
            "a table holds the spectrogram for one window width; give --window once".to_owned(),
        )
        .into());
    }
    if let Some(out) = &args.out {
        refuse_inputs(&[out], &[Some(args.profile.path())])?;
        refuse_foreign(out, "the spectrogram", |bytes| bytes.starts_with(HEADER.as_bytes()))?;
    }
    let profile = args.profile.load()?;
    let framings: Vec<Framing> = if args.windows_mm.is_empty() {
        let fits = |m: &f64| args.profile.framing(&profile, 1e3 * m).ok();
        let framings: Vec<Framing> = PAPER_WINDOWS_M.iter().filter_map(fits).collect();
        if framings.len() < PAPER_WINDOWS_M.len() {
            output::note("window widths that do not fit the profile's length or step were skipped");
        }
        framings
    } else {
        args.windows_mm.iter().map(|mm| args.profile.framing(&profile, *mm)).collect::<Result<_, _>>()?
    };
    if framings.is_empty() {
        bail!("none of the default window widths fits the profile; give one with --window");
    }
    let (values, step_m) = (profile.values(), profile.step_m());
    if is_constant(values) {
        bail!("the profile is constant, so there is nothing to analyze: {}", args.profile.path().display());
    }
    let progress = Progress::endless("analyzing the profile");
    let found = fidelity_by_window(values, step_m, &framings)?;
    if let (Some(out), [framing]) = (&args.out, framings.as_slice()) {
        atomic::write(out, table(values, step_m, *framing)?.as_bytes())?;
    }
    progress.finish();
    let rows: Vec<Value> = found.iter().map(row).collect();
    let offset = offset_of(values);
    let answer = json!({
        "samples": values.len(),
        "step_mm": 1e3 * step_m,
        "length_mm": 1e3 * profile.length_m(),
        "windows": rows,
        "offset_for_reconstruction": offset,
        "out": args.out.as_ref().map(|out| out.display().to_string()),
    });
    output::print(args.json, &answer, || {
        let mut lines = vec![format!(
            "{:.4} mm in {} steps; accuracy of the reconstruction by window width (r: correlation with the original):",
            1e3 * profile.length_m(),
            values.len()
        )];
        lines.extend(found.iter().map(line));
        if offset > 0.0 {
            lines.push(format!(
                "The profile has negative values: {offset:.6} was added for the reconstruction, and subtracted from its result."
            ));
        }
        lines.extend(args.out.as_ref().map(|out| format!("Spectrogram: {}", out.display())));
        lines.join("\n")
    });
    Ok(())
}

/// Returns the fidelity for one window width as JSON.
pub(super) fn row(found: &ProfileFidelity) -> Value {
    json!({
        "window_mm": 1e3 * found.window_m,
        "waveform_r": found.correlation,
        "envelope_r": found.envelope_correlation,
        "spectral_convergence": found.spectral_convergence,
    })
}

/// Returns the fidelity for one window width as text.
pub(super) fn line(found: &ProfileFidelity) -> String {
    format!(
        "{:8.4} mm: waveform r {:5.2}, envelope r {:5.2}, spectral convergence {:.2}",
        1e3 * found.window_m,
        found.correlation,
        found.envelope_correlation,
        found.spectral_convergence
    )
}

/// Returns the spectrogram for one window width as a table, without the offset of a reconstruction.
fn table(values: &[f64], step_m: f64, framing: Framing) -> anyhow::Result<String> {
    let power = Transform::new(framing).power(values)?;
    let per_mm = 1e-3 / (framing.window() as f64 * step_m);
    let mut text = String::from(HEADER);
    for (frame, powers) in power.frames().enumerate() {
        let x_mm = 1e3 * step_m * framing.center(frame);
        for (k, power) in powers.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{x_mm:.6},{:.6},{power:.6e}", per_mm * k as f64);
        }
    }
    Ok(text)
}
