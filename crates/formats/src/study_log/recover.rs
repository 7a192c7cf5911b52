//! Logs whose first line is lost: the answers are read with the plan of the study.

use shagreen_core::people::panel::{is_simulated, simulated_name};
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::schedule::participant_of;
use shagreen_core::people::study::simulated::SIMULATED_DEVICE;
use shagreen_core::people::study::trial::Trial;

use super::lines::Lines;
use super::{LogHeader, LogHeaderError, ReadLog, ReadLogError, read_study_log};
use crate::study_plan::read_logged_plan;

/// Reads a log whose first line and its copy are damaged, with the text of its plan. The number of the participant follows from
/// the seeds of the trials, which the plan gives to nobody else. `name` is the pseudonym, usually the name of the file without
/// its ending; if it cannot be one, the number makes one. A log that is not damaged so far is read as it is.
///
/// # Errors
/// [`ReadLogError::OtherPlan`] if the log has no answers to trials of this plan, [`ReadLogError::Plan`] if the plan cannot be
/// read, [`ReadLogError::Version`] for a log of a newer version.
pub fn recover_study_log(bytes: &[u8], plan_text: &str, name: &str) -> Result<ReadLog, ReadLogError> {
    match read_study_log(bytes) {
        Err(error @ ReadLogError::Version { .. }) => return Err(error),
        Err(_) => {}
        whole @ Ok(_) => return whole,
    }
    let plan = read_logged_plan(plan_text.as_bytes())?;
    let mut lines = Lines::of(bytes, &plan);
    let trials: Vec<&Trial> = lines.answers().map(|answer| &answer.trial).collect();
    let number = participant_of(&plan, &trials).ok_or(ReadLogError::OtherPlan)?;
    let has_simulated = lines.answers().any(|answer| answer.measured.device == SIMULATED_DEVICE);
    let name = if has_simulated && !is_simulated(name) { simulated_name(number) } else { name.to_owned() };
    let header = header(&plan, plan_text, &name, number, lines.begin_secs())?;
    let text = format!(
        "it is damaged; the answers are read with the plan of the study as those of participant {number}, \"{}\"",
        header.participant()
    );
    lines.add_problem(0, &text);
    Ok(lines.into_log(header, plan))
}

/// Header of a participant who is known by name and number only. Who is named as simulated, is.
fn header(
    plan: &Plan,
    plan_text: &str,
    name: &str,
    number: usize,
    unix_secs: f64,
) -> Result<LogHeader, LogHeaderError> {
    let with_name =
        |name: &str| LogHeader::new(name, number, is_simulated(name), plan.seed, "", unix_secs, plan_text);
    with_name(name).or_else(|_| with_name(&format!("p{number:02}")))
}

#[cfg(test)]
mod tests {
    use super::recover_study_log;
    use crate::study_log::tests::with_other_seed;
    use crate::study_log::{LogHeader, ReadLogError, TimedEvent, read_study_log, write_study_log};
    use crate::study_plan::{read_study_plan, study_template};
    use shagreen_core::people::study::simulated::{Observers, World, simulated_session};
    use std::sync::Arc;

    fn text(id: &str) -> &'static str {
        study_template(id).unwrap().text
    }

    /// Lines of the log of a simulated participant with this number, with their line breaks.
    fn lines(number: usize) -> Vec<Vec<u8>> {
        let plan = Arc::new(read_study_plan(text("anchor-rating").as_bytes()).unwrap());
        let world = World::invented(&plan, 3);
        let events = simulated_session(&plan, &world, &Observers::usual(), number, 5).unwrap();
        let events: Vec<TimedEvent> =
            events.into_iter().map(|event| TimedEvent { unix_secs: 1.5e9, event }).collect();
        let name = format!("simulated-{number:02}");
        let header = LogHeader::new(&name, number, true, 5, "test", 1.5e9, text("anchor-rating")).unwrap();
        let bytes = write_study_log(&header, &events);
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect()
    }

    #[test]
    fn the_copy_of_the_first_line_counts_if_that_is_damaged() {
        let whole = lines(3);
        let expected = read_study_log(&whole.concat()).unwrap();
        assert!(expected.problems.is_empty());
        // The last one has lost its line break, so that the copy follows the damage on one line.
        let damaged: [(&[u8], &str); 4] = [
            (b"\0\0\0\0\n", "line 2"),
            (b"{\"format\":\"shagr\n", "line 2"),
            (b"\n", "line 2"),
            (b"\0\0\0\0", "line 1"),
        ];
        for (first, words) in damaged {
            let read = read_study_log(&[first, &whole[1..].concat()].concat()).unwrap();
            assert_eq!((&read.header, &read.events), (&expected.header, &expected.events));
            assert_eq!((read.problems.len(), read.problems[0].line), (1, 1));
            assert!(read.problems[0].text.contains(words), "{:?}", read.problems);
        }
    }

    #[test]
    fn a_damaged_copy_is_named_and_nothing_is_lost() {
        let mut whole = lines(3);
        let expected = read_study_log(&whole.concat()).unwrap();
        let n = whole[1].len();
        whole[1][n / 2] = 0xff;
        let read = read_study_log(&whole.concat()).unwrap();
        assert_eq!((&read.header, &read.events), (&expected.header, &expected.events));
        assert_eq!(
            read.problems[0].to_string(),
            "line 2: the copy of the first line is damaged; nothing is lost"
        );
        // The header of another log is not ours.
        whole[1] = lines(4)[0].clone();
        let read = read_study_log(&whole.concat()).unwrap();
        assert_eq!((read.header.number(), &read.events), (3, &expected.events));
        assert!(read.problems[0].text.contains("another first line"), "{:?}", read.problems);
    }

    #[test]
    fn without_both_the_plan_and_the_seeds_tell_whose_answers_they_are() {
        let whole = lines(7);
        let expected = read_study_log(&whole.concat()).unwrap();
        let damaged = [&b"\0\0\0\n\0\0\0\n"[..], &whole[2..].concat()].concat();
        let error = read_study_log(&damaged).unwrap_err();
        assert!(matches!(error, ReadLogError::Damaged { .. }), "{error}");
        assert!(error.to_string().contains("analyze the log together with others"), "{error}");
        let read = recover_study_log(&damaged, text("anchor-rating"), "simulated-07").unwrap();
        assert_eq!((read.header.participant(), read.header.number()), ("simulated-07", 7));
        assert!(read.header.is_simulated());
        assert_eq!((&read.plan, &read.events), (&expected.plan, &expected.events));
        let first = read.problems.iter().find(|problem| problem.line == 1).unwrap();
        assert!(first.text.contains("as those of participant 7"), "{first}");
        // One answer with a damaged seed does not hide the others.
        let mut flipped = whole.clone();
        flipped[5] = with_other_seed(std::str::from_utf8(&whole[5]).unwrap()).into_bytes();
        let damaged_too = [&b"\0\0\0\n\0\0\0\n"[..], &flipped[2..].concat()].concat();
        let read = recover_study_log(&damaged_too, text("anchor-rating"), "simulated-07").unwrap();
        assert_eq!((read.header.number(), read.events.len()), (7, expected.events.len() - 1));
        // A name that hides the simulation, or that is none, is not taken.
        for name in ["p07", "a copy of it"] {
            let read = recover_study_log(&damaged, text("anchor-rating"), name).unwrap();
            assert_eq!((read.header.participant(), read.header.is_simulated()), ("simulated-07", true));
        }
    }

    #[test]
    fn answers_of_another_plan_are_not_taken() {
        let damaged = [&b"\0\n"[..], &lines(7)[2..].concat()].concat();
        let other = text("anchor-rating").replacen("seed = ", "seed = 1", 1);
        assert_eq!(recover_study_log(&damaged, &other, "p07"), Err(ReadLogError::OtherPlan));
        assert_eq!(recover_study_log(&damaged, text("abx"), "p07"), Err(ReadLogError::OtherPlan));
        assert_eq!(recover_study_log(b"hello", text("abx"), "p07"), Err(ReadLogError::OtherPlan));
        assert!(matches!(recover_study_log(&damaged, "", "p07"), Err(ReadLogError::Plan(_))));
        let newer = String::from_utf8(lines(7).concat())
            .unwrap()
            .replace("\"version\":\"1.1\"", "\"version\":\"2.0\"");
        let newer = recover_study_log(newer.as_bytes(), text("anchor-rating"), "p07");
        assert!(matches!(newer, Err(ReadLogError::Version { .. })), "{newer:?}");
    }
}
