//! Conversion of a texture model to a higher rate, so that textures with different rates can be mixed.
//!
//! The spectrum up to the old Nyquist frequency is kept, and the density above it falls steeply. The Levinson-Durbin
//! recursion computes the predictor from the autocorrelation of this spectrum.

use crate::dsp::ar::{self, levinson};
use crate::dsp::arma;
use crate::dsp::lsf::{ar_from_lsf, lsf_from_ar};
use crate::texture::refit::{FAINTEST, LEAST_ORDER, SpectrumGrid, relative_density};
use crate::texture::{Grain, GrainNode, Interpolation, PublishedNode, TextureModel, TextureModelError};
use crate::units::Hertz;

/// Fraction of the old Nyquist frequency up to which spectra are compared.
const COMPARED: f64 = 0.9;
/// Number of frequencies at which spectra are compared.
const N_COMPARED: usize = 200;

/// Model converted to a higher rate.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRate {
    /// Converted model: the same nodes with the same levels, and the same layers.
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
/// The result has predictors of order 32, or of the model's own order if that is higher, without a moving average, and
/// the same level at every node. At its own rate the model is returned unchanged.
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
    let converter = Converter::new(own, rate, model.order().max(LEAST_ORDER));
    let mut errors_db = Vec::with_capacity(model.n_nodes());
    let mut convert = |index: usize, lsf: &[f64], ma_lsf: &[f64]| {
        let filter = [ar_from_lsf(lsf), ar_from_lsf(ma_lsf)];
        let (lsf, error_db) =
            converter.convert(&filter).ok_or(AtRateError::Spectrum { index, rate_hz: rate.0 })?;
        errors_db.push(error_db);
        Ok::<_, AtRateError>(lsf)
    };
    let along = match model.along() {
        Some(nodes) => Some(converted_nodes(nodes, &mut convert)?),
        None => None,
    };
    let converted = match model.grain() {
        Grain::Measured { nodes, interpolation } => {
            let nodes = converted_nodes(nodes, &mut convert)?;
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
        model: converted.with_along(along)?.with_layers_of(model),
        error_db_median: 0.5 * (errors_db[(n - 1) / 2] + errors_db[n / 2]),
        error_db_worst: errors_db[n - 1],
    })
}

/// Returns the line spectral frequencies at the new rate of a node, from its index, AR part and moving-average part.
type Convert<'a> = dyn FnMut(usize, &[f64], &[f64]) -> Result<Vec<f64>, AtRateError> + 'a;

/// Measured nodes with the line spectral frequencies that `convert` returns for a node's index, AR part and
/// moving-average part.
fn converted_nodes(nodes: &[GrainNode], convert: &mut Convert<'_>) -> Result<Vec<GrainNode>, AtRateError> {
    let mut converted = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        converted.push(GrainNode { lsf: convert(index, &node.lsf, &[])?, ..node.clone() });
    }
    Ok(converted)
}

/// Conversion between two rates; shared by all nodes.
struct Converter {
    own: Hertz,
    rate: Hertz,
    grid: SpectrumGrid,
    compared: Vec<Hertz>,
}

impl Converter {
    fn new(own: Hertz, rate: Hertz, order: usize) -> Self {
        let compared = COMPARED * 0.5 * own.0;
        Self {
            own,
            rate,
            grid: SpectrumGrid::new(own, rate, order),
            compared: (0..N_COMPARED)
                .map(|i| Hertz(compared * (i as f64 + 0.5) / N_COMPARED as f64))
                .collect(),
        }
    }

    /// Converts a filter (AR and moving-average part). Returns the line spectral frequencies at the new rate and the
    /// spectral error in dB; `None` if the predictor is unstable.
    fn convert(&self, filter: &[Vec<f64>; 2]) -> Option<(Vec<f64>, f64)> {
        let mut spectrum = self.grid.spectrum(filter);
        for density in &mut spectrum {
            *density = density.max(FAINTEST);
        }
        let predictor = levinson(&self.grid.lags(&spectrum), self.grid.order()).ar;
        let lsf = lsf_from_ar(&predictor)?;
        let wanted = relative_density(filter, self.own, &self.compared);
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
    use crate::texture::refit::LEAST_ORDER;
    use crate::texture::stick_slip::StickSlip;
    use crate::texture::tap::Tap;
    use crate::texture::test_textures::{arma, two_resonances};
    use crate::texture::{GrainNode, Interpolation, TextureModel};
    use crate::units::{Contact, Hertz, MetersPerSecond};

    /// Checks the root mean square spectral difference up to 450 Hz at all contacts, in dB, and the level.
    fn check(model: &TextureModel, rate_hz: f64, bound_db: f64) {
        let converted = at_rate(model, Hertz(rate_hz)).unwrap();
        assert_eq!((converted.model.rate().0, converted.model.order()), (rate_hz, LEAST_ORDER));
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

    /// The grain along the lay is converted like that across it, and everything that has no rate stays.
    #[test]
    fn all_layers_stay() {
        let model = two_resonances(&[0.05, 0.2], &[0.5, 1.0]);
        let quiet = |n: &GrainNode| GrainNode { level_mps2: 0.25 * n.level_mps2, ..n.clone() };
        let along: Vec<GrainNode> = model.nodes().iter().map(quiet).collect();
        let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 4.0 };
        let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
        let model = model
            .with_along(Some(along))
            .unwrap()
            .with_tap(Some(tap))
            .with_stick_slip(Some(stick_slip))
            .with_turn_rad(0.5);
        let fast = at_rate(&model, Hertz(2000.0)).unwrap().model;
        assert_eq!((fast.tap(), fast.stick_slip(), fast.turn_rad()), (Some(tap), Some(stick_slip), 0.5));
        check(&model.along_model().unwrap(), 2000.0, 0.3);
        let alone = at_rate(&model.along_model().unwrap(), Hertz(2000.0)).unwrap().model;
        assert_eq!(fast.along(), Some(alone.nodes()));
    }

    #[test]
    fn the_highest_rate_is_found() {
        let (slow, fast) = (arma(4, 2), at_rate(&arma(4, 2), Hertz(2000.0)).unwrap().model);
        assert_eq!(highest_rate([&slow, &fast, &slow]), Some(Hertz(2000.0)));
        assert_eq!(highest_rate([]), None);
    }
}
