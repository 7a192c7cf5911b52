//! Simulated worlds in which the compared things differ by a stated amount.

use shagreen_core::people::study::plan::{Design, Plan, Stimulus, Variant};
use shagreen_core::people::study::simulated::World;

/// The world with mean grades of the conditions of a questionnaire at equal distances, in the order of the plan: the last is
/// `points` of a scale of 0 to 100 above the first, and the middle of the scale lies between them.
pub(super) fn with_conditions(mut world: World, plan: &Plan, points: f64) -> World {
    for part in &plan.parts {
        let Design::Likert { conditions, .. } = &part.design else { continue };
        let n_steps = conditions.len().saturating_sub(1).max(1) as f64;
        for (index, condition) in conditions.iter().enumerate() {
            let share = 0.5 + 0.01 * points * (index as f64 / n_steps - 0.5);
            world.conditions.insert(condition.id.clone(), share);
        }
    }
    world
}

/// The world with this effect, in points: on each dimension, the textures and profiles span so many points around 50; each
/// version of one lies so far from its original; and the conditions of a questionnaire differ by so much.
pub(super) fn with_effect(mut world: World, plan: &Plan, points: f64) -> World {
    let before = world.positions.clone();
    let originals: Vec<&Stimulus> =
        plan.stimuli.iter().filter(|stimulus| stimulus.variant == Variant::Original).collect();
    for dimension in 0..world.dimensions.len() {
        let coordinates = || originals.iter().filter_map(|of| before.get(&of.id)?.get(dimension));
        let lowest = coordinates().copied().fold(f64::INFINITY, f64::min);
        let highest = coordinates().copied().fold(f64::NEG_INFINITY, f64::max);
        // A single texture stays where it is.
        let factor = if highest > lowest { points / (highest - lowest) } else { 1.0 };
        let middle = if highest > lowest { 0.5 * (lowest + highest) } else { 50.0 };
        for original in &originals {
            let at = world.positions.get_mut(&original.id).and_then(|position| position.get_mut(dimension));
            if let Some(at) = at {
                *at = 50.0 + factor * (*at - middle);
            }
        }
    }
    for version in plan.stimuli.iter().filter(|stimulus| stimulus.variant != Variant::Original) {
        let Some(original) = originals.iter().find(|of| of.source == version.source) else { continue };
        let (Some(home), Some(old_home), Some(old)) =
            (world.positions.get(&original.id), before.get(&original.id), before.get(&version.id))
        else {
            continue;
        };
        let offset: Vec<f64> = old.iter().zip(old_home).map(|(old, home)| old - home).collect();
        let length = offset.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        let at = home.iter().zip(&offset).map(|(home, x)| home + points * x / length).collect();
        world.positions.insert(version.id.clone(), at);
    }
    with_conditions(world, plan, points)
}
