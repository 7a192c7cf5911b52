//! Speed-force plane of a texture: measured nodes, the boundary around them, and the interpolation between.

mod closed;
mod fade;
mod hull_edges;
mod prepared;
mod radial;
mod refined;
mod table;
mod values;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use shagreen_synth::stick_slip::Friction;

pub use crate::texture::plane::prepared::Prepared;
pub use crate::texture::plane::table::{About, TABLE_MAGIC, TableError, table_about};

use crate::dsp::arma;
use crate::dsp::band_power::{BandPower, band_powers};
use crate::dsp::lsf::ar_from_lsf;
use crate::maths::triangulation::{Triangulation, Xy};
use crate::texture::height_map::HeightMap;
use crate::texture::plane::closed::closed;
use crate::texture::plane::fade::fading;
use crate::texture::plane::hull_edges::HullEdges;
use crate::texture::plane::radial::RadialGrain;
use crate::texture::plane::values::{Strength, Values};
use crate::texture::relief::Relief;
use crate::texture::stick_slip::friction;
use crate::texture::{self, Interpolation, MIN_NODE_DISTANCE, PublishedNode, TextureModel};
use crate::units::{Contact, Hertz, Radians};

/// Grain of a texture at any contact.
///
/// Measured nodes are interpolated in one of two ways.
/// - Barycentric, in the Delaunay triangles over speed and force, each divided by its maximum. Silent nodes at zero
///   speed or force, and the values of the nearest measured nodes along the edges of highest speed and force, close the
///   range ([`crate::texture::boundary`]). Inside the convex hull of the measured nodes, these are interpolated.
///   Between the axes and the lowest measured speeds and forces, the level fades to zero.
/// - By radial basis functions, constant beyond the measured range. Below the lowest measured speed or force, the level
///   decreases linearly to zero at zero speed or force.
///
/// Published nodes already include the boundary, and are interpolated in triangles.
///
/// A texture with a lay has one grain across and one along it. Between them, the line spectral frequencies and the
/// squared level are linear in `sin² θ`, with the angle `θ` from the texture's x axis, across its lay, to the stroke.
#[derive(Clone, Debug)]
pub struct Plane {
    rate: Hertz,
    speed_max_mps: f64,
    force_max_n: f64,
    /// Speed in m/s and force in N of the nodes that are not on the axes.
    measured: Vec<[f64; 2]>,
    vertices: Vec<Values>,
    triangulation: Triangulation,
    /// Radial basis, if used; the triangles then approximate it.
    radial: Option<RadialGrain>,
    /// Grain along the lay.
    along: Option<Box<Plane>>,
    surface: Surface,
}

/// What depends on the position of the tip instead of its speed and force, and its friction.
#[derive(Clone, Debug)]
struct Surface {
    relief: Option<Arc<Relief>>,
    height_map: Option<Arc<HeightMap>>,
    friction: Option<Friction>,
    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    turn_rad: f64,
}

impl Surface {
    fn of(texture: &TextureModel) -> Self {
        let friction = friction(texture.friction(), texture.stick_slip());
        Self {
            relief: texture.relief().cloned(),
            height_map: texture.height_map().cloned(),
            // The renderer refuses a coefficient that is not finite in `f32`.
            friction: friction.map(|of| Friction { kinetic: of.kinetic.min(f32::MAX), ..of }),
            turn_rad: texture.turn_rad(),
        }
    }
}

/// Grain at one contact: white noise filtered by a moving-average part and an AR part.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// Model rate.
    pub rate: Hertz,
    /// Line spectral frequencies of the AR part in radians.
    pub lsf: Vec<f64>,
    /// Line spectral frequencies of the moving-average part in radians; empty without such a part.
    pub ma_lsf: Vec<f64>,
    /// Root mean square acceleration in m/s².
    pub level_mps2: f64,
    /// Standard deviation of the white noise that gives this level, in m/s²; it includes the gain of a published node.
    pub sigma_mps2: f64,
}

impl Grain {
    /// AR coefficients `a_1 … a_p`.
    pub fn ar(&self) -> Vec<f64> {
        ar_from_lsf(&self.lsf)
    }

    /// Moving-average coefficients `b_1 … b_q`.
    pub fn ma(&self) -> Vec<f64> {
        ar_from_lsf(&self.ma_lsf)
    }

    /// Variance of the excitation that gives the level, in (m/s²)².
    pub fn excitation_variance(&self) -> f64 {
        self.sigma_mps2 * self.sigma_mps2
    }

    /// Transfer function `sqrt(2 σ² / rate) B / A` at each frequency, as (real, imaginary). Its squared magnitude is
    /// the power spectral density.
    pub fn response(&self, frequencies: &[Hertz]) -> Vec<(f64, f64)> {
        let scale = self.sigma_mps2 * (2.0 / self.rate.0).sqrt();
        let response = arma::response(&self.ar(), &self.ma(), self.rate, frequencies);
        response.into_iter().map(|(re, im)| (scale * re, scale * im)).collect()
    }

    /// One-sided power spectral density in (m/s²)²/Hz at each frequency.
    pub fn psd(&self, frequencies: &[Hertz]) -> Vec<f64> {
        self.response(frequencies).into_iter().map(|(re, im)| re * re + im * im).collect()
    }

    /// Power in (m/s²)² and mean frequency in each band between neighboring edges, which ascend within 0 Hz and half of the
    /// model rate.
    pub fn band_powers(&self, edges: &[Hertz]) -> Vec<BandPower> {
        let breaks: Vec<Hertz> = self.lsf.iter().map(|radians| Hertz(self.rate.0 * radians / TAU)).collect();
        band_powers(|frequencies| self.psd(frequencies), edges, &breaks)
    }
}

impl Plane {
    /// Creates the plane of a texture.
    pub fn new(texture: &TextureModel) -> Self {
        let highest = Contact { speed: texture.speed_max(), force: texture.force_max() };
        let (speed_max_mps, force_max_n) = (highest.speed.0, highest.force.0);
        // A node that is off an edge by a rounding error would form a triangle as thin as that error, so it is moved
        // onto the edge. At zero this applies to published nodes only, because measured nodes may validly lie that
        // close to zero.
        let is_published = matches!(texture.grain(), texture::Grain::Published { .. });
        let snapped = |share: f64| match share {
            _ if share > 1.0 - MIN_NODE_DISTANCE => 1.0,
            _ if share < MIN_NODE_DISTANCE && is_published => 0.0,
            _ => share,
        };
        let place = |c: Contact| [c.speed.0 / speed_max_mps, c.force.0 / force_max_n].map(snapped);
        let places: Vec<Xy> = texture.contacts().map(place).collect();
        let (mut points, radial) = match texture.grain() {
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
        let mut triangulation = triangulated(&points, radial.is_some());
        if radial.is_none() && !is_published {
            let fading = fading(&points, texture.n_nodes(), &triangulation);
            // Most textures need none, and keep their triangles.
            if !fading.is_empty() {
                points.extend(fading);
                triangulation = triangulated(&points, false);
            }
            let mut hull_edges = HullEdges::new(&points, texture.n_nodes());
            // Every round halves edges, down to a shortest length, so that the loop ends.
            loop {
                let added = hull_edges.bisect(&points, &triangulation);
                if added.is_empty() {
                    break;
                }
                points.extend(added);
                triangulation = triangulated(&points, false);
            }
        }
        let vertices = points.into_iter().map(|(_, values)| values).collect();
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
            along: texture.along_model().map(|along| Box::new(Self::new(&along))),
            surface: Surface::of(texture),
        }
    }

    /// Grain at `contact`, for a stroke across the lay. Above the highest speed or force, it is the grain at that speed
    /// or force; at zero speed or force, it is silent.
    pub fn at(&self, contact: Contact) -> Grain {
        self.values_at(contact).into_grain(self.rate)
    }

    /// Grain at `contact`, as [`Plane::at`], for a stroke at an angle from the texture's x axis.
    pub fn at_angle(&self, contact: Contact, angle: Radians) -> Grain {
        let across = self.values_at(contact);
        let mixed = match &self.along {
            Some(along) => across.mixed_with_along(&along.values_at(contact), angle.0.sin().powi(2)),
            None => across,
        };
        mixed.into_grain(self.rate)
    }

    fn values_at(&self, contact: Contact) -> Values {
        let share = |x: f64, max: f64| if x > 0.0 { (x / max).min(1.0) } else { 0.0 };
        let at = [share(contact.speed.0, self.speed_max_mps), share(contact.force.0, self.force_max_n)];
        let mut values = match &self.radial {
            Some(radial) => radial.at(at),
            None => self.in_triangles(at),
        };
        // A published texture can have a level above zero on its axes.
        if at.contains(&0.0) {
            values.strength = values.strength.silent();
        }
        values
    }

    /// Grain at `contact`, as [`Plane::at`], for a stroke in a direction on the pad: an angle from its x axis,
    /// counterclockwise.
    pub fn toward(&self, contact: Contact, direction: Radians) -> Grain {
        self.at_angle(contact, Radians(direction.0 - self.surface.turn_rad))
    }

    /// Plane of the grain along the lay; `None` for an isotropic texture.
    pub fn along(&self) -> Option<&Self> {
        self.along.as_deref()
    }

    /// Angle of the texture's x axis on the pad, counterclockwise.
    pub fn turn(&self) -> Radians {
        Radians(self.surface.turn_rad)
    }

    /// Direction of the lay on the pad, as an angle from its x axis, counterclockwise; `None` for an isotropic texture.
    pub fn lay(&self) -> Option<Radians> {
        self.along.is_some().then_some(Radians(FRAC_PI_2 + self.surface.turn_rad))
    }

    /// Friction for the renderer; `None` without a known kinetic coefficient.
    pub fn friction(&self) -> Option<Friction> {
        self.surface.friction
    }

    /// Position-dependent relief, if the texture has one.
    pub fn relief(&self) -> Option<&Arc<Relief>> {
        self.surface.relief.as_ref()
    }

    /// Height map, if the texture has one.
    pub fn height_map(&self) -> Option<&Arc<HeightMap>> {
        self.surface.height_map.as_ref()
    }

    /// Model rate.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// Orders of the AR part and of the moving-average part.
    pub(crate) fn orders(&self) -> [usize; 2] {
        [self.vertices[0].lsf.len(), self.vertices[0].ma_lsf.len()]
    }

    /// Speed in m/s and force in N of each node that is not on the axes.
    pub(crate) fn measured(&self) -> &[[f64; 2]] {
        &self.measured
    }

    /// Lowest and highest measured speed in m/s, then lowest and highest measured force in N.
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
            // The triangles cover the whole rectangle; a point outside by a rounding error lies on its edge.
            None => match self.triangulation.nearest_on_outline(at) {
                Some((_, [a, b])) => [a, b, (b.0, 0.0)],
                None => unreachable!("a plane always has corners"),
            },
        };
        Values::mean(&parts.map(|(vertex, weight)| (&self.vertices[vertex], weight)))
    }
}

/// Triangles over nodes in their order, or over the corners of a radial basis.
fn triangulated(points: &[(Xy, Values)], is_radial: bool) -> Triangulation {
    let places: Vec<Xy> = points.iter().map(|(at, _)| *at).collect();
    let made = if is_radial { Triangulation::new(&places) } else { Triangulation::in_order(&places) };
    match made {
        Ok(triangulation) => triangulation,
        Err(error) => unreachable!("the model checks keep relative coordinates in 0..1: {error}"),
    }
}

fn published(node: &PublishedNode) -> Values {
    let strength = Strength::Excitation { variance: node.variance, gain: node.gain };
    Values { lsf: node.ar_lsf.clone(), ma_lsf: node.ma_lsf.clone(), strength }
}

#[cfg(test)]
mod tests;
