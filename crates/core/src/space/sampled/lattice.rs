//! Lattice of speeds and forces at which all textures are sampled.

use crate::texture::plane::Plane;
use crate::units::{Contact, MetersPerSecond, Newtons};

/// Numbers of speeds and forces in the lattice if the textures were not measured at common ones.
const N_SPEEDS: usize = 8;
const N_FORCES: usize = 5;
/// Maximum number of common speeds, or forces, that are used directly.
const MOST_COMMON: usize = 8;
/// Ratio up to which two speeds, or forces, count as equal.
const SAME: f64 = 1.02;
/// Minimum of a lattice axis, as a fraction of its maximum.
const LOWEST: f64 = 0.01;

/// Lattice of all combinations of speeds and forces. If most textures were measured at common speeds or forces, these
/// are used, so that no detail is lost. Otherwise, the axis is logarithmically spaced from the median of the textures'
/// lowest values to the highest value of all.
pub(super) fn lattice(planes: &[&Plane]) -> Vec<Contact> {
    let speeds = axis(planes, 0, N_SPEEDS);
    let forces = axis(planes, 1, N_FORCES);
    let at = |speed: f64, force: f64| Contact { speed: MetersPerSecond(speed), force: Newtons(force) };
    speeds.iter().flat_map(|v| forces.iter().map(|f| at(*v, *f))).collect()
}

/// Values of one axis in ascending order: speeds in m/s (axis 0) or forces in N (axis 1).
fn axis(planes: &[&Plane], axis: usize, n: usize) -> Vec<f64> {
    let of_each: Vec<Vec<f64>> = planes.iter().map(|plane| distinct(plane, axis)).collect();
    let highest = of_each.iter().filter_map(|values| values.last()).copied().fold(0.0, f64::max);
    let mut lowest: Vec<f64> = of_each.iter().filter_map(|values| values.first()).copied().collect();
    lowest.sort_by(f64::total_cmp);
    let Some(low) = lowest.get(lowest.len() / 2).copied() else { return vec![highest] };
    let low = low.max(LOWEST * highest);
    let common = common(&of_each);
    let reaches = |end: f64| common.iter().any(|value| is_same(*value, end));
    if (2..=MOST_COMMON).contains(&common.len()) && reaches(highest) && reaches(low) {
        return common;
    }
    if is_same(low, highest) {
        return vec![highest];
    }
    let at = |i: usize| low * (highest / low).powf(i as f64 / (n - 1) as f64);
    (0..n).map(|i| if i + 1 == n { highest } else { at(i) }).collect()
}

fn is_same(a: f64, b: f64) -> bool {
    a.max(b) <= SAME * a.min(b)
}

/// Values at which a texture was measured, in ascending order without duplicates.
fn distinct(plane: &Plane, axis: usize) -> Vec<f64> {
    let mut values: Vec<f64> = plane.measured().iter().map(|contact| contact[axis]).collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|later, first| is_same(*later, *first));
    values
}

/// Values that more than half of the textures have, in ascending order.
fn common(of_each: &[Vec<f64>]) -> Vec<f64> {
    let mut common: Vec<f64> = Vec::new();
    // A value that most textures have occurs in at least one of the first half plus one.
    for value in of_each.iter().take(of_each.len() / 2 + 1).flatten() {
        if common.iter().any(|other| is_same(*other, *value)) {
            continue;
        }
        let n_have = of_each.iter().filter(|values| values.iter().any(|v| is_same(*v, *value))).count();
        if 2 * n_have > of_each.len() {
            common.push(*value);
        }
    }
    common.sort_by(f64::total_cmp);
    common
}

#[cfg(test)]
mod tests {
    use super::lattice;
    use crate::texture::plane::Plane;
    use crate::texture::test_textures::{arma, two_resonances};

    fn speeds_and_forces(planes: &[Plane]) -> (Vec<f64>, Vec<f64>) {
        let contacts = lattice(&planes.iter().collect::<Vec<_>>());
        let (mut speeds, mut forces): (Vec<f64>, Vec<f64>) =
            contacts.iter().map(|c| (c.speed.0, c.force.0)).unzip();
        speeds.dedup();
        forces.sort_by(f64::total_cmp);
        forces.dedup();
        assert_eq!(contacts.len(), speeds.len() * forces.len());
        (speeds, forces)
    }

    #[test]
    fn common_speeds_and_forces_are_taken_as_they_are() {
        let common = || Plane::new(&two_resonances(&[0.03, 0.1, 0.2], &[0.2, 0.8, 2.0]));
        let other = Plane::new(&two_resonances(&[0.05, 0.07, 0.2], &[0.2, 0.31, 2.0]));
        let found = speeds_and_forces(&[other, common(), common()]);
        assert_eq!(found, (vec![0.03, 0.1, 0.2], vec![0.2, 0.8, 2.0]));
    }

    #[test]
    fn scattered_ones_are_covered_in_equal_ratios() {
        let textures: Vec<Plane> = (0..6)
            .map(|i| {
                let x = 1.0 + 0.1 * f64::from(i);
                Plane::new(&two_resonances(&[0.02 * x, 0.055 * x, 0.2 * x], &[0.2 * x, 0.7 * x, 2.0 * x]))
            })
            .collect();
        let (speeds, forces) = speeds_and_forces(&textures);
        assert_eq!((speeds.len(), forces.len()), (8, 5));
        assert_eq!((speeds[7], forces[4]), (0.2 * 1.5, 2.0 * 1.5));
        let ratio = speeds[1] / speeds[0];
        assert!(speeds.windows(2).all(|w| (w[1] / w[0] - ratio).abs() < 1e-9), "{speeds:?}");
    }

    #[test]
    fn published_boundaries_and_single_contacts_are_no_obstacle() {
        let (speeds, forces) = speeds_and_forces(&[Plane::new(&arma(4, 2))]);
        assert!(speeds[0] > 0.0 && forces[0] > 0.0);
        let single = speeds_and_forces(&[Plane::new(&two_resonances(&[0.1], &[1.0]))]);
        assert_eq!(single, (vec![0.1], vec![1.0]));
    }
}
