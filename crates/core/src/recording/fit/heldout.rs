//! Cross-validation: comparison of segments with models fitted without them.

use std::ops::Range;

use crate::dsp::spectrum::goodness_of_fit;
use crate::maths::sums::add_times;
use crate::recording::fit::pieces::Piece;
use crate::recording::fit::smear::{self, Leakage};
use crate::recording::fit::split::Split;
use crate::recording::fit::surface::{Surface, distance};
use crate::recording::fit::{Comparison, FitError, HIGH_PASS};
use crate::texture::Interpolation;
use crate::texture::plane::{Grain, Plane};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Window length in seconds: 256 samples at 1 kHz.
const WINDOW_SECS: f64 = 0.256;

/// Duration of pooled signal for a comparison, in seconds. A spectral estimate from a quarter of a second agrees with
/// its own model to 0.7 only; one from this duration agrees to 0.98.
const POOL_SECS: f64 = 5.0;

/// Maximum distance of pooled segments, relative to the highest speed and force.
const POOL_DISTANCE: f64 = 0.2;

/// Result of the comparison.
pub(super) struct Compared {
    pub(super) frequencies: Vec<Hertz>,
    /// One for each segment.
    pub(super) comparisons: Vec<Comparison>,
}

/// Compares every segment with models that were fitted without it, or without one of its blocks each; with the model of
/// all segments if nothing is left out.
pub(super) fn compare(
    split: &Split<'_>,
    order: usize,
    interpolation: Interpolation,
) -> Result<Compared, FitError> {
    let mut grains: Vec<Option<Grain>> = vec![None; split.parts.len()];
    for fold in 0..split.n_folds() {
        let seen = split.seen(fold);
        let mut asked = split.asked(fold).peekable();
        if seen.is_empty() || asked.peek().is_none() {
            continue;
        }
        let plane = Plane::new(&Surface::new(seen).model(split.rate, order, interpolation)?);
        for index in asked {
            let Piece { speed_mps, force_n, .. } = split.parts[index];
            let contact = Contact { speed: MetersPerSecond(speed_mps), force: Newtons(force_n) };
            grains[index] = Some(plane.at(contact));
        }
    }
    let (frequencies, comparisons) = with_grains(&split.parts, split.rate, &grains);
    // Blocks of a segment have its speed and force, and so they are pooled with the same blocks.
    let comparisons = split.first.iter().map(|first| comparisons[*first].clone()).collect();
    Ok(Compared { frequencies, comparisons })
}

/// Compares every segment with the grain that was predicted for it; a segment without one is compared with silence.
/// Returns the frequencies of the spectra, and one comparison for each segment.
pub(super) fn with_grains(
    pieces: &[Piece],
    rate: Hertz,
    grains: &[Option<Grain>],
) -> (Vec<Hertz>, Vec<Comparison>) {
    let (n_bins, bins) = compared_bins(rate);
    let step_hz = rate.0 / n_bins as f64;
    let spectra: Vec<[Vec<f64>; 2]> = pieces
        .iter()
        .zip(grains)
        .map(|(piece, grain)| {
            let measured = smear::measured(&piece.signal, rate, n_bins);
            let model = grain.as_ref().map_or_else(
                || vec![0.0; measured.len()],
                |grain| Leakage::new(piece.signal.len(), n_bins).expected(&smear::grain_density(grain)),
            );
            [measured, model].map(|s| s[bins.clone()].to_vec())
        })
        .collect();
    let predicted: Vec<f64> =
        grains.iter().map(|g| g.as_ref().map_or(0.0, |g| g.level_mps2.powi(2))).collect();
    let all = Surface::new(pieces.iter().collect());
    let shares = all.shares();
    let usual: Vec<f64> = pieces.iter().map(|p| all.usual_mean_square(p)).collect();
    let comparisons = (0..pieces.len())
        .map(|i| pooled(i, &pool(i, pieces, &shares), pieces, &spectra, [&predicted, &usual]))
        .collect();
    (bins.map(|k| Hertz(k as f64 * step_hz)).collect(), comparisons)
}

/// Number of samples of a window at this rate, and the bins of its spectrum that are compared: above [`HIGH_PASS`].
pub(super) fn compared_bins(rate: Hertz) -> (usize, Range<usize>) {
    let n_bins = (WINDOW_SECS * rate.0).round() as usize;
    let first = (HIGH_PASS.0 * n_bins as f64 / rate.0).ceil() as usize;
    (n_bins, first..n_bins.div_ceil(2))
}

/// A segment and its nearest neighbors, up to [`POOL_SECS`] in total.
fn pool(of: usize, pieces: &[Piece], shares: &[[f64; 2]]) -> Vec<usize> {
    let far = |i: &usize| distance(shares[*i], shares[of]);
    let mut near: Vec<usize> = (0..pieces.len()).filter(|i| far(i) <= POOL_DISTANCE).collect();
    near.sort_by(|a, b| far(a).total_cmp(&far(b)));
    let mut secs = 0.0;
    near.into_iter()
        .take_while(|i| {
            let more = secs < POOL_SECS;
            secs += pieces[*i].seconds;
            more
        })
        .collect()
}

/// Compares pooled segments with their models' predictions. Both are scaled by the power law from the speed and force
/// of each segment to those of the central one. Scaling by measured or predicted levels would let errors affect their
/// own weights.
fn pooled(
    of: usize,
    pool: &[usize],
    pieces: &[Piece],
    spectra: &[[Vec<f64>; 2]],
    [predicted, usual]: [&[f64]; 2],
) -> Comparison {
    let total: f64 = pool.iter().map(|i| pieces[*i].seconds).sum();
    let scale = |i: usize| pieces[i].seconds / total * usual[of] / usual[i];
    let sum = |which: usize| -> Vec<f64> {
        let mut sum = vec![0.0; spectra[of][which].len()];
        for i in pool {
            add_times(&spectra[*i][which], scale(*i), &mut sum);
        }
        sum
    };
    let (measured_psd, model_psd) = (sum(0), sum(1));
    let measured: f64 = pool.iter().map(|i| scale(*i) * pieces[*i].mean_square).sum();
    let model: f64 = pool.iter().map(|i| scale(*i) * predicted[*i]).sum();
    Comparison {
        gfc: goodness_of_fit(&measured_psd, &model_psd),
        level_error_db: 10.0 * (model / measured).log10(),
        measured_psd,
        model_psd,
    }
}
