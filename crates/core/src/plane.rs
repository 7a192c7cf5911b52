//! A texture's speed-force plane: measured nodes, the boundary around them, and what lies between.

mod prepared;
mod refined;

pub use crate::plane::prepared::Prepared;

use crate::ar::{power_gain, psd};
use crate::boundary::{BoundaryModel, boundary};
use crate::lsf::ar_from_lsf;
use crate::texture::{MIN_NODE_DISTANCE, TextureModel};
use crate::triangulation::Triangulation;
use crate::units::{Contact, Hertz};

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
        let highest = Contact { speed: texture.speed_max(), force: texture.force_max() };
        let (speed_max_mps, force_max_n) = (highest.speed.0, highest.force.0);
        let mut points: Vec<[f64; 2]> = Vec::new();
        let mut vertices = Vec::new();
        for node in texture.nodes() {
            // A rounding error off a far edge would make a triangle that is as thin.
            let snapped = |share: f64| if share > 1.0 - MIN_NODE_DISTANCE { 1.0 } else { share };
            points.push([node.speed.0 / speed_max_mps, node.force.0 / force_max_n].map(snapped));
            vertices.push((node.lsf.clone(), node.level_mps2));
        }
        let measured: Vec<Contact> = texture.contacts().collect();
        for BoundaryModel { at, copy_of, silent } in boundary(&measured, highest) {
            let node = &texture.nodes()[copy_of];
            points.push([at.speed.0 / speed_max_mps, at.force.0 / force_max_n]);
            vertices.push((node.lsf.clone(), if silent { 0.0 } else { node.level_mps2 }));
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

#[cfg(test)]
mod tests;
