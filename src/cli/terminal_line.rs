//! The line of progress on the terminal, and printing beside it.

use std::sync::{Mutex, PoisonError};

use indicatif::{ProgressBar, WeakProgressBar};

/// The line that other output must not overwrite.
static SHOWN: Mutex<Option<WeakProgressBar>> = Mutex::new(None);

/// Keeps the line of this bar intact when [`aside`] prints, until the bar is dropped.
pub(crate) fn keep_intact(bar: &ProgressBar) {
    *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar.downgrade());
}

/// Calls a function that prints. A line of progress is removed before it and drawn again after it.
pub(crate) fn aside<T>(print: impl FnOnce() -> T) -> T {
    let weak = SHOWN.lock().unwrap_or_else(PoisonError::into_inner).clone();
    match weak.and_then(|weak| weak.upgrade()) {
        Some(bar) => bar.suspend(print),
        None => print(),
    }
}
