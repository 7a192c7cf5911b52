//! The paper on attributes from strokes: mean ratings, and the errors of the CNN-LSTM and its rivals.

mod networks;

use anyhow::ensure;
use shagreen_core::people::panel::{PanelConfig, simulated_ratings};
use shagreen_core::space::LabelSource;
use shagreen_core::space::attribute_predictor::{leave_one_out, linear_leave_one_out};
use shagreen_core::space::features::NamedTexture;
use shagreen_core::space::space_build::{FeatureKind, SpaceData, SpaceOptions};
use shagreen_core::texture::patterns::{PAPER_RATE, PAPER_SECS, paper_patterns};
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::{AttributeTable, attribute_table};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::figure::Figure;
use shagreen_formats::library::{Library, id_from_name};
use shagreen_formats::questionnaire::USUAL_PARTICIPANTS;
use shagreen_formats::simulated_rater_labels::panel_labels;
use shagreen_formats::space_report::RATING_FIGURE;
use shagreen_learn::cnn_lstm::Architecture;

use crate::method_predictions::MethodPredictions;
use crate::questionnaire::questionnaire;
use crate::reproduce::GivenJudgments;
use crate::reproduce::charts::{attribute_chart, table};
use crate::reproduce::s2::networks::{KINDS, Kind, network_predictions};
use crate::reproduce::work::Work;
use crate::space;

/// The attributes of the paper.
const ATTRIBUTES: [&str; 5] =
    ["rough-smooth", "flat-bumpy", "sticky-slippery", "hard-soft", "irritating-pleasant"];
/// Fewest textures for a leave-one-out evaluation.
const LEAST_TEXTURES: usize = 5;
/// Why a network has no errors.
const NOT_TRAINED: &str = "not trained; --full, which takes days, or hours with a low --epochs";
/// Why errors differ from the printed ones.
const OTHER_DATA: &str =
    "strokes of simulated textures, and attributes that no people rated, in the place of those of the paper";

pub(super) fn run(work: &mut Work<'_>) -> anyhow::Result<()> {
    let library = work.library(BuiltIn::Simulated)?;
    work.step("averaging ratings")?;
    mean_ratings(work, &library)?;
    sizes(work);
    work.step("predicting each texture from the others")?;
    let attributes = attribute_table(&library)?;
    ensure!(
        attributes.textures.len() >= LEAST_TEXTURES,
        "\"{}\" has attributes of only {}, but at least {LEAST_TEXTURES} are needed; choose another library",
        library.name,
        counted(attributes.textures.len(), "texture")
    );
    let known = attributes.known(&library);
    let estimates = leave_one_out(&known)?;
    let means = estimates.iter().map(|of| of.iter().map(|estimate| estimate.mean).collect()).collect();
    let mut all = vec![
        MethodPredictions { name: "Gaussian process".to_owned(), predicted: means },
        MethodPredictions { name: "linear regression".to_owned(), predicted: linear_leave_one_out(&known)? },
        MethodPredictions::mean_of_others(&attributes.values),
    ];
    let n_quick = all.len();
    if work.options.is_full {
        work.step("training networks without each texture")?;
        all.extend(network_predictions(work, &library, &attributes)?);
    }
    let source = format!("{}; each texture left out", attributes.of_library(&library.name));
    let found = Found { all: &all, networks: &all[n_quick..], attributes: &attributes };
    figure_7(work, &found, &library, &source);
    table_2(work, &found, &source);
    table_3(work, &found, &source);
    figure_8(work, &found, &source);
    Ok(())
}

/// Predictions of all methods.
struct Found<'a> {
    all: &'a [MethodPredictions],
    /// Those of the networks, in the order of [`KINDS`]; empty if none was trained.
    networks: &'a [MethodPredictions],
    attributes: &'a AttributeTable,
}

impl Found<'_> {
    /// Errors of a method by attribute of the paper; `None` for attributes that the library lacks.
    fn errors(&self, method: &MethodPredictions, is_squared: bool) -> Vec<(&'static str, Option<f64>)> {
        let values = &self.attributes.values;
        let errors = if is_squared { method.rmse(values) } else { method.mae(values) };
        let of = |name: &'static str| {
            let index = self.attributes.names.iter().position(|known| known == name);
            (name, index.map(|index| errors[index]))
        };
        ATTRIBUTES.into_iter().map(of).collect()
    }

    /// Predictions of a kind of network; `None` if it was not trained.
    fn network(&self, kind: &Kind) -> Option<&MethodPredictions> {
        KINDS.iter().zip(self.networks).find(|(known, _)| known.id == kind.id).map(|(_, found)| found)
    }
}

/// Figure 5: mean ratings on each adjective pair, by simulated raters or given ones.
fn mean_ratings(work: &mut Work<'_>, library: &Library) -> anyhow::Result<()> {
    let simulated;
    let judged = if let Some(judgments) = work.options.judgments {
        judgments
    } else {
        simulated = simulated_ratings_of(library, work.options.seed)?;
        &simulated
    };
    let textures = library.textures.iter().map(|t| NamedTexture { name: &t.id, model: &t.model }).collect();
    let data = SpaceData {
        textures,
        sorts: Vec::new(),
        ratings: judged.ratings.clone(),
        votes: Vec::new(),
        source: judged.source,
    };
    // Only the means are used: the cheapest features, and no test of their prediction.
    let options = SpaceOptions {
        features: FeatureKind::Physical,
        n_permutations: 0,
        n_draws: 0,
        ..SpaceOptions::usual(work.options.seed)
    };
    let built = space::build(&data, &options, &|_| true)?;
    let raters = counted(built.build.raters.len(), "participant");
    let mut item =
        work.item("figure-5", format!("{raters} ({}) on \"{}\"", judged.source.label(), library.name));
    item.commands.push("shagreen space build --ratings R.csv --out L.json --figures FOLDER".to_owned());
    // The figures of the mean ratings are in the order of the pairs.
    let pairs = built.build.adjectives.iter().map(|adjective| id_from_name(&adjective.pair.name()));
    let figures = built.figures.iter().filter(|(name, _)| name.starts_with(RATING_FIGURE));
    for (pair, (_, figure)) in pairs.zip(figures) {
        item.figures.push((pair, Figure::clone(figure)));
    }
    work.done(item);
    Ok(())
}

/// Ratings of twelve simulated participants on the five adjective pairs of the paper.
fn simulated_ratings_of(library: &Library, seed: u64) -> anyhow::Result<GivenJudgments> {
    let (rated, _) = panel_labels(library)?.on(&questionnaire("vrst-2023")?.pairs);
    let config = PanelConfig { n_participants: USUAL_PARTICIPANTS, ..PanelConfig::usual(seed) };
    Ok(GivenJudgments {
        sorts: Vec::new(),
        ratings: simulated_ratings(&rated.ids, &rated.labels, &rated.pairs, &config)?,
        source: LabelSource::SimulatedRaters,
    })
}

/// Sizes of the strokes and of the network, which need no data.
fn sizes(work: &mut Work<'_>) {
    let network = Architecture::paper320(ATTRIBUTES.len());
    let mut item = work.item("sizes", "the strokes and the network paper320");
    item.set("samples", Some(paper_patterns().len() as f64 * PAPER_SECS * PAPER_RATE.0), "");
    item.set("convolved", Some(network.n_convolved() as f64), "");
    item.set("remembered", Some(network.units[3] as f64), "");
    item.set("joint", Some(network.n_features() as f64), "");
    item.add("trainable parameters", "", Some(network.n_parameters().0 as f64));
    work.done(item);
}

/// Figure 7: actual and predicted attributes by the network of the paper, or else by the Gaussian process.
fn figure_7(work: &mut Work<'_>, found: &Found<'_>, library: &Library, source: &str) {
    let network = KINDS.last().and_then(|kind| found.network(kind));
    let Some(method) = network.or(found.all.first()) else { return };
    let words =
        if network.is_some() { "" } else { "; by a Gaussian process, because no network was trained" };
    let mut item = work.item("figure-7", format!("{source}{words}"));
    let AttributeTable { names, textures, values, .. } = found.attributes;
    let textures: Vec<&str> =
        textures.iter().map(|texture| library.textures[*texture].name.as_str()).collect();
    for (index, attribute) in names.iter().enumerate() {
        let chart = attribute_chart((index, attribute.as_str()), &textures, values, method, source);
        item.figures.push((id_from_name(attribute), chart));
    }
    work.done(item);
}

/// Table 2: errors of the network of the paper, with those of the Gaussian process below.
fn table_2(work: &mut Work<'_>, found: &Found<'_>, source: &str) {
    let mut item = work.item("table-2", source);
    item.commands.push("shagreen train attributes --library simulated --network paper320".to_owned());
    let network = KINDS.last().and_then(|kind| found.network(kind));
    for (is_squared, id, words) in
        [(false, "mae", "mean absolute error"), (true, "rmse", "root mean square error")]
    {
        for (name, error) in network.map(|of| found.errors(of, is_squared)).unwrap_or_default() {
            item.set(&format!("{id}-{name}"), error, "");
        }
        let process = found.all.first().map(|of| found.errors(of, is_squared)).unwrap_or_default();
        for (name, error) in process {
            item.add(format!("Gaussian process, {words}, {name}"), "points", error);
        }
    }
    item.explain_all(if network.is_some() { OTHER_DATA } else { NOT_TRAINED });
    work.done(item);
}

/// Table 3: root mean square errors of the network and its rivals.
fn table_3(work: &mut Work<'_>, found: &Found<'_>, source: &str) {
    let mut item = work.item("table-3", source);
    item.commands.push("shagreen train attributes --library simulated --network paper320 --network serial --network lstm --network 1d-cnn".to_owned());
    for method in found.all {
        let errors = found.errors(method, true);
        if method.name == "linear regression" {
            for (name, error) in errors {
                item.set(
                    &format!("linear-{name}"),
                    error,
                    &format!("twelve features of the texture models, not samples; {OTHER_DATA}"),
                );
            }
        } else if !found.networks.contains(method) {
            for (name, error) in errors {
                item.add(format!("{}, {name}", method.name), "points", error);
            }
        }
    }
    for kind in &KINDS {
        let Some(network) = found.network(kind) else { continue };
        for (name, error) in found.errors(network, true) {
            item.set(&format!("{}-{name}", kind.id), error, "");
        }
    }
    item.explain_all(if found.networks.is_empty() {
        NOT_TRAINED
    } else {
        "strokes of simulated textures, and attributes that no people rated; the paper states no sizes of the rivals"
    });
    work.done(item);
}

/// Figure 8: mean absolute errors of all methods.
fn figure_8(work: &mut Work<'_>, found: &Found<'_>, source: &str) {
    let mut item = work.item("figure-8", source);
    let row = |method: &MethodPredictions| {
        let errors = found.errors(method, false).into_iter().map(|(_, error)| error);
        (method.name.clone(), errors.collect())
    };
    item.figures.push((
        "methods".to_owned(),
        table(
            "Mean absolute error in points, each texture left out",
            ATTRIBUTES.map(str::to_owned).to_vec(),
            found.all.iter().map(row).collect(),
            source,
        ),
    ));
    work.done(item);
}
