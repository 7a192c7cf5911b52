//! Texture in the form that the renderer uses: `f32`, with triangles small enough for an accurate level.

use std::sync::Arc;

use shagreen_synth::stick_slip::Friction;
use shagreen_synth::texture::{Along, Excitation, NO_NEIGHBOR, Node, Parts, Texture, Triangle};

use crate::maths::triangulation::weights_at;
use crate::texture::height_map::HeightMapLevels;
use crate::texture::plane::Plane;
use crate::texture::plane::refined::{Refined, Vertex};
use crate::texture::plane::values::Strength;
use crate::texture::relief::ReliefOctaves;

/// Texture in the form that the renderer uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    rate_hz: f32,
    order: usize,
    ma_order: usize,
    speed_max_mps: f32,
    force_max_n: f32,
    nodes: Vec<Node>,
    /// One excitation for each node, or none at all.
    excitations: Vec<Excitation>,
    triangles: Vec<Triangle>,
    /// Nodes and triangles of the grain along the lay.
    along: Option<(Vec<Node>, Vec<Triangle>)>,
    turn_rad: f32,
    relief: Option<ReliefOctaves>,
    height_map: Option<Arc<HeightMapLevels>>,
    friction: Option<Friction>,
}

impl Plane {
    /// Converts the plane for the renderer: nodes and triangles in `f32`, with the filter's power gain at corners and
    /// at edge midpoints.
    ///
    /// Triangles are subdivided where a quadratic through these gains would miss the level, or where they do not
    /// approximate the radial basis closely enough.
    pub fn prepare(&self) -> Prepared {
        let refined = self.refined();
        let along = self.along().map(Self::refined);
        Prepared {
            rate_hz: self.rate.0 as f32,
            order: self.vertices[0].lsf.len(),
            ma_order: self.vertices[0].ma_lsf.len(),
            speed_max_mps: self.speed_max_mps as f32,
            force_max_n: self.force_max_n as f32,
            nodes: nodes(&refined),
            excitations: refined.vertices.iter().filter_map(excitation).collect(),
            triangles: triangles(&refined),
            along: along.map(|along| (nodes(&along), triangles(&along))),
            turn_rad: self.surface.turn_rad as f32,
            relief: self.surface.relief.as_ref().map(|relief| relief.octaves()),
            height_map: self.surface.height_map.as_ref().map(|height_map| height_map.prepare()),
            friction: self.surface.friction,
        }
    }

    /// Triangles over the nodes, without those along the lay.
    fn refined(&self) -> Refined<'_> {
        let points = self.triangulation.points().iter().zip(&self.vertices);
        let vertices = points.map(|(at, values)| Vertex { at: *at, values: values.clone() }).collect();
        Refined::new(vertices, &self.triangulation, self.radial.as_ref())
    }
}

impl Prepared {
    /// Model rate in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.rate_hz
    }

    /// Components of the texture.
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
            along: self.along.as_ref().map(|(nodes, triangles)| Along { nodes, triangles }),
            turn_rad: self.turn_rad,
            relief: self.relief.as_ref().map(ReliefOctaves::view),
            height_map: self.height_map.as_deref().map(HeightMapLevels::view),
            friction: self.friction,
        }
    }

    /// Texture borrowed by a renderer.
    pub fn view(&self) -> Texture<'_> {
        // Every valid model gives parts that the renderer accepts; a property test checks this.
        Texture::checked_before(self.parts())
    }
}

fn nodes(refined: &Refined<'_>) -> Vec<Node> {
    refined.vertices.iter().map(node).collect()
}

fn triangles(refined: &Refined<'_>) -> Vec<Triangle> {
    (0..refined.triangles.len()).map(|index| triangle(refined, index)).collect()
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

fn narrow<const N: usize>(lsf: &[f64]) -> [f32; N] {
    let mut out = [0.0; N];
    for (narrow, wide) in out.iter_mut().zip(lsf) {
        *narrow = *wide as f32;
    }
    out
}

fn triangle(refined: &Refined<'_>, index: usize) -> Triangle {
    let corners = refined.triangles[index];
    // The weights are affine functions: their values at three points determine the map.
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
