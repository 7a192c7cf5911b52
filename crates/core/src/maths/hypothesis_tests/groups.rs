//! Values of independent groups, checked for the tests that compare groups.

/// Values of two or more independent groups, such as the ratings of different people under each condition.
///
/// Missing values are left out beforehand: a group holds the values that exist.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    values: Vec<Vec<f64>>,
}

/// Reasons why values are no groups to compare.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GroupsError {
    /// There are fewer than two groups.
    #[error("a comparison needs at least 2 groups, got {n_groups}; add a group")]
    TooFew {
        /// Number of groups.
        n_groups: usize,
    },
    /// A group has no values.
    #[error("group {group} has no values; leave it out")]
    Empty {
        /// Index of the group.
        group: usize,
    },
    /// Every group has a single value.
    #[error(
        "each of the {n_groups} groups has a single value, so nothing varies within a group; add values to a group"
    )]
    OneEach {
        /// Number of groups.
        n_groups: usize,
    },
    /// A value is not finite.
    #[error("value {index} of group {group} is not a finite number; leave it out")]
    NotFinite {
        /// Index of the group.
        group: usize,
        /// Index of the value in its group.
        index: usize,
    },
}

impl Groups {
    /// Checks values (groups × values; groups may differ in size).
    ///
    /// # Errors
    /// See [`GroupsError`].
    pub fn new(values: Vec<Vec<f64>>) -> Result<Self, GroupsError> {
        let n_groups = values.len();
        if n_groups < 2 {
            return Err(GroupsError::TooFew { n_groups });
        }
        for (group, values) in values.iter().enumerate() {
            if values.is_empty() {
                return Err(GroupsError::Empty { group });
            }
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                return Err(GroupsError::NotFinite { group, index });
            }
        }
        if values.iter().all(|values| values.len() == 1) {
            return Err(GroupsError::OneEach { n_groups });
        }
        Ok(Self { values })
    }

    /// Values of each group, at least one.
    pub fn values(&self) -> &[Vec<f64>] {
        &self.values
    }

    /// Number of values of each group.
    pub fn sizes(&self) -> Vec<usize> {
        self.values.iter().map(Vec::len).collect()
    }

    /// Degrees of freedom between groups, `k - 1`, and within groups, `N - k`, of `N` values in `k` groups; both are 1
    /// or more.
    pub fn dof(&self) -> [usize; 2] {
        let n_groups = self.values.len();
        [n_groups - 1, self.sizes().iter().sum::<usize>() - n_groups]
    }
}

#[cfg(test)]
mod tests {
    use super::{Groups, GroupsError};

    fn error(values: &[&[f64]]) -> GroupsError {
        Groups::new(values.iter().map(|group| group.to_vec()).collect()).unwrap_err()
    }

    #[test]
    fn groups_that_cannot_be_compared_are_refused() {
        assert_eq!(error(&[&[1.0, 2.0]]), GroupsError::TooFew { n_groups: 1 });
        assert_eq!(error(&[&[1.0, 2.0], &[]]), GroupsError::Empty { group: 1 });
        assert_eq!(error(&[&[1.0], &[2.0], &[3.0]]), GroupsError::OneEach { n_groups: 3 });
        assert_eq!(error(&[&[1.0], &[2.0, f64::NAN]]), GroupsError::NotFinite { group: 1, index: 1 });
        let groups = Groups::new(vec![vec![1.0], vec![2.0, 3.0]]).unwrap();
        assert_eq!((groups.sizes(), groups.dof()), (vec![1, 2], [1, 1]));
    }
}
