//! Nested errors: textures of a fold are predicted by the field over the others, on axes that were chosen without the fold.

use crate::maths::statistics::{mean, standard_deviation};
use crate::space::authoring::Blending;
use crate::space::axis_evaluation::AxisStep;
use crate::space::axis_evaluation::choice::{Spectra, chosen};
use crate::space::fidelity::{Channels, Profile, error_db};
use crate::space::leave_one_out::LeaveOneOutError;
use crate::space::leave_one_out::rest::{Placed, Rests};
use crate::space::space_point::SpacePoint;
use crate::texture::TextureModel;
use crate::texture::blend::Mode;

/// Error of one texture with some number of axes.
#[derive(Clone, Copy, Debug)]
struct Predicted {
    error_db: f64,
    is_first: bool,
    nearest_db: f64,
    is_nearest_first: bool,
}

/// Returns the errors for each number of axes from that of `first` (at least one) to that of `order`, the choice on all
/// textures.
pub(super) fn nested(
    models: &[&TextureModel],
    spectra: &Spectra,
    coordinates: &[Vec<f64>],
    first: &[usize],
    (order, n_folds): (&[usize], usize),
    on_progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Vec<AxisStep>, LeaveOneOutError> {
    let counts: Vec<usize> = (first.len().max(1)..=order.len()).collect();
    let mut predicted: Vec<Vec<Predicted>> = vec![Vec::new(); counts.len()];
    let mut n_same = vec![0_usize; counts.len()];
    for fold in 0..n_folds {
        if !on_progress(fold, n_folds) {
            return Err(LeaveOneOutError::Stopped);
        }
        // Every n-th texture, so that a fold does not hold neighbors of the library.
        let (inside, others): (Vec<usize>, Vec<usize>) =
            (0..models.len()).partition(|texture| texture % n_folds == fold);
        let axes = chosen(spectra, coordinates, &others, first);
        for (at, count) in counts.iter().enumerate() {
            n_same[at] += usize::from(is_same_set(&axes[..*count], &order[..*count]));
            let found = of_fold(models, spectra, coordinates, &axes[..*count], (&inside, &others))?;
            predicted[at].extend(found);
        }
    }
    on_progress(n_folds, n_folds);
    let mut steps: Vec<AxisStep> = Vec::new();
    // The last number of axes that helped.
    let mut base = 0;
    for (at, count) in counts.iter().enumerate() {
        let of = &predicted[at];
        let errors: Vec<f64> = of.iter().map(|texture| texture.error_db).collect();
        let nearest: Vec<f64> = of.iter().map(|texture| texture.nearest_db).collect();
        let share = |is: fn(&Predicted) -> bool| {
            of.iter().filter(|texture| is(texture)).count() as f64 / of.len() as f64
        };
        let gains: Vec<f64> =
            predicted[base].iter().zip(of).map(|(base, now)| base.error_db - now.error_db).collect();
        let gain_db = [mean(&gains), standard_deviation(&gains) / (gains.len() as f64).sqrt()];
        let step = AxisStep {
            n_axes: *count,
            added: order[count - 1],
            agreement: n_same[at] as f64 / n_folds as f64,
            error_db_mean: mean(&errors),
            rank1: share(|texture| texture.is_first),
            nearest_db_mean: mean(&nearest),
            nearest_rank1: share(|texture| texture.is_nearest_first),
            gain_db: (at > 0).then_some(gain_db),
        };
        if step.helps() == Some(true) {
            base = at;
        }
        steps.push(step);
    }
    Ok(steps)
}

/// Predicts the textures of a fold from the others, by the field and by the nearest one.
fn of_fold(
    models: &[&TextureModel],
    spectra: &Spectra,
    coordinates: &[Vec<f64>],
    axes: &[usize],
    (inside, others): (&[usize], &[usize]),
) -> Result<Vec<Predicted>, LeaveOneOutError> {
    let place = |texture: usize| {
        let values: Vec<f64> = axes.iter().map(|axis| coordinates[*axis][texture]).collect();
        SpacePoint::of(&values).unwrap_or_default()
    };
    let textures: Vec<(&TextureModel, Option<SpacePoint>)> = (0..models.len())
        .map(|texture| (models[texture], others.contains(&texture).then(|| place(texture))))
        .collect();
    let targets: Vec<SpacePoint> = inside.iter().map(|texture| place(*texture)).collect();
    let made = Rests::new(&textures).made_at(&targets, &Blending::from(Mode::Field), inside)?;
    let channels = Channels::of_models();
    let known = Placed::all(&textures)?;
    inside
        .iter()
        .zip(targets)
        .zip(made)
        .map(|((texture, at), made)| {
            let profile = made.profile(&channels);
            let nearest = known.iter().min_by(|a, b| a.at.distance(at).total_cmp(&b.at.distance(at)));
            let nearest = &spectra.profiles[nearest.map_or(*texture, |placed| placed.texture)];
            Ok(Predicted {
                error_db: error_db(&profile, &spectra.profiles[*texture]),
                is_first: is_first(&profile, *texture, &spectra.profiles),
                nearest_db: error_db(nearest, &spectra.profiles[*texture]),
                is_nearest_first: is_first(nearest, *texture, &spectra.profiles),
            })
        })
        .collect()
}

/// Whether no texture is closer to the prediction than the original.
fn is_first(predicted: &Profile, original: usize, profiles: &[Profile]) -> bool {
    let own = error_db(predicted, &profiles[original]);
    profiles
        .iter()
        .enumerate()
        .all(|(other, profile)| other == original || error_db(predicted, profile) > own)
}

fn is_same_set(a: &[usize], b: &[usize]) -> bool {
    a.len() == b.len() && a.iter().all(|axis| b.contains(axis))
}
