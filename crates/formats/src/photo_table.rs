//! Labelled photos of surfaces as a table: training data for predictors of attributes from photos.
//!
//! ```csv
//! file,class,softness,softness_sd,source,license,author,note
//! brick-1.jpg,brick,9,7,my photos,CC0,A. Author,
//! ```
//!
//! `file` is relative to the folder of the table. `softness` is 0 (hard) to 100 (soft), with its standard deviation in
//! `softness_sd`; all photos of a class have the same. `source` names what was photographed or published together, so that
//! a validation can leave it out; `repo` is another name of this column, `cls` one of `class`, and `licence` one of
//! `license`. `author` and `note` may be missing. Other columns are not used.

use std::collections::HashMap;
use std::path::{Component, Path};

use crate::named_table::{Field, NamedTable, NamedTableError};

/// Class of materials, with the label of its photos.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoClass {
    /// Name, such as "carpet".
    pub name: String,
    /// Softness, 0 (hard) to 100 (soft).
    pub softness: f64,
    /// Standard deviation of the softness within the class, [`MIN_SD`] to [`MAX_SD`].
    pub softness_sd: f64,
}

/// Photo with its class and origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LabelledPhoto {
    /// Path of the file, relative to the folder of the table, without `..`.
    pub file: String,
    /// Index of its class.
    pub class: usize,
    /// Index of its source.
    pub source: usize,
    /// License.
    pub license: String,
    /// Author; empty if the table states none.
    pub author: String,
    /// Note; may be empty.
    pub note: String,
}

/// Labelled photos.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoTable {
    /// Classes, in the order of their first photo.
    pub classes: Vec<PhotoClass>,
    /// Names of the sources, in the order of their first photo.
    pub sources: Vec<String>,
    /// The photos.
    pub photos: Vec<LabelledPhoto>,
}

/// Smallest standard deviation of a label.
pub const MIN_SD: f64 = 0.1;
/// Largest standard deviation of a label.
pub const MAX_SD: f64 = 50.0;

/// Reasons why a table holds no labelled photos.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PhotoTableError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A number is outside its range.
    #[error("{column} in line {line} is {value}; it must be {low} to {high}")]
    Range {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// The value.
        value: f64,
        /// Lowest value.
        low: f64,
        /// Highest value.
        high: f64,
    },
    /// A path leads out of the folder of the table.
    #[error(
        "the file in line {line} is \"{file}\"; give a path below the folder of the table, without \"..\", and move the photo there"
    )]
    Path {
        /// The line, from one.
        line: u64,
        /// Text of the field.
        file: String,
    },
    /// A photo is listed twice.
    #[error("\"{file}\" is in line {first} and again in line {line}; remove one of the two lines")]
    Twice {
        /// Path of the photo.
        file: String,
        /// The first line, from one.
        first: u64,
        /// The second line, from one.
        line: u64,
    },
    /// Two photos of a class have different labels.
    #[error(
        "the softness of \"{class}\" in line {line} differs from that in line {first}; give all photos of a class the same softness and softness_sd, or divide the class"
    )]
    TwoLabels {
        /// Name of the class.
        class: String,
        /// The first line of the class, from one.
        first: u64,
        /// The line that differs, from one.
        line: u64,
    },
}

/// Reads a table of labelled photos. It does not read the photos.
///
/// # Errors
/// See [`PhotoTableError`].
pub fn read_photo_table(bytes: &[u8]) -> Result<PhotoTable, PhotoTableError> {
    let wanted = "file, class, softness, softness_sd, source, license";
    let table = NamedTable::read(bytes, wanted, "photo")?;
    let file_column = table.need(&["file"])?;
    let class_column = table.need(&["class", "cls"])?;
    let softness_column = table.need(&["softness"])?;
    let sd_column = table.need(&["softness_sd"])?;
    let source_column = table.need(&["source", "repo"])?;
    let license_column = table.need(&["license", "licence"])?;
    let (author_column, note_column) = (table.find(&["author"]), table.find(&["note"]));
    let mut read = PhotoTable { classes: Vec::new(), sources: Vec::new(), photos: Vec::new() };
    let mut lines: HashMap<&str, u64> = HashMap::new();
    let mut classes: HashMap<&str, (usize, u64)> = HashMap::new();
    let mut sources: HashMap<&str, usize> = HashMap::new();
    for row in table.rows() {
        let line = row.line();
        let file = row.at(file_column).word()?;
        if !is_below(file) {
            return Err(PhotoTableError::Path { line, file: file.to_owned() });
        }
        if let Some(first) = lines.insert(file, line) {
            return Err(PhotoTableError::Twice { file: file.to_owned(), first, line });
        }
        let name = row.at(class_column).word()?;
        let softness = within(row.at(softness_column), 0.0, 100.0)?;
        let softness_sd = within(row.at(sd_column), MIN_SD, MAX_SD)?;
        let (class, first) = *classes.entry(name).or_insert_with(|| {
            read.classes.push(PhotoClass { name: name.to_owned(), softness, softness_sd });
            (read.classes.len() - 1, line)
        });
        let of_class = &read.classes[class];
        if [of_class.softness, of_class.softness_sd] != [softness, softness_sd] {
            return Err(PhotoTableError::TwoLabels { class: name.to_owned(), first, line });
        }
        let source = row.at(source_column).word()?;
        let source = *sources.entry(source).or_insert_with(|| {
            read.sources.push(source.to_owned());
            read.sources.len() - 1
        });
        let optional = |column: Option<usize>| column.map_or("", |column| row.at(column).text()).to_owned();
        read.photos.push(LabelledPhoto {
            file: file.to_owned(),
            class,
            source,
            license: row.at(license_column).word()?.to_owned(),
            author: optional(author_column),
            note: optional(note_column),
        });
    }
    Ok(read)
}

impl PhotoTable {
    /// Returns the table of the photos for which `is_kept` holds, without classes and sources that have none of them.
    #[must_use]
    pub fn filtered(&self, is_kept: impl Fn(&LabelledPhoto) -> bool) -> Self {
        let mut kept = Self { classes: Vec::new(), sources: Vec::new(), photos: Vec::new() };
        let mut classes = vec![None; self.classes.len()];
        let mut sources = vec![None; self.sources.len()];
        for photo in self.photos.iter().filter(|photo| is_kept(photo)) {
            let class = *classes[photo.class].get_or_insert_with(|| {
                kept.classes.push(self.classes[photo.class].clone());
                kept.classes.len() - 1
            });
            let source = *sources[photo.source].get_or_insert_with(|| {
                kept.sources.push(self.sources[photo.source].clone());
                kept.sources.len() - 1
            });
            kept.photos.push(LabelledPhoto { class, source, ..photo.clone() });
        }
        kept
    }
}

/// Returns whether a path leads to a file below the folder that it starts from.
fn is_below(path: &str) -> bool {
    let mut components = Path::new(path).components().peekable();
    components.peek().is_some() && components.all(|part| matches!(part, Component::Normal(_)))
}

/// Returns the number in a field.
fn within(field: Field<'_>, low: f64, high: f64) -> Result<f64, PhotoTableError> {
    let blank = || NamedTableError::Blank { line: field.line(), column: field.name().to_owned() };
    let value = field.number()?.ok_or_else(blank)?;
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(PhotoTableError::Range { column: field.name().to_owned(), line: field.line(), value, low, high })
}

#[cfg(test)]
mod tests {
    use super::{PhotoClass, read_photo_table};

    const TABLE: &str = "file,cls,repo,path,licence,author,softness,softness_sd,note\n\
        a.jpg,brick,mine,x,CC0,Ann,9,7,\n\
        sub/b.jpg,carpet,mine,x,CC-BY 4.0,Ben,85,8,by hand\n\
        c.png,brick,theirs,,MIT,,9,7,no provenance\n";

    #[test]
    fn photos_are_read_with_classes_and_sources() {
        let table = read_photo_table(TABLE.as_bytes()).unwrap();
        let brick = PhotoClass { name: "brick".to_owned(), softness: 9.0, softness_sd: 7.0 };
        assert_eq!((table.classes.len(), &table.classes[0]), (2, &brick));
        assert_eq!(table.sources, ["mine", "theirs"]);
        let of: Vec<(&str, usize, usize)> =
            table.photos.iter().map(|photo| (photo.file.as_str(), photo.class, photo.source)).collect();
        assert_eq!(of, [("a.jpg", 0, 0), ("sub/b.jpg", 1, 0), ("c.png", 0, 1)]);
        let last = &table.photos[2];
        assert_eq!(
            (last.license.as_str(), last.author.as_str(), last.note.as_str()),
            ("MIT", "", "no provenance")
        );
        // The names of the columns in other words, without those that may be missing.
        let short = "file;class;softness;softness_sd;source;license\nx.jpg;felt;70,5;9;s;CC0\n";
        let short = read_photo_table(short.as_bytes()).unwrap();
        assert_eq!((short.classes[0].softness, short.photos[0].note.as_str()), (70.5, ""));
    }

    #[test]
    fn photos_are_left_out_with_their_classes_and_sources() {
        let table = read_photo_table(TABLE.as_bytes()).unwrap();
        let kept = table.filtered(|photo| photo.source == 1);
        assert_eq!((kept.classes.len(), kept.sources.len(), kept.photos.len()), (1, 1, 1));
        assert_eq!((kept.photos[0].class, kept.photos[0].source), (0, 0));
        let carpet = table.filtered(|photo| photo.note == "by hand");
        assert_eq!((carpet.classes[0].name.as_str(), carpet.photos[0].class), ("carpet", 0));
        assert_eq!(table.filtered(|_| true), table);
        assert!(table.filtered(|_| false).photos.is_empty());
    }

    #[test]
    fn what_cannot_be_used_says_where() {
        let check = |line: &str, words: &str| {
            let message = read_photo_table(format!("{TABLE}{line}\n").as_bytes()).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        check("a.jpg,brick,mine,x,CC0,Ann,9,7,", "\"a.jpg\" is in line 2 and again in line 5");
        check("d.jpg,brick,mine,x,CC0,Ann,10,7,", "the softness of \"brick\" in line 5 differs from that in");
        check("d.jpg,felt,mine,x,CC0,Ann,101,7,", "softness in line 5 is 101; it must be 0 to 100");
        check("d.jpg,felt,mine,x,CC0,Ann,70,0,", "softness_sd in line 5 is 0; it must be 0.1 to 50");
        check("d.jpg,felt,mine,x,CC0,Ann,soft,7,", "softness in line 5 is \"soft\", not a number");
        check("d.jpg,felt,mine,x,CC0,Ann,,7,", "line 5 has no softness");
        check("d.jpg,,mine,x,CC0,Ann,70,7,", "line 5 has no cls");
        check("d.jpg,felt,,x,CC0,Ann,70,7,", "line 5 has no repo");
        check("d.jpg,felt,mine,x,,Ann,70,7,", "line 5 has no licence");
        for path in ["../d.jpg", "/d.jpg", "sub/../../d.jpg"] {
            check(&format!("{path},felt,mine,x,CC0,Ann,70,7,"), "without \"..\"");
        }
        let message = read_photo_table(b"file,class\na,b\n").unwrap_err().to_string();
        assert!(message.contains("no column is named \"softness\""), "{message}");
        assert!(read_photo_table(b"").unwrap_err().to_string().contains("one row per photo"));
    }
}
