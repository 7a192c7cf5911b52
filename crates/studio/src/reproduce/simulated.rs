//! Answers of simulated participants to the built-in plans of studies.

use std::sync::Arc;

use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Plan, Source, Stimulus, Variant};
use shagreen_core::people::study::simulated::{World, simulated_study};
use shagreen_core::words::counted;
use shagreen_formats::library::Library;

use crate::study::plans::template;
use crate::study::simulation::Simulation;

/// The built-in plan with this identifier, and the answers of simulated participants. They say nothing about people.
///
/// With a library, the participants perceive its textures at their positions, and versions of a texture as far from it as in an
/// invented world. Otherwise all positions are invented.
pub(super) fn simulated_answers(
    id: &str,
    n_participants: usize,
    library: Option<&Library>,
    seed: u64,
) -> anyhow::Result<(Arc<Plan>, Vec<Record>)> {
    let plan = template(id)?.study.plan;
    let simulation = Simulation::usual(n_participants, seed);
    let mut world = simulation.world(&plan);
    if let Some(library) = library {
        world = placed(&world, &plan, library);
    }
    let records = simulated_study(&plan, &world, &simulation.observers, n_participants, seed)?;
    Ok((plan, records))
}

/// A world in which the textures of a library are at their positions.
fn placed(invented: &World, plan: &Plan, library: &Library) -> World {
    let mut world = invented.clone();
    for stimulus in &plan.stimuli {
        let Source::Texture(name) = &stimulus.source else { continue };
        let is_original = |of: &&Stimulus| of.source == stimulus.source && of.variant == Variant::Original;
        let original = plan.stimuli.iter().find(is_original).unwrap_or(stimulus);
        let at = library.index_of(name).and_then(|index| library.textures[index].at());
        let offsets = invented.positions.get(&stimulus.id).zip(invented.positions.get(&original.id));
        if let (Some(at), Some((own, home))) = (at, offsets)
            && at.n_axes() == own.len()
        {
            let moved = |((at, own), home): ((&f64, &f64), &f64)| at + own - home;
            let position = at.coordinates().iter().zip(own).zip(home).map(moved).collect();
            world.positions.insert(stimulus.id.clone(), position);
        }
    }
    world
}

/// Number of simulated participants, in words.
pub(super) fn simulated_participants(n: usize) -> String {
    counted(n, "SIMULATED participant")
}

#[cfg(test)]
mod tests {
    use super::placed;
    use crate::study::plans::template;
    use crate::study::simulation::Simulation;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn textures_are_at_their_positions_and_versions_near_them() {
        let library = starter_library().unwrap();
        let plan = template("authored-dissimilarity").unwrap().study.plan;
        let invented = Simulation::usual(1, 1).world(&plan);
        let world = placed(&invented, &plan, &library);
        let cork = library.textures[library.index_of("cork").unwrap()].at().unwrap();
        for (found, expected) in world.positions["cork"].iter().zip(cork.coordinates()) {
            assert!((found - expected).abs() < 1e-9);
        }
        let offset =
            |of: &[f64]| of.iter().zip(cork.coordinates()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        // As far as in an invented world.
        assert!((offset(&world.positions["cork-authored"]) - 6.0).abs() < 1e-9);
        assert_eq!(world.positions.len(), invented.positions.len());
    }
}
