//! Output of the command line: one JSON object or lines of text on standard output, everything else on standard error.

use std::fmt::Display;
use std::io::{self, Write as _};
use std::process::ExitCode;

use serde_json::Value;
use shagreen_formats::library::{Library, Provenance};
use shagreen_studio::file::one_line;
use shagreen_studio::report::Reporter;

use crate::cli::terminal_line::aside;

/// Name and version of the program, for the files that it writes.
pub(crate) const CREATED_BY: &str = concat!("shagreen ", env!("CARGO_PKG_VERSION"));

/// Prints the result: JSON for a script, otherwise text.
pub(crate) fn print(as_json: bool, result: &Value, text: impl FnOnce() -> String) {
    let text = if as_json { result.to_string() } else { printable(&text()) };
    let written = aside(|| {
        let mut stdout = io::stdout().lock();
        writeln!(stdout, "{text}").and_then(|()| stdout.flush())
    });
    if let Err(error) = written
        && error.kind() != io::ErrorKind::BrokenPipe
    {
        // A reader that closes the pipe has read enough; any other error, such as a full disk, loses the result.
        say(format!(
            "error: the result cannot be written: {error}; free some disk space, or write it elsewhere"
        ));
        std::process::exit(1);
    }
}

/// Prints one line to standard error.
fn say(line: impl Display) {
    let line = printable(&line.to_string()).replace('\n', " ");
    // If standard error is closed, nobody reads the message.
    let _ = aside(|| writeln!(io::stderr(), "{line}"));
}

/// Returns the text with control characters escaped: names come from files and devices and could contain terminal
/// commands.
fn printable(text: &str) -> String {
    // Bidirectional formatting characters are not control characters, but can also disguise text.
    let turns = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let mut printable = String::with_capacity(text.len());
    for c in text.chars() {
        if turns(c) || c.is_control() && !matches!(c, '\n' | '\t') {
            printable.extend(c.escape_default());
        } else {
            printable.push(c);
        }
    }
    printable
}

/// Prints a warning: something is not quite as requested.
pub(crate) fn warn(message: &str) {
    say(format_args!("warning: {message}"));
}

/// Prints a note: something that the user would like to know.
pub(crate) fn note(message: &str) {
    say(format_args!("note: {message}"));
}

/// Warns of textures in a library to be written that must not be redistributed.
pub(crate) fn warn_of_restricted(library: &Library) {
    let restricted: Vec<&str> = library.restricted().map(|texture| texture.name.as_str()).collect();
    if let Some(warning) = Provenance::warning(&restricted) {
        warn(&warning);
    }
}

/// Arguments that contradict each other: wrong usage, not a failure.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}; see --help", self.0)
    }
}

impl std::error::Error for Usage {}

/// Prints why the command failed, on one line with all causes, and returns the exit status.
pub(crate) fn failure(error: &anyhow::Error) -> ExitCode {
    say(format_args!("error: {}", one_line(error)));
    if error.is::<Usage>() { ExitCode::from(WRONG_USAGE) } else { ExitCode::FAILURE }
}

/// Prints an error of the argument parser on one line, and help and version in full. Returns the exit status.
pub(crate) fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // A closed pipe is no error, as in [`print`].
        let _ = write!(io::stdout(), "{error}");
        return ExitCode::SUCCESS;
    }
    say(usage_line(&error.to_string()));
    ExitCode::from(WRONG_USAGE)
}

/// Returns the sentences of a message of the argument parser, without the usage that follows them.
fn usage_line(message: &str) -> String {
    let is_closing = |line: &&str| !line.starts_with("Usage:") && !line.starts_with("For more information");
    let lines = message.lines().map(str::trim).take_while(is_closing).filter(|line| !line.is_empty());
    format!("{}; see --help", plain(&lines.collect::<Vec<_>>().join(" ")))
}

/// Rewords what the parsers of numbers in the standard library and in clap say.
fn plain(message: &str) -> String {
    const WORDS: [(&str, &str); 6] = [
        ("invalid digit found in string", "it must be a whole number"),
        ("cannot parse integer from empty string", "it must be a whole number"),
        ("cannot parse float from empty string", "it must be a number"),
        ("invalid float literal", "it must be a number"),
        ("number too large to fit in target type", "the number is too large"),
        ("number too small to fit in target type", "the number is too small"),
    ];
    let message =
        WORDS.iter().fold(message.to_owned(), |message, (theirs, ours)| message.replace(theirs, ours));
    // "0 is not in 1..=100", and for the largest number of a type "0 is not in 1..=4294967295".
    let Some((before, range)) = message.rsplit_once(" is not in ") else { return message };
    let Some((from, to)) = range.split_once("..") else { return message };
    let before = before.rsplit_once(": ").map_or(before, |(before, _)| before);
    match to.trim_start_matches('=').parse::<u64>() {
        Ok(to) if to < u64::from(u32::MAX) => format!("{before}: it must be {from} to {to}"),
        _ => format!("{before}: it must be at least {from}"),
    }
}

/// Exit status for wrong usage.
const WRONG_USAGE: u8 = 2;

/// Prints the warnings and notes of studio functions.
pub(crate) struct Printed;

impl Reporter for Printed {
    fn warn(&self, message: &str) {
        warn(message);
    }

    fn note(&self, message: &str) {
        note(message);
    }
}

/// Widest column of a table, in characters: an id may be much longer.
pub(crate) const MAX_WIDTH: usize = 40;

#[cfg(test)]
mod tests {
    use super::{plain, printable, usage_line};

    #[test]
    fn a_terminal_obeys_no_name() {
        assert_eq!(printable("Größe 3\t✓\nnext"), "Größe 3\t✓\nnext");
        assert_eq!(printable("\u{1b}[31mred\u{7}\u{9b}\r\u{202e}"), r"\u{1b}[31mred\u{7}\u{9b}\r\u{202e}");
    }

    #[test]
    fn wrong_usage_is_one_line() {
        let message = "error: unexpected argument '--foo' found\n\n  tip: try '--force'\n\nUsage: shagreen render\n\nFor more information, try '--help'.\n";
        assert_eq!(
            usage_line(message),
            "error: unexpected argument '--foo' found tip: try '--force'; see --help"
        );
    }

    #[test]
    fn numbers_are_refused_in_plain_words() {
        for (theirs, ours) in [
            (
                "invalid value 'x' for '--seed <N>': invalid digit found in string",
                "invalid value 'x' for '--seed <N>': it must be a whole number",
            ),
            (
                "invalid value '0' for '--rate <HZ>': 0 is not in 1..=4294967295",
                "invalid value '0' for '--rate <HZ>': it must be at least 1",
            ),
            (
                "invalid value '2000' for '--row <ROW>': 2000 is not in 0..=1000",
                "invalid value '2000' for '--row <ROW>': it must be 0 to 1000",
            ),
            ("a value is required for '--out'", "a value is required for '--out'"),
        ] {
            assert_eq!(plain(theirs), ours);
        }
    }
}
