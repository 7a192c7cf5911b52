//! Voice for programs outside the tool: one texture under one tip, from touches to samples that may drive an actuator.
//!
//! Touches move a [`Stream`]. Its samples and the tap transients pass a [`Limiter`] and a [`LiftGate`], as in the engine of
//! the tool.

mod contacts;
mod stroke;

use crate::contact::Contact;
use crate::drive::KNEE_SHARE;
use crate::impact::{share_of_range, strength_of};
use crate::lift_gate::LiftGate;
use crate::limiter::Limiter;
use crate::renderer::{MODEL_RATES_HZ, Mix, TextureId, Textures};
use crate::runtime_voice::contacts::Contacts;
use crate::runtime_voice::stroke::{Follow, Stroke};
use crate::stream::Stream;
use crate::tap::{Tap, Taps};
use crate::texture::Texture;

/// Highest sample rate of the output, in Hz.
pub const HIGHEST_RATE_HZ: f32 = 768_000.0;
/// Index of the only texture.
const ID: TextureId = 0;

/// Tip at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position upwards, in m.
    pub y_m: f64,
    /// Speed and force; the force is zero while the tip is lifted.
    pub contact: Contact,
}

/// Settings of a voice, constant during its lifetime.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoiceSettings {
    /// Sample rate of the output in Hz, from that of the texture to [`HIGHEST_RATE_HZ`].
    pub sample_rate_hz: f32,
    /// Highest magnitude of a sample in m/s². Samples above four fifths of it are attenuated.
    pub max_mps2: f32,
    /// Seed of the noise: the same seed gives the same samples.
    pub seed: u64,
}

/// Reasons why settings are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum VoiceError {
    /// The sample rate of the output, or that of the texture, is out of range.
    Rate,
    /// The highest magnitude is not a positive finite number.
    Limit,
}

/// One texture under one tip. Nothing in it allocates, and its size is fixed.
#[derive(Clone, Debug)]
pub struct RuntimeVoice {
    model_rate_hz: f32,
    settings: VoiceSettings,
    stream: Stream,
    tap: Tap,
    taps: Taps,
    limiter: Limiter,
    gate: LiftGate,
    /// Frames in a tick.
    tick_frames: f64,
    /// Last touch of the last block.
    touch: Touch,
    contacts: Contacts,
    /// Frames so far.
    frame: u64,
    /// Strength of a tap that starts with the next block.
    strike: Option<f32>,
    /// Whether the gate was closed at the end of the last frames; the filters are then already cleared.
    is_at_rest: bool,
}

struct Lent<'a>(Texture<'a>);

impl Textures for Lent<'_> {
    fn texture(&self, _id: TextureId) -> Option<Texture<'_>> {
        Some(self.0)
    }
}

impl RuntimeVoice {
    /// A lifted tip on a texture with this tap transient.
    ///
    /// # Errors
    /// See [`VoiceError`].
    pub fn new(texture: &Texture<'_>, tap: Option<Tap>, settings: VoiceSettings) -> Result<Self, VoiceError> {
        let model_rate_hz = texture.rate_hz();
        let (lowest_hz, highest_hz) = MODEL_RATES_HZ;
        if !(lowest_hz..=highest_hz).contains(&model_rate_hz)
            || !(model_rate_hz..=HIGHEST_RATE_HZ).contains(&settings.sample_rate_hz)
        {
            return Err(VoiceError::Rate);
        }
        if !(settings.max_mps2.is_finite() && settings.max_mps2 > 0.0) {
            return Err(VoiceError::Limit);
        }
        Ok(Self::lifted(model_rate_hz, tap.unwrap_or(Tap::SILENT), settings))
    }

    fn lifted(model_rate_hz: f32, tap: Tap, settings: VoiceSettings) -> Self {
        let VoiceSettings { sample_rate_hz, max_mps2, seed } = settings;
        let mut stream = Stream::new(model_rate_hz, sample_rate_hz, seed);
        stream.set_mix(Mix::solo(ID));
        Self {
            model_rate_hz,
            settings,
            tick_frames: stream.tick_secs() * f64::from(sample_rate_hz),
            stream,
            tap,
            taps: Taps::new(sample_rate_hz),
            limiter: Limiter::new(max_mps2, KNEE_SHARE),
            gate: LiftGate::new(sample_rate_hz),
            touch: Touch::default(),
            contacts: Contacts::default(),
            frame: 0,
            strike: None,
            is_at_rest: true,
        }
    }

    /// Fills `out` with the next samples in m/s², while the tip moves over the texture that the voice was made for.
    ///
    /// The touches are evenly spaced over the block, and the last one is reached at its last frame. Between two touches in
    /// contact, all values change linearly. A tip that lands has the new touch for the whole time since the touch before,
    /// because it was nowhere on the surface then. Without touches, the last one stays.
    ///
    /// A speed or force that is negative or not finite counts as zero, and a position that is not finite as the last one.
    /// No sample exceeds [`VoiceSettings::max_mps2`], none is other than finite, and all are zero from
    /// [`crate::lift_gate::SILENT_AFTER_SECS`] after lift-off on. Cost: that of [`Stream::process`], and a few operations
    /// a sample. Nothing allocates, locks or panics.
    pub fn process<T>(&mut self, texture: &Texture<'_>, touches: &[T], out: &mut [f32])
    where
        T: Copy + Into<Touch>,
    {
        let stroke = Stroke::new(self.touch, touches, self.frame, out.len());
        // In parts of a tick at most: the gate follows one landing at a time.
        for part in out.chunks_mut((self.tick_frames as usize).max(1)) {
            self.render(texture, &stroke, part);
        }
        self.touch = touches.last().map_or(self.touch, |touch| (*touch).into());
    }

    /// Renders frames in which at most one tick begins.
    fn render<T>(&mut self, texture: &Texture<'_>, stroke: &Stroke<'_, T>, part: &mut [f32])
    where
        T: Copy + Into<Touch>,
    {
        let rates = (f64::from(self.settings.sample_rate_hz), self.tick_frames);
        let mut follow = Follow::new(stroke, rates, &mut self.contacts);
        self.stream.process(&Lent(*texture), &mut follow, part);
        if let Some(strength) = self.strike.take() {
            let highest_mps2 = share_of_range(strength) * KNEE_SHARE * self.settings.max_mps2;
            self.taps.strike(self.tap.within(highest_mps2), strength);
            self.contacts.note_frames(self.frame, self.frame);
        }
        self.taps.add_to(part);
        for sample in part.iter_mut() {
            *sample = self.limiter.limit(*sample);
        }
        self.gate.process(part, self.contacts.touching());
        if self.gate.is_closed() && !self.is_at_rest {
            // The output is silent now. A filter that still oscillates would start the next contact with a jump.
            self.taps.reset();
            self.stream.silence();
        }
        self.is_at_rest = self.gate.is_closed();
        self.frame += part.len() as u64;
    }

    /// Starts the tap transient of the texture with the next sample, for a tip that lands at this speed in m/s; `None` if it
    /// is not known. A texture without a tap transient stays silent.
    pub fn tap(&mut self, impact_mps: Option<f32>) {
        self.strike = Some(strength_of(impact_mps));
    }

    /// Kinetic friction force in N at the last touch: the kinetic coefficient of the texture times the normal force. Zero
    /// while the tip is lifted, and for a texture without known friction.
    pub fn friction_n(&self, texture: &Texture<'_>) -> f32 {
        let force_n = self.touch.contact.sanitized().force_n;
        texture.friction().map_or(0.0, |friction| friction.kinetic * force_n)
    }

    /// Whether a sample was not finite. The output is silent until [`RuntimeVoice::reset`].
    pub fn is_tripped(&self) -> bool {
        self.limiter.is_tripped()
    }

    /// Returns to the state of a new voice, with the same noise. Cost: that of [`RuntimeVoice::new`], some thousand sines.
    pub fn reset(&mut self) {
        *self = Self::lifted(self.model_rate_hz, self.tap, self.settings);
    }

    /// Delay in seconds from a touch to the middle of its ramp in the output, beside the time until its block.
    pub fn latency_secs(&self) -> f32 {
        self.stream.latency_secs()
    }
}

#[cfg(test)]
mod tests;
