//! Choice of axes by the leave-one-out error of a smoothing spline through the spectra, in closed form.

use nalgebra::DMatrix;

use crate::maths::smoother::{Smoother, chosen_ridge};
use crate::space::fidelity::{Channels, Profile};
use crate::space::leave_one_out::LeaveOneOutError;
use crate::space::leave_one_out::rest::Placed;
use crate::space::space_point::{MOST_AXES, SpacePoint, Unit};
use crate::texture::TextureModel;

/// Channel levels of the textures.
pub(super) struct Spectra {
    pub(super) profiles: Vec<Profile>,
}

impl Spectra {
    pub(super) fn new(models: &[&TextureModel]) -> Result<Self, LeaveOneOutError> {
        let anywhere = Some(SpacePoint::default());
        let textures: Vec<(&TextureModel, Option<SpacePoint>)> =
            models.iter().map(|model| (*model, anywhere)).collect();
        let channels = Channels::of_models();
        let placed = Placed::all(&textures)?;
        Ok(Self { profiles: placed.iter().map(|placed| placed.original().profile(&channels)).collect() })
    }
}

/// Position of a texture on some axes, in the unit cube; `coordinates` are those of all textures on all candidates.
pub(super) fn unit_of(coordinates: &[Vec<f64>], axes: &[usize], texture: usize) -> Unit {
    let mut unit = [0.0; MOST_AXES];
    for (to, axis) in unit.iter_mut().zip(axes) {
        *to = coordinates[*axis][texture] / 100.0;
    }
    unit
}

/// Axes in the order of the choice: `first`, then each time the candidate with the lowest error on `textures`, until there
/// are [`MOST_AXES`] or no candidates are left.
pub(super) fn chosen(
    spectra: &Spectra,
    coordinates: &[Vec<f64>],
    textures: &[usize],
    first: &[usize],
) -> Vec<usize> {
    let mut axes = first.to_vec();
    let levels = levels(spectra, textures);
    while axes.len() < MOST_AXES {
        let with = |axis: usize| [axes.as_slice(), &[axis]].concat();
        let free = (0..coordinates.len()).filter(|axis| !axes.contains(axis));
        let errors = free.map(|axis| (axis, left_out_error(&levels, coordinates, textures, &with(axis))));
        let Some((best, _)) = errors.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        axes.push(best);
    }
    axes
}

/// Channel levels in dB, one row for each texture.
fn levels(spectra: &Spectra, textures: &[usize]) -> DMatrix<f64> {
    let n_channels = spectra.profiles.first().map_or(0, |profile| profile.channels_db.len());
    DMatrix::from_fn(textures.len(), n_channels, |row, channel| {
        spectra.profiles[textures[row]].channels_db[channel]
    })
}

/// Mean over the textures of the root mean square error in dB, each predicted without itself: the residual of the spline
/// divided by one minus its leverage. Infinite for axes on which the textures cannot be told apart.
fn left_out_error(
    levels: &DMatrix<f64>,
    coordinates: &[Vec<f64>],
    textures: &[usize],
    axes: &[usize],
) -> f64 {
    let places: Vec<Unit> = textures.iter().map(|texture| unit_of(coordinates, axes, *texture)).collect();
    let Some(smoother) = Smoother::new(&places, chosen_ridge(&places, levels)) else { return f64::INFINITY };
    let n = places.len();
    let mut smoothed = DMatrix::zeros(n, n);
    for (row, place) in places.iter().enumerate() {
        for (column, weight) in smoother.weights(*place).into_iter().enumerate() {
            smoothed[(row, column)] = weight;
        }
    }
    let residuals = levels - &smoothed * levels;
    let error = |row: usize| {
        let square = residuals.row(row).norm_squared() / levels.ncols().max(1) as f64;
        square.sqrt() / (1.0 - smoothed[(row, row)]).max(1e-6)
    };
    (0..n).map(error).sum::<f64>() / n as f64
}

#[cfg(test)]
mod tests {
    use super::left_out_error;
    use crate::maths::rng::Random;
    use crate::maths::smoother::{Smoother, chosen_ridge};
    use crate::space::axis_evaluation::choice::unit_of;
    use nalgebra::DMatrix;

    /// Compares the closed form with the explicit computation at the same ridge.
    #[test]
    fn the_error_is_that_of_predicting_each_texture_without_itself() {
        let mut random = Random::new(5);
        let coordinates: Vec<Vec<f64>> =
            (0..3).map(|_| (0..14).map(|_| 100.0 * random.uniform()).collect()).collect();
        let levels =
            DMatrix::from_fn(14, 3, |row, channel| 0.1 * coordinates[channel][row] + 0.5 * random.normal());
        let all: Vec<usize> = (0..14).collect();
        let axes = [2, 0, 1];
        let places: Vec<_> = all.iter().map(|texture| unit_of(&coordinates, &axes, *texture)).collect();
        let ridge = chosen_ridge(&places, &levels);
        let mut sum = 0.0;
        for left_out in 0..14 {
            let others: Vec<usize> = all.iter().copied().filter(|texture| *texture != left_out).collect();
            let rest: Vec<_> = others.iter().map(|texture| places[*texture]).collect();
            let weights = Smoother::new(&rest, ridge).unwrap().weights(places[left_out]);
            let off = |channel: usize| {
                let predicted: f64 = weights
                    .iter()
                    .zip(&others)
                    .map(|(weight, texture)| weight * levels[(*texture, channel)])
                    .sum();
                (predicted - levels[(left_out, channel)]).powi(2)
            };
            sum += ((0..3).map(off).sum::<f64>() / 3.0).sqrt();
        }
        let error = left_out_error(&levels, &coordinates, &all, &axes);
        assert!((error - sum / 14.0).abs() < 1e-8, "{error} and {}", sum / 14.0);
    }
}
