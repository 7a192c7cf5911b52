//! Offline rendering: what a stylus would feel, as samples.

use shagreen_synth::contact::{Contact as SynthContact, ContactSource, Place};
use shagreen_synth::renderer::{Blend, FADE_SECS, MAX_PARENTS, Mix, Parent, Renderer, TextureId, Textures};
use shagreen_synth::resampler::Resampler;
use shagreen_synth::stream::Stream;
use shagreen_synth::texture::Texture;
use shagreen_synth::voice::MAX_TICK;

use crate::blend::Mode;
use crate::plane::Prepared;
use crate::texture_path::{TexturePath, TraveledAhead};
use crate::units::{Contact, Hertz};

/// How long the textures sound under the first contact before the first sample is kept, in seconds: the memory of a
/// predictor with poles as sharp as real textures have is a tenth of this.
const WARM_UP_SECS: f64 = 0.5;

/// What to render.
#[derive(Clone, Copy, Debug)]
pub struct RenderPlan<'a> {
    /// Textures and weights, at most three.
    pub parents: &'a [(&'a Prepared, f64)],
    /// How they are mixed.
    pub mode: Mode,
    /// Rate of the output; at least that of the textures.
    pub rate: Hertz,
    /// Length of the output in seconds.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// Why a plan cannot be rendered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// Not one prepared texture for each key of a path.
    #[error("a path of {keys} textures was given {n} prepared ones")]
    Keys {
        /// The number given.
        n: usize,
        /// The number needed.
        keys: usize,
    },
    /// No parents, or more than three.
    #[error("a texture is rendered from one to three parents, got {n}")]
    Parents {
        /// The number given.
        n: usize,
    },
    /// Parents differ in rate.
    #[error("the parents have different model rates, {first_hz} and {other_hz} Hz")]
    Rates {
        /// Rate of the first parent.
        first_hz: f32,
        /// The one that differs.
        other_hz: f32,
    },
    /// The output rate is too low, or nonsense.
    #[error(
        "the output rate must be a number from {lowest_hz} Hz (the model's own) to 768000 Hz, got {rate_hz}"
    )]
    Rate {
        /// The rate asked for.
        rate_hz: f64,
        /// The lowest possible.
        lowest_hz: f32,
    },
    /// A sample is not a finite number: a predictor so sharp that `f32` makes it unstable, or weights that are no numbers.
    #[error(
        "the texture does not stay finite: sample {index} is {value}; smooth the sharpest peaks of its spectra"
    )]
    NotFinite {
        /// The first such sample.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// A length that is negative, not finite, or over an hour.
    #[error("the length must be between 0 and 3600 seconds, got {seconds}")]
    Length {
        /// The length asked for.
        seconds: f64,
    },
}

/// The blend of the renderer that a mode stands for.
pub fn synth_blend(mode: Mode) -> Blend {
    match mode {
        Mode::Paper => Blend::Paper,
        Mode::Power => Blend::Power,
        Mode::Shared | Mode::Parametric | Mode::Field => Blend::Shared,
    }
}

struct Lent<'a>(Vec<&'a Prepared>);

impl Textures for Lent<'_> {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        self.0.get(usize::from(id)).map(|prepared| prepared.view())
    }
}

/// What the output is like.
struct Output {
    model_rate_hz: f32,
    rate: Hertz,
    n_frames: usize,
    seed: u64,
}

/// What moves a tip.
pub trait Hand {
    /// Speed and force at a time in s. What is rendered asks forwards; a path is walked once before.
    fn contact_at(&mut self, time_secs: f64) -> Contact;

    /// Where the tip is along reliefs at any time, in m. A hand that says `None`, and says it always, is at their beginning first, and
    /// goes forwards: a stroke that tells no more than its speed does not turn.
    fn place_m_at(&mut self, _time_secs: f64) -> Option<f64> {
        None
    }
}

/// A hand that says how fast and how hard, and no more.
impl<F: FnMut(f64) -> Contact> Hand for F {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        self(time_secs)
    }
}

/// What is looked at to tell how fast a hand comes to its first place, in s.
const APPROACH_SECS: f64 = 0.005;

/// A hand shifted by the warm-up: it holds its first contact until the first sample is kept.
struct Shifted<'a> {
    hand: &'a mut dyn Hand,
    warm_up_secs: f64,
    /// Time in s of the last contact since the warm-up, and its speed in m/s.
    last: (f64, f64),
    /// How far the hand has come.
    place_m: f64,
}

impl<'a> Shifted<'a> {
    fn new(hand: &'a mut dyn Hand, warm_up_secs: f64) -> Self {
        Self { hand, warm_up_secs, last: (0.0, 0.0), place_m: 0.0 }
    }
}

impl ContactSource for Shifted<'_> {
    fn contact_at(&mut self, time_secs: f64) -> SynthContact {
        let secs = (time_secs - self.warm_up_secs).max(0.0);
        let contact = self.hand.contact_at(secs);
        let speed = if contact.speed.0.is_finite() { contact.speed.0.abs() } else { 0.0 };
        // On its way already: a tip that begins to move of a sudden would be heard to.
        let (is_ahead, ahead_secs) = (time_secs <= self.warm_up_secs, self.warm_up_secs - time_secs);
        self.place_m = match self.hand.place_m_at(secs) {
            Some(place_m) if is_ahead => {
                let next_m = self.hand.place_m_at(APPROACH_SECS).unwrap_or(place_m);
                place_m - ahead_secs * (next_m - place_m) / APPROACH_SECS
            }
            Some(place_m) => place_m,
            None if is_ahead => -speed * ahead_secs,
            None => self.place_m + 0.5 * (self.last.1 + speed) * (secs - self.last.0),
        };
        self.last = (secs, speed);
        SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 }
    }

    fn place(&self) -> Place {
        Place { x_m: self.place_m, n_jumps: 0 }
    }
}

/// The acceleration in m/s² that a stylus moved by `hand` would feel.
///
/// The output is not late: the delay of the resampler is taken out.
///
/// # Errors
/// See [`RenderError`].
pub fn render(plan: &RenderPlan<'_>, hand: &mut dyn Hand) -> Result<Vec<f32>, RenderError> {
    let n = plan.parents.len();
    if n == 0 || n > MAX_PARENTS {
        return Err(RenderError::Parents { n });
    }
    let lent = Lent(plan.parents.iter().map(|(prepared, _)| *prepared).collect());
    let mut mix = Mix::silent(synth_blend(plan.mode));
    for (i, (_, weight)) in plan.parents.iter().enumerate() {
        mix.parents[i] = Parent { id: i as TextureId, weight: *weight as f32 };
    }
    let output = output(&lent, plan.rate, plan.seconds, plan.seed)?;
    rendered(&lent, &output, &mut |_| mix, hand)
}

/// What to render of a path.
#[derive(Clone, Copy, Debug)]
pub struct PathPlan<'a> {
    /// The path.
    pub path: &'a TexturePath,
    /// Its textures, prepared, one for each key.
    pub prepared: &'a [Prepared],
    /// Rate of the output; at least that of the textures.
    pub rate: Hertz,
    /// Length of the output in seconds.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// The acceleration in m/s² that a stylus would feel on a texture that changes along its stroke; each landing begins a new
/// one.
///
/// # Errors
/// See [`RenderError`].
pub fn render_path(plan: &PathPlan<'_>, hand: &mut dyn Hand) -> Result<Vec<f32>, RenderError> {
    let keys = plan.path.keys().len();
    if plan.prepared.len() != keys {
        return Err(RenderError::Keys { n: plan.prepared.len(), keys });
    }
    let lent = Lent(plan.prepared.iter().collect());
    let output = output(&lent, plan.rate, plan.seconds, plan.seed)?;
    // Worked out ahead, since the mix and the contact are asked for by turns.
    let ahead =
        TraveledAhead::new(plan.path.along(), plan.seconds, MIX_STEP_SECS, &mut |secs| hand.contact_at(secs));
    let mut mix_at = |time_secs: f64| path_mix(plan.path, ahead.at(time_secs));
    rendered(&lent, &output, &mut mix_at, hand)
}

/// The mix of a path's textures, numbered as its keys, where so much was traveled.
pub fn path_mix(path: &TexturePath, traveled: f64) -> Mix {
    let (key, share) = path.between(traveled);
    let mut mix = Mix::silent(Blend::Shared);
    mix.parents[0] = Parent { id: key as TextureId, weight: 1.0 - share as f32 };
    if share > 0.0 {
        mix.parents[1] = Parent { id: key as TextureId + 1, weight: share as f32 };
    }
    mix
}

/// How long a mix stays: as long as a fade takes, so that one ends as the next begins.
const MIX_STEP_SECS: f64 = FADE_SECS as f64;

/// What the output is like, if it can be made of these textures.
fn output(lent: &Lent<'_>, rate: Hertz, seconds: f64, seed: u64) -> Result<Output, RenderError> {
    let Some(first_hz) = lent.0.first().map(|prepared| prepared.rate_hz()) else {
        return Err(RenderError::Parents { n: 0 });
    };
    if let Some(other) = lent.0.iter().find(|p| p.rate_hz() != first_hz) {
        return Err(RenderError::Rates { first_hz, other_hz: other.rate_hz() });
    }
    if !(rate.0 >= f64::from(first_hz) && rate.0 <= 768_000.0) {
        return Err(RenderError::Rate { rate_hz: rate.0, lowest_hz: first_hz });
    }
    if !(0.0..=3600.0).contains(&seconds) {
        return Err(RenderError::Length { seconds });
    }
    Ok(Output { model_rate_hz: first_hz, rate, n_frames: (seconds * rate.0).round() as usize, seed })
}

fn rendered(
    lent: &Lent<'_>,
    output: &Output,
    mix_at: &mut dyn FnMut(f64) -> Mix,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let samples = if output.rate.0 == f64::from(output.model_rate_hz) {
        at_model_rate(lent, output, mix_at, hand)
    } else {
        resampled(lent, output, mix_at, hand)
    };
    match samples.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(RenderError::NotFinite { index, value: samples[index] }),
        None => Ok(samples),
    }
}

fn at_model_rate(
    lent: &Lent<'_>,
    output: &Output,
    mix_at: &mut dyn FnMut(f64) -> Mix,
    hand: &mut dyn Hand,
) -> Vec<f32> {
    let mut renderer = Renderer::new(output.model_rate_hz, output.seed);
    // A fresh renderer takes any mix.
    let _ = renderer.set_mix(&mix_at(0.0));
    renderer.finish_fades();
    let tick_len = renderer.tick_len();
    let tick_secs = tick_len as f64 / f64::from(output.model_rate_hz);
    let n_warm = (WARM_UP_SECS / tick_secs).ceil();
    let ticks_a_mix = (MIX_STEP_SECS / tick_secs).round().max(1.0);
    let mut contacts = Shifted::new(hand, n_warm * tick_secs);
    let mut tick = [0.0; MAX_TICK];
    let mut out = Vec::with_capacity(output.n_frames + tick_len);
    let mut tick_idx = 0.0;
    while out.len() < output.n_frames {
        if tick_idx >= n_warm && (tick_idx - n_warm) % ticks_a_mix == 0.0 {
            // Busy with fading voices it keeps the mix that it has; the next one is not far.
            let _ = renderer.set_mix(&mix_at((tick_idx - n_warm) * tick_secs));
        }
        tick_idx += 1.0;
        let contact = contacts.contact_at(tick_idx * tick_secs);
        renderer.tick(lent, contact, contacts.place(), &mut tick);
        if tick_idx > n_warm {
            out.extend_from_slice(&tick[..tick_len]);
        }
    }
    out.truncate(output.n_frames);
    out
}

fn resampled(
    lent: &Lent<'_>,
    output: &Output,
    mix_at: &mut dyn FnMut(f64) -> Mix,
    hand: &mut dyn Hand,
) -> Vec<f32> {
    let mut stream = Stream::new(output.model_rate_hz, output.rate.0 as f32, output.seed);
    stream.set_mix(mix_at(0.0));
    let delay_secs = f64::from(Resampler::delay_model_samples() / output.model_rate_hz);
    let n_warm = ((WARM_UP_SECS + delay_secs) * output.rate.0).round() as usize;
    let mut contacts = Shifted::new(hand, WARM_UP_SECS);
    let mut out = vec![0.0; n_warm + output.n_frames];
    let (warm, kept) = out.split_at_mut(n_warm);
    stream.process(lent, &mut contacts, warm);
    let n_block = ((MIX_STEP_SECS * output.rate.0).round() as usize).max(1);
    for (i, block) in kept.chunks_mut(n_block).enumerate() {
        stream.set_mix(mix_at((i * n_block) as f64 / output.rate.0));
        stream.process(lent, &mut contacts, block);
    }
    out.split_off(n_warm)
}

#[cfg(test)]
mod tests;
