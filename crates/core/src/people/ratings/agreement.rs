//! Inter-rater agreement: intraclass correlations ICC(2,1) and ICC(2,k) of Shrout and Fleiss (1979), and Cronbach's
//! alpha.
//!
//! The model of the ICC is two-way random effects with absolute agreement. Textures and raters are both random samples,
//! and a constant bias of a rater counts as disagreement. Confidence intervals follow McGraw and Wong (1996), case A.
//! Alpha, with the raters as items, ignores such a bias; it equals ICC(3,k). Its interval follows Feldt (1965).

use super::RatingTable;
use crate::maths::statistics::{f_quantile_above, f_upper_tail, mean};

/// Mean squares below this value are rounding error; ratings reach 100, and their squares 1e4.
const NO_VARIANCE: f64 = 1e-18;

/// Intraclass correlation with its 95 % confidence interval. It is negative if raters agree less than by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntraclassCorrelation {
    /// Estimated correlation, at most 1.
    pub value: f64,
    /// Lower limit of the interval.
    pub low: f64,
    /// Upper limit of the interval.
    pub high: f64,
}

/// Agreement of the raters on one adjective pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// Agreement of a single rater: ICC(2,1).
    pub single: IntraclassCorrelation,
    /// Agreement of the mean over all raters: ICC(2,k).
    pub average: IntraclassCorrelation,
    /// Consistency of the mean over all raters: Cronbach's alpha, which equals ICC(3,k). Minus infinity if the means of
    /// the textures are equal.
    pub alpha: IntraclassCorrelation,
    /// F statistic: mean square of the textures divided by that of the error.
    pub f: f64,
    /// Degrees of freedom of the textures and of the error.
    pub dof: [usize; 2],
    /// Probability of an F statistic at least this large if the textures do not differ.
    pub p_value: f64,
    /// Indices of the participants included.
    pub participants: Vec<usize>,
    /// Indices of the textures included; every included participant rated each of them.
    pub textures: Vec<usize>,
}

/// Reasons why agreement is undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AgreementError {
    /// Too few ratings are complete.
    #[error(
        "agreement needs 2 participants who rated the same 2 textures; only {n_participants} participants and {n_textures} textures have complete ratings"
    )]
    TooFew {
        /// Number of participants with complete ratings.
        n_participants: usize,
        /// Number of textures with complete ratings.
        n_textures: usize,
    },
    /// No participant distinguishes between textures.
    #[error("every participant gave all textures the same rating, so agreement is undefined")]
    Constant,
    /// Raters contradict each other so strongly that the ICC has no meaning.
    #[error("the raters contradict each other: some rate high what others rate low; check for swapped poles")]
    Contradictory,
}

/// Agreement on one adjective pair, from complete ratings. As long as ratings are missing, it excludes the participant
/// or the texture with the largest fraction of missing ratings. Among equals it excludes the last, and a texture before
/// a participant.
///
/// # Errors
/// See [`AgreementError`].
///
/// # Panics
/// If `pair` is not an index of the table's pairs.
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
    // Spearman-Brown formula; at or below its pole the limit becomes minus infinity.
    let of_mean = |r: f64| {
        let denominator = 1.0 + (k as f64 - 1.0) * r;
        if denominator > 0.0 { k as f64 * r / denominator } else { f64::NEG_INFINITY }
    };
    let average = IntraclassCorrelation {
        value: squares.average().ok_or(contradict)?,
        low: of_mean(single.low),
        high: of_mean(single.high),
    };
    Ok(Agreement { single, average, alpha: squares.alpha(), f, dof, p_value, participants, textures })
}

/// Indices of participants and textures that have no missing ratings among them.
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
        // Compares the fractions of_p / textures and of_t / participants by cross-multiplication, which stays in
        // integers.
        if of_p * participants.len() > of_t * textures.len() {
            participants.remove(p);
        } else {
            textures.remove(t);
        }
    }
    (participants, textures)
}

/// Mean squares of a two-way analysis of variance without replication.
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

    /// ICC(2,k); `None` if its denominator is not positive.
    fn average(&self) -> Option<f64> {
        let whole = self.textures + (self.raters - self.error) / self.n;
        (whole > NO_VARIANCE).then(|| (self.textures - self.error) / whole)
    }

    /// Cronbach's alpha with the interval of Feldt (1965): `(1 - alpha) / (1 - estimate)` has an F distribution.
    fn alpha(&self) -> IntraclassCorrelation {
        let Self { n, k, textures, error, .. } = *self;
        if error <= NO_VARIANCE {
            // The raters differ only by constants.
            return IntraclassCorrelation { value: 1.0, low: 1.0, high: 1.0 };
        }
        if textures <= NO_VARIANCE {
            let none = f64::NEG_INFINITY;
            return IntraclassCorrelation { value: none, low: none, high: none };
        }
        let left = error / textures;
        let dof = [n - 1.0, (n - 1.0) * (k - 1.0)];
        let limit = |probability: f64| 1.0 - left * f_quantile_above(probability, dof[0], dof[1]);
        IntraclassCorrelation { value: 1.0 - left, low: limit(0.025), high: limit(0.975) }
    }

    /// ICC(2,1) with the interval of McGraw and Wong (1996); `None` if it is undefined.
    fn single(&self) -> Option<IntraclassCorrelation> {
        let Self { n, k, textures, raters, error } = *self;
        let whole = textures + (k - 1.0) * error + k * (raters - error) / n;
        if whole <= NO_VARIANCE {
            return None;
        }
        let value = (textures - error) / whole;
        if error <= NO_VARIANCE {
            // The raters differ only by constants, and the degrees of freedom of the interval are undefined.
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
