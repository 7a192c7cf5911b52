//! Positions between two anchors, as simulated participants perceive them.
//!
//! The expected position of a stimulus is that of the nearest point of the line through both anchors, as a percentage of the
//! way from the low anchor to the high one. Beyond an anchor, it is that of the anchor.

use std::collections::BTreeMap;

use crate::people::study::plan::{Design, Part};
use crate::people::study::simulated::World;

impl World {
    /// Expected positions of the stimuli of a part between its anchors, 0 (low) to 100 (high); `None` if the part has another
    /// design.
    ///
    /// They are the answers of participants without noise and guesses. With noise, they are the means of the answers, except
    /// near the ends, where the scale cuts the noise off.
    pub fn positions_between_anchors(&self, part: &Part) -> Option<BTreeMap<String, f64>> {
        let Design::Anchors { stimuli, low, high } = &part.design else { return None };
        let place =
            |stimulus: &String| (stimulus.clone(), self.position_between(self.position(stimulus), low, high));
        Some(stimuli.iter().map(place).collect())
    }

    /// Position of a perception between two stimuli, 0 to 100.
    pub(super) fn position_between(&self, at: &[f64], low: &str, high: &str) -> f64 {
        100.0 * share_between(at, self.position(low), self.position(high))
    }
}

/// Share of the way from `low` to `high` at which a point is, 0 to 1; 0.5 if the ends coincide.
fn share_between(at: &[f64], low: &[f64], high: &[f64]) -> f64 {
    let along = |from: &[f64], to: &[f64]| -> f64 {
        let steps = low.iter().zip(high).map(|(low, high)| high - low);
        steps.zip(from.iter().zip(to)).map(|(step, (from, to))| step * (to - from)).sum()
    };
    let whole = along(low, high);
    if whole > 0.0 { (along(low, at) / whole).clamp(0.0, 1.0) } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::share_between;
    use crate::maths::statistics::mean;
    use crate::people::study::answer::Response;
    use crate::people::study::plan::Design;
    use crate::people::study::schedule::trials;
    use crate::people::study::simulated::{Observers, SimulatedParticipant, World};
    use crate::people::study::test_plans::{ids, part, plan_of, rating};
    use crate::people::study::trial::Task;

    #[test]
    fn a_share_is_that_of_the_nearest_point_of_the_line() {
        let (low, high) = ([10.0, 10.0], [50.0, 40.0]);
        // 20 of 50 points along the line, and 10 points beside it.
        let beside = [10.0 + 20.0 * 0.8 - 10.0 * 0.6, 10.0 + 20.0 * 0.6 + 10.0 * 0.8];
        assert!((share_between(&beside, &low, &high) - 0.4).abs() < 1e-12);
        assert_eq!([low, high].map(|end| share_between(&end, &low, &high)), [0.0, 1.0]);
        assert_eq!([[0.0, 0.0], [90.0, 90.0]].map(|end| share_between(&end, &low, &high)), [0.0, 1.0]);
        assert_eq!(share_between(&beside, &low, &low), 0.5);
    }

    /// With noise in the anchors too, the mean for cork would be 31.1, because a line between two wrong places has another
    /// length and direction.
    #[test]
    fn the_mean_answer_is_the_expected_position() {
        const N: usize = 40_000;
        let (low, high) = ("brick".to_owned(), "denim".to_owned());
        let plan =
            plan_of(vec![part("a", Design::Anchors { stimuli: ids(&["cork", "felt", "glass"]), low, high })]);
        let mut world = World::invented(&plan, 3);
        for (id, at) in [
            ("brick", [30.0, 40.0]),
            ("denim", [70.0, 40.0]),
            ("cork", [42.0, 90.0]),
            ("felt", [50.0, 10.0]),
            ("glass", [58.0, 40.0]),
        ] {
            world.positions.insert(id.to_owned(), at.to_vec());
        }
        let expected = world.positions_between_anchors(&plan.parts[0]).unwrap();
        assert!((expected["cork"] - 30.0).abs() < 1e-9 && (expected["glass"] - 70.0).abs() < 1e-9);
        let observers = Observers { noise_points: 4.0, ..Observers::exact() };
        let mut participant = SimulatedParticipant::new(&plan, &world, observers, 1, 1).unwrap();
        for trial in trials(&plan, &plan.parts[0], 1) {
            let Task::Place { stimulus, .. } = &trial.task else { panic!("{trial:?}") };
            let mut answer = || match participant.respond(&trial) {
                Response::Sliders(values) => values[0],
                other => panic!("{other:?}"),
            };
            let found = mean(&(0..N).map(|_| answer()).collect::<Vec<_>>());
            // Four standard errors: the noise is 10 points of this scale, three deviations from its ends.
            let error = 4.0 * 10.0 / (N as f64).sqrt();
            assert!((found - expected[stimulus]).abs() < error, "{stimulus}: {found} ± {error}");
        }
        assert!(world.positions_between_anchors(&part("b", rating())).is_none());
    }
}
