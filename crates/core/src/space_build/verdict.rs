//! How far a space can be believed, in sentences.

use crate::space::LabelSource;
use crate::space_build::{Axis, PlacedBy, SpaceBuild, TRUSTED_NESTED_R};
use crate::words::counted;

/// Goodness of fit of an adjective's line below which it is called weak: less than half of what was rated lies along it.
const WEAK_R_SQUARED: f64 = 0.5;
/// Deviation from a right angle from which axes are called oblique, in degrees.
const OBLIQUE_DEGREES: f64 = 15.0;
/// Intraclass correlation of the mean rater below which agreement is called poor (Koo and Li 2016).
const POOR_ICC: f64 = 0.5;
/// Chance from which a line or a prediction may be luck.
const CHANCE: f64 = 0.05;

/// What Kruskal (1964) calls a stress-1. He has words for 0, 0.025, 0.05, 0.1 and 0.2; here each reaches halfway to the
/// next, so that his are given back at his values.
pub fn kruskal_word(stress: f64) -> &'static str {
    match stress {
        s if s < 0.0125 => "nearly perfect",
        s if s < 0.0375 => "excellent",
        s if s < 0.075 => "good",
        s if s < 0.15 => "fair",
        _ => "poor",
    }
}

/// Fewest textures of which stress says anything (Kruskal and Wish 1978: four times the dimensions, and one).
pub(super) fn least_textures(n_dims: usize) -> usize {
    4 * n_dims + 1
}

/// Sentences on how far the space can be believed, the most general first. What is not as it should be is said by
/// [`SpaceBuild::findings`].
pub fn verdict(build: &SpaceBuild) -> Vec<String> {
    let mut said = vec![
        format!(
            "{}, from {}{}.",
            counted(build.textures.len(), "texture"),
            build.source.label(),
            if build.source == LabelSource::SimulatedRaters { ": nobody felt anything" } else { "" }
        ),
        format!(
            "Stress of the {}-dimensional perceptual space: {:.3}, {}.",
            build.options.n_dims,
            build.perceptual.stress,
            if build.textures.len() < least_textures(build.options.n_dims) {
                "which says nothing with so few textures".to_owned()
            } else {
                format!("{} after Kruskal", kruskal_word(build.perceptual.stress))
            }
        ),
        angle(build),
    ];
    for axis in &build.axes {
        said.extend(line(build, axis));
        said.extend(prediction(axis));
    }
    said.extend(stability(build));
    said.extend(build.axes.iter().map(|axis| place(axis, build.options.placement.is_none())));
    said
}

/// What places on an axis are, and why, if that was not asked for.
fn place(axis: &Axis, is_chosen_here: bool) -> String {
    let pair = &axis.pair;
    let place = match axis.placed_by {
        PlacedBy::Felt => "where they were felt",
        PlacedBy::Predicted => "where their features predict, by models that have seen them",
    };
    let nested_r = axis.prediction.as_ref().map(|prediction| prediction.validation.nested_cv_r);
    let why = match (is_chosen_here, nested_r) {
        (false, _) => String::new(),
        (true, None) => ", since nothing predicts them".to_owned(),
        (true, Some(r)) => {
            let side = if axis.placed_by == PlacedBy::Predicted { "not below" } else { "below" };
            format!(", since the nested r of predictions, {r:.3}, is {side} {TRUSTED_NESTED_R}")
        }
    };
    format!("Along {pair} textures lie {place}{why}.")
}

fn angle(build: &SpaceBuild) -> String {
    let names = build.axes.each_ref().map(|axis| axis.pair.to_string());
    let degrees = build.angle_degrees;
    let meets = format!("{} and {} meet at {degrees:.1}° in the perceptual space", names[0], names[1]);
    if build.options.is_orthogonal {
        format!("{meets}; the second axis was turned at right angles to the first.")
    } else if (degrees - 90.0).abs() > OBLIQUE_DEGREES {
        format!("{meets}: they are not independent, and the square shows them as if they were.")
    } else {
        format!("{meets}.")
    }
}

/// How well the line of an axis fits, and how far its raters agree.
fn line(build: &SpaceBuild, axis: &Axis) -> Option<String> {
    let adjective = &build.adjectives[axis.adjective];
    let line = adjective.line.as_ref().ok()?;
    let weak = if line.r_squared < WEAK_R_SQUARED { ", a weak line" } else { "" };
    let agreement = adjective.agreement.as_ref().map_or_else(
        |reason| format!("agreement of raters is not known ({reason})"),
        |agreement| {
            let icc = agreement.average.value;
            let poor = if icc < POOR_ICC { ", poor" } else { "" };
            format!("ICC of the mean rater {icc:.2}{poor}")
        },
    );
    let luck = if line.p_value >= CHANCE {
        format!(
            " (p = {:.2}: it may be luck, and then places along it mean little, however well they are predicted)",
            line.p_value
        )
    } else {
        String::new()
    };
    Some(format!("{}: R² {:.2} in the perceptual space{weak}{luck}; {agreement}.", axis.pair, line.r_squared))
}

/// How far places hang on who took part.
fn stability(build: &SpaceBuild) -> Option<String> {
    let stability = build.stability.as_ref()?;
    let loose = |[first, second]: &[f64; 2]| first.hypot(*second);
    let mut by_deviation: Vec<(&String, f64)> =
        build.textures.iter().zip(stability.deviations.iter().map(loose)).collect();
    by_deviation.sort_by(|a, b| b.1.total_cmp(&a.1));
    let least: Vec<&str> = by_deviation.iter().take(3).map(|(id, _)| id.as_str()).collect();
    let failed = match stability.n_failed {
        0 => String::new(),
        n => format!("; {} made no space", counted(n, "more draw")),
    };
    Some(format!(
        "With participants drawn anew, {} times, the places where textures were felt move by {:.1} points of 100 along {} and {:.1} along {} (standard deviation), most of all {}; the angle by {:.0}°{failed}.",
        stability.n_draws,
        stability.typical[0],
        build.axes[0].pair,
        stability.typical[1],
        build.axes[1].pair,
        least.join(", "),
        stability.angle_deviation_degrees,
    ))
}

/// What the prediction of an axis is worth: the published figure never without the one that counts.
fn prediction(axis: &Axis) -> Option<String> {
    let prediction = axis.prediction.as_ref()?;
    let v = &prediction.validation;
    let chance = v.permutation_p.map_or_else(
        || "no null distribution was asked for".to_owned(),
        |p| {
            let luck = if p >= CHANCE { ": may be luck" } else { "" };
            format!("p = {p:.3} over {} permutations{luck}", v.n_permutations)
        },
    );
    Some(format!(
        "{}: predicted from {}, nested cross-validation r {:.2} (accuracy {:.1} %, where guessing the mean has {:.1} %; {chance}). Plain correlation: nested {:.2}, with features chosen on all textures, as is usually published, {:.2} ({:.1} %).",
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
