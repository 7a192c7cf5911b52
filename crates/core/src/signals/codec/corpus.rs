//! Training and test signals of the codec: textures rendered as acceleration at a stylus.

use super::CODEC_RATE;
use crate::dsp::filter::resample;
use crate::texture::TextureModel;
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;
use crate::texture::render::{RenderError, RenderPlan, render};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Stroke conditions: slow and light, medium, fast and firm.
pub const CONTACTS: [Contact; 3] = [
    Contact { speed: MetersPerSecond(0.06), force: Newtons(0.4) },
    Contact { speed: MetersPerSecond(0.12), force: Newtons(1.0) },
    Contact { speed: MetersPerSecond(0.20), force: Newtons(1.6) },
];
/// One of this many textures of a library is held out of training.
const HELD_OUT_EVERY: usize = 3;

/// Returns whether the starter library texture at this index is held out, so that results on it are out-of-sample.
pub fn is_held_out(index: usize) -> bool {
    index % HELD_OUT_EVERY == HELD_OUT_EVERY - 1
}

/// Returns `seconds` of acceleration of a texture at one speed and force, in m/s² at [`CODEC_RATE`].
///
/// # Errors
/// [`RenderError`] if the texture cannot be rendered.
pub fn signal(
    model: &TextureModel,
    contact: Contact,
    seconds: f64,
    seed: u64,
) -> Result<Vec<f64>, RenderError> {
    let rate = Hertz(model.rate().0.max(CODEC_RATE.0));
    let felt = rendered(model, contact, rate, seconds, seed)?;
    Ok(resample(&felt, rate, CODEC_RATE))
}

/// Returns a signal as [`signal`] does, but sped up so that it fills the band of the codec.
///
/// Models with a lower rate leave the upper band empty, unlike recordings. `None` if the model fills the band already.
///
/// # Errors
/// [`RenderError`] if the texture cannot be rendered.
pub fn quickened(
    model: &TextureModel,
    contact: Contact,
    seconds: f64,
    seed: u64,
) -> Result<Option<Vec<f64>>, RenderError> {
    let rate = model.rate();
    if rate.0 >= CODEC_RATE.0 {
        return Ok(None);
    }
    rendered(model, contact, rate, seconds * CODEC_RATE.0 / rate.0, seed).map(Some)
}

fn rendered(
    model: &TextureModel,
    contact: Contact,
    rate: Hertz,
    seconds: f64,
    seed: u64,
) -> Result<Vec<f64>, RenderError> {
    let prepared = Plane::new(model).prepare();
    let plan = RenderPlan { parents: &[(&prepared, 1.0)], mode: Mode::default(), rate, seconds, seed };
    Ok(render(&plan, &mut |_: f64| contact)?.into_iter().map(f64::from).collect())
}
