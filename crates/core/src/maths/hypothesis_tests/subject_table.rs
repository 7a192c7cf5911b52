//! Values of subjects under conditions, with the subjects left out who have a missing cell.

/// Values of two or more subjects, each measured under all of two or more conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct SubjectTable {
    rows: Vec<Vec<f64>>,
    n_left_out: usize,
}

/// Reasons why values are no table of subjects and conditions.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SubjectTableError {
    /// There are fewer than two conditions.
    #[error("a comparison needs at least 2 conditions, got {n_conditions}; add a condition")]
    TooFewConditions {
        /// Number of conditions.
        n_conditions: usize,
    },
    /// Fewer than two subjects have a value under every condition.
    #[error(
        "{n_complete} of {n_subjects} subjects have a value under every condition, but 2 are needed; add subjects or leave out a condition"
    )]
    TooFewSubjects {
        /// Number of subjects without a missing cell.
        n_complete: usize,
        /// Number of all subjects.
        n_subjects: usize,
    },
    /// A subject has another number of cells than the first one.
    #[error(
        "subject {subject} has {n_cells} cells, but the first subject has {expected}; write a missing answer as a missing cell"
    )]
    Cells {
        /// Index of the subject.
        subject: usize,
        /// Number of its cells.
        n_cells: usize,
        /// Number of cells of the first subject.
        expected: usize,
    },
    /// A value is not finite.
    #[error(
        "the value of subject {subject} under condition {condition} is not a finite number; make it a missing cell"
    )]
    NotFinite {
        /// Index of the subject.
        subject: usize,
        /// Index of the condition.
        condition: usize,
    },
}

impl SubjectTable {
    /// Checks cells (subjects × conditions) and leaves out every subject with a missing cell (`None`), as listwise
    /// deletion does.
    ///
    /// # Errors
    /// See [`SubjectTableError`].
    pub fn new(cells: &[Vec<Option<f64>>]) -> Result<Self, SubjectTableError> {
        let n_subjects = cells.len();
        let n_conditions = cells.first().map_or(0, Vec::len);
        if n_conditions < 2 {
            return Err(SubjectTableError::TooFewConditions { n_conditions });
        }
        for (subject, row) in cells.iter().enumerate() {
            if row.len() != n_conditions {
                let (n_cells, expected) = (row.len(), n_conditions);
                return Err(SubjectTableError::Cells { subject, n_cells, expected });
            }
            if let Some(condition) = row.iter().position(|cell| cell.is_some_and(|value| !value.is_finite()))
            {
                return Err(SubjectTableError::NotFinite { subject, condition });
            }
        }
        let rows: Vec<Vec<f64>> = cells.iter().filter_map(|row| row.iter().copied().collect()).collect();
        let n_complete = rows.len();
        if n_complete < 2 {
            return Err(SubjectTableError::TooFewSubjects { n_complete, n_subjects });
        }
        Ok(Self { rows, n_left_out: n_subjects - n_complete })
    }

    /// Values of the complete subjects (subjects × conditions).
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Number of complete subjects, 2 or more.
    pub fn n_subjects(&self) -> usize {
        self.rows.len()
    }

    /// Number of conditions, 2 or more.
    pub fn n_conditions(&self) -> usize {
        self.rows[0].len()
    }

    /// Number of subjects who were left out because of a missing cell.
    pub fn n_left_out(&self) -> usize {
        self.n_left_out
    }

    /// Values under one condition, one per complete subject.
    ///
    /// # Panics
    /// If `condition` is not an index of a condition.
    pub fn condition(&self, condition: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row[condition]).collect()
    }

    /// Values under `first` minus those under `second`, one per complete subject.
    ///
    /// # Panics
    /// If `first` or `second` is not an index of a condition.
    pub fn differences(&self, first: usize, second: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row[first] - row[second]).collect()
    }

    /// Every pair of conditions, the lower index first.
    pub fn pairs(&self) -> Vec<[usize; 2]> {
        pairs(self.n_conditions())
    }
}

#[cfg(test)]
impl SubjectTable {
    /// Table of these rows, none of which has a missing cell.
    pub(super) fn complete(rows: &[Vec<f64>]) -> Self {
        let cells: Vec<Vec<Option<f64>>> =
            rows.iter().map(|row| row.iter().copied().map(Some).collect()).collect();
        Self::new(&cells).unwrap()
    }
}

/// Every pair of `n` indices, the lower index first.
pub(super) fn pairs(n: usize) -> Vec<[usize; 2]> {
    (0..n).flat_map(|first| (first + 1..n).map(move |second| [first, second])).collect()
}

#[cfg(test)]
mod tests {
    use super::{SubjectTable, SubjectTableError};

    fn cells(rows: &[&[f64]]) -> Vec<Vec<Option<f64>>> {
        rows.iter().map(|row| row.iter().map(|v| (!v.is_nan()).then_some(*v)).collect()).collect()
    }

    fn error(rows: &[&[f64]]) -> SubjectTableError {
        SubjectTable::new(&cells(rows)).unwrap_err()
    }

    #[test]
    fn subjects_with_a_missing_cell_are_left_out_and_counted() {
        let gap = f64::NAN;
        let table =
            SubjectTable::new(&cells(&[&[1.0, 2.0, 4.0], &[1.0, gap, 3.0], &[5.0, 3.0, 0.0], &[gap; 3]]));
        let table = table.unwrap();
        assert_eq!(table.rows(), [[1.0, 2.0, 4.0], [5.0, 3.0, 0.0]]);
        assert_eq!((table.n_subjects(), table.n_conditions(), table.n_left_out()), (2, 3, 2));
        assert_eq!((table.condition(1), table.differences(2, 0)), (vec![2.0, 3.0], vec![3.0, -5.0]));
        assert_eq!(table.pairs(), [[0, 1], [0, 2], [1, 2]]);
    }

    #[test]
    fn tables_that_cannot_be_compared_are_refused() {
        assert_eq!(error(&[]), SubjectTableError::TooFewConditions { n_conditions: 0 });
        assert_eq!(error(&[&[1.0], &[2.0]]), SubjectTableError::TooFewConditions { n_conditions: 1 });
        assert_eq!(
            error(&[&[1.0, 2.0], &[f64::NAN, 2.0]]),
            SubjectTableError::TooFewSubjects { n_complete: 1, n_subjects: 2 }
        );
        assert_eq!(
            error(&[&[1.0, 2.0], &[3.0, 4.0, 5.0]]),
            SubjectTableError::Cells { subject: 1, n_cells: 3, expected: 2 }
        );
        assert_eq!(
            error(&[&[1.0, 2.0], &[3.0, f64::INFINITY]]),
            SubjectTableError::NotFinite { subject: 1, condition: 1 }
        );
    }
}
