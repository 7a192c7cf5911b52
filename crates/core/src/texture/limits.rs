//! Valid ranges of the quantities in a texture model, set by the renderer and the file formats.

use std::ops::RangeInclusive;

/// Highest predictor order that the renderer supports.
pub const MAX_ORDER: usize = shagreen_synth::texture::MAX_ORDER;

/// Highest order of the moving average of a published texture that the renderer supports.
pub const MAX_MA_ORDER: usize = shagreen_synth::texture::MAX_MA_ORDER;

/// Maximum number of nodes of a texture. With the boundary it has twice as many triangles, whose indices still fit 16
/// bits in the renderer.
pub const MAX_NODES: usize = 20_000;

/// Maximum number of nodes for radial basis interpolation, whose cost is cubic in the number of nodes.
pub const MAX_RADIAL_NODES: usize = 500;

/// Valid model rates, in Hz.
pub const RATES_HZ: RangeInclusive<f64> = 200.0..=4000.0;

/// Valid node speeds, in m/s, which the renderer's `f32` represents with full relative precision.
pub const SPEEDS_MPS: RangeInclusive<f64> = 1e-6..=100.0;

/// Valid node forces, in N.
pub const FORCES_N: RangeInclusive<f64> = 1e-6..=1e4;

/// Valid node levels (root mean square acceleration), in m/s².
pub const LEVELS_MPS2: RangeInclusive<f64> = 0.0..=1e6;

/// Valid excitation variances of a published node, in (m/s²)².
pub const VARIANCES: RangeInclusive<f64> = 0.0..=1e12;

/// Valid gains of a published node, dimensionless.
pub const GAINS: RangeInclusive<f64> = 0.0..=1e6;

/// Minimum distance in radians between neighboring line spectral frequencies, and from 0 and π. It is 40 times the
/// spacing of `f32` near π, so that the frequencies remain distinct in the renderer.
pub const MIN_LSF_GAP: f64 = 1e-5;

/// Minimum distance in radians between line spectral frequencies of a published texture: half a unit of the sixth
/// decimal, to which they are published. It is still twice the spacing of `f32` near π.
pub const MIN_PUBLISHED_LSF_GAP: f64 = 5e-7;

/// Minimum distance between nodes, and of a node from zero speed and force, relative to the highest speed and force.
/// Closer nodes would give triangles too flat for point location in `f32`.
pub const MIN_NODE_DISTANCE: f64 = 1e-4;
