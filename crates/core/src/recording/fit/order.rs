//! Choice of the predictor order by held-out segments.
//!
//! A predictor of too low an order smears sharp resonances. One of too high an order is fitted to the chance of the
//! strokes, and predicts other strokes worse. So predictors of all orders, fitted to the other segments, predict the
//! spectrum of each held-out segment. The likelihood counts all frequencies alike: a few resonances below 100 Hz with most
//! of the power change it little. Among orders of about the same likelihood, the goodness of fit of the spectra therefore
//! decides.
//!
//! Frequencies that the resampling to the model rate attenuates do not count. A predictor needs many coefficients to follow
//! this slope, and they would blur the texture.

use std::ops::Range;

use crate::dsp::ar::step_down;
use crate::dsp::filter::DECIMATION_PASS_SHARE;
use crate::dsp::spectrum::goodness_of_fit;
use crate::recording::fit::FitError;
use crate::recording::fit::heldout::compared_bins;
use crate::recording::fit::pieces::Piece;
use crate::recording::fit::smear::{self, Leakage};
use crate::recording::fit::split::Split;
use crate::recording::fit::surface::Surface;
use crate::texture::MAX_ORDER;
use crate::units::Hertz;

/// Orders to choose among. Fewer poles than the lowest do not represent a real spectrum.
pub(super) const ORDERS: [usize; 10] = [10, 14, 20, 24, 28, 32, 40, 48, 56, MAX_ORDER];

/// Largest increase of the power of the prediction error, relative to that of the order with the highest likelihood, at
/// which the likelihood counts as the same. Half of its logarithm, 0.005, is the difference in log likelihood per sample of
/// a signal with this band.
const LIKELIHOOD_TOLERANCE: f64 = 0.01;

/// Largest loss of goodness of fit that is accepted for a lower order.
const FIT_TOLERANCE: f64 = 0.01;

/// Maximum number of held-out segments that are predicted, spread evenly over all.
const MAX_PREDICTED: usize = 40;

/// Held-out part, and a predictor of the highest order that was not fitted to it.
struct Predicted<'a> {
    part: &'a Piece,
    predictor: Vec<f64>,
}

/// How well predictors of one order predict all parts.
#[derive(Clone, Copy, Debug, Default)]
struct Judged {
    /// Negative log likelihood of the spectra (P. Whittle 1953), without a constant.
    loss: f64,
    /// Sum of the goodness of fit of the spectra, each multiplied by the duration of the part in s.
    fit: f64,
}

/// Returns the lowest of [`ORDERS`] that describes held-out segments about as well as the best one. At least one part
/// must be left out of a fold.
pub(super) fn held_out_order(split: &Split<'_>) -> Result<usize, FitError> {
    let predicted = predicted(split)?;
    let judged = judged(&predicted, split.rate);
    let least = judged.iter().map(|order| order.loss).fold(f64::INFINITY, f64::min);
    let n_samples: f64 = predicted.iter().map(|one| one.n_counted(split.rate)).sum();
    let secs: f64 = predicted.iter().map(|one| one.part.seconds).sum();
    let limit = least + 0.5 * n_samples * LIKELIHOOD_TOLERANCE.ln_1p();
    let close = || ORDERS.into_iter().zip(judged).filter(|(_, judged)| judged.loss <= limit);
    let best = close().map(|(_, judged)| judged.fit).fold(0.0, f64::max);
    let chosen = close().find(|(_, judged)| judged.fit >= best - FIT_TOLERANCE * secs);
    Ok(chosen.map_or(ORDERS[0], |(order, _)| order))
}

/// Predictors for held-out parts, at their speeds and forces, fitted to the other folds.
fn predicted<'a>(split: &'a Split<'_>) -> Result<Vec<Predicted<'a>>, FitError> {
    let step = split.parts.len().div_ceil(MAX_PREDICTED);
    let mut predicted = Vec::new();
    for fold in 0..split.n_folds() {
        let seen = split.seen(fold);
        let mut asked = split.asked(fold).filter(|index| index.is_multiple_of(step)).peekable();
        if seen.is_empty() || asked.peek().is_none() {
            continue;
        }
        let surface = Surface::new(seen);
        for index in asked {
            let part = &split.parts[index];
            let predictor = surface.predictor_at(part.speed_mps, part.force_n, MAX_ORDER)?.ar;
            predicted.push(Predicted { part, predictor });
        }
    }
    Ok(predicted)
}

/// Predictor of a lower order. Burg's method gives stable predictors, which all have one.
fn lowered(predictor: &[f64], order: usize) -> Vec<f64> {
    let mut lowered = predictor.to_vec();
    while lowered.len() > order && step_down(&mut lowered).is_some() {}
    lowered
}

impl Predicted<'_> {
    /// Number of samples of a signal that has only the band that counts.
    fn n_counted(&self, rate: Hertz) -> f64 {
        let (n_bins, _) = compared_bins(rate);
        2.0 * counted_bins(rate).len() as f64 / n_bins as f64 * self.part.signal.len() as f64
    }
}

/// Bins of a spectrum that count in the likelihood: those that are compared and that resampling does not attenuate.
fn counted_bins(rate: Hertz) -> Range<usize> {
    let (n_bins, bins) = compared_bins(rate);
    let passed = (DECIMATION_PASS_SHARE * 0.5 * n_bins as f64).floor() as usize + 1;
    bins.start..bins.end.min(passed)
}

/// Judges each of [`ORDERS`] by all parts.
fn judged(predicted: &[Predicted<'_>], rate: Hertz) -> [Judged; ORDERS.len()] {
    let ((n_bins, bins), counted) = (compared_bins(rate), counted_bins(rate));
    let mut judged = [Judged::default(); ORDERS.len()];
    for one in predicted {
        let measured = smear::measured(&one.part.signal, rate, n_bins);
        let leakage = Leakage::new(one.part.signal.len(), n_bins);
        for (sum, order) in judged.iter_mut().zip(ORDERS) {
            let model = leakage.expected(&smear::predictor_density(&lowered(&one.predictor, order)));
            let loss = mean_loss(&measured[counted.clone()], &model[counted.clone()]);
            sum.loss += 0.5 * one.n_counted(rate) * loss;
            sum.fit += one.part.seconds * goodness_of_fit(&measured[bins.clone()], &model[bins.clone()]);
        }
    }
    judged
}

/// Mean over the bins of `ln S + P / S`, for a measured spectrum `P` and a model `S`, without a constant. The scale of the
/// model is the most likely one, because the level of a texture does not depend on the order.
fn mean_loss(measured: &[f64], model: &[f64]) -> f64 {
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        measured.iter().zip(model).map(|(p, s)| of(*p, *s)).sum::<f64>() / measured.len() as f64
    };
    mean(&|_, s| s.ln()) + mean(&|p, s| p / s).ln()
}

#[cfg(test)]
mod tests {
    use super::{ORDERS, counted_bins, held_out_order, judged, lowered, mean_loss, predicted};
    use crate::dsp::ar::burg;
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::filter::resample;
    use crate::dsp::spectrum::rms;
    use crate::maths::rng::lcg_noise;
    use crate::recording::fit::pieces::Piece;
    use crate::recording::fit::split::Split;
    use crate::texture::MAX_ORDER;
    use crate::units::Hertz;

    /// Noise with these resonances, in Hz with their radii, after `skipped` samples.
    fn resonant(rate: Hertz, resonances: &[(f64, f64)], n: usize, skipped: usize, seed: u64) -> Vec<f64> {
        let resonances: Vec<(Hertz, f64)> = resonances.iter().map(|(hz, r)| (Hertz(*hz), *r)).collect();
        let ar = from_resonances(rate, &resonances);
        let mut x = lcg_noise(skipped + n, seed);
        for i in 0..x.len() {
            x[i] -= (1..=ar.len().min(i)).map(|k| ar[k - 1] * x[i - k]).sum::<f64>();
        }
        x.split_off(skipped)
    }

    /// Segments of half a second, of constant speed and force.
    fn segments(signal: &[f64], rate: Hertz) -> Vec<Piece> {
        let n = (0.5 * rate.0) as usize;
        let piece = |(index, signal): (usize, &[f64])| Piece {
            recording: 0,
            start_secs: 0.5 * index as f64,
            seconds: 0.5,
            speed_mps: 0.1,
            force_n: 1.0,
            mean_square: signal.iter().map(|x| x * x).sum::<f64>() / n as f64,
            speeds_mps: vec![0.1; n],
            signal: signal.to_vec(),
        };
        signal.chunks_exact(n).enumerate().map(piece).collect()
    }

    #[test]
    fn lower_orders_are_those_that_are_fitted_directly() {
        let x = lcg_noise(400, 2);
        let highest = burg(&x, MAX_ORDER).unwrap().ar;
        for order in ORDERS {
            let direct = burg(&x, order).unwrap().ar;
            for (found, expected) in lowered(&highest, order).iter().zip(&direct) {
                assert!((found - expected).abs() < 1e-9, "order {order}: {found}, expected {expected}");
            }
        }
    }

    #[test]
    fn the_loss_is_least_for_the_measured_spectrum_at_any_scale() {
        let measured = [2.0, 0.5, 4.0];
        let least = measured.iter().map(|p: &f64| p.ln()).sum::<f64>() / 3.0;
        for scale in [1.0, 1e-3, 50.0] {
            assert!((mean_loss(&measured, &measured.map(|p| scale * p)) - least).abs() < 1e-12);
        }
        // Mean of P / S is 2.1666; ln S is zero.
        assert!((mean_loss(&measured, &[1.0; 3]) - (6.5_f64 / 3.0).ln()).abs() < 1e-12);
        for bin in 0..3 {
            let mut other = measured;
            other[bin] *= 1.1;
            assert!(mean_loss(&measured, &other) > least + 1e-4);
        }
    }

    /// The slope of a decimation filter is no texture: resampled strokes have the order of those that were not.
    #[test]
    fn what_resampling_attenuates_does_not_raise_the_order() {
        let (rate, few) = (Hertz(8000.0), [(90.0, 0.996), (230.0, 0.994)]);
        let signal = resample(&resonant(rate, &few, 96_000, 8000, 4), rate, Hertz(1000.0));
        let pieces = segments(&signal, Hertz(1000.0));
        let order = held_out_order(&Split::new(&pieces, Hertz(1000.0))).unwrap();
        assert!(order <= 24, "{order}");
        let counted = counted_bins(Hertz(1000.0));
        // From 10 Hz to nine tenths of 500 Hz or less, in steps of 1000/256 Hz.
        assert!(counted.start == 3 && counted.end <= 128, "{counted:?}");
    }

    #[test]
    fn few_resonances_need_a_low_order_and_many_a_high_one() {
        let rate = Hertz(1000.0);
        let few = [(90.0, 0.97), (230.0, 0.95)];
        let many: Vec<(f64, f64)> = (1..=17).map(|i| (26.0 * f64::from(i), 0.985)).collect();
        for n in [4, 12] {
            let order = |resonances: &[(f64, f64)]| {
                let pieces = segments(&resonant(rate, resonances, 500 * n, 1000, 4), rate);
                held_out_order(&Split::new(&pieces, rate)).unwrap()
            };
            assert!(order(&few) <= 20, "{} for {n} segments", order(&few));
            // 17 resonances are 34 poles. The errors of 32 poles have half as much power again.
            assert_eq!(order(&many), 40, "{n} segments");
        }
    }

    /// Nearly all of the power lies in three sharp resonances below 60 Hz, a twentieth of the band.
    #[test]
    fn strong_low_resonances_count_although_the_likelihood_hardly_changes() {
        let rate = Hertz(2000.0);
        let parts: [(&[(f64, f64)], f64); 4] = [
            (&[(17.0, 0.9937)], 1.0),
            (&[(35.0, 0.9937)], 0.5),
            (&[(52.0, 0.992)], 0.3),
            (&[(60.0, 0.972), (180.0, 0.946)], 0.2),
        ];
        let mut sum = vec![0.0; 6000];
        for ((resonances, level), seed) in parts.into_iter().zip(5..) {
            let x = resonant(rate, resonances, sum.len(), 2000, seed);
            let scale = level / rms(&x);
            sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += scale * x);
        }
        let pieces = segments(&sum, rate);
        let split = Split::new(&pieces, rate);
        let predicted = predicted(&split).unwrap();
        let judged = judged(&predicted, rate);
        let of = |order: usize| judged[ORDERS.iter().position(|other| *other == order).unwrap()];
        let n_samples: f64 = predicted.iter().map(|one| one.n_counted(rate)).sum();
        let secs: f64 = predicted.iter().map(|one| one.part.seconds).sum();
        // The likelihood hardly changes. A reference computation gives a goodness of fit of 0.79 and 0.89.
        assert!((of(20).loss - of(40).loss) / n_samples < 0.01);
        assert!(of(40).fit > of(20).fit + 0.05 * secs, "{judged:?}");
        let order = held_out_order(&split).unwrap();
        assert!((32..=56).contains(&order), "{order}");
    }
}
