//! Text of CSV tables in the dialects of spreadsheets: encoding, column delimiter, row positions and decimal commas.

use std::borrow::Cow;

/// Longest line of a table, in bytes: more than 10,000 columns.
const MAX_LINE_BYTES: usize = 1 << 20;

/// Why bytes are not text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TableTextError {
    /// Neither UTF-8 nor UTF-16 with a byte order mark.
    #[error("line {line} is not valid UTF-8 (byte {byte} of the file); save the table as CSV in UTF-8")]
    Utf8 {
        /// The line, from one.
        line: u64,
        /// Offset of the first invalid byte, from zero.
        byte: usize,
    },
    /// UTF-16 with an unpaired surrogate or an odd byte.
    #[error("line {line} holds an incomplete UTF-16 character; save the table again as CSV in UTF-8")]
    Utf16 {
        /// The line, from one.
        line: u64,
    },
    /// A line is too long for a table.
    #[error(
        "line {line} is longer than {MAX_LINE_BYTES} bytes, so the file is not a table; save it as CSV with one row a line"
    )]
    LongLine {
        /// The line, from one.
        line: u64,
    },
    /// A zero byte, which is typical of binary files.
    #[error(
        "line {line} holds a zero byte, so the file is not a text table or is UTF-16 without a byte order mark; save the table as CSV in UTF-8"
    )]
    Zero {
        /// The line, from one.
        line: u64,
    },
}

/// Decodes bytes without their byte order mark: UTF-8, or UTF-16 of either byte order, which spreadsheets call "Unicode
/// text".
pub(crate) fn text(bytes: &[u8]) -> Result<Cow<'_, str>, TableTextError> {
    let text = if let Some(units) = wide_units(bytes) {
        Cow::Owned(narrow(units, bytes.len() % 2 == 1)?)
    } else {
        let utf8 = std::str::from_utf8(bytes).map_err(|error| {
            let byte = error.valid_up_to();
            TableTextError::Utf8 { line: line_at(&bytes[..byte]), byte }
        })?;
        Cow::Borrowed(utf8.trim_start_matches('\u{feff}'))
    };
    if let Some(at) = text.find('\0') {
        return Err(TableTextError::Zero { line: line_at(&text.as_bytes()[..at]) });
    }
    match long_line(&text) {
        Some(line) => Err(TableTextError::LongLine { line }),
        None => Ok(text),
    }
}

/// Decodes like [`text`] but replaces invalid characters, for files whose encoding does not matter, such as headers.
pub(crate) fn text_with_odd_letters(bytes: &[u8]) -> Cow<'_, str> {
    match wide_units(bytes) {
        Some(units) => {
            let character = |decoded: Result<char, _>| decoded.unwrap_or(char::REPLACEMENT_CHARACTER);
            Cow::Owned(char::decode_utf16(units).map(character).collect())
        }
        None => String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
    }
}

/// Number, from one, of the first line that is too long for a table.
pub(crate) fn long_line(text: &str) -> Option<u64> {
    text.split(['\n', '\r']).position(|line| line.len() > MAX_LINE_BYTES).map(|index| index as u64 + 1)
}

/// The UTF-16 code units after a byte order mark; `None` without one.
fn wide_units(bytes: &[u8]) -> Option<impl Iterator<Item = u16> + '_> {
    let from: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return None,
    };
    Some(bytes[2..].chunks_exact(2).map(move |pair| from([pair[0], pair[1]])))
}

fn narrow(units: impl Iterator<Item = u16>, is_cut: bool) -> Result<String, TableTextError> {
    let mut text = String::new();
    for decoded in char::decode_utf16(units) {
        // The offset within the line is not needed here.
        let character = decoded.map_err(|_| TableTextError::Utf16 { line: line_at(text.as_bytes()) })?;
        text.push(character);
    }
    if is_cut { Err(TableTextError::Utf16 { line: line_at(text.as_bytes()) }) } else { Ok(text) }
}

/// The line number, from one, of the text that follows `before`.
fn line_at(before: &[u8]) -> u64 {
    before.split(|byte| *byte == b'\n').count() as u64
}

/// Returns the delimiter that a first line `sep=;` states, and the text after it.
///
/// Spreadsheets write and obey such a line. The returned text begins with the line's end, so line numbers stay those of
/// the file.
pub(crate) fn stated_delimiter(text: &str) -> (Option<u8>, &str) {
    let (line, rest) = text.split_at(text.find(['\r', '\n']).unwrap_or(text.len()));
    // The delimiter may itself be a tab at the end of the line.
    let line = line.trim_matches([' ', '"']);
    let stated = line.get(..4).filter(|start| start.eq_ignore_ascii_case("sep=")).map(|_| &line[4..]);
    match stated.map(str::as_bytes) {
        // No delimiter is stated, or it was a space.
        Some([]) => (None, rest),
        // Saving the table again may append empty columns, each with its delimiter.
        Some([mark, empty @ ..]) if is_delimiter(*mark) && empty.iter().all(|byte| byte == mark) => {
            (Some(*mark), rest)
        }
        _ => (None, text),
    }
}

/// Returns whether this byte may delimit columns; bytes that occur in names and numbers may not.
fn is_delimiter(byte: u8) -> bool {
    byte == b'\t' || (byte.is_ascii_punctuation() && !matches!(byte, b'"' | b'#' | b'.' | b'-' | b'_'))
}

/// Guesses the delimiter from the first line that is neither empty nor a comment. Semicolons and tabs never occur in a
/// number.
fn delimiter_of(text: &str) -> u8 {
    let is_content = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let line = text.lines().find(is_content).unwrap_or("");
    if line.contains(';') {
        b';'
    } else if line.contains('\t') {
        b'\t'
    } else {
        b','
    }
}

/// A CSV reader of rows of any length, without a header row, that trims spaces around fields.
pub(crate) fn rows(delimiter: u8) -> csv::ReaderBuilder {
    let mut builder = csv::ReaderBuilder::new();
    builder.delimiter(delimiter).has_headers(false).flexible(true).trim(csv::Trim::All);
    builder
}

/// Returns the delimiter, stated or guessed from the first line, and the text without a `sep=` line.
pub(crate) fn delimited(text: &str) -> (u8, &str) {
    let (stated, text) = stated_delimiter(text);
    (stated.unwrap_or_else(|| delimiter_of(text)), text)
}

/// Returns the delimiter, the text without a `sep=` line, and the records that are not empty.
pub(crate) fn records(text: &str) -> (u8, &str, impl Iterator<Item = csv::StringRecord>) {
    let (delimiter, text) = delimited(text);
    let reader = rows(delimiter).from_reader(text.as_bytes());
    // The text is in memory and rows may have any length, so the parser has no error left to return.
    let records = reader.into_records().map_while(Result::ok);
    (delimiter, text, records.filter(|record| record.iter().any(|field| !field.is_empty())))
}

/// Returns the line, from one, of a record of `text`. The reader counts from the end of the previous record, so empty
/// lines and comments between are added.
pub(crate) fn line_of(text: &str, record: &csv::StringRecord) -> u64 {
    let Some(position) = record.position() else { return 0 };
    let rest = usize::try_from(position.byte()).ok().and_then(|byte| text.get(byte..)).unwrap_or("");
    let is_skipped = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    position.line() + rest.lines().take_while(is_skipped).count() as u64
}

/// Parses a finite number. A comma is a decimal comma; in a comma-delimited table the field was quoted. There, `1,000`
/// could also contain a thousands separator, so it is ambiguous and returns `None`.
pub(crate) fn number(field: &str, delimiter: u8) -> Option<f64> {
    if delimiter == b','
        && let Some((whole, part)) = field.split_once(',')
    {
        let digits = whole.trim_start_matches(['-', '+']);
        let could_be_thousands =
            part.len() == 3 && (1..=3).contains(&digits.len()) && !digits.starts_with('0');
        if could_be_thousands && part.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
    }
    let parsed = if field.contains(',') { field.replace(',', ".").parse() } else { field.parse() };
    // The caller reports a field that is not a number.
    parsed.ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::{TableTextError, number, stated_delimiter, text, text_with_odd_letters};

    fn wide(text: &str, order: fn(u16) -> [u8; 2]) -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(order).collect()
    }

    #[test]
    fn every_encoding_says_the_same() {
        let expected = "id;größe\r\ncork;3,5 🙂\r\n";
        let marked = format!("\u{feff}{expected}");
        for bytes in [
            expected.as_bytes().to_vec(),
            marked.into_bytes(),
            wide(expected, u16::to_le_bytes),
            wide(expected, u16::to_be_bytes),
        ] {
            assert_eq!(text(&bytes).unwrap(), expected);
            assert_eq!(text_with_odd_letters(&bytes), expected);
        }
    }

    #[test]
    fn what_is_no_text_says_where() {
        let check = |bytes: &[u8], expected: TableTextError| assert_eq!(text(bytes), Err(expected));
        check(b"id\ncork\xff\n", TableTextError::Utf8 { line: 2, byte: 7 });
        check(b"i\0d\0\n\0", TableTextError::Zero { line: 1 });
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let lone = |unit: u16| {
                let mut bytes = wide("id\ncork,", order);
                bytes.extend(order(unit));
                bytes.extend(wide("1\n", order));
                bytes
            };
            check(&lone(0xd800), TableTextError::Utf16 { line: 2 });
            check(&lone(0xdc00), TableTextError::Utf16 { line: 2 });
            assert!(text_with_odd_letters(&lone(0xd800)).contains('\u{fffd}'));
            let mut cut = wide("id\ncork\nfelt", order);
            cut.pop();
            check(&cut, TableTextError::Utf16 { line: 3 });
        }
    }

    #[test]
    fn a_line_may_say_what_parts_columns() {
        let check = |text: &str, delimiter: Option<u8>, rest: &str| {
            assert_eq!(stated_delimiter(text), (delimiter, rest), "{text:?}");
        };
        check("sep=;\r\na;b\r\n", Some(b';'), "\r\na;b\r\n");
        check("SEP=|\na|b", Some(b'|'), "\na|b");
        check("\"sep=,\"\na,b", Some(b','), "\na,b");
        check("sep=\t\na\tb", Some(b'\t'), "\na\tb");
        check("sep=,,,\na,b", Some(b','), "\na,b");
        check("sep= \na b", None, "\na b");
        check("sep=;", Some(b';'), "");
        for other in ["sep=5\n", "sep=;x\n", "seps\n", "a,b\n", "", "sép=;\n", "sep=é\n", "sep=\"\"\n\n"] {
            let (delimiter, rest) = stated_delimiter(other);
            assert!(delimiter.is_none() && (rest == other || other.starts_with("sep=\"")), "{other:?}");
        }
    }

    #[test]
    fn a_comma_is_the_decimal_one() {
        for (field, value) in
            [("3,5", Some(3.5)), ("3.5", Some(3.5)), ("-0,25", Some(-0.25)), ("7", Some(7.0))]
        {
            assert_eq!(number(field, b';'), value, "{field}");
        }
        for field in ["1,234,5", "1.234,5", "1,234.5", "12:30", "inf", "NaN", "", ",", "3,5 %"] {
            assert_eq!(number(field, b';'), None, "{field}");
        }
    }

    #[test]
    fn a_comma_may_part_thousands_only_where_commas_part_columns() {
        for field in ["1,000", "-12,345", "999,999"] {
            assert_eq!(number(field, b','), None, "{field}");
            assert!(number(field, b';').is_some(), "{field}");
        }
        for (field, value) in [("0,125", 0.125), ("3,5", 3.5), ("1,0000", 1.0), ("1234,567", 1234.567)] {
            assert_eq!(number(field, b','), Some(value));
        }
    }
}
