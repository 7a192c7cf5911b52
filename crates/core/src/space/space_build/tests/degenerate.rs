//! Degenerate solutions of the perceptual space, and the source of predicted positions.

use super::{N, build, judgments, models, quick};
use crate::people::mds::{Degeneracy, Transform};
use crate::people::sorting::{Grouped, Sort};
use crate::space::LabelSource;
use crate::space::space_build::warnings::of_degenerate;
use crate::space::space_build::{
    DegenerateScaling, FeatureKind, PlacedBy, SpaceOptions, stress_in_words, stress_of_random_data,
    validation_summary,
};

/// Sorts of twelve textures by twelve participants, who agree on three clusters and disagree within them: each puts
/// some textures aside, and moves a few to the next cluster.
fn sorts_into_clusters() -> Vec<Sort> {
    let names: Vec<String> = models().into_iter().map(|(name, _)| name).take(12).collect();
    let group = |participant: usize, i: usize| {
        let choice = 7 * i + 11 * participant + (i * participant) % 5;
        match (choice % 6, choice % 23) {
            (0, _) => format!("aside {i}"),
            (_, 1) => format!("{}", (i / 4 + 1) % 3),
            _ => format!("{}", i / 4),
        }
    };
    let sort = |participant: usize| Sort {
        participant: format!("simulated-{:02}", participant + 1),
        trial: "1".to_owned(),
        n_groups: None,
        placements: names
            .iter()
            .enumerate()
            .map(|(i, texture)| Grouped { texture: texture.clone(), group: group(participant, i) })
            .collect(),
    };
    (0..12).map(sort).collect()
}

#[test]
fn a_degenerate_solution_is_replaced_and_never_called_nearly_perfect() {
    let (_, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let built = |transform: Option<Transform>| {
        let options = SpaceOptions {
            transform,
            features: FeatureKind::Physical,
            n_permutations: 0,
            n_draws: 4,
            ..quick()
        };
        build((sorts_into_clusters(), ratings.clone()), &options).unwrap()
    };
    let stated = built(Some(Transform::PrimaryTies));
    let space = stated.perceptual.as_ref().unwrap();
    let signs = space.degenerate.filter(|degenerate| !degenerate.is_replaced).unwrap().signs;
    assert!(signs.n_coincident > 0 && space.configuration.stress < 0.01, "{signs:?}");
    let said = validation_summary(&stated).join("\n");
    assert!(said.contains("not meaningful, because the solution is degenerate"), "{said}");
    assert!(!said.contains("nearly perfect") && stress_in_words(&stated).is_none(), "{said}");
    let findings = stated.findings.join("\n");
    assert!(findings.contains("primary ties gave a degenerate solution ("), "{findings}");
    assert!(findings.contains("unreliable; use interval scaling, or sorts into more groups"), "{findings}");

    let replaced = built(None);
    let space = replaced.perceptual.as_ref().unwrap();
    assert!(space.degenerate.is_some_and(|degenerate| degenerate.is_replaced));
    assert_eq!(replaced.options.mds.transform, Transform::Interval);
    let said = validation_summary(&replaced).join("\n");
    assert!(said.contains("from interval scaling, to which Kruskal's criteria do not apply"), "{said}");
    assert!(replaced.findings.join("\n").contains("interval scaling was used instead"));
    assert_eq!(stress_of_random_data(&replaced), None);
    // Only the most similar textures may coincide.
    let lowest = space.shepard[0].dissimilarity;
    let different = space.shepard.iter().filter(|pair| pair.dissimilarity > lowest);
    let nearest = different.map(|pair| pair.distance).fold(f64::INFINITY, f64::min);
    let farthest = space.shepard.iter().map(|pair| pair.distance).fold(0.0, f64::max);
    assert!(nearest > 1e-3 * farthest, "{nearest} of {farthest}");
}

#[test]
fn a_remedy_that_was_tried_is_not_advised() {
    let signs =
        Degeneracy { n_coincident: 3, largest_coincident: 40.0, n_steps: 2, n_levels: 9, n_pairs: 15 };
    let tried =
        DegenerateScaling { transform: Transform::PrimaryTies, signs, is_replaced: false, is_flat: true };
    let said = of_degenerate(&tried);
    assert!(said.contains("interval scaling was tried") && !said.contains("use interval scaling"), "{said}");
    let said = of_degenerate(&DegenerateScaling { is_flat: false, ..tried });
    assert!(said.contains("use interval scaling"), "{said}");
}

#[test]
fn a_good_solution_stays_nonmetric_and_its_stress_has_a_word() {
    let built = build(judgments(&["rough-smooth", "hard-soft"]), &quick()).unwrap();
    let degenerate = built.perceptual.as_ref().unwrap().degenerate;
    assert_eq!((degenerate, built.options.mds.transform), (None, Transform::PrimaryTies));
    let stated = SpaceOptions { transform: Some(Transform::PrimaryTies), ..quick() };
    assert_eq!(
        build(judgments(&["rough-smooth", "hard-soft"]), &stated).unwrap().perceptual,
        built.perceptual
    );
    assert!(!built.findings.join("\n").contains("degenerate"));
    let said = validation_summary(&built).join("\n");
    assert_eq!(N, 14, "the number of textures for the stress of random dissimilarities");
    let expected =
        "by Kruskal's criteria (random dissimilarities without ties give about 0.25; with ties, less)";
    assert!(said.contains(expected), "{said}");
    assert!(stress_of_random_data(&built).is_some());
}

#[test]
fn positions_that_features_predict_from_human_ratings_are_estimates() {
    let mut built = build(judgments(&["rough-smooth", "hard-soft"]), &quick()).unwrap();
    for (source, placed_by, expected) in [
        (LabelSource::HumanRatings, [PlacedBy::Felt, PlacedBy::Felt], LabelSource::HumanRatings),
        (LabelSource::HumanRatings, [PlacedBy::Felt, PlacedBy::Predicted], LabelSource::Estimated),
        (LabelSource::SimulatedRaters, [PlacedBy::Predicted; 2], LabelSource::SimulatedRaters),
    ] {
        built.source = source;
        for (axis, placed_by) in built.axes.iter_mut().zip(placed_by) {
            axis.placed_by = placed_by;
        }
        assert_eq!(built.place_source(), expected, "{source:?}, {placed_by:?}");
    }
}
