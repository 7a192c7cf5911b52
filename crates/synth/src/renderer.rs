//! Up to three textures mixed into one signal at the model's rate, a tick at a time.

use crate::contact::Contact;
use crate::noise::{Gaussian, Noise};
use crate::texture::Texture;
use crate::voice::{MAX_TICK, Voice};

/// Longest control tick, in seconds.
pub const TICK_SECS: f32 = 0.005;
/// How long any change of weight, texture or blend takes, in seconds.
pub const FADE_SECS: f32 = 0.02;
/// Most textures in a mix.
pub const MAX_PARENTS: usize = 3;
/// Voices that may sound at once: those of the mix, and those on their way out.
pub const MAX_VOICES: usize = 8;

/// Where a texture lies in the owner's table.
pub type TextureId = u16;

/// The owner of the prepared textures, who keeps each one while [`Renderer::is_sounding`] says that it is in use.
pub trait Textures {
    /// The texture at `id`, if there is one.
    fn texture(&self, id: TextureId) -> Option<Texture<'_>>;
}

/// How the voices of a mix become one signal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Blend {
    /// `Σ w_i s_i` of independent signals, as printed in the paper: level sinks between textures.
    Paper,
    /// The same, times `Σ w_i σ_i / sqrt(Σ w_i² σ_i²)`, so that the level is the weighted mean of the levels.
    #[default]
    Power,
    /// `Σ w_i s_i` of signals that share one excitation.
    Shared,
}

/// One texture of a mix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parent {
    /// Which texture.
    pub id: TextureId,
    /// Its weight, 0..1.
    pub weight: f32,
}

/// What should sound: a `Copy` struct, since parents, weights and blend must agree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mix {
    /// The textures, each at most once; a weight of zero is no texture.
    pub parents: [Parent; MAX_PARENTS],
    /// How they are mixed.
    pub blend: Blend,
}

impl Mix {
    /// One texture alone.
    pub fn solo(id: TextureId) -> Self {
        let mut mix = Self::default();
        mix.parents[0] = Parent { id, weight: 1.0 };
        mix
    }

    /// The weight of `id`, summed over its entries; zero where it is not in the mix.
    fn weight_of(&self, id: TextureId) -> f32 {
        let of_id = self.parents.iter().filter(|p| p.id == id && p.weight > 0.0);
        of_id.map(|p| p.weight).sum()
    }
}

#[derive(Clone, Debug)]
struct Slot {
    id: Option<TextureId>,
    voice: Voice,
    noise: Noise,
    hint: u16,
    weight: f32,
    target: f32,
    step: f32,
    level: f32,
}

/// The mixer. Its output is in m/s² at the rate of the textures, all of which must share that rate.
#[derive(Clone, Debug)]
pub struct Renderer {
    seed: u64,
    tick_len: usize,
    fade_ticks: f32,
    gaussian: Gaussian,
    shared_noise: Noise,
    slots: [Slot; MAX_VOICES],
    blend: Blend,
    /// How far the power compensation is switched on, 0..1.
    compensation: f32,
    makeup: f32,
}

impl Renderer {
    /// A silent renderer at `rate_hz` (200 to 4000; anything else is pulled there) whose noise depends on `seed`.
    pub fn new(rate_hz: f32, seed: u64) -> Self {
        let rate_hz = if rate_hz.is_finite() { rate_hz.clamp(200.0, 4000.0) } else { 1000.0 };
        let tick_len = ((rate_hz * TICK_SECS) as usize).clamp(1, MAX_TICK);
        let slot = Slot {
            id: None,
            voice: Voice::new(),
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
        }
    }

    /// Model samples in a tick.
    pub fn tick_len(&self) -> usize {
        self.tick_len
    }

    /// Starts to fade to `mix`. Voices of textures that stay keep sounding; the others fade out.
    ///
    /// Returns false, having changed nothing, while too many voices are still fading: offer the newest mix again
    /// after the next tick. At most `FADE_SECS` later it is taken.
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
            slot.noise = Noise::new(seed);
            slot.hint = 0;
            slot.weight = 0.0;
            slot.target = mix.weight_of(parent.id);
            slot.step = slot.target / self.fade_ticks;
        }
        self.blend = mix.blend;
        true
    }

    /// Ends every fade at once: for a render that starts in the middle of a stroke.
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

    /// Whether a voice of texture `id` is sounding or fading.
    pub fn is_sounding(&self, id: TextureId) -> bool {
        self.slots.iter().any(|s| s.id == Some(id))
    }

    /// Renders one tick that ends at `contact` into `out`, of which [`Renderer::tick_len`] samples are overwritten.
    ///
    /// A texture that the owner no longer has is silent. Cost: bounded by [`MAX_VOICES`] voices.
    pub fn tick(&mut self, textures: &dyn Textures, contact: Contact, out: &mut [f32]) {
        let n = self.tick_len.min(out.len());
        let out = &mut out[..n];
        out.fill(0.0);
        let mut shared = [0.0; MAX_TICK];
        if self.blend == Blend::Shared {
            for e in &mut shared[..n] {
                *e = self.gaussian.draw(&mut self.shared_noise);
            }
        }
        let mut starts = [0.0; MAX_VOICES];
        for (slot, start) in self.slots.iter_mut().zip(&mut starts) {
            *start = slot.weight;
            let Some(id) = slot.id else { continue };
            slot.weight = approach(slot.weight, slot.target, slot.step);
            if let Some(texture) = textures.texture(id) {
                let at = texture.evaluate(contact, &mut slot.hint);
                slot.level = at.level_mps2;
                slot.voice.aim(texture.order(), &at);
            } else {
                slot.weight = 0.0;
                slot.target = 0.0;
            }
        }
        let makeup_before = self.makeup;
        self.makeup = self.next_makeup();
        for (slot, start) in self.slots.iter_mut().zip(starts) {
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
            if slot.weight == 0.0 && slot.target == 0.0 {
                slot.id = None;
            }
        }
    }

    /// The gain that makes up for the loss of independent signals, faded in and out with the blend.
    fn next_makeup(&mut self) -> f32 {
        let target = if self.blend == Blend::Power { 1.0 } else { 0.0 };
        self.compensation =
            approach(self.compensation, target, (target - self.compensation).signum() / self.fade_ticks);
        let sounding = self.slots.iter().filter(|s| s.id.is_some());
        let (sum, squares) = sounding.fold((0.0_f32, 0.0_f32), |(sum, squares), s| {
            let part = s.weight * s.level;
            (sum + part, squares + part * part)
        });
        // Between 1 and sqrt(MAX_VOICES) by Cauchy and Schwarz; without any level there is nothing to make up for.
        let full = if squares > f32::MIN_POSITIVE { sum / libm::sqrtf(squares) } else { 1.0 };
        1.0 + self.compensation * (full - 1.0)
    }
}

/// `from` moved by `step` towards `to`, not past it.
fn approach(from: f32, to: f32, step: f32) -> f32 {
    let next = from + step;
    if (step >= 0.0 && next >= to) || (step <= 0.0 && next <= to) { to } else { next }
}

#[cfg(test)]
pub(crate) mod tests {
    extern crate std;
    use super::{Blend, MAX_VOICES, Mix, Parent, Renderer, TextureId, Textures};
    use crate::contact::Contact;
    use crate::texture::tests::square;
    use crate::texture::{Node, Texture, Triangle};
    use std::vec::Vec;

    /// Any number of textures, alike but for their level at full speed and force.
    pub(crate) struct Table(Vec<([Node; 4], [Triangle; 2])>);

    impl Table {
        pub(crate) fn with_levels(levels: &[f32]) -> Self {
            Self(
                levels
                    .iter()
                    .map(|&level| {
                        let (mut nodes, mut triangles) = square();
                        nodes[2].level_mps2 = level;
                        // White: frequencies evenly spread make a predictor of zeros, with a gain of one.
                        for node in &mut nodes {
                            (node.lsf[0], node.lsf[1]) =
                                (core::f32::consts::PI / 3.0, core::f32::consts::PI * 2.0 / 3.0);
                        }
                        for triangle in &mut triangles {
                            triangle.ln_gain = [0.0; 6];
                        }
                        (nodes, triangles)
                    })
                    .collect(),
            )
        }
    }

    impl Textures for Table {
        fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
            let (nodes, triangles) = self.0.get(usize::from(id))?;
            Texture::new(1000.0, 2, 1.0, 1.0, nodes, triangles).ok()
        }
    }

    pub(crate) const FULL: Contact = Contact { speed_mps: 1.0, force_n: 1.0 };

    fn mix(weights: &[f32], blend: Blend) -> Mix {
        let mut mix = Mix { blend, ..Mix::default() };
        for (i, &weight) in weights.iter().enumerate() {
            mix.parents[i] = Parent { id: i as TextureId, weight };
        }
        mix
    }

    fn render(renderer: &mut Renderer, table: &Table, n: usize) -> Vec<f32> {
        let mut out = std::vec![0.0; n];
        for tick in out.chunks_mut(renderer.tick_len()) {
            renderer.tick(table, FULL, tick);
        }
        out
    }

    fn rms(x: &[f32]) -> f64 {
        (x.iter().map(|v| f64::from(*v).powi(2)).sum::<f64>() / x.len() as f64).sqrt()
    }

    #[test]
    fn blends_have_the_levels_of_their_formulas() {
        let table = Table::with_levels(&[0.5, 1.0, 2.0]);
        let (w, s) = ([0.3_f64, 0.4, 0.3], [0.5, 1.0, 2.0]);
        let sum: f64 = w.iter().zip(&s).map(|(w, s)| w * s).sum();
        let independent = w.iter().zip(&s).map(|(w, s)| (w * s).powi(2)).sum::<f64>().sqrt();
        // These three have one spectrum, so a shared excitation adds them fully in phase.
        for (blend, expected) in [(Blend::Paper, independent), (Blend::Power, sum), (Blend::Shared, sum)] {
            let mut renderer = Renderer::new(1000.0, 3);
            assert!(renderer.set_mix(&mix(&[0.3, 0.4, 0.3], blend)));
            renderer.finish_fades();
            let level = rms(&render(&mut renderer, &table, 200_000)[1000..]);
            // Five standard errors of the level of 200,000 white samples.
            assert!(
                (level / expected - 1.0).abs() < 5.0 / (2.0 * 200_000_f64).sqrt(),
                "{blend:?}: {level} {expected}"
            );
        }
    }

    #[test]
    fn a_change_never_jumps() {
        // One loud and one quiet texture of slow noise stand in: with white noise a jump could not be told from noise,
        // so the envelope is what is looked at: weights move by at most a tick's share of a fade.
        let table = Table::with_levels(&[1.0, 1.0, 1.0, 1.0]);
        let mut renderer = Renderer::new(1000.0, 3);
        assert!(renderer.set_mix(&Mix::solo(0)));
        let _ = render(&mut renderer, &table, 100);
        assert!(renderer.set_mix(&Mix::solo(1)));
        let mut last = 1.0;
        for _ in 0..6 {
            let _ = render(&mut renderer, &table, 5);
            let weight = renderer.slots.iter().find(|s| s.id == Some(0)).map_or(0.0, |s| s.weight);
            assert!(weight <= last && last - weight <= 0.2501, "{last} to {weight}");
            last = weight;
        }
        assert_eq!(last, 0.0);
        assert!(!renderer.is_sounding(0) && renderer.is_sounding(1));
    }

    #[test]
    fn a_texture_that_stays_is_not_restarted() {
        let table = Table::with_levels(&[1.0, 1.0, 1.0]);
        let run = |change: bool| {
            let mut renderer = Renderer::new(1000.0, 9);
            assert!(renderer.set_mix(&mix(&[1.0], Blend::Paper)));
            renderer.finish_fades();
            let _ = render(&mut renderer, &table, 100);
            if change {
                assert!(renderer.set_mix(&mix(&[1.0, 0.0], Blend::Paper)));
            }
            render(&mut renderer, &table, 100)
        };
        assert_eq!(run(false), run(true));
    }

    #[test]
    fn more_changes_than_voices_are_held_back_and_then_taken() {
        let table = Table::with_levels(&[1.0; 20]);
        let mut renderer = Renderer::new(1000.0, 1);
        let mut refused = 0;
        for id in 0..20 {
            while !renderer.set_mix(&Mix::solo(id)) {
                refused += 1;
                let _ = render(&mut renderer, &table, 5);
                assert!(refused < 100, "never taken");
            }
        }
        assert!(refused > 0, "twenty textures fit into {MAX_VOICES} voices at once");
        assert!(renderer.is_sounding(19));
    }

    #[test]
    fn silence_where_there_is_no_contact_or_no_texture() {
        let table = Table::with_levels(&[1.0]);
        let mut renderer = Renderer::new(1000.0, 1);
        assert!(renderer.set_mix(&Mix::solo(7)));
        assert!(render(&mut renderer, &table, 50).iter().all(|&x| x == 0.0));
        assert!(renderer.set_mix(&Mix::solo(0)));
        let mut out = [1.0; 5];
        for _ in 0..10 {
            renderer.tick(&table, Contact::LIFTED, &mut out);
            assert_eq!(out, [0.0; 5]);
        }
    }
}
