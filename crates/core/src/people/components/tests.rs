use proptest::prelude::{any, prop_assert, proptest};

use super::{ComponentsError, MAX_PAIRS, RatingComponents, rating_components};
use crate::maths::rng::Random;

fn components(columns: &[Vec<f64>]) -> RatingComponents {
    let means: Vec<Vec<Option<f64>>> =
        columns.iter().map(|column| column.iter().copied().map(Some).collect()).collect();
    rating_components(&means, 1, &|| true).unwrap()
}

/// Columns that are orthogonal to each other and to a constant, with equal lengths: rows of a Hadamard matrix.
const UNCORRELATED: [[f64; 8]; 3] = [
    [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0],
    [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0],
];

fn mixed(weights: [f64; 3]) -> Vec<f64> {
    (0..8).map(|i| 50.0 + 10.0 * (0..3).map(|k| weights[k] * UNCORRELATED[k][i]).sum::<f64>()).collect()
}

#[test]
fn two_pairs_with_a_known_correlation_have_the_eigenvalues_of_the_closed_form() {
    for r in [-0.9_f64, 0.0, 0.3, 0.8] {
        let found = components(&[mixed([1.0, 0.0, 0.0]), mixed([r, (1.0 - r * r).sqrt(), 0.0])]);
        let expected = [1.0 + r.abs(), 1.0 - r.abs()];
        for (k, eigenvalue) in expected.into_iter().enumerate() {
            // Eight values of one digit: the correlation has 15 correct digits.
            assert!((found.eigenvalues[k] - eigenvalue).abs() < 1e-12, "{r}: {found:?}");
            assert!((found.explained[k] - 0.5 * eigenvalue).abs() < 1e-12, "{r}: {found:?}");
            for loading in &found.loadings[k] {
                // Without a correlation, every direction is an eigenvector.
                assert!(r == 0.0 || (loading.abs() - (0.5 * eigenvalue).sqrt()).abs() < 1e-12, "{found:?}");
            }
        }
        assert_eq!((found.n_textures, &found.pairs[..]), (8, &[0, 1][..]));
    }
}

#[test]
fn three_equally_correlated_pairs_have_the_eigenvalues_of_the_closed_form() {
    // With correlations r between all pairs, the eigenvalues are 1 + 2 r, 1 - r and 1 - r.
    let r = 0.5_f64;
    let columns = [
        mixed([1.0, 0.0, 0.0]),
        mixed([r, (1.0 - r * r).sqrt(), 0.0]),
        mixed([r, r * (1.0 - r) / (1.0 - r * r).sqrt(), ((1.0 - r) * (1.0 + 2.0 * r) / (1.0 + r)).sqrt()]),
    ];
    let found = components(&columns);
    for (eigenvalue, expected) in found.eigenvalues.iter().zip([2.0, 0.5, 0.5]) {
        assert!((eigenvalue - expected).abs() < 1e-12, "{found:?}");
    }
    assert!(found.loadings[0].iter().all(|loading| (loading - (2.0_f64 / 3.0).sqrt()).abs() < 1e-12));
}

/// Mean ratings that two hidden dimensions and a little noise determine.
fn two_dimensional(n_textures: usize, n_pairs: usize, noise: f64) -> Vec<Vec<f64>> {
    let mut random = Random::new(5);
    let hidden: Vec<[f64; 2]> = (0..n_textures).map(|_| [random.normal(), random.normal()]).collect();
    (0..n_pairs)
        .map(|pair| {
            let (sin, cos) = (1.3 * pair as f64).sin_cos();
            hidden.iter().map(|[x, y]| 50.0 + 15.0 * (cos * x + sin * y + noise * random.normal())).collect()
        })
        .collect()
}

#[test]
fn parallel_analysis_finds_the_number_of_hidden_dimensions() {
    let found = components(&two_dimensional(25, 9, 0.3));
    assert_eq!(found.n_dims, 2, "{found:?}");
    assert!(found.explained[0] + found.explained[1] > 0.8, "{found:?}");
    // Random ratings: all eigenvalues are near those of other random ratings.
    let mut random = Random::new(6);
    let noise: Vec<Vec<f64>> = (0..9).map(|_| (0..25).map(|_| random.normal()).collect()).collect();
    assert!(components(&noise).n_dims <= 1, "the first exceeds the limit in one of twenty cases");
    // The sum of the eigenvalues is the number of pairs, also for the random ones on average.
    assert!((found.eigenvalues.iter().sum::<f64>() - 9.0).abs() < 1e-9);
    assert!(found.random_eigenvalues.windows(2).all(|pair| pair[1] <= pair[0]), "{found:?}");
}

#[test]
fn incomplete_and_constant_ratings_are_left_out() {
    let complete = two_dimensional(12, 4, 0.2);
    let mut means: Vec<Vec<Option<f64>>> =
        complete.iter().map(|column| column.iter().copied().map(Some).collect()).collect();
    means[1][3] = None;
    means.insert(2, vec![Some(40.0); 12]);
    means.push(vec![None; 12]);
    let found = rating_components(&means, 1, &|| true).unwrap();
    assert_eq!((found.n_textures, &found.pairs[..]), (11, &[0, 1, 3, 4][..]));
    let without: Vec<Vec<f64>> = complete
        .iter()
        .map(|c| c.iter().enumerate().filter(|(i, _)| *i != 3).map(|(_, v)| *v).collect())
        .collect();
    assert_eq!(found.eigenvalues, components(&without).eigenvalues);
}

#[test]
fn ratings_without_components_say_why() {
    let check = |means: &[Vec<Option<f64>>], expected: ComponentsError| {
        assert_eq!(rating_components(means, 1, &|| true), Err(expected));
    };
    let column = |n: usize| -> Vec<Option<f64>> { (0..n).map(|i| Some(i as f64)).collect() };
    check(&[], ComponentsError::TooFewTextures { n_textures: 0 });
    check(&[column(2), column(2)], ComponentsError::TooFewTextures { n_textures: 2 });
    check(&[column(9)], ComponentsError::TooFewPairs { n_pairs: 1 });
    check(&[column(9), vec![Some(3.0); 9]], ComponentsError::TooFewPairs { n_pairs: 1 });
    let many = vec![column(5); MAX_PAIRS + 1];
    check(&many, ComponentsError::TooManyPairs { n_pairs: MAX_PAIRS + 1 });
    let two = [column(9), column(9)];
    assert_eq!(rating_components(&two, 1, &|| false), Err(ComponentsError::Stopped));
}

proptest! {
    #[test]
    fn the_order_of_the_textures_does_not_matter(seed in any::<u64>()) {
        let columns = two_dimensional(15, 5, 0.5);
        let order = Random::new(seed).shuffled(15);
        let shuffled: Vec<Vec<f64>> =
            columns.iter().map(|column| order.iter().map(|i| column[*i]).collect()).collect();
        let (one, other) = (components(&columns), components(&shuffled));
        for (a, b) in one.eigenvalues.iter().zip(&other.eigenvalues) {
            prop_assert!((a - b).abs() < 1e-9, "{a} and {b}");
        }
        for (a, b) in one.loadings[0].iter().zip(&other.loadings[0]) {
            prop_assert!((a.abs() - b.abs()).abs() < 1e-6, "{a} and {b}");
        }
        prop_assert!(one.n_dims == other.n_dims);
    }
}
