//! Channel for a display that renders friction: the level of friction over time, as the amplitude of a sine or as it is.
//!
//! The level is the kinetic coefficient of the mixed textures over [`FULL_FRICTION`], times its variation over place, and
//! zero while the tip is lifted. Both fade at a change of the mix. It is computed [`STEPS`] times in a tick of the vibration, is
//! linear in between, and is output with the delay of the vibration, so that both belong to the same tip position.

mod faded_mix;

use std::collections::VecDeque;
use std::f64::consts::TAU;

use shagreen_synth::contact::{Contact, ContactSource, Place};
use shagreen_synth::relief::Passage;
use shagreen_synth::renderer::{Mix, Textures};
use shagreen_synth::resampler::Resampler;
use shagreen_synth::stick_slip::MASS_KG;
use shagreen_synth::texture::Texture;

use super::FADE_SECS;
use super::meter::Ramp;
use crate::engine::friction_channel::faded_mix::FadedMix;

/// Kinetic friction coefficient at level 1.
pub const FULL_FRICTION: f32 = 1.0;
/// Amplitude of the carrier at level 1, as a fraction of full scale.
pub const FRICTION_CEILING: f32 = 0.9;
/// Lowest frequency of a carrier, in Hz.
pub const LEAST_CARRIER_HZ: f32 = 20.0;
/// Highest frequency of a carrier, as a fraction of the device's sample rate.
pub const CARRIER_SHARE: f32 = 0.45;
/// Highest kinetic coefficient that counts in a mean.
const HIGHEST_KINETIC: f32 = 100.0;
/// Time in s for which a tip may rest before the channel fades out. Friction is felt only in motion, and a pen whose last
/// report was lost must not leave the carrier on.
const REST_SECS: f64 = 1.0;
/// Positions within a tick at which the level is computed: one every quarter of a millisecond.
const STEPS: u32 = 20;
/// Levels that are kept: 64 ticks. A block of the engine has fewer ticks at device rates of 1 kHz or more; below, the level
/// lags.
const POINTS: usize = 64 * STEPS as usize;

/// Form in which the level of friction is output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionWave {
    /// The level itself, 0 to 1, for a receiver that renders it.
    Level,
    /// A sine whose amplitude is the level times [`FRICTION_CEILING`].
    Carrier {
        /// Frequency in Hz, from [`LEAST_CARRIER_HZ`] to [`CARRIER_SHARE`] of the device's sample rate.
        frequency_hz: f32,
    },
}

/// Channel that carries friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionConfig {
    /// Index of the device channel, counted from zero; it must not carry vibration.
    pub channel_idx: usize,
    /// Form of the level.
    pub wave: FrictionWave,
}

/// State of the channel.
#[derive(Debug)]
pub(super) struct FrictionChannel {
    config: FrictionConfig,
    rate_hz: f64,
    /// Delay of the vibration after the model's clock.
    delay_secs: f64,
    /// Kinetic coefficient, which fades at a change of the mix.
    kinetic: f32,
    /// Textures whose variation over place is felt, with weights that fade at a change of the mix.
    faded: FadedMix,
    /// Time in s since the tip moved.
    rested_secs: f64,
    /// 1 while the tip moves, fading to 0 while it rests.
    motion: f32,
    /// Tip displacement in the last tick.
    passage: Passage,
    /// Times on the stream's clock, and the levels there.
    points: VecDeque<(f64, f32)>,
    /// Phase of the carrier, 0..1.
    phase: f64,
    open: Ramp,
}

impl FrictionChannel {
    /// A silent channel of a device. `latency_secs` is the delay of the output stage.
    pub(super) fn new(
        config: FrictionConfig,
        (model_rate_hz, device_rate_hz): (f32, f32),
        latency_secs: f32,
    ) -> Self {
        let delay_secs = f64::from(Resampler::delay_model_samples() / model_rate_hz + latency_secs);
        let fade_frames = (FADE_SECS * f64::from(device_rate_hz)) as u32;
        let mut channel = Self {
            config,
            rate_hz: f64::from(device_rate_hz),
            delay_secs,
            kinetic: 0.0,
            faded: FadedMix::default(),
            rested_secs: 0.0,
            motion: 1.0,
            passage: Passage::default(),
            points: VecDeque::with_capacity(POINTS),
            phase: 0.0,
            open: Ramp::new(fade_frames),
        };
        channel.restart();
        channel
    }

    /// Index of the device channel.
    pub(super) fn channel_idx(&self) -> usize {
        self.config.channel_idx
    }

    /// Restarts the stream's clock at zero, with a level of zero.
    pub(super) fn restart(&mut self) {
        self.points.clear();
        self.points.push_back((0.0, 0.0));
    }

    /// Fades the channel in or out.
    pub(super) fn set_open(&mut self, is_open: bool) {
        self.open.aim(if is_open { 1.0 } else { 0.0 });
    }

    /// Fills a block that begins at a frame of the stream's clock.
    pub(super) fn fill(&mut self, first_frame: u64, out: &mut [f32]) {
        for (i, y) in out.iter_mut().enumerate() {
            let secs = (first_frame + i as u64) as f64 / self.rate_hz - self.delay_secs;
            let level = self.level_at(secs) * self.open.next();
            *y = match self.config.wave {
                FrictionWave::Level => level,
                FrictionWave::Carrier { frequency_hz } => {
                    self.phase = (self.phase + f64::from(frequency_hz) / self.rate_hz).fract();
                    FRICTION_CEILING * level * (TAU * self.phase).sin() as f32
                }
            };
        }
    }

    /// Computes the levels of the tick that ends at a time, a contact and a place.
    fn note(&mut self, time_secs: f64, end: (Contact, Place), textures: &dyn Textures, mix: &Mix) {
        let (contact, place) = end;
        self.passage = self.passage.on(place, contact.sanitized().force_n);
        let Passage { x_m, y_m, forces_n, .. } = self.passage;
        let from_secs = self.points.back().map_or(time_secs, |(secs, _)| *secs);
        let tick_secs = (time_secs - from_secs).max(0.0);
        let kinetic_before = self.kinetic;
        let fade = (1.0 - (-tick_secs / FADE_SECS).exp()) as f32;
        self.kinetic += fade * (mean_kinetic(textures, mix) - kinetic_before);
        self.faded.follow(mix, (tick_secs / FADE_SECS) as f32);
        let way_m = (x_m.1 - x_m.0).hypot(y_m.1 - y_m.0) / f64::from(STEPS);
        self.rested_secs = if way_m > 0.0 { 0.0 } else { self.rested_secs + tick_secs };
        let motion_before = self.motion;
        let is_moving = self.rested_secs < REST_SECS;
        self.motion += fade * (if is_moving { 1.0 } else { 0.0 } - motion_before);
        let touch = |force_n: f32| if force_n > 0.0 { 1.0 } else { 0.0 };
        let touches = (touch(forces_n.0), touch(forces_n.1));
        for step in 1..=STEPS {
            let done = f64::from(step) / f64::from(STEPS);
            let between = |from: f32, to: f32| from + done as f32 * (to - from);
            let place_m = [x_m, y_m].map(|(from_m, to_m)| from_m + done * (to_m - from_m));
            let touching = between(touches.0, touches.1) * between(motion_before, self.motion);
            let kinetic = between(kinetic_before, self.kinetic) * touching;
            let level = kinetic / FULL_FRICTION * self.mean_variation(textures, done as f32, place_m, way_m);
            // A number that is not finite is no level either.
            let level = if level > 0.0 { level.min(1.0) } else { 0.0 };
            if self.points.len() >= POINTS {
                self.points.pop_front();
            }
            self.points.push_back((from_secs + done * tick_secs, level));
        }
    }

    /// Weighted mean of the variation of friction over place after a share of the tick, at a position on the pad. What the
    /// weights lack of 1 has no variation, so that the variation of a texture fades with its weight; textures whose friction
    /// is unknown have no weight.
    fn mean_variation(&self, textures: &dyn Textures, done: f32, place_m: [f64; 2], way_m: f64) -> f32 {
        let parts = self.faded.weights_at(done).filter_map(|(id, weight)| {
            let texture = textures.texture(id)?;
            texture.friction()?;
            Some((weight, variation(&texture, place_m, way_m)))
        });
        let (weight, sum) = weight_and_sum(parts);
        let rest = (1.0 - weight).max(0.0);
        (sum + rest) / (weight + rest)
    }

    /// Level at a time of the stream's clock, which must not decrease between two calls.
    fn level_at(&mut self, secs: f64) -> f32 {
        while self.points.get(1).is_some_and(|(next_secs, _)| *next_secs <= secs) {
            self.points.pop_front();
        }
        match (self.points.front(), self.points.get(1)) {
            (Some(&(from_secs, from)), Some(&(to_secs, to))) if secs > from_secs => {
                from + ((secs - from_secs) / (to_secs - from_secs)) as f32 * (to - from)
            }
            (Some(&(_, level)), _) => level,
            (None, _) => 0.0,
        }
    }
}

/// Source of contacts that notes the friction at every contact that the stream asks for.
pub(super) struct Noting<'a> {
    pub(super) contacts: &'a mut dyn ContactSource,
    pub(super) textures: &'a dyn Textures,
    pub(super) mix: &'a Mix,
    pub(super) channel: &'a mut FrictionChannel,
}

impl ContactSource for Noting<'_> {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        let contact = self.contacts.contact_at(time_secs);
        self.channel.note(time_secs, (contact, self.contacts.place()), self.textures, self.mix);
        contact
    }

    fn place(&self) -> Place {
        self.contacts.place()
    }
}

/// Weighted mean of the kinetic coefficients of a mix; 0 if none is known.
fn mean_kinetic(textures: &dyn Textures, mix: &Mix) -> f32 {
    let known = mix.parents.iter().filter(|parent| parent.weight > 0.0);
    let parts = known.filter_map(|parent| {
        let friction = textures.texture(parent.id)?.friction()?;
        Some((parent.weight, friction.kinetic.min(HIGHEST_KINETIC)))
    });
    weighted_mean(parts).unwrap_or(0.0)
}

/// Mean of the values, each after its weight; `None` without a weight.
fn weighted_mean(parts: impl Iterator<Item = (f32, f32)>) -> Option<f32> {
    let (weight, sum) = weight_and_sum(parts);
    (weight > 0.0).then(|| sum / weight)
}

/// Sum of the weights, and sum of the values times their weights.
fn weight_and_sum(parts: impl Iterator<Item = (f32, f32)>) -> (f32, f32) {
    parts.fold((0.0, 0.0), |(total, sum), (weight, value)| (total + weight, sum + weight * value))
}

/// Normal force on the tip at a place over its mean, `1 + m a / F`: a tip of mass `m` that follows relief or height map is
/// accelerated by `a`, at the reference force `F` and speed. 1 for a texture without either. Detail that the tip passes
/// within two displacements of `way_m` is left out.
fn variation(texture: &Texture<'_>, [x_m, y_m]: [f64; 2], way_m: f64) -> f32 {
    if !texture.has_surface() {
        return 1.0;
    }
    let here = Passage::default().on(Place { x_m, y_m, n_jumps: 0 }, 1.0);
    let here = texture.passage(&here);
    let (x_m, y_m) = (here.x_m.1, here.y_m.1);
    let relief = texture.relief().map_or(0.0, |relief| relief.value_mps2(x_m, way_m) / relief.force_n());
    let height_map =
        texture.height_map().map_or(0.0, |map| map.mean_acceleration_mps2([x_m, y_m], way_m) / map.force_n());
    (1.0 + MASS_KG * (relief + height_map)).max(0.0)
}

#[cfg(test)]
mod tests;
