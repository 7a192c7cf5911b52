//! What is not as it should be in judgments and in what they were scaled to, in sentences.

use std::collections::{BTreeMap, BTreeSet};

use crate::mds::{Mds, Ties};
use crate::ratings::{RaterFit, RatingTable};
use crate::selection::MIN_TEXTURES;
use crate::sorting::{Finding, Similarity, Sort};
use crate::space::SpacePoint;
use crate::space_build::verdict::least_textures;
use crate::space_build::{Axis, SpaceData};
use crate::words::counted;

/// Findings of one kind that are said one by one before the rest is counted.
const N_SAID: usize = 3;

/// Participants below whom a perceptual space is mostly chance.
const MIN_SORTERS: usize = 5;

/// Lines that meet at less than this, or nearly half a turn, are one, in degrees.
const ONE_LINE_DEGREES: f64 = 20.0;

/// Distance in points of 100 below which two textures cannot be told apart in the space.
const COINCIDENT: f64 = 0.5;

/// Share of the largest distance that half of all pairs have to exceed in a space that has not collapsed.
const COLLAPSED: f64 = 0.05;

/// What is odd about who took part and how they sorted; `unsorted` are the textures that nobody sorted.
pub(super) fn of_sorting(
    data: &SpaceData<'_>,
    similarity: &Similarity,
    table: &RatingTable,
    unsorted: &[&str],
    ties: Ties,
) -> Vec<String> {
    let mut said = sort_findings(&similarity.findings);
    said.extend(participation(data, table));
    if !unsorted.is_empty() {
        said.push(format!("not sorted, and so without a place: {}", unsorted.join(", ")));
    }
    let n_sorters = similarity.agreements.len();
    if n_sorters < MIN_SORTERS {
        let advice = match ties {
            Ties::Primary => "; secondary ties suit so few better",
            Ties::Secondary => "",
        };
        said.push(format!(
            "only {n_sorters} sorted: most dissimilarities are equal, so the perceptual space depends on chance however low its stress is; ten participants are usual{advice}"
        ));
    }
    if n_sorters > 1 && all_sorted_alike(&data.sorts) {
        said.push(
            "all participants sorted exactly alike: that says nothing of what others would do".to_owned(),
        );
    }
    said
}

/// What is odd about who rated and what is missing.
pub(super) fn of_ratings(raters: &[(String, RaterFit)], table: &RatingTable) -> Vec<String> {
    let outlying: Vec<&str> =
        raters.iter().filter(|(_, fit)| fit.outlying).map(|(name, _)| name.as_str()).collect();
    let mut said = Vec::new();
    if !outlying.is_empty() {
        said.push(format!("rated unlike the others, and kept: {}", outlying.join(", ")));
    }
    if table.n_missing() > 0 {
        let missing = counted(table.n_missing(), "rating");
        said.push(format!("missing: {missing}; averages are over those who rated"));
    }
    said
}

/// What is odd about the axes and their predictions.
pub(super) fn of_axes(axes: &[Axis; 2], angle_degrees: f64) -> Vec<String> {
    let mut said = Vec::new();
    if !(ONE_LINE_DEGREES..=180.0 - ONE_LINE_DEGREES).contains(&angle_degrees) {
        said.push(format!(
            "{} and {} are nearly one line in the perceptual space ({angle_degrees:.1}°): choose another axis",
            axes[0].pair, axes[1].pair
        ));
    }
    if axes.iter().any(|axis| axis.prediction.is_none()) {
        said.push(format!(
            "{} textures are too few to say what predicts an axis: {MIN_TEXTURES} are the least, 25 are usual",
            axes[0].felt.len()
        ));
    }
    said
}

/// What is to be known of textures at one place.
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
        "{} and {}{more} lie at one place, closer than {COINCIDENT} points: a point there is one or the other of them",
        textures[i], textures[j]
    ))
}

/// The findings of sorts; of many of one kind the first.
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
    said.extend(rest.map(|(name, n)| format!("{name}: {} more such sorts", n - N_SAID)));
    said
}

/// Who did one part and not the other, and which sorts leave textures out.
fn participation(data: &SpaceData<'_>, table: &RatingTable) -> Vec<String> {
    let sorters: BTreeSet<&str> = data.sorts.iter().map(|sort| sort.participant.as_str()).collect();
    let raters: BTreeSet<&str> = table.participants().iter().map(String::as_str).collect();
    let mut said = Vec::new();
    if sorters.is_disjoint(&raters) {
        said.push(
            "nobody both sorted and rated: two groups of people, or names that were written in two ways"
                .to_owned(),
        );
    } else {
        for (did, only) in [
            ("sorted, but rated nothing", &sorters - &raters),
            ("rated, but sorted nothing", &raters - &sorters),
        ] {
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
            "{} of {} leave textures out, as that of {} (trial {}), {}",
            lacking.len(),
            counted(data.sorts.len(), "sort"),
            first.participant,
            first.trial,
            counted(n, "texture")
        ));
    }
    said
}

/// Whether every participant made the same groups in the same trials.
fn all_sorted_alike(sorts: &[Sort]) -> bool {
    /// Groups without their labels.
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

/// What is odd about the perceptual space.
pub(super) fn of_scaling(perceptual: &Mds, n_dims: usize) -> Vec<String> {
    let (points, mut said) = (&perceptual.points, Vec::new());
    if points.len() < least_textures(n_dims) {
        said.push(format!(
            "{} are few for {n_dims} dimensions: stress is low whatever was sorted, and says nothing below {}",
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
        said.push("the perceptual space was still moving when its steps ran out: allow more".to_owned());
    }
    let is_collapsed =
        distances.last().is_some_and(|largest| distances[distances.len() / 2] < COLLAPSED * largest);
    if is_collapsed {
        said.push(
            "most textures fell together in the perceptual space, far from one or a few: its stress and lines mean nothing; take secondary ties, or more participants"
                .to_owned(),
        );
    }
    said
}
