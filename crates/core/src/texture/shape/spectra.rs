//! Grain in a shape: level, grain size and brightness.

use crate::dsp::ar::{self, levinson};
use crate::dsp::arma;
use crate::dsp::lsf::{ar_from_lsf, lsf_from_ar, repair_to};
use crate::texture::model::decays;
use crate::texture::refit::{FAINTEST, LEAST_ORDER, SpectrumGrid};
use crate::texture::shape::Shape;
use crate::texture::{
    GAINS, Grain, GrainNode, Interpolation, LEVELS_MPS2, MIN_LSF_GAP, PublishedNode, TextureModel,
    TextureModelError,
};
use crate::units::Hertz;

/// Frequency at which brightness changes nothing, except for the factor that keeps the level.
const PIVOT_HZ: f64 = 100.0;
/// Frequency below which the tilt fades to a constant. Without it, a slope of -6 dB an octave would move the level to
/// frequencies that no actuator plays.
const FLAT_BELOW_HZ: f64 = 15.0;
/// Smallest widening of the peaks of a spectrum that the renderer cannot play, in rad: 0.16 Hz at a model rate of 1 kHz.
const LEAST_WIDENING: f64 = 1e-3;
/// Number of widenings that are tried, each twice the one before. The last one leaves nearly white noise.
const N_WIDENINGS: i32 = 10;
/// Minimum distance of line spectral frequencies after a fit, in rad; more than [`MIN_LSF_GAP`], for rounding.
const GAP: f64 = 1.5 * MIN_LSF_GAP;

/// What a shape does to the nodes of a texture.
pub(super) struct NodeShaper {
    /// Factor of the level.
    level: f64,
    refit: Option<Refit>,
}

/// Change of the spectra of all nodes.
struct Refit {
    grid: SpectrumGrid,
    /// Factor of the density at each point of the grid; empty without a tilt.
    tilt: Vec<f64>,
}

impl NodeShaper {
    /// Shaper for the nodes of a model; `None` if the shape leaves all nodes as they are. The values of the shape must be
    /// in their ranges.
    pub(super) fn new(model: &TextureModel, shape: &Shape) -> Option<Self> {
        let is_refit = shape.grain != 1.0 || shape.brightness_db_per_octave != 0.0;
        let refit = is_refit.then(|| Refit::new(model, shape.grain, shape.brightness_db_per_octave));
        (is_refit || shape.level_db != 0.0).then(|| Self { level: shape.level_factor(), refit })
    }

    fn measured(&self, (index, node): (usize, &GrainNode)) -> Result<GrainNode, TextureModelError> {
        let (lsf, kept) = match &self.refit {
            Some(refit) => refit.shaped(index, &[ar_from_lsf(&node.lsf), Vec::new()])?,
            None => (node.lsf.clone(), 1.0),
        };
        let level_mps2 = (self.level * kept * node.level_mps2).min(*LEVELS_MPS2.end());
        Ok(GrainNode { lsf, level_mps2, ..node.clone() })
    }

    fn published(&self, (index, node): (usize, &PublishedNode)) -> Result<PublishedNode, TextureModelError> {
        let Some(refit) = &self.refit else {
            return Ok(PublishedNode { gain: (self.level * node.gain).min(*GAINS.end()), ..node.clone() });
        };
        let filter = [ar_from_lsf(&node.ar_lsf), ar_from_lsf(&node.ma_lsf)];
        let (ar_lsf, kept) = refit.shaped(index, &filter)?;
        // The gain compensates for the difference between the filters' power gains.
        let power = arma::power_gain(&filter[0], &filter[1]) / ar::power_gain(&ar_from_lsf(&ar_lsf));
        let power = if power.is_finite() { power } else { 1.0 };
        let gain = (self.level * kept * power.sqrt() * node.gain).min(*GAINS.end());
        Ok(PublishedNode { ar_lsf, ma_lsf: Vec::new(), gain, ..node.clone() })
    }
}

/// The texture with shaped nodes, also along the lay, and with all its other layers.
///
/// # Errors
/// See [`TextureModelError`].
pub(super) fn shaped_grain(
    model: &TextureModel,
    shaper: &NodeShaper,
) -> Result<TextureModel, TextureModelError> {
    let (rate, friction) = (model.rate(), model.friction());
    let (nodes, interpolation) = match model.grain() {
        Grain::Measured { nodes, interpolation } => (nodes, *interpolation),
        Grain::Published { nodes } => {
            let nodes = nodes.iter().enumerate().map(|node| shaper.published(node));
            let made = TextureModel::published(rate, nodes.collect::<Result<_, _>>()?, friction)?;
            return Ok(made.with_layers_of(model));
        }
    };
    let shaped = |nodes: &[GrainNode]| -> Result<Vec<GrainNode>, TextureModelError> {
        nodes.iter().enumerate().map(|node| shaper.measured(node)).collect()
    };
    // Fitted filters are tested one by one, and the others were tested before.
    let mut made = TextureModel::blended(rate, shaped(nodes)?, friction)?.with_layers_of(model);
    if interpolation != Interpolation::default() {
        made = made.with_interpolation(interpolation)?;
    }
    match model.along() {
        Some(along) => made.with_blended_along(shaped(along)?),
        None => Ok(made),
    }
}

impl Refit {
    /// The spectrum `S(f)` becomes `S(g f) T(f)` with the grain size `g` and the tilt `T`.
    ///
    /// A filter that is fitted at `g` times the rate and run at the rate itself has all its frequencies divided by `g`.
    fn new(model: &TextureModel, grain: f64, brightness_db_per_octave: f64) -> Self {
        let rate = model.rate();
        let grid = SpectrumGrid::new(rate, Hertz(grain * rate.0), model.order().max(LEAST_ORDER));
        // A slope of b dB an octave is a density of f^(b / 10 log10(2)).
        let exponent = 0.05 * brightness_db_per_octave / 2_f64.log10();
        let square = |hz: f64| hz * hz + FLAT_BELOW_HZ * FLAT_BELOW_HZ;
        let tilt = |f: Hertz| (square(f.0 / grain) / square(PIVOT_HZ)).powf(exponent);
        let is_tilted = brightness_db_per_octave != 0.0;
        let tilt = if is_tilted { grid.frequencies().map(tilt).collect() } else { Vec::new() };
        Self { grid, tilt }
    }

    /// Line spectral frequencies of the shaped filter (AR and moving-average part) of the node with this index, and the
    /// factor of the level due to power that leaves the band.
    fn shaped(&self, index: usize, filter: &[Vec<f64>; 2]) -> Result<(Vec<f64>, f64), TextureModelError> {
        let mut spectrum = self.grid.spectrum(filter);
        let kept = self.grid.kept_power(&spectrum).sqrt();
        for (density, factor) in spectrum.iter_mut().zip(&self.tilt) {
            *density *= factor;
        }
        let mean = spectrum.iter().sum::<f64>() / spectrum.len() as f64;
        // A filter without power up to the new Nyquist frequency, or without a finite one, becomes white noise.
        let scale = if mean.is_normal() { mean.recip() } else { 0.0 };
        for density in &mut spectrum {
            *density = (scale * *density).max(FAINTEST);
        }
        let lsf = playable(&self.grid.lags(&spectrum)).ok_or(TextureModelError::Unstable { index })?;
        Ok((lsf, kept))
    }
}

/// Line spectral frequencies of the predictor of an autocorrelation, with peaks wide enough for the renderer. `None` if
/// there is no such predictor, which happens for no autocorrelation of a positive spectrum.
fn playable(lags: &[f64]) -> Option<Vec<f64>> {
    let widenings = (0..N_WIDENINGS).map(|i| LEAST_WIDENING * 2_f64.powi(i));
    std::iter::once(0.0).chain(widenings).find_map(|widening| {
        // A Gaussian window over the lags convolves the spectrum with a Gaussian.
        let window = |k: usize| (-0.5 * (widening * k as f64).powi(2)).exp();
        let windowed: Vec<f64> = lags.iter().enumerate().map(|(k, lag)| window(k) * lag).collect();
        let lsf = repair_to(lsf_from_ar(&levinson(&windowed, lags.len() - 1).ar)?, GAP);
        decays(&lsf).then_some(lsf)
    })
}
