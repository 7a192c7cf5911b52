//! Mixer of up to three textures into one signal at the model's sample rate, one tick at a time.

mod friction;
mod slot;

use crate::contact::{Contact, Place};
use crate::direction::DirectionMean;
use crate::noise::{Gaussian, Noise};
use crate::relief::Passage;
use crate::renderer::friction::MixedFriction;
use crate::renderer::slot::Slot;
use crate::texture::Texture;
use crate::voice::MAX_TICK;

/// Longest control tick, in seconds.
pub const TICK_SECS: f32 = 0.005;
/// Duration of a fade of weights, textures or blend, in seconds.
pub const FADE_SECS: f32 = 0.02;
/// Lowest and highest sample rate of a model, in Hz.
pub const MODEL_RATES_HZ: (f32, f32) = (200.0, 4000.0);
/// Most textures in a mix.
pub const MAX_PARENTS: usize = 3;
/// Most voices at once: those of the mix and those that fade out.
pub const MAX_VOICES: usize = 8;

/// Index of a texture in its owner's table.
pub type TextureId = u16;

/// Owner of the prepared textures. It must keep each texture while [`Renderer::is_sounding`] returns true for it.
pub trait Textures {
    /// Returns the texture at `id`, or `None` if there is none.
    fn texture(&self, id: TextureId) -> Option<Texture<'_>>;
}

/// Interpolation mode: how the voices of a mix are combined into one signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// `Σ w_i s_i` of independent signals, as printed in the paper. The level drops between textures.
    Paper,
    /// `Σ w_i s_i` of independent signals, times `Σ w_i σ_i / sqrt(Σ w_i² σ_i²)`. The level is the weighted mean of the
    /// levels.
    Power,
    /// `Σ w_i s_i` of signals that share one excitation.
    Shared,
}

/// One texture of a mix with its weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parent {
    /// Index of the texture.
    pub id: TextureId,
    /// Weight, 0..1.
    pub weight: f32,
}

/// Textures to play: a `Copy` struct, because parents, weights and blend must change together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mix {
    /// The textures, each at most once; an entry with weight 0 is unused.
    pub parents: [Parent; MAX_PARENTS],
    /// Interpolation mode.
    pub blend: Blend,
}

impl Mix {
    /// An empty mix with the given interpolation mode.
    pub fn silent(blend: Blend) -> Self {
        Self { parents: [Parent::default(); MAX_PARENTS], blend }
    }

    /// One texture alone, with its own excitation.
    pub fn solo(id: TextureId) -> Self {
        let mut mix = Self::silent(Blend::Power);
        mix.parents[0] = Parent { id, weight: 1.0 };
        mix
    }

    /// Returns the weight of `id`, summed over its entries; zero if it is not in the mix.
    fn weight_of(&self, id: TextureId) -> f32 {
        let of_id = self.parents.iter().filter(|p| p.id == id && p.weight > 0.0);
        of_id.map(|p| p.weight).sum()
    }
}

/// Mixer of textures. Its output is in m/s² at the sample rate of the textures, which must all share that rate.
#[derive(Clone, Debug)]
pub struct Renderer {
    seed: u64,
    tick_len: usize,
    tick_secs: f32,
    fade_ticks: f32,
    gaussian: Gaussian,
    shared_noise: Noise,
    slots: [Slot; MAX_VOICES],
    blend: Blend,
    /// Fade of the power compensation, 0..1.
    compensation: f32,
    makeup: f32,
    /// Contact at the end of the last tick.
    contact: Contact,
    /// Tip displacement in the last tick.
    passage: Passage,
    direction: DirectionMean,
    friction: MixedFriction,
}

impl Renderer {
    /// A silent renderer at `rate_hz` with noise determined by `seed`. The rate is clamped to [`MODEL_RATES_HZ`]; a
    /// non-finite rate becomes 1000 Hz.
    pub fn new(rate_hz: f32, seed: u64) -> Self {
        let (lowest_hz, highest_hz) = MODEL_RATES_HZ;
        let rate_hz = if rate_hz.is_finite() { rate_hz.clamp(lowest_hz, highest_hz) } else { 1000.0 };
        let tick_len = ((rate_hz * TICK_SECS) as usize).clamp(1, MAX_TICK);
        Self {
            seed,
            tick_len,
            tick_secs: tick_len as f32 / rate_hz,
            fade_ticks: (FADE_SECS * rate_hz / tick_len as f32).max(1.0),
            gaussian: Gaussian::new(),
            shared_noise: Noise::new(seed ^ 0x5EED_0FA1_15EE_D0FA),
            slots: core::array::from_fn(|_| Slot::new(rate_hz)),
            blend: Blend::Power,
            compensation: 1.0,
            makeup: 1.0,
            contact: Contact::LIFTED,
            passage: Passage::default(),
            direction: DirectionMean::default(),
            friction: MixedFriction::new(rate_hz),
        }
    }

    /// Model samples in a tick.
    pub fn tick_len(&self) -> usize {
        self.tick_len
    }

    /// Starts a fade to `mix`. Voices of textures that remain are not restarted; the others fade out.
    ///
    /// Returns false and changes nothing while too many voices are still fading. The caller then passes the newest mix
    /// again after the next tick; it is accepted at most `FADE_SECS` later.
    #[must_use]
    pub fn set_mix(&mut self, mix: &Mix) -> bool {
        let is_new = |slots: &[Slot; MAX_VOICES], id: TextureId| slots.iter().all(|s| s.id != Some(id));
        let n_new = mix.parents.iter().filter(|p| p.weight > 0.0 && is_new(&self.slots, p.id)).count();
        if n_new > self.slots.iter().filter(|s| s.id.is_none()).count() {
            return false;
        }
        for slot in &mut self.slots {
            if let Some(id) = slot.id {
                slot.fade_to(mix.weight_of(id), self.fade_ticks);
            }
        }
        for parent in mix.parents.iter().filter(|p| p.weight > 0.0) {
            if !is_new(&self.slots, parent.id) {
                continue;
            }
            let seed = self.seed ^ (u64::from(parent.id) + 1).wrapping_mul(0xD1B5_4A32_D192_ED03);
            let Some(slot) = self.slots.iter_mut().find(|s| s.id.is_none()) else { break };
            slot.take(parent.id, seed);
            slot.fade_to(mix.weight_of(parent.id), self.fade_ticks);
        }
        self.blend = mix.blend;
        true
    }

    /// Completes all fades at once, for a render that starts in the middle of a stroke.
    pub fn finish_fades(&mut self) {
        self.slots.iter_mut().for_each(Slot::finish_fade);
        self.compensation = if self.blend == Blend::Power { 1.0 } else { 0.0 };
    }

    /// Clears the state of all filters, so that they no longer oscillate. Fades and noise continue.
    pub fn silence(&mut self) {
        self.slots.iter_mut().for_each(Slot::clear_memory);
        self.friction.reset();
    }

    /// Whether a voice of texture `id` is active, including fades.
    pub fn is_sounding(&self, id: TextureId) -> bool {
        self.slots.iter().any(|s| s.id == Some(id))
    }

    /// Renders one tick that ends at `contact` and `place`. Overwrites the first [`Renderer::tick_len`] samples of
    /// `out`.
    ///
    /// A texture that its owner no longer has is silent. Cost: at most [`MAX_VOICES`] voices, each with its grain
    /// ([`Texture::evaluate`]), relief and height map; beside them one stick-slip model, and one exponential function for
    /// the direction. A rotated texture with a relief or a height map needs a sine and a cosine, one with a grain along
    /// its lay two of each. Nothing is allocated.
    pub fn tick(&mut self, textures: &dyn Textures, contact: Contact, place: Place, out: &mut [f32]) {
        let n = self.tick_len.min(out.len());
        let out = &mut out[..n];
        out.fill(0.0);
        let mut shared = [0.0; MAX_TICK];
        if self.blend == Blend::Shared {
            for e in &mut shared[..n] {
                *e = self.gaussian.draw(&mut self.shared_noise);
            }
        }
        let contacts = (self.contact, contact.sanitized());
        self.contact = contacts.1;
        self.passage = self.passage.on(place, self.contact.force_n);
        let direction = self.direction.follow(&self.passage, self.tick_secs);
        let (mut starts, mut lent) = ([0.0; MAX_VOICES], core::array::from_fn::<_, MAX_VOICES, _>(|_| None));
        for ((slot, start), texture) in self.slots.iter_mut().zip(&mut starts).zip(&mut lent) {
            *start = slot.weight;
            let Some(id) = slot.id else { continue };
            *texture = textures.texture(id);
            slot.aim(texture.as_ref(), contact, direction);
        }
        let makeup_before = self.makeup;
        self.makeup = self.next_makeup();
        let slots = self.slots.iter().zip(&starts).zip(&lent);
        let frictions = slots.filter_map(|((slot, start), texture)| {
            let friction = texture.as_ref()?.friction()?;
            Some((friction, (*start, slot.weight)))
        });
        self.friction.add_tick(frictions, contacts, out);
        for ((slot, start), texture) in self.slots.iter_mut().zip(starts).zip(&lent) {
            if slot.id.is_none() {
                continue;
            }
            let mut own = [0.0; MAX_TICK];
            let noise = if self.blend == Blend::Shared {
                &shared[..n]
            } else {
                for e in &mut own[..n] {
                    *e = self.gaussian.draw(&mut slot.noise);
                }
                &own[..n]
            };
            slot.add_grain(noise, (start * makeup_before, slot.weight * self.makeup), out);
            // Signals of relief and height map are coherent, because they depend on position only; their sum needs no
            // power compensation.
            slot.add_surface(texture.as_ref(), &self.passage, (start, slot.weight), out);
            if slot.weight == 0.0 && slot.target == 0.0 {
                slot.id = None;
            }
        }
    }

    /// Gain that compensates the power loss of independent signals; it fades with the interpolation mode.
    fn next_makeup(&mut self) -> f32 {
        let target = if self.blend == Blend::Power { 1.0 } else { 0.0 };
        self.compensation =
            approach(self.compensation, target, (target - self.compensation).signum() / self.fade_ticks);
        let sounding = self.slots.iter().filter(|s| s.id.is_some());
        let (sum, squares) = sounding.fold((0.0_f32, 0.0_f32), |(sum, squares), s| {
            let part = s.weight * s.level;
            (sum + part, squares + part * part)
        });
        // The ratio lies between 1 and sqrt(MAX_VOICES) (Cauchy-Schwarz); with zero levels no compensation is needed.
        let full = if squares > f32::MIN_POSITIVE { sum / libm::sqrtf(squares) } else { 1.0 };
        1.0 + self.compensation * (full - 1.0)
    }
}

/// Returns `from` moved by `step` towards `to`, but not past it.
fn approach(from: f32, to: f32, step: f32) -> f32 {
    let next = from + step;
    if (step >= 0.0 && next >= to) || (step <= 0.0 && next <= to) { to } else { next }
}

#[cfg(test)]
pub(crate) mod tests;
