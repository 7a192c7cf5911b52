//! The authoring paper: the perceptual space from sorts and ratings, the features that predict its axes, and textures that are
//! authored in the place of removed ones.

mod authored;
mod dissimilarities;
mod waveforms;

use shagreen_core::dsp::mfcc;
use shagreen_core::people::panel::{PanelConfig, USUAL_GROUPS, simulated_ratings, simulated_sorts};
use shagreen_core::space::LabelSource;
use shagreen_core::space::features::NamedTexture;
use shagreen_core::space::selection::{Method, Order, SPARE_TEXTURES};
use shagreen_core::space::space_build::{
    Axis, FeatureKind, PlacedBy, SpaceBuild, SpaceData, SpaceOptions, TRUSTED_NESTED_R,
};
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Hertz;
use shagreen_core::words::counted;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::figure::Figure;
use shagreen_formats::library::Library;
use shagreen_formats::simulated_rater_labels::panel_labels;

use crate::questionnaire::questionnaire;
use crate::reproduce::GivenJudgments;
use crate::reproduce::work::Work;
use crate::space::{self, BuiltSpace};

/// The axes of the paper.
const AXES: [&str; 2] = ["rough-smooth", "hard-soft"];

/// Number of permutations of the full run; the paper has none.
const N_PERMUTATIONS: usize = 1000;

/// What the dimensions of a scaling leave open.
const ARBITRARY: &str = "signs, order and rotation of the dimensions are arbitrary; each has the sign here with which its own adjective pair agrees with print";

/// A texture authored from three others in the place of a removed one.
struct Authored {
    /// Name of the removed texture.
    name: String,
    /// Index of the removed texture in the library.
    texture: usize,
    /// Name, plane and weight of each parent, at one rate.
    parents: Vec<(String, Plane, f64)>,
    /// Rate of the planes.
    rate: Hertz,
}

pub(super) fn run(work: &mut Work<'_>) -> anyhow::Result<()> {
    let library = work.library(BuiltIn::Starter)?;
    work.step("reading or simulating the judgments")?;
    let simulated;
    let judged = if let Some(judgments) = work.options.judgments {
        judgments
    } else {
        simulated = simulated_panel(&library, work.options.seed)?;
        &simulated
    };
    work.step("building the space")?;
    let textures = library.textures.iter().map(|t| NamedTexture { name: &t.id, model: &t.model }).collect();
    let data = SpaceData {
        textures,
        sorts: judged.sorts.clone(),
        ratings: judged.ratings.clone(),
        votes: Vec::new(),
        source: judged.source,
    };
    let built = space::build(&data, &options(work), &|_| true)?;
    if work.options.judgments.is_some() {
        built.build.findings.iter().for_each(|finding| work.reporter.warn(finding));
    }
    let who = format!(
        "{} ({}) on \"{}\"",
        counted(built.build.raters.len(), "participant"),
        judged.source.label(),
        library.name
    );
    perceptual_items(work, &built, &who);
    selection_items(work, &built, &who);
    let placed = built.placed.place(&library);
    authored::items(work, &placed)
}

/// Sorts and ratings of ten simulated participants on the four adjective pairs of the paper.
fn simulated_panel(library: &Library, seed: u64) -> anyhow::Result<GivenJudgments> {
    let perceived = panel_labels(library)?;
    let (rated, _) = perceived.on(&questionnaire("authoring-2020")?.pairs);
    let config = PanelConfig::usual(seed);
    Ok(GivenJudgments {
        sorts: simulated_sorts(&perceived.ids, &perceived.labels, &USUAL_GROUPS, &config)?,
        ratings: simulated_ratings(&rated.ids, &rated.labels, &rated.pairs, &config)?,
        source: LabelSource::SimulatedRaters,
    })
}

/// The chain of the paper: coefficients of all frames, greedy forward selection, parallel analysis, one principal component.
fn options(work: &Work<'_>) -> SpaceOptions {
    SpaceOptions {
        features: FeatureKind::MfccFrames,
        mfcc: mfcc::paper(),
        method: Method::Paper(Order::Greedy),
        n_permutations: if work.options.is_full { N_PERMUTATIONS } else { 0 },
        n_draws: 0,
        ..SpaceOptions::usual(work.options.seed)
    }
}

/// Why our numbers differ from printed ones that follow from judgments.
fn other_judges(build: &SpaceBuild) -> &'static str {
    if build.source == LabelSource::SimulatedRaters {
        "simulated raters judged simulated textures; in the paper, ten people judged 25 real ones"
    } else {
        "other textures and other participants"
    }
}

/// The figure of a built space with this name.
fn figure_of(built: &BuiltSpace, name: &str) -> Option<Figure> {
    built.figures.iter().find(|(known, _)| known == name).map(|(_, figure)| Figure::clone(figure))
}

/// Figures 4 and 5 and Table I.
fn perceptual_items(work: &mut Work<'_>, built: &BuiltSpace, who: &str) {
    let build = &built.build;
    let of_sorts = build.perceptual.as_ref();
    let reason = if of_sorts.is_some() { other_judges(build) } else { "there are no sorts" };
    let command = "shagreen space build --sorting S.csv --ratings R.csv --selection paper --out L.json";

    let mut stress = work.item("figure-4", who);
    let in_two = of_sorts.filter(|_| build.options.n_dims == 2).map(|space| space.configuration.stress);
    stress.set("stress-2", in_two, "");
    stress.figures.extend(figure_of(built, "stress").map(|figure| ("stress".to_owned(), figure)));
    stress.commands.push(command.to_owned());
    stress.explain_all(reason);
    work.done(stress);

    let mut lines = work.item("figure-5", who);
    let is_of_both = build.axes.iter().zip(AXES).all(|(axis, name)| axis.pair.name() == name);
    lines.set("angle", of_sorts.filter(|_| is_of_both).map(|space| space.angle_degrees), "");
    lines.figures.extend(figure_of(built, "perceptual-space").map(|figure| ("lines".to_owned(), figure)));
    lines.explain_all(reason);
    work.done(lines);

    let mut table = work.item("table-1", who);
    let correlation = |pair: &str, dimension: usize| -> Option<f64> {
        let adjective = build.adjectives.iter().find(|adjective| adjective.pair.name() == pair)?;
        adjective.line.as_ref().ok()?.correlations.get(dimension).copied().flatten()
    };
    // A dimension of a scaling has no direction: ours have those of the printed ones.
    let signs = [0, 1].map(|dimension| {
        let printed = table.printed(&format!("{}-{}", AXES[dimension], dimension + 1));
        let ours = correlation(AXES[dimension], dimension);
        let is_turned = ours.zip(printed).is_some_and(|(ours, printed)| ours * printed < 0.0);
        if is_turned { -1.0 } else { 1.0 }
    });
    for pair in ["rough-smooth", "sticky-slippery", "hard-soft", "irritating-pleasant"] {
        for (dimension, sign) in signs.into_iter().enumerate() {
            let ours = correlation(pair, dimension).map(|ours| sign * ours);
            let is_rated = build.adjectives.iter().any(|adjective| adjective.pair.name() == pair);
            let reason = if is_rated { "" } else { "not rated" };
            table.set(&format!("{pair}-{}", dimension + 1), ours, reason);
        }
    }
    // Without sorts, the figure shows the agreement of the raters.
    let figure = figure_of(built, "correlations");
    if of_sorts.is_some() {
        table.explain_all(&format!("{ARBITRARY}; {reason}"));
        table.figures.extend(figure.map(|figure| ("correlations".to_owned(), turned(figure, &signs))));
    } else {
        table.explain_all(reason);
        table.figures.extend(figure.map(|figure| ("correlations".to_owned(), figure)));
    }
    work.done(table);
}

/// The figure of the correlations with the signs of the rows. Its first columns are the dimensions.
fn turned(mut figure: Figure, signs: &[f64]) -> Figure {
    if let Figure::Table(table) = &mut figure {
        for (_, values) in &mut table.rows {
            for (value, sign) in values.iter_mut().zip(signs) {
                *value = value.map(|value| sign * value);
            }
        }
        table.title.push_str("; signs of the dimensions as printed");
    }
    figure
}

/// The selection of features, and Figure 6.
fn selection_items(work: &mut Work<'_>, built: &BuiltSpace, who: &str) {
    let build = &built.build;
    let mut item = work.item("selection", who);
    let predicted = |name: &str| {
        let axis: Option<&Axis> = build.axes.iter().find(|axis| axis.pair.name() == name);
        axis.and_then(|axis| axis.prediction.as_ref())
    };
    for name in AXES {
        let prediction = predicted(name);
        let chain = prediction.and_then(|prediction| prediction.chain.as_ref());
        let validation = prediction.map(|prediction| &prediction.validation);
        let n_forward = chain.map(|chain| chain.forward.features.len());
        let n_most = build.textures.len().saturating_sub(SPARE_TEXTURES);
        // Fewer than three features form no group, and all are kept.
        let n_parallel = chain.map(|chain| {
            chain.parallel.as_ref().map_or(chain.forward.features.len(), |of| of.kept.len()) as f64
        });
        let ended =
            format!("ended here at {SPARE_TEXTURES} features fewer than textures; {}", other_judges(build));
        let reason = if n_forward == Some(n_most) { ended.as_str() } else { "" };
        item.set(&format!("forward-{name}"), n_forward.map(|n| n as f64), reason);
        item.set(&format!("parallel-{name}"), n_parallel, "");
        item.set(&format!("rms-{name}"), validation.map(|of| of.cv_rms_percent), "");
        item.set(&format!("r-{name}"), validation.map(|of| of.cv_r), "");
    }
    // The honest numbers, which the paper lacks.
    for name in AXES {
        let validation = predicted(name).map(|prediction| &prediction.validation);
        let nested = format!("correlation with features selected inside each fold, {name}");
        item.add(nested, "", validation.map(|of| of.nested_cv_r));
        let baseline = format!("accuracy of always predicting the mean, {name}");
        item.add(baseline, "%", validation.map(|of| of.mean_rms_percent));
        if let Some(p) = validation.and_then(|of| of.permutation_p) {
            item.add(format!("p of a permutation test of the nested correlation, {name}"), "", Some(p));
        }
    }
    for (name, file) in [("predicted-1", "first-axis"), ("predicted-2", "second-axis")] {
        item.figures.extend(figure_of(built, name).map(|figure| (file.to_owned(), figure)));
    }
    item.explain_all(&format!(
        "{}; the threshold of the parallel analysis is the 95th percentile of 200 random draws, in the paper one draw",
        other_judges(build)
    ));
    work.done(item);

    let is_felt = build.axes.iter().any(|axis| axis.placed_by == PlacedBy::Felt);
    let places = if is_felt {
        format!(
            "{who}; positions from the judgments on axes that features predict with a nested correlation below {TRUSTED_NESTED_R}"
        )
    } else {
        format!("{who}; positions predicted from features, as in the paper")
    };
    let mut space = work.item("figure-6", places);
    space.figures.extend(figure_of(built, "authoring-space").map(|figure| ("space".to_owned(), figure)));
    work.done(space);
}
