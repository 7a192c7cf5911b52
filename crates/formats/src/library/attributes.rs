//! Attribute values of a texture; two of the attributes may be the axes of a space.

use serde_json::Value;
use shagreen_core::space::LabelSource;

use crate::library::numbers::{DIGITS, digits};
use crate::library::v1::{AttributeV1, AttributesV1};
use crate::library::{LibraryError, USUAL_AXES, Unknown};

/// Attribute values of a texture with their label source.
#[derive(Clone, Debug, PartialEq)]
pub struct Attributes {
    /// What the values were derived from.
    pub source: LabelSource,
    /// The values, in the axis order of their space. Names are unique.
    pub values: Vec<Attribute>,
}

/// The value of one attribute.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name of the attribute: its two poles joined by a hyphen, such as `rough-smooth`.
    pub name: String,
    /// 0 at the first pole, 100 at the second.
    pub value: f64,
}

impl Attributes {
    /// Returns the value of the attribute with this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.values.iter().find(|attribute| attribute.name == name).map(|attribute| attribute.value)
    }
}

/// Converts and validates the attributes of a file.
pub(crate) fn read(id: &str, wire: AttributesV1, unknown: &mut Unknown) -> Result<Attributes, LibraryError> {
    let source = LabelSource::from_id(&wire.label_source)
        .ok_or_else(|| LibraryError::LabelSource { id: id.to_owned(), found: wire.label_source })?;
    unknown.attributes = wire.unknown;
    let mut values: Vec<Attribute> = Vec::new();
    for AttributeV1 { name, value, unknown: more } in wire.values {
        let failed =
            |reason: &'static str| LibraryError::Attribute { id: id.to_owned(), name: name.clone(), reason };
        if name.trim().is_empty() {
            return Err(failed("it has no name"));
        }
        if !(0.0..=100.0).contains(&value) {
            return Err(failed("its value is not between 0 and 100"));
        }
        if values.iter().any(|other| other.name == name) {
            return Err(failed("it is listed twice"));
        }
        values.push(Attribute { name, value });
        unknown.values.push(more);
    }
    Ok(Attributes { source, values })
}

/// Converts attributes to the form of a file.
pub(crate) fn write(attributes: &Attributes, unknown: &Unknown) -> AttributesV1 {
    let n_values = attributes.values.len();
    // Unknown fields are only kept while the number of values is unchanged.
    let more = |i: usize| unknown.values.get(i).filter(|_| unknown.values.len() == n_values).cloned();
    let wire = |(i, a): (usize, &Attribute)| AttributeV1 {
        name: a.name.clone(),
        value: digits(a.value, DIGITS),
        unknown: more(i).unwrap_or_default(),
    };
    AttributesV1 {
        label_source: attributes.source.id().to_owned(),
        values: attributes.values.iter().enumerate().map(wire).collect(),
        unknown: unknown.attributes.clone(),
    }
}

/// Validates the axis names of a file.
pub(crate) fn axes(wire: Option<Vec<String>>) -> Result<Option<[String; 2]>, LibraryError> {
    let Some(names) = wire else { return Ok(None) };
    let axes: [String; 2] = names.try_into().map_err(|_| LibraryError::Axes)?;
    let is_empty = axes.iter().any(|name| name.trim().is_empty());
    if is_empty || axes[0].eq_ignore_ascii_case(&axes[1]) { Err(LibraryError::Axes) } else { Ok(Some(axes)) }
}

/// Returns the axis names in a space report, if they differ from [`USUAL_AXES`].
pub(super) fn axes_of_report(report: &Value) -> Option<[String; 2]> {
    let names = [0, 1].map(|axis| report["axes"][axis]["name"].as_str());
    let [Some(first), Some(second)] = names else { return None };
    let names = [first, second].map(|name| name.trim().to_owned());
    let is_sound = names.iter().all(|name| !name.is_empty()) && names[0] != names[1];
    (is_sound && !is_usual(&names)).then_some(names)
}

/// Returns whether these are [`USUAL_AXES`], ignoring case.
pub(crate) fn is_usual(names: &[String; 2]) -> bool {
    names.iter().zip(USUAL_AXES).all(|(name, usual)| name.eq_ignore_ascii_case(usual))
}

/// Validates the space report of a file, which must be an object if present.
pub(super) fn report(wire: Option<Value>) -> Result<Option<Value>, LibraryError> {
    match wire {
        None | Some(Value::Object(_)) => Ok(wire),
        Some(_) => Err(LibraryError::Report),
    }
}
