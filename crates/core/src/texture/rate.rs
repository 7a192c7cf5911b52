//! Conversion of a texture model to a higher rate, so that textures with different rates can be mixed.
//!
//! The spectrum up to the old Nyquist frequency is kept, and the density above it falls steeply. The Fourier transform
//! of this spectrum is its autocorrelation (Wiener-Khinchin theorem), from which the Levinson-Durbin recursion computes
//! the predictor.

use std::f64::consts::PI;

use crate::dsp::ar::{self, levinson};
use crate::dsp::arma;
use crate::dsp::lsf::{ar_from_lsf, lsf_from_ar};
use crate::texture::{
    Grain, GrainNode, Interpolation, MAX_ORDER, PublishedNode, TextureModel, TextureModelError,
};
use crate::units::Hertz;

/// Number of spectral points between zero and the new Nyquist frequency.
const N_POINTS: usize = 2048;
/// Width of the transition above the old Nyquist frequency, relative to that frequency, and density above the
/// transition. The density is relative to the smaller of the density at the old Nyquist frequency and the mean density.
///
/// A steeper or deeper transition makes the predictor spend its order on the transition; a gentler one leaves audible
/// content above. These two values minimize the error over the starter library from 1 to 2 kHz.
const FALL: f64 = 0.4;
const FLOOR: f64 = 1e-4;
/// Lowest density relative to the mean; deeper notches make the equations ill-conditioned.
const FAINTEST: f64 = 1e-8;
/// Fraction of the old Nyquist frequency up to which spectra are compared.
const COMPARED: f64 = 0.9;
/// Number of frequencies at which spectra are compared.
const N_COMPARED: usize = 200;

/// Model converted to a higher rate.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRate {
    /// Converted model: the same nodes with the same levels.
    pub model: TextureModel,
    /// Median over the nodes of the root mean square spectral difference in dB, up to 0.9 of the old Nyquist frequency.
    pub error_db_median: f64,
    /// Largest root mean square spectral difference of a node, in dB.
    pub error_db_worst: f64,
}

/// Error of converting a model to another rate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AtRateError {
    /// The requested rate is below the model rate.
    #[error(
        "a model at {own_hz} Hz cannot be converted to {rate_hz} Hz, because its content above half of the new rate would be lost; use a rate of at least {own_hz} Hz"
    )]
    Lower {
        /// Model rate, in Hz.
        own_hz: f64,
        /// Requested rate, in Hz.
        rate_hz: f64,
    },
    /// A node has no stable predictor at the new rate.
    #[error(
        "the spectrum of node {index} cannot be converted to {rate_hz} Hz, because its peaks are too sharp; use a lower rate, or smooth the peaks"
    )]
    Spectrum {
        /// Index of the node.
        index: usize,
        /// Requested rate, in Hz.
        rate_hz: f64,
    },
    /// The converted numbers do not form a valid model.
    #[error("the converted numbers do not form a valid texture")]
    Model(#[from] TextureModelError),
}

/// Highest rate of the models, to which all of them can be converted; `None` if there are no models.
pub fn highest_rate<'a, I: IntoIterator<Item = &'a TextureModel>>(models: I) -> Option<Hertz> {
    models.into_iter().map(TextureModel::rate).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Converts a model to `rate`, at least its own rate.
///
/// The result has predictors of order [`MAX_ORDER`] without a moving average, and the same level at every node. At its
/// own rate the model is returned unchanged.
///
/// # Errors
/// See [`AtRateError`].
pub fn at_rate(model: &TextureModel, rate: Hertz) -> Result<AtRate, AtRateError> {
    let own = model.rate();
    if rate == own {
        return Ok(AtRate { model: model.clone(), error_db_median: 0.0, error_db_worst: 0.0 });
    }
    if rate.0.is_nan() || rate.0 < own.0 {
        return Err(AtRateError::Lower { own_hz: own.0, rate_hz: rate.0 });
    }
    let converter = Converter::new(own, rate);
    let mut errors_db = Vec::with_capacity(model.n_nodes());
    let mut convert = |index: usize, lsf: &[f64], ma_lsf: &[f64]| {
        let filter = [ar_from_lsf(lsf), ar_from_lsf(ma_lsf)];
        let (lsf, error_db) =
            converter.convert(&filter).ok_or(AtRateError::Spectrum { index, rate_hz: rate.0 })?;
        errors_db.push(error_db);
        Ok::<_, AtRateError>(lsf)
    };
    let converted = match model.grain() {
        Grain::Measured { nodes, interpolation } => {
            let nodes = nodes
                .iter()
                .enumerate()
                .map(|(index, node)| Ok(GrainNode { lsf: convert(index, &node.lsf, &[])?, ..node.clone() }));
            let nodes: Vec<GrainNode> = nodes.collect::<Result<_, AtRateError>>()?;
            let model = TextureModel::new(rate, nodes, model.friction())?;
            if *interpolation == Interpolation::Barycentric {
                model
            } else {
                model.with_interpolation(*interpolation)?
            }
        }
        Grain::Published { nodes } => {
            let nodes = nodes.iter().enumerate().map(|(index, node)| {
                let ar_lsf = convert(index, &node.ar_lsf, &node.ma_lsf)?;
                // The gain compensates for the difference between the filters' power gains, so that the level is
                // unchanged.
                let own = arma::power_gain(&ar_from_lsf(&node.ar_lsf), &ar_from_lsf(&node.ma_lsf));
                let gain = node.gain * (own / ar::power_gain(&ar_from_lsf(&ar_lsf))).sqrt();
                Ok(PublishedNode { ar_lsf, ma_lsf: Vec::new(), gain, ..node.clone() })
            });
            let nodes: Vec<PublishedNode> = nodes.collect::<Result<_, AtRateError>>()?;
            TextureModel::published(rate, nodes, model.friction())?
        }
    };
    errors_db.sort_by(f64::total_cmp);
    let n = errors_db.len();
    Ok(AtRate {
        model: converted.with_tap(model.tap()).with_relief(model.relief().cloned()),
        error_db_median: 0.5 * (errors_db[(n - 1) / 2] + errors_db[n / 2]),
        error_db_worst: errors_db[n - 1],
    })
}

/// Conversion between two rates; shared by all nodes.
struct Converter {
    own: Hertz,
    rate: Hertz,
    /// Points of the new spectrum below the old Nyquist frequency.
    below: Vec<Hertz>,
    /// Progress of the transition at each point above the old Nyquist frequency, 0 to 1.
    fall: Vec<f64>,
    /// `cos(π m / 2N)` for `m` from 0 over a full period of `4N` values, where `N` is [`N_POINTS`].
    cosines: Vec<f64>,
    compared: Vec<Hertz>,
}

impl Converter {
    fn new(own: Hertz, rate: Hertz) -> Self {
        let nyquist = 0.5 * own.0;
        let point = |i: usize| (i as f64 + 0.5) * 0.5 * rate.0 / N_POINTS as f64;
        let (below, above): (Vec<f64>, Vec<f64>) = (0..N_POINTS).map(point).partition(|f| *f < nyquist);
        let fall = |f: f64| {
            let t = ((f - nyquist) / (FALL * nyquist)).min(1.0);
            0.5 - 0.5 * (PI * t).cos()
        };
        Self {
            own,
            rate,
            below: below.into_iter().map(Hertz).collect(),
            fall: above.into_iter().map(fall).collect(),
            cosines: (0..4 * N_POINTS).map(|m| (PI * m as f64 / (2 * N_POINTS) as f64).cos()).collect(),
            compared: (0..N_COMPARED)
                .map(|i| Hertz(COMPARED * nyquist * (i as f64 + 0.5) / N_COMPARED as f64))
                .collect(),
        }
    }

    /// Converts a filter (AR and moving-average part). Returns the line spectral frequencies at the new rate and the
    /// spectral error in dB; `None` if the predictor is unstable.
    fn convert(&self, filter: &[Vec<f64>; 2]) -> Option<(Vec<f64>, f64)> {
        let power = arma::power_gain(&filter[0], &filter[1]);
        let density = |f: &[Hertz]| -> Vec<f64> {
            let response = arma::response(&filter[0], &filter[1], self.own, f);
            response.into_iter().map(|(re, im)| (re * re + im * im) / power).collect()
        };
        let mut spectrum = density(&self.below);
        let edge = spectrum.last()?.max(FAINTEST);
        // A straight line in decibels with rounded ends.
        let floor = FLOOR * edge.min(1.0);
        spectrum.extend(self.fall.iter().map(|fallen| edge * (floor / edge).powf(*fallen)));
        for density in &mut spectrum {
            *density = density.max(FAINTEST);
        }
        // r_k = Σ S(f_i) cos(2π f_i k / rate), with angles in steps of π / 2N.
        let lag = |k: usize| {
            let angle = |i: usize| (2 * i + 1) * k % (4 * N_POINTS);
            spectrum.iter().enumerate().map(|(i, s)| s * self.cosines[angle(i)]).sum::<f64>()
        };
        let r: Vec<f64> = (0..=MAX_ORDER).map(lag).collect();
        let predictor = levinson(&r, MAX_ORDER).ar;
        let lsf = lsf_from_ar(&predictor)?;
        let wanted = density(&self.compared);
        // Both filters have unit power; at the new rate this power is spread over a wider band.
        let scale = self.rate.0 / self.own.0 * ar::power_gain(&predictor);
        let got = arma::response(&predictor, &[], self.rate, &self.compared);
        let error_db = |(wanted, (re, im)): (f64, (f64, f64))| {
            10.0 * (wanted.max(FAINTEST) * scale / (re * re + im * im)).log10()
        };
        let squares = wanted.into_iter().zip(got).map(error_db).map(|e| e * e).sum::<f64>();
        Some((lsf, (squares / N_COMPARED as f64).sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::{AtRateError, at_rate, highest_rate};
    use crate::texture::plane::Plane;
    use crate::texture::test_textures::{arma, two_resonances};
    use crate::texture::{Interpolation, MAX_ORDER, TextureModel};
    use crate::units::{Contact, Hertz};

    /// Checks the root mean square spectral difference up to 450 Hz at all contacts, in dB, and the level.
    fn check(model: &TextureModel, rate_hz: f64, bound_db: f64) {
        let converted = at_rate(model, Hertz(rate_hz)).unwrap();
        assert_eq!((converted.model.rate().0, converted.model.order()), (rate_hz, MAX_ORDER));
        assert_eq!(converted.model.interpolation(), model.interpolation());
        assert!(converted.error_db_worst < bound_db, "reported error {} dB", converted.error_db_worst);
        let (before, after) = (Plane::new(model), Plane::new(&converted.model));
        let f: Vec<Hertz> = (1..90).map(|i| Hertz(5.0 * f64::from(i))).collect();
        for contact in model.contacts() {
            let (a, b) = (before.at(contact), after.at(contact));
            let level_error = (a.level_mps2 - b.level_mps2).abs();
            assert!(level_error <= 1e-9 * a.level_mps2, "level {}, expected {}", b.level_mps2, a.level_mps2);
            if a.level_mps2 > 0.0 {
                let squares =
                    a.psd(&f).into_iter().zip(b.psd(&f)).map(|(a, b)| (10.0 * (a / b).log10()).powi(2));
                let error_db = (squares.sum::<f64>() / f.len() as f64).sqrt();
                assert!(error_db < bound_db, "{error_db} dB at {contact:?}");
            }
        }
    }

    #[test]
    fn spectrum_and_level_stay_at_twice_the_rate() {
        let model = two_resonances(&[0.05, 0.1, 0.2], &[0.5, 1.0]);
        check(&model, 2000.0, 0.3);
        check(&model, 1500.0, 0.3);
        check(&model.with_interpolation(Interpolation::RadialBasis).unwrap(), 2000.0, 0.3);
    }

    #[test]
    fn published_textures_keep_theirs_too() {
        check(&arma(18, 16), 2000.0, 3.0);
        // The variance still decreases towards the axes by the same rule.
        let converted = at_rate(&arma(18, 16), Hertz(2000.0)).unwrap().model;
        assert_eq!(converted.ma_order(), 0);
        assert_eq!(converted.published_nodes()[0].variance, 0.0);
        let level = |m: &TextureModel| Plane::new(m).at(Contact::from_mm_per_s_and_n(10.0, 0.5)).level_mps2;
        let ratio = level(&converted) / level(&arma(18, 16));
        assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
    }

    #[test]
    fn its_own_rate_changes_nothing_and_a_lower_one_is_refused() {
        let model = arma(4, 2);
        assert_eq!(at_rate(&model, Hertz(1000.0)).unwrap().model, model);
        for rate_hz in [500.0, f64::NAN] {
            assert!(matches!(at_rate(&model, Hertz(rate_hz)), Err(AtRateError::Lower { .. })));
        }
        assert!(matches!(at_rate(&model, Hertz(8000.0)), Err(AtRateError::Model(_))));
    }

    #[test]
    fn the_highest_rate_is_found() {
        let (slow, fast) = (arma(4, 2), at_rate(&arma(4, 2), Hertz(2000.0)).unwrap().model);
        assert_eq!(highest_rate([&slow, &fast, &slow]), Some(Hertz(2000.0)));
        assert_eq!(highest_rate([]), None);
    }
}
