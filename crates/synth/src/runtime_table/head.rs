//! The numbers of a texture that are no arrays, and the texture that they form with its arrays.

use crate::height_map::{self, HeightMap, PATCH_FORCES};
use crate::relief::{self, Relief};
use crate::stick_slip::Friction;
use crate::texture::{Along, Excitation, Node, Parts, Texture, Triangle};

/// Lengths of the arrays of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lengths {
    /// Nodes across and along the lay.
    pub n_nodes: usize,
    /// Triangles across and along the lay.
    pub n_triangles: usize,
    /// Excitations of a published model.
    pub n_excitations: usize,
    /// Samples of relief and height map.
    pub n_samples: usize,
}

impl Lengths {
    /// Memory of these arrays in bytes.
    pub fn bytes(&self) -> usize {
        self.n_nodes * size_of::<Node>()
            + self.n_triangles * size_of::<Triangle>()
            + self.n_excitations * size_of::<Excitation>()
            + self.n_samples * size_of::<f32>()
    }
}

/// Arrays of a texture.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arrays<'m> {
    /// Nodes across the lay, then those along it.
    pub nodes: &'m [Node],
    /// Triangles across the lay, then those along it.
    pub triangles: &'m [Triangle],
    /// Excitations of a published model.
    pub excitations: &'m [Excitation],
    /// Octaves of the relief, then those of the height map.
    pub samples: &'m [f32],
}

/// Numbers of a texture that are no arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Head {
    pub(super) rate_hz: f32,
    pub(super) speed_max_mps: f32,
    pub(super) force_max_n: f32,
    pub(super) turn_rad: f32,
    pub(super) order: usize,
    pub(super) ma_order: usize,
    /// Numbers of nodes and triangles across the lay.
    pub(super) across: [usize; 2],
    /// Numbers of nodes and triangles along the lay.
    pub(super) along: Option<[usize; 2]>,
    pub(super) n_excitations: usize,
    pub(super) relief: Option<ReliefHead>,
    pub(super) height_map: Option<HeightMapHead>,
    pub(super) friction: Option<Friction>,
}

/// Numbers of a relief.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ReliefHead {
    pub(super) step_m: f32,
    pub(super) force_n: f32,
    pub(super) n: usize,
    /// Samples of all octaves.
    pub(super) n_samples: usize,
}

/// Numbers of a height map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HeightMapHead {
    pub(super) side_m: f64,
    pub(super) force_n: f32,
    pub(super) speed_exponent: f32,
    pub(super) n: usize,
    /// Coefficients of all patches and octaves.
    pub(super) n_samples: usize,
}

impl ReliefHead {
    /// Whether the number of samples is that of all octaves.
    pub(super) fn fits(&self) -> bool {
        self.n <= relief::MOST_SAMPLES && self.n_samples == relief::length(self.n)
    }
}

impl HeightMapHead {
    /// Whether the number of samples is that of all octaves of all patches.
    pub(super) fn fits(&self) -> bool {
        self.n <= height_map::MOST_SIDE && self.n_samples == PATCH_FORCES.len() * height_map::length(self.n)
    }
}

impl Head {
    /// Lengths of the arrays that belong to these numbers.
    pub fn lengths(&self) -> Lengths {
        let [n_nodes, n_triangles] = self.across;
        let [n_nodes_along, n_triangles_along] = self.along.unwrap_or_default();
        Lengths {
            n_nodes: n_nodes + n_nodes_along,
            n_triangles: n_triangles + n_triangles_along,
            n_excitations: self.n_excitations,
            n_samples: self.relief.map_or(0, |relief| relief.n_samples)
                + self.height_map.map_or(0, |map| map.n_samples),
        }
    }

    /// The texture of these numbers and of the arrays that [`super::Table::load`] has filled. It costs nothing, for an owner
    /// who lends the texture at every block. Arrays of another texture give zero or non-finite output and never an
    /// out-of-bounds access.
    pub fn view<'m>(&self, arrays: Arrays<'m>) -> Texture<'m> {
        Texture::checked_before(self.parts(arrays))
    }

    /// Data of the texture, which are not checked.
    pub(super) fn parts<'m>(&self, arrays: Arrays<'m>) -> Parts<'m> {
        let (nodes, nodes_along) = parted(arrays.nodes, self.across[0]);
        let (triangles, triangles_along) = parted(arrays.triangles, self.across[1]);
        let n_relief = self.relief.map_or(0, |relief| relief.n_samples);
        let (of_relief, of_height_map) = parted(arrays.samples, n_relief);
        Parts {
            rate_hz: self.rate_hz,
            order: self.order,
            ma_order: self.ma_order,
            speed_max_mps: self.speed_max_mps,
            force_max_n: self.force_max_n,
            nodes,
            excitations: parted(arrays.excitations, self.n_excitations).0,
            triangles,
            along: self.along.map(|[n_nodes, n_triangles]| Along {
                nodes: parted(nodes_along, n_nodes).0,
                triangles: parted(triangles_along, n_triangles).0,
            }),
            turn_rad: self.turn_rad,
            relief: self
                .relief
                .map(|head| Relief::checked_before(head.step_m, head.force_n, head.n, of_relief)),
            height_map: self.height_map.map(|head| {
                let samples = parted(of_height_map, head.n_samples).0;
                HeightMap::checked_before(head.side_m, head.force_n, head.speed_exponent, head.n, samples)
            }),
            friction: self.friction,
        }
    }
}

/// The first `n` items and the others; all items and none if there are fewer.
fn parted<T>(items: &[T], n: usize) -> (&[T], &[T]) {
    items.split_at_checked(n).unwrap_or((items, &[]))
}
