//! Check that spectral distances of rendered signals agree with those of the models.

use crate::maths::rng::derive_seed;
use crate::maths::statistics::mean;
use crate::space::fidelity::{Channels, Profile, chance_db, conditions, error_db};
use crate::space::leave_one_out::rest::{Made, Placed};
use crate::space::leave_one_out::{SignalCheck, SignalPlan};
use crate::texture::plane::Prepared;
use crate::texture::render::{RenderError, RenderPlan, render};
use crate::units::Hertz;

/// Spectral distances of one rendered texture.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_field_names, reason = "the unit comes last, and all have the same")]
pub(super) struct Rendered {
    /// Distance between the signals of interpolated and original texture, in dB.
    pub(super) error_db: f64,
    /// Distance between their models, in dB.
    pub(super) model_error_db: f64,
    /// Distance between the interpolated signal and its own model, in dB.
    pub(super) from_model_db: f64,
}

/// Renders the original and every predicted texture and compares the signals. `authored` holds the profiles of `made`.
pub(super) fn compare(
    plan: &SignalPlan,
    original: &Placed,
    original_profile: &Profile,
    made: &[Made],
    authored: &[Profile],
) -> Result<Vec<Rendered>, RenderError> {
    let seed_of = |what: &str| derive_seed(plan.seed, &format!("{} {what}", original.texture));
    let heard = profile(&original.original(), plan.seconds, seed_of("original"))?;
    let pairs = made.iter().zip(authored).enumerate();
    pairs
        .map(|(method, (made, model))| {
            let signal = profile(made, plan.seconds, seed_of(&format!("method {method}")))?;
            Ok(Rendered {
                error_db: error_db(&signal, &heard),
                model_error_db: error_db(model, original_profile),
                from_model_db: error_db(&signal, model),
            })
        })
        .collect()
}

/// Summary of the comparisons; `None` if nothing was rendered.
pub(super) fn check(plan: &SignalPlan, rendered: &[Rendered]) -> Option<SignalCheck> {
    let of = |value: fn(&Rendered) -> f64| -> Vec<f64> { rendered.iter().map(value).collect() };
    let differences = of(|r| (r.error_db - r.model_error_db).abs());
    (!rendered.is_empty()).then(|| SignalCheck {
        n: rendered.len(),
        seconds: plan.seconds,
        error_db_mean: mean(&of(|r| r.error_db)),
        model_error_db_mean: mean(&of(|r| r.model_error_db)),
        mean_difference_db: mean(&differences),
        largest_difference_db: differences.iter().copied().fold(0.0, f64::max),
        from_model_db: mean(&of(|r| r.from_model_db)),
        chance_db: chance_db(plan.seconds),
    })
}

/// Spectral profile of the rendered signals of a texture under all conditions.
fn profile(made: &Made, seconds: f64, seed: u64) -> Result<Profile, RenderError> {
    let prepared: Vec<(Prepared, f64)> =
        made.parts.iter().map(|(plane, weight)| (plane.prepare(), *weight)).collect();
    let parents: Vec<(&Prepared, f64)> =
        prepared.iter().map(|(prepared, weight)| (prepared, *weight)).collect();
    let rate = made.parts.first().map_or(Hertz(0.0), |(plane, _)| plane.rate());
    let mut signals = Vec::new();
    for (index, contact) in conditions(made.parts.iter().map(|(plane, _)| &**plane)).into_iter().enumerate() {
        let seed = derive_seed(seed, &format!("condition {index}"));
        let plan = RenderPlan { parents: &parents, mode: made.mixing, rate, seconds, seed };
        let signal = render(&plan, &mut |_: f64| contact)?;
        signals.push(signal.into_iter().map(f64::from).collect());
    }
    Ok(Channels::of_signals(rate).profile_of_signals(&signals, rate))
}
