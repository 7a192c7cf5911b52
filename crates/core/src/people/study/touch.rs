//! Whether a participant has touched what a trial asks about.
//!
//! An answer about a texture that was started, but never stroked, says nothing about it. A part can therefore require a
//! distance of motion over each stimulus before the trial can be answered.

use crate::people::study::plan::{Design, Part};
use crate::people::study::trial::Task;

/// What a participant has felt of one stimulus of a trial so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Felt {
    /// Distance that the tip moved in contact while the stimulus played, in m.
    pub distance_m: f64,
    /// Whether the participant can still feel it: it plays or can be started, and the participant moves the tip. Otherwise
    /// no touch is required, so that every trial can be answered.
    pub can_be_felt: bool,
}

/// Number of stimuli that are touched in a trial: those of [`Task::shown`], both sides of a detection, or the texture of a
/// question.
pub fn n_touched(task: &Task) -> usize {
    match task {
        Task::Detect { .. } => 2,
        Task::Question { .. } => 1,
        task => task.shown().len(),
    }
}

/// Whether the tip moves by itself over the stimuli of a part: those of same-different trials with a set time follow each other.
pub fn is_passive(part: &Part) -> bool {
    matches!(part.design, Design::SameDifferent { .. }) && part.timing.stimulus_secs.is_some()
}

/// Distance in mm that the tip must move over each stimulus of a part; `None` if no touch is required, or if the tip moves by
/// itself.
pub fn required_mm(part: &Part) -> Option<f64> {
    part.touch_mm.filter(|_| !is_passive(part))
}

/// Stimuli that must still be touched before a trial of this part can be answered, as indices of `felt`; none if it can be
/// answered. `felt` has an entry for each stimulus of the trial ([`n_touched`]).
pub fn untouched(part: &Part, felt: &[Felt]) -> Vec<usize> {
    let Some(least_mm) = required_mm(part) else { return Vec::new() };
    let least_m = 1e-3 * least_mm;
    let is_untouched =
        |felt: &Felt| felt.can_be_felt && (felt.distance_m < least_m || felt.distance_m.is_nan());
    felt.iter().enumerate().filter(|(_, felt)| is_untouched(felt)).map(|(index, _)| index).collect()
}

#[cfg(test)]
mod tests {
    use super::{Felt, is_passive, n_touched, required_mm, untouched};
    use crate::people::study::plan::{Comparison, Design, Part, Timing};
    use crate::people::study::test_plans::{all_designs, part, rating};
    use crate::people::study::trial::{Side, Task};

    fn felt(millimeters: f64, can_be_felt: bool) -> Felt {
        Felt { distance_m: 1e-3 * millimeters, can_be_felt }
    }

    #[test]
    fn every_stimulus_needs_the_distance_of_the_part() {
        let part = Part { touch_mm: Some(20.0), ..part("a", rating()) };
        assert_eq!(untouched(&part, &[felt(0.0, true), felt(20.0, true), felt(19.9, true)]), [0, 2]);
        assert!(untouched(&part, &[felt(25.0, true), felt(80.0, true)]).is_empty());
        assert!(untouched(&part, &[]).is_empty());
        assert_eq!(untouched(&part, &[felt(f64::NAN, true)]), [0]);
    }

    /// A stimulus that cannot be started again must not block the session.
    #[test]
    fn what_cannot_be_felt_any_more_is_not_required() {
        let part = Part { touch_mm: Some(20.0), ..part("a", rating()) };
        assert!(untouched(&part, &[felt(0.0, false), felt(30.0, true)]).is_empty());
    }

    #[test]
    fn a_part_can_require_no_touch() {
        let part = Part { touch_mm: None, ..part("a", rating()) };
        assert!(untouched(&part, &[felt(0.0, true)]).is_empty());
    }

    /// Nobody can stroke farther than the tip moves by itself.
    #[test]
    fn a_succession_requires_no_touch() {
        let is_it = |part: &Part| matches!(part.design, Design::SameDifferent { .. });
        let same_different = all_designs().parts.into_iter().find(is_it).unwrap();
        let free = Part { touch_mm: Some(20.0), timing: Timing::default(), ..same_different };
        assert_eq!((is_passive(&free), required_mm(&free)), (false, Some(20.0)));
        assert_eq!(untouched(&free, &[felt(0.0, true)]), [0]);
        let timing = Timing { stimulus_secs: Some(0.8), ..Timing::default() };
        let timed = Part { timing, ..free };
        assert_eq!((is_passive(&timed), required_mm(&timed)), (true, None));
        assert!(untouched(&timed, &[felt(0.0, true)]).is_empty());
    }

    #[test]
    fn the_sides_of_a_detection_are_two_and_a_question_has_one_texture() {
        let detect = Task::Detect { track: 0, level: 1.0, target: Side::First, has_feedback: false };
        let question = Task::Question { prompt: 0, condition: "a".to_owned() };
        let matched = Task::Match { pair: Comparison::new("a", "b"), is_swapped: false, x: Side::First };
        assert_eq!([&detect, &question, &matched].map(n_touched), [2, 1, 3]);
    }
}
