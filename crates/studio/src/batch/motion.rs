//! Strokes of a batch.

use shagreen_core::texture::render::Hand;
use shagreen_core::units::Contact;
use shagreen_formats::wav::TraceV1;

use crate::stroke_contacts::StrokeContacts;
use crate::trace::{TrackHand, steady_trace};

/// A stroke of a batch, as it is rendered.
#[derive(Clone, Debug)]
pub enum LoadedStroke {
    /// Constant speed and force.
    Steady {
        /// Speed and force.
        contact: Contact,
        /// Duration in seconds.
        seconds: f64,
    },
    /// Recorded stroke.
    Recorded {
        /// Speed and force over time.
        contacts: StrokeContacts,
        /// Name of its file, without the folder.
        file_name: String,
        /// SHA-256 of the file in hexadecimal digits.
        sha256: String,
    },
}

impl LoadedStroke {
    /// Duration in seconds.
    pub(super) fn seconds(&self) -> f64 {
        match self {
            Self::Steady { seconds, .. } => *seconds,
            Self::Recorded { contacts, .. } => contacts.duration_secs(),
        }
    }

    pub(super) fn trace(&self) -> TraceV1 {
        match self {
            Self::Steady { contact, seconds } => steady_trace(*contact, *seconds),
            Self::Recorded { contacts, .. } => contacts.trace(),
        }
    }

    pub(super) fn file_name(&self) -> Option<String> {
        match self {
            Self::Steady { .. } => None,
            Self::Recorded { file_name, .. } => Some(file_name.clone()),
        }
    }

    /// Calls `render` with the motion of the tip.
    pub(super) fn with_hand<T>(&self, render: impl FnOnce(&mut dyn Hand) -> T) -> T {
        match self {
            Self::Steady { contact, .. } => render(&mut |_: f64| *contact),
            Self::Recorded { contacts: StrokeContacts::Track(track), .. } => render(&mut TrackHand(track)),
            Self::Recorded { contacts, .. } => render(&mut |secs: f64| contacts.contact_at(secs)),
        }
    }

    /// What the files of a job depend on.
    pub(super) fn inputs(&self) -> String {
        match self {
            Self::Steady { contact, seconds } => format!("{contact:?} {seconds:?}"),
            Self::Recorded { file_name, sha256, .. } => format!("{file_name:?} {sha256}"),
        }
    }
}
