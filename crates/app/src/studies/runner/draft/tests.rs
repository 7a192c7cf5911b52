use shagreen_core::people::study::answer::Response;
use shagreen_core::people::study::trial::Side;

use super::{Draft, Entry, entries_of, number_of};

/// The values that a response is made of lead to this response, and only the last one completes it. Votes are complete from
/// the beginning, because nobody has to choose any adjective.
#[test]
fn a_response_is_entered_value_by_value() {
    let grades = Response::Grades { prompt: "oak bark".to_owned(), grades: vec![7, 1, 4] };
    for (mut draft, response) in [
        (Draft::Groups(vec![None; 5], 3), Response::Groups(vec![2, 0, 0, 2, 1])),
        (Draft::Votes(vec![false; 3]), Response::Votes(vec![true, false, true])),
        (Draft::Votes(vec![false; 2]), Response::Votes(vec![false; 2])),
        (Draft::Sliders(vec![None; 3]), Response::Sliders(vec![0.0, 33.4, 100.0])),
        (Draft::Sliders(vec![None]), Response::Sliders(vec![50.0])),
        (Draft::Number(String::new()), Response::Magnitude(0.0)),
        (Draft::Number(String::new()), Response::Magnitude(1.0 / 3.0)),
        (Draft::IsDifferent(None), Response::IsDifferent(false)),
        (Draft::Side(None), Response::Side(Side::Second)),
        (Draft::Grade(None), Response::Grade(5)),
        (Draft::Grades(vec![None; 3]), grades),
    ] {
        let is_vote = matches!(draft, Draft::Votes(_));
        for entry in entries_of(&response) {
            assert!(is_vote || draft.response("oak bark").is_none(), "{response:?}");
            draft.enter(entry);
        }
        assert_eq!(draft.response("oak bark"), Some(response));
    }
}

#[test]
fn a_sort_with_an_empty_group_is_not_complete() {
    let mut draft = Draft::Groups(vec![None; 3], 2);
    for index in 0..3 {
        draft.enter(Entry::Group(index, Some(0)));
    }
    assert_eq!(draft.response(""), None);
    draft.enter(Entry::Group(2, Some(7)));
    assert_eq!(draft, Draft::Groups(vec![Some(0), Some(0), None], 2), "there is no such group");
    draft.enter(Entry::Group(2, Some(1)));
    assert_eq!(draft.response(""), Some(Response::Groups(vec![0, 0, 1])));
}

#[test]
fn a_value_of_another_task_changes_nothing() {
    let mut draft = Draft::Side(None);
    draft.enter(Entry::Grade(0, 3));
    draft.enter(Entry::Slider(0, 50.0));
    assert_eq!(draft, Draft::Side(None));
    assert!(draft.is_single_choice() && !Draft::Grade(None).is_single_choice());
}

#[test]
fn numbers_are_written_with_a_point_or_a_comma() {
    for (text, number) in [
        ("12", Some(12.0)),
        (" 0.5 ", Some(0.5)),
        ("0,5", Some(0.5)),
        ("0", Some(0.0)),
        ("1e3", Some(1000.0)),
    ] {
        assert_eq!(number_of(text), number, "{text}");
    }
    for text in ["", "-1", "a", "1.2.3", "inf", "nan", "."] {
        assert_eq!(number_of(text), None, "{text}");
    }
}
