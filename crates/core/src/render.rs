//! Offline rendering: what a stylus would feel, as samples.

use shagreen_synth::contact::{Contact as SynthContact, ContactSource};
use shagreen_synth::renderer::{Blend, Mix, Parent, Renderer, TextureId, Textures};
use shagreen_synth::resampler::Resampler;
use shagreen_synth::stream::Stream;
use shagreen_synth::texture::Texture;
use shagreen_synth::voice::MAX_TICK;

use crate::blend::Mode;
use crate::plane::Prepared;
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

struct Lent<'a>(&'a [(&'a Prepared, f64)]);

impl Textures for Lent<'_> {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        self.0.get(usize::from(id)).map(|(prepared, _)| prepared.view())
    }
}

/// Contacts shifted by the warm-up: the hand holds its first contact until the first sample is kept.
struct Shifted<'a>(&'a mut dyn FnMut(f64) -> Contact, f64);

impl ContactSource for Shifted<'_> {
    fn contact_at(&mut self, time_secs: f64) -> SynthContact {
        let contact = self.0((time_secs - self.1).max(0.0));
        SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 }
    }
}

/// The acceleration in m/s² that a stylus moving as `contact_at` (time in seconds) would feel.
///
/// The output is not late: the delay of the resampler is taken out.
///
/// # Errors
/// See [`RenderError`].
pub fn render(
    plan: &RenderPlan<'_>,
    contact_at: &mut dyn FnMut(f64) -> Contact,
) -> Result<Vec<f32>, RenderError> {
    let n = plan.parents.len();
    let first_hz = match plan.parents.first() {
        Some((first, _)) if n <= 3 => first.rate_hz(),
        _ => return Err(RenderError::Parents { n }),
    };
    if let Some((other, _)) = plan.parents.iter().find(|(p, _)| p.rate_hz() != first_hz) {
        return Err(RenderError::Rates { first_hz, other_hz: other.rate_hz() });
    }
    if !(plan.rate.0 >= f64::from(first_hz) && plan.rate.0 <= 768_000.0) {
        return Err(RenderError::Rate { rate_hz: plan.rate.0, lowest_hz: first_hz });
    }
    if !(0.0..=3600.0).contains(&plan.seconds) {
        return Err(RenderError::Length { seconds: plan.seconds });
    }
    let mut mix = Mix::silent(synth_blend(plan.mode));
    for (i, (_, weight)) in plan.parents.iter().enumerate() {
        mix.parents[i] = Parent { id: i as TextureId, weight: *weight as f32 };
    }
    let n_frames = (plan.seconds * plan.rate.0).round() as usize;
    let lent = Lent(plan.parents);
    let samples = if plan.rate.0 == f64::from(first_hz) {
        at_model_rate(&lent, &mix, first_hz, plan.seed, n_frames, contact_at)
    } else {
        resampled(&lent, &mix, first_hz, plan, n_frames, contact_at)
    };
    match samples.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(RenderError::NotFinite { index, value: samples[index] }),
        None => Ok(samples),
    }
}

fn at_model_rate(
    lent: &Lent<'_>,
    mix: &Mix,
    rate_hz: f32,
    seed: u64,
    n_frames: usize,
    contact_at: &mut dyn FnMut(f64) -> Contact,
) -> Vec<f32> {
    let mut renderer = Renderer::new(rate_hz, seed);
    // A fresh renderer takes any mix.
    let _ = renderer.set_mix(mix);
    renderer.finish_fades();
    let tick_len = renderer.tick_len();
    let tick_secs = tick_len as f64 / f64::from(rate_hz);
    let n_warm = (WARM_UP_SECS / tick_secs).ceil();
    let mut contacts = Shifted(contact_at, n_warm * tick_secs);
    let mut tick = [0.0; MAX_TICK];
    let mut out = Vec::with_capacity(n_frames + tick_len);
    let mut tick_idx = 0.0;
    while out.len() < n_frames {
        tick_idx += 1.0;
        renderer.tick(lent, contacts.contact_at(tick_idx * tick_secs), &mut tick);
        if tick_idx > n_warm {
            out.extend_from_slice(&tick[..tick_len]);
        }
    }
    out.truncate(n_frames);
    out
}

fn resampled(
    lent: &Lent<'_>,
    mix: &Mix,
    model_rate_hz: f32,
    plan: &RenderPlan<'_>,
    n_frames: usize,
    contact_at: &mut dyn FnMut(f64) -> Contact,
) -> Vec<f32> {
    let mut stream = Stream::new(model_rate_hz, plan.rate.0 as f32, plan.seed);
    stream.set_mix(*mix);
    let delay_secs = f64::from(Resampler::delay_model_samples() / model_rate_hz);
    let n_warm = ((WARM_UP_SECS + delay_secs) * plan.rate.0).round() as usize;
    let mut contacts = Shifted(contact_at, WARM_UP_SECS);
    let mut out = vec![0.0; n_warm + n_frames];
    stream.process(lent, &mut contacts, &mut out);
    out.split_off(n_warm)
}

#[cfg(test)]
mod tests;
