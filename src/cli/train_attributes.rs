//! `shagreen train attributes`: trains predictors of attributes from strokes and evaluates them.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::ensure;
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::statistics::mean;
use shagreen_core::space::attribute_predictor::{leave_one_out, linear_leave_one_out};
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::attribute_table;

use crate::cli::library_args::LibraryArgs;
use crate::cli::method_predictions::{Comparison, MethodPredictions};
use crate::cli::output;
use crate::cli::train_networks::{NetworkArgs, check_out, train_networks};

/// Trains predictors of texture attributes from strokes and reports their leave-one-texture-out errors: each texture is
/// predicted from a training on all others.
///
/// A Gaussian process over a few vibration features trains in milliseconds. With --network the networks of the paper
/// are trained too, which takes hours. The better predictor is named. Attributes are the ratings of the library, or
/// else the axes of its positions; --library simulated has five.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    networks: NetworkArgs,
    /// Folder for the state of trainings of networks; an interrupted training resumes from it.
    #[arg(long, value_name = "FOLDER")]
    state: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Smallest number of textures for a leave-one-out evaluation.
const LEAST_KNOWN: usize = 5;

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    check_out(&args.networks, args.library.path())?;
    let library = args.library.load()?;
    let table = attribute_table(&library)?;
    let known = table.known(&library);
    ensure!(
        known.len() >= LEAST_KNOWN,
        "only {} of \"{}\" with ratings or positions; training needs at least {LEAST_KNOWN}",
        counted(known.len(), "texture"),
        library.name
    );
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
    let trained = train_networks(&args.networks, args.state.as_deref(), &library, &table)?;
    all.extend(trained.judged);

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
    let mut result = comparison.as_json();
    let more = json!({
        "error_over_deviation": comparison.by_name(&calibrations),
        "textures": n,
        "label_source": table.source_ids().collect::<Vec<_>>(),
        "epochs": trained.epochs,
        "seconds": started.elapsed().as_secs_f64(),
    });
    result.extend(more.as_object().cloned().unwrap_or_default());
    output::print(args.json, &Value::Object(result), || {
        format!(
            "Leave-one-texture-out over {}; attributes from {}.\n\n{}",
            counted(n, "texture"),
            table.source_words(),
            comparison.text()
        )
    });
    Ok(())
}
