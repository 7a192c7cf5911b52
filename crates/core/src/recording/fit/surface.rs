//! Kernel estimates of the texture at any speed and force, from nearby segments.

use crate::dsp::ar::{ArFit, Part, burg_varying, order_by_bic};
use crate::dsp::lsf::lsf_from_ar;
use crate::recording::fit::FitError;
use crate::recording::fit::pieces::Piece;
use crate::texture::{GrainNode, Interpolation, TextureModel};
use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Standard deviation of the kernel over (speed, force), relative to the highest speed and force.
const KERNEL_SHARE: f64 = 0.05;

/// Minimum duration of signal behind an estimate in seconds, with each segment weighted by the kernel; the kernel
/// widens until this is reached. The standard error of a level is then about 0.5 dB, and that of a resonance is a few
/// hertz.
const ESTIMATE_SECS: f64 = 1.5;

/// Kernel weight below which a segment is left out of a predictor.
const NEGLIGIBLE: f64 = 1e-3;

/// Factor by which the kernel widens in each step.
const WIDENING: f64 = 1.25;

/// Maximum kernel width: nearly uniform over the whole plane.
const MAX_KERNEL_SHARE: f64 = 2.0;

/// Minimum distance between nodes, relative to the highest speed and force. It is slightly larger than the kernel, so
/// that moving resonances are never far from a node.
const NODE_SPACING: f64 = 0.07;

/// Default exponents of speed and force in the power law of levels: the medians of a hundred real textures.
const USUAL_EXPONENTS: [f64; 2] = [0.97, 0.28];

/// Prior weight of [`USUAL_EXPONENTS`] for a whole texture, and of its exponents for a neighborhood. The unit is
/// seconds of signal whose logarithmic speed or force differs by one. At 0.1 s, any real variation in the recording
/// outweighs the prior.
const BELIEF_SECS: f64 = 0.1;

/// Kernel estimates at any speed and force.
pub(super) struct Surface<'a> {
    pieces: Vec<&'a Piece>,
    speed_max_mps: f64,
    force_max_n: f64,
    trend: Trend,
}

/// Power law `level² ∝ v^2α F^2β` of segments, relative to which their levels are averaged.
#[derive(Clone, Copy)]
struct Trend {
    exponents: [f64; 2],
}

impl Trend {
    /// Weighted least squares on logarithms, regularized towards the exponents `believed`.
    fn new(pieces: &[&Piece], weights: &[f64], believed: [f64; 2]) -> Self {
        let total: f64 = pieces.iter().zip(weights).map(|(p, w)| w * p.seconds).sum();
        let logs = |p: &Piece| [p.speed_mps.ln(), p.force_n.ln(), 0.5 * p.mean_square.ln()];
        let mut mean = [0.0; 3];
        for (piece, weight) in pieces.iter().zip(weights) {
            for (mean, log) in mean.iter_mut().zip(logs(piece)) {
                *mean += weight * piece.seconds / total * log;
            }
        }
        // (M + b I) x = r + b believed, where M and r are central moments.
        let mut moments = [[BELIEF_SECS, 0.0], [0.0, BELIEF_SECS]];
        let mut right = believed.map(|e| BELIEF_SECS * e);
        for (piece, weight) in pieces.iter().zip(weights) {
            let logs = logs(piece);
            let secs = weight * piece.seconds;
            let d = [0, 1, 2].map(|i| logs[i] - mean[i]);
            for i in 0..2 {
                for j in 0..2 {
                    moments[i][j] += secs * d[i] * d[j];
                }
                right[i] += secs * d[i] * d[2];
            }
        }
        let [[a, b], [c, d]] = moments;
        let determinant = a * d - b * c;
        Self {
            exponents: [
                (d * right[0] - b * right[1]) / determinant,
                (a * right[1] - c * right[0]) / determinant,
            ],
        }
    }

    /// `v^2α F^2β`, with an arbitrary unit.
    fn mean_square(&self, speed_mps: f64, force_n: f64) -> f64 {
        let [alpha, beta] = self.exponents;
        (2.0 * (alpha * speed_mps.ln() + beta * force_n.ln())).exp()
    }
}

impl<'a> Surface<'a> {
    /// Estimates from these segments; at least one.
    pub(super) fn new(pieces: Vec<&'a Piece>) -> Self {
        let trend = Trend::new(&pieces, &vec![1.0; pieces.len()], USUAL_EXPONENTS);
        let highest = |value: fn(&Piece) -> f64| pieces.iter().map(|p| value(p)).fold(0.0, f64::max);
        let (speed_max_mps, force_max_n) = (highest(|p| p.speed_mps), highest(|p| p.force_n));
        Self { pieces, speed_max_mps, force_max_n, trend }
    }

    /// Speed and force relative to the highest.
    pub(super) fn share(&self, speed_mps: f64, force_n: f64) -> [f64; 2] {
        [speed_mps / self.speed_max_mps, force_n / self.force_max_n]
    }

    /// Exponents of speed and force in the power law of the levels of all segments.
    pub(super) fn exponents(&self) -> [f64; 2] {
        self.trend.exponents
    }

    /// Mean square that the power law of all segments predicts for a segment, with an arbitrary unit.
    pub(super) fn usual_mean_square(&self, piece: &Piece) -> f64 {
        self.trend.mean_square(piece.speed_mps, piece.force_n)
    }

    /// Positions of all segments, relative to the highest speed and force.
    pub(super) fn shares(&self) -> Vec<[f64; 2]> {
        self.pieces.iter().map(|p| self.share(p.speed_mps, p.force_n)).collect()
    }

    /// Kernel weight of every segment at a position.
    fn weights(&self, at: [f64; 2]) -> Vec<f64> {
        let squares: Vec<f64> = self.shares().into_iter().map(|p| distance(p, at).powi(2)).collect();
        let mut width = KERNEL_SHARE;
        loop {
            let weights: Vec<f64> = squares.iter().map(|d| (-0.5 * d / (width * width)).exp()).collect();
            let secs: f64 = weights.iter().zip(&self.pieces).map(|(w, p)| w * p.seconds).sum();
            if secs >= ESTIMATE_SECS || width > MAX_KERNEL_SHARE {
                return weights;
            }
            width *= WIDENING;
        }
    }

    /// Predictor of this order at a speed and force, from the segments nearby.
    pub(super) fn predictor_at(&self, speed_mps: f64, force_n: f64, order: usize) -> Result<ArFit, FitError> {
        let weights = self.weights(self.share(speed_mps, force_n));
        Ok(self.predictor(&weights, speed_mps, order)?.0)
    }

    /// Predictor of the segments near a position, and its effective number of samples. The segments are normalized, so
    /// that their level has no influence.
    fn predictor(&self, weights: &[f64], speed_mps: f64, order: usize) -> Result<(ArFit, f64), FitError> {
        let near = || self.pieces.iter().zip(weights).filter(|(_, w)| **w > NEGLIGIBLE);
        let unit_mps = KERNEL_SHARE * self.speed_max_mps;
        let parts: Vec<Part<'_>> = near()
            .map(|(p, w)| Part {
                signal: &p.signal,
                offsets: p.speeds_mps.iter().map(|v| (v - speed_mps) / unit_mps).collect(),
                weight: w / p.mean_square,
            })
            .collect();
        let fit = burg_varying(&parts, order).ok_or(FitError::Silent)?;
        let counted = |power: i32| near().map(|(p, w)| w.powi(power) * p.signal.len() as f64).sum::<f64>();
        Ok((fit, counted(1).powi(2) / counted(2)))
    }

    /// Level at a speed and force: the local power law times the mean ratio of the nearby segments to it. The mean is
    /// taken over squares, because the mean of logarithms is biased low for short segments.
    fn level_mps2(&self, weights: &[f64], speed_mps: f64, force_n: f64) -> f64 {
        let trend = Trend::new(&self.pieces, weights, self.trend.exponents);
        // The speed changes by up to a quarter within a segment, so the power law is averaged over it.
        let beyond = |p: &Piece| {
            let sum: f64 = p.speeds_mps.iter().map(|v| trend.mean_square(*v, p.force_n)).sum();
            p.mean_square * p.speeds_mps.len() as f64 / sum
        };
        let pairs = || self.pieces.iter().zip(weights);
        let sum: f64 = pairs().map(|(p, w)| w * p.seconds * beyond(p)).sum();
        let secs: f64 = pairs().map(|(p, w)| w * p.seconds).sum();
        (sum / secs * trend.mean_square(speed_mps, force_n)).sqrt()
    }

    /// Segments at which nodes are placed: the fastest first, then repeatedly the one farthest from all chosen ones, so
    /// that the ends of the range come first.
    fn places(&self) -> Vec<usize> {
        let shares = self.shares();
        let first = (0..shares.len()).max_by(|a, b| shares[*a][0].total_cmp(&shares[*b][0])).unwrap_or(0);
        let mut places = vec![first];
        let mut nearest: Vec<f64> = shares.iter().map(|s| distance(*s, shares[first])).collect();
        while let Some((next, far)) = nearest.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)) {
            if *far < NODE_SPACING {
                break;
            }
            places.push(next);
            for (near, share) in nearest.iter_mut().zip(&shares) {
                *near = near.min(distance(*share, shares[next]));
            }
        }
        places
    }

    /// Median over the nodes of the order preferred by the Bayesian information criterion, clamped to `range`.
    pub(super) fn order(&self, range: std::ops::RangeInclusive<usize>) -> Result<usize, FitError> {
        let mut orders = Vec::new();
        for place in self.places() {
            let weights = self.weights(self.shares()[place]);
            let (fit, n) = self.predictor(&weights, self.pieces[place].speed_mps, *range.end())?;
            orders.push(order_by_bic(&fit, n as usize, 0..=*range.end()));
        }
        orders.sort_unstable();
        Ok(orders[orders.len() / 2].clamp(*range.start(), *range.end()))
    }

    /// Texture model with a node at each chosen segment.
    pub(super) fn model(
        &self,
        rate: Hertz,
        order: usize,
        interpolation: Interpolation,
    ) -> Result<TextureModel, FitError> {
        let node = |place: usize| {
            let Piece { speed_mps, force_n, .. } = *self.pieces[place];
            self.node(speed_mps, force_n, order)
        };
        let nodes = self.places().into_iter().map(node).collect::<Result<Vec<GrainNode>, FitError>>()?;
        Ok(TextureModel::new(rate, nodes, None)?.with_interpolation(interpolation)?)
    }

    /// Estimated node at a speed and force.
    pub(super) fn node(&self, speed_mps: f64, force_n: f64, order: usize) -> Result<GrainNode, FitError> {
        let weights = self.weights(self.share(speed_mps, force_n));
        let lsf = lsf_from_ar(&self.predictor(&weights, speed_mps, order)?.0.ar)
            .ok_or(FitError::Unstable { speed_mps, force_n })?;
        Ok(GrainNode {
            speed: MetersPerSecond(speed_mps),
            force: Newtons(force_n),
            lsf,
            level_mps2: self.level_mps2(&weights, speed_mps, force_n),
        })
    }
}

/// Euclidean distance of two positions.
pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
