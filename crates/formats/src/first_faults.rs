//! Collected faults of a file.

/// Most faults that are kept. A file may break a rule in each of millions of places.
const MOST_KEPT: usize = 100;

/// The first faults of a file, and the number of all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FirstFaults<T> {
    /// The first hundred.
    pub first: Vec<T>,
    /// Number of all.
    pub n: usize,
}

impl<T> Default for FirstFaults<T> {
    fn default() -> Self {
        Self { first: Vec::new(), n: 0 }
    }
}

impl<T> FirstFaults<T> {
    pub(crate) fn add(&mut self, fault: T) {
        self.n += 1;
        if self.first.len() < MOST_KEPT {
            self.first.push(fault);
        }
    }

    /// Returns the value of the file if it has no fault.
    ///
    /// # Errors
    /// The first fault.
    pub fn or_first<V>(self, value: V) -> Result<V, T> {
        self.first.into_iter().next().map_or(Ok(value), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::FirstFaults;

    #[test]
    fn the_first_are_kept_and_all_are_counted() {
        let mut faults = FirstFaults::default();
        assert_eq!(faults.clone().or_first("file"), Ok("file"));
        (0..250).for_each(|fault| faults.add(fault));
        assert_eq!((faults.first.len(), faults.first[99], faults.n), (100, 99, 250));
        assert_eq!(faults.or_first("file"), Err(0));
    }
}
