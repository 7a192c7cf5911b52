//! The result of building a space, applied to a library: positions, attributes, axis names and the validation report.

use serde_json::Value;
use shagreen_core::space::space_build::SpaceBuild;

use crate::label_source_text::state_origin_of_places;
use crate::library::{Attribute, Attributes, Library, Place, is_usual, names_or_usual};
use crate::space_report::space_report;

/// Smallest number of dimensions of a perceptual space whose coordinates become attributes.
const LEAST_DIMENSIONS: usize = 3;
/// Begin of the name of a dimension of a perceptual space.
const DIMENSION: &str = "dimension";

/// A space without the data that it was built from.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedSpace {
    /// The textures with a position in the space. Identifiers are unique.
    pub textures: Vec<PlacedTexture>,
    /// Names of the axes of the positions, if they are not the usual ones; see [`Library::axes`].
    pub axes: Option<Vec<String>>,
    /// How it was built and validated, see [`Library::space_report`].
    pub report: Value,
}

/// Position and attributes of one texture. A position that features predict on an axis is an estimate; the attributes
/// stay what people or simulated raters rated.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedTexture {
    /// Identifier of the texture.
    pub id: String,
    /// Position in the space.
    pub place: Place,
    /// Mean ratings, and coordinates on the dimensions of the perceptual space if it has three or more ([`dimension_name`]).
    pub attributes: Option<Attributes>,
}

impl PlacedSpace {
    /// Extracts the positions, attributes and report of a built space.
    pub fn of(build: &SpaceBuild) -> Self {
        let points = build.perceptual.as_ref().map_or(&[][..], |space| space.configuration.points.as_slice());
        let dimensions = scaled_dimensions(points);
        let texture = |(i, id): (usize, &String)| {
            let mut known = attributes(build, i);
            let on_dimension = |(number, values): &(usize, Vec<f64>)| Attribute {
                name: dimension_name(*number),
                value: values[i],
            };
            known.values.extend(dimensions.iter().map(on_dimension));
            PlacedTexture {
                id: id.clone(),
                place: Place::new(build.positions[i], build.place_source()),
                attributes: Some(known).filter(|known| !known.values.is_empty()),
            }
        };
        let mut report = space_report(build);
        if let Value::Object(report) = &mut report {
            // Libraries are shared, so data about individual participants stays with the experimenter.
            for field in ["raters", "sorters", "verdict", "warnings"] {
                report.remove(field);
            }
        }
        let names: Vec<String> = build.axes.iter().map(|axis| axis.pair.name()).collect();
        Self {
            textures: build.textures.iter().enumerate().map(texture).collect(),
            axes: (!is_usual(&names)).then_some(names),
            report,
        }
    }

    /// Names of the axes of the positions.
    pub fn axis_names(&self) -> Vec<&str> {
        names_or_usual(self.axes.as_deref())
    }

    /// Returns the library with the positions, attributes and report of the space. Textures outside the space lose
    /// their position, because positions from different sources are not comparable. The origin text of the library
    /// states the label source.
    pub fn place(&self, library: &Library) -> Library {
        let mut placed = library.clone();
        for texture in &mut placed.textures {
            let found = self.textures.iter().find(|known| known.id == texture.id);
            texture.place = found.map(|known| known.place);
            texture.attributes = found.and_then(|known| known.attributes.clone());
        }
        placed.space_report = Some(self.report.clone());
        state_origin_of_places(&mut placed);
        placed.axes.clone_from(&self.axes);
        placed
    }
}

/// Name of the attribute that holds the coordinates on a dimension of the perceptual space, counted from 1: `dimension 1`. From 0
/// to 100, the scale goes from the lowest to the highest coordinate of all textures; its direction has no meaning.
pub fn dimension_name(number: usize) -> String {
    format!("{DIMENSION} {number}")
}

/// Whether an attribute holds coordinates on a dimension of a perceptual space ([`dimension_name`]).
pub fn is_dimension_name(name: &str) -> bool {
    let number = name.strip_prefix(DIMENSION).and_then(|rest| rest.strip_prefix(' '));
    number.is_some_and(|number| number.parse::<usize>().is_ok())
}

/// Numbers of the dimensions of the perceptual space, from 1, with the coordinates of the textures, scaled to 0..100 over the
/// textures. None with fewer than three dimensions: the axes are directions in the plane of two. A dimension on which all
/// textures coincide is left out.
fn scaled_dimensions(points: &[Vec<f64>]) -> Vec<(usize, Vec<f64>)> {
    let n_dimensions = points.first().map_or(0, Vec::len);
    if n_dimensions < LEAST_DIMENSIONS {
        return Vec::new();
    }
    let scaled = |dimension: usize| {
        let values: Vec<f64> = points.iter().map(|point| point[dimension]).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let in_scale = |value: f64| (100.0 * ((value - low) / (high - low))).clamp(0.0, 100.0);
        (high > low).then(|| (dimension + 1, values.into_iter().map(in_scale).collect()))
    };
    (0..n_dimensions).filter_map(scaled).collect()
}

/// Mean ratings of a texture on every relevant pair, as given; a pair that is an axis follows the direction of the
/// axis.
fn attributes(build: &SpaceBuild, texture: usize) -> Attributes {
    let counted = build.adjectives.iter().filter(|adjective| adjective.is_relevant);
    let values = counted.filter_map(|adjective| {
        let mean = adjective.ratings[texture].mean?;
        let turned = build.axes.iter().find(|axis| axis.is_turned(&adjective.pair));
        Some(match turned {
            Some(axis) => Attribute { name: axis.pair.name(), value: 100.0 - mean },
            None => Attribute { name: adjective.pair.name(), value: mean },
        })
    });
    Attributes { source: build.source, values: values.collect() }
}

#[cfg(test)]
mod tests {
    use super::{dimension_name, is_dimension_name, scaled_dimensions};

    #[test]
    fn dimensions_of_a_perceptual_space_run_from_0_to_100() {
        let points = vec![vec![-2.0, 1.0, 4.0], vec![3.0, 1.0, 0.0], vec![0.5, 1.0, 3.0]];
        // All textures coincide on the second dimension.
        let expected = [(1, vec![0.0, 100.0, 50.0]), (3, vec![100.0, 0.0, 75.0])];
        assert_eq!(scaled_dimensions(&points), expected);
        let plane: Vec<Vec<f64>> = points.iter().map(|point| point[..2].to_vec()).collect();
        assert!(scaled_dimensions(&plane).is_empty() && scaled_dimensions(&[]).is_empty());
    }

    #[test]
    fn names_of_dimensions_are_known() {
        assert!(is_dimension_name(&dimension_name(1)) && is_dimension_name("dimension 12"));
        for name in ["dimension", "dimension one", "rough-smooth", "dimensional 1"] {
            assert!(!is_dimension_name(name), "{name}");
        }
    }
}
