//! Tables of words and numbers with a header line: judgments of people, positions of textures.
//!
//! Commas, semicolons or tabs separate the columns, or the character that a first line such as `sep=|` states. Decimal
//! commas are accepted, in quotes if commas separate the columns. Column names are compared without case, spaces,
//! underscores and hyphens.

use std::collections::HashSet;

use crate::csv_text::{self, TableTextError, line_of, number};

/// Why bytes are not such a table, or a field is invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NamedTableError {
    /// No rows after the header line.
    #[error("the table has no rows; add a header line with the columns ({wanted}) and one row per {of}")]
    Empty {
        /// The required columns.
        wanted: &'static str,
        /// What one row describes.
        of: &'static str,
    },
    /// Not text.
    #[error(transparent)]
    Text(#[from] TableTextError),
    /// A required column is missing.
    #[error("no column is named {wanted}; the columns are {found}; correct the header line")]
    Missing {
        /// Accepted column names.
        wanted: String,
        /// Column names in the file.
        found: String,
    },
    /// Two columns have the same name.
    #[error("two columns are named \"{name}\"; rename or remove one")]
    TwoColumns {
        /// The name.
        name: String,
    },
    /// A column with values has no name.
    #[error("line {line} has a value in a column without a name; name the column in the header line")]
    Unnamed {
        /// The first such line, from one.
        line: u64,
    },
    /// A row has the wrong number of fields.
    #[error(
        "line {line} has {found} fields, but the header line names {expected} columns; correct the line{hint}"
    )]
    Fields {
        /// The line, from one.
        line: u64,
        /// Number of fields found.
        found: usize,
        /// Number of columns.
        expected: usize,
        /// A further suggestion, or empty.
        hint: &'static str,
    },
    /// A required field is empty.
    #[error("line {line} has no {column}; fill it in, or remove the line")]
    Blank {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
    },
    /// A field is not a finite number.
    #[error(
        "{column} in line {line} is \"{found}\", not a number; correct the line, or leave the field empty"
    )]
    Number {
        /// The line, from one.
        line: u64,
        /// Name of the column.
        column: String,
        /// Text of the field.
        found: String,
    },
}

/// A table whose rows all have as many fields as the header line.
pub(crate) struct NamedTable {
    /// Column names as written in the file.
    pub(crate) columns: Vec<String>,
    /// Number of the header line, from one.
    pub(crate) first_line: u64,
    /// The column delimiter.
    delimiter: u8,
    rows: Vec<Row>,
}

/// A row with its line number.
struct Row {
    line: u64,
    fields: Vec<String>,
}

/// A row with its table.
#[derive(Clone, Copy)]
pub(crate) struct RowOf<'a> {
    table: &'a NamedTable,
    row: &'a Row,
}

/// A field with its row and table.
#[derive(Clone, Copy)]
pub(crate) struct Field<'a> {
    table: &'a NamedTable,
    row: &'a Row,
    column: usize,
}

impl NamedTable {
    /// Reads a table. `wanted` lists the required columns, and `of` names what one row describes; both appear in
    /// errors.
    pub(crate) fn read(
        bytes: &[u8],
        wanted: &'static str,
        of: &'static str,
    ) -> Result<Self, NamedTableError> {
        let text = csv_text::text(bytes)?;
        let (delimiter, text) = csv_text::delimited(&text);
        let mut reader = csv_text::rows(delimiter).comment(Some(b'#')).from_reader(text.as_bytes());
        let mut columns: Option<Vec<String>> = None;
        let mut first_line = 1;
        let mut rows = Vec::new();
        let mut record = csv::StringRecord::new();
        // The text is in memory and rows may have any length, so the parser has no error left to return.
        while reader.read_record(&mut record).unwrap_or(false) {
            let line = line_of(text, &record);
            if record.iter().all(str::is_empty) {
                continue;
            }
            let fields: Vec<String> = record.iter().map(str::to_owned).collect();
            match &columns {
                None => (columns, first_line) = (Some(fields), line),
                Some(columns) if columns.len() != fields.len() => {
                    let (found, expected) = (fields.len(), columns.len());
                    let is_comma = delimiter == b',' && found > expected;
                    let hint = if is_comma {
                        "; a number with a decimal comma needs quotes in a comma-separated table"
                    } else {
                        ""
                    };
                    return Err(NamedTableError::Fields { line, found, expected, hint });
                }
                Some(_) => rows.push(Row { line, fields }),
            }
        }
        let columns = columns.filter(|_| !rows.is_empty()).ok_or(NamedTableError::Empty { wanted, of })?;
        let mut names = HashSet::new();
        if let Some(name) = columns.iter().find(|name| !name.is_empty() && !names.insert(plain(name))) {
            return Err(NamedTableError::TwoColumns { name: name.clone() });
        }
        // Spreadsheets leave empty columns behind; only one with values needs a name.
        let is_lost =
            |row: &&Row| row.fields.iter().zip(&columns).any(|(f, name)| name.is_empty() && !f.is_empty());
        if let Some(row) = rows.iter().find(is_lost) {
            return Err(NamedTableError::Unnamed { line: row.line });
        }
        Ok(Self { columns, first_line, delimiter, rows })
    }

    /// Returns the column of the first of these names that exists.
    pub(crate) fn find(&self, names: &[&str]) -> Option<usize> {
        names.iter().find_map(|name| self.columns.iter().position(|column| plain(column) == plain(name)))
    }

    /// Returns the column of the first of these names that exists, or an error.
    pub(crate) fn need(&self, names: &[&str]) -> Result<usize, NamedTableError> {
        self.find(names).ok_or_else(|| NamedTableError::Missing {
            wanted: names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(" or "),
            found: self.columns.join(", "),
        })
    }

    /// Returns the named columns that are not in `taken`.
    pub(crate) fn others(&self, taken: &[Option<usize>]) -> Vec<usize> {
        let is_other = |i: &usize| !taken.contains(&Some(*i)) && !self.columns[*i].is_empty();
        (0..self.columns.len()).filter(is_other).collect()
    }

    /// The rows of the table.
    pub(crate) fn rows(&self) -> impl Iterator<Item = RowOf<'_>> {
        self.rows.iter().map(|row| RowOf { table: self, row })
    }
}

impl<'a> RowOf<'a> {
    /// The field in a column.
    pub(crate) fn at(self, column: usize) -> Field<'a> {
        Field { table: self.table, row: self.row, column }
    }

    /// Line number, from one.
    pub(crate) fn line(self) -> u64 {
        self.row.line
    }
}

impl<'a> Field<'a> {
    /// Line number, from one.
    pub(crate) fn line(self) -> u64 {
        self.row.line
    }

    /// Text of the field; may be empty.
    pub(crate) fn text(self) -> &'a str {
        &self.row.fields[self.column]
    }

    /// Text of the field, or an error if it is empty.
    pub(crate) fn word(self) -> Result<&'a str, NamedTableError> {
        let text = self.text();
        if text.is_empty() {
            return Err(NamedTableError::Blank { line: self.row.line, column: self.name().to_owned() });
        }
        Ok(text)
    }

    /// The number in the field; `None` if it is empty or a missing-value mark.
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

    /// Name of the column.
    pub(crate) fn name(self) -> &'a str {
        &self.table.columns[self.column]
    }
}

/// Serializes rows of equal length, the header first, in the form that [`NamedTable::read`] accepts.
pub(crate) fn write_table(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().comment(Some(b'#')).from_writer(Vec::new());
    for row in rows {
        // Writing to memory cannot fail.
        let written = writer.write_record(&row);
        assert!(written.is_ok(), "rows differ in length: {written:?}");
    }
    writer.into_inner().unwrap_or_default()
}

/// Normalizes a name for comparison.
pub(crate) fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '_' | '-' | '\u{2013}')).collect::<String>().to_lowercase()
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
        assert_eq!(read("# a; b\nid,rs\na,1\n").unwrap().columns, ["id", "rs"]);
    }

    #[test]
    fn tables_of_spreadsheets_say_the_same() {
        let plain = "id,rs\ncork,3.5\n\nfelt,40\n";
        let wide = |order: fn(u16) -> [u8; 2]| -> Vec<u8> {
            "\u{feff}id\trs\r\ncork\t3,5\r\n\r\nfelt\t40\r\n".encode_utf16().flat_map(order).collect()
        };
        let values = |bytes: &[u8]| {
            let table = NamedTable::read(bytes, "id", "texture").unwrap();
            assert_eq!(table.columns, ["id", "rs"]);
            table.rows().map(|row| (row.at(1).number().unwrap(), row.line())).collect::<Vec<_>>()
        };
        assert_eq!(values(plain.as_bytes()), [(Some(3.5), 2), (Some(40.0), 4)]);
        for bytes in
            [wide(u16::to_le_bytes), wide(u16::to_be_bytes), b"id,rs\ncork,\"3,5\"\n\nfelt,40\n".to_vec()]
        {
            assert_eq!(values(&bytes), values(plain.as_bytes()));
        }
        for (mark, comma) in [(';', ','), ('|', ','), ('\t', ','), (',', '.')] {
            let text =
                format!("sep={mark}\r\nid{mark}rs\r\n# note\r\ncork{mark}3{comma}5\r\nfelt{mark}40\r\n");
            assert_eq!(values(text.as_bytes()), [(Some(3.5), 4), (Some(40.0), 5)], "{text:?}");
        }
        let table = read("id,rs\ncork,\"1,234,5\"\n").unwrap();
        let message = table.rows().next().unwrap().at(1).number().unwrap_err().to_string();
        assert!(message.contains("rs in line 2 is \"1,234,5\", not a number"), "{message}");
    }

    #[test]
    fn what_cannot_be_used_says_where() {
        let check = |text: &str, words: &str| {
            let message = read(text).err().unwrap();
            assert!(message.contains(words), "{message}");
        };
        check("", "no rows");
        check("id,rs\n", "no rows");
        check(
            "id,rs\na,1,2\n",
            "line 2 has 3 fields, but the header line names 2 columns; correct the line; a number with a decimal",
        );
        check("id;rs\na;1;2\n", "names 2 columns; correct the line");
        check("id,ID\na,1\n", "two columns");
        check("id,,\na,,\nb,,1\n", "line 3 has a value in a column without a name");
        assert!(
            NamedTable::read(b"id\na\xff\n", "id", "texture")
                .err()
                .unwrap()
                .to_string()
                .contains("line 2 is not valid UTF-8")
        );
        let table = read("id,rs\n,x1\n").unwrap();
        let row = table.rows().next().unwrap();
        assert!(row.at(0).word().unwrap_err().to_string().contains("line 2 has no id"));
        assert!(row.at(1).number().unwrap_err().to_string().contains("rs in line 2 is \"x1\""));
        assert!(
            table.need(&["value", "rating"]).unwrap_err().to_string().contains("\"value\" or \"rating\"")
        );
    }
}
