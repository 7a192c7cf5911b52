//! `shagreen quality fit`: fits a model of felt difference to rated pairs of signals.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::dsp::filter::resample;
use shagreen_core::signals::quality::{Feature, PAPER_RATE, USUAL_TOLERANCE};
use shagreen_core::words::counted;
use shagreen_formats::figure::page_svg;
use shagreen_formats::quality_model::{self, write_quality_model};
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::output::{self, Printed, Usage};
use crate::cli::progress::Progress;
use crate::cli::quantity::quantity;
use crate::cli::signal_source::SignalArgs;
use crate::cli::study::textures::TextureArgs;
use crate::cli::words::words;
use shagreen_studio::figure_files::{check_figures, figure_files, write_together};
use shagreen_studio::file::{folder_of, in_file};
use shagreen_studio::quality_fit::{
    FIGURE_NAMES, FORMAT, FittedModel, RatedPairs, fit_figures, fit_pairs, fit_report, fit_text, load_pairs,
    signal_file, verdict,
};
use shagreen_studio::quality_model::predicts_nothing;
use shagreen_studio::replace::{has_format, refuse_foreign, refuse_inputs};
use shagreen_studio::study::plans::load_plan;
use shagreen_studio::study::stimuli::Waveforms;

/// Fits a model of d' to pairs of signals that people have rated.
///
/// The table has one row for each pair: the signals (reference, comparison) and d' (d_prime), or counts of answers "same" and
/// "different". The distances of the signals are computed, or columns with the names of features state them. Features are
/// eliminated backward, as long as the sum of squared errors rises by no more than --tolerance. The weights are fitted to all
/// pairs, and without the pairs of any two textures (rotations). In nested cross-validation, each texture in turn is left out of
/// elimination and fit; its R² is about 0 or negative if the model predicts nothing.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Table of rated pairs.
    #[arg(value_name = "PAIRS.csv")]
    pairs: PathBuf,
    /// Folder of the signals that the table names, as WAV files. Default: the folder of the table.
    #[arg(long, value_name = "FOLDER", conflicts_with = "plan")]
    signals: Option<PathBuf>,
    /// Plan of the study in which the pairs were rated: the table names its stimuli.
    #[arg(long, value_name = "PLAN.toml")]
    plan: Option<PathBuf>,
    #[command(flatten)]
    textures: TextureArgs,
    #[command(flatten)]
    wav: SignalArgs,
    /// Features to select from, separated by commas: roughness, brightness, regularity, asymmetry, spectral_power,
    /// spectral_amplitude, envelope. Default: all that are known.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = words(Feature::ALL, Feature::id))]
    features: Option<Vec<Feature>>,
    /// Relative rise of the sum of squared errors at which elimination stops: 0.2 for 20 %.
    #[arg(long, value_name = "SHARE", value_parser = quantity, default_value_t = USUAL_TOLERANCE)]
    tolerance: f64,
    /// Detection threshold for the distances; see `shagreen quality --help`. Default: held-tool.
    #[arg(long, value_name = "THRESHOLD", value_parser = words(ThresholdKind::ALL, ThresholdKind::id))]
    threshold: Option<ThresholdKind>,
    /// Model file to write, for `--model` of other commands and for the window. A report (MODEL.report.json) and a page of
    /// figures (MODEL.report.svg) are written next to it.
    #[arg(short, long, value_name = "MODEL.json")]
    out: Option<PathBuf>,
    /// Folder for the figures, as SVG and CSV: predicted against rated d', and the weights.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Model file, report and page of figures.
struct Outputs {
    model: PathBuf,
    report: PathBuf,
    page: PathBuf,
}

impl Outputs {
    fn of(out: &Path) -> Self {
        let [report, page] = ["report.json", "report.svg"].map(|ending| out.with_extension(ending));
        Self { model: out.to_owned(), report, page }
    }

    /// Returns an error if one of the files cannot be written, or would replace an input or a file of another kind.
    fn check(&self, inputs: &[Option<&Path>]) -> anyhow::Result<()> {
        let Self { model, report, page } = self;
        if let Some(folder) = [model, report, page].into_iter().find(|path| path.is_dir()) {
            bail!("this is a folder; choose the name of a file to write: {}", folder.display());
        }
        refuse_inputs(&[model, report, page], inputs)?;
        refuse_foreign(model, "the model", |bytes| has_format(bytes, quality_model::FORMAT))?;
        refuse_foreign(report, "the report", |bytes| has_format(bytes, FORMAT))?;
        refuse_foreign(page, "the page of figures", |bytes| bytes.starts_with(b"<svg"))
    }
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    if args.plan.is_none() && args.textures.is_given() {
        bail!(Usage(
            "--library and --project apply only with --plan; leave them out, or give the plan".to_owned()
        ));
    }
    if args.plan.is_some() && args.wav.is_given() {
        bail!(Usage("--full-scale and --channel apply to WAV files; leave them out with --plan".to_owned()));
    }
    let inputs = [Some(args.pairs.as_path()), args.plan.as_deref()];
    let outputs = args.out.as_deref().map(Outputs::of);
    if let Some(outputs) = &outputs {
        outputs.check(&inputs)?;
    }
    if let Some(folder) = &args.figures {
        check_figures(folder, &FIGURE_NAMES, &inputs)?;
    }
    let pairs = load(args)?;
    if pairs.threshold.is_none() && args.threshold.is_some() {
        output::warn("--threshold has no effect, because the table states the distances");
    }
    let progress = Progress::endless("fitting the model");
    let fitted =
        fit_pairs(pairs, args.features.as_deref(), args.tolerance).with_context(|| in_file(&args.pairs))?;
    progress.finish();
    let nested = fitted.fit.nested.r_squared;
    if predicts_nothing(nested) {
        output::warn(&verdict(nested));
    }
    write(&fitted, outputs.as_ref(), args.figures.as_deref())?;
    output::print(args.json, &fit_report(&fitted), || in_words(&fitted, outputs.as_ref()));
    Ok(())
}

/// Loads the pairs with the distances of their signals.
fn load(args: &Args) -> anyhow::Result<RatedPairs> {
    let threshold = args.threshold.unwrap_or_default();
    let mut progress: Option<Progress> = None;
    let mut on_step = |n_done: usize, n: usize| {
        let bar = progress.get_or_insert_with(|| Progress::new("comparing the signals", n));
        if n_done > 0 {
            bar.step();
        }
        true
    };
    if let Some(path) = &args.plan {
        let (study, textures) = (load_plan(path)?, args.textures.load()?);
        let waveforms = Waveforms::new(&study, &textures, &Printed).with_context(|| in_file(path))?;
        return load_pairs(&args.pairs, threshold, &mut |id| waveforms.of(id), &Printed, &mut on_step);
    }
    let folder = args.signals.clone().unwrap_or_else(|| folder_of(&args.pairs));
    let mut n_resampled = 0;
    let mut load = |name: &str| -> anyhow::Result<Vec<f64>> {
        let signal = args.wav.load(&signal_file(&folder, name)?)?;
        if signal.rate == PAPER_RATE {
            return Ok(signal.samples_mps2);
        }
        n_resampled += 1;
        Ok(resample(&signal.samples_mps2, signal.rate, PAPER_RATE))
    };
    let pairs = load_pairs(&args.pairs, threshold, &mut load, &Printed, &mut on_step)?;
    if n_resampled > 0 {
        output::note(&format!("{} resampled to {PAPER_RATE}", were(n_resampled)));
    }
    Ok(pairs)
}

fn were(n_signals: usize) -> String {
    format!("{} {}", counted(n_signals, "signal"), if n_signals == 1 { "was" } else { "were" })
}

fn write(fitted: &FittedModel, outputs: Option<&Outputs>, figures: Option<&Path>) -> anyhow::Result<()> {
    let of_fit = fit_figures(fitted);
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    if let Some(folder) = figures {
        files.extend(of_fit.iter().flat_map(|(name, figure)| figure_files(folder, name, figure)));
    }
    if let Some(Outputs { model, report, page }) = outputs {
        let mut text = serde_json::to_string_pretty(&fit_report(fitted))?;
        text.push('\n');
        let on_page: Vec<_> = of_fit.into_iter().map(|(_, figure)| figure).collect();
        let subtitle = format!(
            "{} of {} in {}; {}",
            counted(fitted.pairs.rated.len(), "pair"),
            counted(fitted.pairs.textures.len(), "texture"),
            fitted.pairs.table,
            fitted.source()
        );
        files.push((report.clone(), text.into_bytes()));
        files.push((page.clone(), page_svg("Model of felt difference", &subtitle, &on_page).into_bytes()));
        files.push((model.clone(), write_quality_model(&fitted.file())));
    }
    write_together(&files, figures)
}

fn in_words(fitted: &FittedModel, outputs: Option<&Outputs>) -> String {
    let text = fit_text(fitted);
    match outputs {
        Some(Outputs { model, report, .. }) => {
            format!("{text}\nModel: {}\nReport: {}", model.display(), report.display())
        }
        None => text,
    }
}
