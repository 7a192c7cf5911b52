use super::{Answer, Event, Measured, Record, Response, ResponseError, check, is_right};
use crate::people::study::plan::{Comparison, Design};
use crate::people::study::setup::{OutputDevice, ScreenScale, Setup};
use crate::people::study::test_plans::{ids, likert, rating, textures};
use crate::people::study::trial::{Side, Task, Trial};

fn sort() -> (Task, Design) {
    let task = Task::Sort { stimuli: textures(), n_groups: 3 };
    (task, Design::Sorting { stimuli: textures(), groups: vec![3] })
}

#[test]
fn a_sort_needs_every_texture_and_every_group() {
    let (task, design) = sort();
    let checked = |groups: &[usize]| check(&Response::Groups(groups.to_vec()), &task, &design);
    assert_eq!(checked(&[0, 1, 2, 2, 0]), Ok(()));
    assert_eq!(checked(&[0, 1, 2]), Err(ResponseError::Count { given: 3, needed: 5 }));
    assert_eq!(checked(&[0, 1, 1, 1, 0]), Err(ResponseError::EmptyGroup { group: 3, n_groups: 3 }));
    let outside = ResponseError::OutOfRange { number: 4, value: 3.0, low: 0.0, high: 2.0 };
    assert_eq!(checked(&[0, 1, 2, 3, 0]), Err(outside));
}

#[test]
fn values_must_be_on_their_scale() {
    let rate = Task::Rate { stimulus: "cork".to_owned() };
    let sliders = |values: &[f64]| check(&Response::Sliders(values.to_vec()), &rate, &rating());
    assert_eq!(sliders(&[0.0, 100.0]), Ok(()));
    assert!(
        sliders(&[50.0]).is_err() && sliders(&[50.0, 100.5]).is_err() && sliders(&[f64::NAN, 1.0]).is_err()
    );
    let question = Task::Question { prompt: 0, condition: "txt-t".to_owned() };
    let grades = |grades: &[u32]| {
        check(&Response::Grades { prompt: String::new(), grades: grades.to_vec() }, &question, &likert())
    };
    assert_eq!(grades(&[1, 2, 3, 4, 7]), Ok(()));
    assert!(grades(&[1, 2, 3, 4, 8]).is_err() && grades(&[0, 2, 3, 4, 5]).is_err() && grades(&[1]).is_err());
    let pair = Comparison::new("cork", "cork-low");
    let compare = Task::Compare { pair: pair.clone(), is_swapped: false };
    let design = Design::Dissimilarity { pairs: vec![pair], reference: None };
    let magnitude = |value: f64| check(&Response::Magnitude(value), &compare, &design);
    assert_eq!(magnitude(1e6), Ok(()));
    assert!(magnitude(-1.0).is_err() && magnitude(f64::INFINITY).is_err() && magnitude(f64::NAN).is_err());
}

#[test]
fn a_response_of_another_kind_is_refused() {
    let (task, design) = sort();
    assert_eq!(check(&Response::IsDifferent(true), &task, &design), Err(ResponseError::Kind));
    let groups = Response::Groups(vec![0, 1, 2, 2, 0]);
    assert_eq!(check(&groups, &task, &rating()), Err(ResponseError::Kind));
    let vote = Task::Vote { stimulus: "cork".to_owned() };
    let relevance = Design::Relevance { stimuli: textures(), adjectives: ids(&["rough", "soft"]) };
    assert_eq!(check(&Response::Votes(vec![true, false]), &vote, &relevance), Ok(()));
    assert_eq!(check(&Response::Sliders(vec![1.0, 2.0]), &vote, &relevance), Err(ResponseError::Kind));
}

#[test]
fn only_tasks_with_a_truth_can_be_right() {
    let pair = Comparison::new("cork", "cork-low");
    let detect = Task::Detect { track: 0, level: 1.0, target: Side::Second, has_feedback: false };
    assert_eq!(is_right(&detect, &Response::Side(Side::Second)), Some(true));
    assert_eq!(is_right(&detect, &Response::Side(Side::First)), Some(false));
    let same = Task::Discriminate { pair: pair.clone(), is_different: false, segment: 0 };
    assert_eq!(is_right(&same, &Response::IsDifferent(true)), Some(false));
    let grade = Task::Grade { pair, is_swapped: false };
    assert_eq!(is_right(&grade, &Response::Grade(1)), None);
}

#[test]
fn the_first_of_two_answers_to_a_trial_counts() {
    let answer = |number: usize, value: f64| {
        let task = Task::Compare { pair: Comparison::new("cork", "felt"), is_swapped: false };
        let trial = Trial { part: "a".to_owned(), number, is_practice: false, seed: 1, task };
        let response = Response::Magnitude(value);
        Event::Answered(Box::new(Answer { trial, response, measured: Measured::default() }))
    };
    let events =
        [Event::Consented, answer(1, 4.0), Event::Rested, answer(2, 5.0), answer(1, 6.0), Event::Ended];
    let record = Record::of("p01".to_owned(), 1, false, &events);
    let values: Vec<&Response> = record.answers.iter().map(|answer| &answer.response).collect();
    assert_eq!(values, [&Response::Magnitude(4.0), &Response::Magnitude(5.0)]);
}

#[test]
fn every_answer_has_the_setup_of_its_time() {
    let setup = |output: Option<&str>| Setup {
        output: output.map(|id| OutputDevice { id: id.to_owned(), name: id.to_owned() }),
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.8 },
        program: "test".to_owned(),
    };
    let answer = |number: usize| {
        let task = Task::Rate { stimulus: "cork".to_owned() };
        let trial = Trial { part: "a".to_owned(), number, is_practice: false, seed: 1, task };
        let response = Response::Sliders(vec![1.0]);
        Event::Answered(Box::new(Answer { trial, response, measured: Measured::default() }))
    };
    let set_up = |output| Event::SetUp(Box::new(setup(output)));
    let events = [
        answer(1),
        set_up(Some("usb")),
        answer(2),
        answer(2),
        answer(3),
        set_up(None),
        answer(4),
        Event::Resumed,
        answer(5),
        Event::Resumed,
        set_up(Some("hdmi")),
        answer(6),
    ];
    let record = Record::of("p01".to_owned(), 1, false, &events);
    let outputs: Vec<Option<Option<&str>>> = (0..record.answers.len())
        .map(|index| {
            record.setup_at(index).map(|setup| setup.output.as_ref().map(|output| output.id.as_str()))
        })
        .collect();
    let expected = [None, Some(Some("usb")), Some(Some("usb")), Some(None), None, Some(Some("hdmi"))];
    assert_eq!(outputs, expected);
    let screen = setup(None).screen;
    assert!(!screen.is_measured() && screen.pixels_per_mm() == 3.8);
}
