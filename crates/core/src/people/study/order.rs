//! Orders of presentation: balanced Latin squares and seeded shuffles.
//!
//! In a Latin square, every condition takes every position equally often over the participants. Williams' squares are also
//! balanced for what comes before: every condition follows every other one equally often (Williams 1949).

/// Order in which a participant meets parts or trials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// As the plan lists them.
    Listed,
    /// In a random order, in which the repeats of a comparison are mixed.
    #[default]
    Shuffled,
    /// In a random order of its own for each repeat: everything once, then everything again.
    ShuffledBlocks,
    /// In a row of a balanced Latin square: the next row for the next participant, and for the next repeat.
    LatinSquare,
}

impl Order {
    /// All orders, in the order of lists.
    pub const ALL: [Self; 4] = [Self::Listed, Self::Shuffled, Self::ShuffledBlocks, Self::LatinSquare];

    /// Identifier in plans.
    pub fn id(self) -> &'static str {
        match self {
            Self::Listed => "listed",
            Self::Shuffled => "shuffled",
            Self::ShuffledBlocks => "shuffled-blocks",
            Self::LatinSquare => "latin-square",
        }
    }

    /// Returns the order with this identifier.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|order| order.id() == id)
    }
}

/// Number of rows of the balanced square of `n` conditions: `n` if it is even, `2 n` if it is odd, because a single square
/// of an odd number cannot be balanced. A study is balanced if its number of participants is a multiple of it.
pub fn n_rows(n: usize) -> usize {
    if n < 2 || n.is_multiple_of(2) { n.max(1) } else { 2 * n }
}

/// Row `row` of the balanced Latin square of `n` conditions: a permutation of 0..`n`. Rows repeat after [`n_rows`].
pub fn latin_row(n: usize, row: usize) -> Vec<usize> {
    if n == 0 {
        return Vec::new();
    }
    let row = row % n_rows(n);
    // The first row is 0, 1, n-1, 2, n-2, …; each further row adds one to all conditions.
    let first = |at: usize| if at.is_multiple_of(2) { n - at / 2 } else { at.div_ceil(2) };
    let mut conditions: Vec<usize> = (0..n).map(|at| (first(at) + row) % n).collect();
    if row >= n {
        conditions.reverse();
    }
    conditions
}

/// Returns the items in the order of these indices, which are a permutation.
pub(crate) fn in_order<T>(items: Vec<T>, order: &[usize]) -> Vec<T> {
    let mut left: Vec<Option<T>> = items.into_iter().map(Some).collect();
    order.iter().filter_map(|index| left.get_mut(*index)?.take()).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::{Order, in_order, latin_row, n_rows};
    use proptest::prelude::{prop_assert_eq, proptest};

    #[test]
    fn four_conditions_have_the_printed_square() {
        // Williams' square of four treatments, as textbooks print it.
        let square: Vec<Vec<usize>> = (0..4).map(|row| latin_row(4, row)).collect();
        assert_eq!(square, [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]);
        assert_eq!((n_rows(4), n_rows(3), n_rows(1), n_rows(0)), (4, 6, 1, 1));
        assert_eq!((latin_row(0, 3), latin_row(1, 5), latin_row(4, 4)), (vec![], vec![0], vec![0, 1, 3, 2]));
    }

    #[test]
    fn an_order_comes_back_from_its_identifier() {
        assert!(Order::ALL.into_iter().all(|order| Order::from_id(order.id()) == Some(order)));
        assert_eq!(Order::from_id("random"), None);
        assert_eq!(in_order(vec!["a", "b", "c"], &[2, 0, 1]), ["c", "a", "b"]);
    }

    proptest! {
        /// Every condition is equally often at every position, and equally often before every other one.
        #[test]
        fn squares_are_balanced(n in 2_usize..14) {
            let rows: Vec<Vec<usize>> = (0..n_rows(n)).map(|row| latin_row(n, row)).collect();
            let mut at = BTreeMap::new();
            let mut before = BTreeMap::new();
            for row in &rows {
                for (position, condition) in row.iter().enumerate() {
                    *at.entry((position, *condition)).or_insert(0) += 1;
                }
                for two in row.windows(2) {
                    *before.entry((two[0], two[1])).or_insert(0) += 1;
                }
            }
            let each = n_rows(n) / n;
            prop_assert_eq!(at.len(), n * n);
            prop_assert_eq!(before.len(), n * (n - 1));
            prop_assert_eq!(at.values().filter(|count| **count != each).count(), 0);
            prop_assert_eq!(before.values().filter(|count| **count != each).count(), 0);
        }
    }
}
