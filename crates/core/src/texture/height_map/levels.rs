//! Height map in the form that the renderer uses.

mod sum;

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::sync::{Arc, OnceLock};

use rustfft::num_complex::Complex;
use shagreen_synth::height_map::{HeightMap as SynthHeightMap, LEAST_SIDE, MOST_SIDE, PATCH_FORCES, length};

use crate::dsp::contact_patch::patch_gain;
use crate::dsp::square_transform::{coefficients, index_of, series, wave_number};
use crate::texture::height_map::HeightMap;

/// Share of the acceleration power that may lie beyond the band of octave 0: -60 dB.
const LEFT_OUT: f64 = 1e-6;
/// Share of the acceleration power of a map that a larger tile must hold.
const HELD: f64 = 0.9;

/// Height map as spline coefficients in octaves for three contact patches, in `f32`. For a faster tip, the renderer reads
/// later octaves, so that it plays no content above the Nyquist frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMapLevels {
    side_m: f64,
    force_n: f32,
    speed_exponent: f32,
    n: usize,
    octaves: Vec<f32>,
}

/// Levels of a map, which are prepared at most once. Maps are equal whether they are prepared or not.
#[derive(Clone, Default)]
pub(super) struct KeptLevels(OnceLock<Arc<HeightMapLevels>>);

impl KeptLevels {
    /// Levels of a map that needs no preparation.
    pub(super) fn of(levels: HeightMapLevels) -> Self {
        Self(OnceLock::from(Arc::new(levels)))
    }

    /// Levels of the map with heights times `factor`, if those of this map are prepared: they are linear in the heights.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let Some(levels) = self.0.get() else { return Self::default() };
        let levels = if factor == 1.0 { Arc::clone(levels) } else { Arc::new(levels.scaled(factor)) };
        Self(OnceLock::from(levels))
    }
}

impl PartialEq for KeptLevels {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for KeptLevels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("KeptLevels")
    }
}

/// A wave of a height map.
pub(super) struct Wave {
    /// Periods along x and y on the tile.
    pub(super) periods: [isize; 2],
    /// Angular wave number in 1/m.
    pub(super) k_per_m: f64,
    /// Amplitude and phase in m: the heights are the sum of `amplitude exp(2πi periods · place / side)`.
    pub(super) amplitude: Complex<f64>,
}

impl HeightMap {
    /// Returns the map for the renderer, which the first call prepares and the map keeps. Waves of two steps and less, and
    /// the mean height, are left out.
    ///
    /// Octave 0 has as many samples as the waves need that a tip can feel through the smallest patch, at most twice as
    /// many along a side as the map. Memory: at most 64 n² bytes, which is 16.8 MB for n = 512 and 4.2 MB for n = 256.
    pub fn prepare(&self) -> Arc<HeightMapLevels> {
        Arc::clone(self.levels.0.get_or_init(|| Arc::new(self.prepared_on(1))))
    }

    /// Whether [`HeightMap::prepare`] returns without work.
    pub fn is_prepared(&self) -> bool {
        self.levels.0.get().is_some()
    }

    /// This map for the renderer, repeated `copies` times along both sides of a larger tile. Waves of fewer than four samples
    /// on [`MOST_SIDE`] samples along that tile are left out.
    pub(super) fn prepared_on(&self, copies: usize) -> HeightMapLevels {
        let mut waves = self.waves();
        for wave in &mut waves {
            wave.periods = wave.periods.map(|periods| periods * copies.cast_signed());
        }
        let radius_m = self.options.patch_radius_m;
        let radii_m = PATCH_FORCES.map(|force| f64::from(force).cbrt() * radius_m);
        let most = (2 * copies * self.n).next_power_of_two().min(MOST_SIDE);
        let n = side_of_octave_0(&waves, radii_m[0], most);
        let mut octaves = vec![0.0; PATCH_FORCES.len() * length(n)];
        let mut m = n;
        while m >= LEAST_SIDE {
            let begin = length(n) - length(m);
            // The coefficients are real, so that one complex transform serves two patches.
            for (first, second) in [(0, 1), (2, 2)] {
                let samples = spline(&waves, m, [radii_m[first], radii_m[second]]);
                for (at, sample) in samples.iter().enumerate() {
                    octaves[first * length(n) + begin + at] = sample.re as f32;
                    octaves[second * length(n) + begin + at] = sample.im as f32;
                }
            }
            m /= 2;
        }
        HeightMapLevels {
            side_m: copies as f64 * self.side_m,
            force_n: self.options.force.0 as f32,
            speed_exponent: self.options.speed_exponent as f32,
            n,
            octaves,
        }
    }

    /// Most copies along a larger tile with which [`HeightMap::prepared_on`] holds [`HELD`] of the acceleration power that can
    /// be felt through the smallest patch; at least one.
    pub(super) fn most_copies(&self) -> usize {
        let radius_m = f64::from(PATCH_FORCES[0]).cbrt() * self.options.patch_radius_m;
        let mut powers: Vec<(isize, f64)> =
            self.waves().iter().map(|wave| (squared_periods(wave), felt_power(wave, radius_m))).collect();
        powers.sort_unstable_by_key(|(squared, _)| *squared);
        let total: f64 = powers.iter().map(|(_, power)| power).sum();
        let mut held = 0.0;
        let shortest = powers.iter().find(|(_, power)| {
            held += power;
            held >= HELD * total
        });
        // Without waves, nothing can be lost.
        let periods = shortest.map_or(1.0, |(squared, _)| (*squared as f64).sqrt());
        ((MOST_SIDE / 4) as f64 / periods).max(1.0) as usize
    }

    /// All waves longer than two steps, in any direction, without the mean height.
    pub(super) fn waves(&self) -> Vec<Wave> {
        let n = self.n;
        let wave = |(index, amplitude): (usize, Complex<f64>)| {
            let periods = [index % n, index / n].map(|index| wave_number(index, n));
            let n_periods = (periods[0] as f64).hypot(periods[1] as f64);
            let is_held = n_periods > 0.0 && 2.0 * n_periods < n as f64;
            is_held.then(|| Wave { periods, k_per_m: TAU * n_periods / self.side_m, amplitude })
        };
        coefficients(&self.heights_m).into_iter().enumerate().filter_map(wave).collect()
    }
}

/// Fewest samples along a side, up to `most`, whose band contains what can be felt through a patch of this radius.
fn side_of_octave_0(waves: &[Wave], patch_radius_m: f64, most: usize) -> usize {
    let power = |wave: &Wave| felt_power(wave, patch_radius_m);
    let total: f64 = waves.iter().map(power).sum();
    let mut n = LEAST_SIDE;
    while n < most {
        let beyond: f64 = waves.iter().filter(|wave| !is_within(wave, n)).map(power).sum();
        if beyond <= LEFT_OUT * total {
            break;
        }
        n *= 2;
    }
    n
}

/// Acceleration power of a wave through a patch of this radius, at a speed of 1 m/s.
fn felt_power(wave: &Wave, patch_radius_m: f64) -> f64 {
    let acceleration = wave.k_per_m * wave.k_per_m * patch_gain(wave.k_per_m * patch_radius_m);
    acceleration * acceleration * wave.amplitude.norm_sqr()
}

/// Square of the number of periods on the tile, in the direction of the wave.
fn squared_periods(wave: &Wave) -> isize {
    let [x, y] = wave.periods;
    x * x + y * y
}

/// Whether a wave has at least four samples per period on `n` samples along a side.
fn is_within(wave: &Wave, n: usize) -> bool {
    16 * squared_periods(wave) <= (n * n).cast_signed()
}

/// Spline coefficients on `n` × `n` samples of the waves within their band: the real parts for a patch of the first radius,
/// the imaginary parts for one of the second.
fn spline(waves: &[Wave], n: usize, radii_m: [f64; 2]) -> Vec<Complex<f64>> {
    let mut field = vec![Complex::new(0.0, 0.0); n * n];
    for wave in waves.iter().filter(|wave| is_within(wave, n)) {
        let [first, second] = radii_m.map(|radius_m| patch_gain(wave.k_per_m * radius_m));
        let [column, row] = wave.periods.map(|periods| index_of(periods, n));
        let [x, y] = wave.periods.map(|periods| spline_gain(periods as f64 / n as f64));
        field[row * n + column] = wave.amplitude * Complex::new(first, second) / (x * y);
    }
    series(&mut field);
    field
}

/// Gain of a B-spline of degree five at a frequency in cycles per sample: sinc⁶.
fn spline_gain(frequency: f64) -> f64 {
    let angle = PI * frequency;
    if angle == 0.0 { 1.0 } else { (angle.sin() / angle).powi(6) }
}

impl HeightMapLevels {
    fn scaled(&self, factor: f64) -> Self {
        let octaves = self.octaves.iter().map(|sample| (factor * f64::from(*sample)) as f32).collect();
        Self { octaves, ..*self }
    }

    /// Height map borrowed by a renderer.
    pub fn view(&self) -> SynthHeightMap<'_> {
        // Every valid height map gives numbers that the renderer accepts; a property test checks this.
        SynthHeightMap::checked_before(self.side_m, self.force_n, self.speed_exponent, self.n, &self.octaves)
    }
}
