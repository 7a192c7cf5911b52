//! A texture as the renderer takes it: in `f32`, with triangles small enough for the level.

use shagreen_synth::texture::{MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, Triangle};

use crate::plane::Plane;
use crate::plane::refined::{Refined, Vertex};
use crate::triangulation::weights_at;

/// A texture as the renderer takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    rate_hz: f32,
    order: usize,
    speed_max_mps: f32,
    force_max_n: f32,
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

impl Plane {
    /// What the renderer needs: nodes and triangles in `f32`, with the gain of the predictor at corners and at the
    /// middles of edges, and more triangles than the plane has where a quadratic through these would miss the level.
    pub fn prepare(&self) -> Prepared {
        let vertex = |(at, (lsf, level)): (&[f64; 2], &(Vec<f64>, f64))| Vertex {
            at: *at,
            lsf: lsf.clone(),
            level_mps2: *level,
        };
        let vertices = self.triangulation.points().iter().zip(&self.vertices).map(vertex).collect();
        let refined = Refined::new(vertices, &self.triangulation);
        Prepared {
            rate_hz: self.rate.0 as f32,
            order: self.vertices[0].0.len(),
            speed_max_mps: self.speed_max_mps as f32,
            force_max_n: self.force_max_n as f32,
            nodes: refined.vertices.iter().map(node).collect(),
            triangles: (0..refined.triangles.len()).map(|index| triangle(&refined, index)).collect(),
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
        let Self { rate_hz, order, speed_max_mps, force_max_n, ref nodes, ref triangles } = *self;
        Parts { rate_hz, order, speed_max_mps, force_max_n, nodes, triangles }
    }

    /// The texture lent to a renderer.
    pub fn view(&self) -> Texture<'_> {
        // A model that was accepted makes slices that are accepted; a property test holds it.
        Texture::checked_before(self.parts())
    }
}

fn node(vertex: &Vertex) -> Node {
    let mut lsf = [0.0; MAX_ORDER];
    for (narrow, wide) in lsf.iter_mut().zip(&vertex.lsf) {
        *narrow = *wide as f32;
    }
    Node { level_mps2: vertex.level_mps2 as f32, lsf }
}

fn triangle(refined: &Refined, index: usize) -> Triangle {
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
