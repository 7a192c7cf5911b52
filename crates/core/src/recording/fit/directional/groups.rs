//! Directions that count as one.

use std::f64::consts::PI;

/// Largest difference of directions that count as one, in rad: directions measured from positions scatter by a degree or
/// two.
pub(super) const SAME_RAD: f64 = 3.0 / 180.0 * PI;

/// Groups of equal angles.
pub(super) struct Groups {
    /// Angle of each group in rad, zero to the period, ascending.
    pub(super) angles_rad: Vec<f64>,
    /// Group of each input.
    pub(super) of: Vec<usize>,
}

impl Groups {
    /// Groups angles that are equal within [`SAME_RAD`] modulo `period_rad`.
    pub(super) fn new(angles_rad: &[f64], period_rad: f64) -> Self {
        let mut sorted: Vec<f64> = angles_rad.iter().map(|angle| angle.rem_euclid(period_rad)).collect();
        sorted.sort_by(f64::total_cmp);
        let mut groups: Vec<f64> = Vec::new();
        for angle in sorted {
            if groups.iter().all(|group| difference(angle, *group, period_rad).abs() > SAME_RAD) {
                groups.push(angle);
            }
        }
        let of = angles_rad.iter().map(|angle| nearest(&groups, *angle, period_rad)).collect();
        Self { angles_rad: groups, of }
    }
}

/// `a - b` modulo the period, from minus half of it to half of it, in rad.
pub(super) fn difference(a_rad: f64, b_rad: f64, period_rad: f64) -> f64 {
    let difference = a_rad - b_rad;
    difference - period_rad * (difference / period_rad).round()
}

/// Index of the angle nearest to `to_rad`; 0 if there are none.
pub(super) fn nearest(angles_rad: &[f64], to_rad: f64, period_rad: f64) -> usize {
    let apart = |angle: &f64| difference(*angle, to_rad, period_rad).abs();
    let nearest = angles_rad.iter().enumerate().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    nearest.map_or(0, |(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::{Groups, difference, nearest};
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::{PI, TAU};

    #[test]
    fn opposite_directions_are_one_axis_and_two_directions() {
        let angles = [0.0, 45.0, 180.0, 179.5, 225.0, 359.0, -135.0].map(f64::to_radians);
        let axes = Groups::new(&angles, PI);
        assert_eq!((axes.angles_rad.len(), &axes.of[..]), (2, &[0, 1, 0, 0, 1, 0, 1][..]));
        let directions = Groups::new(&angles, TAU);
        assert_eq!((directions.angles_rad.len(), &directions.of[..]), (4, &[0, 1, 2, 2, 3, 0, 3][..]));
        assert_eq!(nearest(&[], 1.0, PI), 0);
    }

    proptest! {
        #[test]
        fn every_angle_is_near_its_group(angles in prop::collection::vec(-20.0_f64..20.0, 1..20)) {
            let groups = Groups::new(&angles, PI);
            for (angle, group) in angles.iter().zip(&groups.of) {
                let apart = difference(*angle, groups.angles_rad[*group], PI).abs();
                // Rounding of the remainder.
                prop_assert!(apart <= super::SAME_RAD + 1e-12, "{apart}");
            }
        }
    }
}
