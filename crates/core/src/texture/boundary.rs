//! Boundary nodes that close the speed-force range around measured nodes.
//!
//! They are silent at zero speed or zero force. At the highest speed and at the highest force they copy a measured
//! model, for faster or stronger strokes than the measured ones. This is the rule for files of the published format; the
//! plane of a measured texture ([`crate::texture::plane`]) has other values at these places.
//!
//! The rule and its spacings are from H. Culbertson, J. Unwin and K. Kuchenbecker, "Modeling and rendering realistic
//! textures from unconstrained tool-surface interactions" (2014).

use crate::texture::MIN_NODE_DISTANCE;
use crate::units::{Contact, MetersPerSecond, Newtons};

/// Spacing of silent nodes along the axis of zero force, in m/s.
const SPEED_STEP_MPS: f64 = 0.040;
/// Spacing of silent nodes along the axis of zero speed, in N, after the first at [`FIRST_FORCE_N`].
const FORCE_STEP_N: f64 = 1.25;
/// First silent node on the axis of zero speed, in N.
const FIRST_FORCE_N: f64 = 0.5;

/// Model at a boundary node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryModel {
    /// Speed and force of the node.
    pub at: Contact,
    /// Index of the measured model whose spectrum it copies: the nearest in raw mm/s and N.
    pub copy_of: usize,
    /// Whether the level is zero; otherwise the model is a full copy.
    pub silent: bool,
}

/// Boundary nodes of models at the contacts `measured`, up to the speed and force `highest`.
///
/// The silent nodes come first, then the copies along the edges of highest speed and force. A copy is omitted if a
/// measured node lies nearby on the same edge. Empty if `measured` is empty.
pub fn boundary(measured: &[Contact], highest: Contact) -> Vec<BoundaryModel> {
    let (speed_max, force_max) = (highest.speed.0, highest.force.0);
    let (speeds, forces) =
        (steps(speed_max, SPEED_STEP_MPS, SPEED_STEP_MPS), steps(force_max, FIRST_FORCE_N, FORCE_STEP_N));
    let silent = speeds.iter().map(|v| [*v, 0.0]).chain(forces.iter().map(|f| [0.0, *f])).chain([[0.0, 0.0]]);
    let far = forces.iter().map(|f| [speed_max, *f]).chain(speeds.iter().map(|v| [*v, force_max]));
    // A texture treats closer nodes as one.
    let is_near = |a: f64, b: f64, max: f64| (a - b).abs() <= MIN_NODE_DISTANCE * max;
    let is_taken = |[v, f]: [f64; 2], copies: &[[f64; 2]]| {
        let is_corner = v == speed_max && f == force_max;
        let is_here = |m: &Contact| {
            let (here_v, here_f) = (is_near(m.speed.0, v, speed_max), is_near(m.force.0, f, force_max));
            let same_edge = (v == speed_max && here_v && (m.force.0 - f).abs() < FORCE_STEP_N)
                || (f == force_max && here_f && (m.speed.0 - v).abs() < SPEED_STEP_MPS);
            (here_v && here_f) || (same_edge && !is_corner)
        };
        measured.iter().any(is_here) || copies.contains(&[v, f])
    };
    let mut copies: Vec<[f64; 2]> = Vec::new();
    for place in far {
        if !is_taken(place, &copies) {
            copies.push(place);
        }
    }
    let model = |[v, f]: [f64; 2], silent: bool| {
        let at = Contact { speed: MetersPerSecond(v), force: Newtons(f) };
        nearest(measured, at).map(|copy_of| BoundaryModel { at, copy_of, silent })
    };
    silent
        .filter_map(|place| model(place, true))
        .chain(copies.iter().filter_map(|place| model(*place, false)))
        .collect()
}

/// Index of the contact nearest to `to` in raw mm/s and N, so that speed dominates; the first of equally near ones.
fn nearest(contacts: &[Contact], to: Contact) -> Option<usize> {
    let distance = |i: &usize| {
        let Contact { speed, force } = contacts[*i];
        (speed.mm_per_s() - to.speed.mm_per_s()).hypot(force.0 - to.force.0)
    };
    (0..contacts.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Maximum number of steps along an axis, which limits the number of triangles for unrealistic speeds and forces.
const MAX_STEPS: u32 = 100;

/// Returns `first, first + step, …` up to a hundredth of a step below `max`, and `max` itself. The step is widened if
/// there would be more than [`MAX_STEPS`].
fn steps(max: f64, first: f64, step: f64) -> Vec<f64> {
    let step = step.max(max / f64::from(MAX_STEPS));
    let below = max - 0.01 * step;
    let mut out: Vec<f64> =
        (0..MAX_STEPS).map(|i| first + step * f64::from(i)).take_while(|x| *x < below).collect();
    out.push(max);
    out
}

#[cfg(test)]
mod tests {
    use super::{BoundaryModel, boundary};
    use crate::units::Contact;

    fn at(mm_per_s: f64, n: f64) -> Contact {
        Contact::from_mm_per_s_and_n(mm_per_s, n)
    }

    /// Nodes in mm/s and N, rounded for readable tests.
    fn places(models: &[BoundaryModel], silent: bool) -> Vec<(f64, f64, usize)> {
        let round = |x: f64| (1e6 * x).round() / 1e6;
        let of_kind = models.iter().filter(|model| model.silent == silent);
        of_kind.map(|m| (round(m.at.speed.mm_per_s()), round(m.at.force.0), m.copy_of)).collect()
    }

    #[test]
    fn lies_where_it_was_published() {
        let models = boundary(&[at(50.0, 1.0), at(80.0, 1.5)], at(90.0, 2.0));
        let silent = [(40.0, 0.0), (80.0, 0.0), (90.0, 0.0), (0.0, 0.5), (0.0, 1.75), (0.0, 2.0), (0.0, 0.0)];
        let of = [0, 1, 1, 0, 0, 0, 0];
        let expected: Vec<_> = silent.iter().zip(of).map(|((v, f), of)| (*v, *f, of)).collect();
        assert_eq!(places(&models, true), expected);
        let far = [(90.0, 0.5, 1), (90.0, 1.75, 1), (90.0, 2.0, 1), (40.0, 2.0, 0), (80.0, 2.0, 1)];
        assert_eq!(places(&models, false), far);
    }

    #[test]
    fn measurements_on_the_far_edges_stay() {
        // Measured at the highest speed, at the highest force, and at both.
        let models = boundary(&[at(90.0, 1.0), at(50.0, 2.0), at(90.0, 2.0)], at(90.0, 2.0));
        assert_eq!(places(&models, false), []);
        assert_eq!(boundary(&[], at(90.0, 2.0)), []);
    }

    #[test]
    fn no_speed_makes_it_long() {
        assert!(boundary(&[at(50.0, 1.0)], at(1e8, 1e4)).len() <= 410);
    }
}
