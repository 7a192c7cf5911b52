//! A value read from a file, with what was not quite as it should be.

/// What was read, and what the reader would like to tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported<T> {
    /// The value, complete and checked.
    pub value: T,
    /// Sentences for people, one for each thing that was odd but usable.
    pub warnings: Vec<String>,
}
