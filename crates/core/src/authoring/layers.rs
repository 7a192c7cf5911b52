//! What becomes of landing and friction where a few textures are blended.
//!
//! Both are averaged as logarithms: hands tell ratios of friction, frequency and damping apart, not differences, and the
//! frequency of a landing goes with the root of a stiffness that runs over decades. A texture of which a layer is not known has no
//! say in it; where none is known there is none.

use crate::field::{LEAST_FRICTION, ln_tap, tap_from_ln};
use crate::tap::Tap;

/// The weighted geometric mean of what friction is known.
pub(super) fn mean_friction(parts: impl Iterator<Item = (Option<f64>, f64)>) -> Option<f64> {
    let known =
        parts.filter_map(|(friction, weight)| friction.map(|f| ([f.max(LEAST_FRICTION).ln()], weight)));
    mean(known).map(|[ln]| ln.exp())
}

/// The weighted geometric mean of what landings are known.
pub(super) fn mean_tap(parts: impl Iterator<Item = (Option<Tap>, f64)>) -> Option<Tap> {
    mean(parts.filter_map(|(tap, weight)| tap.map(|tap| (ln_tap(tap), weight)))).map(|ln| tap_from_ln(&ln))
}

fn mean<const N: usize>(parts: impl Iterator<Item = ([f64; N], f64)>) -> Option<[f64; N]> {
    let (mut sum, mut total) = ([0.0; N], 0.0);
    for (values, weight) in parts {
        total += weight;
        for (s, v) in sum.iter_mut().zip(values) {
            *s += weight * v;
        }
    }
    (total > 0.0).then(|| sum.map(|s| s / total))
}
