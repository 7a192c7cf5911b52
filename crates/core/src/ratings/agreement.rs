//! How well raters agree: intraclass correlations of Shrout and Fleiss (1979), cases 2,1 and 2,k.
//!
//! Two-way random effects, absolute agreement: textures and raters are both samples, and a rater who rates everything
//! ten points higher disagrees. Intervals are those of McGraw and Wong (1996), case A.

use super::RatingTable;
use crate::statistics::{f_quantile_above, f_upper_tail, mean};

/// Mean squares below this are rounding: ratings run to 100, and so their squares to 1e4.
const NO_VARIANCE: f64 = 1e-18;

/// An intraclass correlation with its 95 % interval. It may be negative where raters agree less than by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntraclassCorrelation {
    /// The correlation, at most 1.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Agreement of raters on one pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// Of one rater: ICC(2,1).
    pub single: IntraclassCorrelation,
    /// Of the mean of the raters: ICC(2,k).
    pub average: IntraclassCorrelation,
    /// F of textures against the error.
    pub f: f64,
    /// Degrees of freedom of the textures and of the error.
    pub dof: [usize; 2],
    /// Probability of an F as large without any difference between textures.
    pub p_value: f64,
    /// Indices of the participants that are counted.
    pub participants: Vec<usize>,
    /// Indices of the textures that are counted: each of them was rated by each of the participants.
    pub textures: Vec<usize>,
}

/// Why there is no agreement to speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AgreementError {
    /// Too little is complete.
    #[error(
        "agreement needs 2 participants who rated the same 2 textures; only {n_participants} and {n_textures} are complete"
    )]
    TooFew {
        /// Participants whose ratings are complete.
        n_participants: usize,
        /// Textures whose ratings are complete.
        n_textures: usize,
    },
    /// Nobody rates two textures differently.
    #[error("every participant gave all textures the same rating: there is nothing to agree on")]
    Constant,
    /// What some rate high, others rate low, so that a share of common variance has no meaning.
    #[error("the raters contradict each other: what some rate high, others rate low; look for swapped poles")]
    Contradictory,
}

/// The agreement on one pair over complete ratings: while any is missing, the participant or the texture with the
/// greatest share of missing ratings is left out (the later one of equals, a texture before a participant).
///
/// # Errors
/// See [`AgreementError`].
///
/// # Panics
/// If the table has no pair of that index.
pub fn agreement(table: &RatingTable, pair: usize) -> Result<Agreement, AgreementError> {
    let (participants, textures) = complete(table, pair);
    let (n, k) = (textures.len(), participants.len());
    if n < 2 || k < 2 {
        return Err(AgreementError::TooFew { n_participants: k, n_textures: n });
    }
    let row = |texture: &usize| -> Vec<f64> {
        participants.iter().filter_map(|p| table.value(*p, *texture, pair)).collect()
    };
    let rows: Vec<Vec<f64>> = textures.iter().map(row).collect();
    let squares = MeanSquares::new(&rows);
    if squares.textures + squares.error <= NO_VARIANCE {
        return Err(AgreementError::Constant);
    }
    let dof = [n - 1, (n - 1) * (k - 1)];
    let f = if squares.error > NO_VARIANCE { squares.textures / squares.error } else { f64::INFINITY };
    let p_value = f_upper_tail(f, dof[0] as f64, dof[1] as f64);
    let contradict = AgreementError::Contradictory;
    let single = squares.single().ok_or(contradict)?;
    // Spearman and Brown; an end below their pole has no counterpart above minus infinity.
    let of_mean = |r: f64| {
        let denominator = 1.0 + (k as f64 - 1.0) * r;
        if denominator > 0.0 { k as f64 * r / denominator } else { f64::NEG_INFINITY }
    };
    let average = IntraclassCorrelation {
        value: squares.average().ok_or(contradict)?,
        low: of_mean(single.low),
        high: of_mean(single.high),
    };
    Ok(Agreement { single, average, f, dof, p_value, participants, textures })
}

/// Participants and textures without a missing rating among them.
fn complete(table: &RatingTable, pair: usize) -> (Vec<usize>, Vec<usize>) {
    let mut participants: Vec<usize> = (0..table.participants().len()).collect();
    let mut textures: Vec<usize> = (0..table.textures().len()).collect();
    let missing = |p: usize, t: usize| usize::from(table.value(p, t, pair).is_none());
    loop {
        let of_participant = |p: &usize| textures.iter().map(|t| missing(*p, *t)).sum::<usize>();
        let of_texture = |t: &usize| participants.iter().map(|p| missing(*p, *t)).sum::<usize>();
        let worst_participant = participants.iter().map(of_participant).enumerate().max_by_key(|(_, n)| *n);
        let worst_texture = textures.iter().map(of_texture).enumerate().max_by_key(|(_, n)| *n);
        let (Some((p, of_p)), Some((t, of_t))) = (worst_participant, worst_texture) else { break };
        if of_p == 0 && of_t == 0 {
            break;
        }
        // Shares of counts, compared crosswise to stay whole: of_p / textures against of_t / participants.
        if of_p * participants.len() > of_t * textures.len() {
            participants.remove(p);
        } else {
            textures.remove(t);
        }
    }
    (participants, textures)
}

/// The mean squares of a two-way table without repetition.
struct MeanSquares {
    n: f64,
    k: f64,
    textures: f64,
    raters: f64,
    error: f64,
}

impl MeanSquares {
    fn new(rows: &[Vec<f64>]) -> Self {
        let (n, k) = (rows.len() as f64, rows[0].len() as f64);
        let of_texture: Vec<f64> = rows.iter().map(|row| mean(row)).collect();
        let of_rater: Vec<f64> = (0..rows[0].len())
            .map(|rater| mean(&rows.iter().map(|row| row[rater]).collect::<Vec<_>>()))
            .collect();
        let grand = mean(&of_texture);
        let squares = |means: &[f64]| means.iter().map(|m| (m - grand) * (m - grand)).sum::<f64>();
        let mut error = 0.0;
        for (row, texture) in rows.iter().zip(&of_texture) {
            for (value, rater) in row.iter().zip(&of_rater) {
                error += (value - texture - rater + grand).powi(2);
            }
        }
        Self {
            n,
            k,
            textures: k * squares(&of_texture) / (n - 1.0),
            raters: n * squares(&of_rater) / (k - 1.0),
            error: error / ((n - 1.0) * (k - 1.0)),
        }
    }

    /// ICC(2,k); `None` where the variance that it is a share of would not be positive.
    fn average(&self) -> Option<f64> {
        let whole = self.textures + (self.raters - self.error) / self.n;
        (whole > NO_VARIANCE).then(|| (self.textures - self.error) / whole)
    }

    /// ICC(2,1) with the interval of McGraw and Wong (1996); `None` where it has no meaning.
    fn single(&self) -> Option<IntraclassCorrelation> {
        let Self { n, k, textures, raters, error } = *self;
        let whole = textures + (k - 1.0) * error + k * (raters - error) / n;
        if whole <= NO_VARIANCE {
            return None;
        }
        let value = (textures - error) / whole;
        if error <= NO_VARIANCE {
            // Raters differ by constants alone: the interval's degrees of freedom have no value there.
            return Some(IntraclassCorrelation { value, low: value, high: value });
        }
        let (a, b) = (k * value / (n * (1.0 - value)), 1.0 + k * value * (n - 1.0) / (n * (1.0 - value)));
        let dof = (a * raters + b * error).powi(2)
            / ((a * raters).powi(2) / (k - 1.0) + (b * error).powi(2) / ((n - 1.0) * (k - 1.0)));
        let of_raters = k * raters + (k * n - k - n) * error;
        if !(dof.is_finite() && dof > 0.0) {
            return None;
        }
        let f_low = f_quantile_above(0.025, n - 1.0, dof);
        let f_high = f_quantile_above(0.025, dof, n - 1.0);
        let low = n * (textures - f_low * error) / (f_low * of_raters + n * textures);
        let high = n * (f_high * textures - error) / (of_raters + n * f_high * textures);
        Some(IntraclassCorrelation { value, low, high })
    }
}
