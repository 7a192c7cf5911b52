//! Signals of textures: strokes at one speed and force, before and after the codec.

use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::dsp::filter::resample;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::signals::codec::CODEC_RATE;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::books::Codebooks;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_formats::codec_tables::built_in_codebooks;

use super::StimulusSound;
use super::profiles::reconstruction;
use crate::render::{SampleFormat, render_along, render_mixture};

/// Speed and force of the strokes.
pub const SIGNAL_CONTACT: Contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
/// Length of a signal, in s: three segments of the published length.
pub const SIGNAL_SECS: f64 = 2.4;

/// Makes signals of textures.
#[derive(Clone, Debug)]
pub(super) struct SignalMaker {
    seed: u64,
    books: Arc<Codebooks>,
}

impl SignalMaker {
    /// Maker with the seed of a plan, from which the noise follows.
    pub(super) fn new(seed: u64) -> anyhow::Result<Self> {
        Ok(Self { seed, books: Arc::new(built_in_codebooks()?) })
    }

    /// Signal in m/s² at the rate of the codec. Signals of the same name have the same noise.
    pub(super) fn of(&self, sound: &StimulusSound, name: &str) -> anyhow::Result<Vec<f64>> {
        let rate = Hertz(sound.rate().0.max(CODEC_RATE.0));
        let seed = derive_seed(self.seed, &format!("signal of {name}"));
        let format = SampleFormat { rate, seconds: SIGNAL_SECS, seed, loops: false };
        let mut hand = |_: f64| SIGNAL_CONTACT;
        let samples = match sound.path() {
            Some(path) => render_along(path, format, &mut hand)?,
            None => render_mixture(&sound.planes(), sound.mixing(), format, &mut hand)?,
        };
        let samples: Vec<f64> = samples.into_iter().map(f64::from).collect();
        Ok(if rate == CODEC_RATE { samples } else { resample(&samples, rate, CODEC_RATE) })
    }

    /// The signal after the codec at this bit rate, in kbit/s.
    pub(super) fn coded(&self, signal: &[f64], kbps: f64) -> anyhow::Result<Vec<f64>> {
        let rate = Bitrate::from_bits_per_sec((1e3 * kbps).round() as u32).with_context(|| {
            let all = Bitrate::ALL.map(|rate| rate.kbps().to_string());
            format!("the codec has no bit rate of {kbps} kbit/s; use one of {}", all.join(", "))
        })?;
        Ok(Coded::encode(signal, rate, &self.books)?.decode(&self.books))
    }
}

/// The signal reconstructed from its spatial spectrogram with this window.
pub(super) fn reconstructed(signal: &[f64], window_mm: f64) -> anyhow::Result<Vec<f64>> {
    reconstruction(signal, SIGNAL_CONTACT.speed.0 / CODEC_RATE.0, window_mm)
}

/// Segments of a signal of equal length, each as a relief over the position.
pub(super) fn segments(signal: &[f64], n_segments: usize) -> anyhow::Result<Vec<StimulusSound>> {
    let n_samples = (signal.len() / n_segments.max(1)).max(1);
    let sound = |samples: &[f64]| {
        let profile = Profile::new(SIGNAL_CONTACT.speed.0 / CODEC_RATE.0, samples.to_vec())
            .context("the segments are too short; reduce `segments`")?;
        let relief = Relief::new(profile, SIGNAL_CONTACT.force)?;
        Ok(StimulusSound::of_model(TextureModel::of_relief(Arc::new(relief), CODEC_RATE)?))
    };
    signal.chunks_exact(n_samples).take(n_segments.max(1)).map(sound).collect()
}
