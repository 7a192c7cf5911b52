//! The audible textures: voices with their weights, and the textures interpolated for the point or shaped.

mod shaped_textures;

use std::sync::Arc;

use shagreen_core::space::authoring::{Authored, Voice};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::{Mode, mixture_psd};
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::{Contact, Hertz, Radians};
use shagreen_formats::library::Library;
use shagreen_studio::authoring::shaped_plane_at;
use shagreen_studio::report::Warnings;

pub(super) use self::shaped_textures::{Shaped, ShapedTextures, Unshaped, needs_preparation};

use super::loaded_textures::Textures;

/// Difference of level along and across from which a direction is shown, in dB: about what a hand notices.
const LEAST_LAY_DB: f64 = 1.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Library texture with this index.
    Library(usize),
    /// Texture of [`Audible::made`] with this number.
    Made(u64),
}

/// Audible texture and its weight.
#[derive(Clone, Debug)]
pub(super) struct AudibleVoice {
    pub(super) source: Source,
    pub(super) plane: Arc<Plane>,
    pub(super) share: f64,
}

/// Texture that is not one of the library, because it is interpolated or shaped, prepared for the renderer.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// Identifies the texture to the output.
    pub(super) number: u64,
    pub(super) prepared: Arc<Prepared>,
}

/// A plane that is prepared for the renderer. During a drag a worker makes it, because it would take a large part of a
/// frame.
#[derive(Debug)]
pub(super) struct ReadyPlane {
    plane: Arc<Plane>,
    prepared: Arc<Prepared>,
}

impl ReadyPlane {
    pub(super) fn new(plane: Arc<Plane>) -> Self {
        let prepared = Arc::new(plane.prepare());
        Self { plane, prepared }
    }

    pub(super) fn of(model: &TextureModel) -> Self {
        Self::new(Arc::new(Plane::new(model)))
    }

    /// The plane, and its texture for the renderer under the next number after `n_made`.
    pub(super) fn numbered(self, n_made: &mut u64) -> (Arc<Plane>, Made) {
        *n_made += 1;
        (self.plane, Made { number: *n_made, prepared: self.prepared })
    }
}

/// Audible textures and the mode in which they are mixed.
#[derive(Clone, Debug, Default)]
pub(super) struct Audible {
    /// At most three; empty is silence.
    pub(super) voices: Vec<AudibleVoice>,
    pub(super) mixing: Mode,
    pub(super) made: Vec<Made>,
}

/// The interpolated texture, if it is one of the voices.
pub(super) fn audible_model(authored: &Authored) -> Option<&TextureModel> {
    authored.voices().into_iter().find_map(|(voice, _)| match voice {
        Voice::Made(model) => Some(model),
        Voice::Texture(_) => None,
    })
}

/// Speeds and forces of a voice: those of a texture of the library, which still needs the shape, or of the interpolated
/// model, which has it. `planes` are those of the library.
///
/// # Errors
/// States why a texture of the library cannot have this shape.
fn plane_of(
    voice: Voice<'_>,
    shape: &Shape,
    library: &Library,
    planes: &[Arc<Plane>],
) -> Result<Arc<Plane>, String> {
    match voice {
        Voice::Texture(texture) if shape.is_neutral() => Ok(Arc::clone(&planes[texture])),
        Voice::Texture(texture) => {
            let (entry, rate) = (&library.textures[texture], planes[texture].rate());
            let plane = shaped_plane_at(entry, shape, rate, &Warnings::default());
            plane.map(Arc::new).map_err(|error| format!("{error:#}"))
        }
        Voice::Made(model) => Ok(Arc::new(Plane::new(model))),
    }
}

/// Speeds and forces of the voices of an interpolated texture in its shape, and their weights. `planes` are those of the
/// library.
///
/// # Errors
/// States why a texture of the library cannot have the shape.
pub(super) fn planes_of(
    authored: &Authored,
    library: &Library,
    planes: &[Arc<Plane>],
) -> Result<Vec<(Arc<Plane>, f64)>, String> {
    let voices = authored.voices().into_iter();
    let of = |voice: Voice<'_>| plane_of(voice, &authored.shape, library, planes);
    voices.map(|(voice, share)| of(voice).map(|plane| (plane, share))).collect()
}

impl Audible {
    /// Audible textures of `authored`. `ready` is the interpolated one, if it is made already; library textures in a shape
    /// come from `shaped` if they are there. Textures that are made are numbered on from `n_made`.
    ///
    /// # Errors
    /// States why a texture of the library cannot have the shape.
    pub(super) fn new(
        authored: &Authored,
        mut ready: Option<ReadyPlane>,
        textures: &Textures,
        shaped: &mut ShapedTextures,
        n_made: &mut u64,
    ) -> Result<Self, String> {
        let mut heard = Self { mixing: authored.mixing(), ..Self::default() };
        for (voice, share) in authored.voices() {
            let (plane, made) = match voice {
                Voice::Texture(texture) if authored.shape.is_neutral() => {
                    let (source, plane) = (Source::Library(texture), Arc::clone(&textures.planes[texture]));
                    heard.voices.push(AudibleVoice { source, plane, share });
                    continue;
                }
                Voice::Texture(texture) => shaped.of(texture, &authored.shape, textures, n_made)?,
                Voice::Made(model) => ready.take().unwrap_or_else(|| ReadyPlane::of(model)).numbered(n_made),
            };
            heard.voices.push(AudibleVoice { source: Source::Made(made.number), plane, share });
            heard.made.push(made);
        }
        Ok(heard)
    }

    /// Direction of the lay of the heaviest texture whose level at `contact` differs along and across by [`LEAST_LAY_DB`].
    pub(super) fn lay(&self, contact: Contact) -> Option<Radians> {
        let differs = |voice: &&AudibleVoice| {
            let level = |plane: &Plane| plane.at(contact).level_mps2;
            let along = voice.plane.along().map_or(0.0, level);
            (20.0 * (level(&voice.plane) / along).log10()).abs() >= LEAST_LAY_DB
        };
        let directional = self.voices.iter().filter(|voice| voice.plane.lay().is_some()).filter(differs);
        directional.max_by(|a, b| a.share.total_cmp(&b.share))?.plane.lay()
    }

    /// Angle of the x axis of the heaviest texture on the pad, counterclockwise.
    pub(super) fn turn(&self) -> Radians {
        let heaviest = self.voices.iter().max_by(|a, b| a.share.total_cmp(&b.share));
        heaviest.map_or(Radians(0.0), |voice| voice.plane.turn())
    }

    /// A single interpolated texture, identified by `number`.
    pub(super) fn made_alone(plane: Plane, number: u64) -> Self {
        let made = Made { number, prepared: Arc::new(plane.prepare()) };
        let voice = AudibleVoice { source: Source::Made(number), plane: Arc::new(plane), share: 1.0 };
        Self { voices: vec![voice], made: vec![made], ..Self::default() }
    }

    /// Whether all voices remain valid: their library textures are marked in `is_kept`, and their sample rate is
    /// `rate`.
    pub(super) fn survives(&self, is_kept: &[bool], rate: Hertz) -> bool {
        self.voices.iter().all(|voice| {
            let is_there = match voice.source {
                Source::Library(texture) => is_kept.get(texture).copied().unwrap_or(false),
                Source::Made(_) => true,
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
