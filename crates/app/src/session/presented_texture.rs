//! A stimulus of a study, prepared for the output.

use std::sync::Arc;

use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::texture::rate::at_rate;
use shagreen_core::units::Hertz;
use shagreen_device::synth::tap::Tap;
use shagreen_studio::study::stimuli::StimulusSound;

use super::audible::{Audible, AudibleVoice, Made, Source};

/// A stimulus of a study, prepared for the output at one sample rate. Preparing it takes time, so a worker does it.
#[derive(Debug)]
pub struct PresentedTexture {
    /// Voices of each key of the path; without a path, of the only texture.
    mixes: Vec<Vec<PreparedVoice>>,
    /// Path along a stroke, if the texture changes.
    path: Option<TexturePath>,
    mixing: Mode,
    tap: Tap,
    rate: Hertz,
}

#[derive(Debug)]
struct PreparedVoice {
    plane: Arc<Plane>,
    prepared: Arc<Prepared>,
    share: f64,
}

impl PreparedVoice {
    fn new(model: &TextureModel, share: f64, rate: Hertz) -> Result<Self, String> {
        let plane = if model.rate() == rate {
            Plane::new(model)
        } else {
            Plane::new(&at_rate(model, rate).map_err(|error| error.to_string())?.model)
        };
        let prepared = Arc::new(plane.prepare());
        Ok(Self { plane: Arc::new(plane), prepared, share })
    }
}

impl PresentedTexture {
    /// A stimulus at a sample rate, which is at least its own. All stimuli of a trial have the same one: the output is
    /// opened again when the rate changes, which would tell them apart.
    ///
    /// # Errors
    /// States why a texture cannot be converted to this rate.
    pub fn new(sound: &StimulusSound, rate: Hertz) -> Result<Self, String> {
        let voice = |(model, share): &(TextureModel, f64)| PreparedVoice::new(model, *share, rate);
        let path = sound.path().cloned();
        let mixes = match &path {
            Some(path) => path
                .keys()
                .iter()
                .map(|key| Ok(vec![PreparedVoice::new(&key.model, 1.0, rate)?]))
                .collect::<Result<_, String>>()?,
            None => vec![sound.voices().iter().map(voice).collect::<Result<_, _>>()?],
        };
        let tap = sound.tap().map_or(Tap::SILENT, Tap::from);
        Ok(Self { mixes, path, mixing: sound.mixing(), tap, rate })
    }

    /// Path along a stroke, if the texture changes.
    pub(super) fn path(&self) -> Option<&TexturePath> {
        self.path.as_ref()
    }

    /// Tap transient at a contact onset.
    pub(super) fn tap(&self) -> Tap {
        self.tap
    }

    /// Sample rate of all voices.
    pub(crate) fn rate(&self) -> Hertz {
        self.rate
    }

    /// Voices at a key of the path, or those of the only texture. They are numbered on from `n_made`.
    pub(super) fn audible(&self, key: usize, n_made: &mut u64) -> Audible {
        let mut heard = Audible { mixing: self.mixing, ..Audible::default() };
        for PreparedVoice { plane, prepared, share } in self.mixes.get(key).map_or(&[][..], Vec::as_slice) {
            *n_made += 1;
            let made = Made { number: *n_made, prepared: Arc::clone(prepared) };
            let source = Source::Made(made.number);
            heard.voices.push(AudibleVoice { source, plane: Arc::clone(plane), share: *share });
            heard.made.push(made);
        }
        heard
    }
}
