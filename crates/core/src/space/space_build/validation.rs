//! Validation summary of a space, as sentences.

use crate::maths::statistics::mean;
use crate::people::mds::{Transform, expected_random_stress};
use crate::people::ratings::{Agreement, IntraclassCorrelation};
use crate::space::LabelSource;
use crate::space::space_build::{Axis, PerceptualSpace, PlacedBy, SpaceBuild, TRUSTED_NESTED_R};
use crate::words::counted;

/// R² of an adjective's line below which the fit is called weak: it explains less than half of the variance of the
/// ratings.
const WEAK_R_SQUARED: f64 = 0.5;
/// Deviation from a right angle, in degrees, above which the axes are called oblique.
const OBLIQUE_DEGREES: f64 = 15.0;
/// ICC of the mean rating below which agreement is called poor (Koo and Li 2016).
const POOR_ICC: f64 = 0.5;
/// Correlation of the mean ratings on two axes at or above which they are called dependent: they share half of their
/// variance.
pub(super) const DEPENDENT_R: f64 = 0.7;
/// Number of principal components whose variance is stated.
const N_SHARES: usize = 3;
/// p-value at or above which a line or a prediction is called not significant.
const CHANCE: f64 = 0.05;

/// Minimum number of sorters; with fewer, the perceptual space depends mostly on chance.
pub(super) const MIN_SORTERS: usize = 5;

/// Minimum number of raters; with fewer, a standard error has less than four degrees of freedom.
pub(super) const MIN_RATERS: usize = 5;

/// Kruskal's (1964) word for a stress-1 value. He gives words for 0, 0.025, 0.05, 0.1 and 0.2; the boundaries here lie
/// halfway between these values.
pub fn kruskal_word(stress: f64) -> &'static str {
    match stress {
        s if s < 0.0125 => "nearly perfect",
        s if s < 0.0375 => "excellent",
        s if s < 0.075 => "good",
        s if s < 0.15 => "fair",
        _ => "poor",
    }
}

/// Minimum number of textures for a meaningful stress (Kruskal and Wish 1978): four times the dimensions plus one.
pub(super) fn least_textures(n_dims: usize) -> usize {
    4 * n_dims + 1
}

/// Validation summary of a space, most general sentences first. Warnings about irregularities are in
/// [`SpaceBuild::findings`].
pub fn validation_summary(build: &SpaceBuild) -> Vec<String> {
    let mut said = vec![format!(
        "{}; source of the judgments: {}{}.",
        counted(build.textures.len(), "texture"),
        build.source.label(),
        if build.source == LabelSource::SimulatedRaters { "; no person felt the textures" } else { "" }
    )];
    said.extend(few_judges(build).map(|few| format!("{few}.")));
    match &build.perceptual {
        Some(space) => said.extend([stress(build, space), angle(build, space)]),
        None => said.extend([ratings_alone(build), correlation(build)]),
    }
    said.push(components(build));
    for axis in &build.axes {
        said.extend(line(build, axis));
        said.extend(prediction(axis));
    }
    said.extend(stability(build));
    said.extend(errors(build));
    said.extend(build.axes.iter().map(|axis| place(build, axis)));
    said
}

/// Warning that the judgments come from few participants, so that every result depends on who took part; `None` from five
/// sorters and raters on. It belongs beside every figure.
pub fn few_judges(build: &SpaceBuild) -> Option<String> {
    let n_raters = build.raters.len();
    let mut few = Vec::new();
    if let Some(space) = &build.perceptual {
        let n_sorters = space.similarity.agreements.len();
        few.extend((n_sorters < MIN_SORTERS).then(|| format!("{n_sorters} sorted")));
    }
    few.extend((n_raters < MIN_RATERS).then(|| format!("{n_raters} rated")));
    (!few.is_empty()).then(|| {
        format!(
            "Few participants ({}): correlations and p-values describe these people alone. Ten are usual",
            few.join(", ")
        )
    })
}

/// Kruskal's word for the stress of a perceptual space; `None` if it does not apply: to a degenerate solution, to
/// interval scaling, to a stress that is low because few participants sorted, or without sorts.
pub fn stress_in_words(build: &SpaceBuild) -> Option<&'static str> {
    let space = build.perceptual.as_ref()?;
    let is_degenerate = space.degenerate.is_some_and(|degenerate| !degenerate.is_replaced);
    let is_metric = build.options.mds.transform == Transform::Interval;
    let word = kruskal_word(space.configuration.stress);
    let is_by_chance = space.similarity.agreements.len() < MIN_SORTERS && word == kruskal_word(0.0);
    (!is_degenerate && !is_metric && !is_by_chance).then_some(word)
}

/// Mean stress that random dissimilarities without ties give for as many textures and dimensions; with ties it is lower.
/// `None` outside the range of [`expected_random_stress`], for interval scaling, to which it does not apply, and without
/// sorts.
pub fn stress_of_random_data(build: &SpaceBuild) -> Option<f64> {
    build.perceptual.as_ref()?;
    match build.options.mds.transform {
        Transform::PrimaryTies | Transform::SecondaryTies => {
            expected_random_stress(build.textures.len(), build.options.n_dims)
        }
        Transform::Interval => None,
    }
}

/// Stress of the perceptual space, and the values to compare it with.
fn stress(build: &SpaceBuild, space: &PerceptualSpace) -> String {
    let (n_textures, n_dims) = (build.textures.len(), build.options.n_dims);
    let is_degenerate = space.degenerate.is_some_and(|degenerate| !degenerate.is_replaced);
    let meaning = match stress_in_words(build) {
        _ if n_textures < least_textures(n_dims) => "not meaningful with so few textures".to_owned(),
        Some(word) => match stress_of_random_data(build) {
            Some(random) => format!(
                "{word} by Kruskal's criteria (random dissimilarities without ties give about {random:.2}; with ties, less)"
            ),
            None => format!("{word} by Kruskal's criteria"),
        },
        None if is_degenerate => "not meaningful, because the solution is degenerate".to_owned(),
        None if build.options.mds.transform == Transform::Interval => {
            "from interval scaling, to which Kruskal's criteria do not apply".to_owned()
        }
        None => "not meaningful with so few participants".to_owned(),
    };
    format!(
        "Stress of the {n_dims}-dimensional perceptual space: {:.3}, {meaning}.",
        space.configuration.stress
    )
}

/// What a space from ratings alone consists of, and what it lacks.
fn ratings_alone(build: &SpaceBuild) -> String {
    format!(
        "Built from ratings alone, by {}: the perceived positions are mean ratings. There are no sorts, so there is no perceptual space, and the report lacks stress, adjective directions and their angle.",
        counted(build.raters.len(), "participant")
    )
}

/// Correlation of the mean ratings on the two axes.
fn correlation(build: &SpaceBuild) -> String {
    let names = build.axes.each_ref().map(|axis| axis.pair.to_string());
    match build.axis_correlation {
        Some(r) => {
            let are_dependent = r.abs() >= DEPENDENT_R;
            let meaning = if are_dependent {
                ": the axes are not independent, although the map draws them at a right angle"
            } else {
                ""
            };
            format!("The mean ratings on {} and {} correlate with r = {r:.2}{meaning}.", names[0], names[1])
        }
        None => format!("The correlation of the mean ratings on {} and {} is unknown.", names[0], names[1]),
    }
}

/// Variance that the principal components of the mean ratings explain, and their number.
fn components(build: &SpaceBuild) -> String {
    let found = match &build.components {
        Ok(found) => found,
        Err(reason) => return format!("No principal components of the mean ratings: {reason}."),
    };
    let shares: Vec<String> =
        found.explained.iter().take(N_SHARES).map(|share| format!("{:.0} %", 100.0 * share)).collect();
    format!(
        "The principal components of the mean ratings ({}, {}) explain {} of the variance, the largest first; parallel analysis finds {}.",
        counted(found.pairs.len(), "adjective pair"),
        counted(found.n_textures, "texture"),
        shares.join(", "),
        counted(found.n_dims, "dimension")
    )
}

/// Root mean square over the textures of the standard errors of the mean ratings on each axis, in points; `None` with
/// sorts, whose positions are projections, and if no texture has two raters.
pub fn position_errors(build: &SpaceBuild) -> Option<[f64; 2]> {
    if build.perceptual.is_some() {
        return None;
    }
    let [first, second] = build.axes.each_ref().map(|axis| {
        let ratings = &build.adjectives[axis.adjective].ratings;
        let squares: Vec<f64> =
            ratings.iter().filter_map(|average| average.standard_error).map(|error| error * error).collect();
        (!squares.is_empty()).then(|| mean(&squares).sqrt())
    });
    Some([first?, second?])
}

fn errors(build: &SpaceBuild) -> Option<String> {
    let [first, second] = position_errors(build)?;
    Some(format!(
        "Standard errors of the mean ratings: {first:.1} points of 100 on {} and {second:.1} on {} (root mean square over textures).",
        build.axes[0].pair, build.axes[1].pair
    ))
}

/// Kind of positions on an axis, and the reason if the choice was automatic.
fn place(build: &SpaceBuild, axis: &Axis) -> String {
    let pair = &axis.pair;
    let is_rated_alone = build.perceptual.is_none();
    let place = match axis.placed_by {
        PlacedBy::Felt if is_rated_alone => "mean ratings",
        PlacedBy::Felt => "perceived positions, computed from the judgments",
        PlacedBy::Predicted => "positions predicted from features, by models trained on the same textures",
    };
    let nested_r = axis.prediction.as_ref().map(|prediction| prediction.validation.nested_cv_r);
    let is_chosen_here = build.options.placement.is_none() && !is_rated_alone;
    let why = match (is_chosen_here, nested_r) {
        (false, _) => String::new(),
        (true, None) => ", because there is no prediction".to_owned(),
        (true, Some(r)) => {
            let side = if axis.placed_by == PlacedBy::Predicted { "at least" } else { "below" };
            format!(
                ", because the nested correlation of the prediction, {r:.3}, is {side} {TRUSTED_NESTED_R}, a rule of thumb"
            )
        }
    };
    format!("{pair}: {place}{why}.")
}

fn angle(build: &SpaceBuild, space: &PerceptualSpace) -> String {
    let names = build.axes.each_ref().map(|axis| axis.pair.to_string());
    let degrees = space.angle_degrees;
    let meets = format!(
        "The directions of {} and {} in the perceptual space form an angle of {degrees:.1}°",
        names[0], names[1]
    );
    if build.options.is_orthogonal {
        format!("{meets}; the second axis was made orthogonal to the first.")
    } else if (degrees - 90.0).abs() > OBLIQUE_DEGREES {
        format!("{meets}: the axes are not independent, although the map draws them at a right angle.")
    } else {
        format!("{meets}.")
    }
}

/// Fit of the mean ratings of an axis in the perceptual space, and agreement of the raters.
fn line(build: &SpaceBuild, axis: &Axis) -> Option<String> {
    let adjective = &build.adjectives[axis.adjective];
    if build.perceptual.is_none() {
        return Some(match &adjective.agreement {
            Ok(agreement) => reliability(axis, agreement),
            Err(reason) => format!("{}: inter-rater agreement is unknown ({reason}).", axis.pair),
        });
    }
    let line = adjective.line.as_ref().ok()?;
    let weak = if line.r_squared < WEAK_R_SQUARED { ", a weak fit" } else { "" };
    let agreement = adjective.agreement.as_ref().map_or_else(
        |reason| format!("inter-rater agreement is unknown ({reason})"),
        |agreement| {
            let icc = agreement.average.value;
            let poor = if icc < POOR_ICC { ", poor" } else { "" };
            format!(
                "inter-rater agreement (ICC of the mean rating) {icc:.2}{poor}, from {} and {} with complete ratings{}",
                counted(agreement.participants.len(), "rater"),
                counted(agreement.textures.len(), "texture"),
                incomplete(build, agreement)
            )
        },
    );
    let luck = if line.p_value >= CHANCE {
        format!(
            " (p = {:.2}, not significant: positions on this axis may have little meaning, however well they are predicted)",
            line.p_value
        )
    } else {
        String::new()
    };
    Some(format!(
        "{}: R² of the ratings in the perceptual space {:.2}{weak}{luck}; {agreement}.",
        axis.pair, line.r_squared
    ))
}

/// Half of a sentence if an agreement comes from a part of the ratings: those means have other reliabilities.
fn incomplete(build: &SpaceBuild, agreement: &Agreement) -> String {
    let all = [build.raters.len(), build.textures.len()];
    if agreement.participants.len() >= all[0] && agreement.textures.len() >= all[1] {
        return String::new();
    }
    format!(" of {} and {}; it does not apply to means over other numbers of raters", all[0], all[1])
}

/// Agreement of the raters on an axis, with intervals.
fn reliability(axis: &Axis, agreement: &Agreement) -> String {
    let interval = |of: &IntraclassCorrelation| {
        let limit = |value: f64| if value < 0.0 { "below 0".to_owned() } else { format!("{value:.2}") };
        format!("{} (95 % interval {} to {})", limit(of.value), limit(of.low), limit(of.high))
    };
    let poor = if agreement.average.value < POOR_ICC { ", poor" } else { "" };
    format!(
        "{}: Cronbach's alpha over {} and {} with complete ratings {}; absolute agreement (ICC of the mean rating) {}{poor}.",
        axis.pair,
        counted(agreement.participants.len(), "rater"),
        counted(agreement.textures.len(), "texture"),
        interval(&agreement.alpha),
        interval(&agreement.average),
    )
}

/// Bootstrap stability of the perceived positions.
fn stability(build: &SpaceBuild) -> Option<String> {
    let stability = build.stability.as_ref()?;
    let loose = |[first, second]: &[f64; 2]| first.hypot(*second);
    let mut by_deviation: Vec<(&String, f64)> =
        build.textures.iter().zip(stability.deviations.iter().map(loose)).collect();
    by_deviation.sort_by(|a, b| b.1.total_cmp(&a.1));
    let least: Vec<&str> = by_deviation.iter().take(3).map(|(id, _)| id.as_str()).collect();
    let failed = match stability.n_failed {
        0 => String::new(),
        n => format!("; {} yielded no space", counted(n, "more sample")),
    };
    Some(format!(
        "Bootstrap over participants ({} samples): the perceived positions have a standard deviation of {:.1} points of 100 on {} and {:.1} on {} (root mean square over textures; largest for {}). The angle between the two directions has a standard deviation of {:.0}°{failed}.",
        stability.n_draws,
        stability.typical[0],
        build.axes[0].pair,
        stability.typical[1],
        build.axes[1].pair,
        least.join(", "),
        stability.angle_deviation_degrees,
    ))
}

/// Validation of an axis prediction. The sentence always states the unbiased correlation together with the one that is
/// usually published.
fn prediction(axis: &Axis) -> Option<String> {
    let prediction = axis.prediction.as_ref()?;
    let v = &prediction.validation;
    let chance = v.permutation_p.map_or_else(
        || "no permutation test".to_owned(),
        |p| {
            let luck = if p >= CHANCE { ", not significant" } else { "" };
            format!("p = {p:.3} from {} permutations{luck}", v.n_permutations)
        },
    );
    let spread = v.nested_cv_r_deviation.map_or_else(String::new, |deviation| {
        format!(
            "standard deviation {deviation:.2} over {} assignments of the textures to folds; ",
            v.scheme.n_repeats
        )
    });
    Some(format!(
        "{}: predicted from {}; nested correlation {:.2} ({spread}{chance}). In nested cross-validation, the range-normalized accuracy is {:.1} % (predicting the mean gives {:.1} %) and the plain correlation {:.2}. With features selected on all textures, as usually published and biased upwards, the plain correlation is {:.2} and the accuracy {:.1} %.",
        axis.pair,
        counted(prediction.features.len(), "feature"),
        v.nested_cv_r,
        v.nested_cv_rms_percent,
        v.mean_rms_percent,
        v.nested_cv_plain_r,
        v.cv_r,
        v.cv_rms_percent
    ))
}
