//! Signals to learn from and to be measured on: textures as a stylus would feel them.

use super::CODEC_RATE;
use crate::blend::Mode;
use crate::filter::resample;
use crate::plane::Plane;
use crate::render::{RenderError, RenderPlan, render};
use crate::texture::TextureModel;
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// What the textures are stroked with: slow and light, as usual, fast and firm.
pub const CONTACTS: [Contact; 3] = [
    Contact { speed: MetersPerSecond(0.06), force: Newtons(0.4) },
    Contact { speed: MetersPerSecond(0.12), force: Newtons(1.0) },
    Contact { speed: MetersPerSecond(0.20), force: Newtons(1.6) },
];
/// Of this many textures of a library one is left out of training.
const HELD_OUT_EVERY: usize = 3;

/// Whether the texture at this place of the starter library went into no table: what is measured on it was not learnt.
pub fn is_held_out(index: usize) -> bool {
    index % HELD_OUT_EVERY == HELD_OUT_EVERY - 1
}

/// The acceleration in m/s² at [`CODEC_RATE`] of a texture under one contact, so many seconds of it.
///
/// # Errors
/// See [`RenderError`].
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

/// The same as if everything in it were so fast that it fills the band of the codec: models of lower rates leave its upper
/// part empty, recordings do not. `None` where the model fills it anyway.
///
/// # Errors
/// See [`RenderError`].
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
