//! Leave-one-out error of the interpolation in a library.

use std::ops::RangeInclusive;

use shagreen_core::maths::shard::Shard;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::leave_one_out::{
    LeaveOneOut, LeaveOneOutError, LeaveOneOutPart, Plan, leave_one_out, leave_one_out_part,
};
use shagreen_core::texture::TextureModel;
use shagreen_formats::library::Library;

use crate::report::Reporter;

/// Valid durations of the rendered signals, in s. The minimum gives three spectral windows; the maximum limits computing time.
pub const SIGNAL_SECS: RangeInclusive<f64> = 4.0..=600.0;

/// Returns the interpolation options that a space with this number of axes supports, and notes the others. Options that stand
/// alone stay: the evaluation then states why it fails.
pub fn supported(blendings: Vec<Blending>, n_axes: usize, reporter: &dyn Reporter) -> Vec<Blending> {
    if blendings.len() == 1 {
        return blendings;
    }
    let (supported, others): (Vec<Blending>, Vec<Blending>) =
        blendings.into_iter().partition(|blending| blending.check_in(n_axes).is_ok());
    if !others.is_empty() {
        let ids: Vec<&str> = others.iter().map(|blending| blending.mode.id()).collect();
        reporter.note(&format!(
            "the modes {} are left out: they interpolate in triangles, which a space with {n_axes} axes does not have",
            ids.join(", ")
        ));
    }
    supported
}

/// Evaluates the interpolation of the textures of a library ([`leave_one_out`]). `on_progress` receives the number of finished
/// textures and their total; returning `false` stops the evaluation.
///
/// # Errors
/// Those of [`leave_one_out`], with the identifier of the texture that is the cause.
pub fn evaluate_interpolation(
    library: &Library,
    plan: &Plan,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> anyhow::Result<LeaveOneOut> {
    leave_one_out(&models_and_positions(library), plan, on_progress).map_err(|error| named(error, library))
}

/// Evaluates a part of the textures ([`leave_one_out_part`]), as [`evaluate_interpolation`] does all.
///
/// # Errors
/// As [`evaluate_interpolation`].
pub fn evaluate_part(
    library: &Library,
    plan: &Plan,
    shard: Shard,
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> anyhow::Result<LeaveOneOutPart> {
    leave_one_out_part(&models_and_positions(library), plan, shard, on_progress)
        .map_err(|error| named(error, library))
}

fn models_and_positions(library: &Library) -> Vec<(&TextureModel, Option<SpacePoint>)> {
    library.textures.iter().map(|texture| (&texture.model, texture.at())).collect()
}

/// The error with the identifier of the texture that is its cause.
fn named(error: LeaveOneOutError, library: &Library) -> anyhow::Error {
    let id = error.texture().map(|texture| library.textures[texture].id.clone());
    let error = anyhow::Error::from(error);
    match id {
        Some(id) => error.context(format!("the evaluation failed because of the texture \"{id}\"")),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use super::{evaluate_interpolation, supported};
    use crate::report::Warnings;
    use shagreen_core::space::authoring::Blending;
    use shagreen_core::space::leave_one_out::Plan;
    use shagreen_core::texture::blend::Mode;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn modes_in_triangles_are_left_out_of_a_deep_space_unless_alone() {
        let all = || Mode::ALL.map(Blending::from).to_vec();
        let reporter = Warnings::default();
        assert_eq!(supported(all(), 2, &reporter).len(), Mode::ALL.len());
        let deep = supported(all(), 3, &reporter);
        assert_eq!(deep.iter().map(|blending| blending.mode).collect::<Vec<_>>(), [Mode::Field]);
        assert_eq!(supported(vec![Mode::Power.into()], 3, &reporter).len(), 1);
    }

    #[test]
    fn an_evaluation_says_why_it_ends() {
        let mut library = starter_library().unwrap();
        let plan = Plan { blendings: vec![Mode::Field.into()], signals: None };
        let stopped = evaluate_interpolation(&library, &plan, &mut |_, _| false).unwrap_err();
        assert!(stopped.to_string().contains("stopped"), "{stopped}");
        library.textures.truncate(3);
        let few = evaluate_interpolation(&library, &plan, &mut |_, _| true).unwrap_err();
        assert!(few.to_string().contains("got 3"), "{few}");
    }
}
