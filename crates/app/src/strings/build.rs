//! Build workspace, and saving a figure.

use std::collections::BTreeSet;

use shagreen_core::people::mds::Transform;
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::selection::Method;
use shagreen_core::space::space_build::{FeatureKind, PlacedBy, Step};
use shagreen_formats::questionnaire::USUAL_PARTICIPANTS;
use shagreen_formats::space_report::RATING_FIGURE;
use shagreen_studio::questionnaire::ExperimentFile;

// Inputs.
pub const MADE_OF: &str = "Inputs";
/// Kind of file in the dialog of the system.
pub const TABLES: &str = "Tables";
pub const SORTING: &str = "Sorting";
pub const RATINGS: &str = "Ratings";
pub const VOTES: &str = "Relevance votes";
pub const SORTING_HELP: &str = "CSV table of the groups into which each participant sorted the textures. Without it, the positions are the mean ratings.";
pub const RATINGS_HELP: &str =
    "CSV table of ratings of each texture between two opposite adjectives, 0 to 100. Required.";
pub const VOTES_HELP: &str =
    "CSV table of the adjectives that participants found relevant. Without it, all adjectives are used.";
pub const SCALE_LOW: &str = "Lowest rating of the scale";
pub const SCALE_HIGH: &str = "Highest rating of the scale";
pub const SCALE_HELP: &str = "Lowest and highest rating that participants could give, such as 1 and 7. Ratings are converted to 0 to 100.";
pub const ASSUMED_PEOPLE: &str =
    "The participants are assumed to be people. Simulated raters must be named simulated-01 and so on.";
pub const PATH_HINT: &str = "Path of a CSV file…";
pub const SAVE: &str = "Save";

/// Accessible name of the menu that saves the figure of this title.
pub fn save(title: &str) -> String {
    format!("Save {title}")
}

pub const NOTHING_YET: &str = "none yet";
pub const OPTIONAL: &str = "optional";
pub const READING: &str = "Reading…";
pub const QUESTIONNAIRES: &str = "Questionnaires";
pub const SIMULATE: &str = "Try with simulated raters";
pub const SIMULATE_HELP: &str = "Ten simulated raters sort and rate the textures from their library positions, attributes and physical quantities, with noise. Use them only to try the workflow, never for conclusions.";
pub const PARTICIPANTS: &str = "participants";
pub const SIMULATED_PANEL: &str = "simulated raters";

// Options.
pub const OPTIONS: &str = "Options";
pub const DIMENSIONS: &str = "Dimensions";
pub const NEEDS_SORTS: &str = "Without sorts there is no perceptual space, so this option has no effect.";
pub const DIMENSIONS_HELP: &str = "Number of dimensions of the perceptual space (multidimensional scaling). More dimensions lower the stress and fit the adjectives better.";
pub const TIES: &str = "Ties";
pub const TIES_HELP: &str = "Treatment of texture pairs with equal similarity: primary lets their distances differ, secondary makes their distances equal. Interval makes all distances a linear function of the dissimilarities (metric scaling). Automatic is primary, or interval if the solution of primary is degenerate.";
pub const FIRST_AXIS: &str = "X axis";
pub const SECOND_AXIS: &str = "Y axis";
pub const AXIS_HELP: &str = "Adjective pair that becomes this axis. Automatic takes rough to smooth and hard to soft if they were rated, else the pair that correlates best with each dimension. Without sorts, it takes the two least correlated pairs with reliable ratings.";
pub const AUTOMATIC: &str = "automatic";
pub const FEATURES: &str = "Features";
pub const FEATURES_HELP: &str = "Vibration features that predict the position of a texture.";
pub const SELECTION: &str = "Selection";
pub const SELECTION_HELP: &str = "Method that selects and weights the features: the mean of ridge regressions, or the published forward selection, which adds features by partial F or in order of correlation (ranked).";
pub const PLACEMENT: &str = "Positions";
pub const PLACEMENT_HELP: &str = "Source of the positions: perceived (from the judgments) or predicted (from the features). Automatic uses the prediction for an axis if its nested correlation is at least 0.85, and the mean ratings without sorts.";
pub const ORTHOGONAL: &str = "Orthogonal axes";
pub const ORTHOGONAL_HELP: &str = "Rotates the second axis to a right angle with the first, so that a move along one leaves the other unchanged.";
pub const PERMUTATIONS: &str = "Permutations";
pub const PERMUTATIONS_HELP: &str = "Number of random permutations of the positions, for the test of the prediction against chance. More permutations take longer; 0 skips the test.";
pub const SEED: &str = "Seed";
pub const SEED_HELP: &str = "Seed of the random numbers: the same seed gives the same space.";

// Building.
pub const BUILD_SPACE: &str = "Build the space";
pub const BUILD_AGAIN: &str = "Build again";
pub const CANCEL: &str = "Cancel";
pub const CANCEL_HELP: &str = "Stops the build. The previous space stays.";
pub const STOPPING: &str = "Stopping…";
pub const NEEDS_RATINGS: &str = "A ratings table is required. A sorting table is optional.";
pub const CHANGED: &str =
    "Library, judgments or options have changed since this space was built. Build it again.";
pub const BROKEN: &str = "The build stopped unexpectedly; try other options, or only part of the judgments.";

// Before a space is built.
pub const EMPTY_TITLE: &str = "From judgments to a space";
pub const EMPTY_STEPS: [&str; 3] = [
    "Participants rate each texture between pairs of adjectives, and can sort the textures into groups by feel.",
    "Enter the paths of the tables on the left, or drop the files here. Simulated raters need no tables.",
    "Build the space, check its figures and validation, then use it.",
];
pub const SORTING_EXAMPLE_TITLE: &str = "Sorting (optional): one row for each texture in each sort";
pub const SORTING_EXAMPLE: &str = "participant,trial,groups,texture,group\np01,1,3,cork,a";
pub const RATINGS_EXAMPLE_TITLE: &str = "Ratings: one row for each participant and texture, 0 to 100";
pub const RATINGS_EXAMPLE: &str = "participant,texture,rough-smooth,hard-soft\np01,cork,41,70.5";
pub const EXAMPLE_NOTE: &str = "Textures are identified by their id in the library. An empty group or rating means that the texture was not judged.";

// Validation and use.
pub const VERDICT: &str = "Validation";
pub const NO_VERDICT: &str = "The validation summary appears here after you build a space.";
pub const USE_SPACE: &str = "Use this space";
pub const USE_HELP: &str = "Gives the textures the positions and ratings of this space. Undo restores the previous ones. “Save as…” in the Author workspace saves them in a library file, with the report.";
pub const USE_NOTE: &str = "Undo restores the previous positions.";
pub const IN_USE: &str = "In use";
pub const GO_TO_AUTHOR: &str = "Open in Author";

// Figures.
pub const FIGURES: &str = "Figures";
pub const SAVE_SVG: &str = "Save SVG…";
pub const SAVE_PNG: &str = "Save PNG…";
pub const SAVE_CSV: &str = "Save CSV…";
/// Choice of the adjective pair whose mean ratings are shown.
pub const RATED_PAIR: &str = "Adjective pair";
pub const SAVE_TITLE: &str = "Save figure";
pub const SAVE_PATH: &str = "Path of the figure file";
pub const SAVE_HINT: &str = "e.g. /path/to/figure";
pub const BLANK_TITLE: &str = "Save questionnaire";
pub const BLANK_PATH: &str = "Path of the questionnaire file";
pub const BLANK_HINT: &str = "e.g. /path/to/ratings.csv";
pub const BLANK_EXISTS: &str =
    "A blank file of this kind exists at this path. Replace it, or choose another path.";
pub const NOT_BLANK: &str =
    "The file at this path is not a blank file of this kind and is not replaced. Choose another path.";
pub const DROP_HERE: &str = "Drop sorting, ratings or votes";
pub const DROP_KINDS: &str = "CSV tables of sorting, ratings and relevance votes";

/// Tooltip of the menu of questionnaires.
pub fn questionnaires_help() -> String {
    format!(
        "Blank tables and instructions for an experiment with the textures of the open library and {USUAL_PARTICIPANTS} participants. The command “space questionnaire” writes them for other numbers."
    )
}

/// Entry in the menu of questionnaires.
pub fn blank_file(file: ExperimentFile) -> &'static str {
    match file {
        ExperimentFile::Ratings => "Table of ratings…",
        ExperimentFile::Votes => "Table of relevance votes…",
        ExperimentFile::Instructions => "Instructions…",
    }
}

/// Accessible name of an entry in the menu of questionnaires.
pub fn blank_file_of(file: ExperimentFile, questionnaire: &str) -> String {
    format!("{questionnaire}: {}", blank_file(file).trim_end_matches('…'))
}

/// What the file of a questionnaire contains.
pub fn to_save_blank(file: ExperimentFile, questionnaire: &str, n_textures: usize) -> String {
    let what = match file {
        ExperimentFile::Ratings => "a blank table of ratings",
        ExperimentFile::Votes => "a blank table of votes on the relevance of adjectives",
        ExperimentFile::Instructions => "the instructions",
    };
    format!(
        "Saves {what} for {USUAL_PARTICIPANTS} participants and {}: {questionnaire}.",
        count(n_textures, "texture")
    )
}

pub fn of_the_library(n_textures: usize) -> String {
    format!("{n_textures} textures of the open library")
}

/// Accessible name of the path field of a table.
pub fn path_of(what: &str) -> String {
    format!("Path of the table: {}", what.to_lowercase())
}

/// Accessible name of the button that reads a table.
pub fn read(what: &str) -> String {
    format!("Read {}", what.to_lowercase())
}

/// Accessible name of the button that removes a table.
pub fn remove(what: &str) -> String {
    format!("Remove {}", what.to_lowercase())
}

fn n_of<T: Ord>(names: impl Iterator<Item = T>) -> usize {
    names.collect::<BTreeSet<_>>().len()
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Numbers of participants, sorts and textures.
pub fn sorting(sorts: &[Sort]) -> String {
    let participants = n_of(sorts.iter().map(|sort| &sort.participant));
    let textures = n_of(sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| &p.texture)));
    [count(participants, "participant"), count(sorts.len(), "sort"), count(textures, "texture")].join(", ")
}

/// Numbers of participants, ratings, textures and adjective pairs.
pub fn ratings(ratings: &[Rating]) -> String {
    let participants = n_of(ratings.iter().map(|rating| &rating.participant));
    let textures = n_of(ratings.iter().map(|rating| &rating.texture));
    let pairs: BTreeSet<String> = ratings.iter().map(|rating| rating.pair.name()).collect();
    let parts = [
        count(participants, "participant"),
        count(ratings.len(), "rating"),
        count(textures, "texture"),
        count(pairs.len(), "pair"),
    ];
    parts.join(", ")
}

/// Numbers of participants, votes and adjectives.
pub fn votes(votes: &[RelevanceVote]) -> String {
    let participants = n_of(votes.iter().map(|vote| &vote.participant));
    let adjectives = n_of(votes.iter().map(|vote| &vote.adjective));
    [count(participants, "participant"), count(votes.len(), "vote"), count(adjectives, "adjective")]
        .join(", ")
}

/// Warning about judged textures without an entry in the library.
pub fn not_in_library(names: &[&str]) -> String {
    let more = names.len().saturating_sub(3);
    let and_more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!(
        "Not in the library: {}{and_more}. Correct the names, or import the textures.",
        names[..names.len() - more].join(", ")
    )
}

/// Progress of the build: number and name of the step.
pub fn step(step: Step) -> String {
    let what = match step {
        Step::Sorting => "pooling sorts",
        Step::Scaling => "scaling the perceptual space",
        Step::Adjectives => "analyzing the ratings",
        Step::Features => "computing features",
        Step::Axis(0) => "predicting the x axis",
        Step::Axis(_) => "predicting the y axis",
        Step::Stability => "bootstrapping participants",
    };
    format!("{} of {}: {what}", step.index() + 1, Step::COUNT)
}

pub fn ties(ties: Option<Transform>) -> &'static str {
    ties.map_or(AUTOMATIC, Transform::id)
}

pub fn features(kind: FeatureKind) -> &'static str {
    match kind {
        FeatureKind::Mfcc => "MFCC (means)",
        FeatureKind::MfccFrames => "MFCC (frames, published)",
        FeatureKind::Physical => "physical",
        FeatureKind::MfccAndPhysical => "MFCC and physical",
    }
}

pub fn selection(method: Method) -> &'static str {
    match method.id() {
        "paper" => "as published",
        "paper-ranked" => "as published, ranked",
        _ => "ridge regressions",
    }
}

pub fn placement(placement: Option<PlacedBy>) -> &'static str {
    match placement {
        None => AUTOMATIC,
        Some(PlacedBy::Felt) => "perceived",
        Some(PlacedBy::Predicted) => "predicted",
    }
}

/// Tab label of a figure, from its file name.
pub fn figure(name: &str) -> &str {
    match name {
        "stress" => "Stress",
        "perceptual-space" => "Perceptual",
        "correlations" => "Correlations",
        "adjectives" => "Adjectives",
        "predicted-1" => "Predicted x",
        "predicted-2" => "Predicted y",
        "authoring-space" => "Authoring",
        "shepard" => "Shepard",
        "components" => "Components",
        of_ratings if of_ratings.starts_with(RATING_FIGURE) => "Mean ratings",
        other => other,
    }
}

pub fn to_save(title: &str, format: &str) -> String {
    match format {
        "CSV" => format!("Saves the data of “{title}” in CSV format."),
        _ => format!("Saves “{title}” in {format} format."),
    }
}

/// Question before a figure of the same kind is replaced.
pub fn exists(format: &str) -> String {
    format!("A figure in {format} format exists at this path. Replace it, or choose another path.")
}

/// Why an existing file is not replaced by a figure.
pub fn no_figure(format: &str) -> String {
    format!(
        "The file at this path is not a figure of this kind ({format}) and is not replaced. Choose another path."
    )
}
