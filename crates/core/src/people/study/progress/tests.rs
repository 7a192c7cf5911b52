use std::sync::Arc;

use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

use super::{Progress, ProgressError, Replayed, Step, Taken, replay};
use crate::people::study::answer::{Answer, Event, Measured, Response};
use crate::people::study::plan::{Design, Part, Plan, Varied};
use crate::people::study::staircase::StaircaseRule;
use crate::people::study::test_plans::{all_designs, part, plan_of, rating, staircase};
use crate::people::study::trial::{Side, Task, Trial};

/// A response that fits a trial of the plans for tests, different for different numbers.
fn respond(trial: &Trial, number: usize) -> Response {
    match &trial.task {
        Task::Sort { stimuli, n_groups } => {
            Response::Groups((0..stimuli.len()).map(|index| (index + number) % n_groups).collect())
        }
        Task::Vote { .. } => Response::Votes(vec![number.is_multiple_of(2); 3]),
        Task::Rate { .. } => Response::Sliders(vec![number as f64 % 100.0; 2]),
        Task::Compare { .. } => Response::Magnitude(number as f64),
        Task::Discriminate { .. } => Response::IsDifferent(number.is_multiple_of(3)),
        Task::Detect { .. } | Task::Match { .. } => Response::Side(Side::second_if(number.is_multiple_of(5))),
        Task::Grade { .. } => Response::Grade(1 + number as u32 % 5),
        Task::Question { .. } => {
            Response::Grades { prompt: "cork".to_owned(), grades: vec![1 + number as u32 % 7; 5] }
        }
        Task::Page { stimuli, .. } => Response::Sliders(vec![number as f64 % 100.0; stimuli.len()]),
        Task::Place { .. } => Response::Sliders(vec![number as f64 % 100.0]),
    }
}

fn answered(trial: Trial, response: Response) -> Event {
    Event::Answered(Box::new(Answer { trial, response, measured: Measured::default() }))
}

/// All events of a session from its state to its end.
fn events_to_the_end(progress: &mut Progress) -> Vec<Event> {
    let mut events = Vec::new();
    for number in 0..100_000 {
        match progress.step() {
            Step::Consent => {
                progress.consent();
                events.push(Event::Consented);
            }
            Step::Break => {
                progress.rest();
                events.push(Event::Rested);
            }
            Step::Trial(trial) => {
                let response = respond(&trial, number);
                assert_eq!(progress.answer(&trial, &response), Ok(Taken::Expected));
                events.push(answered(trial, response));
            }
            Step::Done => {
                events.push(Event::Ended);
                return events;
            }
        }
    }
    panic!("the session does not end");
}

fn started(plan: &Plan, participant: usize) -> Progress {
    Progress::new(Arc::new(plan.clone()), participant).unwrap()
}

fn replayed(plan: &Plan, events: &[Event]) -> Replayed {
    replay(Arc::new(plan.clone()), 1, events).unwrap()
}

#[test]
fn a_session_of_all_designs_ends() {
    let plan = all_designs();
    let mut progress = started(&plan, 1);
    assert_eq!(progress.step(), Step::Consent);
    let events = events_to_the_end(&mut progress);
    assert_eq!((progress.step(), progress.place()), (Step::Done, None));
    assert_eq!(events.iter().filter(|event| **event == Event::Consented).count(), 1);
    // Fourteen trials of the dissimilarities have a break after each five; the two of practice do not count.
    assert_eq!(events.iter().filter(|event| **event == Event::Rested).count(), 2);
    let staircases = progress.staircases(5);
    assert!(staircases.len() == 1 && staircases[0].is_over() && progress.staircases(0).is_empty());
}

#[test]
fn a_plan_without_consent_text_begins_with_a_trial() {
    let plan = Plan { consent: " ".to_owned(), ..all_designs() };
    let progress = started(&plan, 1);
    assert!(matches!(progress.step(), Step::Trial(_)));
    let place = progress.place().unwrap();
    assert_eq!((place.part_number, place.n_parts, place.n_answered, place.n_trials), (1, 11, 0, Some(2)));
}

#[test]
fn the_place_tells_practice_from_what_counts() {
    let plan = plan_of(vec![Part { n_practice: 2, ..part("a", rating()) }]);
    let mut progress = started(&plan, 1);
    progress.consent();
    let mut places = Vec::new();
    while let Step::Trial(trial) = progress.step() {
        let place = progress.place().unwrap();
        places.push((place.is_practice, place.is_after_practice));
        progress.answer(&trial, &respond(&trial, 1)).unwrap();
    }
    let expected = [(true, false), (true, false), (false, true), (false, false)];
    assert_eq!(places[..4], expected);
    assert_eq!(places.len(), 7);
}

#[test]
fn practice_does_not_count_toward_a_break() {
    let plan = plan_of(vec![Part { n_practice: 3, break_every: Some(2), ..part("a", rating()) }]);
    let mut progress = started(&plan, 1);
    let events = events_to_the_end(&mut progress);
    let kinds: Vec<&str> = events
        .iter()
        .map(|event| match event {
            Event::Answered(answer) if answer.trial.is_practice => "practice",
            Event::Answered(_) => "trial",
            Event::Rested => "break",
            _ => "other",
        })
        .collect();
    let expected = [
        "other", "practice", "practice", "practice", "trial", "trial", "break", "trial", "trial", "break",
        "trial", "other",
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn nothing_follows_a_refusal() {
    let plan = all_designs();
    let mut progress = started(&plan, 1);
    progress.refuse();
    assert_eq!((progress.step(), progress.place(), progress.has_refused()), (Step::Done, None, true));
    let progress = replayed(&plan, &[Event::Refused]).progress;
    assert_eq!((progress.step(), progress.has_refused()), (Step::Done, true));
    assert!(!started(&plan, 1).has_refused());
}

#[test]
fn a_damaged_answer_is_asked_again() {
    let plan = plan_of(vec![part("a", rating())]);
    let mut events = events_to_the_end(&mut started(&plan, 1));
    let Event::Answered(lost) = events.remove(3) else { panic!("an answer") };
    let Replayed { progress, warnings } = replayed(&plan, &events);
    assert!(warnings.is_empty());
    assert_eq!(progress.step(), Step::Trial(lost.trial.clone()));
    assert_eq!(progress.place().unwrap().n_answered, 4);
}

#[test]
fn a_staircase_goes_on_after_a_damaged_answer() {
    let plan = plan_of(vec![part("a", staircase())]);
    let mut progress = started(&plan, 1);
    progress.consent();
    let mut events = vec![Event::Consented];
    // Four right answers lower the level, the wrong one raises it again.
    for is_right in [true, true, true, true, false, true] {
        let Step::Trial(trial) = progress.step() else { panic!("a trial") };
        let Task::Detect { target, .. } = trial.task else { panic!("a detection") };
        let response = Response::Side(Side::second_if((target == Side::Second) == is_right));
        progress.answer(&trial, &response).unwrap();
        events.push(answered(trial, response));
    }
    let whole = replayed(&plan, &events);
    events.remove(5);
    let damaged = replayed(&plan, &events);
    assert_eq!(whole.progress.step(), damaged.progress.step());
    assert_eq!(whole.progress.staircases(0)[0].reversals(), damaged.progress.staircases(0)[0].reversals());
    assert!(whole.warnings.is_empty());
    let expected =
        "part \"a\", trial 6: an answer before it is missing; the staircase goes on from this level";
    assert_eq!(damaged.warnings, [expected]);
}

#[test]
fn a_second_answer_is_named_and_does_not_count() {
    let plan = plan_of(vec![part("a", rating())]);
    let events = events_to_the_end(&mut started(&plan, 1));
    let twice = [&events[..2], &events[1..3]].concat();
    let Replayed { progress, warnings } = replayed(&plan, &twice);
    assert_eq!(warnings, ["part \"a\", trial 1 is answered twice; the first answer counts"]);
    assert_eq!(progress.place().unwrap().n_answered, 2);
}

#[test]
fn answers_of_another_plan_or_participant_are_refused() {
    let plan = plan_of(vec![part("a", rating())]);
    let events = events_to_the_end(&mut started(&plan, 2));
    let error = replay(Arc::new(plan.clone()), 1, &events).unwrap_err();
    assert!(matches!(error, ProgressError::OtherTrial { number: 1, .. }), "{error}");
    let other = plan_of(vec![part("b", rating())]);
    let error = replay(Arc::new(other), 2, &events).unwrap_err();
    assert_eq!(error, ProgressError::UnknownPart { part: "a".to_owned() });
    let Step::Trial(trial) = replayed(&plan, &[Event::Consented]).progress.step() else { panic!("a trial") };
    let mut progress = started(&plan, 1);
    let error = progress.answer(&trial, &Response::Sliders(vec![5.0])).unwrap_err().to_string();
    assert!(error.contains("part \"a\", trial 1: 1 values are given, but 2 are needed"), "{error}");
    assert_eq!(progress.place().unwrap().n_answered, 0);
    assert_eq!(Progress::new(Arc::new(plan), 0).unwrap_err(), ProgressError::Participant);
    let empty = Arc::new(plan_of(Vec::new()));
    assert!(matches!(Progress::new(empty, 1).unwrap_err(), ProgressError::Plan(_)));
}

#[test]
fn feedback_ends_after_the_first_reversals() {
    let design = Design::Staircase {
        varied: Varied::Gap,
        rule: StaircaseRule::gap_detection(),
        feedback_reversals: 1,
    };
    let plan = plan_of(vec![Part { n_practice: 1, ..part("a", design) }]);
    let mut progress = started(&plan, 1);
    progress.consent();
    let mut seen = Vec::new();
    // Practice, four right, one wrong: the first reversal.
    for (number, is_right) in [true, true, true, true, true, false, true].into_iter().enumerate() {
        let Step::Trial(trial) = progress.step() else { panic!("a trial") };
        assert_eq!((trial.number, trial.is_practice), (number + 1, number == 0));
        let Task::Detect { target, level, has_feedback, .. } = trial.task else { panic!("a detection") };
        seen.push((level, has_feedback));
        let side = Side::second_if((target == Side::Second) == is_right);
        progress.answer(&trial, &Response::Side(side)).unwrap();
    }
    assert_eq!(seen[..5], [(6.0, true); 5]);
    assert_eq!(seen[5..], [(0.375, true), (6.0, false)]);
}

proptest! {
    /// Wherever a session is interrupted, replaying its events gives the state that it had.
    #[test]
    fn replaying_any_beginning_gives_the_same_next_step(cut in 0_usize..400) {
        let plan = all_designs();
        let events = events_to_the_end(&mut started(&plan, 1));
        let cut = cut % events.len();
        let Replayed { mut progress, warnings } = replayed(&plan, &events[..cut]);
        prop_assert!(warnings.is_empty());
        let expected = match &events[cut] {
            Event::Answered(answer) => Step::Trial(answer.trial.clone()),
            Event::Consented => Step::Consent,
            Event::Rested => Step::Break,
            Event::SetUp(_) | Event::Refused | Event::Resumed | Event::Ended => Step::Done,
        };
        prop_assert_eq!(progress.step(), expected);
        let events = events_to_the_end(&mut progress);
        prop_assert_eq!(events.last(), Some(&Event::Ended));
    }
}
