//! Offline rendering: the acceleration at the stylus, as samples.

use shagreen_synth::contact::{Contact as SynthContact, ContactSource, Place};
use shagreen_synth::renderer::{Blend, FADE_SECS, MAX_PARENTS, Mix, Parent, Renderer, TextureId, Textures};
use shagreen_synth::resampler::Resampler;
use shagreen_synth::stream::Stream;
use shagreen_synth::texture::Texture;
use shagreen_synth::voice::MAX_TICK;

use crate::texture::blend::Mode;
use crate::texture::plane::Prepared;
use crate::units::{Contact, Hertz};

/// Warm-up time in seconds, rendered at the first contact and discarded. The impulse response of a predictor with
/// realistic poles lasts a tenth of it.
const WARM_UP_SECS: f64 = 0.5;

/// Settings for offline rendering.
#[derive(Clone, Copy, Debug)]
pub struct RenderPlan<'a> {
    /// Textures and weights, at most three.
    pub parents: &'a [(&'a Prepared, f64)],
    /// Interpolation mode.
    pub mode: Mode,
    /// Output sample rate, at least the model rate of the textures.
    pub rate: Hertz,
    /// Output duration in seconds.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// Error of offline rendering.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The number of prepared textures differs from the number of texture keys in a path.
    #[error("a path with {keys} textures needs {keys} prepared textures, got {n}")]
    Keys {
        /// Number of prepared textures.
        n: usize,
        /// Number of keys.
        keys: usize,
    },
    /// There are no parents, or more than three.
    #[error("rendering needs one to three parent textures, got {n}")]
    Parents {
        /// Number of parents.
        n: usize,
    },
    /// The parents have different model rates.
    #[error(
        "the parent textures have different model rates, {first_hz} and {other_hz} Hz; convert them to one rate"
    )]
    Rates {
        /// Model rate of the first parent, in Hz.
        first_hz: f32,
        /// Model rate that differs, in Hz.
        other_hz: f32,
    },
    /// The output rate is too low, too high or not finite.
    #[error(
        "the output sample rate must lie between {lowest_hz} Hz (the model rate) and 768000 Hz, got {rate_hz}"
    )]
    Rate {
        /// Requested rate, in Hz.
        rate_hz: f64,
        /// Lowest valid rate, in Hz.
        lowest_hz: f32,
    },
    /// A sample is not finite, because a predictor is unstable in `f32` or a weight is not finite.
    #[error(
        "the rendered signal is unstable: sample {index} is {value}; smooth the sharpest peaks of the texture's spectra"
    )]
    NotFinite {
        /// Index of the first such sample.
        index: usize,
        /// Value of the sample.
        value: f32,
    },
    /// The duration is negative, not finite, or longer than an hour.
    #[error("the duration must lie between 0 and 3600 seconds, got {seconds}")]
    Length {
        /// Requested duration in seconds.
        seconds: f64,
    },
}

/// Blend operation of the renderer for an interpolation mode.
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

/// Output settings after validation.
struct Output {
    model_rate_hz: f32,
    rate: Hertz,
    n_frames: usize,
    seed: u64,
}

/// A stroke: tip speed, normal force and tip position over time.
pub trait Hand {
    /// Speed and force at a time in s. Rendering calls this method with increasing times. Rendering a path first calls
    /// it for one pass over all times, and then starts again.
    fn contact_at(&mut self, time_secs: f64) -> Contact;

    /// Tip position on the pad at any time, to the right and upwards, in m. An implementation that returns `None` must
    /// always return `None`. The position then starts at (0, 0) and moves to the right by the distance that the tip
    /// travels, because a stroke without positions does not turn or reverse.
    fn place_m_at(&mut self, _time_secs: f64) -> Option<[f64; 2]> {
        None
    }
}

/// Stroke with speed and force only.
impl<F: FnMut(f64) -> Contact> Hand for F {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        self(time_secs)
    }
}

/// Time step in s for estimating the velocity at the start of the stroke.
const APPROACH_SECS: f64 = 0.005;

/// Stroke delayed by the warm-up: it holds its first contact until the first sample is kept.
struct Shifted<'a> {
    hand: &'a mut dyn Hand,
    warm_up_secs: f64,
    /// Time in s of the last contact since the warm-up, and its speed in m/s.
    last: (f64, f64),
    /// Current position to the right and upwards, in m.
    place_m: [f64; 2],
}

impl<'a> Shifted<'a> {
    fn new(hand: &'a mut dyn Hand, warm_up_secs: f64) -> Self {
        Self { hand, warm_up_secs, last: (0.0, 0.0), place_m: [0.0; 2] }
    }
}

impl ContactSource for Shifted<'_> {
    fn contact_at(&mut self, time_secs: f64) -> SynthContact {
        let secs = (time_secs - self.warm_up_secs).max(0.0);
        let contact = self.hand.contact_at(secs);
        let speed = if contact.speed.0.is_finite() { contact.speed.0.abs() } else { 0.0 };
        // The tip already moves during the warm-up, because a sudden start would be audible.
        let (is_ahead, ahead_secs) = (time_secs <= self.warm_up_secs, self.warm_up_secs - time_secs);
        self.place_m = match self.hand.place_m_at(secs) {
            Some(place_m) if is_ahead => {
                let next_m = self.hand.place_m_at(APPROACH_SECS).unwrap_or(place_m);
                [0, 1].map(|i| place_m[i] - ahead_secs * (next_m[i] - place_m[i]) / APPROACH_SECS)
            }
            Some(place_m) => place_m,
            None if is_ahead => [-speed * ahead_secs, 0.0],
            None => [self.place_m[0] + 0.5 * (self.last.1 + speed) * (secs - self.last.0), 0.0],
        };
        self.last = (secs, speed);
        contact.into()
    }

    fn place(&self) -> Place {
        Place { x_m: self.place_m[0], y_m: self.place_m[1], n_jumps: 0 }
    }
}

/// Renders the acceleration in m/s² at a stylus moved by `hand`.
///
/// The output has no latency: the resampler's delay is removed.
///
/// # Errors
/// See [`RenderError`].
pub fn render(plan: &RenderPlan<'_>, hand: &mut dyn Hand) -> Result<Vec<f32>, RenderError> {
    let n = plan.parents.len();
    if n == 0 || n > MAX_PARENTS {
        return Err(RenderError::Parents { n });
    }
    let mut mix = Mix::silent(synth_blend(plan.mode));
    for (i, (_, weight)) in plan.parents.iter().enumerate() {
        mix.parents[i] = Parent { id: i as TextureId, weight: *weight as f32 };
    }
    let varying = VaryingPlan {
        prepared: plan.parents.iter().map(|(prepared, _)| *prepared).collect(),
        rate: plan.rate,
        seconds: plan.seconds,
        seed: plan.seed,
    };
    render_varying(&varying, &mut |_| mix, hand)
}

/// Settings for rendering with a mix of textures that changes over time.
pub(crate) struct VaryingPlan<'a> {
    /// Textures, all with the same model rate; a mix identifies them by index.
    pub(crate) prepared: Vec<&'a Prepared>,
    /// Output sample rate, at least the model rate of the textures.
    pub(crate) rate: Hertz,
    /// Output duration in seconds.
    pub(crate) seconds: f64,
    /// Seed of all noise.
    pub(crate) seed: u64,
}

/// Renders the acceleration in m/s² with the mix that `mix_at` returns for each time in seconds.
///
/// # Errors
/// See [`RenderError`].
pub(crate) fn render_varying(
    plan: &VaryingPlan<'_>,
    mix_at: &mut dyn FnMut(f64) -> Mix,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let lent = Lent(plan.prepared.clone());
    let output = output(&lent, plan.rate, plan.seconds, plan.seed)?;
    rendered(&lent, &output, mix_at, hand)
}

/// Interval between mix updates in seconds, equal to the fade time, so that one fade ends when the next starts.
pub(crate) const MIX_STEP_SECS: f64 = FADE_SECS as f64;

/// Validates the output settings for these textures.
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
    // A new renderer accepts every mix.
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
            // If all voices are busy fading, the current mix continues until the next update.
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
