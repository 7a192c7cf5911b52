//! A sound with the textures that it is made of, which a `Texture` of Python holds.

use std::sync::Arc;

use anyhow::{anyhow, bail};
use shagreen_core::space::fidelity::mixture_level_toward_mps2;
use shagreen_core::texture::blend::{Mode, mixture_psd_toward};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::{Contact, Hertz, Radians};
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_studio::render::SampleFormat;
use shagreen_studio::report::Reporter;
use shagreen_studio::sound::Sound;
use shagreen_studio::sound_entry::entry_of_sound;
use shagreen_studio::sound_render::{add_taps_of_stroke, render_sound};

use crate::strokes::Motion;

/// Largest number of samples of a signal: one hour at more than 48 kHz, in 1 GiB.
const MAX_SAMPLES: f64 = 268_435_456.0;

/// A sound with the textures that it is made of.
pub(crate) struct Sounding {
    /// Textures of the sound.
    pub(crate) library: Arc<Library>,
    /// Voices, mixture and tap transient.
    pub(crate) sound: Sound,
    /// Name to show.
    pub(crate) name: String,
}

impl Sounding {
    /// Returns the texture as a library entry with its terms of use.
    pub(crate) fn entry(&self) -> anyhow::Result<TextureEntry> {
        Ok(self.library.with_terms(&entry_of_sound(&self.library, &self.sound, &self.name)?))
    }

    /// Returns the sound of a single entry.
    pub(crate) fn of_entry(entry: TextureEntry) -> anyhow::Result<Self> {
        let (id, name) = (entry.id.clone(), entry.name.clone());
        let library = Library { name: name.clone(), textures: vec![entry], ..Library::default() };
        let sound = Sound::of_texture(&library, &id, Mode::default(), &Shape::default())?;
        Ok(Self { library: Arc::new(library), sound, name })
    }

    /// Returns the model rate of the sound.
    pub(crate) fn rate(&self) -> anyhow::Result<Hertz> {
        self.sound.rate(&self.library)
    }

    /// Renders a motion, with tap transients where a stroke lands. `rate_hz` is the rate of the format.
    pub(crate) fn rendered(
        &self,
        motion: Motion,
        (format, rate_hz): (SampleFormat, u32),
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Vec<f32>> {
        let Self { library, sound, .. } = self;
        let n_samples = (format.seconds * format.rate.0).round();
        if n_samples < 1.0 {
            bail!("{} s at {rate_hz} Hz contain no sample; choose a longer duration", format.seconds);
        }
        if n_samples > MAX_SAMPLES {
            bail!("{n_samples} samples are too many; render at most {MAX_SAMPLES} at once");
        }
        // Memory that is missing would end the whole program later.
        Vec::<f32>::new().try_reserve_exact(2 * n_samples as usize).map_err(|error| {
            anyhow!("there is not enough memory for {n_samples} samples ({error}); choose a shorter duration")
        })?;
        match motion {
            Motion::Steady { contact, .. } => {
                render_sound(library, sound, format, &mut |_: f64| contact, reporter)
            }
            Motion::Stroke(stroke) => {
                let mut hand = |secs: f64| -> Contact { stroke.contact_at(secs) };
                let mut samples = render_sound(library, sound, format, &mut hand, reporter)?;
                add_taps_of_stroke(&mut samples, library, sound, (stroke, rate_hz), reporter)?;
                Ok(samples)
            }
        }
    }

    /// Returns the power spectral density of the noise in (m/s²)²/Hz.
    pub(crate) fn psd(
        &self,
        contact: Contact,
        direction: Radians,
        frequencies: &[Hertz],
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Vec<f64>> {
        let planes = self.sound.planes(&self.library, reporter)?;
        Ok(mixture_psd_toward(&borrowed(&planes), self.sound.mixing, contact, direction, frequencies))
    }

    /// Returns the level of the noise in m/s².
    pub(crate) fn level_mps2(
        &self,
        contact: Contact,
        direction: Radians,
        reporter: &dyn Reporter,
    ) -> anyhow::Result<f64> {
        let planes = self.sound.planes(&self.library, reporter)?;
        Ok(mixture_level_toward_mps2(&borrowed(&planes), self.sound.mixing, contact, direction))
    }
}

fn borrowed(planes: &[(Plane, f64)]) -> Vec<(&Plane, f64)> {
    planes.iter().map(|(plane, weight)| (plane, *weight)).collect()
}
