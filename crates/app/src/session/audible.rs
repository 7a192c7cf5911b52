//! The audible textures: voices with their weights, and the texture interpolated for the point.

use std::sync::Arc;

use shagreen_core::space::authoring::{Authored, Voice};
use shagreen_core::texture::blend::{Mode, mixture_psd};
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::units::{Contact, Hertz};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Library texture with this index.
    Library(usize),
    /// [`Audible::made`].
    Made,
}

/// Audible texture and its weight.
#[derive(Clone, Debug)]
pub(super) struct AudibleVoice {
    pub(super) source: Source,
    pub(super) plane: Arc<Plane>,
    pub(super) share: f64,
}

/// Interpolated texture, prepared for the renderer.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// Identifies the texture to the output.
    pub(super) number: u64,
    pub(super) prepared: Prepared,
}

/// Audible textures and the mode in which they are mixed.
#[derive(Clone, Debug, Default)]
pub(super) struct Audible {
    /// At most three; empty is silence.
    pub(super) voices: Vec<AudibleVoice>,
    pub(super) mixing: Mode,
    pub(super) made: Option<Made>,
}

/// Speeds and forces of a voice: those of a texture of the library, or of the interpolated model.
pub(super) fn plane_of(voice: Voice<'_>, planes: &[Arc<Plane>]) -> Arc<Plane> {
    match voice {
        Voice::Texture(texture) => Arc::clone(&planes[texture]),
        Voice::Made(model) => Arc::new(Plane::new(model)),
    }
}

impl Audible {
    /// Audible textures of `authored`. An interpolated texture is identified by `number`.
    pub(super) fn new(authored: &Authored, planes: &[Arc<Plane>], number: u64) -> Self {
        let mut heard = Self { mixing: authored.mixing(), ..Self::default() };
        for (voice, share) in authored.voices() {
            let plane = plane_of(voice, planes);
            let source = match voice {
                Voice::Texture(texture) => Source::Library(texture),
                Voice::Made(_) => {
                    heard.made = Some(Made { number, prepared: plane.prepare() });
                    Source::Made
                }
            };
            heard.voices.push(AudibleVoice { source, plane, share });
        }
        heard
    }

    /// A single interpolated texture, identified by `number`.
    pub(super) fn made_alone(plane: Plane, number: u64) -> Self {
        let made = Some(Made { number, prepared: plane.prepare() });
        let voice = AudibleVoice { source: Source::Made, plane: Arc::new(plane), share: 1.0 };
        Self { voices: vec![voice], made, ..Self::default() }
    }

    /// Whether all voices remain valid: their library textures are marked in `is_kept`, and their sample rate is
    /// `rate`.
    pub(super) fn survives(&self, is_kept: &[bool], rate: Hertz) -> bool {
        self.voices.iter().all(|voice| {
            let is_there = match voice.source {
                Source::Library(texture) => is_kept.get(texture).copied().unwrap_or(false),
                Source::Made => true,
            };
            is_there && voice.plane.rate() == rate
        })
    }

    /// Power spectral density of the mixture in (m/s²)²/Hz at one contact.
    pub(super) fn psd(&self, contact: Contact, frequencies: &[Hertz]) -> Vec<f64> {
        let voices: Vec<(&Plane, f64)> =
            self.voices.iter().map(|voice| (&*voice.plane, voice.share)).collect();
        mixture_psd(&voices, self.mixing, contact, frequencies)
    }
}
