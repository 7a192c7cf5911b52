//! Tap transients in stroke recordings: detection of contacts, and one decaying sinusoid fitted to all of them.

mod ring;
mod transient;

use crate::recording::Recording;
use crate::recording::tap_transients::ring::ring;
use crate::recording::tap_transients::transient::landings;
use crate::texture::tap::Tap;

/// Tap transient fitted to the contacts in one or more recordings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedTap {
    /// Tap transient; its amplitude is the mean over the contacts.
    pub tap: Tap,
    /// Number of tap transients found.
    pub n_landings: usize,
    /// Share of the transients' energy that the decaying sinusoid explains, with a free amplitude for each, 0 to 1.
    pub explained: f64,
}

/// Fits one tap transient to the contacts in all recordings; `None` if the usable parts contain no contact.
///
/// At a contact the force rises from below [`crate::recording::segment::MIN_FORCE`] and stays above it. Recordings may
/// have different sample rates.
pub fn fit_tap_transients(recordings: &[Recording]) -> Option<FittedTap> {
    let transients: Vec<_> = recordings.iter().flat_map(landings).collect();
    ring(&transients)
}

#[cfg(test)]
mod tests;
