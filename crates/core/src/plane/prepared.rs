//! A texture as the renderer takes it: in `f32`, with triangles small enough for the level.

use shagreen_synth::texture::{Excitation, MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, Triangle};

use crate::plane::Plane;
use crate::plane::refined::{Refined, Vertex};
use crate::plane::values::Strength;
use crate::relief::ReliefOctaves;
use crate::triangulation::weights_at;

/// A texture as the renderer takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    rate_hz: f32,
    order: usize,
    ma_order: usize,
    speed_max_mps: f32,
    force_max_n: f32,
    nodes: Vec<Node>,
    /// One for each node, or none.
    excitations: Vec<Excitation>,
    triangles: Vec<Triangle>,
    relief: Option<ReliefOctaves>,
}

impl Plane {
    /// What the renderer needs: nodes and triangles in `f32`, with the gain of the filter at corners and at the
    /// middles of edges, and more triangles than the plane has where a quadratic through these would miss the level,
    /// or triangles a radial basis.
    pub fn prepare(&self) -> Prepared {
        let points = self.triangulation.points().iter().zip(&self.vertices);
        let vertices = points.map(|(at, values)| Vertex { at: *at, values: values.clone() }).collect();
        let refined = Refined::new(vertices, &self.triangulation, self.radial.as_ref());
        Prepared {
            rate_hz: self.rate.0 as f32,
            order: self.vertices[0].lsf.len(),
            ma_order: self.vertices[0].ma_lsf.len(),
            speed_max_mps: self.speed_max_mps as f32,
            force_max_n: self.force_max_n as f32,
            nodes: refined.vertices.iter().map(node).collect(),
            excitations: refined.vertices.iter().filter_map(excitation).collect(),
            triangles: (0..refined.triangles.len()).map(|index| triangle(&refined, index)).collect(),
            relief: self.relief.as_ref().map(|relief| relief.octaves()),
        }
    }
}

impl Prepared {
    /// Samples a second of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.rate_hz
    }

    /// What the texture is made of.
    pub fn parts(&self) -> Parts<'_> {
        Parts {
            rate_hz: self.rate_hz,
            order: self.order,
            ma_order: self.ma_order,
            speed_max_mps: self.speed_max_mps,
            force_max_n: self.force_max_n,
            nodes: &self.nodes,
            excitations: &self.excitations,
            triangles: &self.triangles,
            relief: self.relief.as_ref().map(ReliefOctaves::view),
        }
    }

    /// The texture lent to a renderer.
    pub fn view(&self) -> Texture<'_> {
        // A model that was accepted makes slices that are accepted; a property test holds it.
        Texture::checked_before(self.parts())
    }
}

fn node(vertex: &Vertex) -> Node {
    Node { level_mps2: vertex.values.level_mps2() as f32, lsf: narrow(&vertex.values.lsf) }
}

fn excitation(vertex: &Vertex) -> Option<Excitation> {
    match vertex.values.strength {
        Strength::Level { .. } => None,
        Strength::Excitation { variance, gain } => Some(Excitation {
            variance: variance as f32,
            gain: gain as f32,
            ma_lsf: narrow(&vertex.values.ma_lsf),
        }),
    }
}

fn narrow(lsf: &[f64]) -> [f32; MAX_ORDER] {
    let mut out = [0.0; MAX_ORDER];
    for (narrow, wide) in out.iter_mut().zip(lsf) {
        *narrow = *wide as f32;
    }
    out
}

fn triangle(refined: &Refined<'_>, index: usize) -> Triangle {
    let corners = refined.triangles[index];
    // The weights are affine: their values at three points give the map.
    let places = corners.map(|corner| refined.vertices[corner].at);
    let [origin, x, y] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|at| weights_at(places, at));
    let map = |i: usize| [x[i] - origin[i], y[i] - origin[i], origin[i]];
    let ([u0, u1, u2], [v0, v1, v2]) = (map(0), map(1));
    Triangle {
        nodes: corners.map(|corner| corner as u16),
        neighbors: refined.neighbors(index).map(|n| n.map_or(NO_NEIGHBOR, |n| n as u16)),
        weights: [u0, u1, u2, v0, v1, v2].map(|w| w as f32),
        ln_gain: refined.ln_gains(index).map(|g| g as f32),
    }
}
