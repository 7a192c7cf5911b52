//! `shagreen doctor`: shows what works on this computer, and what to do about what does not.

use serde_json::{Value, json};
use shagreen_studio::doctor::{Line, State, lines};

use crate::cli::doctor_facts::facts;
use crate::cli::output;

/// Shows what works on this computer (sound, outputs, pens and their permissions, priority, display, graphics, libraries,
/// folders, networks) and what to do about what does not. No device plays, and
/// nothing is changed: outputs are asked for their formats, and a file written to a folder as a trial is removed again.
///
/// Each line states a part, its state, and what was seen: "works"; "limited", it works with a limitation; "fails";
/// "absent", it is not there and nothing needs it; "unknown". The exit status is 0 also if something fails.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) {
    let lines = lines(&facts());
    let count = |state: State| lines.iter().filter(|line| line.state == state).count();
    let counts: serde_json::Map<String, Value> =
        State::ALL.iter().map(|state| (state.id().to_owned(), json!(count(*state)))).collect();
    let result = json!({"lines": lines.iter().map(line_json).collect::<Vec<_>>(), "counts": counts});
    output::print(args.json, &result, || {
        let mut words: Vec<String> = lines.iter().map(in_words).collect();
        words.push(match count(State::Fails) {
            0 => "Nothing fails.".to_owned(),
            1 => "1 part fails; see its remedy above.".to_owned(),
            n => format!("{n} parts fail; see their remedies above."),
        });
        words.join("\n")
    });
}

fn line_json(line: &Line) -> Value {
    json!({"topic": line.topic, "state": line.state.id(), "seen": line.seen, "remedy": line.remedy})
}

/// Width of the columns of state and topic, in characters.
const WIDTHS: (usize, usize) = (7, 18);

fn in_words(line: &Line) -> String {
    let (state, topic, seen) = (line.state.id(), line.topic, &line.seen);
    let (state_width, topic_width) = WIDTHS;
    let mut words = vec![format!("{state:<state_width$}  {topic:<topic_width$}  {seen}")];
    for (index, remedy) in line.remedy.iter().flat_map(|remedy| remedy.lines()).enumerate() {
        let mark = if index == 0 { "->" } else { "" };
        let indent = state_width + topic_width + 4;
        words.push(format!("{:indent$}{mark:<2} {remedy}", ""));
    }
    words.join("\n")
}

#[cfg(test)]
mod tests {
    use super::{Line, State, in_words};

    #[test]
    fn a_remedy_stands_below_its_line() {
        let line = Line {
            topic: "pens",
            state: State::Fails,
            seen: "no permission".to_owned(),
            remedy: Some("Write the line\n  RULE".to_owned()),
        };
        let expected = "fails    pens                no permission\n                             -> Write the line\n                                  RULE";
        assert_eq!(in_words(&line), expected);
    }
}
