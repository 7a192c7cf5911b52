//! Results of building a space: a JSON report for scripts and figures for people.

use serde_json::{Value, json};
use shagreen_core::people::mds::Transform;
use shagreen_core::people::property::correlation_table;
use shagreen_core::people::ratings::Agreement;
use shagreen_core::space::selection::PaperChain;
use shagreen_core::space::space_build::{
    Adjective, Axis, DegenerateScaling, PlacedBy, Prediction, SpaceBuild, kruskal_word, stress_in_words,
    stress_of_random_data, validation_summary,
};

use crate::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-space-report";
/// Names of the figures, in order.
pub const FIGURES: [&str; 8] = [
    "stress",
    "perceptual-space",
    "correlations",
    "adjectives",
    "predicted-1",
    "predicted-2",
    "authoring-space",
    "shepard",
];

/// Version of the report.
const VERSION: &str = "1.3";

/// Returns the report: all results of the analysis in one JSON object.
pub fn space_report(build: &SpaceBuild) -> Value {
    let options = &build.options;
    json!({
        "format": FORMAT,
        "version": VERSION,
        "label_source": build.source.id(),
        "position_source": build.place_source().id(),
        "textures": build.textures.len(),
        "not_placed": build.not_sorted,
        "dimensions": options.n_dims,
        "stress": build.stress,
        "stress_chosen": build.perceptual.stress,
        "ties": options.mds.transform.id(),
        "degenerate": build.degenerate.as_ref().map(degenerate),
        "converged": build.perceptual.converged,
        "stress_in_words": stress_in_words(build),
        "stress_of_random_data": stress_of_random_data(build),
        "adjectives": build.adjectives.iter().map(adjective).collect::<Vec<_>>(),
        "axes": build.axes.iter().map(|axis| self::axis(build, axis)).collect::<Vec<_>>(),
        "angle_degrees": build.angle_degrees,
        "axes_turned_orthogonal": options.is_orthogonal,
        "stability": build.stability.as_ref().map(|stability| json!({
            "draws": stability.n_draws,
            "failed_draws": stability.n_failed,
            "deviation": stability.typical,
            "angle_deviation_degrees": stability.angle_deviation_degrees,
        })),
        "features": {"kind": options.features.id(), "label": build.features.label, "n": build.features.names.len()},
        "selection": options.method.id(),
        "placed_by": placed_by(build).map_or("felt+predicted", PlacedBy::id),
        "positions": positions(build),
        "raters": build.raters.iter().map(|(name, fit)| json!({
            "participant": name,
            "ratings": fit.n_ratings,
            "correlation_with_others": fit.correlation,
            "outlying": fit.outlying,
        })).collect::<Vec<_>>(),
        "sorters": build.similarity.agreements.iter().map(|agreement| json!({
            "participant": agreement.participant,
            "correlation_with_others": agreement.correlation,
        })).collect::<Vec<_>>(),
        "missing_ratings": build.n_missing_ratings,
        "seed": options.seed,
        "verdict": validation_summary(build),
        "warnings": build.findings,
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
        "half_widths_95": adjective.ratings.iter().map(|average| average.half_width).collect::<Vec<_>>(),
        "icc_single": icc(|a| [a.single.value, a.single.low, a.single.high]),
        "icc_mean": icc(|a| [a.average.value, a.average.low, a.average.high]),
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
            "at": [build.positions[i].rough_smooth, build.positions[i].hard_soft],
            "felt": [first.felt[i], second.felt[i]],
            "felt_deviation": build.stability.as_ref().map(|stability| stability.deviations[i]),
            "predicted": of_both(&|prediction| prediction.predicted[i]),
            "nested_predicted": of_both(&|prediction| prediction.validation.predicted[i]),
            "perceptual": build.perceptual.points[i],
        })
    };
    build.textures.iter().enumerate().map(position).collect()
}

/// Returns the figures that are common in papers, each with a short name for files.
pub fn space_figures(build: &SpaceBuild) -> Vec<(&'static str, Figure)> {
    let figures = [
        stress(build),
        perceptual(build),
        correlations(build),
        adjectives(build),
        predicted(build, &build.axes[0]),
        predicted(build, &build.axes[1]),
        authoring(build),
        shepard(build),
    ];
    let mut figures: Vec<(&'static str, Figure)> = FIGURES.into_iter().zip(figures).collect();
    for (name, figure) in &mut figures {
        figure.set_source(build.source.label());
        if *name == "authoring-space" && build.place_source() != build.source {
            figure.set_source(&format!("{} from {}", build.place_source().label(), build.source.label()));
        }
    }
    figures
}

/// A one-line description of the data behind all figures.
pub fn space_subtitle(build: &SpaceBuild) -> String {
    format!(
        "{} textures, {}: {} sorters, {} raters, seed {}; {} from {}, feature selection {}",
        build.textures.len(),
        build.source.label(),
        build.similarity.agreements.len(),
        build.raters.len(),
        build.options.seed,
        match placed_by(build) {
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

fn series(name: &str, mark: Mark, tone: Tone, points: Vec<Point>) -> Series {
    Series { name: name.to_owned(), mark, tone, points }
}

fn chart(title: String, [x_label, y_label]: [&str; 2], is_isotropic: bool, series: Vec<Series>) -> Figure {
    Figure::Chart(Chart {
        title,
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        is_isotropic,
        x_scale: Scale::Linear,
        shown: None,
        series,
        source: String::new(),
    })
}

fn stress(build: &SpaceBuild) -> Figure {
    let last = build.stress.len() as f64;
    let limit = |stress: f64| {
        let ends = vec![Point::new(1.0, stress), Point::new(last, stress)];
        series(kruskal_word(stress), Mark::Segments, Tone::Faint, ends)
    };
    let by_dims: Vec<Point> = (1..).zip(&build.stress).map(|(d, s)| Point::new(f64::from(d), *s)).collect();
    let chosen = Point::named(
        build.options.n_dims as f64,
        build.perceptual.stress,
        format!("{:.3}", build.perceptual.stress),
    );
    // Kruskal's words do not apply to the stress of interval scaling.
    let limits = match build.options.mds.transform {
        Transform::PrimaryTies | Transform::SecondaryTies => vec![limit(0.1), limit(0.05)],
        Transform::Interval => Vec::new(),
    };
    chart(
        "Stress over number of dimensions".to_owned(),
        ["dimensions", "stress-1"],
        false,
        limits
            .into_iter()
            .chain([
                series("stress", Mark::Line, Tone::Main, by_dims),
                series("chosen", Mark::Dots, Tone::Second, vec![chosen]),
            ])
            .collect(),
    )
}

fn perceptual(build: &SpaceBuild) -> Figure {
    let points = &build.perceptual.points;
    let reach = points.iter().flat_map(|p| [p[0].abs(), p[1].abs()]).fold(0.0, f64::max);
    let mut all = Vec::new();
    for (index, adjective) in build.adjectives.iter().enumerate() {
        let Ok(line) = &adjective.line else { continue };
        let end = |sign: f64, pole: &str| {
            // Scaled to the extent of the textures.
            let length = 0.9 * sign * line.r_squared * reach;
            Point::named(length * line.direction[0], length * line.direction[1], pole)
        };
        let is_axis = build.axes.iter().any(|axis| axis.adjective == index);
        let tone = if is_axis { Tone::Second } else { Tone::Third };
        let ends = vec![end(-1.0, &adjective.pair.low), end(1.0, &adjective.pair.high)];
        all.push(series(&adjective.pair.name(), Mark::Segments, tone, ends));
    }
    let dots =
        build.textures.iter().zip(points).map(|(id, point)| Point::named(point[0], point[1], id)).collect();
    all.push(series("textures", Mark::Dots, Tone::Main, dots));
    chart(
        format!("Perceptual space, stress {:.3}; line length is R²", build.perceptual.stress),
        ["dimension 1", "dimension 2"],
        true,
        all,
    )
}

fn correlations(build: &SpaceBuild) -> Figure {
    let n_dims = build.options.n_dims;
    let row = |adjective: &Adjective| {
        let line = adjective.line.as_ref().ok();
        let icc = adjective.agreement.as_ref().ok().map(|agreement| agreement.average.value);
        let of_dims = (0..n_dims).map(|d| line.and_then(|line| line.correlations[d]));
        (adjective.pair.name(), of_dims.chain([line.map(|line| line.r_squared), icc]).collect())
    };
    let dims = (1..=n_dims).map(|d| format!("dim. {d}"));
    Figure::Table(Table {
        title: "Adjectives and dimensions: correlation, R², rater agreement (ICC)".to_owned(),
        columns: dims.chain(["R²".to_owned(), "ICC(2,k)".to_owned()]).collect(),
        rows: build.adjectives.iter().map(row).collect(),
        decimals: 3,
        source: String::new(),
    })
}

fn adjectives(build: &SpaceBuild) -> Figure {
    let rated_on_all: Vec<usize> = (0..build.textures.len())
        .filter(|texture| build.adjectives.iter().all(|a| a.ratings[*texture].mean.is_some()))
        .collect();
    let columns: Vec<Vec<f64>> = build
        .adjectives
        .iter()
        .map(|a| rated_on_all.iter().filter_map(|texture| a.ratings[*texture].mean).collect())
        .collect();
    let names: Vec<String> = build.adjectives.iter().map(|a| a.pair.name()).collect();
    Figure::Table(Table {
        title: "Correlation of mean ratings between adjectives".to_owned(),
        columns: names.clone(),
        rows: names.into_iter().zip(correlation_table(&columns, &columns)).collect(),
        decimals: 2,
        source: String::new(),
    })
}

fn predicted(build: &SpaceBuild, axis: &Axis) -> Figure {
    let (mut dots, mut seen) = (Vec::new(), Vec::new());
    let mut title = format!("{}: not predicted, too few textures", axis.pair);
    if let Some(Prediction { validation: v, predicted, .. }) = &axis.prediction {
        let named = build.textures.iter().enumerate();
        dots = named.map(|(i, id)| Point::named(axis.felt[i], v.predicted[i], id)).collect();
        seen = axis.felt.iter().zip(predicted).map(|(felt, p)| Point::new(*felt, *p)).collect();
        let chance = v.permutation_p.map_or_else(String::new, |p| format!(", p = {p:.3}"));
        title = format!(
            "{}: nested cross-validation r {:.2}{chance}; r {:.2} with features selected on all textures",
            axis.pair, v.nested_cv_r, v.cv_r
        );
    }
    chart(
        title,
        ["perceptual position, 0 to 100", "predicted position, 0 to 100"],
        false,
        vec![
            series("identity", Mark::Line, Tone::Faint, vec![Point::new(0.0, 0.0), Point::new(100.0, 100.0)]),
            series("training fit", Mark::Dots, Tone::Faint, seen),
            series("nested cross-validation", Mark::Dots, Tone::Main, dots),
        ],
    )
}

fn authoring(build: &SpaceBuild) -> Figure {
    let at = |i: usize| {
        let place = build.positions[i];
        Point::new(place.rough_smooth, place.hard_soft)
    };
    let edges = build.space.triangles().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[usize; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    let dots = build.textures.iter().enumerate().map(|(i, id)| Point::named(at(i).x, at(i).y, id)).collect();
    let hull: Vec<Point> = build.space.hull().flat_map(|edge| edge.map(at)).collect();
    let [first, second] = build.axes.each_ref().map(|axis| axis.pair.to_string());
    chart(
        "Authoring space".to_owned(),
        [&format!("{first}, 0 to 100"), &format!("{second}, 0 to 100")],
        true,
        vec![
            series("triangles", Mark::Segments, Tone::Faint, edges.into_iter().flatten().map(at).collect()),
            series("convex hull", Mark::Segments, Tone::Third, hull),
            series("textures", Mark::Dots, Tone::Main, dots),
        ],
    )
}

fn shepard(build: &SpaceBuild) -> Figure {
    let pairs = &build.shepard;
    let distances = pairs.iter().map(|p| Point::new(p.dissimilarity, p.distance)).collect();
    let mut disparities: Vec<Point> =
        pairs.iter().map(|p| Point::new(p.dissimilarity, p.disparity)).collect();
    disparities.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    chart(
        "Shepard diagram".to_owned(),
        ["dissimilarity, 0 to 100", "distance"],
        false,
        vec![
            series("pairs", Mark::Dots, Tone::Faint, distances),
            series("disparities", Mark::Line, Tone::Main, disparities),
        ],
    )
}
