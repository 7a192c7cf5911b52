//! Height maps on one common tile: their weighted sums are cheap, and continuous in the weights.
//!
//! The tile depends on the set of maps and not on the weights: it is as large as one of the maps, and every other one that it
//! holds is repeated on it the whole number of times that fits its side best. The repeated maps still differ in side, by at
//! most a factor of √2 from that of the tile. In a sum they share one side, the geometric mean of theirs by the magnitude of
//! weight. It changes smoothly with the weights, and is that of a map which contributes alone. A sum therefore has no seam,
//! and the scale of its heaviest map changes little.
//!
//! A tile has a limited number of samples. It would lose the waves of a map that is much smaller, and holds no larger one. Its
//! side is therefore that with which it holds the most maps. The others stay apart: they are in no sum, but a map that stays
//! apart and has most of the weight is felt instead of the sum, exactly where it contributes alone.
//!
//! Maps are prepared for the renderer once, each with its own contact patches. Preparation is linear in the heights, so that
//! the sum of prepared maps is the prepared sum.
//!
//! Maps can be rotated against the sum. A rotated tile does not repeat on an upright one, except after quarter turns. A map is
//! therefore rotated by the nearest quarter turn, and near the middle between two of them, it is a mixture of both
//! (`quarter_turn`).

use std::sync::{Arc, OnceLock};

use rustfft::num_complex::Complex;

use crate::dsp::square_transform::{coefficients, index_of, series, wave_number};
use crate::maths::sums::add_times;
use crate::texture::height_map::levels::{HeightMapLevels, KeptLevels};
use crate::texture::height_map::quarter_turn::{quarter_turned, quarter_turns};
use crate::texture::height_map::{
    HeightMap, HeightMapOptions, N_RANGE, PATCH_RADII_M, SIDES_M, SPEED_EXPONENTS,
};
use crate::texture::limits::FORCES_N;
use crate::units::Newtons;

/// Magnitude of weight up to which a map does not contribute. From there to twice as much, it fades in.
const LEAST_WEIGHT: f64 = 1e-3;
/// Share of all weight from which a map that stays apart is felt instead of the sum.
const APART_SHARE: f64 = 0.75;

/// Height maps on a common tile.
#[derive(Clone, Debug)]
pub struct CommonTile {
    /// Number of heights along a side of the tile.
    n: usize,
    maps: Vec<Option<Fitted>>,
}

/// A map of a [`CommonTile`] in a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TilePart {
    /// Index of the map.
    pub map: usize,
    /// Weight; weights of a field can be negative.
    pub weight: f64,
    /// Angle of the map's axes in the axes of the sum, counterclockwise, in rad.
    pub turn_rad: f64,
}

impl CommonTile {
    /// Common tile of these maps, by index; `None` if there are none. It has as many heights as the finest map that it holds
    /// needs, up to the limit of [`HeightMap::new`].
    pub fn new(maps: &[Option<Arc<HeightMap>>]) -> Option<Self> {
        let largest_m = maps.iter().flatten().map(|map| map.side_m).reduce(f64::max)?;
        let sizes: Vec<Option<Size>> =
            maps.iter().map(|map| Some(Size::of(map.as_ref()?, largest_m))).collect();
        let tile_m = side_for_most_m(&sizes)?;
        let fitted = maps.iter().zip(&sizes).map(|(map, size)| {
            let (map, size) = (map.as_ref()?, size.as_ref()?);
            Some(Fitted::new(Arc::clone(map), size.copies_on(tile_m)))
        });
        let maps: Vec<Option<Fitted>> = fitted.collect();
        let held = maps.iter().flatten().filter(|map| !map.is_apart);
        // Three copies of 64 heights, for instance, need the next power of two.
        let n = held.map(|map| (map.copies * map.map.n).next_power_of_two()).max()?;
        Some(Self { n: n.clamp(*N_RANGE.start(), *N_RANGE.end()), maps })
    }

    /// Prepares all maps, so that sums take little time from now on. Without this, the first sum with a map prepares it.
    pub fn prepare(&self) {
        for map in self.maps.iter().flatten() {
            map.heights_m(map.n_on(self.n));
            map.levels();
        }
    }

    /// Weighted sum of maps, which needs no preparation; `None` if no map contributes. An index without a map counts as a
    /// surface without heights.
    ///
    /// Maps are added at the same force. The options are the means by the magnitude of weight; they hold for the sum as a file
    /// keeps it, while the prepared maps keep their own patches. Heights that exceed the limits of a map are reduced.
    ///
    /// Cost: a multiplication and an addition for each prepared sample of each map that contributes.
    pub fn blended(&self, parts: &[TilePart]) -> Option<HeightMap> {
        let known = without_others(parts.iter().filter_map(|part| self.known(part)).collect());
        let first = known.first()?;
        if known.len() == 1 && first.is_upright() {
            return Some(first.fitted.map.scaled(first.weight));
        }
        let options = mean_options(&known);
        let side_m = mean_side_m(first, &known);
        let n = first.fitted.n_on(self.n);
        let turned = known.iter().flat_map(|part| {
            let factor = part.weight * (options.force.0 / part.fitted.map.options.force.0).cbrt();
            quarter_turns(part.turn_rad).map(|(quarter, gain)| (part.fitted, quarter, gain * factor))
        });
        let mut heights_m = vec![0.0; n * n];
        let mut levels = Vec::new();
        for (fitted, quarter, factor) in turned.filter(|(.., factor)| *factor != 0.0) {
            let (own_m, own_levels) = (fitted.heights_m(n), fitted.levels());
            if quarter == 0 {
                add_times(own_m, factor, &mut heights_m);
                levels.push((own_levels, factor as f32));
            } else {
                add_times(&quarter_turned(own_m, quarter), factor, &mut heights_m);
                levels.push((Arc::new(own_levels.turned(quarter)), factor as f32));
            }
        }
        let levels = KeptLevels::of(HeightMapLevels::sum(&levels, side_m, &options));
        Some(HeightMap { heights_m, n, side_m, options, levels }.scaled(1.0))
    }

    /// The map of a part, if it contributes.
    fn known(&self, part: &TilePart) -> Option<Part<'_>> {
        let fitted = self.maps.get(part.map)?.as_ref()?;
        let weight = faded(part.weight);
        (weight != 0.0).then_some(Part { fitted, weight, turn_rad: part.turn_rad })
    }
}

/// A map that contributes to a sum.
struct Part<'a> {
    fitted: &'a Fitted,
    weight: f64,
    turn_rad: f64,
}

impl Part<'_> {
    /// Whether the map has the axes of the sum.
    fn is_upright(&self) -> bool {
        let [(quarter, _), (_, other)] = quarter_turns(self.turn_rad);
        quarter == 0 && other == 0.0
    }
}

/// What a tile must know of a map to hold it.
struct Size {
    side_m: f64,
    most_copies: usize,
}

impl Size {
    /// Size of a map on tiles of at most this side.
    fn of(map: &HeightMap, largest_m: f64) -> Self {
        let copies = copies_on(largest_m, map.side_m);
        // Most maps have so few heights that no tile is too large, and their waves need not be computed.
        let most_copies = if copies * map.n <= *N_RANGE.end() { copies } else { map.most_copies() };
        Self { side_m: map.side_m, most_copies }
    }

    /// Number of copies on a tile, if it holds the map.
    fn copies_on(&self, tile_m: f64) -> Option<usize> {
        let copies = copies_on(tile_m, self.side_m);
        (self.side_m <= tile_m && copies <= self.most_copies).then_some(copies)
    }
}

/// Side in m of the tile that holds the most of these maps; the shortest one, if there are several.
fn side_for_most_m(sizes: &[Option<Size>]) -> Option<f64> {
    let known = || sizes.iter().flatten();
    let n_held = |tile_m: f64| known().filter(|size| size.copies_on(tile_m).is_some()).count();
    let tiles = known().map(|size| (n_held(size.side_m), size.side_m));
    let better = |a: (usize, f64), b: (usize, f64)| if (b.0, a.1) > (a.0, b.1) { b } else { a };
    tiles.reduce(better).map(|(_, side_m)| side_m)
}

/// A map that is repeated along the sides of a tile, or stays apart.
#[derive(Clone, Debug)]
struct Fitted {
    map: Arc<HeightMap>,
    copies: usize,
    is_apart: bool,
    /// Heights on the grid of the tile, if they differ from those of the map.
    heights_m: OnceLock<Vec<f64>>,
    /// Levels on the tile, if they differ from those of the map.
    levels: OnceLock<Arc<HeightMapLevels>>,
}

impl Fitted {
    /// A map with this number of copies; `None` for one that the tile does not hold.
    fn new(map: Arc<HeightMap>, copies: Option<usize>) -> Self {
        let (is_apart, copies) = (copies.is_none(), copies.unwrap_or(1));
        Self { map, copies, is_apart, heights_m: OnceLock::new(), levels: OnceLock::new() }
    }

    /// Number of heights along a side in a sum on a tile of `n`.
    fn n_on(&self, n: usize) -> usize {
        if self.is_apart { self.map.n } else { n }
    }

    /// Side of all copies, in m.
    fn side_m(&self) -> f64 {
        self.copies as f64 * self.map.side_m
    }

    /// Heights in m on `n` × `n` points of the tile.
    fn heights_m(&self, n: usize) -> &[f64] {
        if self.copies == 1 && self.map.n == n {
            return &self.map.heights_m;
        }
        self.heights_m.get_or_init(|| self.resampled_m(n))
    }

    /// Levels of all copies.
    fn levels(&self) -> Arc<HeightMapLevels> {
        if self.copies == 1 {
            return self.map.prepare();
        }
        Arc::clone(self.levels.get_or_init(|| Arc::new(self.map.prepared_on(self.copies))))
    }

    /// Heights of all copies on `n` × `n` points, by their Fourier series. A wave that repeats with its map has `copies` times
    /// as many periods on the tile.
    fn resampled_m(&self, n: usize) -> Vec<f64> {
        let own_n = self.map.n;
        let mut waves = vec![Complex::new(0.0, 0.0); n * n];
        for (index, amplitude) in coefficients(&self.map.heights_m).into_iter().enumerate() {
            let own = [index % own_n, index / own_n].map(|index| wave_number(index, own_n));
            let periods = own.map(|periods| periods * self.copies.cast_signed());
            let below = |periods: &[isize; 2], n: usize| periods.iter().all(|p| 2 * p.unsigned_abs() < n);
            if below(&own, own_n) && below(&periods, n) {
                let [column, row] = periods.map(|periods| index_of(periods, n));
                waves[row * n + column] = amplitude;
            }
        }
        series(&mut waves);
        waves.iter().map(|wave| wave.re).collect()
    }
}

/// Number of copies of a map whose side is nearest, as a ratio, to that of a tile, and valid.
fn copies_on(tile_m: f64, own_m: f64) -> usize {
    let fewer = (tile_m / own_m).floor().max(1.0);
    let more = fewer + 1.0;
    let is_nearer = fewer * more * own_m * own_m < tile_m * tile_m;
    let copies = if is_nearer && more * own_m <= *SIDES_M.end() { more } else { fewer };
    copies as usize
}

/// The parts that are felt together: those that the tile holds, or one that stays apart. The sum fades out while the share of
/// the latter grows from 1/2 to [`APART_SHARE`], and then the latter fades in, until it contributes alone.
fn without_others(mut parts: Vec<Part<'_>>) -> Vec<Part<'_>> {
    let total: f64 = parts.iter().map(|part| part.weight.abs()).sum();
    let share = |part: &Part<'_>| if part.fitted.is_apart { part.weight.abs() / total } else { 0.0 };
    let largest = parts.iter().map(share).fold(0.0, f64::max);
    for part in &mut parts {
        let beyond = if part.fitted.is_apart { share(part) - APART_SHARE } else { APART_SHARE - largest };
        part.weight *= (beyond / (1.0 - APART_SHARE)).clamp(0.0, 1.0);
    }
    parts.retain(|part| part.weight != 0.0);
    parts
}

/// The weight with which a map contributes; zero for one that is not finite.
fn faded(weight: f64) -> f64 {
    if !weight.is_finite() {
        return 0.0;
    }
    weight * (weight.abs() / LEAST_WEIGHT - 1.0).clamp(0.0, 1.0)
}

/// Geometric mean of the sides of the parts in m, by the magnitude of weight; exact if all are those of the first one.
fn mean_side_m(first: &Part<'_>, parts: &[Part<'_>]) -> f64 {
    let total: f64 = parts.iter().map(|part| part.weight.abs()).sum();
    let side_m = first.fitted.side_m();
    let ln_ratio = |part: &Part<'_>| part.weight.abs() / total * (part.fitted.side_m() / side_m).ln();
    let mean_m = side_m * parts.iter().map(ln_ratio).sum::<f64>().exp();
    mean_m.clamp(*SIDES_M.start(), *SIDES_M.end())
}

/// Means of the options by the magnitude of weight: weights of a field can be negative, forces cannot.
fn mean_options(parts: &[Part<'_>]) -> HeightMapOptions {
    let total: f64 = parts.iter().map(|part| part.weight.abs()).sum();
    let mean = |value: fn(&HeightMapOptions) -> f64| {
        parts.iter().map(|part| part.weight.abs() / total * value(&part.fitted.map.options)).sum::<f64>()
    };
    // A mean can leave the valid range by a rounding error.
    HeightMapOptions {
        force: Newtons(mean(|options| options.force.0).clamp(*FORCES_N.start(), *FORCES_N.end())),
        speed_exponent: mean(|options| options.speed_exponent).min(*SPEED_EXPONENTS.end()),
        patch_radius_m: mean(|options| options.patch_radius_m).min(*PATCH_RADII_M.end()),
    }
}

#[cfg(test)]
mod tests;
