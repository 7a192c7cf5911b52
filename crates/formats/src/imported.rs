//! A value read from a file, with what was not quite as it should be.

/// What was read, and what the reader would like to tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported<T> {
    /// The value, complete and checked.
    pub value: T,
    /// Sentences for people, one for each thing that was odd but usable.
    pub warnings: Vec<String>,
}

impl<T> Imported<T> {
    /// A value about which there is nothing to tell.
    pub fn clean(value: T) -> Self {
        Self { value, warnings: Vec::new() }
    }
}
