//! A texture's speed-force plane: measured nodes, the boundary around them, and what lies between.

mod prepared;
mod refined;

pub use crate::plane::prepared::Prepared;

use crate::ar::{power_gain, psd};
use crate::lsf::ar_from_lsf;
use crate::texture::{MIN_NODE_DISTANCE, TextureModel};
use crate::triangulation::Triangulation;
use crate::units::{Contact, Hertz};

// The boundary, and its spacings in mm/s and N, are those of H. Culbertson, J. Unwin and K. Kuchenbecker, "Modeling and
// rendering realistic textures from unconstrained tool-surface interactions" (2014).
/// Spacing of silent models along the axis of zero force, in m/s.
const SPEED_STEP_MPS: f64 = 0.040;
/// Spacing of silent models along the axis of zero speed, in N, after the first at [`FIRST_FORCE_N`].
const FORCE_STEP_N: f64 = 1.25;
/// First silent model on the axis of zero speed, in N.
const FIRST_FORCE_N: f64 = 0.5;

/// The grain of a texture at any contact: barycentric in the Delaunay triangles over speed and force, each divided by
/// its maximum, closed by silent models at zero speed or force and by copies along the edges of full speed and force.
#[derive(Clone, Debug)]
pub struct Plane {
    rate: Hertz,
    speed_max_mps: f64,
    force_max_n: f64,
    /// Line spectral frequencies and level of every vertex.
    vertices: Vec<(Vec<f64>, f64)>,
    triangulation: Triangulation,
}

/// The grain at one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// Samples a second of the model.
    pub rate: Hertz,
    /// Line spectral frequencies in radians.
    pub lsf: Vec<f64>,
    /// Root mean square acceleration in m/s².
    pub level_mps2: f64,
}

impl Grain {
    /// Predictor coefficients `a_1 … a_p`.
    pub fn ar(&self) -> Vec<f64> {
        ar_from_lsf(&self.lsf)
    }

    /// Variance of the excitation that gives the level, in (m/s²)².
    pub fn excitation_variance(&self) -> f64 {
        self.level_mps2 * self.level_mps2 / power_gain(&self.ar())
    }

    /// One-sided power spectral density in (m/s²)²/Hz at each frequency.
    pub fn psd(&self, frequencies: &[Hertz]) -> Vec<f64> {
        psd(&self.ar(), self.excitation_variance(), self.rate, frequencies)
    }
}

impl Plane {
    /// The plane of a texture.
    pub fn new(texture: &TextureModel) -> Self {
        let (speed_max_mps, force_max_n) = (texture.speed_max().0, texture.force_max().0);
        let mut points: Vec<[f64; 2]> = Vec::new();
        let mut vertices = Vec::new();
        for node in texture.nodes() {
            // A rounding error off a far edge would make a triangle that is as thin.
            let snapped = |share: f64| if share > 1.0 - MIN_NODE_DISTANCE { 1.0 } else { share };
            points.push([node.speed.0 / speed_max_mps, node.force.0 / force_max_n].map(snapped));
            vertices.push((node.lsf.clone(), node.level_mps2));
        }
        let n_measured = points.len();
        // A boundary model has the spectrum of the measured one nearest in mm/s and N.
        let nearest = |speed_mps: f64, force_n: f64| {
            let distance = |i: &usize| {
                let node = &texture.nodes()[*i];
                (1e3 * (node.speed.0 - speed_mps)).hypot(node.force.0 - force_n)
            };
            (0..n_measured).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let speeds = steps(speed_max_mps, SPEED_STEP_MPS, SPEED_STEP_MPS);
        let forces = steps(force_max_n, FIRST_FORCE_N, FORCE_STEP_N);
        let silent =
            speeds.iter().map(|v| [*v, 0.0]).chain(forces.iter().map(|f| [0.0, *f])).chain([[0.0, 0.0]]);
        for [v, f] in silent {
            points.push([v / speed_max_mps, f / force_max_n]);
            vertices.push((texture.nodes()[nearest(v, f)].lsf.clone(), 0.0));
        }
        // Copies along the far edges, but where something was measured on the edge close by.
        let far = forces.iter().map(|f| [speed_max_mps, *f]).chain(speeds.iter().map(|v| [*v, force_max_n]));
        for [v, f] in far {
            let at = [v / speed_max_mps, f / force_max_n];
            let reach = [SPEED_STEP_MPS / speed_max_mps, FORCE_STEP_N / force_max_n];
            let corner = at == [1.0, 1.0];
            let taken = points.iter().enumerate().any(|(i, p)| {
                let same_edge = (at[0] == 1.0 && p[0] == 1.0 && (p[1] - at[1]).abs() < reach[1])
                    || (at[1] == 1.0 && p[1] == 1.0 && (p[0] - at[0]).abs() < reach[0]);
                *p == at || (i < n_measured && same_edge && !corner)
            });
            if !taken {
                let node = &texture.nodes()[nearest(v, f)];
                points.push(at);
                vertices.push((node.lsf.clone(), node.level_mps2));
            }
        }
        let triangulation = match Triangulation::new(&points) {
            Ok(triangulation) => triangulation,
            Err(error) => unreachable!("a model's own checks keep shares of the highest in 0..1: {error}"),
        };
        Self { rate: texture.rate(), speed_max_mps, force_max_n, vertices, triangulation }
    }

    /// The grain at `contact`; outside the measured range that of its nearest edge, in the air silent.
    pub fn at(&self, contact: Contact) -> Grain {
        let share = |x: f64, max: f64| if x > 0.0 { (x / max).min(1.0) } else { 0.0 };
        let at = [share(contact.speed.0, self.speed_max_mps), share(contact.force.0, self.force_max_n)];
        let order = self.vertices[0].0.len();
        let parts = match self.triangulation.locate(at, 0) {
            Some((triangle, weights)) => {
                let [a, b, c] = self.triangulation.triangles()[triangle];
                [(a, weights[0]), (b, weights[1]), (c, weights[2])]
            }
            // The triangles cover the whole rectangle; what is a rounding error outside lies on its edge.
            None => match self.triangulation.nearest_on_outline(at) {
                Some((_, [a, b])) => [a, b, (b.0, 0.0)],
                None => unreachable!("a plane has corners"),
            },
        };
        let mix = |value: &dyn Fn(usize) -> f64| parts.iter().map(|(c, w)| w * value(*c)).sum::<f64>();
        Grain {
            rate: self.rate,
            lsf: (0..order).map(|i| mix(&|c| self.vertices[c].0[i])).collect(),
            level_mps2: mix(&|c| self.vertices[c].1),
        }
    }
}

/// `first, first + step, …` below `max` by more than a hundredth of a step, and `max` itself.
fn steps(max: f64, first: f64, step: f64) -> Vec<f64> {
    let below = max - 0.01 * step;
    let mut out: Vec<f64> =
        (0..1000).map(|i| first + step * f64::from(i)).take_while(|x| *x < below).collect();
    out.push(max);
    out
}

#[cfg(test)]
mod tests;
