//! Every word of the workspace Build and of saving a figure.

use std::collections::BTreeSet;

use shagreen_core::mds::Ties;
use shagreen_core::ratings::{Rating, RelevanceVote};
use shagreen_core::selection::Method;
use shagreen_core::sorting::Sort;
use shagreen_core::space_build::{FeatureKind, PlacedBy, Step};

/// Heading of the column of judgments and options.
pub const MADE_OF: &str = "Made of";
/// Heading of the sortings.
pub const SORTING: &str = "Sorting";
/// Heading of the ratings.
pub const RATINGS: &str = "Ratings";
/// Heading of the votes.
pub const VOTES: &str = "Relevance votes";
/// What sortings are.
pub const SORTING_HELP: &str = "A CSV table: who put which textures into one group. Required.";
/// What ratings are.
pub const RATINGS_HELP: &str =
    "A CSV table: how each texture was rated between two adjectives, 0 to 100. Required.";
/// What votes are.
pub const VOTES_HELP: &str = "A CSV table: which adjectives people found relevant. Without it, all count.";
/// Hint in the field for a path.
pub const PATH_HINT: &str = "Path of a CSV file…";
/// The menu that saves a figure.
pub const SAVE: &str = "Save";
/// Its accessible name.
pub fn save(title: &str) -> String {
    format!("Save {title}")
}
/// Nothing was read yet.
pub const NOTHING_YET: &str = "none yet";
/// Nothing was read, and nothing has to be.
pub const OPTIONAL: &str = "optional";
/// Files are being read.
pub const READING: &str = "Reading…";
/// Lets a simulated panel judge.
pub const SIMULATE: &str = "Try with a simulated panel";
/// What a simulated panel is.
pub const SIMULATE_HELP: &str = "Ten simulated raters sort and rate by the places, attributes and physics of the library's textures, with noise. For trying the way, never for conclusions.";
/// Who may be written in several ways.
pub const PARTICIPANTS: &str = "participants";
/// Name of what a simulated panel said.
pub const SIMULATED_PANEL: &str = "simulated raters";
/// Heading of the options.
pub const OPTIONS: &str = "How it is made";
/// Option: dimensions of the perceptual space.
pub const DIMENSIONS: &str = "Dimensions";
/// What the option does.
pub const DIMENSIONS_HELP: &str =
    "Dimensions of the perceptual space. Stress falls with each; adjectives find more room.";
/// Option: ties.
pub const TIES: &str = "Ties";
/// What the option does.
pub const TIES_HELP: &str = "What becomes of pairs that were sorted equally alike: they may lie at different distances (primary), or get one (secondary).";
/// Option: the first axis.
pub const FIRST_AXIS: &str = "Axis across";
/// Option: the second axis.
pub const SECOND_AXIS: &str = "Axis up";
/// What the options do.
pub const AXIS_HELP: &str = "The adjective pairs that become the axes. Automatic: rough to smooth and hard to soft where they were rated, else the pair closest to each dimension.";
/// An option is left to the program.
pub const AUTOMATIC: &str = "automatic";
/// Option: features.
pub const FEATURES: &str = "Features";
/// What the option does.
pub const FEATURES_HELP: &str = "What is taken from the vibrations to predict where a texture lies.";
/// Option: selection.
pub const SELECTION: &str = "Selection";
/// What the option does.
pub const SELECTION_HELP: &str = "How features are chosen and weighed.";
/// Option: placement.
pub const PLACEMENT: &str = "Places";
/// What the option does.
pub const PLACEMENT_HELP: &str = "Textures lie where people felt them, or where their features predict; automatic takes, axis by axis, what is likely nearer to what people feel.";
/// Option: axes at right angles.
pub const ORTHOGONAL: &str = "Second axis at right angles";
/// What the option does.
pub const ORTHOGONAL_HELP: &str = "Turns the second axis, so that a move along one is none along the other.";
/// Option: permutations.
pub const PERMUTATIONS: &str = "Permutations";
/// What the option does.
pub const PERMUTATIONS_HELP: &str =
    "How often places are exchanged to see how well chance predicts. More take longer; 0 tests nothing.";
/// Option: seed.
pub const SEED: &str = "Seed";
/// What the option does.
pub const SEED_HELP: &str = "Start of all that is random: the same seed gives the same space.";
/// Builds.
pub const BUILD_SPACE: &str = "Build the space";
/// Builds again, since something has changed.
pub const BUILD_AGAIN: &str = "Build again";
/// Stops building.
pub const CANCEL: &str = "Cancel";
/// What cancelling does.
pub const CANCEL_HELP: &str = "Drops what is being built. What was built before stays.";
/// Building was cancelled and comes to rest.
pub const STOPPING: &str = "Stopping…";
/// Something is missing before a space can be built.
pub const NEEDS_BOTH: &str = "Needs sorting and ratings.";
/// Judgments or options are not those of the space that is shown.
pub const CHANGED: &str = "Changed since this space was built.";
/// The worker is gone.
pub const BROKEN: &str = "Building broke off; try other options, or part of the judgments.";
/// Heading before a space is built.
pub const EMPTY_TITLE: &str = "From judgments to a space";
/// What to do before a space is built.
pub const EMPTY_STEPS: [&str; 3] = [
    "People sort the textures into groups by how they feel, and rate each between pairs of adjectives.",
    "Give both tables on the left, or drop them here. A simulated panel shows the way without them.",
    "Build the space, look at its figures and at how far it can be believed, then use it.",
];
/// What a table of sortings looks like, in words.
pub const SORTING_EXAMPLE_TITLE: &str = "Sorting: one line for each texture of each sort";
/// What a table of sortings looks like.
pub const SORTING_EXAMPLE: &str = "participant,trial,groups,texture,group\np01,1,3,cork,a";
/// What a table of ratings looks like, in words.
pub const RATINGS_EXAMPLE_TITLE: &str = "Ratings: one line for each texture and person, 0 to 100";
/// What a table of ratings looks like.
pub const RATINGS_EXAMPLE: &str = "participant,texture,rough-smooth,hard-soft\np01,cork,41,70.5";
/// Below the examples.
pub const EXAMPLE_NOTE: &str =
    "Textures go by their id in the library. A texture whose group or rating is left empty was not judged.";
/// Heading of the sentences on how far a space can be believed.
pub const VERDICT: &str = "How far it can be believed";
/// Before there is a verdict.
pub const NO_VERDICT: &str =
    "Once a space is built, this column says how far it can be believed, in sentences.";
/// Puts a space to use.
pub const USE_SPACE: &str = "Use this space";
/// What using a space does.
pub const USE_HELP: &str = "Gives the textures their places and ratings of this space. Undo brings the old ones back; “Save as…” in Author writes them into a file, with the report.";
/// Above the button that puts a space to use.
pub const USE_NOTE: &str = "Undo brings the old places back.";
/// The space is in use.
pub const IN_USE: &str = "In use";
/// Goes to the workspace where the space is felt.
pub const GO_TO_AUTHOR: &str = "Feel it in Author";
/// Accessible name of the choice of figures.
pub const FIGURES: &str = "Figures";
/// Saves the picture of a figure.
pub const SAVE_SVG: &str = "Save SVG…";
/// Saves the picture of a figure as pixels.
pub const SAVE_PNG: &str = "Save PNG…";
/// Saves the numbers of a figure.
pub const SAVE_CSV: &str = "Save CSV…";
/// Heading of the sheet that saves a figure.
pub const SAVE_TITLE: &str = "Save figure";
/// Accessible name of the field of the path of a figure.
pub const SAVE_PATH: &str = "Path of the figure's file";
/// Hint in the field of the path of a figure.
pub const SAVE_HINT: &str = "/path/to/figure";
/// Shown while files hover over the window.
pub const DROP_HERE: &str = "Drop sortings, ratings or votes";
/// What can be dropped.
pub const DROP_KINDS: &str = "CSV tables of what people sorted, rated and voted";
/// How many textures the library has.
pub fn of_the_library(n_textures: usize) -> String {
    format!("{n_textures} textures of the open library")
}

/// Accessible name of the field for the path of a table.
pub fn path_of(what: &str) -> String {
    format!("Path of the table: {}", what.to_lowercase())
}

/// Accessible name of the button that reads a table.
pub fn read(what: &str) -> String {
    format!("Read {}", what.to_lowercase())
}

/// Accessible name of the button that takes a table away.
pub fn remove(what: &str) -> String {
    format!("Remove {}", what.to_lowercase())
}

fn n_of<T: Ord>(names: impl Iterator<Item = T>) -> usize {
    names.collect::<BTreeSet<_>>().len()
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Sortings in figures.
pub fn sorting(sorts: &[Sort]) -> String {
    let participants = n_of(sorts.iter().map(|sort| &sort.participant));
    let textures = n_of(sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| &p.texture)));
    [count(participants, "participant"), count(sorts.len(), "sort"), count(textures, "texture")].join(", ")
}

/// Ratings in figures.
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

/// Votes in figures.
pub fn votes(votes: &[RelevanceVote]) -> String {
    let participants = n_of(votes.iter().map(|vote| &vote.participant));
    let adjectives = n_of(votes.iter().map(|vote| &vote.adjective));
    [count(participants, "participant"), count(votes.len(), "vote"), count(adjectives, "adjective")]
        .join(", ")
}

/// Names of textures that were judged but are not in the library.
pub fn not_in_library(names: &[&str]) -> String {
    let more = names.len().saturating_sub(3);
    let and_more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!(
        "Not in the library: {}{and_more}. Correct the names, or import the textures.",
        names[..names.len() - more].join(", ")
    )
}

/// A step of building.
pub fn step(step: Step) -> String {
    let what = match step {
        Step::Sorting => "putting sorts together",
        Step::Scaling => "scaling the perceptual space",
        Step::Adjectives => "fitting adjectives",
        Step::Features => "stroking textures",
        Step::Axis(0) => "predicting the axis across",
        Step::Axis(_) => "predicting the axis up",
        Step::Stability => "drawing participants anew",
    };
    format!("{} of {}: {what}", step.index() + 1, Step::COUNT)
}

/// How ties are treated.
pub fn ties(ties: Ties) -> &'static str {
    match ties {
        Ties::Primary => "primary",
        Ties::Secondary => "secondary",
    }
}

/// What is taken from vibrations.
pub fn features(kind: FeatureKind) -> &'static str {
    match kind {
        FeatureKind::Mfcc => "cepstra (means)",
        FeatureKind::MfccFrames => "cepstra (frames, paper)",
        FeatureKind::Physical => "physical",
        FeatureKind::MfccAndPhysical => "cepstra and physical",
    }
}

/// How features are chosen.
pub fn selection(method: Method) -> &'static str {
    match method.id() {
        "paper" => "as in the paper",
        "paper-ranked" => "as in the paper, ranked",
        _ => "practical",
    }
}

/// Where textures lie.
pub fn placement(placement: Option<PlacedBy>) -> &'static str {
    match placement {
        None => AUTOMATIC,
        Some(PlacedBy::Felt) => "as felt",
        Some(PlacedBy::Predicted) => "as predicted",
    }
}

/// Name of a figure on its tab, by the name that serves for files.
pub fn figure(name: &str) -> &str {
    match name {
        "stress" => "Stress",
        "perceptual-space" => "Perceptual",
        "correlations" => "Correlations",
        "adjectives" => "Adjectives",
        "predicted-1" => "Predicted across",
        "predicted-2" => "Predicted up",
        "authoring-space" => "Authoring",
        "shepard" => "Shepard",
        other => other,
    }
}

/// What a figure's file will hold.
pub fn to_save(title: &str, format: &str) -> String {
    match format {
        "CSV" => format!("The numbers of “{title}” go into one CSV file."),
        _ => format!("“{title}” goes into one {format} file."),
    }
}

/// A file of the same kind is there.
pub fn exists(format: &str) -> String {
    format!("There is such a {format} file at this path already. Replace it, or choose another path.")
}

/// Why a file of another kind is not replaced.
pub fn no_figure(format: &str) -> String {
    format!("Choose another path: what is there is no {format} file of such a figure, so it is not replaced.")
}
