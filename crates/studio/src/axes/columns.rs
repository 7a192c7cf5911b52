//! Coordinates of the textures of a library on axes that are chosen by name, and positions made of them.

use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::TextureModel;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::project::{AddedCoordinates, plain_axis_name};

use crate::parallel::in_parallel;

/// Coordinate of each texture on an axis, 0 to 100, indexed as the textures of the library.
pub(super) type Column = Vec<Option<f64>>;

/// Where the coordinates on an axis come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisSource {
    /// The positions, by the number of the coordinate, from 0.
    Position(usize),
    /// An attribute of the textures.
    Attribute,
    /// A feature of the vibration.
    Signal(SignalAxis),
}

impl AxisSource {
    /// Word for lists and scripts.
    pub fn label(self) -> &'static str {
        match self {
            Self::Position(_) => "positions",
            Self::Attribute => "attributes",
            Self::Signal(_) => "vibration",
        }
    }
}

/// Coordinates of the textures of a library on chosen axes, by name. They are kept until they are cleared: an axis that is computed
/// from the vibration takes about a millisecond a texture.
#[derive(Clone, Debug, Default)]
pub struct AxisColumns(Vec<(String, Option<(AxisSource, Column)>)>);

impl AxisColumns {
    /// Discards the coordinates, because textures or their positions have changed.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the position of each texture on these axes, and keeps their coordinates instead of those on other axes. A texture
    /// without a coordinate on one of them has that of `added`, or else no position.
    ///
    /// The label source of a position is that of its first axis that is no feature of the vibration, or else physical; with a
    /// coordinate of `added`, it is an estimate. Standard deviations are kept if the first two axes are those of the library's
    /// positions.
    pub fn places(
        &mut self,
        library: &Library,
        axes: &[String],
        added: &AddedCoordinates,
    ) -> Vec<Option<Place>> {
        self.follow(library, axes);
        let columns: Option<Vec<&(AxisSource, Column)>> = axes.iter().map(|name| self.get(name)).collect();
        let Some(columns) = columns else { return vec![None; library.textures.len()] };
        let mut first = columns.iter().take(2).map(|(source, _)| *source);
        let keeps_deviation = (0..2).all(|axis| first.next() == Some(AxisSource::Position(axis)));
        let place = |(index, texture): (usize, &TextureEntry)| {
            let given = || columns.iter().map(move |(_, column)| column[index]);
            let on_axis =
                |(given, axis): (Option<f64>, &String)| given.or_else(|| added.get(&texture.id, axis));
            let coordinates: Option<Vec<f64>> = given().zip(axes).map(on_axis).collect();
            let at = SpacePoint::of(&coordinates?).ok()?; // There are too many axes, or none.
            let stated = columns.iter().find_map(|(source, _)| match source {
                AxisSource::Position(_) => texture.label_source(),
                AxisSource::Attribute => texture.attributes.as_ref().map(|attributes| attributes.source),
                AxisSource::Signal(_) => None,
            });
            let deviation = texture.place.and_then(|place| place.deviation).filter(|_| keeps_deviation);
            let source = if given().all(|given| given.is_some()) {
                stated.unwrap_or(LabelSource::PhysicalLabels)
            } else {
                LabelSource::Estimated
            };
            Some(Place { deviation, ..Place::new(at, source) })
        };
        library.textures.iter().enumerate().map(place).collect()
    }

    /// Coordinate of a texture on an axis of the last positions, which a position, an attribute or the vibration gives.
    pub fn coordinate(&self, axis: &str, texture: usize) -> Option<f64> {
        self.get(axis)?.1.get(texture).copied().flatten()
    }

    /// Where the coordinates on an axis of the last positions come from; `None` if no texture has one.
    pub fn source(&self, name: &str) -> Option<AxisSource> {
        self.get(name).map(|(source, _)| *source)
    }

    /// Computes the coordinates that are missing, and discards those on other axes.
    fn follow(&mut self, library: &Library, axes: &[String]) {
        self.0.retain(|(name, _)| axes.contains(name));
        for name in axes {
            if !self.0.iter().any(|(known, _)| known == name) {
                self.0.push((name.clone(), column(library, name)));
            }
        }
    }

    fn get(&self, name: &str) -> Option<&(AxisSource, Column)> {
        self.0.iter().find(|(known, _)| known == name)?.1.as_ref()
    }
}

/// Returns the position of each texture of a list: on the axes that `axes` names, otherwise its own. A texture without a coordinate
/// on one of the axes has that of `added`, or else no position.
pub fn list_places(
    library: &Library,
    axes: Option<&[String]>,
    columns: &mut AxisColumns,
    added: &AddedCoordinates,
) -> Vec<Option<Place>> {
    let names = library.axis_names();
    let Some(axes) = axes.filter(|axes| names != **axes) else {
        // A texture that was added on another number of axes would leave no space at all.
        let is_whole = |place: &Place| place.at.n_axes() == names.len();
        return library.textures.iter().map(|texture| texture.place.filter(is_whole)).collect();
    };
    columns.places(library, axes, added)
}

/// Where the coordinates on an axis come from, and the coordinate of each texture; `None` if no texture has one.
pub(super) fn column(library: &Library, name: &str) -> Option<(AxisSource, Column)> {
    stated_column(library, name).or_else(|| {
        let axis = SignalAxis::from_name(name)?;
        let column = in_parallel(library.textures.len(), |texture| axis.of(model(library, texture)));
        column.iter().any(Option::is_some).then_some((AxisSource::Signal(axis), column))
    })
}

/// As [`column`], without features of the vibration.
pub(super) fn stated_column(library: &Library, name: &str) -> Option<(AxisSource, Column)> {
    let all = |source: AxisSource, of: &dyn Fn(&TextureEntry) -> Option<f64>| {
        let column: Column = library.textures.iter().map(of).collect();
        column.iter().any(Option::is_some).then_some((source, column))
    };
    let of_positions = library
        .axis_names()
        .iter()
        .position(|axis| *axis == name)
        .and_then(|axis| all(AxisSource::Position(axis), &|texture| texture.at()?.get(axis)));
    let plain = plain_axis_name(name);
    of_positions.or_else(|| all(AxisSource::Attribute, &|texture| texture.attributes.as_ref()?.get(plain)))
}

pub(super) fn model(library: &Library, texture: usize) -> &TextureModel {
    &library.textures[texture].model
}

#[cfg(test)]
mod tests;
