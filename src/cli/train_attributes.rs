//! `shagreen train attributes`: how well attributes can be told from strokes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use serde_json::{Value, json};
use shagreen_core::attribute_predictor::{leave_one_out, linear_leave_one_out};
use shagreen_core::gaussian_process::Estimate;
use shagreen_core::statistics::mean;
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::attribute_table;

use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output;
use crate::cli::train_networks::{NetworkArgs, train_networks};

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

/// What a way of predicting came to, texture by texture.
pub(crate) struct Judged {
    /// What it is called.
    pub(crate) name: String,
    /// Predictions of each texture, attribute by attribute.
    pub(crate) predicted: Vec<Vec<f64>>,
}

/// Errors of a way of predicting, attribute by attribute, in points of 0..100.
struct Errors {
    mae: Vec<f64>,
    rmse: Vec<f64>,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    let library = load(&args.library)?;
    let table = attribute_table(&library)?;
    let known = table.known(&library);
    let estimates = leave_one_out(&known)?;
    let means = |of: &[Estimate]| of.iter().map(|estimate| estimate.mean).collect::<Vec<f64>>();
    let mut all = vec![Judged {
        name: "gaussian process".to_owned(),
        predicted: estimates.iter().map(|of| means(of)).collect(),
    }];
    all.push(Judged { name: "linear regression".to_owned(), predicted: linear_leave_one_out(&known)? });
    let n = known.len();
    let without = |index: usize, attribute: usize| {
        let others = table.values.iter().enumerate().filter(|(i, _)| *i != index);
        mean(&others.map(|(_, values)| values[attribute]).collect::<Vec<f64>>())
    };
    let of_others = |index| (0..table.names.len()).map(|attribute| without(index, attribute)).collect();
    all.push(Judged { name: "mean of the others".to_owned(), predicted: (0..n).map(of_others).collect() });
    let trained = train_networks(&args.networks, args.state.as_deref(), &library, &table)?;
    all.extend(trained.judged);

    let errors: Vec<Errors> = all.iter().map(|judged| errors(&judged.predicted, &table.values)).collect();
    let total = |errors: &Errors| errors.rmse.iter().sum::<f64>();
    let chosen = (0..all.len()).min_by(|a, b| total(&errors[*a]).total_cmp(&total(&errors[*b]))).unwrap_or(0);
    // How far off it is, in its own deviations: about one where it knows how unsure it is.
    let calibration = |attribute: usize| {
        let pairs = estimates.iter().zip(&table.values);
        let squares = pairs
            .map(|(of, values)| ((of[attribute].mean - values[attribute]) / of[attribute].deviation).powi(2));
        mean(&squares.collect::<Vec<f64>>()).sqrt()
    };
    let by_name = |values: &[f64]| -> BTreeMap<&str, f64> {
        table.names.iter().map(String::as_str).zip(values.iter().copied()).collect()
    };
    let baselines: BTreeMap<&str, Value> = all
        .iter()
        .zip(&errors)
        .map(|(judged, of)| {
            (judged.name.as_str(), json!({"mae": by_name(&of.mae), "rmse": by_name(&of.rmse)}))
        })
        .collect();
    let calibrations: Vec<f64> = (0..table.names.len()).map(calibration).collect();
    let seconds = started.elapsed().as_secs_f64();
    let result = json!({
        "chosen": all[chosen].name,
        "mae": by_name(&errors[chosen].mae),
        "rmse": by_name(&errors[chosen].rmse),
        "error_over_deviation": by_name(&calibrations),
        "baselines": baselines,
        "textures": n,
        "label_source": table.sources.iter().map(|source| source.id()).collect::<Vec<_>>(),
        "epochs": trained.epochs,
        "seconds": seconds,
    });
    output::print(args.json, &result, || {
        let widest = all.iter().map(|judged| judged.name.len()).max().unwrap_or(0);
        let row = |name: &str, values: &[f64]| {
            let cell = |(value, name): (&f64, &String)| format!("{value:>0$.2}", name.len());
            let cells: Vec<String> = values.iter().zip(&table.names).map(cell).collect();
            format!("{name:<widest$}  {}\n", cells.join("  "))
        };
        let heading = format!("{:widest$}  {}\n", "", table.names.join("  "));
        let table_of = |what: &str, pick: fn(&Errors) -> &[f64]| {
            let rows: String =
                all.iter().zip(&errors).map(|(judged, errors)| row(&judged.name, pick(errors))).collect();
            format!("{what}\n{heading}{rows}")
        };
        format!(
            "Each of {} was left out in turn; attributes by {}.\n\n{}\n{}\nBest: {}.",
            counted(n, "texture"),
            table.source_words(),
            table_of("Mean absolute error, in points of 100", |errors| &errors.mae),
            table_of("Root mean square error", |errors| &errors.rmse),
            all[chosen].name
        )
    });
    Ok(())
}

fn errors(predicted: &[Vec<f64>], values: &[Vec<f64>]) -> Errors {
    let n_attributes = values.first().map_or(0, Vec::len);
    let off = |attribute: usize| -> Vec<f64> {
        predicted.iter().zip(values).map(|(p, v)| (p[attribute] - v[attribute]).abs()).collect()
    };
    let square =
        |errors: &[f64]| mean(&errors.iter().map(|error| error * error).collect::<Vec<f64>>()).sqrt();
    Errors {
        mae: (0..n_attributes).map(|attribute| mean(&off(attribute))).collect(),
        rmse: (0..n_attributes).map(|attribute| square(&off(attribute))).collect(),
    }
}
