//! Fitting of one texture model to strokes in several directions.
//!
//! The power of a texture with a lay follows `P(θ) = m + c cos 2θ + s sin 2θ` over the direction `θ` of the stroke: the
//! renderer mixes the powers of the grain across and along the lay by `cos²` and `sin²` of the angle. So the lay is
//! found from powers, not from decibels, and opposite directions count as one axis. The lay is the direction of least
//! power, as for brushing. A texture whose loudest direction is called its lay is the same texture, turned by a right
//! angle.

mod comparison;
mod groups;
mod lay;
mod power_law;
mod stroke_power;
mod unmixed;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::recording::Recording;
use crate::recording::fit::directional::groups::{Groups, difference};
use crate::recording::fit::directional::power_law::{PowerLaw, modulation_by_chance_db};
use crate::recording::fit::directional::stroke_power::{StrokePowers, spread_db};
use crate::recording::fit::pieces::{Cut, Piece, cut};
use crate::recording::fit::split::Split;
use crate::recording::fit::surface::Surface;
use crate::recording::fit::{FitError, FitOptions, TapFit, coverage_of, first_playable, landing, orders};
use crate::texture::TextureModel;
use crate::texture::plane::Plane;
use crate::units::Hertz;

/// Smallest ratio of the powers across and along the lay, in dB, that makes a texture directional: 12 % in amplitude.
pub const LEAST_MODULATION_DB: f64 = 1.0;

/// Level difference of opposite strokes, in dB, from which on a note says that the model has their mean.
const OPPOSITE_DB: f64 = 3.0;

/// Recording of strokes in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectedRecording {
    /// Direction of the tip's motion on the surface in rad, counterclockwise from its x axis.
    pub direction_rad: f64,
    /// Recording of the strokes.
    pub recording: Recording,
}

/// Texture model fitted to strokes in several directions, and its report.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedDirections {
    /// The model. It has grain along the lay and the rotation of the lay if the texture is directional.
    pub model: TextureModel,
    /// What was found.
    pub report: DirectionReport,
}

/// Strokes, lay and quality of a model that was fitted to several directions.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionReport {
    /// Directions of the strokes, ascending.
    pub directions: Vec<MeasuredDirection>,
    /// Number of stationary segments.
    pub n_segments: usize,
    /// Model rate.
    pub rate: Hertz,
    /// Predictor order.
    pub order: usize,
    /// Share of the speed-force plane inside the convex hull of the segments, 0 to 1.
    pub coverage: f64,
    /// Power across the lay relative to the power along it, in dB, averaged over speeds and forces. `None` if the
    /// directions do not show a lay.
    pub modulation_db: Option<f64>,
    /// 95th percentile of the modulation, in dB, that a texture without a lay would show by chance, from the spread of
    /// the strokes in one direction. `None` if there are too few strokes, or the directions do not show a lay.
    pub chance_db: Option<f64>,
    /// Direction of the lay in rad, counterclockwise from the x axis of the strokes, 0 to π; `None` for an isotropic
    /// texture.
    pub lay_rad: Option<f64>,
    /// Median goodness of fit of the spectra over the segments, 0 to 1. Each segment is compared with the model in its
    /// own direction; the model was fitted to the segments too.
    pub gfc_median: f64,
    /// Median absolute level error over the segments, in dB, of the same comparison.
    pub level_error_db_median: f64,
    /// Fitted tap transient, if any.
    pub tap: Option<TapFit>,
    /// Sentences on what was left out of the fit or averaged, and why.
    pub notes: Vec<String>,
}

/// Strokes in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredDirection {
    /// Direction of the tip's motion in rad, 0 to 2π.
    pub direction_rad: f64,
    /// Number of recordings with fitted segments.
    pub n_recordings: usize,
    /// Duration of the fitted segments, in seconds.
    pub seconds: f64,
    /// Level relative to all directions at the same speeds and forces, in dB.
    pub level_db: f64,
}

/// Fits one texture model to recordings of strokes in known directions.
///
/// All recordings together give model rate, order, tap transient, and the speeds and forces of the nodes
/// ([`crate::recording::fit::fit`]). The power of the strokes over direction gives the lay. If the modulation is at
/// least [`LEAST_MODULATION_DB`] and above chance, the nodes are estimated across and along the lay from the measured
/// directions, and [`TextureModel::turn_rad`] is the angle across the lay, so that the texture keeps its orientation.
/// Otherwise all directions are pooled in an isotropic model.
///
/// # Errors
/// See [`FitError`]; recordings are counted in the order of `directed`.
pub fn fit_directions(
    directed: Vec<DirectedRecording>,
    options: &FitOptions,
) -> Result<FittedDirections, FitError> {
    let (directions_rad, recordings): (Vec<f64>, Vec<Recording>) =
        directed.into_iter().map(|d| (d.direction_rad, d.recording)).unzip();
    if recordings.is_empty() {
        return Err(FitError::Empty);
    }
    if let Some(recording) = directions_rad.iter().position(|direction| !direction.is_finite()) {
        return Err(FitError::Direction { recording });
    }
    let Cut { pieces, rate, mut notes } = cut(&recordings, options.rate)?;
    let orders = orders(&Split::new(&pieces, rate), options.order)?;
    let tap = landing(&recordings, &mut notes);
    let (axes_rad, strokes) = by_axis(&directions_rad, pieces, &mut notes);
    let all = Surface::new(strokes.iter().flatten().collect());
    let (order, pooled) = first_playable(&orders, |order| all.model(rate, order, options.interpolation))?;
    let coverage = coverage_of(&all, &mut notes);
    let plane = Plane::new(&pooled);

    let directions = measured_directions(&directions_rad, &strokes, &plane);
    note_opposites(&directions, &mut notes);
    let powers = StrokePowers::of_axes(&strokes, &plane);
    let means: Vec<f64> = powers.iter().map(StrokePowers::mean).collect();
    let found = PowerLaw::fit(&axes_rad, &means);
    let modulation_db = found.map(PowerLaw::modulation_db);
    let chance_db = found.and(spread_db(&powers)).map(|spread_db| {
        let errors_db: Vec<f64> = powers.iter().map(|p| spread_db / (p.n() as f64).sqrt()).collect();
        modulation_by_chance_db(&axes_rad, &errors_db)
    });
    let along =
        || axes_rad.iter().map(|axis| format!("{:.0}°", axis.to_degrees())).collect::<Vec<_>>().join(" and ");
    if found.is_none() {
        notes.push(format!(
            "Strokes along {} do not show a lay, so the texture is isotropic; record strokes at 0°, 45°, 90° and 135°.",
            along()
        ));
    } else if axes_rad.len() == 2 {
        notes.push(format!(
            "Strokes along {} only: the lay is assumed to lie along one of them; if it lies between them, the difference between along and across is larger than computed. Record strokes at 0°, 45°, 90° and 135°.",
            along()
        ));
    }
    let least_db = chance_db.unwrap_or(0.0).max(LEAST_MODULATION_DB);
    let across_rad = found.filter(|law| law.modulation_db() >= least_db).map(PowerLaw::across_rad);
    let (order, model) = match across_rad {
        Some(across_rad) => {
            let lower: Vec<usize> = orders.into_iter().filter(|lower| *lower <= order).collect();
            first_playable(&lower, |order| lay::model(&strokes, &axes_rad, across_rad, &pooled, order))?
        }
        None => (order, pooled),
    };
    let (gfc_median, level_error_db_median) = comparison::medians(&model, &axes_rad, &strokes);
    let report = DirectionReport {
        directions,
        n_segments: strokes.iter().map(Vec::len).sum(),
        rate,
        order,
        coverage,
        modulation_db,
        chance_db,
        lay_rad: across_rad.map(|across_rad| (across_rad + FRAC_PI_2).rem_euclid(PI)),
        gfc_median,
        level_error_db_median,
        tap,
        notes,
    };
    Ok(FittedDirections { model: model.with_tap(tap.map(|fit| fit.tap)), report })
}

/// Axes with segments in rad, 0 to π, and the segments of each. Opposite directions have one axis.
fn by_axis(
    directions_rad: &[f64],
    pieces: Vec<Piece>,
    notes: &mut Vec<String>,
) -> (Vec<f64>, Vec<Vec<Piece>>) {
    let axes = Groups::new(directions_rad, PI);
    let mut strokes: Vec<Vec<Piece>> = axes.angles_rad.iter().map(|_| Vec::new()).collect();
    for piece in pieces {
        strokes[axes.of[piece.recording]].push(piece);
    }
    for (axis_rad, _) in axes.angles_rad.iter().zip(&strokes).filter(|(_, pieces)| pieces.is_empty()) {
        notes.push(format!(
            "The strokes along {:.0}° are too short or too uneven to be fitted; this direction is left out.",
            axis_rad.to_degrees()
        ));
    }
    axes.angles_rad.into_iter().zip(strokes).filter(|(_, pieces)| !pieces.is_empty()).unzip()
}

/// Strokes and level of each direction.
fn measured_directions(
    directions_rad: &[f64],
    strokes: &[Vec<Piece>],
    plane: &Plane,
) -> Vec<MeasuredDirection> {
    let groups = Groups::new(directions_rad, TAU);
    let of_group = |(group, direction_rad): (usize, &f64)| {
        let pieces: Vec<&Piece> =
            strokes.iter().flatten().filter(|piece| groups.of[piece.recording] == group).collect();
        let mut recordings: Vec<usize> = pieces.iter().map(|piece| piece.recording).collect();
        recordings.sort_unstable();
        recordings.dedup();
        (!pieces.is_empty()).then(|| MeasuredDirection {
            direction_rad: *direction_rad,
            n_recordings: recordings.len(),
            seconds: pieces.iter().map(|piece| piece.seconds).sum(),
            level_db: 10.0 * stroke_power::relative(&pieces, plane).log10(),
        })
    };
    groups.angles_rad.iter().enumerate().filter_map(of_group).collect()
}

/// Notes which opposite strokes differ much in level; a model over `cos 2θ` has their mean.
fn note_opposites(directions: &[MeasuredDirection], notes: &mut Vec<String>) {
    for (i, a) in directions.iter().enumerate() {
        let is_opposite = |b: &&MeasuredDirection| {
            difference(a.direction_rad + PI, b.direction_rad, TAU).abs() < groups::SAME_RAD
        };
        let Some(b) = directions[i + 1..].iter().find(is_opposite) else { continue };
        let difference_db = (a.level_db - b.level_db).abs();
        if difference_db >= OPPOSITE_DB {
            notes.push(format!(
                "Strokes at {:.0}° and {:.0}° differ by {difference_db:.1} dB; the model has their mean.",
                a.direction_rad.to_degrees(),
                b.direction_rad.to_degrees()
            ));
        }
    }
}

#[cfg(test)]
mod tests;
