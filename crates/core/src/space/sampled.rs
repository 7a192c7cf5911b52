//! Textures sampled at common speeds and forces, as spectra with common bins and predictors of a common order, so that
//! they can be averaged, compared and resynthesized.

mod bins;
mod exponential;
mod lattice;

use std::sync::Arc;

use crate::dsp::ar::{SIDE_BY_SIDE, levinson_side_by_side};
use crate::dsp::lsf::{FastLsf, repair_to};
use crate::space::sampled::bins::Bins;
use crate::space::sampled::lattice::lattice;
use crate::texture::height_map::HeightMap;
use crate::texture::plane::{Grain, Plane};
use crate::texture::stick_slip::StickSlip;
use crate::texture::tap::Tap;
use crate::texture::{GrainNode, MAX_ORDER, TextureModel, TextureModelError};
use crate::units::{Contact, Hertz};

/// Number of bins of a spectrum at a sample rate of 1 kHz, from zero to half the rate; bins are equally wide at other
/// rates.
const BINS_AT_1_KHZ: f64 = 128.0;
/// Minimum order of a predictor fitted to a mean spectrum; lower orders lose the shape of a real spectrum.
const MIN_ORDER: usize = 20;
/// Additional poles that approximate a moving average.
const POLES_FOR_ZEROS: usize = 8;
/// Highest order for a texture with a moving average; more poles would approximate details of no importance.
const MAX_WITH_ZEROS: usize = 32;
/// Minimum spacing of line spectral frequencies, in radians.
const GAP: f64 = 1e-4;
/// Lower limit of a spectral density, in (m/s²)²/Hz; smaller densities are raised to it. The corresponding level over
/// 500 Hz is a hundred-thousandth of the detection threshold of a finger.
const FLOOR_PSD: f64 = 1e-15;

/// Properties of a texture that are interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    /// Vibration model of the texture for strokes across its lay, and its relief.
    pub plane: &'a Plane,
    /// Vibration model for strokes along the lay, measured at the same speeds and forces; `None` for an isotropic
    /// texture.
    pub along: Option<&'a Plane>,
    /// Kinetic friction coefficient, if known.
    pub friction: Option<f64>,
    /// Tap transient, if measured.
    pub tap: Option<Tap>,
    /// Height map, if the texture has one.
    pub height_map: Option<&'a Arc<HeightMap>>,
    /// Parameters of stick-slip friction, if the texture has it.
    pub stick_slip: Option<StickSlip>,
    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    pub turn_rad: f64,
}

impl<'a> Layers<'a> {
    /// Layers of a texture with this plane, which may have a higher sample rate.
    pub fn of(model: &'a TextureModel, plane: &'a Plane) -> Self {
        Self {
            plane,
            along: plane.along(),
            friction: model.friction(),
            tap: model.tap(),
            height_map: model.height_map(),
            stick_slip: model.stick_slip(),
            turn_rad: model.turn_rad(),
        }
    }
}

/// Vibration model of a texture, sampled at the contacts of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SampledGrain {
    /// ln of the density in (m/s²)²/Hz, contact by contact, bin by bin.
    pub(crate) ln_psd: Vec<f32>,
    /// Line spectral frequencies in radians, contact by contact.
    pub(crate) lsf: Vec<f64>,
    /// ln of the level in m/s², one per contact.
    pub(crate) ln_level: Vec<f64>,
}

/// Common lattice, bins and predictor order for textures of one sample rate.
#[derive(Clone, Debug)]
pub(crate) struct Sampling {
    contacts: Vec<Contact>,
    rate: Hertz,
    order: usize,
    bins: Bins,
    frequencies: Vec<Hertz>,
    quick: FastLsf,
}

impl Sampling {
    /// Sampling that fits all planes, which must have one sample rate; `None` without planes.
    pub(crate) fn new(planes: &[&Plane]) -> Option<Self> {
        let rate = planes.first()?.rate();
        let poles = |plane: &&Plane| {
            let [order, ma_order] = plane.orders();
            if ma_order > 0 { (order + ma_order + POLES_FOR_ZEROS).min(MAX_WITH_ZEROS) } else { order }
        };
        let order = planes.iter().map(poles).max()?.clamp(MIN_ORDER, MAX_ORDER).next_multiple_of(2);
        let n_bins = (BINS_AT_1_KHZ * rate.0 / 1000.0).ceil() as usize;
        let bins = Bins::new(rate, n_bins, order);
        let (contacts, frequencies) = (lattice(planes), bins.frequencies());
        Some(Self { contacts, rate, order, bins, frequencies, quick: FastLsf::new() })
    }

    /// Samples the vibration model of a plane.
    pub(crate) fn sample(&self, plane: &Plane) -> SampledGrain {
        let n = self.contacts.len();
        let mut sampled = SampledGrain {
            ln_psd: Vec::with_capacity(n * self.bins.len()),
            lsf: Vec::with_capacity(n * self.order),
            ln_level: Vec::with_capacity(n),
        };
        for contact in &self.contacts {
            let grain = plane.at(*contact);
            let psd = grain.psd(&self.frequencies);
            let ln_psd: Vec<f32> = psd.iter().map(|p| p.max(FLOOR_PSD).ln() as f32).collect();
            sampled.lsf.extend(self.frequencies_of(&grain, &ln_psd));
            sampled.ln_level.push(grain.level_mps2.max(self.floor_mps2()).ln());
            sampled.ln_psd.extend(ln_psd);
        }
        sampled
    }

    /// Level in m/s² of a texture whose density is [`FLOOR_PSD`] everywhere. Levels near it come from silent textures.
    fn floor_mps2(&self) -> f64 {
        (FLOOR_PSD * 0.5 * self.rate.0).sqrt()
    }

    fn node(&self, at: Contact, lsf: Vec<f64>, level_mps2: f64) -> GrainNode {
        let level_mps2 = if level_mps2 < 2.0 * self.floor_mps2() { 0.0 } else { level_mps2 };
        GrainNode { speed: at.speed, force: at.force, lsf: repair_to(lsf, GAP), level_mps2 }
    }

    /// Line spectral frequencies at the common order. A predictor without a moving-average part is padded with zeros,
    /// which does not change it; a filter with such a part is fitted again.
    fn frequencies_of(&self, grain: &Grain, ln_psd: &[f32]) -> Vec<f64> {
        if grain.ma_lsf.is_empty() {
            let mut ar = grain.ar();
            ar.resize(self.order, 0.0);
            if let Some(lsf) = self.quick.of(&ar) {
                return lsf;
            }
        }
        self.fit(&[ln_psd]).swap_remove(0).0
    }

    /// Predictors fitted to the densities `e^ln_psd` by Levinson's recursion, as line spectral frequencies, and their
    /// levels; at most [`SIDE_BY_SIDE`] at once.
    fn fit(&self, ln_psds: &[&[f32]]) -> Vec<(Vec<f64>, f64)> {
        let mut lags = self.bins.lags(ln_psds);
        let levels = lags[0].map(f64::sqrt);
        // White noise of 1e-9 of the power keeps rounding errors from making a predictor unstable.
        lags[0] = lags[0].map(|power| power * (1.0 + 1e-9));
        let predictors = levinson_side_by_side(&lags);
        let of_predictor = |ar: &Vec<f64>| self.quick.of(ar).unwrap_or_else(|| even(self.order));
        predictors.iter().map(of_predictor).zip(levels).take(ln_psds.len()).collect()
    }

    /// Nodes with these ln densities, contact by contact, bin by bin.
    pub(crate) fn nodes_of_spectra(&self, ln_psd: &[f32]) -> Vec<GrainNode> {
        let spectra: Vec<&[f32]> = ln_psd.chunks_exact(self.bins.len()).collect();
        let fitted = spectra.chunks(SIDE_BY_SIDE).flat_map(|spectra| self.fit(spectra));
        let nodes = self.contacts.iter().zip(fitted);
        nodes.map(|(at, (lsf, level_mps2))| self.node(*at, lsf, level_mps2)).collect()
    }

    /// Nodes with these line spectral frequencies and ln levels, contact by contact.
    pub(crate) fn nodes_of_frequencies(&self, lsf: &[f64], ln_level: &[f64]) -> Vec<GrainNode> {
        let nodes = self.contacts.iter().zip(lsf.chunks_exact(self.order)).zip(ln_level);
        nodes.map(|((at, lsf), ln_level)| self.node(*at, lsf.to_vec(), ln_level.exp())).collect()
    }

    /// Texture with these nodes across its lay and, unless it is isotropic, along it.
    ///
    /// # Errors
    /// See [`TextureModelError`].
    pub(crate) fn texture(
        &self,
        across: Vec<GrainNode>,
        along: Option<Vec<GrainNode>>,
        friction: Option<f64>,
        tap: Option<Tap>,
    ) -> Result<TextureModel, TextureModelError> {
        let isotropic = TextureModel::blended(self.rate, across, friction)?.with_tap(tap);
        match along {
            Some(along) => isotropic.with_blended_along(along),
            None => Ok(isotropic),
        }
    }
}

/// Line spectral frequencies of the predictor with all coefficients zero.
fn even(order: usize) -> Vec<f64> {
    (1..=order).map(|i| std::f64::consts::PI * i as f64 / (order + 1) as f64).collect()
}
