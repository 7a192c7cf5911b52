//! Local mean of a quantity of the textures: what an axis has at a point that does not state it.

use nalgebra::DMatrix;

use crate::maths::smoother::{Smoother, Surface};
use crate::space::space_point::{MIDDLE, MOST_AXES, SpacePoint, Unit};

/// Smoothing spline through values of the textures, limited to their range. Beyond the range of their positions, it is the value
/// at its border, not an extrapolation. Fitting takes time cubic in the number of textures;
/// a value at a point takes linear time.
#[derive(Clone, Debug)]
pub struct LocalMean {
    /// `None` if positions coincide: they have no spline.
    surface: Option<Surface<MOST_AXES>>,
    /// Mean of the values, in place of a spline.
    mean: f64,
    lowest: f64,
    highest: f64,
    /// Lowest and highest coordinate of the positions on each axis, in the unit cube.
    ranges: [[f64; 2]; MOST_AXES],
}

impl LocalMean {
    /// Fits the spline. `None` if no texture has both a position and a value.
    ///
    /// `positions` and `values` are indexed like the library. All positions have the same axes.
    pub fn new(positions: &[Option<SpacePoint>], values: &[Option<f64>]) -> Option<Self> {
        let known: Vec<(Unit, f64)> = positions
            .iter()
            .zip(values)
            .filter_map(|(place, value)| Some(((*place)?.unit(), (*value)?)))
            .collect();
        let lowest = known.iter().map(|(_, value)| *value).reduce(f64::min)?;
        let highest = known.iter().map(|(_, value)| *value).fold(lowest, f64::max);
        let places: Vec<Unit> = known.iter().map(|(place, _)| *place).collect();
        let column = DMatrix::from_fn(known.len(), 1, |row, _| known[row].1);
        let smoother = Smoother::<MOST_AXES>::fitted(&places, &column);
        let mean = known.iter().map(|(_, value)| value).sum::<f64>() / known.len() as f64;
        let ranges = std::array::from_fn(|axis| {
            let along = || places.iter().map(|place| place[axis]);
            [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
        });
        let surface = smoother.map(|smoother| smoother.surface(&column));
        Some(Self { surface, mean, lowest, highest, ranges })
    }

    /// Value at a point on the axes of the positions, within the range of the values.
    pub fn at(&self, at: SpacePoint) -> f64 {
        let unit = at.unit();
        let near: Unit =
            std::array::from_fn(|axis| unit[axis].clamp(self.ranges[axis][0], self.ranges[axis][1]));
        let on_surface = |surface: &Surface<MOST_AXES>| surface.at(near).first().copied();
        let value = self.surface.as_ref().and_then(on_surface).unwrap_or(self.mean);
        value.clamp(self.lowest, self.highest)
    }
}

/// Local means of the textures on the axes that points do not state, over those that they state.
#[derive(Clone, Debug)]
pub struct LocalMeans {
    /// One for each axis; `None` if points state it.
    axes: Vec<Option<AxisMean>>,
}

/// Mean of the textures on one axis.
#[derive(Clone, Debug)]
struct AxisMean {
    /// `None` if points state no axis, or no texture has a position.
    local: Option<LocalMean>,
    /// Mean of all textures; [`MIDDLE`] without positions.
    overall: f64,
}

impl LocalMeans {
    /// Fits the means once for many points. `is_stated` says for each axis of the space whether points state it; `positions` are
    /// those of the textures on all axes.
    pub fn new(positions: &[Option<SpacePoint>], is_stated: &[bool]) -> Self {
        let on_stated = |place: SpacePoint| {
            let stated = is_stated.iter().enumerate().filter(|(_, is_stated)| **is_stated);
            let coordinates: Option<Vec<f64>> = stated.map(|(axis, _)| place.get(axis)).collect();
            SpacePoint::of(&coordinates?).ok() // Without any stated axis, no texture is nearer than another.
        };
        let places: Vec<Option<SpacePoint>> = positions.iter().map(|place| on_stated((*place)?)).collect();
        let mean = |axis: usize| {
            let values: Vec<Option<f64>> = positions.iter().map(|place| (*place)?.get(axis)).collect();
            AxisMean { local: LocalMean::new(&places, &values), overall: mean_of(&values).unwrap_or(MIDDLE) }
        };
        let axes = is_stated.iter().enumerate().map(|(axis, is_stated)| (!is_stated).then(|| mean(axis)));
        Self { axes: axes.collect() }
    }

    /// Returns the coordinates of a point on all axes. `known` has one entry for each axis, 0 to 100, and a coordinate on each
    /// stated axis. The others have the local mean of the textures; if points state no axis, it is the mean of all textures,
    /// and the middle if none has a position.
    pub fn completed(&self, known: &[Option<f64>]) -> Vec<f64> {
        let pairs = || self.axes.iter().zip(known);
        let stated = pairs().filter(|(mean, _)| mean.is_none()).map(|(_, known)| known.unwrap_or(MIDDLE));
        let at = SpacePoint::of(&stated.collect::<Vec<f64>>()).ok(); // Without any stated axis, there is no point.
        let coordinate = |(mean, known): (&Option<AxisMean>, &Option<f64>)| match mean {
            None => known.unwrap_or(MIDDLE),
            Some(AxisMean { local, overall }) => {
                local.as_ref().zip(at).map_or(*overall, |(local, at)| local.at(at))
            }
        };
        pairs().map(coordinate).collect()
    }
}

/// Returns the coordinates of one point on all axes, as [`LocalMeans::completed`]: `known` has the coordinates that it states.
pub fn with_local_means(positions: &[Option<SpacePoint>], known: &[Option<f64>]) -> Vec<f64> {
    let is_stated: Vec<bool> = known.iter().map(Option::is_some).collect();
    LocalMeans::new(positions, &is_stated).completed(known)
}

/// Mean of the known values; `None` without any.
fn mean_of(values: &[Option<f64>]) -> Option<f64> {
    let known: Vec<f64> = values.iter().flatten().copied().collect();
    (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::{LocalMean, LocalMeans, with_local_means};
    use crate::maths::rng::Random;
    use crate::space::space_point::SpacePoint;

    #[test]
    fn it_follows_what_is_linear_and_stays_in_the_range() {
        let mut random = Random::new(3);
        let positions: Vec<Option<SpacePoint>> = (0..30)
            .map(|i| {
                (i % 7 != 0).then(|| SpacePoint::plane(100.0 * random.uniform(), 100.0 * random.uniform()))
            })
            .collect();
        let values: Vec<Option<f64>> =
            positions.iter().map(|at| at.map(|at| 20.0 + 0.5 * at.x() - 0.1 * at.y())).collect();
        let at = SpacePoint::plane(40.0, 60.0);
        let mean = LocalMean::new(&positions, &values).unwrap();
        assert!((mean.at(at) - 34.0).abs() < 1e-6);
        let highest = values.iter().flatten().copied().fold(0.0, f64::max);
        assert!(mean.at(SpacePoint::plane(100.0, 0.0)) <= highest);
        // Beyond the positions, the value at their border.
        let border = |axis: usize, of: fn(f64, f64) -> f64| {
            positions.iter().flatten().filter_map(|at| at.get(axis)).reduce(of).unwrap()
        };
        let corner = SpacePoint::plane(border(0, f64::max), border(1, f64::min));
        assert_eq!(mean.at(SpacePoint::plane(100.0, 0.0)), mean.at(corner));
        assert!(LocalMean::new(&positions, &[None; 30]).is_none());
        let same = vec![Some(at); 4];
        let found = LocalMean::new(&same, &[Some(1.0), Some(2.0), Some(3.0), None]).unwrap().at(at);
        assert!((1.0..=3.0).contains(&found));
    }

    /// Positions on three axes, the third of which grows with the first.
    fn on_three() -> Vec<Option<SpacePoint>> {
        let place = |i: u32| {
            let [x, y] = [i * 37 % 101, i * 59 % 97].map(f64::from);
            SpacePoint::of(&[x, y, 10.0 + 0.5 * x]).unwrap()
        };
        (0..20).map(|i| (i % 6 != 0).then(|| place(i))).collect()
    }

    #[test]
    fn coordinates_that_are_not_stated_follow_from_those_that_are() {
        let positions = on_three();
        let known = [Some(40.0), Some(70.0), None];
        let whole = with_local_means(&positions, &known);
        assert_eq!(whole[..2], [40.0, 70.0]);
        assert!((whole[2] - 30.0).abs() < 1e-6, "{whole:?}");
        // The same for many points, which are fitted once.
        let means = LocalMeans::new(&positions, &[true, true, false]);
        assert_eq!(means.completed(&known), whole);
        for along in [20.0, 60.0] {
            let third = means.completed(&[Some(along), Some(5.0), None])[2];
            assert!((third - 10.0 - 0.5 * along).abs() < 1e-6, "{third}");
        }
        let first = with_local_means(&positions, &[None, None, Some(35.0)])[0];
        assert!((first - 50.0).abs() < 1e-6, "{first}");
        assert_eq!(with_local_means(&positions, &[Some(1.0), Some(2.0), Some(3.0)]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn without_any_coordinate_it_is_the_mean_of_all() {
        let positions = on_three();
        let mean = |axis: usize| {
            let values: Vec<f64> = positions.iter().flatten().filter_map(|at| at.get(axis)).collect();
            values.iter().sum::<f64>() / values.len() as f64
        };
        let whole = with_local_means(&positions, &[None; 3]);
        assert!((0..3).all(|axis| (whole[axis] - mean(axis)).abs() < 1e-9), "{whole:?}");
        assert_eq!(with_local_means(&[None, None], &[None, Some(30.0)]), [50.0, 30.0]);
        assert_eq!(with_local_means(&[], &[None]), [50.0]);
    }
}
