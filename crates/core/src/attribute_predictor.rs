//! Attributes of a texture from its model: a few quantities of the vibration, of friction and of a tap, and a Gaussian
//! process each.
//!
//! Where people rated a few dozen textures there is little to learn from, and little is what this takes: the level, how it
//! grows with speed and force, the shape of the spectrum in six bands, friction, and how a landing rings. What not all of
//! the textures have is left out. It learns in milliseconds and says how unsure it is.

use crate::features::{Physical, physical};
use crate::gaussian_process::{Estimate, GaussianProcess, GaussianProcessError};
use crate::least_squares::{LeastSquaresError, least_squares};
use crate::patterns::paper_patterns;
use crate::plane::Plane;
use crate::texture::TextureModel;
use crate::units::{Contact, Hertz};

/// Edges in Hz of the bands of the spectrum.
const BANDS_HZ: [f64; 7] = [10.0, 30.0, 60.0, 120.0, 200.0, 320.0, 500.0];
const N_BANDS: usize = BANDS_HZ.len() - 1;
/// Steps of frequency within the bands, in Hz.
const STEP_HZ: f64 = 2.0;
/// Share of the power below which a band counts as this: what lies lower is what a filter leaves of nothing.
const LEAST_SHARE: f64 = 1e-6;

/// Quantities of a texture.
pub const N_QUANTITIES: usize = N_BANDS + 6;

/// Textures up to which each is left out and everything is learned anew without it.
const MOST_LEARNED_ANEW: usize = 60;

/// What a texture is known by; `None` where it has no such quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantities([Option<f64>; N_QUANTITIES]);

/// A texture whose attributes are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// What it is known by.
    pub quantities: Quantities,
    /// Its attributes, each 0..100.
    pub attributes: Vec<f64>,
}

/// Why attributes cannot be told.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AttributeError {
    /// Textures have different numbers of attributes.
    #[error("texture {index} has {n} attributes, {expected} are expected")]
    Attributes {
        /// Index of the texture.
        index: usize,
        /// How many it has.
        n: usize,
        /// How many the first has.
        expected: usize,
    },
    /// There is no quantity that all textures have.
    #[error("there is no quantity of touch that all {n} textures have: are some of them silent?")]
    NothingShared {
        /// How many textures.
        n: usize,
    },
    /// Nothing can be learned.
    #[error(transparent)]
    Learning(#[from] GaussianProcessError),
}

/// The quantities of a texture, stroked at the 25 patterns of the authoring paper.
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

/// Share of each band in the power within the bands, in dB, mean over those patterns where the texture sounds; `None` for
/// a band that the model says nothing of.
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

/// The attributes of a texture by those of known ones, in their order, kept within 0..100.
///
/// # Errors
/// See [`AttributeError`].
pub fn predict(known: &[Known], texture: &Quantities) -> Result<Vec<Estimate>, AttributeError> {
    let references: Vec<&Known> = known.iter().collect();
    predict_by(&references, texture)
}

/// What each of the textures would be taken for by the others, attribute by attribute.
///
/// Each is left out and everything, its kernel too, is learned from the others; among more than 60 textures kernels are
/// those of all, which one more or less hardly moves.
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

/// The same by a straight line through the quantities, by least squares: what there is to be better than. A quantity that
/// follows from others is left out.
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
        // A column of ones, and the quantities.
        let value = |row: usize, column: Option<usize>| column.map_or(1.0, |column| rows[row][column]);
        let target = |attribute: usize| -> Vec<f64> {
            others.iter().map(|i| known[*i].attributes[attribute]).collect()
        };
        loop {
            // As many columns as textures follow every noise.
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

/// Quantities that all textures have, and the one more: a row each.
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

/// An attribute lies within 0..100.
fn within(estimate: Estimate) -> Estimate {
    Estimate { mean: estimate.mean.clamp(0.0, 100.0), ..estimate }
}

#[cfg(test)]
mod tests {
    use super::{AttributeError, Known, leave_one_out, linear_leave_one_out, predict, quantities};
    use crate::rng::Random;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Hertz, MetersPerSecond, Newtons};

    /// A texture of one resonance, that grows with speed and force.
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

    /// Textures whose roughness is their level and whose hardness is their resonance.
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
            // The level in dB is linear in the roughness; its double says nothing new.
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

    #[test]
    fn tables_that_do_not_fit_are_refused() {
        let mut textures = known(6, false);
        textures[2].attributes.pop();
        let error = predict(&textures, &textures[0].quantities).unwrap_err();
        assert_eq!(error, AttributeError::Attributes { index: 2, n: 1, expected: 2 });
    }
}
