//! Positions of textures as a table: `id`, `rs` and `hs` from 0 to 100, and any further attribute by its two poles.
//!
//! ```csv
//! id,rs,hs,flat-bumpy,source
//! cork,40.5,71,33,human
//! ```
//!
//! `source` states what the positions were derived from: `human`, `simulated`, `physical` or `estimated`. Without this
//! column, the source that the caller states applies to the whole table. Without `rs` and `hs`, the columns
//! `rough-smooth` and `hard-soft` hold the position. The axes of a space may be other attributes: the position columns
//! are then named `x:` and `y:` followed by the attribute, such as `x:warm-cold`. A table on another [`Scale`] is
//! converted to 0 to 100. Other columns are not used.

use std::collections::HashMap;

use shagreen_core::people::ratings::{PairNameError, SHORT_SCALE};
use shagreen_core::space::{LabelSource, SpacePoint};

use crate::imported::Imported;
use crate::label_source_text::state_origin_of_places;
use crate::library::{Attribute, Attributes, DIGITS, Library, Place, USUAL_AXES, digits, is_usual};
use crate::named_table::{Field, NamedTable, NamedTableError, write_table};
use crate::pair_columns::{NAME_BOTH_POLES, is_attribute, pair_columns, unused_warning};

/// The scale of the values in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
}

/// Why two numbers do not form a scale.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the low end of a scale must be below its high end, but they are {low} and {high}; correct them")]
pub struct ScaleError {
    /// The first number.
    pub low: f64,
    /// The second number.
    pub high: f64,
}

impl Scale {
    /// The scale of a space, from 0 to 100.
    pub const OF_SPACE: Self = Self { low: 0.0, high: 100.0 };

    /// A scale from `low` to `high`.
    ///
    /// # Errors
    /// [`ScaleError`] unless both numbers and their difference are finite, and `high` exceeds `low`.
    pub fn new(low: f64, high: f64) -> Result<Self, ScaleError> {
        if (high - low).is_finite() && high > low {
            Ok(Self { low, high })
        } else {
            Err(ScaleError { low, high })
        }
    }

    /// Returns whether a value lies on the scale.
    pub fn contains(self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Converts a value of the scale to 0..100.
    pub fn to_space(self, value: f64) -> f64 {
        if self == Self::OF_SPACE {
            return value;
        }
        // Rounding must not exceed the range of the space.
        (100.0 * ((value - self.low) / (self.high - self.low))).clamp(0.0, 100.0)
    }
}

/// The position of a texture, and its attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Identifier of the texture.
    pub id: String,
    /// Position in the space.
    pub place: Place,
    /// Values of all attributes in the table, the two axes first.
    pub attributes: Attributes,
}

/// Positions of textures from a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Names of the two axes, if they are not [`USUAL_AXES`].
    pub axes: Option<[String; 2]>,
    /// The textures.
    pub placements: Vec<Placement>,
}

/// Why a table holds no positions.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlacesCsvError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A texture is listed twice.
    #[error("\"{id}\" has a position in line {first} and again in line {line}; remove one of the two lines")]
    Twice {
        /// Identifier of the texture.
        id: String,
        /// The first line, from one.
        first: u64,
        /// The second line, from one.
        line: u64,
    },
    /// A coordinate is empty.
    #[error("{column} of \"{id}\" is empty in line {line}; fill it in, or remove the line")]
    Blank {
        /// Identifier of the texture.
        id: String,
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
    },
    /// A value is outside the scale.
    #[error(
        "{column} in line {line} is {value}; it must be between {low} and {high}; correct it, or state the scale of the table"
    )]
    Range {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// The value.
        value: f64,
        /// Low end of the scale.
        low: f64,
        /// High end of the scale.
        high: f64,
    },
    /// An attribute value is not a number.
    #[error(
        "{column} in line {line} is \"{found}\", not a number; if the column is not an adjective pair, remove it, or rename it to one word"
    )]
    NotAValue {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// Text of the field.
        found: String,
    },
    /// A column name can be split into two adjectives in several ways.
    #[error("line {line}: {source}")]
    Pair {
        /// The line, from one.
        line: u64,
        /// What is wrong.
        source: PairNameError,
    },
    /// Only one of the two axes is named.
    #[error(
        "the column \"{column}\" is one axis of a position; name the other axis column too, as \"{missing}\" followed by its attribute"
    )]
    HalfAPlace {
        /// Name of the existing axis column.
        column: String,
        /// Prefix of the missing column name.
        missing: &'static str,
    },
    /// Both axes have the same name.
    #[error("both axes are \"{name}\"; use two different attributes, such as x:warm-cold and y:flat-bumpy")]
    OneAxis {
        /// The name.
        name: String,
    },
    /// A label source is unknown.
    #[error("source in line {line} is \"{found}\"; use human, simulated, physical or estimated")]
    Source {
        /// The line, from one.
        line: u64,
        /// Text of the field.
        found: String,
    },
    /// The label source is not stated.
    #[error(
        "the source of the positions is not stated; add a column `source` with human, simulated, physical or estimated, or state one source for the whole table"
    )]
    NoSource,
}

/// Prefixes of position columns on other axes than the usual ones.
const PLACE_ON: [&str; 2] = ["x:", "y:"];
/// Short names of the columns of the usual axes.
const SHORT: [&str; 2] = ["rs", "hs"];

/// Reads a table of positions on a scale. `source` applies to rows without their own. Unused columns raise a warning.
///
/// # Errors
/// See [`PlacesCsvError`].
pub fn read_places(
    bytes: &[u8],
    source: Option<LabelSource>,
    scale: Scale,
) -> Result<Imported<Places>, PlacesCsvError> {
    let table = NamedTable::read(bytes, "id, rs, hs", "texture")?;
    let id_column = table.need(&["id", "texture", "texture_id", "name"])?;
    let (place_columns, axes) = place_columns(&table)?;
    let [across, up] = place_columns;
    let names = axes.as_ref().map_or(USUAL_AXES, |axes| axes.each_ref().map(String::as_str));
    let source_column = table.find(&["source", "label_source"]);
    let others = table.others(&[Some(id_column), Some(across), Some(up), source_column]);
    let columns = pair_columns(&table, &others, |field| value(field, scale).is_ok())
        .map_err(|source| PlacesCsvError::Pair { line: table.first_line, source })?;
    // An attribute may have a one-word name, unlike a rated adjective pair.
    let of_one_word =
        |column: &usize| is_attribute(&table, *column, |field| value(field, scale).ok().flatten());
    let (single, unused): (Vec<usize>, Vec<usize>) =
        columns.unused.iter().partition(|column| of_one_word(column));
    let mut attribute_columns: Vec<usize> =
        columns.pairs.iter().map(|(column, _)| *column).chain(single).collect();
    attribute_columns.sort_unstable();
    let mut placements = Vec::new();
    let mut lines: HashMap<&str, u64> = HashMap::new();
    for row in table.rows() {
        let (id, line) = (row.at(id_column).word()?, row.line());
        if let Some(first) = lines.insert(id, line) {
            return Err(PlacesCsvError::Twice { id: id.to_owned(), first, line });
        }
        let needed = |field: Field<'_>| -> Result<f64, PlacesCsvError> {
            let blank = || PlacesCsvError::Blank { id: id.to_owned(), column: field.name().to_owned(), line };
            in_scale(field, field.number()?.ok_or_else(blank)?, scale)
        };
        let point = SpacePoint { rough_smooth: needed(row.at(across))?, hard_soft: needed(row.at(up))? };
        let stated = source_column.map(|column| row.at(column).text()).filter(|text| !text.is_empty());
        let source = match stated {
            Some(text) => LabelSource::from_id(&text.to_lowercase())
                .ok_or_else(|| PlacesCsvError::Source { line, found: text.to_owned() })?,
            None => source.ok_or(PlacesCsvError::NoSource)?,
        };
        let axis = |name: &str, value: f64| Attribute { name: name.to_owned(), value };
        let mut values = Vec::new();
        for (name, value) in names.into_iter().zip([point.rough_smooth, point.hard_soft]) {
            // If the table also has this attribute as a column, its rated value is kept; it may differ from the
            // position.
            if attribute_columns.iter().all(|column| !row.at(*column).name().eq_ignore_ascii_case(name)) {
                values.push(axis(name, value));
            }
        }
        for column in &attribute_columns {
            let field = row.at(*column);
            if let Some(value) = value(field, scale)? {
                values.push(axis(field.name(), value));
            }
        }
        let attributes = Attributes { source, values };
        placements.push(Placement { id: id.to_owned(), place: Place::new(point, source), attributes });
    }
    let warning = unused_warning(&table, &unused, NAME_BOTH_POLES);
    Ok(Imported { value: Places { axes, placements }, warnings: warning.into_iter().collect() })
}

/// Returns the position columns, and the axis names if they are not the usual ones.
fn place_columns(table: &NamedTable) -> Result<([usize; 2], Option<[String; 2]>), PlacesCsvError> {
    let named = PLACE_ON.map(|prefix| {
        table.columns.iter().enumerate().find_map(|(column, name)| {
            let start = name.get(..prefix.len()).filter(|start| start.eq_ignore_ascii_case(prefix))?;
            let name = name[start.len()..].trim();
            (!name.is_empty()).then(|| (column, name.to_owned()))
        })
    });
    if let [Some((across, first)), Some((up, second))] = named {
        if first.eq_ignore_ascii_case(&second) {
            return Err(PlacesCsvError::OneAxis { name: first });
        }
        let axes = [first, second];
        return Ok(([across, up], (!is_usual(&axes)).then_some(axes)));
    }
    if let Some((column, _)) = named.iter().flatten().next() {
        let missing = PLACE_ON[usize::from(named[0].is_some())];
        return Err(PlacesCsvError::HalfAPlace { column: table.columns[*column].clone(), missing });
    }
    let needed = |axis: usize| table.need(&[SHORT[axis], USUAL_AXES[axis]]);
    Ok(([needed(0)?, needed(1)?], None))
}

/// Returns the value of an attribute, 0 to 100; `None` if the field is empty.
fn value(field: Field<'_>, scale: Scale) -> Result<Option<f64>, PlacesCsvError> {
    let number = field.number().map_err(|_| PlacesCsvError::NotAValue {
        column: field.name().to_owned(),
        line: field.line(),
        found: field.text().to_owned(),
    })?;
    number.map(|value| in_scale(field, value, scale)).transpose()
}

/// Converts the value of a field to 0..100.
fn in_scale(field: Field<'_>, value: f64, scale: Scale) -> Result<f64, PlacesCsvError> {
    if scale.contains(value) {
        return Ok(scale.to_space(value));
    }
    let (column, line, Scale { low, high }) = (field.name().to_owned(), field.line(), scale);
    Err(PlacesCsvError::Range { column, line, value, low, high })
}

/// Returns the lowest and highest coordinate if several placements look as if they used another scale than 0 to 100:
/// none is above [`SHORT_SCALE`].
pub fn looks_rescaled(placements: &[Placement]) -> Option<(f64, f64)> {
    let all = placements.iter().flat_map(|p| [p.place.at.rough_smooth, p.place.at.hard_soft]);
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    (placements.len() > 1 && high <= SHORT_SCALE).then_some((low, high))
}

/// Assigns the positions and attributes of a table to a library. Returns the identifiers of textures that the table
/// does not list; these lose their position and attributes. The origin text of the library states the label source.
pub fn place_textures(library: &mut Library, places: &Places) -> Vec<String> {
    let Places { axes, placements } = places;
    library.axes.clone_from(axes);
    let mut missing = Vec::new();
    for texture in &mut library.textures {
        let found = placements.iter().find(|placement| placement.id == texture.id);
        texture.place = found.map(|placement| placement.place);
        texture.attributes = found.map(|placement| placement.attributes.clone());
        if found.is_none() {
            missing.push(texture.id.clone());
        }
    }
    state_origin_of_places(library);
    missing
}

/// Writes the positions and attributes of a library as such a table, with attributes in the order of first appearance.
/// Textures without a position are omitted.
pub fn places_csv(library: &Library) -> Vec<u8> {
    let placed = || library.textures.iter().filter_map(|texture| Some((texture, texture.place?)));
    let mut names: Vec<&str> = Vec::new();
    for attribute in placed().flat_map(|(texture, _)| texture.attributes.iter().flat_map(|a| &a.values)) {
        if !names.contains(&attribute.name.as_str()) {
            names.push(&attribute.name);
        }
    }
    let number = |value: f64| format!("{}", digits(value, DIGITS));
    let [across, up] = [0, 1].map(|axis| {
        let named = library.axes.as_ref().map(|axes| format!("{}{}", PLACE_ON[axis], axes[axis]));
        named.unwrap_or_else(|| SHORT[axis].to_owned())
    });
    let first = ["id", &across, &up, "source"].into_iter().chain(names.iter().copied());
    let rows = placed().map(|(texture, place)| {
        let fixed = [
            texture.id.clone(),
            number(place.at.rough_smooth),
            number(place.at.hard_soft),
            place.source.id().to_owned(),
        ];
        let value = |name: &&str| {
            texture.attributes.as_ref().and_then(|a| a.get(name)).map_or_else(String::new, number)
        };
        fixed.into_iter().chain(names.iter().map(value)).collect()
    });
    write_table(std::iter::once(first.map(str::to_owned).collect()).chain(rows))
}

#[cfg(test)]
mod tests {
    use super::{
        Placement, Places, PlacesCsvError, Scale, looks_rescaled, place_textures, places_csv, read_places,
    };
    use crate::starter::starter_library;
    use shagreen_core::space::LabelSource;

    fn read_places_csv(bytes: &[u8], source: Option<LabelSource>) -> Result<Vec<Placement>, PlacesCsvError> {
        read_places(bytes, source, Scale::OF_SPACE).map(|imported| imported.value.placements)
    }

    #[test]
    fn axes_may_be_other_attributes() {
        let text =
            "id,X: warm-cold,y:flat-bumpy,source,warm-cold\ncork,40.5,71,human,39\nfelt,90,95,human,88\n";
        let places = read_places(text.as_bytes(), None, Scale::OF_SPACE).unwrap().value;
        assert_eq!(places.axes, Some(["warm-cold", "flat-bumpy"].map(str::to_owned)));
        let cork = &places.placements[0];
        assert_eq!((cork.place.at.rough_smooth, cork.place.at.hard_soft), (40.5, 71.0));
        assert_eq!(cork.attributes.get("flat-bumpy"), Some(71.0));
        assert_eq!(cork.attributes.get("warm-cold"), Some(39.0));
        assert_eq!(cork.attributes.get("rough-smooth"), None);
        let mut library = starter_library().unwrap();
        place_textures(&mut library, &places);
        assert_eq!(library.axis_names(), ["warm-cold", "flat-bumpy"]);
        let written = places_csv(&library);
        assert!(written.starts_with(b"id,x:warm-cold,y:flat-bumpy,source,"));
        assert_eq!(read_places(&written, None, Scale::OF_SPACE).unwrap().value, places);
        // A table on the usual axes removes the axis names.
        let usual =
            read_places(b"id,x:Rough-Smooth,y:hard-soft,source\ncork,1,2,human\n", None, Scale::OF_SPACE);
        place_textures(&mut library, &usual.unwrap().value);
        assert_eq!(library.axes, None);
        let twice =
            read_places_csv(b"id,x:a-b,y:A-B,source\ncork,1,2,human\n", None).unwrap_err().to_string();
        assert!(twice.contains("both axes"), "{twice}");
        let half = read_places_csv(b"id,x:a-b,hs,source\ncork,1,2,human\n", None).unwrap_err().to_string();
        assert!(half.contains("\"x:a-b\" is one axis") && half.contains("\"y:\""), "{half}");
        let half =
            read_places_csv(b"id,rs,hs,y:a-b,source\ncork,1,2,3,human\n", None).unwrap_err().to_string();
        assert!(half.contains("\"x:\""), "{half}");
    }

    #[test]
    fn places_and_attributes_are_read() {
        let text = "id,rs,hs,flat-bumpy,source\ncork,40.5,71,33,human\nfelt,90,95,,\n";
        let placements = read_places_csv(text.as_bytes(), Some(LabelSource::PhysicalLabels)).unwrap();
        let cork = &placements[0];
        assert_eq!((cork.place.at.rough_smooth, cork.place.at.hard_soft), (40.5, 71.0));
        assert_eq!(cork.place.source, LabelSource::HumanRatings);
        assert_eq!(cork.attributes.get("flat-bumpy"), Some(33.0));
        assert_eq!(cork.attributes.get("hard-soft"), Some(71.0));
        assert_eq!(placements[1].place.source, LabelSource::PhysicalLabels);
        assert_eq!(placements[1].attributes.values.len(), 2);
        let by_poles = "texture;Rough-Smooth;Hard-Soft\ncork;40,5;71\n";
        let placements = read_places_csv(by_poles.as_bytes(), Some(LabelSource::HumanRatings)).unwrap();
        assert_eq!(placements[0].place.at.rough_smooth, 40.5);
    }

    #[test]
    fn a_library_is_placed_again_by_its_own_table() {
        let text =
            "id,rs,hs,source,rough-smooth,flat-bumpy\ncork,40.5,71,human,39,33\nfelt,90,95,simulated,,12.5\n";
        let placements = read_places_csv(text.as_bytes(), None).unwrap();
        assert_eq!(placements[0].attributes.get("rough-smooth"), Some(39.0));
        let mut library = starter_library().unwrap();
        let missing = place_textures(&mut library, &Places { axes: None, placements: placements.clone() });
        assert_eq!((missing.len(), missing.contains(&"cork".to_owned())), (23, false));
        let again = read_places_csv(&places_csv(&library), None).unwrap();
        assert_eq!(again, placements);
    }

    #[test]
    fn another_scale_is_brought_to_that_of_the_space() {
        let text = "id,rs,hs,flat-bumpy\ncork,1,7,\nfelt,4,\"2,5\",6\n";
        let read = |scale| read_places(text.as_bytes(), Some(LabelSource::HumanRatings), scale);
        let placements = read(Scale::new(1.0, 7.0).unwrap()).unwrap().value.placements;
        let at = |i: usize| (placements[i].place.at.rough_smooth, placements[i].place.at.hard_soft);
        assert_eq!((at(0), at(1)), ((0.0, 100.0), (50.0, 25.0)));
        assert_eq!(placements[1].attributes.get("rough-smooth"), Some(50.0));
        assert!((placements[1].attributes.get("flat-bumpy").unwrap() - 500.0 / 6.0).abs() < 1e-12);
        assert_eq!(looks_rescaled(&placements), None);
        assert_eq!(looks_rescaled(&read(Scale::OF_SPACE).unwrap().value.placements), Some((1.0, 7.0)));
        assert_eq!(looks_rescaled(&read(Scale::OF_SPACE).unwrap().value.placements[..1]), None);
        let message = read(Scale::new(1.0, 6.0).unwrap()).unwrap_err().to_string();
        assert!(message.contains("hs in line 2 is 7; it must be between 1 and 6"), "{message}");
        for (low, high) in [(7.0, 1.0), (1.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-1e308, 1e308)] {
            assert!(Scale::new(low, high).is_err(), "{low} {high}");
        }
        // Rounding stays within both the space and the scale of the table.
        let odd = Scale::new(0.1, 0.7).unwrap();
        assert_eq!((odd.to_space(0.1), odd.to_space(0.7)), (0.0, 100.0));
        assert_eq!(Scale::OF_SPACE.to_space(28.999_999_999_999_996), 28.999_999_999_999_996);
    }

    #[test]
    fn other_columns_are_named_and_not_used() {
        let text = "id,rs,hs,warm,color,flat-bumpy,start-time,age\ncork,40,71,5,red,33,12:30,5\n";
        let read = read_places(text.as_bytes(), Some(LabelSource::HumanRatings), Scale::OF_SPACE).unwrap();
        let names: Vec<&str> =
            read.value.placements[0].attributes.values.iter().map(|a| a.name.as_str()).collect();
        assert_eq!(names, ["rough-smooth", "hard-soft", "warm", "flat-bumpy"]);
        assert!(read.warnings[0].starts_with("the columns color, start-time, age are not used;"), "{read:?}");
    }

    #[test]
    fn what_places_nothing_says_why() {
        let check = |text: &str, words: &str| {
            let message = read_places_csv(text.as_bytes(), Some(LabelSource::HumanRatings)).unwrap_err();
            assert!(message.to_string().contains(words), "{message}");
        };
        check("id,rs,hs\na,1,2\na,3,4\n", "line 2 and again in line 3");
        check("id,rs,hs\na,,2\n", "rs of \"a\" is empty");
        check("id,rs,hs\na,101,2\n", "rs in line 2 is 101; it must be between 0 and 100");
        check("id,rs,hs,warm-cold\na,1,2,-3\n", "warm-cold in line 2 is -3");
        check("id,rs,hs,warm-cold\na,1,2,12:30\n", "warm-cold in line 2 is \"12:30\"");
        check("id,rs,hs,so-so-so\na,1,2,3\n", "line 1: \"so-so-so\" can be split");
        check("id,rs,hs,source\na,1,2,me\n", "human, simulated, physical or estimated");
        check("id,rs\na,1\n", "\"hs\"");
        let unsaid = read_places_csv(b"id,rs,hs\na,1,2\n", None).unwrap_err();
        assert!(unsaid.to_string().contains("column `source`"));
    }
}
