//! Height map of a texture: surface heights over both coordinates, felt by a tip that follows them in any direction.
//!
//! A tip with speed v in the direction u, pressed with the force F, has the acceleration
//!
//! `a = v² (v/v₀)^(p−2) min(F/F₀, 4)^⅓ (u_x² h_xx + 2 u_x u_y h_xy + u_y² h_yy)`
//!
//! where v₀ is 0.1 m/s, F₀ the reference force and p the speed exponent. The factor with p describes how far the tip
//! follows: with p = 2 it follows the heights, a lower p attenuates fast strokes. The stiffness of a Hertz contact grows
//! with `F^⅓`. The heights h are filtered by the contact patch ([`crate::dsp::contact_patch`]), whose radius grows with
//! `F^⅓` too, between a quarter and four times the reference force.
//!
//! x points to the right and y up, as in the picture of a texture: the first row of heights is the lowest row of the
//! picture. The tile repeats in both directions.

mod common_tile;
mod error;
mod levels;
mod oracle;
mod quarter_turn;
#[cfg(test)]
mod tests;

use std::ops::RangeInclusive;

use crate::texture::height_map::levels::KeptLevels;
use crate::texture::limits::FORCES_N;
use crate::texture::relief::MAX_MPS2;
use crate::units::Newtons;

pub use crate::texture::height_map::common_tile::{CommonTile, TilePart};
pub use crate::texture::height_map::error::HeightMapError;
pub use crate::texture::height_map::levels::HeightMapLevels;

/// Valid numbers of heights along a side; they are powers of two.
pub const N_RANGE: RangeInclusive<usize> = 16..=512;
/// Valid sides of a tile, in m.
pub const SIDES_M: RangeInclusive<f64> = 1e-3..=1.0;
/// Largest magnitude of a height, in m.
pub const MAX_HEIGHT_M: f64 = 0.01;
/// Valid powers of speed that the acceleration follows.
pub const SPEED_EXPONENTS: RangeInclusive<f64> = 0.0..=2.0;
/// Valid radii of the contact patch, in m.
pub const PATCH_RADII_M: RangeInclusive<f64> = 0.0..=5e-3;
/// Speed v₀ in m/s at which the acceleration does not depend on the speed exponent.
const REFERENCE_MPS: f64 = 0.1;
/// Share of the largest heights and accelerations to which changed maps are limited, so that rounding in a file does not
/// exceed them.
const WITHIN_LIMITS: f64 = 0.999;

/// Periodic height map: one square tile of heights in m.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    /// Row by row from y = 0 on, x runs along a row.
    heights_m: Vec<f64>,
    n: usize,
    side_m: f64,
    options: HeightMapOptions,
    levels: KeptLevels,
}

/// How a tip follows a height map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightMapOptions {
    /// Reference force F₀, at which the contact patch has its stated radius.
    pub force: Newtons,
    /// Power of speed that the acceleration follows, 0 to 2; 2 for a tip that follows the heights.
    pub speed_exponent: f64,
    /// Radius of the contact patch at the reference force, 0 to 5 mm.
    pub patch_radius_m: f64,
}

impl HeightMapOptions {
    /// A pen with a ball tip of 1.5 mm radius that follows a hard plastic: the Hertz patch `(¾ F R / E*)^⅓` at 1 N and
    /// 1 GPa has a radius of 0.1 mm. Used where only heights are known.
    pub const HARD_PLASTIC: Self = Self { force: Newtons(1.0), speed_exponent: 2.0, patch_radius_m: 1e-4 };

    fn check(&self) -> Result<(), HeightMapError> {
        if !FORCES_N.contains(&self.force.0) {
            return Err(HeightMapError::Force { force_n: self.force.0 });
        }
        if !SPEED_EXPONENTS.contains(&self.speed_exponent) {
            return Err(HeightMapError::SpeedExponent { speed_exponent: self.speed_exponent });
        }
        if !PATCH_RADII_M.contains(&self.patch_radius_m) {
            return Err(HeightMapError::PatchRadius { patch_radius_m: self.patch_radius_m });
        }
        Ok(())
    }
}

impl HeightMap {
    /// A tile of `n` × `n` heights in m, row by row from y = 0 on with x along a row, and a side in m. The height at
    /// column i of row j is that at `x = i side / n` and `y = j side / n`.
    ///
    /// # Errors
    /// See [`HeightMapError`]: `n` must be a power of two in [`N_RANGE`], the side in [`SIDES_M`], heights at most
    /// [`MAX_HEIGHT_M`] in magnitude and so smooth that a stroke at 0.1 m/s stays below [`MAX_MPS2`], and the options in
    /// their ranges.
    pub fn new(heights_m: Vec<f64>, side_m: f64, options: HeightMapOptions) -> Result<Self, HeightMapError> {
        let n = heights_m.len().isqrt();
        if n * n != heights_m.len() || !N_RANGE.contains(&n) || !n.is_power_of_two() {
            return Err(HeightMapError::Shape { n_heights: heights_m.len() });
        }
        if !SIDES_M.contains(&side_m) {
            return Err(HeightMapError::Side { side_m });
        }
        options.check()?;
        // A number that is not finite is not within the limit.
        let is_within = |height_m: &f64| height_m.abs() <= MAX_HEIGHT_M;
        if let Some(index) = heights_m.iter().position(|height_m| !is_within(height_m)) {
            return Err(HeightMapError::Height {
                row: index / n,
                column: index % n,
                height_m: heights_m[index],
            });
        }
        let map = Self { heights_m, n, side_m, options, levels: KeptLevels::default() };
        let (index, mps2) = map.strongest_mps2();
        if mps2 > MAX_MPS2 {
            return Err(HeightMapError::Steep { row: index / n, column: index % n, mps2 });
        }
        Ok(map)
    }

    /// Heights in m, row by row from y = 0 on; x runs along a row.
    pub fn heights_m(&self) -> &[f64] {
        &self.heights_m
    }

    /// Number of heights along a side.
    pub fn n(&self) -> usize {
        self.n
    }

    /// Side of the tile, in m.
    pub fn side_m(&self) -> f64 {
        self.side_m
    }

    /// How a tip follows the heights.
    pub fn options(&self) -> HeightMapOptions {
        self.options
    }

    /// The same map with heights times `factor`. A factor that would exceed the limits of [`HeightMap::new`] is limited
    /// to them; one that is not finite is read as 1. If this map is prepared, the result is too.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let factor = if factor.is_finite() { factor } else { 1.0 };
        let highest_m = self.heights_m.iter().fold(0.0_f64, |most, height_m| most.max(height_m.abs()));
        // A flat map has no limit.
        let most = (MAX_HEIGHT_M / highest_m).min(MAX_MPS2 / self.strongest_mps2().1);
        let within = if factor.abs() > most { most * WITHIN_LIMITS * factor.signum() } else { factor };
        let heights_m = self.heights_m.iter().map(|height_m| within * height_m).collect();
        Self { heights_m, levels: self.levels.scaled(within), ..*self }
    }

    /// The same heights on a tile with the side times `factor`, which is limited to [`SIDES_M`]; a factor that is not
    /// finite and positive is read as 1. A smaller tile is steeper: heights that would exceed the limits of
    /// [`HeightMap::new`] are reduced.
    #[must_use]
    pub fn stretched(&self, factor: f64) -> Self {
        let side_m = self.stretched_side_m(factor);
        // On another side, the contact patch averages other waves.
        let levels = if side_m == self.side_m { self.levels.clone() } else { KeptLevels::default() };
        Self { side_m, levels, ..self.clone() }.scaled(1.0)
    }

    /// Side in m of the tile of [`HeightMap::stretched`] with this factor.
    pub fn stretched_side_m(&self, factor: f64) -> f64 {
        let factor = if factor.is_finite() && factor > 0.0 { factor } else { 1.0 };
        (factor * self.side_m).clamp(*SIDES_M.start(), *SIDES_M.end())
    }

    /// Distance between two heights, in m.
    fn step_m(&self) -> f64 {
        self.side_m / self.n as f64
    }

    /// Index of a height and an upper bound of the acceleration there at 0.1 m/s in any direction, in m/s²; of all
    /// heights the one with the largest bound. Second derivatives are central differences.
    fn strongest_mps2(&self) -> (usize, f64) {
        let n = self.n;
        let per_square = (REFERENCE_MPS / self.step_m()).powi(2);
        // A division would take most of the time; n is a power of two.
        let at = |column: usize, row: usize| self.heights_m[(row & (n - 1)) * n + (column & (n - 1))];
        let bound = |index: usize| {
            // One step back on a periodic tile is n - 1 steps ahead.
            let (i, j) = (index % n, index / n);
            let (left, right, below, above) = (i + n - 1, i + 1, j + n - 1, j + 1);
            let here = 2.0 * at(i, j);
            let xx = at(left, j) - here + at(right, j);
            let yy = at(i, below) - here + at(i, above);
            let xy = 0.25 * (at(right, above) + at(left, below) - at(left, above) - at(right, below));
            // The largest curvature is at most the largest row sum of the matrix of second derivatives.
            per_square * (xx.abs().max(yy.abs()) + xy.abs())
        };
        let stronger = |most: (usize, f64), index: usize| {
            let mps2 = bound(index);
            if mps2 > most.1 { (index, mps2) } else { most }
        };
        (0..n * n).fold((0, 0.0), stronger)
    }
}
