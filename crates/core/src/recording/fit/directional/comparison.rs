//! Comparison of a model with the strokes in their own directions.

use crate::dsp::spectrum::median;
use crate::recording::fit::heldout::with_grains;
use crate::recording::fit::pieces::Piece;
use crate::texture::TextureModel;
use crate::texture::plane::Plane;
use crate::units::{Contact, MetersPerSecond, Newtons, Radians};

/// Median goodness of fit and median absolute level error in dB over all segments, each compared with the model in its
/// own direction.
pub(super) fn medians(model: &TextureModel, axes_rad: &[f64], strokes: &[Vec<Piece>]) -> (f64, f64) {
    let plane = Plane::new(model);
    let (mut fits, mut errors_db) = (Vec::new(), Vec::new());
    for (axis_rad, pieces) in axes_rad.iter().zip(strokes) {
        let angle = Radians(axis_rad - model.turn_rad());
        let grain = |piece: &Piece| {
            let (speed, force) = (MetersPerSecond(piece.speed_mps), Newtons(piece.force_n));
            Some(plane.at_angle(Contact { speed, force }, angle))
        };
        let grains: Vec<_> = pieces.iter().map(grain).collect();
        let (_, comparisons) = with_grains(pieces, model.rate(), &grains);
        fits.extend(comparisons.iter().map(|comparison| comparison.gfc));
        errors_db.extend(comparisons.iter().map(|comparison| comparison.level_error_db.abs()));
    }
    (median(fits), median(errors_db))
}
