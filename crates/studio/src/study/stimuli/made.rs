//! A stimulus as textures to play.

use anyhow::{Context as _, bail};
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::{at_rate, highest_rate};
use shagreen_core::texture::shape::Shape;
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Library, TextureEntry, write_library};
use shagreen_formats::project::sha256_hex;

use crate::near_names::unknown_texture;
use crate::report::Reporter;
use crate::sound::Sound;
use crate::study::textures::{Found, StudyTextures};

/// A stimulus: textures with weights, which are played together.
#[derive(Clone, Debug)]
pub struct StimulusSound {
    voices: Vec<(TextureModel, f64)>,
    rate: Hertz,
    mixing: Mode,
    tap: Option<Tap>,
    path: Option<TexturePath>,
    sha256: String,
}

impl StimulusSound {
    /// A texture of the library, or an authored texture of the project.
    pub(super) fn of_name(
        textures: &StudyTextures,
        name: &str,
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        let library = textures.library();
        match textures.find(name) {
            Some(Found::Texture(_)) => Self::of_sound(
                &Sound::of_texture(library, name, Mode::default(), &Shape::default())?,
                library,
            ),
            Some(Found::Authored(authored)) => {
                let pinned = &authored.blend.locked;
                let of_project = textures
                    .project()
                    .map(|project| project.with_places_of(library, |id| pinned.contains(id)));
                let library = of_project.as_ref().unwrap_or(library);
                Self::of_sound(&Sound::of_authored(library, authored, &authored.shape, reporter)?, library)
            }
            None => bail!(unknown_texture(library, name)),
        }
    }

    /// The texture at the position of a texture of the library, authored from all others.
    pub(super) fn authored_copy(
        textures: &StudyTextures,
        name: &str,
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        let Some(Found::Texture(index)) = textures.find(name) else {
            bail!(
                "only a texture of the library can be authored from the others; use `variant = \"original\"` for \"{name}\""
            )
        };
        let mut others = textures.library().clone();
        let removed = others.textures.remove(index);
        let at = removed.at().with_context(|| {
            format!(
                "\"{name}\" has no position at which it can be authored; assign one, or use another texture"
            )
        })?;
        let blending = (&Blending::default(), &Shape::default());
        Self::of_sound(&Sound::of_point(&others, at, blending, reporter)?, &others)
    }

    /// A texture by itself.
    pub(super) fn of_model(model: TextureModel) -> Self {
        let rate = model.rate();
        Self::hashed(vec![(model, 1.0)], rate, Mode::default(), None, None)
    }

    fn of_sound(sound: &Sound, library: &Library) -> anyhow::Result<Self> {
        let voices = sound.voice_models(library)?;
        let rate = highest_rate(voices.iter().map(|(model, _)| model))
            .context("there is no texture to play; use another one")?;
        let converted = |(model, weight): (TextureModel, f64)| {
            if model.rate() == rate {
                return Ok((model, weight));
            }
            Ok((at_rate(&model, rate)?.model, weight))
        };
        let voices = voices.into_iter().map(converted).collect::<anyhow::Result<_>>()?;
        Ok(Self::hashed(voices, rate, sound.mixing, sound.tap, sound.path.clone()))
    }

    fn hashed(
        voices: Vec<(TextureModel, f64)>,
        rate: Hertz,
        mixing: Mode,
        tap: Option<Tap>,
        path: Option<TexturePath>,
    ) -> Self {
        let mut sound = Self { voices, rate, mixing, tap, path, sha256: String::new() };
        sound.sha256 = sound.hash();
        sound
    }

    /// Hash of the models as a library has them, with their weights.
    fn hash(&self) -> String {
        let entry = |(index, (model, _)): (usize, &(TextureModel, f64))| {
            let path = if index == 0 { self.path.clone() } else { None };
            TextureEntry { path, ..TextureEntry::new(index.to_string(), String::new(), model.clone()) }
        };
        let textures = self.voices.iter().enumerate().map(entry).collect();
        let mut bytes = write_library(&Library { textures, ..Library::default() });
        let weights: Vec<String> = self.voices.iter().map(|(_, weight)| weight.to_string()).collect();
        bytes.extend(format!("{} {} {:?}", self.mixing.id(), weights.join(" "), self.tap).into_bytes());
        sha256_hex(&bytes)
    }

    /// The sound with another level, in dB relative to its own.
    pub(super) fn with_level(self, level_db: f64) -> anyhow::Result<Self> {
        if level_db == 0.0 {
            return Ok(self);
        }
        let shape = Shape { level_db, ..Shape::default() }.checked()?;
        let scaled = |(model, weight): (TextureModel, f64)| Ok((shape.apply(&model)?, weight));
        let voices = self.voices.into_iter().map(scaled).collect::<anyhow::Result<_>>()?;
        let path = self.path.map(|path| path.shaped(&shape)).transpose()?;
        Ok(Self::hashed(voices, self.rate, self.mixing, self.tap, path))
    }

    /// The sound with a higher level, in dB relative to its own.
    pub(super) fn louder(&self, level_db: f64) -> anyhow::Result<Self> {
        self.clone().with_level(level_db)
    }

    /// Textures at a common rate, and their weights, at least one.
    pub fn voices(&self) -> &[(TextureModel, f64)] {
        &self.voices
    }

    /// Speed-force planes of the textures, and their weights.
    pub fn planes(&self) -> Vec<(Plane, f64)> {
        self.voices.iter().map(|(model, weight)| (Plane::new(model), *weight)).collect()
    }

    /// Rate of all textures.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// How the textures are mixed.
    pub fn mixing(&self) -> Mode {
        self.mixing
    }

    /// Tap transient, if it is known.
    pub fn tap(&self) -> Option<Tap> {
        self.tap
    }

    /// Path along a stroke, if the texture changes.
    pub fn path(&self) -> Option<&TexturePath> {
        self.path.as_ref()
    }

    /// Hash of the textures (SHA-256, hexadecimal): equal for stimuli that feel the same.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }
}
