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
use shagreen_formats::evaluation_report::{
    TABLE, best, evaluation_figures, evaluation_report, evaluation_source, figure_name, method_id,
};
use shagreen_formats::library::Library;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Progress};
use crate::cli::quantity::within;
use shagreen_studio::figure_files::{check_figures, figure_files, write_together};
use shagreen_studio::file;

/// Leaves out each texture, interpolates one at its position from the others, and compares the two on signals.
///
/// Only textures strictly inside the convex hull of the others are left out. Spectra at nine combinations of speed and
/// force are compared in 40 channels. The baseline is a copy of the nearest texture, which an interpolated one should
/// improve on. No person felt anything: these are no human ratings.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// Interpolation mode; all compares the modes.
    #[arg(long, value_name = "MODE", value_parser = modes_parser(), default_value = Mode::default().id())]
    blend: Modes,
    /// Number of textures for which rendered signals are compared too. Default: all.
    #[arg(long, value_name = "N")]
    signals: Option<usize>,
    /// Duration of each signal, in seconds.
    #[arg(long, value_name = "S", value_parser = signal_secs, default_value = "16")]
    seconds: f64,
    /// Folder for figures, as SVG and CSV: a table of the methods, and a map of the errors of each.
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

/// Word for all modes.
const ALL: &str = "all";

fn modes_parser() -> impl clap::builder::TypedValueParser<Value = Modes> {
    use clap::builder::TypedValueParser as _;
    clap::builder::PossibleValuesParser::new(Mode::ALL.map(Mode::id).into_iter().chain([ALL]))
        .map(|id| Modes(Mode::from_id(&id).map_or_else(|| Mode::ALL.to_vec(), |mode| vec![mode])))
}

/// Shortest and longest signal, in s: three windows of its spectrum, and a limit on computing time.
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
    let library = args.library.load()?;
    let n_textures = args.signals.unwrap_or(usize::MAX);
    let signals = SignalPlan { n_textures, seconds: args.seconds, seed: args.seed };
    let plan = Plan { blendings, signals: (n_textures > 0).then_some(signals) };
    let measured = measure(&library, &plan).map_err(|error| explained(error, &library, &args.library))?;
    let beyond = measured.textures.iter().filter(|left| !left.is_within_measured).count();
    if beyond > 0 {
        output::warn(&format!(
            "{} of {} textures were not measured at all speeds and forces of the comparison; the nearest measured ones are used",
            beyond,
            measured.textures.len()
        ));
    }
    let report = evaluation_report(&library, &measured);
    if let Some(folder) = &args.figures {
        let figures = evaluation_figures(&library, &measured);
        let files: Vec<_> =
            figures.iter().flat_map(|(name, figure)| figure_files(folder, name, figure)).collect();
        write_together(&files, Some(folder))?;
    }
    output::print(args.json, &report, || table(&library, &measured, args.figures.as_deref()));
    Ok(())
}

fn measure(library: &Library, plan: &Plan) -> Result<LeaveOneOut, LeaveOneOutError> {
    let textures: Vec<(&TextureModel, Option<SpacePoint>)> =
        library.textures.iter().map(|texture| (&texture.model, texture.at())).collect();
    let mut progress: Option<Progress> = None;
    let measured = leave_one_out(&textures, plan, &mut |n_done, n| {
        let bar = progress.get_or_insert_with(|| Progress::new("textures left out", n));
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
    let mut lines = vec![
        format!(
            "{}: leave-one-out over {}, of {} with a position ({}; the errors are no human ratings)",
            library.name,
            counted(n, "texture"),
            n + measured.on_hull.len(),
            evaluation_source(library)
        ),
        format!(
            "  {:10} {:>9} {:>9} {:>9} {:>6} {:>6} {:>6} {:>9}",
            "", "error", "median", "level", "rank 1", "top 5", "NRS", "signals"
        ),
    ];
    let best = best(measured).map(|summary| &summary.method);
    lines.extend(measured.methods.iter().map(|summary| row(summary, best == Some(&summary.method))));
    lines.push(
        "* smallest error: root mean square difference of channel levels from the original, over 9 contacts and 40 channels"
            .to_owned(),
    );
    let checks = measured.methods.iter().filter_map(|summary| summary.signals);
    if let Some(largest) = checks.clone().map(|c| c.mean_difference_db).max_by(f64::total_cmp) {
        let rendered = checks.map(|check| check.n).max().unwrap_or(0);
        lines.push(format!(
            "signals: the same error between rendered signals of {}; on average within {largest:.2} dB of that between the models",
            counted(rendered, "texture")
        ));
    }
    lines.extend(figures.map(|folder| format!("Figures: {}", folder.display())));
    lines.join("\n")
}

fn row(summary: &Summary, is_best: bool) -> String {
    let none = || "\u{2013}".to_owned();
    let nrs = summary.nrs_mean.map_or_else(none, |nrs| format!("{nrs:.2}"));
    let signals = summary.signals.map_or_else(none, |check| format!("{:.2} dB", check.error_db_mean));
    format!(
        "{} {:10} {:6.2} dB {:6.2} dB {:6.2} dB {:4.0} % {:4.0} % {nrs:>6} {signals:>9}",
        if is_best { '*' } else { ' ' },
        method_id(&summary.method),
        summary.error_db_mean,
        summary.error_db_median,
        summary.level_error_db_mean,
        100.0 * summary.rank1,
        100.0 * summary.top5,
    )
}
