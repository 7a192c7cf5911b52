//! Warnings and notes during work.

use std::cell::RefCell;

/// Receiver of warnings and notes.
pub trait Reporter {
    /// Reports that something is not quite as requested.
    fn warn(&self, message: &str);

    /// Reports something that the user would like to know.
    fn note(&self, message: &str);
}

/// Collects warnings and drops notes, for a window that shows the warnings afterwards.
#[derive(Debug, Default)]
pub struct Warnings(RefCell<Vec<String>>);

impl Warnings {
    /// Returns the warnings in the order in which they were reported.
    pub fn into_vec(self) -> Vec<String> {
        self.0.into_inner()
    }
}

impl Reporter for Warnings {
    fn warn(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }

    fn note(&self, _: &str) {}
}
