//! Cross-validation folds: sets of textures that are left out together.

use super::SelectionError;
use crate::maths::rng::Random;

/// Folds made by dealing out the textures of an order in turn.
pub(super) fn deal(order: &[usize], n_folds: usize) -> Vec<Vec<usize>> {
    (0..n_folds).map(|fold| order.iter().copied().skip(fold).step_by(n_folds).collect()).collect()
}

/// All folds of all repeats; for leave-one-out (as many folds as textures), one repeat is enough.
pub(super) fn repeated(
    n: usize,
    n_folds: usize,
    n_repeats: usize,
    random: &mut Random,
) -> Result<Vec<Vec<usize>>, SelectionError> {
    if n_folds < 2 || n_folds > n || n_repeats < 1 {
        return Err(SelectionError::Folds { n, n_folds, n_repeats });
    }
    let n_repeats = if n_folds == n { 1 } else { n_repeats };
    Ok((0..n_repeats).flat_map(|_| deal(&random.shuffled(n), n_folds)).collect())
}

/// Indices of the textures outside a fold, in ascending order.
pub(super) fn outside(fold: &[usize], n: usize) -> Vec<usize> {
    (0..n).filter(|texture| !fold.contains(texture)).collect()
}

#[cfg(test)]
mod tests {
    use super::{outside, repeated};
    use crate::maths::rng::Random;

    #[test]
    fn every_texture_is_left_out_once_a_repeat() {
        for (n, n_folds, n_repeats, expected) in [(25, 5, 4, 4), (8, 8, 9, 1), (11, 3, 2, 2)] {
            let folds = repeated(n, n_folds, n_repeats, &mut Random::new(5)).unwrap();
            assert_eq!(folds.len(), n_folds * expected);
            for texture in 0..n {
                assert_eq!(folds.iter().filter(|f| f.contains(&texture)).count(), expected);
            }
            assert!(
                folds
                    .iter()
                    .all(|f| f.len().abs_diff(n / n_folds) <= 1 && outside(f, n).len() == n - f.len())
            );
        }
        assert!(repeated(8, 9, 1, &mut Random::new(5)).is_err());
        assert!(repeated(8, 1, 1, &mut Random::new(5)).is_err());
        assert!(repeated(8, 4, 0, &mut Random::new(5)).is_err());
    }
}
