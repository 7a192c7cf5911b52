//! Attribute values of a texture, and the names of the axes of a space, which may be attributes.

use serde_json::Value;
use shagreen_core::space::{LabelSource, MOST_AXES};

use crate::library::numbers::{DIGITS, digits};
use crate::library::v1::{AttributeV1, AttributesV1};
use crate::library::{Library, LibraryError, USUAL_AXES, Unknown};

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
pub(crate) fn axes(wire: Option<Vec<String>>) -> Result<Option<Vec<String>>, LibraryError> {
    match wire {
        Some(names) if !are_axes(&names) => Err(LibraryError::Axes),
        names => Ok(names),
    }
}

/// Returns whether names can be those of the axes of a space: one to six, none empty, and no two equal, ignoring case.
pub(crate) fn are_axes<S: AsRef<str>>(names: &[S]) -> bool {
    let is_sound = |(index, name): (usize, &S)| {
        let name: &str = name.as_ref();
        let mut others = names[..index].iter().map(AsRef::as_ref);
        !name.trim().is_empty() && others.all(|other: &str| !other.eq_ignore_ascii_case(name))
    };
    (1..=MOST_AXES).contains(&names.len()) && names.iter().enumerate().all(is_sound)
}

/// Axes of a library that is read from a file: those that the file states, or else those of the space report. Before version
/// 1.3, only the report held them.
pub(super) fn axes_in_file(stated: Option<Vec<String>>, report: Option<&Value>) -> Option<Vec<String>> {
    let of_report = report.and_then(axes_of_report);
    match stated {
        // Stated only because the report names others; see `axes_for_file`.
        Some(names) if of_report.is_some() && is_usual(&names) => None,
        Some(names) => Some(names),
        None => of_report,
    }
}

/// Axes that a file of a library must state, so that [`axes_in_file`] gives those of the library again.
pub(super) fn axes_for_file(library: &Library) -> Option<Vec<String>> {
    let names_others = library.space_report.as_ref().and_then(axes_of_report).is_some();
    let usual = || names_others.then(|| USUAL_AXES.map(str::to_owned).to_vec());
    library.axes.clone().or_else(usual)
}

/// Returns the axis names in a space report, if they differ from [`USUAL_AXES`].
fn axes_of_report(report: &Value) -> Option<Vec<String>> {
    let names = [0, 1].map(|axis| report["axes"][axis]["name"].as_str());
    let [Some(first), Some(second)] = names else { return None };
    let names = [first, second].map(|name| name.trim().to_owned()).to_vec();
    let is_sound = names.iter().all(|name| !name.is_empty()) && names[0] != names[1];
    (is_sound && !is_usual(&names)).then_some(names)
}

/// Returns whether these are [`USUAL_AXES`], ignoring case.
pub(crate) fn is_usual(names: &[String]) -> bool {
    names.len() == USUAL_AXES.len()
        && names.iter().zip(USUAL_AXES).all(|(name, usual)| name.eq_ignore_ascii_case(usual))
}

/// Validates the space report of a file, which must be an object if present.
pub(super) fn report(wire: Option<Value>) -> Result<Option<Value>, LibraryError> {
    match wire {
        None | Some(Value::Object(_)) => Ok(wire),
        Some(_) => Err(LibraryError::Report),
    }
}
