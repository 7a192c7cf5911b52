//! Weighted sums of height maps.

use rustfft::num_complex::Complex;

use crate::dsp::square_transform::{coefficients, index_of, series, wave_number};
use crate::texture::height_map::levels::KeptLevels;
use crate::texture::height_map::{
    HeightMap, HeightMapOptions, N_RANGE, PATCH_RADII_M, SIDES_M, SPEED_EXPONENTS,
};
use crate::texture::limits::FORCES_N;
use crate::units::Newtons;

/// Maps whose weight has a smaller magnitude do not contribute.
const LEAST_WEIGHT: f64 = 1e-3;
/// Largest change of scale of a map that is fitted into the tile of another one.
const MOST_STRETCH: f64 = 0.125;

impl HeightMap {
    /// Weighted sum of height maps. Parts without a map reduce the heights by their weight. `None` if no map contributes.
    ///
    /// The tile of the sum is 1, 2 or 4 copies along a side of the map with the largest weight, whose scale stays. The
    /// others are repeated a whole number of times on it, so that the sum has no seam; their scale changes by at most an
    /// eighth. A map that does not fit in this way is left out, as if it had no heights. Of the possible tiles, the
    /// smallest one into which the largest total weight fits is used. It has as many heights as the finest map needs, up
    /// to the limit of [`HeightMap::new`].
    ///
    /// Maps are added at the same force. The options are the means by the magnitude of weight, and heights that exceed the
    /// limits of a map are reduced.
    ///
    /// Cost: a sum for each map of the same side and resolution as the result, a Fourier transform for each other one. The
    /// result must be prepared anew, unless a single map contributes: see [`HeightMap::scaled`].
    pub fn blended(parts: &[(Option<&Self>, f64)]) -> Option<Self> {
        let is_heard = |weight: f64| weight.is_finite() && weight.abs() > LEAST_WEIGHT;
        let known = parts.iter().filter(|(_, weight)| is_heard(*weight));
        let known: Vec<(&Self, f64)> = known.filter_map(|(map, weight)| Some(((*map)?, *weight))).collect();
        if let [(only, weight)] = known.as_slice() {
            let is_whole = (weight - 1.0).abs() < LEAST_WEIGHT;
            return Some(if is_whole { (*only).clone() } else { only.scaled(*weight) });
        }
        let (mut frame, mut heaviest) = *known.first()?;
        for (map, weight) in &known {
            if weight.abs() > heaviest.abs() {
                (frame, heaviest) = (*map, *weight);
            }
        }
        let side_m = common_side_m(frame, &known);
        let fitted: Vec<Fitted<'_>> = known.iter().filter_map(|part| Fitted::new(*part, side_m)).collect();
        // Three copies of 64 heights, for instance, need the next power of two.
        let n = fitted.iter().map(|part| (part.copies * part.map.n).next_power_of_two()).max()?;
        let n = n.clamp(*N_RANGE.start(), *N_RANGE.end());
        // A map that does not fit the tile adds nothing, and must not change the options either.
        let used: Vec<(&Self, f64)> = fitted.iter().map(|part| (part.map, part.weight)).collect();
        let options = mean_options(&used);
        let mut heights_m = vec![0.0; n * n];
        let mut waves = vec![Complex::new(0.0, 0.0); n * n];
        for part in &fitted {
            let factor = part.weight * (options.force.0 / part.map.options.force.0).cbrt();
            if part.copies == 1 && part.map.n == n {
                for (sum, height_m) in heights_m.iter_mut().zip(&part.map.heights_m) {
                    *sum += factor * height_m;
                }
            } else {
                part.add_waves(factor, n, &mut waves);
            }
        }
        if waves.iter().any(|wave| wave.norm_sqr() > 0.0) {
            series(&mut waves);
            for (sum, wave) in heights_m.iter_mut().zip(&waves) {
                *sum += wave.re;
            }
        }
        Some(Self { heights_m, n, side_m, options, levels: KeptLevels::default() }.scaled(1.0))
    }
}

/// A map that is repeated along the sides of a tile.
struct Fitted<'a> {
    map: &'a HeightMap,
    weight: f64,
    copies: usize,
}

impl<'a> Fitted<'a> {
    /// `None` if the scale of the map would change too much.
    fn new((map, weight): (&'a HeightMap, f64), side_m: f64) -> Option<Self> {
        let copies = (side_m / map.side_m).round().max(1.0);
        let stretch = side_m / (copies * map.side_m);
        // The tolerance covers rounding.
        let fits = (stretch - 1.0).abs() < MOST_STRETCH + 1e-9;
        fits.then_some(Self { map, weight, copies: copies as usize })
    }

    /// Adds the Fourier coefficients of the repeated map, on `n` × `n` heights. A wave that repeats with its tile has
    /// `copies` times as many periods.
    fn add_waves(&self, factor: f64, n: usize, waves: &mut [Complex<f64>]) {
        let own_n = self.map.n;
        for (index, amplitude) in coefficients(&self.map.heights_m).into_iter().enumerate() {
            let own = [index % own_n, index / own_n].map(|index| wave_number(index, own_n));
            let periods = own.map(|periods| periods * self.copies.cast_signed());
            let below = |periods: &[isize; 2], n: usize| periods.iter().all(|p| 2 * p.unsigned_abs() < n);
            if below(&own, own_n) && below(&periods, n) {
                let [column, row] = periods.map(|periods| index_of(periods, n));
                waves[row * n + column] += factor * amplitude;
            }
        }
    }
}

/// Side of the tile of a sum: copies of the frame into which the largest weight fits.
fn common_side_m(frame: &HeightMap, known: &[(&HeightMap, f64)]) -> f64 {
    let fitting = |side_m: f64| -> f64 {
        known.iter().filter_map(|part| Fitted::new(*part, side_m)).map(|part| part.weight.abs()).sum()
    };
    let mut best = (frame.side_m, fitting(frame.side_m));
    for copies in [2, 4] {
        let side_m = copies as f64 * frame.side_m;
        let is_possible = copies * frame.n <= *N_RANGE.end() && side_m <= *SIDES_M.end();
        let weight = fitting(side_m);
        if is_possible && weight > best.1 + LEAST_WEIGHT {
            best = (side_m, weight);
        }
    }
    best.0
}

/// Means of the options by the magnitude of weight: weights of a field can be negative, forces cannot.
fn mean_options(used: &[(&HeightMap, f64)]) -> HeightMapOptions {
    let total: f64 = used.iter().map(|(_, weight)| weight.abs()).sum();
    let mean = |value: fn(&HeightMapOptions) -> f64| {
        used.iter().map(|(map, weight)| weight.abs() / total * value(&map.options)).sum::<f64>()
    };
    // A mean can leave the valid range by a rounding error.
    HeightMapOptions {
        force: Newtons(mean(|options| options.force.0).clamp(*FORCES_N.start(), *FORCES_N.end())),
        speed_exponent: mean(|options| options.speed_exponent).min(*SPEED_EXPONENTS.end()),
        patch_radius_m: mean(|options| options.patch_radius_m).min(*PATCH_RADII_M.end()),
    }
}
