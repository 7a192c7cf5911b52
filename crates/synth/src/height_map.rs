//! Height map: surface heights over both coordinates, which accelerate a tip that follows them in any direction.
//!
//! On a surface h, a tip with speed v in the direction u has the acceleration
//! `v² (u_x² h_xx + 2 u_x u_y h_xy + u_y² h_yy)`. The heights are stored as the coefficients of a spline, so that the
//! three derivatives come from one map and are exact in every direction.

mod spline;
mod voice;

use crate::height_map::spline::taps;
use crate::octave::{lower_and_share, octave_for};

pub use crate::height_map::voice::HeightMapVoice;

/// Fewest samples along a side of an octave: one wave of four samples.
pub const LEAST_SIDE: usize = 4;
/// Most samples along a side of an octave.
pub const MOST_SIDE: usize = 1024;
/// Normal forces of the stored contact patches, relative to the reference force. Beyond them, the patch keeps its size.
pub const PATCH_FORCES: [f32; 3] = [0.25, 1.0, 4.0];
/// Squared radii of these patches relative to that at the reference force: `(F/F₀)^(2/3)`, after Hertz.
const PATCH_SQUARES: [f32; 3] = [0.396_850_26, 1.0, 2.519_842_1];
/// Tip speed in m/s at which the acceleration is `v² h_uu` for every speed exponent.
pub const REFERENCE_SPEED_MPS: f32 = 0.1;

/// Reasons why data do not form a valid height map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HeightMapError {
    /// The side or the reference force is not a positive finite number, or the speed exponent is not 0 to 2.
    Range,
    /// The number of samples along a side is not a power of two in range, or the slice does not have the length of all
    /// octaves of all patches.
    Length,
    /// A sample is not finite.
    Number,
}

/// A square periodic height map, filtered by contact patches of three sizes and stored as octaves (a multiresolution
/// pyramid) of spline coefficients. Octave 0 has `n` × `n` samples. Each further octave has half as many samples along
/// a side and half the bandwidth. Every octave contains only waves of at least four samples per period, in any direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightMap<'a> {
    side_m: f64,
    force_n: f32,
    speed_exponent: f32,
    n: usize,
    octaves: &'a [f32],
}

/// Number of samples of all octaves of one patch, from `n` × `n` samples (`n` is a power of two of at most
/// [`MOST_SIDE`]) down to [`LEAST_SIDE`] × [`LEAST_SIDE`].
pub const fn length(n: usize) -> usize {
    (4 * n * n).saturating_sub(LEAST_SIDE * LEAST_SIDE) / 3
}

impl<'a> HeightMap<'a> {
    /// A height map of one tile with this side in m, and `n` × `n` samples in octave 0. `octaves` has the coefficients in
    /// m of the three patches in sequence, of each patch all octaves, of each octave row by row from y = 0 and x = 0 on.
    ///
    /// `force_n` is the reference force of the patches in N, and `speed_exponent` the power of speed that the acceleration
    /// follows, 0 to 2.
    ///
    /// Memory: at most 16.8 MB, for 1024 × 1024 samples in octave 0.
    ///
    /// # Errors
    /// See [`HeightMapError`].
    pub fn new(
        side_m: f64,
        force_n: f32,
        speed_exponent: f32,
        n: usize,
        octaves: &'a [f32],
    ) -> Result<Self, HeightMapError> {
        let is_positive = side_m.is_finite() && side_m > 0.0 && force_n.is_finite() && force_n > 0.0;
        if !(is_positive && (0.0..=2.0).contains(&speed_exponent)) {
            return Err(HeightMapError::Range);
        }
        let fits = (LEAST_SIDE..=MOST_SIDE).contains(&n) && n.is_power_of_two();
        if !fits || octaves.len() != PATCH_FORCES.len() * length(n) {
            return Err(HeightMapError::Length);
        }
        if !octaves.iter().all(|x| x.is_finite()) {
            return Err(HeightMapError::Number);
        }
        Ok(Self { side_m, force_n, speed_exponent, n, octaves })
    }

    /// A height map over data that [`HeightMap::new`] has accepted before. Invalid data give zero or non-finite output and
    /// never an out-of-bounds access.
    pub fn checked_before(
        side_m: f64,
        force_n: f32,
        speed_exponent: f32,
        n: usize,
        octaves: &'a [f32],
    ) -> Self {
        let n = n.clamp(LEAST_SIDE, MOST_SIDE).next_power_of_two();
        Self { side_m, force_n, speed_exponent, n, octaves }
    }

    /// Side of the tile in m.
    pub fn side_m(&self) -> f64 {
        self.side_m
    }

    /// Reference force of the contact patches, in N.
    pub fn force_n(&self) -> f32 {
        self.force_n
    }

    /// Power of speed that the acceleration follows, 0 to 2.
    pub fn speed_exponent(&self) -> f32 {
        self.speed_exponent
    }

    /// Number of samples along a side of octave 0.
    pub fn n(&self) -> usize {
        self.n
    }

    /// Coefficients of all patches and octaves in sequence, in m.
    pub fn octaves(&self) -> &'a [f32] {
        self.octaves
    }

    /// Acceleration in m/s² of a tip that passes a position in m at [`REFERENCE_SPEED_MPS`] and the reference force: the
    /// mean over all directions, `v² (h_xx + h_yy) / 2`. Waves shorter than twice the displacement `way_m` are left out.
    pub fn mean_acceleration_mps2(&self, place_m: [f64; 2], way_m: f64) -> f32 {
        self.acceleration_mps2(place_m, octave_for(way_m, self.step_m()), 1.0, [0.5, 0.0, 0.5])
    }

    /// Distance between two samples of octave 0, in m.
    fn step_m(&self) -> f32 {
        (self.side_m / self.n as f64) as f32
    }

    /// Acceleration in m/s² of a tip that passes a position in m at [`REFERENCE_SPEED_MPS`], with a patch of this squared
    /// radius relative to that at the reference force. The direction is `u_x²`, `2 u_x u_y` and `u_y²`. A fractional octave
    /// interpolates linearly between two octaves.
    fn acceleration_mps2(&self, place_m: [f64; 2], octave: f32, patch: f32, direction: [f32; 3]) -> f32 {
        // After the last octave only the mean remains, which has no second derivative.
        let (lower, share) = lower_and_share(octave, (self.n / LEAST_SIDE).ilog2() + 1);
        let patches = patches_around(patch);
        let direction = direction.map(f64::from);
        let mut curvature = self.in_octave_per_m(place_m, lower, patches, direction);
        if share > 0.0 {
            let upper = self.in_octave_per_m(place_m, lower + 1, patches, direction);
            curvature += f64::from(share) * (upper - curvature);
        }
        REFERENCE_SPEED_MPS * REFERENCE_SPEED_MPS * curvature as f32
    }

    /// Second derivative in 1/m of one octave in a direction, interpolated linearly between two neighboring patches.
    fn in_octave_per_m(
        &self,
        place_m: [f64; 2],
        octave: u32,
        (patch, share): (usize, f32),
        [xx, xy, yy]: [f64; 3],
    ) -> f64 {
        let n = self.n >> octave;
        if n < LEAST_SIDE {
            return 0.0;
        }
        let samples = |patch: usize| {
            let begin = patch * length(self.n) + length(self.n) - length(n);
            self.octaves.get(begin..begin + n * n).unwrap_or(&[])
        };
        let (smaller, larger) = (samples(patch), samples(patch + 1));
        let per_m = n as f64 / self.side_m;
        let [columns, rows] = place_m.map(|place_m| taps(place_m * per_m, n));
        let mut sum = 0.0;
        for row in rows {
            let (mut value, mut slope, mut curve) = (0.0, 0.0, 0.0);
            for column in columns {
                let at = row.index * n + column.index;
                let [a, b] = [smaller, larger].map(|samples| samples.get(at).copied().unwrap_or(0.0));
                let sample = f64::from(a) + f64::from(share) * (f64::from(b) - f64::from(a));
                value += column.value * sample;
                slope += column.slope * sample;
                curve += column.curve * sample;
            }
            sum += xx * row.value * curve + xy * row.slope * slope + yy * row.curve * value;
        }
        per_m * per_m * sum
    }
}

/// Index of the smaller one of the two stored patches around a squared radius, and the share of the larger one. For waves
/// that are long against the patch, its gain is linear in the squared radius, so that interpolation is exact there.
fn patches_around(square: f32) -> (usize, f32) {
    let [small, middle, large] = PATCH_SQUARES;
    let (patch, share) = if square < middle {
        (0, (square - small) / (middle - small))
    } else {
        (1, (square - middle) / (large - middle))
    };
    (patch, share.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests;
