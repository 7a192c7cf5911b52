//! Axes of a space: which ones a library knows, positions of its textures on a choice of them, and what each adds.
//!
//! An axis has a name: that of an axis of the positions of a library or of an attribute, each by its two poles (`rough-smooth`),
//! or that of a feature of the vibration (`centroid`). If several have the same name, it is that of the first of these.
//! [`ATTRIBUTE_PREFIX`](shagreen_formats::project::ATTRIBUTE_PREFIX) before a name selects the attribute.

mod columns;

use shagreen_core::people::ratings::poles;
use shagreen_core::space::MOST_AXES;
use shagreen_core::space::axis_evaluation::{AxisCandidate, AxisEvaluation, evaluate_axes};
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_core::texture::TextureModel;
use shagreen_core::words::near;
use shagreen_formats::library::{Library, USUAL_AXES};
use shagreen_formats::placed_space::is_dimension_name;
use shagreen_formats::project::{AddedCoordinates, plain_axis_name};

pub use self::columns::{AxisColumns, AxisSource, list_places};

use self::columns::{Column, column, model, stated_column};
use crate::parallel::in_parallel;

/// Words for 0 and for 100 on a dimension of a perceptual space, before its name.
const DIMENSION_ENDS: [&str; 2] = ["low", "high"];

/// Axis on which at least one texture has a coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownAxis {
    /// Name of the axis.
    pub name: String,
    /// Where its coordinates come from.
    pub source: AxisSource,
    /// Number of textures with a coordinate, at least one.
    pub n_known: usize,
    /// Lowest and highest coordinate of the textures, 0 to 100.
    pub range: [f64; 2],
}

/// Choice of axes with a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AxisPreset {
    /// Name to show.
    pub name: &'static str,
    /// Names of the axes, at most [`MOST_AXES`].
    pub axes: Vec<String>,
}

/// Why a library cannot be placed on axes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AxesError {
    /// There is no axis, or there are too many.
    #[error("a space has 1 to {MOST_AXES} axes, got {n}; choose fewer or more")]
    Count {
        /// Number of names.
        n: usize,
    },
    /// An axis is named twice.
    #[error("the axis \"{name}\" is named twice; name each axis once")]
    Twice {
        /// Name of the axis.
        name: String,
    },
    /// No texture has a coordinate on an axis.
    #[error("no texture has the axis \"{name}\"; {}choose from {}", meant(.near.as_ref()), .known.join(", "))]
    Unknown {
        /// Name of the axis.
        name: String,
        /// The most similar known name, if one is similar.
        near: Option<String>,
        /// Names of all axes of the library.
        known: Vec<String>,
    },
    /// No texture has a coordinate on all axes.
    #[error("no texture has all of the axes {}; leave out some of them", .axes.join(", "))]
    Nothing {
        /// Names of the axes.
        axes: Vec<String>,
    },
}

/// Evaluation of the axes of a library.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluatedAxes {
    /// Names of the candidates, to which the indices of the evaluation refer.
    pub names: Vec<String>,
    /// Errors with one axis more at each step.
    pub found: AxisEvaluation,
}

/// Returns the axes that a library knows, each name once: those of its positions, then its other attributes, then features of the
/// vibration.
pub fn known_axes(library: &Library) -> Vec<KnownAxis> {
    known_columns(library).into_iter().map(|(axis, _)| axis).collect()
}

/// The axes that a library knows, with the coordinates of the textures.
fn known_columns(library: &Library) -> Vec<(KnownAxis, Column)> {
    let attributes = library.textures.iter().filter_map(|texture| texture.attributes.as_ref());
    let attributes = attributes.flat_map(|attributes| &attributes.values).map(|of| of.name.as_str());
    let mut known: Vec<(KnownAxis, Column)> = Vec::new();
    let mut add = |name: &str, source: AxisSource, column: Column| {
        let n_known = column.iter().flatten().count();
        if n_known > 0 && known.iter().all(|(axis, _)| axis.name != name) {
            let around = |[low, high]: [f64; 2], value: &f64| [low.min(*value), high.max(*value)];
            let range = column.iter().flatten().fold([f64::INFINITY, f64::NEG_INFINITY], around);
            known.push((KnownAxis { name: name.to_owned(), source, n_known, range }, column));
        }
    };
    let mut names: Vec<&str> = library.axis_names();
    for name in attributes {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    for name in names {
        if let Some((source, column)) = stated_column(library, name) {
            add(name, source, column);
        }
    }
    let features = in_parallel(library.textures.len(), |texture| SignalAxis::all_of(model(library, texture)));
    for (index, axis) in SignalAxis::ALL.into_iter().enumerate() {
        let column = features.iter().map(|of_texture| of_texture[index]).collect();
        add(axis.name(), AxisSource::Signal(axis), column);
    }
    known
}

/// Returns the coordinate of each texture on an axis, 0 to 100; `None` if no texture has one. A feature of the vibration takes
/// about a millisecond for each texture.
pub fn axis_values(library: &Library, name: &str) -> Option<Vec<Option<f64>>> {
    column(library, name).map(|(_, column)| column)
}

/// Returns the meaning of 0 and of 100 on an axis: the poles of an attribute, of which the second is empty if its name is one
/// word, those of a feature of the vibration, or the ends of a dimension of a perceptual space, which name it: its direction has no
/// meaning.
pub fn axis_poles(name: &str) -> [String; 2] {
    let plain = plain_axis_name(name);
    match SignalAxis::from_name(name) {
        Some(axis) => axis.poles().map(str::to_owned),
        None if is_dimension_name(plain) => DIMENSION_ENDS.map(|end| format!("{end} {plain}")),
        None => poles(plain),
    }
}

/// Returns the choices of axes of the papers that a library knows: the two axes of the authoring paper, and the five attributes of
/// the CNN-LSTM paper, of which the first two are those of the canvas.
pub fn presets(library: &Library) -> Vec<AxisPreset> {
    let preset = |name: &'static str, axes: &[&str]| AxisPreset {
        name,
        axes: axes.iter().map(|axis| (*axis).to_owned()).collect(),
    };
    let is_known = |preset: &AxisPreset| preset.axes.iter().all(|name| column(library, name).is_some());
    let all = [preset("authoring paper", &USUAL_AXES), preset("CNN-LSTM paper", &ATTRIBUTES)];
    all.into_iter().filter(is_known).collect()
}

/// Returns the library with positions on these axes, which its `axes` then name. A texture without a coordinate on one of them has
/// no position. With the axes of its positions, the library stays as it is.
///
/// Positions have label sources and standard deviations as in [`AxisColumns::places`].
///
/// # Errors
/// See [`AxesError`].
pub fn placed_on(library: &Library, axes: &[String]) -> Result<Library, AxesError> {
    placed_with(library, axes, &AddedCoordinates::default())
}

/// As [`placed_on`]; a texture without a coordinate on one of the axes has that of `added`, if there is one.
///
/// # Errors
/// See [`AxesError`].
pub fn placed_with(
    library: &Library,
    axes: &[String],
    added: &AddedCoordinates,
) -> Result<Library, AxesError> {
    if library.axis_names().iter().eq(axes) {
        return Ok(library.clone());
    }
    if !(1..=MOST_AXES).contains(&axes.len()) {
        return Err(AxesError::Count { n: axes.len() });
    }
    let mut columns = AxisColumns::default();
    let places = columns.places(library, axes, added);
    let mut names: Vec<String> = Vec::new();
    for name in axes {
        let plain = match columns.source(name).ok_or_else(|| unknown(library, name))? {
            AxisSource::Signal(axis) => axis.name(),
            AxisSource::Position(_) | AxisSource::Attribute => plain_axis_name(name),
        };
        // A file of the library would be refused.
        if names.iter().any(|other| other.eq_ignore_ascii_case(plain)) {
            return Err(AxesError::Twice { name: plain.to_owned() });
        }
        names.push(plain.to_owned());
    }
    if places.iter().all(Option::is_none) {
        return Err(AxesError::Nothing { axes: names });
    }
    Ok(library.clone().with_places(places, names))
}

fn unknown(library: &Library, name: &str) -> AxesError {
    let known: Vec<String> = known_axes(library).into_iter().map(|axis| axis.name).collect();
    let near = near(known.iter().map(String::as_str), name).first().map(|near| (*near).to_owned());
    AxesError::Unknown { name: name.to_owned(), near, known }
}

fn meant(near: Option<&String>) -> String {
    near.map_or_else(String::new, |near| format!("did you mean \"{near}\"? Otherwise, "))
}

/// Evaluates what axes add to a space: those of `first`, in this order, then those of `candidates`, or else all that the library
/// knows ([`evaluate_axes`]). `on_progress` receives the number of finished parts and their total; returning `false` stops the
/// evaluation.
///
/// # Errors
/// No texture has one of the axes, one of `first` is named twice or there are too many, too few textures have all axes, or the
/// evaluation was stopped.
pub fn evaluate(
    library: &Library,
    first: &[String],
    candidates: Option<&[String]>,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> anyhow::Result<EvaluatedAxes> {
    let known = known_columns(library);
    let of_name = |name: &String| {
        let known = known.iter().find(|(axis, _)| axis.name == *name).map(|(_, column)| column.clone());
        let values = known.or_else(|| axis_values(library, name)).ok_or_else(|| unknown(library, name))?;
        Ok(AxisCandidate { name: name.clone(), values })
    };
    let mut names: Vec<String> = first.to_vec();
    let all = || known.iter().map(|(axis, _)| axis.name.clone()).collect::<Vec<String>>();
    for name in candidates.map_or_else(all, <[String]>::to_vec) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let candidates = names.iter().map(of_name).collect::<Result<Vec<AxisCandidate>, AxesError>>()?;
    // A name twice is the same candidate twice, which the evaluation refuses.
    let first: Vec<usize> =
        first.iter().filter_map(|name| names.iter().position(|other| other == name)).collect();
    let models: Vec<&TextureModel> = library.textures.iter().map(|texture| &texture.model).collect();
    let found = evaluate_axes(&models, &candidates, &first, on_progress)?;
    Ok(EvaluatedAxes { names, found })
}

#[cfg(test)]
mod tests;
