//! Textures at the same speeds and forces, as spectra of the same bins and predictors of the same order: what can be
//! averaged, compared and put together anew.

mod bins;
mod exponential;

use crate::ar::levinson;
use crate::lsf::{QuickLsf, repair_to};
use crate::plane::{Grain, Plane};
use crate::sampled::bins::Bins;
use crate::tap::Tap;
use crate::texture::{GrainNode, MAX_ORDER, TextureModel, TextureModelError};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Speeds and forces of a lattice.
const N_SPEEDS: usize = 5;
const N_FORCES: usize = 5;
/// Bins of a spectrum at 1 kHz, from zero to half the rate; as wide at other rates.
const BINS_AT_1_KHZ: f64 = 128.0;
/// Lowest order of a predictor through a mean of spectra: lower ones lose the shape of a real spectrum.
const MIN_ORDER: usize = 20;
/// Poles more that stand for a moving average.
const POLES_FOR_ZEROS: usize = 8;
/// Distance of frequencies that is kept, in radians.
const GAP: f64 = 1e-4;
/// Density below which nothing is told apart, in (m/s²)²/Hz: its root over 500 Hz is a hundred-thousandth of what a
/// finger feels.
const FLOOR_PSD: f64 = 1e-15;
/// Level below which a texture is silent, in m/s².
const FLOOR_MPS2: f64 = 1e-6;

/// What of a texture is blended.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    /// Its grain.
    pub plane: &'a Plane,
    /// Kinetic friction coefficient, where it is known.
    pub friction: Option<f64>,
    /// The transient of a landing, where it was measured.
    pub tap: Option<Tap>,
}

/// Speeds and forces, all of one with all of the other.
#[derive(Clone, Debug, PartialEq)]
struct Lattice {
    contacts: Vec<Contact>,
}

/// Grain at the contacts of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SampledGrain {
    /// ln of the density in (m/s²)²/Hz, bin by bin, contact by contact.
    pub(crate) ln_psd: Vec<f32>,
    /// Line spectral frequencies in radians, contact by contact.
    pub(crate) lsf: Vec<f64>,
    /// ln of the level in m/s² at each contact.
    pub(crate) ln_level: Vec<f64>,
}

/// How textures of one rate are sampled.
#[derive(Clone, Debug)]
pub(crate) struct Sampling {
    lattice: Lattice,
    rate: Hertz,
    order: usize,
    bins: Bins,
    frequencies: Vec<Hertz>,
    quick: QuickLsf,
}

impl Lattice {
    /// A lattice over what textures know: from the middle of their lowest speeds and forces to the highest of all, in equal ratios.
    fn over(planes: &[&Plane]) -> Self {
        let (mut low, mut high) = ([Vec::new(), Vec::new()], [0.0_f64; 2]);
        for plane in planes {
            let measured = plane.measured();
            for axis in 0..2 {
                low[axis].push(measured[axis].0);
                high[axis] = high[axis].max(measured[axis].1);
            }
        }
        let [low_speed, low_force] = low.map(middle);
        let speeds = ratios(low_speed, high[0], N_SPEEDS);
        let forces = ratios(low_force, high[1], N_FORCES);
        let at = |speed: f64, force: f64| Contact { speed: MetersPerSecond(speed), force: Newtons(force) };
        let contacts = speeds.iter().flat_map(|v| forces.iter().map(|f| at(*v, *f))).collect();
        Self { contacts }
    }
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// `n` numbers from `low` to `high` in equal ratios; one where there is no room between.
fn ratios(low: f64, high: f64, n: usize) -> Vec<f64> {
    if high < 1.01 * low {
        return vec![high];
    }
    let low = low.max(0.01 * high);
    let share = |i: usize| i as f64 / (n - 1) as f64;
    (0..n).map(|i| if i + 1 == n { high } else { low * (high / low).powf(share(i)) }).collect()
}

impl Sampling {
    /// A lattice, bins and an order that fit the planes, which have one rate; `None` without any.
    pub(crate) fn new(planes: &[&Plane]) -> Option<Self> {
        let rate = planes.first()?.rate();
        let poles = |plane: &&Plane| {
            let [order, ma_order] = plane.orders();
            order + if ma_order > 0 { ma_order + POLES_FOR_ZEROS } else { 0 }
        };
        let order = planes.iter().map(poles).max()?.clamp(MIN_ORDER, MAX_ORDER).next_multiple_of(2);
        let n_bins = (BINS_AT_1_KHZ * rate.0 / 1000.0).ceil() as usize;
        let bins = Bins::new(rate, n_bins, order);
        let (lattice, frequencies) = (Lattice::over(planes), bins.frequencies());
        Some(Self { lattice, rate, order, bins, frequencies, quick: QuickLsf::new() })
    }

    /// The grain of a plane.
    pub(crate) fn sample(&self, plane: &Plane) -> SampledGrain {
        let n = self.lattice.contacts.len();
        let mut sampled = SampledGrain {
            ln_psd: Vec::with_capacity(n * self.bins.len()),
            lsf: Vec::with_capacity(n * self.order),
            ln_level: Vec::with_capacity(n),
        };
        for contact in &self.lattice.contacts {
            let grain = plane.at(*contact);
            let psd = grain.psd(&self.frequencies);
            let ln_psd: Vec<f32> = psd.iter().map(|p| p.max(FLOOR_PSD).ln() as f32).collect();
            sampled.lsf.extend(self.frequencies_of(&grain, &ln_psd));
            sampled.ln_level.push(grain.level_mps2.max(FLOOR_MPS2).ln());
            sampled.ln_psd.extend(ln_psd);
        }
        sampled
    }

    /// Line spectral frequencies at the common order: a predictor is filled up with zeros, which change nothing; with a
    /// moving average it is fitted anew.
    fn frequencies_of(&self, grain: &Grain, ln_psd: &[f32]) -> Vec<f64> {
        if grain.ma_lsf.is_empty() {
            let mut ar = grain.ar();
            ar.resize(self.order, 0.0);
            if let Some(lsf) = self.quick.of(&ar) {
                return lsf;
            }
        }
        self.fit(ln_psd).0
    }

    /// The predictor whose spectrum is nearest to densities `e^ln_psd` (Levinson's), as line spectral frequencies, and the
    /// level.
    fn fit(&self, ln_psd: &[f32]) -> (Vec<f64>, f64) {
        let mut lags = self.bins.lags(ln_psd);
        let level = lags[0].sqrt();
        // A billionth of white noise keeps rounding from making the predictor unstable.
        lags[0] *= 1.0 + 1e-9;
        let ar = levinson(&lags, self.order).ar;
        (self.quick.of(&ar).unwrap_or_else(|| even(self.order)), level)
    }

    /// A texture whose grain has these densities, as ln, bin by bin, contact by contact.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub(crate) fn texture_of_spectra(
        &self,
        ln_psd: &[f32],
        friction: Option<f64>,
        tap: Option<Tap>,
    ) -> Result<TextureModel, TextureModelError> {
        let spectra = ln_psd.chunks_exact(self.bins.len());
        let nodes = self.lattice.contacts.iter().zip(spectra).map(|(at, ln_psd)| {
            let (lsf, level_mps2) = self.fit(ln_psd);
            node(*at, &lsf, level_mps2)
        });
        Ok(TextureModel::new(self.rate, nodes.collect(), friction)?.with_tap(tap))
    }

    /// A texture with these frequencies and levels, contact by contact.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub(crate) fn texture_of_frequencies(
        &self,
        lsf: &[f64],
        ln_level: &[f64],
        friction: Option<f64>,
        tap: Option<Tap>,
    ) -> Result<TextureModel, TextureModelError> {
        let nodes = self.lattice.contacts.iter().zip(lsf.chunks_exact(self.order)).zip(ln_level);
        let nodes = nodes.map(|((at, lsf), ln_level)| node(*at, lsf, ln_level.exp()));
        Ok(TextureModel::new(self.rate, nodes.collect(), friction)?.with_tap(tap))
    }
}

fn node(at: Contact, lsf: &[f64], level_mps2: f64) -> GrainNode {
    // What is at the floor was silent.
    let level_mps2 = if level_mps2 <= 1.01 * FLOOR_MPS2 { 0.0 } else { level_mps2 };
    GrainNode { speed: at.speed, force: at.force, lsf: repair_to(lsf, GAP), level_mps2 }
}

/// The frequencies of a predictor of zeros.
fn even(order: usize) -> Vec<f64> {
    (1..=order).map(|i| std::f64::consts::PI * i as f64 / (order + 1) as f64).collect()
}
