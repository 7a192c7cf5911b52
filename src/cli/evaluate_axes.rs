//! `shagreen evaluate axes`: what further axes add to a space, measured on signals.

use serde_json::{Value, json};
use shagreen_core::space::axis_evaluation::AxisStep;
use shagreen_core::words::counted;
use shagreen_formats::axes_report::{axes_report, nothing_helps, signal_axes_note};
use shagreen_formats::library::Library;
use shagreen_studio::axes::{EvaluatedAxes, KnownAxis, evaluate, known_axes};

use crate::cli::axis_name::axis_names;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::progress::Progress;

/// Least width of the names of rows, in characters.
const LABEL_WIDTH: usize = 22;

/// Evaluates what further axes add to the space: attributes of the textures, and axes that are computed from their
/// vibration.
///
/// One axis is added at a time, each time the one that lowers the error most. The error is the spectral distance between
/// a texture and the texture that mode field interpolates at its position from the others. The axes are chosen without
/// the textures that are predicted (nested cross-validation), so that an axis of chance values does not seem to help. All
/// textures are predicted, also those on the convex hull. The errors are computed from signals, not from human ratings.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// Axes that come first, whatever they add, separated by commas. Default: the axes of the positions of the library.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    first: Option<Vec<String>>,
    /// Choose all axes by what they add, also the first.
    #[arg(long, conflicts_with = "first")]
    free: bool,
    /// Further axes to choose from, separated by commas. Default: all that the library knows; `shagreen library list` shows
    /// them.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    candidates: Option<Vec<String>>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let library = args.library.load()?;
    let first = match &args.first {
        Some(first) => axis_names(&library, first),
        None if args.free => Vec::new(),
        None => library.axis_names().into_iter().map(str::to_owned).collect(),
    };
    let candidates = args.candidates.as_ref().map(|names| axis_names(&library, names));
    let mut progress: Option<Progress> = None;
    let evaluated = evaluate(&library, &first, candidates.as_deref(), &mut |n_done, n| {
        let bar = progress.get_or_insert_with(|| Progress::new("evaluating the axes", n));
        if n_done > 0 {
            bar.step();
        }
        true
    });
    if let Some(progress) = progress {
        progress.finish();
    }
    let evaluated = evaluated?;
    let mut report = axes_report(&library, &evaluated.names, &evaluated.found);
    report["first"] = json!(first);
    report["candidates"] = candidates_json(&known_axes(&library), &evaluated, first.len());
    report["chosen"] = chosen(&evaluated, &first).into();
    output::print(args.json, &report, || table(&library, &evaluated, &first));
    Ok(())
}

/// Returns the steps at which an axis was chosen: all of them, without the first if it holds given axes.
fn choices(evaluated: &EvaluatedAxes, n_first: usize) -> &[AxisStep] {
    evaluated.found.steps.get(usize::from(n_first > 0)..).unwrap_or_default()
}

/// Returns the chosen axes in the order of their gain, with the errors that a space has with them, as JSON.
fn candidates_json(known: &[KnownAxis], evaluated: &EvaluatedAxes, n_first: usize) -> Value {
    let source = |name: &String| known.iter().find(|axis| axis.name == *name).map(|axis| axis.source.label());
    let candidate = |step: &AxisStep| {
        let name = &evaluated.names[step.added];
        json!({"name": name, "source": source(name), "error_db_mean": step.error_db_mean, "rank1": step.rank1})
    };
    choices(evaluated, n_first).iter().map(candidate).collect()
}

/// Returns the axes to use: the first ones, and further ones up to the last that helps. One axis is chosen in any case.
fn chosen(evaluated: &EvaluatedAxes, first: &[String]) -> Vec<String> {
    let steps = choices(evaluated, first.len());
    let n_helpful = steps.iter().rposition(|step| step.helps() == Some(true)).map_or(0, |last| last + 1);
    let n_chosen = n_helpful.max(usize::from(first.is_empty()));
    let names = steps.iter().take(n_chosen).map(|step| evaluated.names[step.added].clone());
    first.iter().cloned().chain(names).collect()
}

fn table(library: &Library, evaluated: &EvaluatedAxes, first: &[String]) -> String {
    let EvaluatedAxes { names, found } = evaluated;
    let labels: Vec<String> =
        found.steps.iter().enumerate().map(|(at, step)| label(at, &names[step.added], first)).collect();
    let width = labels.iter().map(|label| label.chars().count()).fold(LABEL_WIDTH, usize::max);
    let mut lines = vec![
        format!(
            "{}: {}; axes chosen without the predicted textures (nested); the errors are computed, not rated by people",
            library.name,
            counted(found.textures.len(), "texture")
        ),
        format!(
            "  {:>4}  {:<width$} {:>9} {:>6} {:>12} {:>6} {:>16}  helps",
            "axes", "added", "error", "rank 1", "nearest", "rank 1", "gain"
        ),
    ];
    lines.extend(found.steps.iter().zip(&labels).map(|(step, label)| row(label, width, step)));
    let notes = [
        "Error: RMS difference of channel levels over 9 speed-force pairs and 40 channels, averaged over textures; nearest: that of a copy of the nearest texture.",
        "Gain: decrease of the error, ± standard error, compared with the last number of axes that helped. It helps if the gain is more than twice its standard error.",
        "Rank 1: percentage of textures whose original is the closest to the prediction.",
    ];
    lines.extend(notes.map(str::to_owned));
    if !found.left_out.is_empty() {
        let left_out: Vec<&str> = found.left_out.iter().map(|axis| names[*axis].as_str()).collect();
        lines.push(format!("Left out, because too few textures have a value: {}.", left_out.join(", ")));
    }
    lines.extend(nothing_helps(found).map(str::to_owned));
    lines.extend(signal_axes_note(library, names.iter().map(String::as_str)).map(str::to_owned));
    lines.join("\n")
}

/// Returns the name of a row: the axes that come first in the first row, and the axis that is added in the others.
fn label(at: usize, added: &str, first: &[String]) -> String {
    match (at, first) {
        (0, []) => added.to_owned(),
        (0, first) => first.join(", "),
        _ => format!("+ {added}"),
    }
}

fn row(label: &str, width: usize, step: &AxisStep) -> String {
    let gain = step
        .gain_db
        .map_or_else(|| "\u{2013}".to_owned(), |[gain, error]| format!("{gain:.2} ± {error:.2} dB"));
    let helps = match step.helps() {
        None => "",
        Some(true) => "yes",
        Some(false) => "no",
    };
    let line = format!(
        "  {:>4}  {label:<width$} {:6.2} dB {:4.0} % {:9.2} dB {:4.0} % {gain:>16}  {helps}",
        step.n_axes,
        step.error_db_mean,
        100.0 * step.rank1,
        step.nearest_db_mean,
        100.0 * step.nearest_rank1,
    );
    line.trim_end().to_owned()
}
