//! A texture's speed-force plane: measured nodes, the boundary around them, and what lies between.

mod prepared;
mod radial;
mod refined;
mod values;

use std::sync::Arc;

pub use crate::plane::prepared::Prepared;

use crate::arma;
use crate::boundary::{BoundaryModel, boundary};
use crate::lsf::ar_from_lsf;
use crate::plane::radial::RadialGrain;
use crate::plane::values::{Strength, Values};
use crate::relief::Relief;
use crate::texture::{self, GrainNode, Interpolation, MIN_NODE_DISTANCE, PublishedNode, TextureModel};
use crate::triangulation::{Triangulation, Xy};
use crate::units::{Contact, Hertz};

/// The grain of a texture at any contact.
///
/// Measured nodes are interpolated in the Delaunay triangles over speed and force, each divided by its maximum, closed by
/// silent models at zero speed or force and by copies along the edges of full speed and force; or by a radial basis,
/// held at its value on the edge of what was measured, with a level that below the lowest speed or force falls in a
/// straight line to silence. Published nodes bring their boundary with them.
#[derive(Clone, Debug)]
pub struct Plane {
    rate: Hertz,
    speed_max_mps: f64,
    force_max_n: f64,
    /// Speed in m/s and force in N of what was measured off the axes.
    measured: Vec<[f64; 2]>,
    vertices: Vec<Values>,
    triangulation: Triangulation,
    /// Where this is, the triangles only stand for it.
    radial: Option<RadialGrain>,
    /// What lies at each place, whatever the contact.
    relief: Option<Arc<Relief>>,
}

/// The grain at one contact: white noise through a moving average and a predictor.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// Samples a second of the model.
    pub rate: Hertz,
    /// Line spectral frequencies of the predictor in radians.
    pub lsf: Vec<f64>,
    /// Line spectral frequencies of the moving average in radians; none where there is none.
    pub ma_lsf: Vec<f64>,
    /// Root mean square acceleration in m/s².
    pub level_mps2: f64,
    /// Standard deviation of the white noise that gives the level, in m/s²; a published gain is part of it.
    pub sigma_mps2: f64,
}

impl Grain {
    /// Predictor coefficients `a_1 … a_p`.
    pub fn ar(&self) -> Vec<f64> {
        ar_from_lsf(&self.lsf)
    }

    /// Coefficients `b_1 … b_q` of the moving average.
    pub fn ma(&self) -> Vec<f64> {
        ar_from_lsf(&self.ma_lsf)
    }

    /// Variance of the excitation that gives the level, in (m/s²)².
    pub fn excitation_variance(&self) -> f64 {
        self.sigma_mps2 * self.sigma_mps2
    }

    /// Transfer function `sqrt(2 σ² / rate) B / A` at each frequency, as (real, imaginary): its square is the density.
    pub fn response(&self, frequencies: &[Hertz]) -> Vec<(f64, f64)> {
        let scale = self.sigma_mps2 * (2.0 / self.rate.0).sqrt();
        let response = arma::response(&self.ar(), &self.ma(), self.rate, frequencies);
        response.into_iter().map(|(re, im)| (scale * re, scale * im)).collect()
    }

    /// One-sided power spectral density in (m/s²)²/Hz at each frequency.
    pub fn psd(&self, frequencies: &[Hertz]) -> Vec<f64> {
        self.response(frequencies).into_iter().map(|(re, im)| re * re + im * im).collect()
    }
}

impl Plane {
    /// The plane of a texture.
    pub fn new(texture: &TextureModel) -> Self {
        let highest = Contact { speed: texture.speed_max(), force: texture.force_max() };
        let (speed_max_mps, force_max_n) = (highest.speed.0, highest.force.0);
        // A rounding error off an edge would make a triangle that is as thin. Measured nodes may be as near to zero.
        let is_published = matches!(texture.grain(), texture::Grain::Published { .. });
        let snapped = |share: f64| match share {
            _ if share > 1.0 - MIN_NODE_DISTANCE => 1.0,
            _ if share < MIN_NODE_DISTANCE && is_published => 0.0,
            _ => share,
        };
        let place = |c: Contact| [c.speed.0 / speed_max_mps, c.force.0 / force_max_n].map(snapped);
        let places: Vec<Xy> = texture.contacts().map(place).collect();
        let (points, radial) = match texture.grain() {
            texture::Grain::Measured { nodes, interpolation } => {
                let radial = match interpolation {
                    Interpolation::RadialBasis => RadialGrain::new(nodes, &places),
                    Interpolation::Barycentric => None,
                };
                let points = match &radial {
                    Some(radial) => radial.corners().into_iter().map(|at| (at, radial.at(at))).collect(),
                    None => closed(nodes, &places, highest),
                };
                (points, radial)
            }
            texture::Grain::Published { nodes } => {
                (places.into_iter().zip(nodes.iter().map(published)).collect(), None)
            }
        };
        let (points, vertices): (Vec<Xy>, Vec<Values>) = points.into_iter().unzip();
        let triangulated =
            if radial.is_some() { Triangulation::new(&points) } else { Triangulation::in_order(&points) };
        let triangulation = match triangulated {
            Ok(triangulation) => triangulation,
            Err(error) => unreachable!("a model's own checks keep shares of the highest in 0..1: {error}"),
        };
        let contacts = texture.contacts().map(|c| [c.speed.0, c.force.0]);
        let measured = contacts.filter(|c| c[0] > 0.0 && c[1] > 0.0).collect();
        Self {
            rate: texture.rate(),
            speed_max_mps,
            force_max_n,
            measured,
            vertices,
            triangulation,
            radial,
            relief: texture.relief().cloned(),
        }
    }

    /// The grain at `contact`; outside the measured range that of its nearest edge, in the air silent.
    pub fn at(&self, contact: Contact) -> Grain {
        let share = |x: f64, max: f64| if x > 0.0 { (x / max).min(1.0) } else { 0.0 };
        let at = [share(contact.speed.0, self.speed_max_mps), share(contact.force.0, self.force_max_n)];
        let mut values = match &self.radial {
            Some(radial) => radial.at(at),
            None => self.in_triangles(at),
        };
        // A published texture may sound on its axes.
        if at.contains(&0.0) {
            values.strength = values.strength.silent();
        }
        values.into_grain(self.rate)
    }

    /// What lies at each place, where anything does.
    pub fn relief(&self) -> Option<&Arc<Relief>> {
        self.relief.as_ref()
    }

    /// Samples a second.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// Orders of the predictor and of the moving average.
    pub(crate) fn orders(&self) -> [usize; 2] {
        [self.vertices[0].lsf.len(), self.vertices[0].ma_lsf.len()]
    }

    /// Speed in m/s and force in N of everything that was measured off the axes.
    pub(crate) fn measured(&self) -> &[[f64; 2]] {
        &self.measured
    }

    /// Lowest and highest speed in m/s, then force in N, at which something was measured.
    pub(crate) fn measured_range(&self) -> [(f64, f64); 2] {
        let highest = [self.speed_max_mps, self.force_max_n];
        [0, 1]
            .map(|axis| (self.measured.iter().map(|c| c[axis]).fold(highest[axis], f64::min), highest[axis]))
    }

    fn in_triangles(&self, at: Xy) -> Values {
        let parts = match self.triangulation.locate(at) {
            Some((triangle, weights)) => {
                let [a, b, c] = self.triangulation.corners(triangle);
                [(a, weights[0]), (b, weights[1]), (c, weights[2])]
            }
            // The triangles cover the whole rectangle; what is a rounding error outside lies on its edge.
            None => match self.triangulation.nearest_on_outline(at) {
                Some((_, [a, b])) => [a, b, (b.0, 0.0)],
                None => unreachable!("a plane has corners"),
            },
        };
        Values::mean(&parts.map(|(vertex, weight)| (&self.vertices[vertex], weight)))
    }
}

/// Measured nodes and the boundary around them.
fn closed(nodes: &[GrainNode], places: &[Xy], highest: Contact) -> Vec<(Xy, Values)> {
    let measured = nodes.iter().map(|n| Values::measured(n.lsf.clone(), n.level_mps2));
    let mut points: Vec<(Xy, Values)> = places.iter().copied().zip(measured).collect();
    let contacts: Vec<Contact> = nodes.iter().map(|n| Contact { speed: n.speed, force: n.force }).collect();
    for BoundaryModel { at, copy_of, silent } in boundary(&contacts, highest) {
        let node = &nodes[copy_of];
        let place = [at.speed.0 / highest.speed.0, at.force.0 / highest.force.0];
        points.push((place, Values::measured(node.lsf.clone(), if silent { 0.0 } else { node.level_mps2 })));
    }
    points
}

fn published(node: &PublishedNode) -> Values {
    let strength = Strength::Excitation { variance: node.variance, gain: node.gain };
    Values { lsf: node.ar_lsf.clone(), ma_lsf: node.ma_lsf.clone(), strength }
}

#[cfg(test)]
mod tests;
