//! A texture model at a higher rate than its own, so that textures of different rates can be mixed.
//!
//! The spectrum up to the old Nyquist frequency is kept, the band above it falls steeply, and the autocorrelation of
//! that (Wiener and Khinchin: its Fourier transform) gives the predictor by Levinson's recursion.

use std::f64::consts::PI;

use crate::ar::{self, levinson};
use crate::arma;
use crate::lsf::{ar_from_lsf, lsf_from_ar};
use crate::texture::{
    Grain, GrainNode, Interpolation, MAX_ORDER, PublishedNode, TextureModel, TextureModelError,
};
use crate::units::Hertz;

/// Points of a spectrum between zero and half the new rate.
const N_POINTS: usize = 2048;
/// Width of the fall above the old Nyquist frequency, as a share of it, and the density below it, as a share of that at
/// the old Nyquist frequency or of the mean, whichever is less. Steeper or deeper, the predictor spends its order on
/// the fall; gentler, the band above is heard. Over the starter library from 1 to 2 kHz these two leave the least error.
const FALL: f64 = 0.4;
const FLOOR: f64 = 1e-4;
/// Lowest density, as a share of the mean: deeper holes make equations that cannot be solved.
const FAINTEST: f64 = 1e-8;
/// Share of the old Nyquist frequency up to which spectra are compared.
const COMPARED: f64 = 0.9;
/// Frequencies at which they are compared.
const N_COMPARED: usize = 200;

/// A model at a higher rate.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRate {
    /// The model: the same nodes with the same levels.
    pub model: TextureModel,
    /// Median over the nodes of the root mean square difference of spectra up to 0.9 of the old Nyquist frequency, in dB.
    pub error_db_median: f64,
    /// The same of the worst node.
    pub error_db_worst: f64,
}

/// Why a model has no such rate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AtRateError {
    /// The rate is below the model's own.
    #[error(
        "a model of {own_hz} Hz cannot be had at {rate_hz} Hz: what lies above half of that would be lost"
    )]
    Lower {
        /// The model's own.
        own_hz: f64,
        /// The one asked for.
        rate_hz: f64,
    },
    /// A node has no predictor at the new rate.
    #[error("the spectrum of node {index} cannot be had at {rate_hz} Hz; its peaks are too sharp")]
    Spectrum {
        /// Index of the node.
        index: usize,
        /// The one asked for.
        rate_hz: f64,
    },
    /// The new numbers do not make a model.
    #[error("at another rate the numbers do not make a texture")]
    Model(#[from] TextureModelError),
}

/// The highest rate of models, which all of them can be had at; `None` without models.
pub fn highest_rate<'a, I: IntoIterator<Item = &'a TextureModel>>(models: I) -> Option<Hertz> {
    models.into_iter().map(TextureModel::rate).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// A model at `rate`, at least its own: predictors of order [`MAX_ORDER`] without a moving average, the same level at
/// every node. At its own rate it is the model itself.
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
                // The gain takes up the difference of the filters' powers, so that the level stays.
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

/// From one rate to another: what all nodes share.
struct Converter {
    own: Hertz,
    rate: Hertz,
    /// The points of the new spectrum that lie below the old Nyquist frequency.
    below: Vec<Hertz>,
    /// How far the density has fallen at each point above, 0 to 1.
    fall: Vec<f64>,
    /// `cos(π m / 2N)` for a whole turn of `4 N`.
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

    /// The frequencies of the filter (predictor and moving average) at the new rate, and the error of its spectrum in dB.
    fn convert(&self, filter: &[Vec<f64>; 2]) -> Option<(Vec<f64>, f64)> {
        let power = arma::power_gain(&filter[0], &filter[1]);
        let density = |f: &[Hertz]| -> Vec<f64> {
            let response = arma::response(&filter[0], &filter[1], self.own, f);
            response.into_iter().map(|(re, im)| (re * re + im * im) / power).collect()
        };
        let mut spectrum = density(&self.below);
        let edge = spectrum.last()?.max(FAINTEST);
        // A straight line in decibels but for its rounded ends.
        let floor = FLOOR * edge.min(1.0);
        spectrum.extend(self.fall.iter().map(|fallen| edge * (floor / edge).powf(*fallen)));
        for density in &mut spectrum {
            *density = density.max(FAINTEST);
        }
        // r_k = Σ S(f_i) cos(2π f_i k / rate), with the angle in steps of π / 2N.
        let lag = |k: usize| {
            let angle = |i: usize| (2 * i + 1) * k % (4 * N_POINTS);
            spectrum.iter().enumerate().map(|(i, s)| s * self.cosines[angle(i)]).sum::<f64>()
        };
        let r: Vec<f64> = (0..=MAX_ORDER).map(lag).collect();
        let predictor = levinson(&r, MAX_ORDER).ar;
        let lsf = lsf_from_ar(&predictor)?;
        let wanted = density(&self.compared);
        // Both of power one: a density of the new rate is spread over a wider band.
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
    use crate::plane::Plane;
    use crate::texture::test_textures::{arma, two_resonances};
    use crate::texture::{Interpolation, MAX_ORDER, TextureModel};
    use crate::units::{Contact, Hertz};

    /// Largest root mean square difference of spectra up to 450 Hz over contacts, in dB, with the level checked.
    fn check(model: &TextureModel, rate_hz: f64, bound_db: f64) {
        let converted = at_rate(model, Hertz(rate_hz)).unwrap();
        assert_eq!((converted.model.rate().0, converted.model.order()), (rate_hz, MAX_ORDER));
        assert_eq!(converted.model.interpolation(), model.interpolation());
        assert!(converted.error_db_worst < bound_db, "{} dB said", converted.error_db_worst);
        let (before, after) = (Plane::new(model), Plane::new(&converted.model));
        let f: Vec<Hertz> = (1..90).map(|i| Hertz(5.0 * f64::from(i))).collect();
        for contact in model.contacts() {
            let (a, b) = (before.at(contact), after.at(contact));
            let level_error = (a.level_mps2 - b.level_mps2).abs();
            assert!(level_error <= 1e-9 * a.level_mps2, "{} for {}", b.level_mps2, a.level_mps2);
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
        // The rule by which variance sinks towards the axes is as before.
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
