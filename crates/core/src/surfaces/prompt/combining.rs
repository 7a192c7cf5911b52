//! Estimates of single words: changed by degree and negation words, and combined.

use crate::maths::birge::{BirgeMean, birge_mean};
use crate::maths::gaussian_process::Estimate;
use crate::surfaces::prompt::OPEN;

/// Smallest standard deviation of a prediction from words alone, in points.
const SUREST: f64 = 4.0;
/// Factor on the standard deviation of a negated word: "not rough" is not certainly smooth.
const DENIED: f64 = 1.4;

/// Modifiers of a word about touch.
#[derive(Clone, Copy)]
pub(super) struct Modifiers {
    /// Whether the word is negated.
    pub(super) is_denied: bool,
    /// Factor on the precision of its estimates.
    pub(super) weight: f64,
    /// Relative shift of its means toward the nearer end of the axis, or toward the middle if negative.
    pub(super) reach: f64,
}

impl Modifiers {
    pub(super) const NONE: Self = Self { is_denied: false, weight: 1.0, reach: 0.0 };
}

/// Adds an estimate unless it is already present: a repeated word adds no information.
pub(super) fn tell(said: &mut Vec<Estimate>, more: Option<Estimate>) {
    said.extend(more.filter(|estimate| !said.contains(estimate)));
}

/// Applies degree and negation to an estimate.
pub(super) fn qualified(hint: Estimate, modifiers: Modifiers) -> Estimate {
    let Estimate { mut mean, mut deviation } = hint;
    deviation /= modifiers.weight.sqrt();
    let end = if mean < 50.0 { 0.0 } else { 100.0 };
    let toward = if modifiers.reach < 0.0 { 50.0 } else { end };
    mean += modifiers.reach.abs().min(1.0) * (toward - mean);
    if modifiers.is_denied {
        mean = 100.0 - mean;
        deviation *= DENIED;
    }
    Estimate { mean, deviation }
}

/// Returns the combined estimate, and whether the Birge ratio of the estimates exceeds 2.
pub(super) fn combined(estimates: &[Estimate]) -> (Estimate, bool) {
    let Some(BirgeMean { estimate, ratio }) = birge_mean(estimates) else { return (OPEN, false) };
    let deviation = estimate.deviation.clamp(SUREST, OPEN.deviation);
    (Estimate { mean: estimate.mean.clamp(0.0, 100.0), deviation }, ratio > 2.0)
}
