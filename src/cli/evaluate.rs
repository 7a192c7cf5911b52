//! `shagreen evaluate leave-one-out`: leave-one-out errors of the interpolation, measured on signals.

use std::path::{Path, PathBuf};

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::leave_one_out::{
    LeaveOneOut, LeaveOneOutError, Method, Plan, SignalPlan, Summary, leave_one_out,
};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::words::counted;
use shagreen_formats::axes_report::signal_axes_note;
use shagreen_formats::evaluation_report::{
    TABLE, best, evaluation_figures, evaluation_report, evaluation_source, figure_name, method_id,
    position_caveat,
};
use shagreen_formats::library::{Library, USUAL_AXES};

use crate::cli::axes_args::AxesArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::quantity::count;
use crate::cli::quantity::within;
use shagreen_studio::figure_files::{check_figures, figure_files, write_together};
use shagreen_studio::file;

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

/// Signal duration limits, in s. The minimum gives three spectral windows; the maximum limits computing time.
const SIGNAL_SECS: std::ops::RangeInclusive<f64> = 4.0..=600.0;

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
    let blendings = supported(blendings, library.axis_names().len());
    let n_textures = args.signals.unwrap_or(usize::MAX);
    let signals = SignalPlan { n_textures, seconds: args.seconds, seed: args.seed };
    let plan = Plan { blendings, signals: (n_textures > 0).then_some(signals) };
    let measured = measure(&library, &plan).map_err(|error| explained(error, &library, &args.library))?;
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

/// Leaves out the modes that do not interpolate in a space with this number of axes, and notes them. A single mode stays: the
/// evaluation then states why it fails.
fn supported(blendings: Vec<Blending>, n_axes: usize) -> Vec<Blending> {
    if blendings.len() == 1 {
        return blendings;
    }
    let (supported, others): (Vec<Blending>, Vec<Blending>) =
        blendings.into_iter().partition(|blending| blending.check_in(n_axes).is_ok());
    if !others.is_empty() {
        let ids: Vec<&str> = others.iter().map(|blending| blending.mode.id()).collect();
        output::note(&format!(
            "the modes {} are left out: they interpolate in triangles, which a space with {n_axes} axes does not have",
            ids.join(", ")
        ));
    }
    supported
}

fn measure(library: &Library, plan: &Plan) -> Result<LeaveOneOut, LeaveOneOutError> {
    let textures: Vec<(&TextureModel, Option<SpacePoint>)> =
        library.textures.iter().map(|texture| (&texture.model, texture.at())).collect();
    let mut progress: Option<Progress> = None;
    let measured = leave_one_out(&textures, plan, &mut |n_done, n| {
        let bar = progress.get_or_insert_with(|| Progress::new("evaluating the textures", n));
        if n_done > 0 {
            bar.step();
        }
        true
    });
    if let Some(progress) = progress {
        progress.finish();
    }
    measured
}

/// Returns the error with the texture's id and the file, if one of them is the cause.
fn explained(error: LeaveOneOutError, library: &Library, args: &LibraryArgs) -> anyhow::Error {
    let id = error.texture().map(|texture| library.textures[texture].id.clone());
    let mut error = anyhow::Error::from(error);
    if let Some(id) = id {
        error = error.context(format!("the evaluation failed because of the texture \"{id}\""));
    }
    match args.path() {
        Some(path) => error.context(file::in_file(path)),
        None => error,
    }
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
