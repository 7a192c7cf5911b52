//! Ranks of values, with mean ranks for ties.

/// Ranks of values with the sizes of their ties.
pub(super) struct Ranks {
    /// Rank of each value, from 1; equal values have the mean of their ranks.
    pub(super) ranks: Vec<f64>,
    /// Number of values in each set of two or more equal values.
    pub(super) ties: Vec<usize>,
}

/// Ranks of finite values, from 1 for the smallest.
pub(super) fn ranks(values: &[f64]) -> Ranks {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut ties = Vec::new();
    let mut n_ranked = 0;
    // Two zeros of different sign are equal.
    for equal in order.chunk_by(|a, b| values[*a] == values[*b]) {
        let rank = n_ranked as f64 + 0.5 * (equal.len() + 1) as f64;
        for index in equal {
            ranks[*index] = rank;
        }
        if equal.len() > 1 {
            ties.push(equal.len());
        }
        n_ranked += equal.len();
    }
    Ranks { ranks, ties }
}

#[cfg(test)]
mod tests {
    use super::ranks;

    #[test]
    fn equal_values_share_the_mean_of_their_ranks() {
        let ranked = ranks(&[3.0, -1.0, 3.0, 0.0, -0.0, 7.0, 3.0]);
        assert_eq!(ranked.ranks, [5.0, 1.0, 5.0, 2.5, 2.5, 7.0, 5.0]);
        assert_eq!(ranked.ties, [2, 3]);
        assert!(ranks(&[]).ranks.is_empty() && ranks(&[2.0]).ties.is_empty());
    }
}
