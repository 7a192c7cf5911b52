//! Local mean of a quantity of the textures: what an axis has at a point that does not state it.

use nalgebra::DMatrix;

use crate::maths::smoother::Smoother;
use crate::space::space_point::{MOST_AXES, SpacePoint, Unit};

/// Value at a point by a smoothing spline through the values of the textures, limited to their range. `None` if no texture
/// has both a position and a value.
///
/// `positions` and `values` are indexed like the library. The point and the positions need the same axes.
pub fn local_mean(positions: &[Option<SpacePoint>], values: &[Option<f64>], at: SpacePoint) -> Option<f64> {
    let known: Vec<(Unit, f64)> = positions
        .iter()
        .zip(values)
        .filter_map(|(place, value)| Some(((*place)?.unit(), (*value)?)))
        .collect();
    let low = known.iter().map(|(_, value)| *value).reduce(f64::min)?;
    let high = known.iter().map(|(_, value)| *value).fold(low, f64::max);
    let places: Vec<Unit> = known.iter().map(|(place, _)| *place).collect();
    let column = DMatrix::from_fn(known.len(), 1, |row, _| known[row].1);
    let mean = || known.iter().map(|(_, value)| value).sum::<f64>() / known.len() as f64;
    // Coincident positions have no spline.
    let value = Smoother::<MOST_AXES>::fitted(&places, &column)
        .and_then(|smoother| smoother.surface(&column).at(at.unit()).first().copied())
        .unwrap_or_else(mean);
    Some(value.clamp(low, high))
}

#[cfg(test)]
mod tests {
    use super::local_mean;
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
        assert!((local_mean(&positions, &values, at).unwrap() - 34.0).abs() < 1e-6);
        let highest = values.iter().flatten().copied().fold(0.0, f64::max);
        assert!(local_mean(&positions, &values, SpacePoint::plane(100.0, 0.0)).unwrap() <= highest);
        assert_eq!(local_mean(&positions, &vec![None; 30], at), None);
        let same = vec![Some(at); 4];
        let found = local_mean(&same, &[Some(1.0), Some(2.0), Some(3.0), None], at).unwrap();
        assert!((1.0..=3.0).contains(&found));
    }
}
