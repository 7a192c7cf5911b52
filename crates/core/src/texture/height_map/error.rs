//! Errors of height maps.

use crate::texture::height_map::{MAX_HEIGHT_M, N_RANGE, PATCH_RADII_M, SIDES_M, SPEED_EXPONENTS};
use crate::texture::limits::FORCES_N;
use crate::texture::relief::MAX_MPS2;

/// Error of creating a height map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HeightMapError {
    /// The heights are no square with a valid side.
    #[error(
        "a height map has n x n heights, and n is a power of two from {} to {}; got {n_heights} heights",
        N_RANGE.start(), N_RANGE.end()
    )]
    Shape {
        /// Number of heights.
        n_heights: usize,
    },
    /// The side is out of range.
    #[error(
        "the side of a height map must be from {} to {} mm, got {} mm",
        1e3 * SIDES_M.start(), 1e3 * SIDES_M.end(), 1e3 * .side_m
    )]
    Side {
        /// Side in m.
        side_m: f64,
    },
    /// A height is too large, or not finite.
    #[error(
        "the height in row {row}, column {column} is {} mm; its magnitude may be at most {} mm",
        1e3 * .height_m, 1e3 * MAX_HEIGHT_M
    )]
    Height {
        /// Row from zero, at y = 0.
        row: usize,
        /// Column from zero, at x = 0.
        column: usize,
        /// Height in m.
        height_m: f64,
    },
    /// Neighboring heights differ so much that a tip would accelerate by more than [`MAX_MPS2`].
    #[error(
        "around row {row}, column {column} the heights accelerate a tip at 100 mm/s by {mps2:.3e} m/s²; at most {MAX_MPS2:e} m/s² are allowed, so lower the heights or use a larger side"
    )]
    Steep {
        /// Row from zero, at y = 0.
        row: usize,
        /// Column from zero, at x = 0.
        column: usize,
        /// Upper bound of the acceleration in m/s².
        mps2: f64,
    },
    /// The reference force is out of range.
    #[error("the force of a height map must be from {} to {} N, got {force_n}", FORCES_N.start(), FORCES_N.end())]
    Force {
        /// Force in N.
        force_n: f64,
    },
    /// The speed exponent is out of range.
    #[error(
        "the speed exponent of a height map must be from {} to {}, got {speed_exponent}",
        SPEED_EXPONENTS.start(), SPEED_EXPONENTS.end()
    )]
    SpeedExponent {
        /// Power of speed.
        speed_exponent: f64,
    },
    /// The radius of the contact patch is out of range.
    #[error(
        "the contact patch of a height map must have a radius from {} to {} mm, got {} mm",
        1e3 * PATCH_RADII_M.start(), 1e3 * PATCH_RADII_M.end(), 1e3 * .patch_radius_m
    )]
    PatchRadius {
        /// Radius in m.
        patch_radius_m: f64,
    },
}
