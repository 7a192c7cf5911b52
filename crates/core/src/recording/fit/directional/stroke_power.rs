//! Power of the strokes along each axis, relative to the texture in all directions.

use std::collections::BTreeMap;

use crate::recording::fit::pieces::Piece;
use crate::texture::plane::Plane;
use crate::units::{Contact, MetersPerSecond, Newtons};

/// Smallest number of recordings along every axis for which each recording counts as one stroke. With fewer, each
/// segment counts.
const MIN_RECORDINGS: usize = 2;

/// Power of the strokes along one axis, relative to the texture in all directions at the same speeds and forces.
pub(super) struct StrokePowers {
    /// Duration in seconds and relative power of each stroke.
    strokes: Vec<(f64, f64)>,
}

impl StrokePowers {
    /// Strokes of each axis, from its segments. `plane` is the texture in all directions.
    pub(super) fn of_axes(axes: &[Vec<Piece>], plane: &Plane) -> Vec<Self> {
        let by_recording: Vec<Vec<Vec<&Piece>>> = axes.iter().map(|pieces| recordings(pieces)).collect();
        let is_repeated = by_recording.iter().all(|recordings| recordings.len() >= MIN_RECORDINGS);
        let of_axis = |(pieces, recordings): (&Vec<Piece>, Vec<Vec<&Piece>>)| {
            let strokes =
                if is_repeated { recordings } else { pieces.iter().map(|piece| vec![piece]).collect() };
            let power = |stroke: &Vec<&Piece>| (seconds(stroke), relative(stroke, plane));
            Self { strokes: strokes.iter().map(power).collect() }
        };
        axes.iter().zip(by_recording).map(of_axis).collect()
    }

    /// Number of strokes.
    pub(super) fn n(&self) -> usize {
        self.strokes.len()
    }

    /// Mean relative power, weighted by duration.
    pub(super) fn mean(&self) -> f64 {
        let seconds: f64 = self.strokes.iter().map(|(seconds, _)| seconds).sum();
        self.strokes.iter().map(|(seconds, power)| seconds * power).sum::<f64>() / seconds
    }

    /// Sum of the squared deviations of the levels from their mean, in dB².
    fn squares_db(&self) -> f64 {
        let levels_db: Vec<f64> = self.strokes.iter().map(|(_, power)| 10.0 * power.log10()).collect();
        let mean_db = levels_db.iter().sum::<f64>() / levels_db.len() as f64;
        levels_db.iter().map(|level_db| (level_db - mean_db).powi(2)).sum()
    }
}

/// Power of segments relative to what the plane predicts at their speeds and forces, weighted by duration.
pub(super) fn relative(pieces: &[&Piece], plane: &Plane) -> f64 {
    let predicted = |piece: &Piece| {
        let contact = Contact { speed: MetersPerSecond(piece.speed_mps), force: Newtons(piece.force_n) };
        plane.at(contact).level_mps2.powi(2)
    };
    let measured: f64 = pieces.iter().map(|piece| piece.seconds * piece.mean_square).sum();
    let expected: f64 = pieces.iter().map(|piece| piece.seconds * predicted(piece)).sum();
    // Both are positive: silent segments are left out, and the plane is silent at zero speed and force only.
    measured / expected.max(f64::MIN_POSITIVE)
}

/// Standard deviation of the levels of strokes about the mean of their axis, in dB; `None` if no axis has two strokes.
pub(super) fn spread_db(axes: &[StrokePowers]) -> Option<f64> {
    let n_free: usize = axes.iter().map(|axis| axis.n().saturating_sub(1)).sum();
    let squares_db: f64 = axes.iter().map(StrokePowers::squares_db).sum();
    (n_free > 0).then(|| (squares_db / n_free as f64).sqrt())
}

/// Segments of each recording.
fn recordings(pieces: &[Piece]) -> Vec<Vec<&Piece>> {
    let mut by_recording: BTreeMap<usize, Vec<&Piece>> = BTreeMap::new();
    for piece in pieces {
        by_recording.entry(piece.recording).or_default().push(piece);
    }
    by_recording.into_values().collect()
}

fn seconds(pieces: &[&Piece]) -> f64 {
    pieces.iter().map(|piece| piece.seconds).sum()
}
