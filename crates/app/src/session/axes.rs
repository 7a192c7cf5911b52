//! Axes of the space in use: their names, points on them, and what a space with more axes than the canvas changes.

use std::borrow::Cow;

use shagreen_core::space::authoring::Blending;
use shagreen_core::space::{SpacePoint, with_local_means};
use shagreen_formats::project::BlendChoice;

use super::Session;
use super::loaded_textures::{positions, positions_without};

/// Number of axes of the canvas. Spaces with more have no triangles.
const CANVAS_AXES: usize = 2;

impl Session {
    /// Names of the axes of the space, as in the project: one to six, the horizontal one of the canvas first, then the vertical
    /// one.
    pub fn axes(&self) -> &[String] {
        &self.textures.axis_names
    }

    /// Names of the chosen axes on which no texture has a coordinate.
    pub fn missing_axes(&self) -> Vec<&str> {
        // Coordinates on the axes of the positions are not looked up by name.
        if self.textures.library.axis_names() == self.textures.axis_names {
            return Vec::new();
        }
        let is_missing = |name: &&String| self.textures.columns.source(name).is_none();
        self.textures.axis_names.iter().filter(is_missing).map(String::as_str).collect()
    }

    /// Number of axes of the space, one to six.
    pub fn n_axes(&self) -> usize {
        self.textures.axis_names.len()
    }

    /// Words at the low and the high end of each axis.
    pub fn poles(&self) -> &[[String; 2]] {
        &self.textures.poles
    }

    /// Positions of all textures on the axes of the space, by index.
    pub(crate) fn positions(&self) -> Vec<Option<SpacePoint>> {
        positions(&self.textures.places)
    }

    /// Positions of the textures that take part in all authored textures, by index: local means follow from them.
    pub(crate) fn common_positions(&self) -> Vec<Option<SpacePoint>> {
        let own = self.textures.own.left_out(self.textures(), |_| false);
        positions_without(&self.textures.places, &own)
    }

    /// Whether the canvas shows a slice, because the space has more axes than it.
    pub fn is_sliced(&self) -> bool {
        self.n_axes() > CANVAS_AXES
    }

    /// A point on the axes of the space: coordinates that it lacks are in the middle, and others are left out.
    pub fn fitted(&self, at: SpacePoint) -> SpacePoint {
        at.on(self.n_axes())
    }

    /// Interpolation options as they apply in the space.
    pub fn blend_in_space<'a>(&self, choice: &'a BlendChoice) -> Cow<'a, BlendChoice> {
        choice.in_space(self.n_axes())
    }

    /// Interpolation options as they apply in the space, with the pinned textures as library indices.
    pub fn blending(&self, choice: &BlendChoice) -> Blending {
        self.blend_in_space(choice).blending(|id| self.index_of(id))
    }

    /// Point with these coordinates, one for each axis. An axis without one has the local mean of the textures: the mean of
    /// those near the point on the other axes.
    pub fn completed(&self, told: &[Option<f64>]) -> SpacePoint {
        let whole = with_local_means(&self.common_positions(), told);
        SpacePoint::of(&whole).unwrap_or_else(|_| self.fitted(SpacePoint::default()))
    }

    /// A point with the local mean of the textures on one axis.
    pub fn at_local_mean(&self, at: SpacePoint, axis: usize) -> SpacePoint {
        let at = self.fitted(at);
        let told: Vec<Option<f64>> =
            (0..at.n_axes()).map(|each| at.get(each).filter(|_| each != axis)).collect();
        let mean = self.completed(&told).get(axis);
        mean.map_or(at, |mean| at.with(axis, mean))
    }
}
