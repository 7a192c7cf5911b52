//! Results of building a space: a JSON report for scripts and figures for people.
//!
//! A report of a space from ratings alone has the same fields. Those that need sorts are null or empty, and the field
//! `absent` names them.

mod figures;

use serde_json::{Value, json};
use shagreen_core::people::components::RatingComponents;
use shagreen_core::people::ratings::{Agreement, RaterFit};
use shagreen_core::people::sorting::SorterFit;
use shagreen_core::space::selection::PaperChain;
use shagreen_core::space::space_build::{
    Adjective, Axis, DegenerateScaling, PlacedBy, Prediction, SpaceBuild, Stability, few_judges,
    position_errors, stress_in_words, stress_of_random_data, validation_summary,
};
use shagreen_core::words::counted;

pub use crate::space_report::figures::{RATING_FIGURE, figure_names, space_figures};

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-space-report";

/// Version of the report.
const VERSION: &str = "1.5";

/// Returns the report: all results of the analysis in one JSON object.
pub fn space_report(build: &SpaceBuild) -> Value {
    let options = &build.options;
    let of_sorts = of_sorts(build);
    let has_sorts = build.perceptual.is_some();
    let absent = of_sorts.iter().map(|(name, _)| *name).chain(["positions.perceptual"]);
    let mut report = json!({
        "format": FORMAT,
        "version": VERSION,
        "label_source": build.source.id(),
        "position_source": build.place_source().id(),
        "judgments": if has_sorts { "sorts and ratings" } else { "ratings" },
        "absent": absent.filter(|_| !has_sorts).collect::<Vec<_>>(),
        "why_absent": (!has_sorts).then_some("there are no sorts"),
        "textures": build.textures.len(),
        "not_placed": build.not_placed,
        "adjectives": build.adjectives.iter().map(adjective).collect::<Vec<_>>(),
        "axes": build.axes.iter().map(|axis| self::axis(build, axis)).collect::<Vec<_>>(),
        "axis_correlation": build.axis_correlation,
        "mean_rating_components": build.components.as_ref().ok().map(|found| components(build, found)),
        "why_no_components": build.components.as_ref().err().map(ToString::to_string),
        "standard_error": position_errors(build),
        "features": {"kind": options.features.id(), "label": build.features.label, "n": build.features.names.len()},
        "selection": options.method.id(),
        "placed_by": placed_by(build).map_or("felt+predicted", PlacedBy::id),
        "positions": positions(build),
        "raters": build.raters.iter().map(|(name, fit)| rater(build, name, fit)).collect::<Vec<_>>(),
        "missing_ratings": build.n_missing_ratings,
        "seed": options.seed,
        "verdict": validation_summary(build),
        "warnings": build.findings,
    });
    for (name, value) in of_sorts {
        report[name] = value;
    }
    report
}

/// Fields that need sorts; without sorts, they are null or empty.
fn of_sorts(build: &SpaceBuild) -> [(&'static str, Value); 12] {
    let options = &build.options;
    let space = build.perceptual.as_ref();
    let stress: &[f64] = space.map_or(&[][..], |space| space.stress.as_slice());
    let sorters: Vec<Value> = space.map_or_else(Vec::new, |space| {
        let sorter = |fit: &SorterFit| {
            json!({"participant": fit.participant, "correlation_with_others": fit.correlation})
        };
        space.similarity.agreements.iter().map(sorter).collect()
    });
    [
        ("dimensions", json!(space.map(|_| options.n_dims))),
        ("stress", json!(stress)),
        ("stress_chosen", json!(space.map(|space| space.configuration.stress))),
        ("ties", json!(space.map(|_| options.mds.transform.id()))),
        ("degenerate", json!(space.and_then(|space| space.degenerate.as_ref()).map(degenerate))),
        ("converged", json!(space.map(|space| space.configuration.converged))),
        ("stress_in_words", json!(stress_in_words(build))),
        ("stress_of_random_data", json!(stress_of_random_data(build))),
        ("angle_degrees", json!(space.map(|space| space.angle_degrees))),
        ("axes_turned_orthogonal", json!(space.map(|_| options.is_orthogonal))),
        ("stability", json!(build.stability.as_ref().map(stability))),
        ("sorters", json!(sorters)),
    ]
}

/// Bootstrap stability of the positions.
fn stability(stability: &Stability) -> Value {
    json!({
        "draws": stability.n_draws,
        "failed_draws": stability.n_failed,
        "deviation": stability.typical,
        "angle_deviation_degrees": stability.angle_deviation_degrees,
    })
}

/// Agreement of a rater with the others. Pairs are listed on which the person always gave the same rating, or rated
/// opposite to the others.
fn rater(build: &SpaceBuild, name: &str, fit: &RaterFit) -> Value {
    // Adjectives are in the order of the pairs of the table.
    let named = |pairs: &[usize]| -> Vec<String> {
        pairs.iter().map(|pair| build.adjectives[*pair].pair.name()).collect()
    };
    json!({
        "participant": name,
        "ratings": fit.n_ratings,
        "correlation_with_others": fit.correlation,
        "outlying": fit.outlying,
        "constant_on": named(&fit.constant_pairs),
        "reversed_on": named(&fit.reversed_pairs),
    })
}

/// Principal components of the mean ratings.
fn components(build: &SpaceBuild, found: &RatingComponents) -> Value {
    json!({
        "adjectives": found.pairs.iter().map(|pair| build.adjectives[*pair].pair.name()).collect::<Vec<_>>(),
        "textures": found.n_textures,
        "eigenvalues": found.eigenvalues,
        "explained": found.explained,
        "loadings": found.loadings,
        "random_eigenvalues_95": found.random_eigenvalues,
        "dimensions": found.n_dims,
    })
}

/// A degenerate solution of multidimensional scaling, and whether interval scaling replaced it.
fn degenerate(degenerate: &DegenerateScaling) -> Value {
    json!({
        "ties": degenerate.transform.id(),
        "replaced": degenerate.is_replaced,
        "coincident_pairs": degenerate.signs.n_coincident,
        "largest_coincident_dissimilarity": degenerate.signs.largest_coincident,
        "steps": degenerate.signs.n_steps,
        "dissimilarities": degenerate.signs.n_levels,
        "pairs": degenerate.signs.n_pairs,
    })
}

/// The kind of positions, if it is the same on both axes.
fn placed_by(build: &SpaceBuild) -> Option<PlacedBy> {
    let [first, second] = build.axes.each_ref().map(|axis| axis.placed_by);
    (first == second).then_some(first)
}

fn adjective(adjective: &Adjective) -> Value {
    let line = adjective.line.as_ref().ok();
    let agreement = adjective.agreement.as_ref().ok();
    let icc = |of: fn(&Agreement) -> [f64; 3]| agreement.map(of);
    json!({
        "name": adjective.pair.name(),
        "direction": line.map(|line| &line.direction),
        "r2": line.map(|line| line.r_squared),
        "p": line.map(|line| line.p_value),
        "correlation": line.map(|line| &line.correlations),
        "why_no_line": adjective.line.as_ref().err().map(ToString::to_string),
        "relevance": adjective.relevance,
        "relevant": adjective.is_relevant,
        "means": adjective.ratings.iter().map(|average| average.mean).collect::<Vec<_>>(),
        "standard_errors": adjective.ratings.iter().map(|average| average.standard_error).collect::<Vec<_>>(),
        "half_widths_95": adjective.ratings.iter().map(|average| average.half_width).collect::<Vec<_>>(),
        "raters": adjective.ratings.iter().map(|average| average.n_raters).collect::<Vec<_>>(),
        "icc_single": icc(|a| [a.single.value, a.single.low, a.single.high]),
        "icc_mean": icc(|a| [a.average.value, a.average.low, a.average.high]),
        "alpha": icc(|a| [a.alpha.value, a.alpha.low, a.alpha.high]),
        "icc_raters": agreement.map(|agreement| agreement.participants.len()),
        "icc_textures": agreement.map(|agreement| agreement.textures.len()),
        "why_no_agreement": adjective.agreement.as_ref().err().map(ToString::to_string),
    })
}

/// Numbers of a missing prediction are null, and its features are empty.
fn axis(build: &SpaceBuild, axis: &Axis) -> Value {
    let prediction = axis.prediction.as_ref();
    let v = prediction.map(|prediction| &prediction.validation);
    let chain = prediction.and_then(|prediction| prediction.chain.as_ref());
    json!({
        "name": axis.pair.name(),
        "direction": axis.direction,
        "r2": build.adjectives[axis.adjective].line.as_ref().ok().map(|line| line.r_squared),
        "placed_by": axis.placed_by.id(),
        "features": prediction.map_or(&[][..], |prediction| &prediction.features),
        "cv_r": v.map(|v| v.cv_r),
        "cv_rms_percent": v.map(|v| v.cv_rms_percent),
        "nested_cv_r": v.map(|v| v.nested_cv_r),
        "nested_cv_r_deviation": v.and_then(|v| v.nested_cv_r_deviation),
        "nested_cv_plain_r": v.map(|v| v.nested_cv_plain_r),
        "nested_cv_rms_percent": v.map(|v| v.nested_cv_rms_percent),
        "mean_rms_percent": v.map(|v| v.mean_rms_percent),
        "permutation_p": v.and_then(|v| v.permutation_p),
        "permutations": v.map(|v| v.n_permutations),
        "null_r_95": v.and_then(|v| v.null_r_95),
        "folds": v.map(|v| v.scheme.n_folds),
        "repeats": v.map(|v| v.scheme.n_repeats),
        "chain": chain.map(|chain| self::chain(build, chain)),
    })
}

/// The steps of the paper's feature selection.
fn chain(build: &SpaceBuild, chain: &PaperChain) -> Value {
    let name = |feature: &usize| &build.features.names[*feature];
    json!({
        "selected": chain.forward.features.iter().map(name).collect::<Vec<_>>(),
        "partial_f_p": chain.forward.p_values,
        "parallel": chain.parallel.as_ref().map(|parallel| json!({
            "threshold": parallel.threshold,
            "winning_groups": parallel.n_winning,
            "counts": parallel.counts,
            "kept": parallel.kept.iter().map(name).collect::<Vec<_>>(),
        })),
        "explained": chain.explained,
    })
}

fn positions(build: &SpaceBuild) -> Vec<Value> {
    let [first, second] = &build.axes;
    let of_both = |of: &dyn Fn(&Prediction) -> f64| {
        let [first, second] = [first, second].map(|axis| axis.prediction.as_ref().map(of));
        first.zip(second).map(|(first, second)| [first, second])
    };
    let position = |(i, id): (usize, &String)| {
        json!({
            "id": id,
            "at": build.positions[i].coordinates(),
            "felt": [first.felt[i], second.felt[i]],
            "felt_deviation": build.stability.as_ref().map(|stability| stability.deviations[i]),
            "felt_standard_error": build.perceptual.is_none().then(|| standard_errors(build, i)),
            "predicted": of_both(&|prediction| prediction.predicted[i]),
            "nested_predicted": of_both(&|prediction| prediction.validation.predicted[i]),
            "perceptual": build.perceptual.as_ref().map(|space| &space.configuration.points[i]),
        })
    };
    build.textures.iter().enumerate().map(position).collect()
}

/// Standard errors of the mean ratings of a texture on both axes; `None` with a single rating.
fn standard_errors(build: &SpaceBuild, texture: usize) -> [Option<f64>; 2] {
    build.axes.each_ref().map(|axis| build.adjectives[axis.adjective].ratings[texture].standard_error)
}

/// A one-line description of the data behind all figures.
pub fn space_subtitle(build: &SpaceBuild) -> String {
    let sorters = match &build.perceptual {
        Some(space) => counted(space.similarity.agreements.len(), "sorter"),
        None => "no sorts".to_owned(),
    };
    let few = few_judges(build).map_or_else(String::new, |few| format!("; {few}"));
    format!(
        "{}, {}: {sorters}, {}, seed {}; {} from {}, feature selection {}{few}",
        counted(build.textures.len(), "texture"),
        build.source.label(),
        counted(build.raters.len(), "rater"),
        build.options.seed,
        match placed_by(build) {
            Some(PlacedBy::Felt) if build.perceptual.is_none() => "mean ratings, predictions".to_owned(),
            Some(PlacedBy::Felt) => "perceptual positions, predictions".to_owned(),
            Some(PlacedBy::Predicted) => "predicted positions".to_owned(),
            None => {
                let felt = build.axes.iter().find(|axis| axis.placed_by == PlacedBy::Felt);
                let felt = felt.map_or_else(String::new, |axis| axis.pair.to_string());
                format!("perceptual positions along {felt}, predicted positions")
            }
        },
        build.features.label,
        build.options.method.id()
    )
}
