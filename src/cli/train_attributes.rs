//! `shagreen train attributes`: trains predictors of attributes from texture models and evaluates them.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::ensure;
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::shard::Shard;
use shagreen_core::maths::statistics::mean;
use shagreen_core::space::attribute_predictor::{leave_one_out, linear_leave_one_out};
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::{AttributeTable, attribute_table};
use shagreen_formats::library::Library;

use crate::cli::drawn_touches::{DrawnTouches, drawn_touches};
use crate::cli::library_args::LibraryArgs;
use crate::cli::method_predictions::{Comparison, MethodPredictions};
use crate::cli::output;
use crate::cli::prediction_figures::{FigureArgs, Judged};
use crate::cli::progress::Progress;
use crate::cli::train_networks::{NetworkArgs, check_arguments, train_networks, train_part};

/// Trains predictors of texture attributes on the texture models of a library. Reports leave-one-texture-out errors: each
/// texture is predicted by a predictor that was trained on the others.
///
/// A Gaussian process over 12 features of each model (level, spectrum, friction, tap transient) trains in milliseconds.
/// --network also trains a network of "Predicting Perceptual Haptic Attributes of Textured Surface from Tactile Data
/// Based on Deep CNN-LSTM Network" (VRST 2023) or one of its rivals, on strokes rendered from the models or recorded; this
/// takes hours, or the time budget of --minutes.
/// Linear regression and the mean of the other textures are evaluated too. The command names the predictor with the
/// lowest root mean square error. Attributes are the ratings of the library; without ratings, they are the axes of its
/// positions. --library simulated has five attributes.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    networks: NetworkArgs,
    /// Number of drawn materials (random parameters) on which the prediction of hard-soft is evaluated too, with and
    /// without tap transients; at least 5, or 0 for none. Each is stroked and tapped with another tool: tip radius 0.5 to
    /// 3 mm, effective mass 10 to 40 g, half to double damping. Labels and tap transients are computed from the same
    /// contact stiffness. Takes some seconds for each material.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    drawn: u32,
    /// Folder for the state of network training; an interrupted training resumes from it.
    #[arg(long, value_name = "FOLDER")]
    state: Option<PathBuf>,
    #[command(flatten)]
    figures: FigureArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Smallest number of textures for a leave-one-out evaluation.
const LEAST_KNOWN: usize = 5;

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    let n_drawn = args.drawn as usize;
    ensure!(
        n_drawn == 0 || n_drawn >= LEAST_KNOWN,
        "--drawn is {n_drawn}, but at least {LEAST_KNOWN} materials are needed; give a larger number, or leave the option out"
    );
    check_arguments(&args.networks, args.library.path())?;
    let library = args.library.load()?;
    let table = attribute_table(&library)?;
    let known = table.known(&library);
    ensure!(
        known.len() >= LEAST_KNOWN,
        "\"{}\" has only {} usable for training (estimates do not count), but at least {LEAST_KNOWN} are needed; give ratings or positions for all textures in one table with `shagreen space place`",
        library.name,
        counted(known.len(), "texture")
    );
    if let (Some(shard), Some(state)) = (args.networks.shard(), &args.state) {
        return train_a_part(args, state, (&library, &table), shard);
    }
    args.figures.check(&table.names, &[args.library.path()])?;
    let progress = Progress::endless("predicting each texture from the others");
    let estimates = leave_one_out(&known)?;
    let means = |of: &[Estimate]| of.iter().map(|estimate| estimate.mean).collect::<Vec<f64>>();
    let mut all = vec![MethodPredictions {
        name: "gaussian process".to_owned(),
        predicted: estimates.iter().map(|of| means(of)).collect(),
    }];
    all.push(MethodPredictions {
        name: "linear regression".to_owned(),
        predicted: linear_leave_one_out(&known)?,
    });
    all.push(MethodPredictions::mean_of_others(&table.values));
    progress.finish();
    let drawn = if n_drawn > 0 { Some(drawn_touches(n_drawn, args.networks.seed())?) } else { None };
    let mut trained = train_networks(&args.networks, args.state.as_deref(), &library, &table, &all[0])?;
    all.append(&mut trained.judged);

    let comparison = Comparison::new(&all, &table.names, &table.values);
    // RMS of error over predicted standard deviation: about one for calibrated uncertainties.
    let calibration = |attribute: usize| {
        let pairs = estimates.iter().zip(&table.values);
        let squares = pairs
            .map(|(of, values)| ((of[attribute].mean - values[attribute]) / of[attribute].deviation).powi(2));
        mean(&squares.collect::<Vec<f64>>()).sqrt()
    };
    let calibrations: Vec<f64> = (0..table.names.len()).map(calibration).collect();
    let n = known.len();
    let deviations =
        estimates.iter().map(|of| of.iter().map(|estimate| estimate.deviation).collect()).collect();
    let textures: Vec<String> =
        table.textures.iter().map(|index| library.textures[*index].name.clone()).collect();
    let drawing = args.figures.write(&Judged {
        methods: &all,
        deviations: &[(all[0].name.clone(), deviations)],
        textures: &textures,
        attributes: &table.names,
        actual: &table.values,
        validation: "leave-one-texture-out",
        source: &table.source_words(),
    });
    let mut result = comparison.as_json();
    let more = json!({
        "error_over_deviation": comparison.by_name(&calibrations),
        "textures": n,
        "label_source": table.source_ids().collect::<Vec<_>>(),
        "epochs": trained.n_epochs(),
        "networks": trained.as_json(),
        "figures": args.figures.folder().map(|folder| folder.display().to_string()),
        "seconds": started.elapsed().as_secs_f64(),
    });
    result.extend(more.as_object().cloned().unwrap_or_default());
    if let Some(drawn) = &drawn {
        result.insert("drawn".to_owned(), Value::Object(drawn.as_json()));
    }
    output::print(args.json, &Value::Object(result), || {
        let of_library = format!(
            "Leave-one-texture-out errors over {}; attributes from {}.\n\n{}",
            counted(n, "texture"),
            table.source_words(),
            comparison.text()
        );
        let parts = [of_library, trained.text(), drawn.as_ref().map(DrawnTouches::text).unwrap_or_default()];
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<String>>().join("\n\n")
    });
    // After the result, which took hours and must not be lost with the figures.
    drawing
}

/// Trains the networks that leave out a part of the textures.
fn train_a_part(
    args: &Args,
    state: &Path,
    (library, table): (&Library, &AttributeTable),
    shard: Shard,
) -> anyhow::Result<()> {
    let textures = train_part(&args.networks, state, library, table, shard)?;
    let result = json!({
        "shard": shard.to_string(),
        "state": state.display().to_string(),
        "textures": textures,
    });
    output::print(args.json, &result, || {
        format!(
            "Trained without each of {} ({}); when all parts are trained, run the command without --shard: {}",
            counted(textures.len(), "texture"),
            textures.join(", "),
            state.display()
        )
    });
    Ok(())
}
