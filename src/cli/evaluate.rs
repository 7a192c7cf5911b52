//! `shagreen evaluate leave-one-out`: leave-one-out errors of the interpolation, measured on signals.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::maths::shard::Shard;
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::leave_one_out::{LeaveOneOut, Method, Plan, SignalPlan, Summary, join_parts};
use shagreen_core::texture::blend::Mode;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::axes_report::signal_axes_note;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::evaluation_part::{
    evaluation_inputs, is_evaluation_part, read_evaluation_part, write_evaluation_part,
};
use shagreen_formats::evaluation_report::{
    TABLE, best, evaluation_figures, evaluation_report, evaluation_source, figure_name, method_id,
    position_caveat,
};
use shagreen_formats::library::{Library, USUAL_AXES};

use crate::cli::axes_args::AxesArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::progress::Progress;
use crate::cli::quantity::count;
use crate::cli::quantity::within;
use shagreen_studio::evaluation::{SIGNAL_SECS, evaluate_interpolation, evaluate_part, supported};
use shagreen_studio::figure_files::{check_figures, figure_files, write_together};
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Removes each texture in turn, interpolates a texture at its position from the others, and compares the spectra of
/// the two.
///
/// Only textures strictly inside the convex hull of the others are evaluated; on one axis (--axes), all but those at its
/// ends. With more than two axes nearly all textures lie on the hull, so all are evaluated. Spectra are compared at nine
/// combinations of speed and force, in 40 frequency channels (20 to 480 Hz). The baseline is a copy of the nearest
/// texture; interpolation should have a lower error. The errors are computed from signals, not from human ratings.
///
/// If positions were computed from the textures themselves (physical labels, estimates), the position of a left-out
/// texture contains part of its answer. The shape error excludes the overall level: it compares the shape of the
/// spectra and their dependence on speed and force.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    axes: AxesArgs,
    /// Interpolation mode; `all` evaluates every mode that supports the number of axes.
    #[arg(long, value_name = "MODE", value_parser = modes_parser(), default_value = Mode::default().id())]
    blend: Modes,
    /// Number of textures whose rendered signals are compared, in addition to the models of all textures; 0 renders
    /// none. Default: all.
    #[arg(long, value_name = "N", value_parser = count(0..=1000))]
    signals: Option<usize>,
    /// Duration of each rendered signal, in s.
    #[arg(long, value_name = "S", value_parser = signal_secs, default_value = "16")]
    seconds: f64,
    /// Folder for figures, as SVG and CSV: a table of the methods, and for each method a map of the errors in the
    /// space.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
    /// Random seed of the noise; the same seed repeats all signals exactly.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Evaluate only a part of the textures, such as 2/4, and write its results to the file --part, to divide the work among
    /// computers. --merge joins the parts.
    #[arg(long, value_name = "I/N", requires = "part", conflicts_with_all = ["figures", "merge"])]
    shard: Option<Shard>,
    /// File to write with --shard.
    #[arg(long, value_name = "PART.json", requires = "shard")]
    part: Option<PathBuf>,
    /// Join these parts instead of evaluating; give all of them, and the library and options with which they were made.
    #[arg(long, value_name = "PART.json", num_args = 1..)]
    merge: Vec<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// One mode or all modes.
#[derive(Clone, Debug)]
struct Modes(Vec<Mode>);

/// Note on errors with more than two axes.
const OTHER_TEXTURES: &str = "These errors are not comparable with those of two axes, which exclude the textures on the convex hull. Compare numbers of axes with `shagreen evaluate axes`.";

/// Value of --blend that selects every mode.
const ALL: &str = "all";

fn modes_parser() -> impl clap::builder::TypedValueParser<Value = Modes> {
    use clap::builder::TypedValueParser as _;
    clap::builder::PossibleValuesParser::new(Mode::ALL.map(Mode::id).into_iter().chain([ALL]))
        .map(|id| Modes(Mode::from_id(&id).map_or_else(|| Mode::ALL.to_vec(), |mode| vec![mode])))
}

fn signal_secs(text: &str) -> Result<f64, String> {
    within(text, &SIGNAL_SECS, "seconds")
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let blendings: Vec<Blending> = args.blend.0.iter().map(|mode| Blending::from(*mode)).collect();
    if let Some(folder) = &args.figures {
        let methods = std::iter::once(Method::Nearest).chain(blendings.iter().cloned().map(Method::Blended));
        let names: Vec<String> = methods.map(|m| figure_name(&m)).chain([TABLE.to_owned()]).collect();
        check_figures(folder, &names, &[args.library.path()])?;
    }
    let library = args.axes.place(args.library.load()?, None, &[])?;
    let blendings = supported(blendings, library.axis_names().len(), &Printed);
    let n_textures = args.signals.unwrap_or(usize::MAX);
    let signals = SignalPlan { n_textures, seconds: args.seconds, seed: args.seed };
    let plan = Plan { blendings, signals: (n_textures > 0).then_some(signals) };
    if let (Some(shard), Some(path)) = (args.shard, &args.part) {
        return write_part(args, &library, &plan, (shard, path));
    }
    let measured = if args.merge.is_empty() {
        watched(&args.library, |on_progress| evaluate_interpolation(&library, &plan, on_progress))?
    } else {
        merged(&args.merge, &library, &plan)?
    };
    let beyond = measured.textures.iter().filter(|left| !left.is_within_measured).count();
    if beyond > 0 {
        output::warn(&format!(
            "{} of {} textures lack measurements at some of the compared speeds and forces; their nearest measured speed and force is used",
            beyond,
            measured.textures.len()
        ));
    }
    let mut report = evaluation_report(&library, &measured);
    report["axes"] = library.axis_names().into();
    report["axes_caveat"] = signal_axes_note(&library, library.axis_names()).into();
    if let Some(folder) = &args.figures {
        let figures = evaluation_figures(&library, &measured);
        let files: Vec<_> =
            figures.iter().flat_map(|(name, figure)| figure_files(folder, name, figure)).collect();
        write_together(&files, Some(folder))?;
    }
    output::print(args.json, &report, || table(&library, &measured, args.figures.as_deref()));
    Ok(())
}

/// Evaluates a part of the textures and writes it to a file.
fn write_part(
    args: &Args,
    library: &Library,
    plan: &Plan,
    (shard, path): (Shard, &Path),
) -> anyhow::Result<()> {
    refuse_inputs(&[path], &[args.library.path()])?;
    refuse_foreign(path, "the part of the evaluation", is_evaluation_part)?;
    atomic::check_all(&[path])?;
    let part = watched(&args.library, |on_progress| evaluate_part(library, plan, shard, on_progress))?;
    let inputs = evaluation_inputs(library, plan, output::CREATED_BY);
    atomic::write(path, &write_evaluation_part(&part, &inputs))?;
    let n = part.textures.len();
    let result = json!({
        "part": path.display().to_string(),
        "shard": shard.to_string(),
        "n": n,
        "of": part.n_evaluated,
    });
    output::print(args.json, &result, || {
        format!("Evaluated {n} of {}: {}", counted(part.n_evaluated, "texture"), path.display())
    });
    Ok(())
}

/// Joins the parts in these files.
fn merged(paths: &[PathBuf], library: &Library, plan: &Plan) -> anyhow::Result<LeaveOneOut> {
    let inputs = evaluation_inputs(library, plan, output::CREATED_BY);
    let part = |path: &PathBuf| {
        let bytes = file::read_file(path, FileKind::Document)?;
        read_evaluation_part(&bytes, &inputs, library.textures.len()).with_context(|| file::in_file(path))
    };
    let parts = paths.iter().map(part).collect::<anyhow::Result<Vec<_>>>()?;
    Ok(join_parts(plan, parts)?)
}

/// Does work that reports the number of finished textures and their total, and shows its progress.
fn watched<T>(
    args: &LibraryArgs,
    work: impl FnOnce(&mut dyn FnMut(usize, usize) -> bool) -> anyhow::Result<T>,
) -> anyhow::Result<T> {
    let mut progress: Option<Progress> = None;
    let done = work(&mut |n_done, n| {
        let bar = progress.get_or_insert_with(|| Progress::new("evaluating the textures", n));
        if n_done > 0 {
            bar.step();
        }
        true
    });
    if let Some(progress) = progress {
        progress.finish();
    }
    done.map_err(|error| match args.path() {
        Some(path) => error.context(file::in_file(path)),
        None => error,
    })
}

fn table(library: &Library, measured: &LeaveOneOut, figures: Option<&Path>) -> String {
    let n = measured.textures.len();
    let checks = measured.methods.iter().filter_map(|summary| summary.signals);
    let n_rendered = checks.clone().map(|check| check.n).max().unwrap_or(0);
    // Both columns are means over the rendered textures, which may be fewer than those of the other columns.
    let [model, signal] = ["model", "signal"].map(|name| format!("{name} (n={n_rendered})"));
    let rendered = if n_rendered > 0 { format!(" {model:>12} {signal:>12}") } else { String::new() };
    let mut lines = vec![
        format!(
            "{}: leave-one-out of {} ({} have a position; {}); {}; the errors are computed, not rated by people",
            library.name,
            counted(n, "texture"),
            n + measured.on_hull.len(),
            evaluated(measured.on_hull.len()),
            evaluation_source(library)
        ),
        format!(
            "  {:10} {:>12} {:>12} {:>12} {:>12} {:>6} {:>6} {:>6}{rendered}",
            "", "mean error", "median error", "level error", "shape error", "rank 1", "top 5", "NRS",
        ),
    ];
    let best = best(measured).map(|summary| &summary.method);
    lines.extend(measured.methods.iter().map(|summary| row(summary, best == Some(&summary.method))));
    let notes = [
        "* lowest mean error. Error: RMS difference of channel levels over 9 speed-force pairs and 40 channels, averaged over textures.",
        "Level error: mean absolute difference of the total vibration level.",
        "Shape error: error after one gain per texture has matched its mean channel level to that of the original.",
        "Rank 1, top 5: percentage of textures whose original is the closest, or among the five closest, to the interpolated one.",
        "NRS: 1 - error / distance between the two textures farthest apart on the first axis, averaged over textures.",
    ];
    lines.extend(notes.map(str::to_owned));
    let caveats = [position_caveat(library), signal_axes_note(library, library.axis_names())];
    lines.extend(caveats.into_iter().flatten().map(str::to_owned));
    if library.axis_names().len() > USUAL_AXES.len() {
        lines.push(OTHER_TEXTURES.to_owned());
    }
    if let Some(largest) = checks.map(|c| c.mean_difference_db).max_by(f64::total_cmp) {
        lines.push(format!(
            "Model, signal: mean error of {}, computed from the models and from rendered signals. For one texture, the two differ by {largest:.2} dB on average at most.",
            counted(n_rendered, "texture")
        ));
    }
    lines.extend(figures.map(|folder| format!("Figures: {}", folder.display())));
    lines.join("\n")
}

/// Returns how many textures are not evaluated. With more than two axes, those on the convex hull are evaluated too.
fn evaluated(n_on_hull: usize) -> String {
    match n_on_hull {
        0 => "all are evaluated".to_owned(),
        n => format!("{n} on the convex hull are not evaluated"),
    }
}

fn row(summary: &Summary, is_best: bool) -> String {
    let nrs = summary.nrs_mean.map_or_else(|| "\u{2013}".to_owned(), |nrs| format!("{nrs:.2}"));
    let rendered = summary.signals.map_or_else(String::new, |check| {
        format!(" {:9.2} dB {:9.2} dB", check.model_error_db_mean, check.error_db_mean)
    });
    format!(
        "{} {:10} {:9.2} dB {:9.2} dB {:9.2} dB {:9.2} dB {:4.0} % {:4.0} % {nrs:>6}{rendered}",
        if is_best { '*' } else { ' ' },
        method_id(&summary.method),
        summary.error_db_mean,
        summary.error_db_median,
        summary.level_error_db_mean,
        summary.shape_error_db_mean,
        100.0 * summary.rank1,
        100.0 * summary.top5,
    )
}
