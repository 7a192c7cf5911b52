//! What the command line prints and reads: one JSON object or some lines on standard output, all else on standard error.

use std::fmt::Display;
use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

use anyhow::Context as _;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::Value;
use shagreen_formats::library::{Library, Provenance};

/// The program and its version, for the files that it writes.
pub(crate) const CREATED_BY: &str = concat!("shagreen ", env!("CARGO_PKG_VERSION"));

/// Prints the result: as JSON for a script, else as text for a person.
pub(crate) fn print(as_json: bool, result: &Value, text: impl FnOnce() -> String) {
    let text = if as_json { result.to_string() } else { printable(&text()) };
    let mut stdout = io::stdout().lock();
    if let Err(error) = writeln!(stdout, "{text}").and_then(|()| stdout.flush())
        && error.kind() != io::ErrorKind::BrokenPipe
    {
        // Whoever closed the pipe has read enough; a full disk has lost what was asked for.
        say(format!("error: the answer cannot be written: {error}; make room, or write it elsewhere"));
        std::process::exit(1);
    }
}

/// A line on standard error.
fn say(line: impl Display) {
    let line = printable(&line.to_string()).replace('\n', " ");
    // Whoever closed it does not want to know.
    let _ = writeln!(io::stderr(), "{line}");
}

/// Text without what a terminal would obey: names come from files and from devices, which may say anything.
fn printable(text: &str) -> String {
    // Marks that turn the order of letters around are no control characters, and hide as much.
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

/// Says what is not quite as asked.
pub(crate) fn warn(message: &str) {
    say(format_args!("warning: {message}"));
}

/// Says what the person would like to know.
pub(crate) fn note(message: &str) {
    say(format_args!("note: {message}"));
}

/// Says which textures of a library that is written may not be passed on.
pub(crate) fn warn_of_restricted(library: &Library) {
    let restricted: Vec<&str> = library.restricted().map(|texture| texture.name.as_str()).collect();
    if let Some(warning) = Provenance::warning(&restricted) {
        warn(&warning);
    }
}

/// That the arguments do not fit together: wrong usage, not a failure.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}; see --help", self.0)
    }
}

impl std::error::Error for Usage {}

/// Says why the command could not be done, on one line, with all its causes.
pub(crate) fn failure(error: &anyhow::Error) -> ExitCode {
    say(format_args!("error: {}", one_line(error)));
    if error.is::<Usage>() { ExitCode::from(WRONG_USAGE) } else { ExitCode::FAILURE }
}

/// Says what is wrong with the arguments, on one line; help and version, which come the same way, are printed whole.
pub(crate) fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // As with results.
        let _ = write!(io::stdout(), "{error}");
        return ExitCode::SUCCESS;
    }
    say(usage_line(&error.to_string()));
    ExitCode::from(WRONG_USAGE)
}

/// The sentences of a message of the argument parser, without the usage that follows them.
fn usage_line(message: &str) -> String {
    let is_closing = |line: &&str| !line.starts_with("Usage:") && !line.starts_with("For more information");
    let lines = message.lines().map(str::trim).take_while(is_closing).filter(|line| !line.is_empty());
    format!("{}; see --help", lines.collect::<Vec<_>>().join(" "))
}

/// Exit status for wrong usage.
const WRONG_USAGE: u8 = 2;

/// The chain of causes, the path last: contexts that only name a file are moved to the end.
pub(crate) fn one_line(error: &anyhow::Error) -> String {
    let (files, causes): (Vec<_>, Vec<_>) =
        error.chain().map(ToString::to_string).partition(|cause| cause.starts_with(IN_FILE));
    let mut parts: Vec<String> = Vec::new();
    for cause in causes {
        // Some errors repeat their source in their own words.
        if !parts.iter().any(|part| part.contains(&cause)) {
            parts.push(cause);
        }
    }
    let paths = files.iter().map(|file| file.trim_start_matches(IN_FILE).to_owned());
    let line: Vec<String> = parts.into_iter().chain(paths).collect();
    line.join(": ").replace(['\n', '\r'], " ")
}

/// Marks a context that only names a file.
const IN_FILE: &str = "file ";

/// The context for an error inside a file: [`failure`] shows it last.
pub(crate) fn in_file(path: &Path) -> String {
    format!("{IN_FILE}{}", path.display())
}

/// The name of a file, for people.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// The bytes of a file.
pub(crate) fn read_file(path: &Path) -> anyhow::Result<Vec<u8>> {
    let reason = |error: &io::Error| match error.kind() {
        io::ErrorKind::NotFound => "there is no such file; check its name and its folder".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder; give a file in it".to_owned(),
        io::ErrorKind::PermissionDenied => "you may not read it; ask for the right, or copy it".to_owned(),
        _ => format!("{error}; check its name and your rights"),
    };
    std::fs::read(path)
        .map_err(|error| anyhow::anyhow!("cannot read the file: {}", reason(&error)))
        .with_context(|| in_file(path))
}

/// A bar on standard error, where that is a terminal.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// A bar of `n` steps of `what`.
    pub(crate) fn new(what: &'static str, n: usize) -> Self {
        Self::styled("{bar:30} {pos}/{len} {msg} {elapsed}", what, n)
    }

    /// The same for work of hours, with how long it will still take.
    pub(crate) fn of_hours(what: &'static str, n: usize) -> Self {
        Self::styled("{bar:30} {pos}/{len} {msg} {elapsed}, about {eta} left", what, n)
    }

    fn styled(template: &str, what: &'static str, n: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(n as u64), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(what);
        Self(bar)
    }

    /// So many steps need not be done: they say nothing of how long the others take.
    pub(crate) fn leave_out(&self, n: usize) {
        self.0.dec_length(n as u64);
    }

    /// One more step is done.
    pub(crate) fn step(&self) {
        self.steps(1);
    }

    /// So many more steps are done.
    pub(crate) fn steps(&self, n: usize) {
        self.0.inc(n as u64);
    }

    /// Says something above the bar.
    pub(crate) fn note(&self, line: &str) {
        self.0.suspend(|| note(line));
    }

    /// So many seconds are played or rendered; [`in_ms`] is the number of steps for a bar of them.
    pub(crate) fn set_secs(&self, secs: f64) {
        self.0.set_position(in_ms(secs) as u64);
    }

    /// Takes the bar away, which dropping it does too.
    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

/// Whole milliseconds.
pub(crate) fn in_ms(secs: f64) -> usize {
    (1e3 * secs) as usize
}

#[cfg(test)]
mod tests {
    use super::{in_file, one_line, printable, usage_line};

    use std::path::Path;

    #[test]
    fn the_path_comes_last_on_one_line() {
        let error = anyhow::anyhow!("line 3 is\nshort")
            .context("the stroke is damaged")
            .context(in_file(Path::new("a/b.svc")));
        assert_eq!(one_line(&error), "the stroke is damaged: line 3 is short: a/b.svc");
    }

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
}
