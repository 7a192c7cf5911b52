//! Tables of words and numbers with a first line that names their columns: judgements of people, places of textures.
//!
//! Columns are parted by commas, semicolons or tabs; a decimal comma is understood where commas do not part the columns.
//! Names of columns are compared without case, spaces, underscores and hyphens.

use std::collections::HashSet;

/// Why bytes are no such table, or a field of it cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NamedTableError {
    /// Nothing but, at most, a first line.
    #[error(
        "the table has no rows; give a first line that names the columns ({wanted}) and a row for each {of}"
    )]
    Empty {
        /// The columns that it needs.
        wanted: &'static str,
        /// What a row is of.
        of: &'static str,
    },
    /// Not text.
    #[error("the file is no UTF-8 text (byte {byte}); save the table as CSV in UTF-8")]
    NotText {
        /// The first byte that is none.
        byte: usize,
    },
    /// A column is missing.
    #[error("no column is named {wanted}; the columns are {found}; name it in the first line")]
    Missing {
        /// Names that would do.
        wanted: String,
        /// Names that are there.
        found: String,
    },
    /// Two columns have the same name.
    #[error("two columns are named \"{name}\"; rename or remove one")]
    TwoColumns {
        /// The name.
        name: String,
    },
    /// A column has no name.
    #[error("line {line} has something in a column without a name; name the column in the first line")]
    Unnamed {
        /// The first such line, from one.
        line: u64,
    },
    /// A row has too few or too many fields.
    #[error("line {line} has {found} fields, the first line names {expected} columns; correct the line")]
    Fields {
        /// The line, from one.
        line: u64,
        /// The fields found.
        found: usize,
        /// The columns.
        expected: usize,
    },
    /// A field is empty that must not be.
    #[error("line {line} has no {column}; fill it in, or remove the line")]
    Blank {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
    },
    /// A field is not a finite number.
    #[error("{column} in line {line} is \"{found}\", not a number; correct the line")]
    Number {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        found: String,
    },
}

/// A table, every row as long as the first line.
pub(crate) struct NamedTable {
    /// Names of the columns as they are written.
    pub(crate) columns: Vec<String>,
    rows: Vec<Row>,
    delimiter: u8,
}

/// A row and where it stands.
struct Row {
    line: u64,
    fields: Vec<String>,
}

/// A row of a table.
#[derive(Clone, Copy)]
pub(crate) struct RowOf<'a> {
    table: &'a NamedTable,
    row: &'a Row,
}

/// A field of a table.
#[derive(Clone, Copy)]
pub(crate) struct Field<'a> {
    table: &'a NamedTable,
    row: &'a Row,
    column: usize,
}

impl NamedTable {
    /// Reads a table of which a row is `of` something and needs the columns `wanted`, in words.
    pub(crate) fn read(
        bytes: &[u8],
        wanted: &'static str,
        of: &'static str,
    ) -> Result<Self, NamedTableError> {
        let text = std::str::from_utf8(bytes)
            .map_err(|error| NamedTableError::NotText { byte: error.valid_up_to() })?;
        let text = text.trim_start_matches('\u{feff}');
        let delimiter = delimiter_of(text);
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter)
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut columns: Option<Vec<String>> = None;
        let mut rows = Vec::new();
        let mut record = csv::StringRecord::new();
        // Text in memory with rows of any length: there is nothing left that the parser could refuse.
        while reader.read_record(&mut record).unwrap_or(false) {
            let line = line_of(text, &record);
            if record.iter().all(str::is_empty) {
                continue;
            }
            let fields: Vec<String> = record.iter().map(str::to_owned).collect();
            match &columns {
                None => columns = Some(fields),
                Some(columns) if columns.len() != fields.len() => {
                    let (found, expected) = (fields.len(), columns.len());
                    return Err(NamedTableError::Fields { line, found, expected });
                }
                Some(_) => rows.push(Row { line, fields }),
            }
        }
        let columns = columns.filter(|_| !rows.is_empty()).ok_or(NamedTableError::Empty { wanted, of })?;
        let mut names = HashSet::new();
        if let Some(name) = columns.iter().find(|name| !name.is_empty() && !names.insert(plain(name))) {
            return Err(NamedTableError::TwoColumns { name: name.clone() });
        }
        // Spreadsheets leave empty columns behind; one that holds something needs a name.
        let is_lost =
            |row: &&Row| row.fields.iter().zip(&columns).any(|(f, name)| name.is_empty() && !f.is_empty());
        if let Some(row) = rows.iter().find(is_lost) {
            return Err(NamedTableError::Unnamed { line: row.line });
        }
        Ok(Self { columns, rows, delimiter })
    }

    /// The column of the first of these names that there is.
    pub(crate) fn find(&self, names: &[&str]) -> Option<usize> {
        names.iter().find_map(|name| self.columns.iter().position(|column| plain(column) == plain(name)))
    }

    /// The same, which must be there.
    pub(crate) fn need(&self, names: &[&str]) -> Result<usize, NamedTableError> {
        self.find(names).ok_or_else(|| NamedTableError::Missing {
            wanted: names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(" or "),
            found: self.columns.join(", "),
        })
    }

    /// The columns that are none of these and have a name.
    pub(crate) fn others(&self, taken: &[Option<usize>]) -> Vec<usize> {
        let is_other = |i: &usize| !taken.contains(&Some(*i)) && !self.columns[*i].is_empty();
        (0..self.columns.len()).filter(is_other).collect()
    }

    /// The rows.
    pub(crate) fn rows(&self) -> impl Iterator<Item = RowOf<'_>> {
        self.rows.iter().map(|row| RowOf { table: self, row })
    }
}

impl<'a> RowOf<'a> {
    /// The field in a column.
    pub(crate) fn at(self, column: usize) -> Field<'a> {
        Field { table: self.table, row: self.row, column }
    }

    /// Where it stands, from one.
    pub(crate) fn line(self) -> u64 {
        self.row.line
    }
}

impl<'a> Field<'a> {
    /// Where it stands, from one.
    pub(crate) fn line(self) -> u64 {
        self.row.line
    }

    /// What stands there, perhaps nothing.
    pub(crate) fn text(self) -> &'a str {
        &self.row.fields[self.column]
    }

    /// What stands there, which must be something.
    pub(crate) fn word(self) -> Result<&'a str, NamedTableError> {
        let text = self.text();
        if text.is_empty() {
            return Err(NamedTableError::Blank { line: self.row.line, column: self.name().to_owned() });
        }
        Ok(text)
    }

    /// The number there; `None` where it is left empty, or says that there is none.
    pub(crate) fn number(self) -> Result<Option<f64>, NamedTableError> {
        let text = self.text();
        if matches!(text.to_ascii_lowercase().as_str(), "" | "-" | "na" | "n/a" | "nan" | "null" | "none") {
            return Ok(None);
        }
        number(text, self.table.delimiter).map(Some).ok_or_else(|| NamedTableError::Number {
            line: self.row.line,
            column: self.name().to_owned(),
            found: text.to_owned(),
        })
    }

    /// Name of its column.
    pub(crate) fn name(self) -> &'a str {
        &self.table.columns[self.column]
    }
}

/// A table of these rows, the first line among them, all as long, that [`NamedTable::read`] takes back.
pub(crate) fn write_table(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().comment(Some(b'#')).from_writer(Vec::new());
    for row in rows {
        // Memory takes all text.
        let written = writer.write_record(&row);
        assert!(written.is_ok(), "rows are all as long: {written:?}");
    }
    writer.into_inner().unwrap_or_default()
}

/// A name as it is compared.
fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '_' | '-' | '\u{2013}')).collect::<String>().to_lowercase()
}

/// The line, from one, on which a record of `text` stands: the reader counts from the end of the record before it, and
/// there may be empty lines and comments between.
pub(crate) fn line_of(text: &str, record: &csv::StringRecord) -> u64 {
    let Some(position) = record.position() else { return 0 };
    let rest = usize::try_from(position.byte()).ok().and_then(|byte| text.get(byte..)).unwrap_or("");
    let is_skipped = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    position.line() + rest.lines().take_while(is_skipped).count() as u64
}

/// The delimiter of the first line that has any: a semicolon or tab is never part of a number.
pub(crate) fn delimiter_of(text: &str) -> u8 {
    let line = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    if line.contains(';') {
        b';'
    } else if line.contains('\t') {
        b'\t'
    } else {
        b','
    }
}

/// The number in a field, if it is a finite one.
pub(crate) fn number(field: &str, delimiter: u8) -> Option<f64> {
    let parsed = if delimiter == b',' { field.parse() } else { field.replace(',', ".").parse() };
    // What is no number is the caller's to name.
    parsed.ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::NamedTable;

    fn read(text: &str) -> Result<NamedTable, String> {
        NamedTable::read(text.as_bytes(), "id", "texture").map_err(|error| error.to_string())
    }

    #[test]
    fn columns_are_found_however_they_are_spelled() {
        let table = read("\u{feff}Texture ID;Rough-Smooth\ncork;40,5\n\n# a note\nfelt;\n").unwrap();
        assert_eq!((table.need(&["id", "texture_id"]), table.find(&["rough_smooth"])), (Ok(0), Some(1)));
        let values: Vec<_> =
            table.rows().map(|r| (r.at(0).word().unwrap(), r.at(1).number().unwrap(), r.line())).collect();
        assert_eq!(values, [("cork", Some(40.5), 2), ("felt", None, 5)]);
        assert_eq!(table.others(&[Some(0), None]), [1]);
        let spreadsheet = read("id,rs,,\na,1,,\n").unwrap();
        assert_eq!(spreadsheet.others(&[Some(0)]), [1]);
    }

    #[test]
    fn what_cannot_be_used_says_where() {
        let check = |text: &str, words: &str| {
            let message = read(text).err().unwrap();
            assert!(message.contains(words), "{message}");
        };
        check("", "no rows");
        check("id,rs\n", "no rows");
        check("id,rs\na,1,2\n", "line 2 has 3 fields");
        check("id,ID\na,1\n", "two columns");
        check("id,,\na,,\nb,,1\n", "line 3 has something in a column without a name");
        assert!(NamedTable::read(b"id\n\xff\n", "id", "texture").is_err());
        let table = read("id,rs\n,x1\n").unwrap();
        let row = table.rows().next().unwrap();
        assert!(row.at(0).word().unwrap_err().to_string().contains("line 2 has no id"));
        assert!(row.at(1).number().unwrap_err().to_string().contains("rs in line 2 is \"x1\""));
        assert!(
            table.need(&["value", "rating"]).unwrap_err().to_string().contains("\"value\" or \"rating\"")
        );
    }
}
