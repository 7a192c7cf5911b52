//! Variance of errors as a sum of known terms with unknown coefficients.
//!
//! The coefficients of `v = Σ coefficient · term`, 0 or more, maximize the likelihood of normal errors with the variances
//! `v`. This is the Itakura-Saito distance between squared errors and variances, with the multiplicative updates of
//! C. Févotte, N. Bertin and J.-L. Durrieu (2009), none of which lowers the likelihood.

use crate::maths::statistics::dot;

/// Number of updates; a later one changes the variances by less than they are uncertain.
const N_UPDATES: usize = 400;

/// Smallest variance, relative to the mean square of the errors.
const LEAST_SHARE: f64 = 1e-9;

/// Error with the terms of its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorTerms<const N: usize> {
    /// Squared error, 0 or more.
    pub squared: f64,
    /// Terms of the variance, 0 or more, in the unit of the squared error.
    pub terms: [f64; N],
    /// Weight of the error, 0 or more.
    pub weight: f64,
}

/// Returns the coefficients of the terms, all 0 or more; `None` if all errors, all weights or all terms are zero, or if a
/// number is not finite or negative.
///
/// The weighted mean of `squared / variance` is one: the errors are as large as their standard deviations state.
pub fn variance_components<const N: usize>(errors: &[ErrorTerms<N>]) -> Option<[f64; N]> {
    let is_sound = |x: f64| x.is_finite() && x >= 0.0;
    let all_sound = errors.iter().all(|error| {
        is_sound(error.squared) && is_sound(error.weight) && error.terms.into_iter().all(is_sound)
    });
    let total: f64 = errors.iter().map(|error| error.weight).sum();
    let square = errors.iter().map(|error| error.weight * error.squared).sum::<f64>() / total;
    if !(all_sound && total > 0.0 && square > 0.0) {
        return None;
    }
    let least = LEAST_SHARE * square;
    // Begins with equal contributions of the terms that are not always zero.
    let means: [f64; N] = std::array::from_fn(|term| {
        errors.iter().map(|error| error.weight * error.terms[term]).sum::<f64>() / total
    });
    let n_terms = means.iter().filter(|mean| **mean > 0.0).count();
    if n_terms == 0 {
        return None;
    }
    let mut coefficients = means.map(|mean| if mean > 0.0 { square / (n_terms as f64 * mean) } else { 0.0 });
    for _ in 0..N_UPDATES {
        let (mut excess, mut present) = ([0.0; N], [0.0; N]);
        for error in errors {
            let variance = dot(&coefficients, &error.terms).max(least);
            for (term, (excess, present)) in error.terms.iter().zip(excess.iter_mut().zip(&mut present)) {
                *excess += error.weight * term * error.squared / (variance * variance);
                *present += error.weight * term / variance;
            }
        }
        for (coefficient, (excess, present)) in coefficients.iter_mut().zip(excess.into_iter().zip(present)) {
            if present > 0.0 {
                *coefficient *= (excess / present).sqrt();
            }
        }
    }
    // The common factor has a closed form.
    let ratio = errors
        .iter()
        .map(|error| error.weight * error.squared / dot(&coefficients, &error.terms).max(least))
        .sum::<f64>()
        / total;
    Some(coefficients.map(|coefficient| ratio * coefficient))
}

#[cfg(test)]
mod tests {
    use super::{ErrorTerms, variance_components};
    use crate::maths::rng::Random;
    use crate::maths::statistics::dot;
    use proptest::prelude::{Strategy as _, prop, prop_assert, proptest};

    #[test]
    fn one_constant_term_gives_the_weighted_mean_square() {
        let errors = [(4.0, 1.0), (1.0, 3.0), (9.0, 0.0)].map(|(squared, weight)| ErrorTerms {
            squared,
            terms: [2.0],
            weight,
        });
        let [coefficient] = variance_components(&errors).unwrap();
        assert!((2.0 * coefficient - 7.0 / 4.0).abs() < 1e-12, "{coefficient}");
    }

    #[test]
    fn coefficients_that_made_the_errors_are_found() {
        let mut random = Random::new(9);
        let made = [3.0, 0.0, 5.0];
        let errors: Vec<ErrorTerms<3>> = (0..20_000)
            .map(|_| {
                let terms = [1.0, random.uniform(), 4.0 * random.uniform()];
                let squared = dot(&made, &terms) * random.normal().powi(2);
                ErrorTerms { squared, terms, weight: 1.0 }
            })
            .collect();
        let found = variance_components(&errors).unwrap();
        // The constant and the second term partly replace each other; the variance is that of the model within 3 %.
        assert!((found[2] - 5.0).abs() < 0.4, "{found:?}");
        for terms in [[1.0, 0.5, 0.2], [1.0, 0.1, 3.8]] {
            assert!((dot(&found, &terms) / dot(&made, &terms) - 1.0).abs() < 0.05, "{found:?} {terms:?}");
        }
    }

    #[test]
    fn what_has_no_variance_is_refused() {
        let error = ErrorTerms { squared: 1.0, terms: [1.0, 2.0], weight: 1.0 };
        assert_eq!(variance_components::<2>(&[]), None);
        assert_eq!(variance_components(&[ErrorTerms { squared: 0.0, ..error }]), None);
        assert_eq!(variance_components(&[ErrorTerms { weight: 0.0, ..error }]), None);
        assert_eq!(variance_components(&[ErrorTerms { terms: [0.0; 2], ..error }]), None);
        assert_eq!(variance_components(&[error, ErrorTerms { terms: [1.0, -1.0], ..error }]), None);
        assert_eq!(variance_components(&[ErrorTerms { squared: f64::NAN, ..error }]), None);
    }

    proptest! {
        /// The errors are as large as their variances state, whatever the errors and terms are.
        #[test]
        fn the_mean_of_squared_error_over_variance_is_one(
            errors in prop::collection::vec(
                (0.0..50.0_f64, 0.1..9.0_f64, 0.0..9.0_f64, 0.1..3.0_f64).prop_map(|(squared, a, b, weight)| {
                    ErrorTerms { squared, terms: [a, b], weight }
                }),
                3..30,
            )
        ) {
            if let Some(coefficients) = variance_components(&errors) {
                let total: f64 = errors.iter().map(|error| error.weight).sum();
                let ratio: f64 = errors
                    .iter()
                    .map(|error| error.weight * error.squared / dot(&coefficients, &error.terms))
                    .sum::<f64>() / total;
                prop_assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
                prop_assert!(coefficients.iter().all(|x| *x >= 0.0));
            }
        }
    }
}
