//! `shagreen space panel`: sortings and ratings of simulated participants.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_core::panel::{PanelConfig, USUAL_GROUPS, is_simulated, simulated_ratings, simulated_sorts};
use shagreen_core::ratings::AdjectivePair;
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::panel_labels::{PanelLabels, panel_labels};
use shagreen_formats::ratings_csv::{ratings_csv, read_ratings_csv};
use shagreen_formats::sorting_csv::{read_sorting_csv, sorting_csv};

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output;

/// What a panel is like where nobody says otherwise.
const USUAL: PanelConfig = PanelConfig::usual(1);

/// Simulates participants who sort and rate the textures of a library, to try `space build` without people.
///
/// They perceive the places and attributes that the library has, with noise, and use the scale each in an own way. They
/// are called `simulated-01` and so on, and every space made of them says so.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// Sortings to write.
    #[arg(long, value_name = "S.csv")]
    sorting: PathBuf,
    /// Ratings to write.
    #[arg(long, value_name = "R.csv")]
    ratings: PathBuf,
    /// How many participants.
    #[arg(long, default_value_t = USUAL.n_participants, value_name = "N")]
    participants: usize,
    /// Groups that are to be made, a trial each.
    #[arg(long, default_values_t = USUAL_GROUPS, value_delimiter = ',')]
    groups: Vec<usize>,
    /// Standard deviation of what is perceived of a texture, in points of an axis.
    #[arg(long, default_value_t = USUAL.noise_points, value_name = "POINTS")]
    noise: f64,
    /// Standard deviation of each participant's constant error on a pair, in points.
    #[arg(long, default_value_t = USUAL.bias_points, value_name = "POINTS")]
    bias: f64,
    /// Standard deviation of the logarithm of the share of the scale that a participant uses.
    #[arg(long, default_value_t = USUAL.scale_log_spread, value_name = "SHARE")]
    scale: f64,
    /// Makes the same panel again.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.sorting, &args.ratings], &[args.library.path()])?;
    refuse_foreign(&args.sorting, "simulated sortings", |bytes| {
        read_sorting_csv(bytes).is_ok_and(|table| table.sorts.iter().all(|s| is_simulated(&s.participant)))
    })?;
    refuse_foreign(&args.ratings, "simulated ratings", |bytes| {
        read_ratings_csv(bytes).is_ok_and(|ratings| ratings.iter().all(|r| is_simulated(&r.participant)))
    })?;
    if args.sorting == args.ratings {
        bail!("sortings and ratings cannot be one file; name two: {}", args.sorting.display());
    }
    let library = load(&args.library)?;
    let PanelLabels { pairs, ids, labels } = panel_labels(&library)?;
    let config = PanelConfig {
        n_participants: args.participants,
        noise_points: args.noise,
        bias_points: args.bias,
        scale_log_spread: args.scale,
        seed: args.seed,
    };
    let sorts = simulated_sorts(&ids, &labels, &args.groups, &config)?;
    let ratings = simulated_ratings(&ids, &labels, &pairs, &config)?;
    atomic::write_all(&[(&args.sorting, &sorting_csv(&sorts)), (&args.ratings, &ratings_csv(&ratings))])?;
    let names: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
    let (n_sorts, n_ratings) = (sorts.len(), ratings.len());
    output::print(
        args.json,
        &json!({
            "label_source": LabelSource::SimulatedRaters.id(),
            "participants": args.participants,
            "textures": ids,
            "adjectives": names,
            "sorts": n_sorts,
            "ratings": n_ratings,
            "seed": args.seed,
        }),
        || {
            format!(
                "Simulated {} on {}: {} and {} of {}",
                counted(args.participants, "participant"),
                counted(ids.len(), "texture"),
                counted(n_sorts, "sort"),
                counted(n_ratings, "rating"),
                names.join(", ")
            )
        },
    );
    Ok(())
}
