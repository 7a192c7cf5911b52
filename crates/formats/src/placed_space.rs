//! The result of building a space, applied to a library: positions, attributes, axis names and the validation report.

use serde_json::Value;
use shagreen_core::space::space_build::SpaceBuild;

use crate::label_source_text::state_origin_of_places;
use crate::library::{Attribute, Attributes, Library, Place, is_usual};
use crate::space_report::space_report;

/// A space without the data that it was built from.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedSpace {
    /// The textures with a position in the space. Identifiers are unique.
    pub textures: Vec<PlacedTexture>,
    /// Names of the attributes that the two coordinates represent, if they are not the usual ones; see
    /// [`Library::axes`].
    pub axes: Option<[String; 2]>,
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
    /// Mean ratings.
    pub attributes: Option<Attributes>,
}

impl PlacedSpace {
    /// Extracts the positions, attributes and report of a built space.
    pub fn of(build: &SpaceBuild) -> Self {
        let texture = |(i, id): (usize, &String)| PlacedTexture {
            id: id.clone(),
            place: Place::new(build.positions[i], build.place_source()),
            attributes: Some(attributes(build, i)).filter(|a| !a.values.is_empty()),
        };
        let mut report = space_report(build);
        if let Value::Object(report) = &mut report {
            // Libraries are shared, so data about individual participants stays with the experimenter.
            for field in ["raters", "sorters", "verdict", "warnings"] {
                report.remove(field);
            }
        }
        let names = build.axes.each_ref().map(|axis| axis.pair.name());
        Self {
            textures: build.textures.iter().enumerate().map(texture).collect(),
            axes: (!is_usual(&names)).then_some(names),
            report,
        }
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
