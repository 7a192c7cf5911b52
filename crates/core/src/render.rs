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
        Mode::Shared => Blend::Shared,
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
        Some((first, _)) if n <= 3 => first.rate_hz,
        _ => return Err(RenderError::Parents { n }),
    };
    if let Some((other, _)) = plan.parents.iter().find(|(p, _)| p.rate_hz != first_hz) {
        return Err(RenderError::Rates { first_hz, other_hz: other.rate_hz });
    }
    if !(plan.rate.0 >= f64::from(first_hz) && plan.rate.0 <= 768_000.0) {
        return Err(RenderError::Rate { rate_hz: plan.rate.0, lowest_hz: first_hz });
    }
    if !(0.0..=3600.0).contains(&plan.seconds) {
        return Err(RenderError::Length { seconds: plan.seconds });
    }
    let mut mix = Mix { blend: synth_blend(plan.mode), ..Mix::default() };
    for (i, (_, weight)) in plan.parents.iter().enumerate() {
        mix.parents[i] = Parent { id: i as TextureId, weight: *weight as f32 };
    }
    let n_frames = (plan.seconds * plan.rate.0).round() as usize;
    let lent = Lent(plan.parents);
    Ok(if plan.rate.0 == f64::from(first_hz) {
        at_model_rate(&lent, &mix, first_hz, plan.seed, n_frames, contact_at)
    } else {
        resampled(&lent, &mix, first_hz, plan, n_frames, contact_at)
    })
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
mod tests {
    use super::{RenderError, RenderPlan, render};
    use crate::ar::{comparison_frequencies, from_resonances};
    use crate::blend::{Mode, mixture_psd};
    use crate::lsf::lsf_from_ar;
    use crate::plane::{Plane, Prepared};
    use crate::spectrum::welch;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

    fn plane(low_hz: f64, level: f64) -> Plane {
        let mut nodes = Vec::new();
        for v in [0.05, 0.1, 0.2] {
            for f in [0.5, 1.0] {
                let ar = from_resonances(Hertz(1000.0), &[(Hertz(low_hz), 0.9), (Hertz(300.0), 0.8)]);
                nodes.push(GrainNode {
                    speed: MetersPerSecond(v),
                    force: Newtons(f),
                    lsf: lsf_from_ar(&ar).unwrap(),
                    level_mps2: level * v * 10.0,
                });
            }
        }
        Plane::new(&TextureModel::new(Hertz(1000.0), nodes, None).unwrap())
    }

    fn steady(_: f64) -> Contact {
        Contact::from_mm_per_s_and_n(80.0, 0.7)
    }

    /// Rendered signals have the spectra that the formulas say, in every mode and at any output rate.
    #[test]
    fn rendered_spectrum_is_the_models() {
        let planes = [plane(60.0, 0.5), plane(110.0, 1.0), plane(160.0, 2.0)];
        let prepared: Vec<Prepared> = planes.iter().map(Plane::prepare).collect();
        let weights = [0.3, 0.4, 0.3];
        let parents: Vec<(&Prepared, f64)> = prepared.iter().zip(weights).collect();
        let by_plane: Vec<(&Plane, f64)> = planes.iter().zip(weights).collect();
        for mode in Mode::ALL {
            for rate in [1000.0, 8000.0] {
                let plan = RenderPlan { parents: &parents, mode, rate: Hertz(rate), seconds: 120.0, seed: 5 };
                let x = render(&plan, &mut steady).unwrap();
                let wide: Vec<f64> = x.iter().map(|v| f64::from(*v)).collect();
                let estimate = welch(&wide, Hertz(rate), (rate * 0.256) as usize);
                // Third-octave-like groups of bins: 30..60, 60..120, 120..240, 240..440 Hz.
                for (low, high) in [(30.0, 60.0), (60.0, 120.0), (120.0, 240.0), (240.0, 440.0)] {
                    let bins: Vec<(Hertz, f64)> =
                        estimate.iter().copied().filter(|(f, _)| f.0 >= low && f.0 < high).collect();
                    let f: Vec<Hertz> = bins.iter().map(|b| b.0).collect();
                    let model: f64 = mixture_psd(&by_plane, mode, steady(0.0), &f).iter().sum();
                    let error_db = 10.0 * (bins.iter().map(|b| b.1).sum::<f64>() / model).log10();
                    // 120 s in at least 30 Hz: a standard error of 0.07 dB; the window leaks a little more.
                    assert!(
                        error_db.abs() < 0.4,
                        "{mode:?} at {rate}: {low}..{high} Hz off by {error_db} dB"
                    );
                }
            }
        }
        assert_eq!(comparison_frequencies(Hertz(1000.0), 256).len(), 256);
    }

    #[test]
    fn a_lifted_tip_is_silent_and_the_same_seed_repeats() {
        let prepared = plane(80.0, 1.0).prepare();
        let parents = [(&prepared, 1.0)];
        let plan =
            RenderPlan { parents: &parents, mode: Mode::Shared, rate: Hertz(1000.0), seconds: 1.0, seed: 1 };
        let mut lifts = |t: f64| if t < 0.5 { steady(t) } else { Contact::default() };
        let a = render(&plan, &mut lifts).unwrap();
        assert_eq!(a, render(&plan, &mut lifts).unwrap());
        let rms = |x: &[f32]| (x.iter().map(|v| v * v).sum::<f32>() / x.len() as f32).sqrt();
        assert!(rms(&a[..500]) > 0.1);
        assert!(a[600..].iter().all(|v| v.abs() < 1e-3), "rings for more than 0.1 s");
    }

    #[test]
    fn bad_plans_are_named() {
        let prepared = plane(80.0, 1.0).prepare();
        let parents = [(&prepared, 1.0)];
        let plan =
            RenderPlan { parents: &parents, mode: Mode::Power, rate: Hertz(1000.0), seconds: 1.0, seed: 1 };
        let error = |plan: RenderPlan<'_>| render(&plan, &mut steady).unwrap_err();
        assert_eq!(error(RenderPlan { parents: &[], ..plan }), RenderError::Parents { n: 0 });
        let low = RenderError::Rate { rate_hz: 500.0, lowest_hz: 1000.0 };
        assert_eq!(error(RenderPlan { rate: Hertz(500.0), ..plan }), low);
        assert_eq!(error(RenderPlan { seconds: -1.0, ..plan }), RenderError::Length { seconds: -1.0 });
        assert!(matches!(error(RenderPlan { seconds: f64::NAN, ..plan }), RenderError::Length { .. }));
    }
}
