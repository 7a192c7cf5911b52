//! Stimuli at the ends of a dimension: the anchors of a scale, and the references of dissimilarities.
//!
//! Participants judge all other stimuli by these two, which a plan chooses because they differ most. At random positions, they
//! could be alike, and nothing would lie between them.

use crate::people::study::plan::{Comparison, Design, Part, Plan, Source};

/// Coordinates of the two ends on their dimension, in points; random positions lie between them.
const LOW_POINTS: f64 = 5.0;
const HIGH_POINTS: f64 = 95.0;
/// Coordinate of the ends on every other dimension, in points.
const MIDDLE_POINTS: f64 = 50.0;

/// Positions of the textures and profiles that are ends. Those of the first part are the ends of the first dimension, and so
/// on; a texture that is an end in several parts keeps its first position.
pub(super) fn positions_at_ends(plan: &Plan, n_dimensions: usize) -> Vec<(&Source, Vec<f64>)> {
    let mut positions: Vec<(&Source, Vec<f64>)> = Vec::new();
    for (index, ends) in plan.parts.iter().filter_map(ends_of).enumerate() {
        for (id, end) in ends.into_iter().zip([LOW_POINTS, HIGH_POINTS]) {
            let Some(stimulus) = plan.stimulus(id) else { continue };
            if positions.iter().any(|(source, _)| **source == stimulus.source) {
                continue;
            }
            let mut position = vec![MIDDLE_POINTS; n_dimensions];
            if let Some(coordinate) = position.get_mut(index % n_dimensions.max(1)) {
                *coordinate = end;
            }
            positions.push((&stimulus.source, position));
        }
    }
    positions
}

/// Identifiers of the two stimuli by which participants judge the others, if a part has such.
fn ends_of(part: &Part) -> Option<[&str; 2]> {
    match &part.design {
        Design::Anchors { low, high, .. } => Some([low.as_str(), high.as_str()]),
        Design::Dissimilarity { reference: Some(Comparison { first, second }), .. } => {
            Some([first.as_str(), second.as_str()])
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{HIGH_POINTS, LOW_POINTS, MIDDLE_POINTS};
    use crate::people::study::plan::Design;
    use crate::people::study::simulated::World;
    use crate::people::study::test_plans::{all_designs, ids, part, plan_of};

    /// The anchors of this plan are the references of its dissimilarities too.
    #[test]
    fn anchors_and_references_lie_at_the_ends_and_other_textures_between_them() {
        for seed in 1..=20 {
            let world = World::invented(&all_designs(), seed);
            assert_eq!(world.positions["brick"], [LOW_POINTS, MIDDLE_POINTS]);
            assert_eq!(world.positions["denim"], [HIGH_POINTS, MIDDLE_POINTS]);
            for id in ["cork", "felt", "glass"] {
                assert!((LOW_POINTS..HIGH_POINTS).contains(&world.positions[id][0]), "{id}, seed {seed}");
            }
        }
    }

    #[test]
    fn each_part_has_a_dimension_and_a_texture_keeps_its_first_position() {
        let anchors = |low: &str, high: &str| Design::Anchors {
            stimuli: ids(&["felt"]),
            low: low.to_owned(),
            high: high.to_owned(),
        };
        let plan = plan_of(vec![part("a", anchors("cork", "glass")), part("b", anchors("brick", "cork"))]);
        let world = World::invented(&plan, 3);
        assert_eq!(world.positions["cork"], [LOW_POINTS, MIDDLE_POINTS]);
        assert_eq!(world.positions["glass"], [HIGH_POINTS, MIDDLE_POINTS]);
        assert_eq!(world.positions["brick"], [MIDDLE_POINTS, LOW_POINTS]);
        // All others are where they would be without anchors.
        let without = World::invented(&plan_of(Vec::new()), 3);
        assert_eq!(world.positions["felt"], without.positions["felt"]);
        assert_eq!(world.positions["denim"], without.positions["denim"]);
        assert_ne!(world.positions["cork"], without.positions["cork"]);
    }
}
