//! `shagreen train attributes`: how well attributes can be told from strokes.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::ensure;
use serde_json::{Value, json};
use shagreen_core::attribute_predictor::{leave_one_out, linear_leave_one_out};
use shagreen_core::gaussian_process::Estimate;
use shagreen_core::statistics::mean;
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::attribute_table;

use crate::cli::judged::{Comparison, Judged};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output;
use crate::cli::train_networks::{NetworkArgs, check_out, train_networks};

/// Learns to tell the attributes of textures from strokes, and says how well: each texture is left out, everything is
/// learned from the others, and it is predicted.
///
/// A Gaussian process over a few quantities of the vibration learns in milliseconds; with --network the networks of the paper
/// learn beside it, which takes hours. What predicts better is named. Attributes are the ratings that the library has, or
/// else the axes of its places; --library simulated has five.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    networks: NetworkArgs,
    /// Where to keep the trainings of networks: one that was stopped goes on from there.
    #[arg(long, value_name = "FOLDER")]
    state: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Fewer textures cannot do without one and still tell it.
const LEAST_KNOWN: usize = 5;

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    check_out(&args.networks, args.library.path())?;
    let library = load(&args.library)?;
    let table = attribute_table(&library)?;
    let known = table.known(&library);
    ensure!(
        known.len() >= LEAST_KNOWN,
        "{} of \"{}\" can be learned from; {LEAST_KNOWN} with ratings or places are the least",
        counted(known.len(), "texture"),
        library.name
    );
    let estimates = leave_one_out(&known)?;
    let means = |of: &[Estimate]| of.iter().map(|estimate| estimate.mean).collect::<Vec<f64>>();
    let mut all = vec![Judged {
        name: "gaussian process".to_owned(),
        predicted: estimates.iter().map(|of| means(of)).collect(),
    }];
    all.push(Judged { name: "linear regression".to_owned(), predicted: linear_leave_one_out(&known)? });
    all.push(Judged::mean_of_others(&table.values));
    let trained = train_networks(&args.networks, args.state.as_deref(), &library, &table)?;
    all.extend(trained.judged);

    let comparison = Comparison::new(&all, &table.names, &table.values);
    // How far off it is, in its own deviations: about one where it knows how unsure it is.
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
            "Each of {} was left out in turn; attributes by {}.\n\n{}",
            counted(n, "texture"),
            table.source_words(),
            comparison.text()
        )
    });
    Ok(())
}
