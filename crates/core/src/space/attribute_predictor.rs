//! Prediction of a texture's attributes from its model: a few physical features and one Gaussian process per attribute.
//!
//! Ratings of a few dozen textures are a small training set, so the features are few. They are the level, its exponents
//! over speed and force, the relative power in six frequency bands, the friction coefficient, and the frequency and
//! decay rate of the tap transient. Features that some of the textures lack are left out. Training takes milliseconds,
//! and every prediction has a standard deviation.

use crate::maths::gaussian_process::{Estimate, GaussianProcess, GaussianProcessError};
use crate::maths::least_squares::{LeastSquaresError, least_squares};
use crate::maths::statistics::{mean, standard_deviation};
use crate::space::features::{Physical, physical};
use crate::texture::TextureModel;
use crate::texture::patterns::paper_patterns;
use crate::texture::plane::Plane;
use crate::units::{Contact, Hertz};

/// Edges of the spectral bands, in Hz.
const BANDS_HZ: [f64; 7] = [10.0, 30.0, 60.0, 120.0, 200.0, 320.0, 500.0];
const N_BANDS: usize = BANDS_HZ.len() - 1;
/// Frequency step within the bands, in Hz.
const STEP_HZ: f64 = 2.0;
/// Lower limit of the fraction of the power in a band. Smaller fractions are raised to it, because they are only filter
/// residue.
const LEAST_SHARE: f64 = 1e-6;

/// Number of features of a texture.
pub const N_QUANTITIES: usize = N_BANDS + 6;

/// Maximum number of textures for which leave-one-out prediction retrains everything without each texture.
const MOST_LEARNED_ANEW: usize = 60;

/// Features of a texture; an entry is `None` if the texture lacks that feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantities([Option<f64>; N_QUANTITIES]);

/// A texture with known attributes, used for training.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Features of the texture.
    pub quantities: Quantities,
    /// Attributes of the texture, each 0..100.
    pub attributes: Vec<f64>,
}

/// Reasons why attributes cannot be predicted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AttributeError {
    /// The textures have different numbers of attributes.
    #[error("texture {index} has {n} attributes, but the first texture has {expected}")]
    Attributes {
        /// Index of the texture.
        index: usize,
        /// Number of attributes of this texture.
        n: usize,
        /// Number of attributes of the first texture.
        expected: usize,
    },
    /// No feature is available for all textures.
    #[error("no feature is available for all {n} textures; check whether some of them are silent")]
    NothingShared {
        /// Number of textures.
        n: usize,
    },
    /// The Gaussian process cannot be trained.
    #[error(transparent)]
    Learning(#[from] GaussianProcessError),
}

/// Features of a texture at the 25 stroke patterns of the authoring paper ([`paper_patterns`]).
pub fn quantities(model: &TextureModel) -> Quantities {
    let contacts = paper_patterns();
    let Physical {
        level_db,
        speed_exponent,
        force_exponent,
        friction,
        tap_frequency_hz,
        tap_decay_per_sec,
        ..
    } = physical(model, &contacts);
    let logarithm = |x: Option<f64>| x.filter(|x| *x > 0.0).map(f64::ln);
    let of_contact = [
        level_db,
        speed_exponent,
        force_exponent,
        logarithm(friction),
        logarithm(tap_frequency_hz),
        logarithm(tap_decay_per_sec),
    ];
    let bands = band_shares_db(&Plane::new(model), &contacts);
    let mut all = [None; N_QUANTITIES];
    for (into, from) in all.iter_mut().zip(of_contact.into_iter().chain(bands)) {
        *into = from.filter(|x| x.is_finite());
    }
    Quantities(all)
}

/// Power in each band relative to the total over all bands, in dB, averaged over the contacts where the texture is not
/// silent. `None` for a band that reaches above half the sample rate of the model.
fn band_shares_db(plane: &Plane, contacts: &[Contact]) -> [Option<f64>; N_BANDS] {
    let (mut sums, mut n) = ([0.0; N_BANDS], 0.0);
    for grain in contacts.iter().map(|contact| plane.at(*contact)).filter(|grain| grain.level_mps2 > 0.0) {
        let power = |band: usize| {
            let n_steps = ((BANDS_HZ[band + 1] - BANDS_HZ[band]) / STEP_HZ) as usize;
            let frequency = |i: usize| Hertz(BANDS_HZ[band] + (i as f64 + 0.5) * STEP_HZ);
            let frequencies: Vec<Hertz> =
                (0..n_steps).map(frequency).filter(|f| f.0 < 0.5 * grain.rate.0).collect();
            grain.psd(&frequencies).iter().sum::<f64>()
        };
        let powers: [f64; N_BANDS] = std::array::from_fn(power);
        let total: f64 = powers.iter().sum();
        for (sum, power) in sums.iter_mut().zip(powers) {
            *sum += 10.0 * (power / total).max(LEAST_SHARE).log10();
        }
        n += 1.0;
    }
    let highest = 0.5 * plane.rate().0;
    std::array::from_fn(|band| (n > 0.0 && BANDS_HZ[band + 1] <= highest).then(|| sums[band] / n))
}

/// Mean and standard deviation of each attribute over the training textures: the estimate for a texture about which
/// nothing is known. A prediction with at least this standard deviation says nothing about its texture.
pub fn without_features(known: &[Known]) -> Vec<Estimate> {
    let n_attributes = known.first().map_or(0, |texture| texture.attributes.len());
    let of = |attribute: usize| {
        let values: Vec<f64> =
            known.iter().filter_map(|texture| texture.attributes.get(attribute)).copied().collect();
        Estimate { mean: mean(&values), deviation: standard_deviation(&values) }
    };
    (0..n_attributes).map(of).collect()
}

/// Attributes of a texture, predicted from textures with known attributes, in their order and clamped to 0..100.
///
/// # Errors
/// See [`AttributeError`].
pub fn predict(known: &[Known], texture: &Quantities) -> Result<Vec<Estimate>, AttributeError> {
    let references: Vec<&Known> = known.iter().collect();
    predict_by(&references, texture)
}

/// Leave-one-out predictions: all attributes of each texture, predicted from the other textures.
///
/// For each texture, everything including the kernel is trained again on the other textures. With more than 60
/// textures, the kernels are trained once on all textures, because one texture hardly changes them.
///
/// # Errors
/// See [`AttributeError`].
pub fn leave_one_out(known: &[Known]) -> Result<Vec<Vec<Estimate>>, AttributeError> {
    if known.len() > MOST_LEARNED_ANEW {
        let references: Vec<&Known> = known.iter().collect();
        let (rows, n_attributes) = (shared(&references, None)?, n_attributes(&references)?);
        let mut of_textures = vec![Vec::with_capacity(n_attributes); known.len()];
        for attribute in 0..n_attributes {
            let values: Vec<f64> = known.iter().map(|texture| texture.attributes[attribute]).collect();
            let estimates = GaussianProcess::learn(&rows, &values)?.leave_one_out();
            for (of_texture, estimate) in of_textures.iter_mut().zip(estimates) {
                of_texture.push(within(estimate));
            }
        }
        return Ok(of_textures);
    }
    let without = |index: usize| {
        let others: Vec<&Known> =
            known.iter().enumerate().filter(|(i, _)| *i != index).map(|(_, k)| k).collect();
        predict_by(&others, &known[index].quantities)
    };
    (0..known.len()).map(without).collect()
}

/// Leave-one-out predictions by ordinary linear regression on the features, as a baseline. Linearly dependent features
/// are dropped.
///
/// # Errors
/// See [`AttributeError`].
pub fn linear_leave_one_out(known: &[Known]) -> Result<Vec<Vec<f64>>, AttributeError> {
    let references: Vec<&Known> = known.iter().collect();
    let (rows, n_attributes) = (shared(&references, None)?, n_attributes(&references)?);
    let without = |index: usize| -> Vec<f64> {
        let others: Vec<usize> = (0..rows.len()).filter(|i| *i != index).collect();
        let mut used = vec![None];
        used.extend((0..rows[0].len()).map(Some));
        // The first column is the constant 1, the others are the features.
        let value = |row: usize, column: Option<usize>| column.map_or(1.0, |column| rows[row][column]);
        let target = |attribute: usize| -> Vec<f64> {
            others.iter().map(|i| known[*i].attributes[attribute]).collect()
        };
        loop {
            // With more columns than textures, the regression would fit noise exactly.
            used.truncate(others.len());
            let columns: Vec<Vec<f64>> =
                used.iter().map(|column| others.iter().map(|i| value(*i, *column)).collect()).collect();
            let fits: Result<Vec<_>, _> = (0..n_attributes)
                .map(|attribute| least_squares(&columns, &target(attribute)).map(|fit| fit.coefficients))
                .collect();
            match fits {
                Ok(fits) => {
                    let predicted = |coefficients: &Vec<f64>| {
                        let parts = coefficients.iter().zip(&used);
                        let sum: f64 =
                            parts.map(|(coefficient, column)| coefficient * value(index, *column)).sum();
                        sum.clamp(0.0, 100.0)
                    };
                    return fits.iter().map(predicted).collect();
                }
                Err(LeastSquaresError::Dependent { column }) => drop(used.remove(column)),
            }
        }
    };
    Ok((0..known.len()).map(without).collect())
}

fn predict_by(known: &[&Known], texture: &Quantities) -> Result<Vec<Estimate>, AttributeError> {
    let mut rows = shared(known, Some(texture))?;
    let Some(row) = rows.pop() else { unreachable!("the texture has a row") };
    let of_attribute = |attribute: usize| {
        let values: Vec<f64> = known.iter().map(|texture| texture.attributes[attribute]).collect();
        Ok(within(GaussianProcess::learn(&rows, &values)?.at(&row)))
    };
    (0..n_attributes(known)?).map(of_attribute).collect()
}

/// Features that all textures have, including `more`: one row per texture.
fn shared(known: &[&Known], more: Option<&Quantities>) -> Result<Vec<Vec<f64>>, AttributeError> {
    let all = || known.iter().map(|texture| &texture.quantities).chain(more);
    let used: Vec<usize> = (0..N_QUANTITIES).filter(|i| all().all(|of| of.0[*i].is_some())).collect();
    if used.is_empty() {
        return Err(AttributeError::NothingShared { n: all().count() });
    }
    Ok(all().map(|of| used.iter().filter_map(|i| of.0[*i]).collect()).collect())
}

fn n_attributes(known: &[&Known]) -> Result<usize, AttributeError> {
    let expected = known.first().map_or(0, |texture| texture.attributes.len());
    match known.iter().position(|texture| texture.attributes.len() != expected) {
        Some(index) => Err(AttributeError::Attributes { index, n: known[index].attributes.len(), expected }),
        None => Ok(expected),
    }
}

/// Clamps the mean to 0..100.
fn within(estimate: Estimate) -> Estimate {
    Estimate { mean: estimate.mean.clamp(0.0, 100.0), ..estimate }
}

#[cfg(test)]
mod tests {
    use super::{
        AttributeError, Known, leave_one_out, linear_leave_one_out, predict, quantities, without_features,
    };
    use crate::maths::rng::Random;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Hertz, MetersPerSecond, Newtons};

    /// A texture with one resonance whose level grows with speed and force.
    fn model(level_mps2: f64, resonance: f64, friction: Option<f64>) -> TextureModel {
        let node = |speed: f64, force: f64| GrainNode {
            speed: MetersPerSecond(speed),
            force: Newtons(force),
            lsf: vec![resonance, resonance + 0.15, 1.9, 2.6],
            level_mps2: level_mps2 * (speed / 0.1) * (force / 0.3).sqrt(),
        };
        let nodes = vec![node(0.05, 0.1), node(0.25, 0.1), node(0.05, 0.5), node(0.25, 0.5)];
        TextureModel::new(Hertz(1000.0), nodes, friction).unwrap()
    }

    /// Textures whose roughness determines their level and whose hardness determines their resonance.
    fn known(n: usize, friction: bool) -> Vec<Known> {
        let mut random = Random::new(4);
        let of = |_| {
            let (rough, hard) = (random.uniform(), random.uniform());
            let model =
                model(10.0_f64.powf(1.5 * rough - 1.0), 0.3 + hard, friction.then_some(0.3 + 0.2 * rough));
            let attributes = vec![90.0 - 80.0 * rough, 90.0 - 80.0 * hard];
            Known { quantities: quantities(&model), attributes }
        };
        (0..n).map(of).collect()
    }

    #[test]
    fn attributes_that_follow_from_the_vibration_are_found() {
        let known = known(25, true);
        let mean_error = |attribute: usize| {
            let estimates = leave_one_out(&known).unwrap();
            let errors = known
                .iter()
                .zip(&estimates)
                .map(|(k, e)| (k.attributes[attribute] - e[attribute].mean).abs());
            errors.sum::<f64>() / 25.0
        };
        assert!(mean_error(0) < 2.0 && mean_error(1) < 5.0, "{} {}", mean_error(0), mean_error(1));
    }

    #[test]
    fn a_line_is_found_and_quantities_that_follow_from_others_do_no_harm() {
        let mut known = known(20, true);
        for texture in &mut known {
            // The level in dB is linear in the roughness, so twice the level adds no information.
            texture.quantities.0[4] = texture.quantities.0[0].map(|x| 2.0 * x + 1.0);
        }
        let predicted = linear_leave_one_out(&known).unwrap();
        for (known, predicted) in known.iter().zip(&predicted) {
            assert!((known.attributes[0] - predicted[0]).abs() < 1.0, "{predicted:?}");
        }
    }

    #[test]
    fn what_one_texture_lacks_is_left_out_for_all() {
        let known = known(12, true);
        let texture = model(0.5, 0.8, None);
        let estimates = predict(&known, &quantities(&texture)).unwrap();
        let without: Vec<Known> = {
            let strip = |known: &Known| {
                let mut quantities = known.quantities;
                quantities.0[3] = None;
                Known { quantities, ..known.clone() }
            };
            known.iter().map(strip).collect()
        };
        assert_eq!(estimates, predict(&without, &quantities(&texture)).unwrap());
        let silent = model(0.0, 0.8, None);
        assert_eq!(predict(&known, &quantities(&silent)), Err(AttributeError::NothingShared { n: 13 }));
    }

    #[test]
    fn many_textures_are_judged_almost_as_few_are() {
        let many = known(64, false);
        let quick = leave_one_out(&many).unwrap();
        let others: Vec<Known> = many[1..].to_vec();
        let anew = predict(&others, &many[0].quantities).unwrap();
        for (quick, anew) in quick[0].iter().zip(&anew) {
            assert!((quick.mean - anew.mean).abs() < 3.0, "{quick:?} {anew:?}");
        }
    }

    /// Values 0, 50 and 100: mean 50 and standard deviation 50.
    #[test]
    fn without_features_the_estimate_is_that_of_the_labels() {
        let mut known = known(3, false);
        for (texture, value) in known.iter_mut().zip([0.0, 50.0, 100.0]) {
            texture.attributes = vec![value, 20.0];
        }
        let labels = without_features(&known);
        assert_eq!(labels.len(), 2);
        let (first, second) = (labels[0], labels[1]);
        assert!((first.mean - 50.0).abs() < 1e-12 && (first.deviation - 50.0).abs() < 1e-12, "{first:?}");
        assert_eq!((second.mean, second.deviation), (20.0, 0.0));
        assert!(without_features(&[]).is_empty());
    }

    #[test]
    fn tables_that_do_not_fit_are_refused() {
        let mut textures = known(6, false);
        textures[2].attributes.pop();
        let error = predict(&textures, &textures[0].quantities).unwrap_err();
        assert_eq!(error, AttributeError::Attributes { index: 2, n: 1, expected: 2 });
    }
}
