//! Figures of a space: those that are common in papers, and the mean ratings on each adjective pair.

use shagreen_core::people::mds::Transform;
use shagreen_core::people::property::correlation_table;
use shagreen_core::space::space_build::{
    Adjective, Axis, PerceptualSpace, Prediction, SpaceBuild, few_judges, kruskal_word,
};

use crate::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};

/// Names of the figures that every space has, in order.
const FIGURES: [&str; 9] = [
    "stress",
    "perceptual-space",
    "correlations",
    "adjectives",
    "predicted-1",
    "predicted-2",
    "authoring-space",
    "shepard",
    "components",
];

/// First part of the names of the figures of mean ratings; the number of the adjective pair follows, from 1.
pub const RATING_FIGURE: &str = "mean-ratings-";

/// Maximum number of figures of mean ratings.
const MAX_RATING_FIGURES: usize = 50;

/// Why a figure is empty.
const NO_SORTS: &str = "empty, because there are no sorts";

/// Returns the names of the figures of a space with ratings on this number of adjective pairs, in order. Of many pairs, the
/// first fifty have a figure of their mean ratings.
pub fn figure_names(n_pairs: usize) -> Vec<String> {
    let of_ratings = (1..=n_pairs.min(MAX_RATING_FIGURES)).map(|number| format!("{RATING_FIGURE}{number}"));
    FIGURES.into_iter().map(str::to_owned).chain(of_ratings).collect()
}

/// Returns the figures, each with a short name for files; the names are those of [`figure_names`]. A figure that needs sorts
/// has a title that says so if there are none.
pub fn space_figures(build: &SpaceBuild) -> Vec<(String, Figure)> {
    let space = build.perceptual.as_ref();
    let figures = [
        space.map_or_else(|| empty("Stress over number of dimensions"), |space| stress(build, space)),
        space.map_or_else(|| empty("Perceptual space"), |space| perceptual(build, space)),
        if space.is_some() { correlations(build) } else { reliabilities(build) },
        adjectives(build),
        predicted(build, &build.axes[0]),
        predicted(build, &build.axes[1]),
        authoring(build),
        space.map_or_else(|| empty("Shepard diagram"), shepard),
        components(build),
    ];
    let of_ratings = build.adjectives.iter().take(MAX_RATING_FIGURES);
    let all = figures.into_iter().chain(of_ratings.map(|adjective| mean_ratings(build, adjective)));
    let mut figures: Vec<(String, Figure)> =
        figure_names(build.adjectives.len()).into_iter().zip(all).collect();
    let few = if few_judges(build).is_some() { ", few participants" } else { "" };
    for (name, figure) in &mut figures {
        figure.set_source(&format!("{}{few}", build.source.label()));
        if name.as_str() == "authoring-space" && build.place_source() != build.source {
            let (places, judgments) = (build.place_source().label(), build.source.label());
            figure.set_source(&format!("{places} from {judgments}{few}"));
        }
    }
    figures
}

/// A chart without data, whose title says why.
fn empty(title: &str) -> Figure {
    chart(format!("{title}: {NO_SORTS}"), ["", ""], false, Vec::new())
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

fn stress(build: &SpaceBuild, space: &PerceptualSpace) -> Figure {
    let last = space.stress.len() as f64;
    let limit = |stress: f64| {
        let ends = vec![Point::new(1.0, stress), Point::new(last, stress)];
        series(kruskal_word(stress), Mark::Segments, Tone::Faint, ends)
    };
    let by_dims: Vec<Point> = (1..).zip(&space.stress).map(|(d, s)| Point::new(f64::from(d), *s)).collect();
    let chosen = Point::named(
        build.options.n_dims as f64,
        space.configuration.stress,
        format!("{:.3}", space.configuration.stress),
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

fn perceptual(build: &SpaceBuild, space: &PerceptualSpace) -> Figure {
    let points = &space.configuration.points;
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
        format!("Perceptual space, stress {:.3}; line length is R²", space.configuration.stress),
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
        n_counts: 0,
        source: String::new(),
    })
}

/// Agreement of the raters on each pair, without sorts.
fn reliabilities(build: &SpaceBuild) -> Figure {
    let row = |adjective: &Adjective| {
        let agreement = adjective.agreement.as_ref().ok();
        let values = agreement.map(|of| [of.alpha.value, of.average.value, of.single.value]);
        (adjective.pair.name(), (0..3).map(|i| values.map(|values| values[i])).collect())
    };
    Figure::Table(Table {
        title: "Rater agreement; the correlations with dimensions need sorts, and there are none".to_owned(),
        columns: ["alpha", "ICC(2,k)", "ICC(2,1)"].map(str::to_owned).to_vec(),
        rows: build.adjectives.iter().map(row).collect(),
        decimals: 3,
        n_counts: 0,
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
        n_counts: 0,
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
        let spread = v.nested_cv_r_deviation.map_or_else(String::new, |spread| format!(" ± {spread:.2}"));
        title = format!(
            "{}: nested cross-validation r {:.2}{spread}{chance}; r {:.2} with features selected on all textures",
            axis.pair, v.nested_cv_r, v.cv_r
        );
    }
    chart(
        title,
        [
            if build.perceptual.is_some() {
                "perceptual position, 0 to 100"
            } else {
                "mean rating, 0 to 100"
            },
            "predicted position, 0 to 100",
        ],
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
        Point::new(place.x(), place.y())
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

fn shepard(space: &PerceptualSpace) -> Figure {
    let pairs = &space.shepard;
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

/// Eigenvalues of the mean ratings, and those of random ratings.
fn components(build: &SpaceBuild) -> Figure {
    let found = match &build.components {
        Ok(found) => found,
        Err(reason) => {
            let title = format!("Principal components of the mean ratings: empty, because {reason}");
            return chart(title, ["component", "eigenvalue"], false, Vec::new());
        }
    };
    let points = |values: &[f64]| -> Vec<Point> {
        (1..).zip(values).map(|(component, value)| Point::new(f64::from(component), *value)).collect()
    };
    let eigenvalues = points(&found.eigenvalues);
    let dots: Vec<Point> = (eigenvalues.iter().zip(&found.explained))
        .map(|(point, share)| Point::named(point.x, point.y, format!("{:.0} %", 100.0 * share)))
        .collect();
    let word = if found.n_dims == 1 { "dimension" } else { "dimensions" };
    chart(
        format!(
            "Principal components of the mean ratings: {} {word} by parallel analysis; labels are explained variance",
            found.n_dims
        ),
        ["component", "eigenvalue"],
        false,
        vec![
            series(
                "95th percentile of random ratings",
                Mark::Line,
                Tone::Faint,
                points(&found.random_eigenvalues),
            ),
            series("mean ratings", Mark::Line, Tone::Main, eigenvalues),
            series("mean ratings", Mark::Dots, Tone::Main, dots),
        ],
    )
}

/// Mean rating of each texture on a pair, with its confidence interval, in ascending order.
fn mean_ratings(build: &SpaceBuild, adjective: &Adjective) -> Figure {
    let pair = &adjective.pair;
    let mut means: Vec<(f64, Option<f64>, &str)> = adjective
        .rated()
        .map(|(texture, mean)| {
            (mean, adjective.ratings[texture].half_width, build.textures[texture].as_str())
        })
        .collect();
    means.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(b.2)));
    let (mut dots, mut intervals) = (Vec::new(), Vec::new());
    for (place, (mean, half_width, id)) in (1..).zip(means) {
        let x = f64::from(place);
        dots.push(Point::named(x, mean, id));
        if let Some(half_width) = half_width {
            intervals.extend([Point::new(x, mean - half_width), Point::new(x, mean + half_width)]);
        }
    }
    let ends = intervals.iter().map(|point: &Point| point.y);
    let (low, high) = ends.fold((0.0_f64, 100.0_f64), |(low, high), y| (low.min(y), high.max(y)));
    let width = dots.len() as f64 + 1.0;
    let mut all = Vec::new();
    if !intervals.is_empty() {
        all.push(series("95 % confidence interval", Mark::Segments, Tone::Third, intervals));
    }
    all.push(series("mean rating", Mark::Dots, Tone::Main, dots));
    Figure::Chart(Chart {
        title: format!(
            "{pair}: mean ratings of {} raters, with 95 % confidence intervals",
            build.raters.len()
        ),
        x_label: "texture, in order of the mean rating".to_owned(),
        y_label: format!("{} (0) to {} (100)", pair.low, pair.high),
        is_isotropic: false,
        x_scale: Scale::Linear,
        shown: Some([(0.0, width), (low - 2.0, high + 2.0)]),
        series: all,
        source: String::new(),
    })
}
