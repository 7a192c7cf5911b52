//! How a texture is rated on any number of attributes, of which two may be the axes of a space.

use serde_json::Value;
use shagreen_core::space::LabelSource;

use crate::library::v1::{AttributeV1, AttributesV1};
use crate::library::write::{DIGITS, digits};
use crate::library::{LibraryError, USUAL_AXES, Unknown};

/// A texture's values on attributes, which always say where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Attributes {
    /// What they were derived from.
    pub source: LabelSource,
    /// The values, in the order of the axes of the space that they belong to. Names are unique.
    pub values: Vec<Attribute>,
}

/// A value on one attribute.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name of the attribute: its two poles with a hyphen between them, as `rough-smooth`.
    pub name: String,
    /// 0 at the first pole, 100 at the second.
    pub value: f64,
}

impl Attributes {
    /// The value on the attribute of this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.values.iter().find(|attribute| attribute.name == name).map(|attribute| attribute.value)
    }
}

/// The attributes of a file, checked.
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
            return Err(failed("it is there twice"));
        }
        values.push(Attribute { name, value });
        unknown.values.push(more);
    }
    Ok(Attributes { source, values })
}

/// The attributes as a file has them.
pub(crate) fn write(attributes: &Attributes, unknown: &Unknown) -> AttributesV1 {
    let n_values = attributes.values.len();
    // What is not known of values belongs to them only as long as they are the same.
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

/// The names of the axes, as a file has them.
pub(crate) fn axes(wire: Option<Vec<String>>) -> Result<Option<[String; 2]>, LibraryError> {
    let Some(names) = wire else { return Ok(None) };
    let axes: [String; 2] = names.try_into().map_err(|_| LibraryError::Axes)?;
    let is_empty = axes.iter().any(|name| name.trim().is_empty());
    if is_empty || axes[0].eq_ignore_ascii_case(&axes[1]) { Err(LibraryError::Axes) } else { Ok(Some(axes)) }
}

/// The names of the axes that a space was built on, where they are not the usual ones.
pub(super) fn axes_of_report(report: &Value) -> Option<[String; 2]> {
    let names = [0, 1].map(|axis| report["axes"][axis]["name"].as_str());
    let [Some(first), Some(second)] = names else { return None };
    let names = [first, second].map(|name| name.trim().to_owned());
    let is_sound = names.iter().all(|name| !name.is_empty()) && names[0] != names[1];
    (is_sound && !is_usual(&names)).then_some(names)
}

/// Whether these are [`USUAL_AXES`], whatever their case.
pub(crate) fn is_usual(names: &[String; 2]) -> bool {
    names.iter().zip(USUAL_AXES).all(|(name, usual)| name.eq_ignore_ascii_case(usual))
}

/// What a file says of how its space was made: an object, or nothing.
pub(super) fn report(wire: Option<Value>) -> Result<Option<Value>, LibraryError> {
    match wire {
        None | Some(Value::Object(_)) => Ok(wire),
        Some(_) => Err(LibraryError::Report),
    }
}
