//! Interpolation of tap transients and friction between a few textures.
//!
//! Both are averaged as logarithms. Touch discriminates ratios of friction, frequency and damping, not differences, and
//! the frequency of a tap transient depends on the square root of a stiffness that spans decades. A texture without a
//! known value does not contribute. If no value is known, the result is `None`.

use crate::space::field::{LEAST_FRICTION, ln_tap, tap_from_ln};
use crate::texture::tap::Tap;

/// Weighted geometric mean of the known friction coefficients.
pub(super) fn mean_friction(parts: impl Iterator<Item = (Option<f64>, f64)>) -> Option<f64> {
    let known =
        parts.filter_map(|(friction, weight)| friction.map(|f| ([f.max(LEAST_FRICTION).ln()], weight)));
    mean(known).map(|[ln]| ln.exp())
}

/// Weighted geometric mean of the known tap transients.
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
