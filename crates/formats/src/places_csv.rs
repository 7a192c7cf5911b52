//! Places of textures as a table: `id`, `rs` and `hs` from 0 to 100, and any further attribute by its two poles.
//!
//! ```csv
//! id,rs,hs,flat-bumpy,source
//! cork,40.5,71,33,human
//! ```
//!
//! `source` says what the places were derived from: `human`, `simulated` or `physical`; where there is no such column, the
//! whole table has the one that the caller states. Without `rs` and `hs`, the columns `rough-smooth` and `hard-soft` are
//! the place.

use std::collections::HashMap;

use shagreen_core::space::{LabelSource, SpacePoint, SpacePointError};

use crate::library::{Attribute, Attributes, DIGITS, Library, Place, digits};
use crate::named_table::{Field, NamedTable, NamedTableError, write_table};

/// Where a texture lies, and its attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Identifier of the texture.
    pub id: String,
    /// Where it lies.
    pub place: Place,
    /// Its values on all attributes of the table, the two axes first.
    pub attributes: Attributes,
}

/// Why a table places nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlacesCsvError {
    /// It cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A texture is there twice.
    #[error("\"{id}\" is placed in line {first} and again in line {line}; keep one of the two")]
    Twice {
        /// Identifier of the texture.
        id: String,
        /// The first line, from one.
        first: u64,
        /// The second.
        line: u64,
    },
    /// A place has no number.
    #[error("{column} of \"{id}\" is empty in line {line}; fill it in, or remove the line")]
    Blank {
        /// Identifier of the texture.
        id: String,
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
    },
    /// A place lies outside the square.
    #[error("line {line}: {source}")]
    Place {
        /// The line, from one.
        line: u64,
        /// What is wrong.
        source: SpacePointError,
    },
    /// An attribute lies outside its range.
    #[error("{column} in line {line} is {value}; it must lie between 0 and 100")]
    Range {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// The value.
        value: f64,
    },
    /// A source is not known.
    #[error("source in line {line} is \"{found}\"; say human, simulated or physical")]
    Source {
        /// The line, from one.
        line: u64,
        /// What stands there.
        found: String,
    },
    /// Nothing says what the places were derived from.
    #[error(
        "nothing says where the places come from; add a column `source` with human, simulated or physical, or state one for the whole table"
    )]
    NoSource,
}

/// Name of the first axis as an attribute.
pub const ROUGH_SMOOTH: &str = "rough-smooth";
/// Name of the second axis as an attribute.
pub const HARD_SOFT: &str = "hard-soft";

/// Reads a table of places; `source` is that of rows that do not state their own.
///
/// # Errors
/// See [`PlacesCsvError`].
pub fn read_places_csv(bytes: &[u8], source: Option<LabelSource>) -> Result<Vec<Placement>, PlacesCsvError> {
    let table = NamedTable::read(bytes, "id, rs, hs", "texture")?;
    let id_column = table.need(&["id", "texture", "texture_id", "name"])?;
    let rs_column = table.need(&["rs", ROUGH_SMOOTH])?;
    let hs_column = table.need(&["hs", HARD_SOFT])?;
    let source_column = table.find(&["source", "label_source"]);
    let others = table.others(&[Some(id_column), Some(rs_column), Some(hs_column), source_column]);
    let mut placements = Vec::new();
    let mut lines: HashMap<&str, u64> = HashMap::new();
    for row in table.rows() {
        let (id, line) = (row.at(id_column).word()?, row.line());
        if let Some(first) = lines.insert(id, line) {
            return Err(PlacesCsvError::Twice { id: id.to_owned(), first, line });
        }
        let needed = |field: Field<'_>| -> Result<f64, PlacesCsvError> {
            let blank = || PlacesCsvError::Blank { id: id.to_owned(), column: field.name().to_owned(), line };
            field.number()?.ok_or_else(blank)
        };
        let point = SpacePoint::new(needed(row.at(rs_column))?, needed(row.at(hs_column))?)
            .map_err(|source| PlacesCsvError::Place { line, source })?;
        let stated = source_column.map(|column| row.at(column).text()).filter(|text| !text.is_empty());
        let source = match stated {
            Some(text) => LabelSource::from_id(&text.to_lowercase())
                .ok_or_else(|| PlacesCsvError::Source { line, found: text.to_owned() })?,
            None => source.ok_or(PlacesCsvError::NoSource)?,
        };
        let axis = |name: &str, value: f64| Attribute { name: name.to_owned(), value };
        let mut values = Vec::new();
        for (name, value) in [(ROUGH_SMOOTH, point.rough_smooth), (HARD_SOFT, point.hard_soft)] {
            // A table may have the attribute beside the place: what was rated is not where it was put.
            if others.iter().all(|column| !row.at(*column).name().eq_ignore_ascii_case(name)) {
                values.push(axis(name, value));
            }
        }
        for column in &others {
            let field = row.at(*column);
            let Some(value) = field.number()? else { continue };
            if !(0.0..=100.0).contains(&value) {
                return Err(PlacesCsvError::Range { column: field.name().to_owned(), line, value });
            }
            values.push(axis(field.name(), value));
        }
        let attributes = Attributes { source, values };
        placements.push(Placement { id: id.to_owned(), place: Place { at: point, source }, attributes });
    }
    Ok(placements)
}

/// Puts the textures of a library where a table says; returns the identifiers of those that are not in it, which lose
/// their place and attributes.
pub fn place_textures(library: &mut Library, placements: &[Placement]) -> Vec<String> {
    let mut missing = Vec::new();
    for texture in &mut library.textures {
        let found = placements.iter().find(|placement| placement.id == texture.id);
        texture.place = found.map(|placement| placement.place);
        texture.attributes = found.map(|placement| placement.attributes.clone());
        if found.is_none() {
            missing.push(texture.id.clone());
        }
    }
    missing
}

/// The places and attributes of a library as such a table, with the attributes in the order of their first appearance.
/// Textures without a place are not in it.
pub fn places_csv(library: &Library) -> Vec<u8> {
    let placed = || library.textures.iter().filter_map(|texture| Some((texture, texture.place?)));
    let mut names: Vec<&str> = Vec::new();
    for attribute in placed().flat_map(|(texture, _)| texture.attributes.iter().flat_map(|a| &a.values)) {
        if !names.contains(&attribute.name.as_str()) {
            names.push(&attribute.name);
        }
    }
    let number = |value: f64| format!("{}", digits(value, DIGITS));
    let first = ["id", "rs", "hs", "source"].into_iter().chain(names.iter().copied());
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
    use super::{place_textures, places_csv, read_places_csv};
    use crate::starter::starter_library;
    use shagreen_core::space::LabelSource;

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
        let missing = place_textures(&mut library, &placements);
        assert_eq!((missing.len(), missing.contains(&"cork".to_owned())), (23, false));
        let again = read_places_csv(&places_csv(&library), None).unwrap();
        assert_eq!(again, placements);
    }

    #[test]
    fn what_places_nothing_says_why() {
        let check = |text: &str, words: &str| {
            let message = read_places_csv(text.as_bytes(), Some(LabelSource::HumanRatings)).unwrap_err();
            assert!(message.to_string().contains(words), "{message}");
        };
        check("id,rs,hs\na,1,2\na,3,4\n", "line 2 and again in line 3");
        check("id,rs,hs\na,,2\n", "rs of \"a\" is empty");
        check("id,rs,hs\na,101,2\n", "line 2");
        check("id,rs,hs,warm-cold\na,1,2,-3\n", "warm-cold in line 2 is -3");
        check("id,rs,hs,source\na,1,2,me\n", "human, simulated or physical");
        check("id,rs\na,1\n", "\"hs\"");
        let unsaid = read_places_csv(b"id,rs,hs\na,1,2\n", None).unwrap_err();
        assert!(unsaid.to_string().contains("column `source`"));
    }
}
