//! Warnings about irregular judgments and perceptual spaces, as sentences.

use std::collections::{BTreeMap, BTreeSet};

use crate::people::mds::{Mds, Transform};
use crate::people::ratings::{OUTLIER_LIMIT, REVERSED_LIMIT, RaterFit, RatingTable};
use crate::people::sorting::{Finding, Similarity, Sort};
use crate::space::SpacePoint;
use crate::space::selection::MIN_TEXTURES;
use crate::space::space_build::axis_choice::{RELIABLE_ALPHA, is_reliable};
use crate::space::space_build::validation::{DEPENDENT_R, MIN_RATERS, MIN_SORTERS, least_textures};
use crate::space::space_build::{Adjective, Axis, DegenerateScaling, SpaceData, SpaceOptions};
use crate::words::{counted, listed};

/// Maximum number of findings of one kind that are listed; the others are only counted.
const N_SAID: usize = 3;

/// Angle in degrees from 0 or 180 below which two directions count as parallel.
const ONE_LINE_DEGREES: f64 = 20.0;

/// Distance, in points of 100, below which two textures count as coincident.
const COINCIDENT: f64 = 0.5;

/// Minimum median distance relative to the largest distance; a smaller value indicates a collapsed space.
const COLLAPSED: f64 = 0.05;

/// Whether textures without judgments need a warning: if they are fewer than the judged ones. Otherwise the experiment was about a
/// part of the library, and the number of textures in the space says so.
pub(super) fn are_missed(n_left_out: usize, n_judged: usize) -> bool {
    n_left_out > 0 && n_left_out < n_judged
}

/// Warnings about the participants and their sorts; `unsorted` are the textures that nobody sorted.
pub(super) fn of_sorting(
    data: &SpaceData<'_>,
    similarity: &Similarity,
    table: &RatingTable,
    unsorted: &[&str],
    transform: Transform,
) -> Vec<String> {
    let mut said = sort_findings(&similarity.findings);
    said.extend(participation(data, table));
    // Those that were rated have a warning of their own.
    let left_out: Vec<&str> =
        unsorted.iter().copied().filter(|name| !table.textures().iter().any(|of| of == name)).collect();
    if are_missed(left_out.len(), similarity.textures.len()) {
        said.push(format!("not sorted, so without a position: {}", left_out.join(", ")));
    }
    let n_sorters = similarity.agreements.len();
    if n_sorters < MIN_SORTERS {
        let advice = match transform {
            Transform::PrimaryTies => "; with so few participants, use secondary ties",
            Transform::SecondaryTies | Transform::Interval => "",
        };
        said.push(format!(
            "only {} sorted the textures: most dissimilarities are tied, so the perceptual space depends on chance even if its stress is low; ten participants are usual{advice}",
            counted(n_sorters, "participant")
        ));
    }
    if n_sorters > 1 && all_sorted_alike(&data.sorts) {
        said.push(
            "all participants made identical sorts: nothing is known about the variation between participants".to_owned(),
        );
    }
    said
}

/// Warnings about raters and missing ratings.
pub(super) fn of_ratings(raters: &[(String, RaterFit)], table: &RatingTable) -> Vec<String> {
    let outlying: Vec<String> = raters
        .iter()
        .filter(|(_, fit)| fit.outlying)
        .map(|(name, fit)| match fit.correlation {
            Some(correlation) => format!("{name} ({correlation:.2})"),
            None => name.clone(),
        })
        .collect();
    let mut said = Vec::new();
    if !outlying.is_empty() {
        said.push(format!(
            "ratings: outlying participants, whose correlation with the mean of the others is below {OUTLIER_LIMIT} (not excluded): {}",
            outlying.join(", ")
        ));
    }
    if table.n_missing() > 0 {
        let missing = counted(table.n_missing(), "rating");
        said.push(format!("missing: {missing}; averages use only the ratings given"));
    }
    let on_pairs = |of: fn(&RaterFit) -> &Vec<usize>| -> Vec<String> {
        let with_some = raters.iter().filter(|(_, fit)| !of(fit).is_empty());
        with_some
            .map(|(name, fit)| {
                let pairs: Vec<String> =
                    of(fit).iter().map(|pair| table.pairs()[*pair].to_string()).collect();
                format!("{name} ({})", listed(&pairs))
            })
            .collect()
    };
    let constant = on_pairs(|fit| &fit.constant_pairs);
    if !constant.is_empty() {
        said.push(format!(
            "ratings: participants who gave all textures the same rating on a pair (not excluded): {}",
            listed(&constant)
        ));
    }
    let reversed = on_pairs(|fit| &fit.reversed_pairs);
    if !reversed.is_empty() {
        said.push(format!(
            "ratings: participants whose correlation with the mean of the others on a pair is below {REVERSED_LIMIT}, as with swapped poles (not corrected; check the table): {}",
            listed(&reversed)
        ));
    }
    said
}

/// Warning about two directions that are nearly parallel.
pub(super) fn of_angle(axes: &[Axis; 2], angle_degrees: f64) -> Option<String> {
    let is_oblique = !(ONE_LINE_DEGREES..=180.0 - ONE_LINE_DEGREES).contains(&angle_degrees);
    is_oblique.then(|| {
        format!(
            "{} and {} are nearly parallel in the perceptual space ({angle_degrees:.1}°); choose another axis",
            axes[0].pair, axes[1].pair
        )
    })
}

/// Warning about axes that are not predicted.
pub(super) fn of_prediction(axes: &[Axis; 2]) -> Option<String> {
    axes.iter().any(|axis| axis.prediction.is_none()).then(|| {
        format!(
            "{} textures are too few to predict an axis from features; use at least {MIN_TEXTURES}, preferably 25",
            axes[0].felt.len()
        )
    })
}

/// Warnings about positions that are mean ratings; `not_placed` are the textures whose missing position needs a warning.
pub(super) fn of_mean_ratings(
    axes: &[Axis; 2],
    adjectives: &[Adjective],
    axis_correlation: Option<f64>,
    n_raters: usize,
    not_placed: &[String],
) -> Vec<String> {
    let mut said = Vec::new();
    if n_raters == 1 {
        said.push(
            "only one participant rated: neither the agreement between raters nor the standard errors of the positions are known; ten participants are usual".to_owned(),
        );
    } else if n_raters < MIN_RATERS {
        said.push(format!(
            "only {n_raters} participants rated: the standard errors of the positions are uncertain; ten participants are usual"
        ));
    }
    if !not_placed.is_empty() {
        said.push(format!("not rated on both axes, so without a position: {}", not_placed.join(", ")));
    }
    for axis in axes {
        let adjective = &adjectives[axis.adjective];
        let alpha = adjective.agreement.as_ref().ok().map(|agreement| agreement.alpha.value);
        if let Some(alpha) = alpha.filter(|_| !is_reliable(adjective)) {
            said.push(format!(
                "{}: the mean ratings are unreliable (Cronbach's alpha {alpha:.2}, below {RELIABLE_ALPHA}), so positions on this axis depend on who rated",
                axis.pair
            ));
        }
        let n_single = adjective.ratings.iter().filter(|average| average.n_raters == 1).count();
        if n_single > 0 && n_raters > 1 {
            said.push(format!(
                "{}: {} with a single rating, so without a standard error",
                axis.pair,
                counted(n_single, "texture")
            ));
        }
    }
    if let Some(r) = axis_correlation.filter(|r| r.abs() >= DEPENDENT_R) {
        said.push(format!(
            "{} and {} correlate with r = {r:.2}, so they measure nearly the same; choose another axis",
            axes[0].pair, axes[1].pair
        ));
    }
    said
}

/// Warning about textures with nearly the same position.
pub(super) fn of_places(textures: &[String], positions: &[SpacePoint]) -> Option<String> {
    let pairs = (0..textures.len()).flat_map(|i| (i + 1..textures.len()).map(move |j| (i, j)));
    let same: Vec<(usize, usize)> =
        pairs.filter(|(i, j)| positions[*i].distance(positions[*j]) < COINCIDENT).collect();
    let (i, j) = *same.first()?;
    let more = match same.len() {
        1 => String::new(),
        n => format!(" (and {})", counted(n - 1, "more pair")),
    };
    Some(format!(
        "{} and {}{more} have nearly the same position (distance below {COINCIDENT} points): mode field averages such textures, and the other modes change from one to the other within this distance",
        textures[i], textures[j]
    ))
}

/// Findings about the sorts. Of each kind, the first few are listed and the others counted.
fn sort_findings(findings: &[Finding]) -> Vec<String> {
    let mut said = Vec::new();
    let mut n_of: BTreeMap<&str, usize> = BTreeMap::new();
    for finding in findings {
        let n = n_of.entry(finding.name()).or_default();
        *n += 1;
        if *n <= N_SAID {
            said.push(finding.to_string());
        }
    }
    let rest = n_of.into_iter().filter(|(_, n)| *n > N_SAID);
    said.extend(rest.map(|(name, n)| format!("{name}: {}", counted(n - N_SAID, "more case"))));
    said
}

/// Warnings about participants who only sorted or only rated, and about sorts that omit textures.
fn participation(data: &SpaceData<'_>, table: &RatingTable) -> Vec<String> {
    let sorters: BTreeSet<&str> = data.sorts.iter().map(|sort| sort.participant.as_str()).collect();
    let raters: BTreeSet<&str> = table.participants().iter().map(String::as_str).collect();
    let mut said = Vec::new();
    if sorters.is_disjoint(&raters) {
        said.push(
            "no participant both sorted and rated: either these are two groups of people, or the tables spell names differently"
                .to_owned(),
        );
    } else {
        for (did, only) in
            [("sorted but did not rate", &sorters - &raters), ("rated but did not sort", &raters - &sorters)]
        {
            if !only.is_empty() {
                said.push(format!("{did}: {}", only.into_iter().collect::<Vec<_>>().join(", ")));
            }
        }
    }
    let textures: BTreeSet<&str> =
        data.sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| p.texture.as_str())).collect();
    let lacking: Vec<&Sort> =
        data.sorts.iter().filter(|sort| sort.placements.len() < textures.len()).collect();
    if let Some(first) = lacking.first() {
        let n = textures.len() - first.placements.len();
        said.push(format!(
            "sorts that omit textures: {} of {}; for example, the sort of {} (trial {}) omits {}",
            lacking.len(),
            data.sorts.len(),
            first.participant,
            first.trial,
            counted(n, "texture")
        ));
    }
    said
}

/// Whether every participant made the same groups in the same trials.
fn all_sorted_alike(sorts: &[Sort]) -> bool {
    /// Groups of a sort, without their labels.
    fn parts(sort: &Sort) -> BTreeSet<BTreeSet<&str>> {
        let mut groups: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for placement in &sort.placements {
            groups.entry(&placement.group).or_default().insert(&placement.texture);
        }
        groups.into_values().collect()
    }
    let mut by_participant: BTreeMap<&str, BTreeSet<BTreeSet<BTreeSet<&str>>>> = BTreeMap::new();
    for sort in sorts {
        by_participant.entry(&sort.participant).or_default().insert(parts(sort));
    }
    let mut all = by_participant.into_values();
    let first = all.next();
    all.all(|other| first.as_ref() == Some(&other))
}

/// Warning about a degenerate solution.
pub(super) fn of_degenerate(degenerate: &DegenerateScaling) -> String {
    let DegenerateScaling { transform, signs, is_replaced, is_flat } = degenerate;
    let name = match transform {
        Transform::PrimaryTies => "primary ties",
        Transform::SecondaryTies => "secondary ties",
        Transform::Interval => "interval scaling",
    };
    let why = if signs.n_coincident > 0 {
        format!(
            "{} of textures at the same point, with dissimilarities of up to {:.0} of 100",
            counted(signs.n_coincident, "pair"),
            signs.largest_coincident
        )
    } else if signs.n_steps == 1 {
        "all distances are equal, although the dissimilarities differ".to_owned()
    } else {
        format!(
            "only {} different dissimilarities for {}, which very different positions fit",
            signs.n_levels,
            counted(signs.n_pairs, "pair")
        )
    };
    if *is_replaced {
        format!(
            "{name} gave a degenerate solution ({why}), whose stress of nearly 0 has no meaning; interval scaling was used instead"
        )
    } else {
        // The usual remedy has been tried.
        let remedy = if *is_flat {
            "interval scaling was tried, but it puts all textures into fewer dimensions; use sorts into more groups, or more participants"
        } else {
            "use interval scaling, or sorts into more groups"
        };
        format!(
            "{name} gave a degenerate solution ({why}): its stress of nearly 0 has no meaning, and its positions are unreliable; {remedy}"
        )
    }
}

/// Warnings about the perceptual space.
pub(super) fn of_scaling(perceptual: &Mds, options: &SpaceOptions) -> Vec<String> {
    let (points, n_dims, mut said) = (&perceptual.points, options.n_dims, Vec::new());
    if points.len() < least_textures(n_dims) {
        said.push(format!(
            "{} are too few for {n_dims} dimensions: with fewer than {}, stress is low for any data and has no meaning",
            counted(points.len(), "texture"),
            least_textures(n_dims)
        ));
    }
    let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let distance = |(i, j): (usize, usize)| {
        points[i].iter().zip(&points[j]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let mut distances: Vec<f64> = pairs.map(distance).collect();
    distances.sort_by(f64::total_cmp);
    if !perceptual.converged {
        said.push(
            "multidimensional scaling did not converge: the stress may not be the lowest possible; try another seed"
                .to_owned(),
        );
    }
    let is_collapsed =
        distances.last().is_some_and(|largest| distances[distances.len() / 2] < COLLAPSED * largest);
    if is_collapsed {
        let remedy = match options.mds.transform {
            Transform::PrimaryTies | Transform::SecondaryTies => "interval scaling or more participants",
            Transform::Interval => "more participants, or leave out the textures that lie apart",
        };
        said.push(format!(
            "the perceptual space has collapsed: most textures coincide, far from one or a few others, so stress and adjective directions have no meaning; use {remedy}"
        ));
    }
    said
}
