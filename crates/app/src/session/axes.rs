//! Axes of the space in use: their names, points on them, and what a space with more axes than the canvas changes.

use std::borrow::Cow;

use shagreen_core::space::authoring::Blending;
use shagreen_core::space::{SpacePoint, local_mean};
use shagreen_formats::project::BlendChoice;

use super::Session;
use super::loaded_textures::positions;

/// Number of axes of the canvas. Spaces with more have no triangles.
const CANVAS_AXES: usize = 2;
/// Coordinate on an axis on which no texture has one.
const MIDDLE: f64 = 50.0;

impl Session {
    /// Names of the axes of the space, as in the project: one to six, the horizontal one of the canvas first, then the vertical
    /// one.
    pub fn axes(&self) -> &[String] {
        &self.textures.axis_names
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
        let known: Vec<(usize, f64)> =
            told.iter().enumerate().filter_map(|(axis, value)| Some((axis, (*value)?))).collect();
        let coordinates: Vec<f64> = known.iter().map(|(_, value)| *value).collect();
        // Without any coordinate, no texture is nearer than another.
        let at = SpacePoint::of(&coordinates).ok();
        let sites: Vec<SpacePoint> = self.positions().into_iter().flatten().collect();
        let on_known = |site: &SpacePoint| {
            let coordinates: Option<Vec<f64>> = known.iter().map(|(axis, _)| site.get(*axis)).collect();
            SpacePoint::of(&coordinates?).ok()
        };
        let positions: Vec<Option<SpacePoint>> = sites.iter().map(on_known).collect();
        let mean = |axis: usize| {
            let values: Vec<Option<f64>> = sites.iter().map(|site| site.get(axis)).collect();
            let near = at.and_then(|at| local_mean(&positions, &values, at));
            near.or_else(|| mean_of(&values)).unwrap_or(MIDDLE)
        };
        let whole = told.iter().enumerate().map(|(axis, value)| value.unwrap_or_else(|| mean(axis)));
        SpacePoint::of(&whole.collect::<Vec<f64>>()).unwrap_or_else(|_| self.fitted(SpacePoint::default()))
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

/// Mean of the known values; `None` without any.
fn mean_of(values: &[Option<f64>]) -> Option<f64> {
    let known: Vec<f64> = values.iter().flatten().copied().collect();
    (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::mean_of;

    #[test]
    fn unknown_values_have_no_mean() {
        assert_eq!([mean_of(&[None]), mean_of(&[Some(2.0), None, Some(4.0)])], [None, Some(3.0)]);
    }
}
