//! Parts of the recordings that are left out of a fit in turn, to compare models with strokes that they were not fitted
//! to.

use std::borrow::Cow;

use crate::recording::fit::HeldOut;
use crate::recording::fit::pieces::{Piece, least_samples};
use crate::units::Hertz;

/// Number of folds of segments.
const N_FOLDS: usize = 10;

/// Number of passes through the folds over all segments. A fold consists of neighboring segments, spread over all
/// strokes.
const N_TURNS: usize = 2;

/// Minimum number of segments that are left out whole. Fewer are divided into blocks.
const MIN_PIECES: usize = 10;

/// Minimum duration of a block in seconds: one window of a spectrum.
const BLOCK_SECS: f64 = 0.256;

/// Minimum number of blocks.
const MIN_BLOCKS: usize = 4;

/// Segments, or their blocks, in folds.
pub(super) struct Split<'a> {
    pub(super) rate: Hertz,
    /// Segments or blocks, in the order of the recordings.
    pub(super) parts: Cow<'a, [Piece]>,
    /// Fold of every part.
    pub(super) folds: Vec<usize>,
    /// Index of the first part of every segment.
    pub(super) first: Vec<usize>,
    pub(super) held_out: HeldOut,
}

impl<'a> Split<'a> {
    /// Splits segments at this model rate: into ten folds of segments; if there are few, into blocks, each of which is a
    /// fold; if there are too few of these, not at all.
    pub(super) fn new(pieces: &'a [Piece], rate: Hertz) -> Self {
        let whole = |folds: Vec<usize>, held_out: HeldOut| Self {
            rate,
            parts: Cow::Borrowed(pieces),
            folds,
            first: (0..pieces.len()).collect(),
            held_out,
        };
        if pieces.len() >= MIN_PIECES {
            return whole(segment_folds(pieces), HeldOut::Segments);
        }
        let n_least = least_samples(rate).max((BLOCK_SECS * rate.0).round() as usize);
        let (mut blocks, mut first) = (Vec::new(), Vec::new());
        for piece in pieces {
            first.push(blocks.len());
            blocks.extend(in_blocks(piece, n_least));
        }
        if blocks.len() < MIN_BLOCKS {
            return whole(vec![0; pieces.len()], HeldOut::Nothing);
        }
        let folds = (0..blocks.len()).collect();
        Self { rate, parts: Cow::Owned(blocks), folds, first, held_out: HeldOut::Blocks }
    }

    /// Number of folds.
    pub(super) fn n_folds(&self) -> usize {
        self.folds.iter().max().map_or(0, |last| last + 1)
    }

    /// Parts that a model is fitted to which is compared with this fold: those of the other folds, or all if nothing is
    /// left out.
    pub(super) fn seen(&self, fold: usize) -> Vec<&Piece> {
        let is_seen = |of: usize| of != fold || self.held_out == HeldOut::Nothing;
        self.parts.iter().zip(&self.folds).filter(|(_, of)| is_seen(**of)).map(|(part, _)| part).collect()
    }

    /// Indices of the parts of a fold.
    pub(super) fn asked(&self, fold: usize) -> impl Iterator<Item = usize> {
        self.folds.iter().enumerate().filter(move |(_, of)| **of == fold).map(|(index, _)| index)
    }
}

/// Fold of every segment.
fn segment_folds(pieces: &[Piece]) -> Vec<usize> {
    let total: f64 = pieces.iter().map(|p| p.seconds).sum();
    let mut before = 0.0;
    pieces
        .iter()
        .map(|piece| {
            // By its middle, so that rounding does not move segments of equal length.
            let middle = before + 0.5 * piece.seconds;
            before += piece.seconds;
            let block = ((N_FOLDS * N_TURNS) as f64 * middle / total) as usize;
            block % N_FOLDS
        })
        .collect()
}

/// Divides a segment into blocks of equal length, each of at least `n_least` samples. They keep the speed and force of
/// the segment. A segment with a silent block stays whole, because a predictor needs vibration.
fn in_blocks(piece: &Piece, n_least: usize) -> Vec<Piece> {
    let n = piece.signal.len();
    let n_blocks = (n / n_least).max(1);
    let block = |index: usize| {
        let samples = index * n / n_blocks..(index + 1) * n / n_blocks;
        let signal = piece.signal[samples.clone()].to_vec();
        let share = |count: usize| count as f64 / n as f64;
        Piece {
            start_secs: piece.start_secs + share(samples.start) * piece.seconds,
            seconds: share(samples.len()) * piece.seconds,
            speeds_mps: piece.speeds_mps[samples].to_vec(),
            mean_square: signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64,
            signal,
            ..*piece
        }
    };
    let blocks: Vec<Piece> = (0..n_blocks).map(block).collect();
    if blocks.iter().any(|block| block.mean_square == 0.0) { vec![piece.clone()] } else { blocks }
}

#[cfg(test)]
mod tests {
    use super::{HeldOut, Split, in_blocks};
    use crate::maths::rng::lcg_noise;
    use crate::recording::fit::pieces::Piece;
    use crate::units::Hertz;

    fn piece(n: usize, seed: u64) -> Piece {
        let signal = lcg_noise(n, seed);
        Piece {
            recording: 0,
            start_secs: seed as f64,
            seconds: n as f64 / 1000.0,
            speed_mps: 0.1,
            force_n: 1.0,
            mean_square: signal.iter().map(|x| x * x).sum::<f64>() / n as f64,
            speeds_mps: (0..n).map(|i| 0.1 + 1e-6 * i as f64).collect(),
            signal,
        }
    }

    #[test]
    fn many_segments_are_left_out_whole() {
        let pieces: Vec<Piece> = (0..40).map(|seed| piece(300, seed)).collect();
        let split = Split::new(&pieces, Hertz(1000.0));
        assert_eq!((split.held_out, split.n_folds()), (HeldOut::Segments, 10));
        assert_eq!(split.first, (0..40).collect::<Vec<_>>());
        for fold in 0..10 {
            // Two turns of two neighbors each.
            let asked: Vec<usize> = split.asked(fold).collect();
            assert_eq!((asked.len(), split.seen(fold).len()), (4, 36));
            assert_eq!((asked[1] - asked[0], asked[3] - asked[2]), (1, 1));
        }
    }

    #[test]
    fn few_segments_are_left_out_in_blocks() {
        let pieces = [piece(950, 1), piece(200, 2), piece(600, 3)];
        let split = Split::new(&pieces, Hertz(1000.0));
        // Blocks of at least 256 samples: three, one and two.
        assert_eq!((split.held_out, split.n_folds(), split.parts.len()), (HeldOut::Blocks, 6, 6));
        assert_eq!(split.first, [0, 3, 4]);
        for fold in 0..6 {
            assert_eq!((split.asked(fold).collect::<Vec<_>>(), split.seen(fold).len()), (vec![fold], 5));
        }
        // At a low rate, blocks have as many samples as the shortest segment.
        assert!(Split::new(&pieces, Hertz(200.0)).parts.iter().all(|part| part.signal.len() >= 100));
    }

    #[test]
    fn blocks_are_the_segment_in_parts() {
        let whole = piece(950, 1);
        let blocks = in_blocks(&whole, 256);
        let signal: Vec<f64> = blocks.iter().flat_map(|block| block.signal.clone()).collect();
        let speeds: Vec<f64> = blocks.iter().flat_map(|block| block.speeds_mps.clone()).collect();
        assert_eq!((signal, speeds), (whole.signal.clone(), whole.speeds_mps.clone()));
        let energy: f64 = blocks.iter().map(|block| block.seconds * block.mean_square).sum();
        assert!((energy / (whole.seconds * whole.mean_square) - 1.0).abs() < 1e-12);
        for pair in blocks.windows(2) {
            assert!((pair[0].start_secs + pair[0].seconds - pair[1].start_secs).abs() < 1e-12);
        }
        // A part without vibration has no predictor.
        let mut silent = whole;
        silent.signal[600..].fill(0.0);
        assert_eq!(in_blocks(&silent, 256).len(), 1);
    }

    #[test]
    fn what_is_too_short_to_divide_is_not_left_out() {
        let pieces = [piece(300, 1), piece(400, 2)];
        let split = Split::new(&pieces, Hertz(1000.0));
        assert_eq!((split.held_out, split.n_folds(), split.seen(0).len()), (HeldOut::Nothing, 1, 2));
    }
}
