//! Stress that random dissimilarities give: the scale on which a stress is low.

use std::ops::RangeInclusive;

/// Numbers of items for which the approximation is used.
const ITEMS: RangeInclusive<usize> = 10..=48;

/// Numbers of dimensions for which the approximation is used.
const DIMS: RangeInclusive<usize> = 1..=3;

/// Mean stress-1 of nonmetric scaling of random dissimilarities without ties, 0..1; `None` outside the range of the
/// approximation: 10 to 48 items, 1 to 3 dimensions.
///
/// For `n` items in `m` dimensions it is `0.001 (-524.25 + 33.80 m - 2.54 n - 307.26 ln m + 588.35 sqrt(ln n))` (Spence,
/// "A simple approximation for random rankings stress values", Multivariate Behavioral Research 14, 1979). Simulated
/// random orders gave values within 0.02 of it over this range.
pub fn expected_random_stress(n_items: usize, dims: usize) -> Option<f64> {
    if !ITEMS.contains(&n_items) || !DIMS.contains(&dims) {
        return None;
    }
    let (n, m) = (n_items as f64, dims as f64);
    Some(1e-3 * (-524.25 + 33.80 * m - 2.54 * n - 307.26 * m.ln() + 588.35 * n.ln().sqrt()))
}

#[cfg(test)]
mod tests {
    use super::expected_random_stress;
    use crate::maths::rng::lcg_noise;
    use crate::people::dissimilarities::Dissimilarities;
    use crate::people::mds::{MdsOptions, nonmetric};

    #[test]
    fn random_dissimilarities_give_this_stress() {
        for (n, dims) in [(12, 1), (12, 2), (12, 3), (16, 2)] {
            let stress = |seed: u64| {
                let noise = lcg_noise(n * (n - 1) / 2, seed).into_iter().map(|value| Some(value.abs()));
                let items = Dissimilarities::from_condensed(n, noise.collect()).unwrap();
                nonmetric(&items, dims, &MdsOptions::usual(seed)).unwrap().stress
            };
            let mean = (1..=8).map(stress).sum::<f64>() / 8.0;
            let expected = expected_random_stress(n, dims).unwrap();
            // The standard deviation of one stress is 0.01 to 0.03, and a better minimum lowers the mean.
            assert!((mean - expected).abs() < 0.03, "{n} items in {dims}: {mean} for {expected}");
        }
    }

    #[test]
    fn it_rises_with_the_items_and_falls_with_the_dimensions() {
        for n in 10..48 {
            for dims in 1..=3 {
                let here = expected_random_stress(n, dims).unwrap();
                assert!(here > 0.0 && here < 1.0);
                assert!(expected_random_stress(n + 1, dims).unwrap() > here, "{n} in {dims}");
                assert!(dims == 3 || expected_random_stress(n, dims + 1).unwrap() < here, "{n} in {dims}");
            }
        }
        assert_eq!([(9, 2), (49, 2), (12, 0), (12, 4)].map(|(n, m)| expected_random_stress(n, m)), [None; 4]);
    }
}
