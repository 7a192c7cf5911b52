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
//! are then named `x:` and `y:` followed by the attribute, such as `x:warm-cold`. Further axes, up to six, have the columns
//! `z:`, `u:`, `v:` and `w:`, in this order, such as `z:sticky-slippery`. A space with one axis has only `x:`. Instead of the
//! letters, `axis1:` to `axis6:` are read too. A table on another [`Scale`] is converted to 0 to 100. Other columns are not
//! used.

use std::collections::HashMap;

use shagreen_core::people::ratings::{PairNameError, SHORT_SCALE};
use shagreen_core::space::{LabelSource, MOST_AXES, SpacePoint, SpacePointError};

use crate::imported::Imported;
use crate::label_source_text::state_origin_of_places;
use crate::library::{
    Attribute, Attributes, DIGITS, Library, Place, USUAL_AXES, digits, is_usual, names_or_usual,
};
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

    /// Returns the low and the high end.
    pub fn ends(self) -> [f64; 2] {
        [self.low, self.high]
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
    /// Values of all attributes in the table, the axes first.
    pub attributes: Attributes,
}

/// Positions of textures from a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Names of the axes, if they are not [`USUAL_AXES`].
    pub axes: Option<Vec<String>>,
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
    /// An axis is named, but not the one before it, or only the second one.
    #[error(
        "the column \"{column}\" is one axis of a position; name the other axis column too, as \"{missing}\" followed by its attribute"
    )]
    HalfAPlace {
        /// Name of the existing axis column.
        column: String,
        /// Prefix of the missing column name.
        missing: &'static str,
    },
    /// Two axes have the same name.
    #[error("both axes are \"{name}\"; use two different attributes, such as x:warm-cold and y:flat-bumpy")]
    OneAxis {
        /// The name.
        name: String,
    },
    /// The coordinates of a texture are not those of a position.
    #[error(transparent)]
    Point(#[from] SpacePointError),
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

/// Prefixes of position columns on other axes than the two usual ones.
const PLACE_ON: [&str; MOST_AXES] = ["x:", "y:", "z:", "u:", "v:", "w:"];
/// Other prefixes of the same columns, which are read but not written.
const NUMBERED: [&str; MOST_AXES] = ["axis1:", "axis2:", "axis3:", "axis4:", "axis5:", "axis6:"];
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
    let names = names_or_usual(axes.as_deref());
    let source_column = table.find(&["source", "label_source"]);
    let taken: Vec<Option<usize>> =
        [Some(id_column), source_column].into_iter().chain(place_columns.iter().copied().map(Some)).collect();
    let others = table.others(&taken);
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
        let coordinates: Vec<f64> =
            place_columns.iter().map(|column| needed(row.at(*column))).collect::<Result<_, _>>()?;
        let stated = source_column.map(|column| row.at(column).text()).filter(|text| !text.is_empty());
        let source = match stated {
            Some(text) => LabelSource::from_id(&text.to_lowercase())
                .ok_or_else(|| PlacesCsvError::Source { line, found: text.to_owned() })?,
            None => source.ok_or(PlacesCsvError::NoSource)?,
        };
        let axis = |name: &str, value: f64| Attribute { name: name.to_owned(), value };
        let mut values = Vec::new();
        for (name, value) in names.iter().zip(&coordinates) {
            // If the table also has this attribute as a column, its rated value is kept; it may differ from the
            // position.
            if attribute_columns.iter().all(|column| !row.at(*column).name().eq_ignore_ascii_case(name)) {
                values.push(axis(name, *value));
            }
        }
        for column in &attribute_columns {
            let field = row.at(*column);
            if let Some(value) = value(field, scale)? {
                values.push(axis(field.name(), value));
            }
        }
        let attributes = Attributes { source, values };
        let place = Place::new(SpacePoint::of(&coordinates)?, source);
        placements.push(Placement { id: id.to_owned(), place, attributes });
    }
    let warning = unused_warning(&table, &unused, NAME_BOTH_POLES);
    Ok(Imported { value: Places { axes, placements }, warnings: warning.into_iter().collect() })
}

/// A column of positions, with the name of its axis.
type PlaceColumn = (usize, String);

/// Returns the position columns, in the order of the axes, and the axis names if they are not the usual ones.
fn place_columns(table: &NamedTable) -> Result<(Vec<usize>, Option<Vec<String>>), PlacesCsvError> {
    let column_of = |prefix: &str| {
        table.columns.iter().enumerate().find_map(|(column, name)| {
            let start = name.get(..prefix.len()).filter(|start| start.eq_ignore_ascii_case(prefix))?;
            let name = name[start.len()..].trim();
            (!name.is_empty()).then(|| (column, name.to_owned()))
        })
    };
    let mut named: [Option<PlaceColumn>; MOST_AXES] =
        std::array::from_fn(|axis| column_of(PLACE_ON[axis]).or_else(|| column_of(NUMBERED[axis])));
    let usual = [0, 1].map(|axis| table.find(&[SHORT[axis], USUAL_AXES[axis]]));
    if named[..2].iter().all(Option::is_none) {
        for (axis, name) in USUAL_AXES.into_iter().enumerate() {
            let column = table.need(&[SHORT[axis], name])?;
            named[axis] = Some((column, name.to_owned()));
        }
    }
    let n_axes = named.iter().take_while(|column| column.is_some()).count();
    let after = named.iter().skip(n_axes).flatten().next();
    // One axis is a space, unless the table has a column of the second usual axis.
    let half = if n_axes == 1 && usual.iter().any(Option::is_some) { named[0].as_ref() } else { None };
    if let Some((column, _)) = after.or(half) {
        let column = table.columns[*column].clone();
        return Err(PlacesCsvError::HalfAPlace { column, missing: PLACE_ON[n_axes] });
    }
    let (columns, names): (Vec<usize>, Vec<String>) = named.into_iter().flatten().unzip();
    for (index, name) in names.iter().enumerate() {
        if names[..index].iter().any(|other| other.eq_ignore_ascii_case(name)) {
            return Err(PlacesCsvError::OneAxis { name: names[index].clone() });
        }
    }
    let axes = (!is_usual(&names)).then_some(names);
    Ok((columns, axes))
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
    let all = placements.iter().flat_map(|p| p.place.at.coordinates());
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
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
    let axes: Vec<String> = match &library.axes {
        Some(axes) => PLACE_ON.iter().zip(axes).map(|(prefix, name)| format!("{prefix}{name}")).collect(),
        None => SHORT.map(str::to_owned).to_vec(),
    };
    let first = ["id"]
        .into_iter()
        .chain(axes.iter().map(String::as_str))
        .chain(["source"])
        .chain(names.iter().copied());
    let rows = placed().map(|(texture, place)| {
        // A row has as many fields as the first line.
        let at = place.at.on(axes.len());
        let coordinates = at.coordinates().iter().map(|coordinate| number(*coordinate));
        let source = place.source.id().to_owned();
        let fixed: Vec<String> =
            [texture.id.clone()].into_iter().chain(coordinates).chain([source]).collect();
        let value = |name: &&str| {
            texture.attributes.as_ref().and_then(|a| a.get(name)).map_or_else(String::new, number)
        };
        fixed.into_iter().chain(names.iter().map(value)).collect()
    });
    write_table(std::iter::once(first.map(str::to_owned).collect()).chain(rows))
}

#[cfg(test)]
mod tests;
