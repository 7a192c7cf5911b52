//! Mixer of up to three textures into one signal at the model's sample rate, one tick at a time.

use crate::contact::{Contact, Place};
use crate::noise::{Gaussian, Noise};
use crate::relief::{Passage, ReliefVoice};
use crate::texture::Texture;
use crate::voice::{MAX_TICK, Voice};

/// Longest control tick, in seconds.
pub const TICK_SECS: f32 = 0.005;
/// Duration of a fade of weights, textures or blend, in seconds.
pub const FADE_SECS: f32 = 0.02;
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

#[derive(Clone, Debug)]
struct Slot {
    id: Option<TextureId>,
    voice: Voice,
    relief: ReliefVoice,
    noise: Noise,
    hint: u16,
    weight: f32,
    target: f32,
    step: f32,
    level: f32,
}

/// Mixer of textures. Its output is in m/s² at the sample rate of the textures, which must all share that rate.
#[derive(Clone, Debug)]
pub struct Renderer {
    seed: u64,
    tick_len: usize,
    fade_ticks: f32,
    gaussian: Gaussian,
    shared_noise: Noise,
    slots: [Slot; MAX_VOICES],
    blend: Blend,
    /// Fade of the power compensation, 0..1.
    compensation: f32,
    makeup: f32,
    /// Tip displacement in the last tick.
    passage: Passage,
}

impl Renderer {
    /// A silent renderer at `rate_hz` with noise determined by `seed`. The rate is clamped to 200..4000 Hz; a
    /// non-finite rate becomes 1000 Hz.
    pub fn new(rate_hz: f32, seed: u64) -> Self {
        let rate_hz = if rate_hz.is_finite() { rate_hz.clamp(200.0, 4000.0) } else { 1000.0 };
        let tick_len = ((rate_hz * TICK_SECS) as usize).clamp(1, MAX_TICK);
        let slot = Slot {
            id: None,
            voice: Voice::new(),
            relief: ReliefVoice::new(rate_hz),
            noise: Noise::new(seed),
            hint: 0,
            weight: 0.0,
            target: 0.0,
            step: 0.0,
            level: 0.0,
        };
        Self {
            seed,
            tick_len,
            fade_ticks: (FADE_SECS * rate_hz / tick_len as f32).max(1.0),
            gaussian: Gaussian::new(),
            shared_noise: Noise::new(seed ^ 0x5EED_0FA1_15EE_D0FA),
            slots: core::array::from_fn(|_| slot.clone()),
            blend: Blend::Power,
            compensation: 1.0,
            makeup: 1.0,
            passage: Passage::default(),
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
                slot.target = mix.weight_of(id);
                slot.step = (slot.target - slot.weight) / self.fade_ticks;
            }
        }
        for parent in mix.parents.iter().filter(|p| p.weight > 0.0) {
            if !is_new(&self.slots, parent.id) {
                continue;
            }
            let seed = self.seed ^ (u64::from(parent.id) + 1).wrapping_mul(0xD1B5_4A32_D192_ED03);
            let Some(slot) = self.slots.iter_mut().find(|s| s.id.is_none()) else { break };
            slot.id = Some(parent.id);
            slot.voice.reset();
            slot.relief.reset();
            slot.noise = Noise::new(seed);
            slot.hint = 0;
            slot.weight = 0.0;
            slot.target = mix.weight_of(parent.id);
            slot.step = slot.target / self.fade_ticks;
        }
        self.blend = mix.blend;
        true
    }

    /// Completes all fades at once, for a render that starts in the middle of a stroke.
    pub fn finish_fades(&mut self) {
        for slot in &mut self.slots {
            slot.weight = slot.target;
            slot.step = 0.0;
            if slot.target == 0.0 {
                slot.id = None;
            }
        }
        self.compensation = if self.blend == Blend::Power { 1.0 } else { 0.0 };
    }

    /// Clears the state of all filters, so that they no longer oscillate. Fades and noise continue.
    pub fn silence(&mut self) {
        for slot in &mut self.slots {
            slot.voice.clear_memory();
            slot.relief.reset();
        }
    }

    /// Whether a voice of texture `id` is active, including fades.
    pub fn is_sounding(&self, id: TextureId) -> bool {
        self.slots.iter().any(|s| s.id == Some(id))
    }

    /// Renders one tick that ends at `contact` and `place`. Overwrites the first [`Renderer::tick_len`] samples of
    /// `out`.
    ///
    /// A texture that its owner no longer has is silent. Cost: at most [`MAX_VOICES`] voices.
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
        self.passage = self.passage.on(place, contact.sanitized().force_n);
        let (mut starts, mut reliefs) = ([0.0; MAX_VOICES], [None; MAX_VOICES]);
        for ((slot, start), relief) in self.slots.iter_mut().zip(&mut starts).zip(&mut reliefs) {
            *start = slot.weight;
            let Some(id) = slot.id else { continue };
            slot.weight = approach(slot.weight, slot.target, slot.step);
            if let Some(texture) = textures.texture(id) {
                let at = texture.evaluate(contact, &mut slot.hint);
                slot.level = at.level_mps2;
                slot.voice.aim(texture.order(), &at);
                *relief = texture.relief();
            } else {
                slot.weight = 0.0;
                slot.target = 0.0;
            }
        }
        let makeup_before = self.makeup;
        self.makeup = self.next_makeup();
        for ((slot, start), relief) in self.slots.iter_mut().zip(starts).zip(reliefs) {
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
            slot.voice.add_tick(noise, (start * makeup_before, slot.weight * self.makeup), out);
            // Relief signals are coherent, because they depend on position only; their sum needs no power compensation.
            match relief {
                Some(relief) => {
                    slot.relief.add_tick(&relief, &self.passage, (start, slot.weight), out);
                }
                None => slot.relief.reset(),
            }
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
