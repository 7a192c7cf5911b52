//! Tables of numbers in any CSV dialect: conversion of text to columns.

use std::borrow::Cow;

use crate::csv_text::{self, TableTextError, long_line, stated_delimiter, text_with_odd_letters};
use crate::recording::RecordingFileError;
use crate::recording::column_map::{ColumnMap, Separator};

/// Maximum number of columns, more than any sensor has.
const MAX_COLUMNS: usize = 1000;
/// Number of lines used to detect the dialect.
const SNIFFED_LINES: usize = 50;

/// Text cells in a column of numbers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NotNumbers {
    /// Number of such cells.
    pub(super) n: usize,
    /// Line of the first, from one.
    pub(super) first_line: usize,
}

/// A table: columns of equal length, with NaN for missing numbers.
#[derive(Debug)]
pub(super) struct Table {
    /// Names as written, with the unit of a second header line in brackets; `column 1` and so on without a header.
    pub(super) names: Vec<String>,
    /// The values.
    pub(super) columns: Vec<Vec<f64>>,
    /// Text cells per column.
    pub(super) not_numbers: Vec<NotNumbers>,
    /// The column separator.
    pub(super) separator: Separator,
    /// Whether numbers have a decimal comma.
    pub(super) decimal_comma: bool,
    /// Whether there is a header.
    pub(super) header: bool,
    /// Sentences for the user.
    pub(super) warnings: Vec<String>,
}

/// Decodes bytes: UTF-8, or UTF-16 with a byte order mark. Invalid characters, as of a header in another encoding, are
/// replaced.
fn text_of(bytes: &[u8]) -> Result<Cow<'_, str>, RecordingFileError> {
    let text = text_with_odd_letters(bytes);
    if text.contains('\0') {
        let problem = "the file is neither a WAV file nor text".to_owned();
        return Err(RecordingFileError::Table { problem, line: None });
    }
    // Before any cell is parsed: a line of a hundred million cells would take gigabytes.
    if let Some(line) = long_line(&text) {
        let problem = TableTextError::LongLine { line }.to_string();
        return Err(RecordingFileError::Table { problem, line: None });
    }
    Ok(text)
}

/// The lines that are neither empty nor comments.
fn content(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim_end).filter(|line| !line.trim().is_empty() && !line.starts_with('#'))
}

fn separator_of(text: &str) -> Separator {
    let lines: Vec<&str> = content(text).take(SNIFFED_LINES).collect();
    let last = lines.last().copied().unwrap_or("");
    // The last of these lines is a row of numbers, whereas a header may contain any character.
    if last.contains(';') {
        Separator::Semicolon
    } else if last.contains('\t') {
        Separator::Tab
    } else if last.trim().contains(' ') && (!last.contains(',') || has_decimal_commas(last, &[' '])) {
        Separator::Spaces
    } else {
        Separator::Comma
    }
}

/// Returns whether a line has commas, and each of them is inside a number.
fn has_decimal_commas(line: &str, separators: &[char]) -> bool {
    let mut fields = line.split(separators).filter(|field| field.contains(',')).peekable();
    fields.peek().is_some() && fields.all(|field| number(field.trim_matches('"'), true).is_some())
}

/// Parses a number; NaN for a missing-value mark, `None` for other text.
pub(super) fn number(field: &str, decimal_comma: bool) -> Option<f64> {
    match field {
        "" | "-" | "NA" | "N/A" | "null" | "NULL" | "None" => Some(f64::NAN),
        _ if decimal_comma && field.contains(',') => field.replace(',', ".").parse().ok(),
        _ => field.parse().ok(),
    }
}

/// Reads a table; the map may state its dialect.
pub(super) fn read_table(bytes: &[u8], map: &ColumnMap) -> Result<Table, RecordingFileError> {
    let text = text_of(bytes)?;
    let (stated, text) = stated_delimiter(&text);
    let stated = match stated {
        Some(b',') => Some(Separator::Comma),
        Some(b';') => Some(Separator::Semicolon),
        Some(b'\t') => Some(Separator::Tab),
        _ => None,
    };
    let separator = map.separator.or(stated).unwrap_or_else(|| separator_of(text));
    let mark = match separator {
        Separator::Comma => ',',
        Separator::Semicolon => ';',
        Separator::Tab | Separator::Spaces => '\t',
    };
    let decimal_comma = map.decimal_comma.unwrap_or_else(|| {
        let marks: &[char] = if separator == Separator::Spaces { &[' ', '\t'] } else { &[mark] };
        separator != Separator::Comma
            && content(text).skip(1).take(SNIFFED_LINES).any(|line| has_decimal_commas(line, marks))
    });
    let text =
        if separator == Separator::Spaces { Cow::Owned(single_tabs(text)) } else { Cow::Borrowed(text) };
    let mut reader = csv_text::rows(mark as u8).comment(Some(b'#')).from_reader(text.as_bytes());
    let mut table = Table {
        names: Vec::new(),
        columns: Vec::new(),
        not_numbers: Vec::new(),
        separator,
        decimal_comma,
        header: false,
        warnings: Vec::new(),
    };
    let mut record = csv::StringRecord::new();
    let (mut n_short, mut first_short, mut n_lacking) = (0, 0, 0);
    let (mut has_units, mut n_words) = (false, 0);
    // The text is in memory and rows may have any length, so the parser has no error left to return.
    while reader.read_record(&mut record).unwrap_or(false) {
        let line = record.position().map_or(0, |position| position.line() as usize);
        if record.iter().all(str::is_empty) {
            continue;
        }
        let is_words = record
            .iter()
            .all(|field| field.is_empty() || number(field, decimal_comma || mark != ',').is_none());
        if table.names.is_empty() {
            table.start(&record, map.header.unwrap_or(is_words), line)?;
            table.reserve(&text);
            if table.header {
                continue;
            }
        } else if table.header && is_words && table.columns.first().is_some_and(Vec::is_empty) {
            // Only one line can hold units. Appending every such line to the names would take quadratic time for prose.
            if std::mem::replace(&mut has_units, true) {
                n_words += 1;
                continue;
            }
            for (name, unit) in table.names.iter_mut().zip(&record).filter(|(_, unit)| !unit.is_empty()) {
                *name = format!("{name} [{}]", unit.trim_matches(['[', ']', '(', ')']));
            }
            continue;
        }
        if record.iter().skip(table.names.len()).any(|field| !field.is_empty()) {
            let problem = format!(
                "{} values where the table has {} columns{}",
                record.len(),
                table.names.len(),
                comma_hint(map)
            );
            return Err(RecordingFileError::Table { problem, line: Some(line) });
        }
        if record.len() < table.names.len() {
            n_short += 1;
            n_lacking += table.names.len() - record.len();
            // Otherwise a short file could request any amount of memory.
            if n_lacking > text.len() {
                let n_columns = table.names.len();
                let problem = format!("too many lines have fewer values than the {n_columns} columns");
                return Err(RecordingFileError::Table { problem, line: Some(line) });
            }
            first_short = if n_short == 1 { line } else { first_short };
        }
        table.push(&record, line);
    }
    if table.columns.first().is_none_or(Vec::is_empty) {
        let problem = match content(&text).count() {
            0 => "the file is empty".to_owned(),
            1 if table.header => "the table has a header, but no rows of numbers".to_owned(),
            _ => format!(
                "the table has no rows of numbers with the separator {}; if its separator is another one, state it{}",
                separator.name(),
                comma_hint(map)
            ),
        };
        return Err(RecordingFileError::Table { problem, line: None });
    }
    if n_words > 0 {
        table.warnings.push(format!("{n_words} lines of text before the numbers are ignored"));
    }
    if n_short > 0 {
        table.warnings.push(format!(
            "{n_short} lines have fewer values than columns, first line {first_short}; the absent values count as missing"
        ));
    }
    Ok(table)
}

/// A suggestion if the map states a decimal comma.
fn comma_hint(map: &ColumnMap) -> &'static str {
    if map.decimal_comma == Some(true) {
        "; decimal_comma = true may be wrong, or needs the separator stated"
    } else {
        ""
    }
}

/// Replaces runs of spaces and tabs by one tab each, and removes them at the ends of lines.
fn single_tabs(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        for (i, word) in line.split_whitespace().enumerate() {
            if i > 0 {
                out.push('\t');
            }
            out.push_str(word);
        }
        out.push('\n');
    }
    out
}

impl Table {
    fn start(
        &mut self,
        first: &csv::StringRecord,
        header: bool,
        line: usize,
    ) -> Result<(), RecordingFileError> {
        if first.len() > MAX_COLUMNS {
            let problem =
                format!("the table has {} columns, but at most {MAX_COLUMNS} are supported", first.len());
            return Err(RecordingFileError::Table { problem, line: Some(line) });
        }
        self.header = header;
        let name =
            |(i, field): (usize, &str)| if header { field.to_owned() } else { format!("column {}", i + 1) };
        self.names = first.iter().enumerate().map(name).collect();
        // Nameless columns at the end come from trailing separators.
        while header && self.names.len() > 1 && self.names.last().is_some_and(String::is_empty) {
            self.names.pop();
        }
        self.columns = vec![Vec::new(); self.names.len()];
        self.not_numbers = vec![NotNumbers::default(); self.names.len()];
        Ok(())
    }

    /// Reserves memory for as many rows as the text can hold; a full row takes at least one byte per column.
    fn reserve(&mut self, text: &str) {
        let n_lines = text.bytes().filter(|byte| matches!(byte, b'\n' | b'\r')).count() + 1;
        let n_rows = n_lines.min(text.len() / self.columns.len() + 1);
        for column in &mut self.columns {
            column.reserve_exact(n_rows);
        }
    }

    fn push(&mut self, record: &csv::StringRecord, line: usize) {
        for (i, column) in self.columns.iter_mut().enumerate() {
            let value = number(record.get(i).unwrap_or(""), self.decimal_comma);
            if value.is_none() {
                let cells = &mut self.not_numbers[i];
                cells.first_line = if cells.n == 0 { line } else { cells.first_line };
                cells.n += 1;
            }
            column.push(value.unwrap_or(f64::NAN));
        }
    }
}
