//! `shagreen space panel`: simulates participants who rate textures, and sort them.

use std::path::{Path, PathBuf};

use anyhow::bail;
use serde_json::json;
use shagreen_core::people::panel::{
    PanelConfig, USUAL_GROUPS, is_simulated, simulated_ratings, simulated_sorts,
};
use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::ratings_csv::{ratings_csv, read_ratings_csv};
use shagreen_formats::simulated_rater_labels::{SimulatedRaterLabels, panel_labels};
use shagreen_formats::sorting_csv::{read_sorting_csv, sorting_csv};

use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::quantity::count;
use shagreen_studio::questionnaire::questionnaire;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Default parameters of a panel.
const USUAL: PanelConfig = PanelConfig::usual(1);

/// Simulates participants who rate the textures of a library, and sort them, to try `space build` without people.
///
/// They perceive the library's positions and attributes with noise, and each uses the rating scale differently. They
/// are named `simulated-01`, `simulated-02` and so on. A space that is built from their judgments states that it is
/// simulated.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    /// CSV file to write with the sorts; without it, the participants only rate.
    #[arg(long, value_name = "S.csv")]
    sorting: Option<PathBuf>,
    /// CSV file to write with the ratings.
    #[arg(long, value_name = "R.csv")]
    ratings: PathBuf,
    /// Questionnaire whose adjective pairs they rate; `shagreen space questionnaire` lists them. Default: all pairs that can
    /// be simulated.
    #[arg(long, value_name = "Q")]
    questionnaire: Option<String>,
    /// Number of participants.
    #[arg(long, default_value_t = USUAL.n_participants, value_name = "N", value_parser = count(1..=10_000))]
    participants: usize,
    /// Numbers of groups that each participant sorts the textures into, one trial for each number; separated by commas.
    #[arg(
        long,
        default_values_t = USUAL_GROUPS,
        value_delimiter = ',',
        value_parser = count(1..=1000),
        requires = "sorting"
    )]
    groups: Vec<usize>,
    /// Standard deviation of the noise in each judgment of a texture, in points of an axis (0 to 100).
    #[arg(long, default_value_t = USUAL.noise_points, value_name = "POINTS")]
    noise: f64,
    /// Standard deviation, over the participants, of their constant bias on an adjective pair, in points (0 to 100).
    #[arg(long, default_value_t = USUAL.bias_points, value_name = "POINTS")]
    bias: f64,
    /// Standard deviation, over the participants, of the natural logarithm of the fraction of the scale that they use.
    #[arg(long, default_value_t = USUAL.scale_log_spread, value_name = "SD")]
    scale: f64,
    /// Random seed; the same seed gives the same panel.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let sorting = args.sorting.as_deref();
    let outputs: Vec<&Path> = sorting.into_iter().chain([args.ratings.as_path()]).collect();
    refuse_inputs(&outputs, &[args.library.path()])?;
    if let Some(path) = sorting {
        refuse_foreign(path, "the simulated sorts", |bytes| {
            read_sorting_csv(bytes)
                .is_ok_and(|table| table.sorts.iter().all(|s| is_simulated(&s.participant)))
        })?;
    }
    refuse_foreign(&args.ratings, "the simulated ratings", |bytes| {
        read_ratings_csv(bytes).is_ok_and(|ratings| ratings.iter().all(|r| is_simulated(&r.participant)))
    })?;
    if sorting == Some(args.ratings.as_path()) {
        bail!(
            "sorts and ratings cannot be written to the same file; give two files: {}",
            args.ratings.display()
        );
    }
    let library = args.library.load()?;
    // They sort by all that they perceive, whatever they are asked to rate.
    let perceived = panel_labels(&library)?;
    let rated = rated(args, &perceived)?;
    let SimulatedRaterLabels { pairs, ids, labels } = &rated;
    let config = PanelConfig {
        n_participants: args.participants,
        noise_points: args.noise,
        bias_points: args.bias,
        scale_log_spread: args.scale,
        seed: args.seed,
    };
    let progress = Progress::endless("simulating the participants");
    let sorts = match sorting {
        Some(_) => simulated_sorts(&perceived.ids, &perceived.labels, &args.groups, &config)?,
        None => Vec::new(),
    };
    let ratings = simulated_ratings(ids, labels, pairs, &config)?;
    let tables = [sorting_csv(&sorts), ratings_csv(&ratings)];
    let files: Vec<(&Path, &[u8])> = [sorting, Some(args.ratings.as_path())]
        .into_iter()
        .zip(&tables)
        .filter_map(|(path, table)| Some((path?, table.as_slice())))
        .collect();
    atomic::write_all(&files)?;
    progress.finish();
    let names: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
    let (n_sorts, n_ratings) = (sorts.len(), ratings.len());
    output::print(
        args.json,
        &json!({
            "label_source": LabelSource::SimulatedRaters.id(),
            "participants": args.participants,
            "textures": ids,
            "questionnaire": args.questionnaire,
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

/// What the participants rate: the pairs of the questionnaire, or all that they perceive.
fn rated(args: &Args, perceived: &SimulatedRaterLabels) -> anyhow::Result<SimulatedRaterLabels> {
    let Some(id) = &args.questionnaire else { return Ok(perceived.clone()) };
    let questionnaire = questionnaire(id)?;
    let (rated, unknown) = perceived.on(&questionnaire.pairs);
    if rated.pairs.is_empty() {
        bail!("simulated raters cannot rate any pair of {id} on this library; give another questionnaire");
    }
    if !unknown.is_empty() {
        let names: Vec<String> = unknown.iter().map(AdjectivePair::name).collect();
        output::warn(&format!(
            "the library has no values for these pairs, so the simulated raters leave them out: {}",
            names.join(", ")
        ));
    }
    Ok(rated)
}
