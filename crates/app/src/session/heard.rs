//! What is heard: the voices of what was authored, with the plane of a texture that was made for the point.

use std::sync::Arc;

use shagreen_core::authoring::{Authored, Voice};
use shagreen_core::blend::{Mode, mixture_psd};
use shagreen_core::plane::{Plane, Prepared};
use shagreen_core::units::{Contact, Hertz};

/// Where a voice comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// The texture at this index of the list.
    Library(usize),
    /// [`Heard::made`].
    Made,
}

/// A texture that sounds.
#[derive(Clone, Debug)]
pub(super) struct HeardVoice {
    pub(super) source: Source,
    pub(super) plane: Arc<Plane>,
    pub(super) share: f64,
}

/// A texture that was made for a point.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// Tells it from all others that were made.
    pub(super) number: u64,
    pub(super) prepared: Prepared,
}

/// What sounds, and how it is mixed.
#[derive(Clone, Debug, Default)]
pub(super) struct Heard {
    /// At most three; none are silence.
    pub(super) voices: Vec<HeardVoice>,
    pub(super) mixing: Mode,
    pub(super) made: Option<Made>,
}

impl Heard {
    /// What is heard of `authored`; a texture that was made gets this `number`.
    pub(super) fn new(authored: &Authored, planes: &[Arc<Plane>], number: u64) -> Self {
        let mut heard = Self { mixing: authored.mixing(), ..Self::default() };
        for (voice, share) in authored.voices() {
            let (source, plane) = match voice {
                Voice::Texture(texture) => (Source::Library(texture), Arc::clone(&planes[texture])),
                Voice::Made(model) => {
                    let plane = Plane::new(model);
                    heard.made = Some(Made { number, prepared: plane.prepare() });
                    (Source::Made, Arc::new(plane))
                }
            };
            heard.voices.push(HeardVoice { source, plane, share });
        }
        heard
    }

    /// One texture that was made, alone; it gets this `number`.
    pub(super) fn made_alone(plane: Plane, number: u64) -> Self {
        let made = Some(Made { number, prepared: plane.prepare() });
        let voice = HeardVoice { source: Source::Made, plane: Arc::new(plane), share: 1.0 };
        Self { voices: vec![voice], made, ..Self::default() }
    }

    /// Whether all of it can go on sounding where only the textures that `is_kept` are there still, at this rate.
    pub(super) fn survives(&self, is_kept: &[bool], rate: Hertz) -> bool {
        self.voices.iter().all(|voice| {
            let is_there = match voice.source {
                Source::Library(texture) => is_kept.get(texture).copied().unwrap_or(false),
                Source::Made => true,
            };
            is_there && voice.plane.rate() == rate
        })
    }

    /// Its density in (m/s²)²/Hz at one contact.
    pub(super) fn psd(&self, contact: Contact, frequencies: &[Hertz]) -> Vec<f64> {
        let voices: Vec<(&Plane, f64)> =
            self.voices.iter().map(|voice| (&*voice.plane, voice.share)).collect();
        mixture_psd(&voices, self.mixing, contact, frequencies)
    }
}
