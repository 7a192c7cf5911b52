//! A value read from a file, with warnings.

/// A value read from a file, with the reader's warnings.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported<T> {
    /// The value, complete and validated.
    pub value: T,
    /// Sentences for the user, one for each imperfection that leaves the data usable.
    pub warnings: Vec<String>,
}
