//! What a space gives the textures of a library: places, attributes, names of axes, and how far all that can be believed.

use serde_json::Value;
use shagreen_core::space_build::SpaceBuild;

use crate::library::{Attribute, Attributes, Library, Place, is_usual};
use crate::place_origin::state_origin_of_places;
use crate::space_report::space_report;

/// A space without the way to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedSpace {
    /// The textures that have a place in it. Identifiers are unique.
    pub textures: Vec<PlacedTexture>,
    /// Names of the attributes that the two coordinates stand for, where they are not the usual ones: as in
    /// [`Library::axes`].
    pub axes: Option<[String; 2]>,
    /// How it was made, as in [`Library::space_report`].
    pub report: Value,
}

/// What a space says of one texture.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedTexture {
    /// Its identifier.
    pub id: String,
    /// Where it lies.
    pub place: Place,
    /// How it was rated.
    pub attributes: Option<Attributes>,
}

impl PlacedSpace {
    /// What a space that was built gives.
    pub fn of(build: &SpaceBuild) -> Self {
        let texture = |(i, id): (usize, &String)| PlacedTexture {
            id: id.clone(),
            place: Place { at: build.positions[i], source: build.source },
            attributes: Some(attributes(build, i)).filter(|a| !a.values.is_empty()),
        };
        let mut report = space_report(build);
        if let Value::Object(report) = &mut report {
            // A library is passed on: who took part stays with those who asked them.
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

    /// The library with the places and attributes of the space, and its report. Textures that are not in the space lose
    /// their place: positions of two origins mean little beside each other. The origin of the library says what they come
    /// from.
    pub fn place(&self, library: &Library) -> Library {
        let mut placed = library.clone();
        for texture in &mut placed.textures {
            let found = self.textures.iter().find(|known| known.id == texture.id);
            texture.place = found.map(|known| known.place);
            texture.attributes = found.and_then(|known| known.attributes.clone());
        }
        state_origin_of_places(&mut placed);
        placed.space_report = Some(self.report.clone());
        placed.axes.clone_from(&self.axes);
        placed
    }
}

/// Mean ratings of a texture on every pair that counts, as they were given; on an axis in the axis's own direction.
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
