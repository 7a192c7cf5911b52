//! One texture of a mix: its voices, noise and fade.

use super::{TextureId, approach};
use crate::contact::Contact;
use crate::direction::Direction;
use crate::height_map::HeightMapVoice;
use crate::noise::Noise;
use crate::relief::{Passage, ReliefVoice};
use crate::texture::Texture;
use crate::voice::Voice;

/// Voices of one texture, with a weight that fades.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    /// The texture; `None` for a free slot.
    pub(super) id: Option<TextureId>,
    /// Noise of the texture alone.
    pub(super) noise: Noise,
    /// Weight at the end of the last tick.
    pub(super) weight: f32,
    /// Weight at the end of the fade.
    pub(super) target: f32,
    /// Level (RMS) of the grain in m/s².
    pub(super) level: f32,
    voice: Voice,
    relief: ReliefVoice,
    height_map: HeightMapVoice,
    hints: [u16; 2],
    step: f32,
}

impl Slot {
    /// A free slot at the model's sample rate in Hz.
    pub(super) fn new(rate_hz: f32) -> Self {
        Self {
            id: None,
            noise: Noise::new(0),
            weight: 0.0,
            target: 0.0,
            level: 0.0,
            voice: Voice::new(),
            relief: ReliefVoice::new(rate_hz),
            height_map: HeightMapVoice::new(rate_hz),
            hints: [0; 2],
            step: 0.0,
        }
    }

    /// Takes a texture, which is silent until [`Slot::fade_to`].
    pub(super) fn take(&mut self, id: TextureId, seed: u64) {
        self.id = Some(id);
        self.voice.reset();
        self.relief.reset();
        self.height_map.reset();
        self.noise = Noise::new(seed);
        self.hints = [0; 2];
        self.weight = 0.0;
    }

    /// Fades to a weight within a number of ticks.
    pub(super) fn fade_to(&mut self, target: f32, fade_ticks: f32) {
        self.target = target;
        self.step = (target - self.weight) / fade_ticks;
    }

    /// Completes the fade.
    pub(super) fn finish_fade(&mut self) {
        self.weight = self.target;
        self.step = 0.0;
        if self.target == 0.0 {
            self.id = None;
        }
    }

    /// Clears the state of all filters. The fade and the noise continue.
    pub(super) fn clear_memory(&mut self) {
        self.voice.clear_memory();
        self.relief.reset();
        self.height_map.reset();
    }

    /// Sets the contact at the end of the next tick, and moves the weight. A texture that its owner no longer has is
    /// silent.
    pub(super) fn aim(&mut self, texture: Option<&Texture<'_>>, contact: Contact, direction: Direction) {
        self.weight = approach(self.weight, self.target, self.step);
        if let Some(texture) = texture {
            let at = texture.evaluate(contact, direction, &mut self.hints);
            self.level = at.level_mps2;
            self.voice.aim(texture.order(), &at);
        } else {
            (self.weight, self.target) = (0.0, 0.0);
        }
    }

    /// Adds a tick of the grain, driven by `noise`, with weights at both ends of the tick.
    pub(super) fn add_grain(&mut self, noise: &[f32], weights: (f32, f32), out: &mut [f32]) {
        self.voice.add_tick(noise, weights, out);
    }

    /// Adds a tick of relief and height map over a passage on the pad, with weights at both ends of the tick.
    pub(super) fn add_surface(
        &mut self,
        texture: Option<&Texture<'_>>,
        on_pad: &Passage,
        weights: (f32, f32),
        out: &mut [f32],
    ) {
        let Some(texture) = texture.filter(|texture| texture.has_surface()) else {
            self.relief.reset();
            self.height_map.reset();
            return;
        };
        let passage = texture.passage(on_pad);
        match texture.relief() {
            Some(relief) => self.relief.add_tick(&relief, &passage, weights, out),
            None => self.relief.reset(),
        }
        match texture.height_map() {
            Some(height_map) => self.height_map.add_tick(&height_map, &passage, weights, out),
            None => self.height_map.reset(),
        }
    }
}
