//! From recordings to a texture model.

mod error;
mod heldout;
mod pieces;
mod smear;
mod strokes;
mod surface;

pub use crate::fit::error::FitError;
pub use crate::fit::pieces::{MODEL_RATES_HZ, highest_order};
pub use crate::fit::strokes::{Stroke, strokes};

use crate::recording::Recording;
use crate::spectrum::median;
use crate::tap::{Tap, fit_landings};
use crate::texture::{Interpolation, TextureModel};
use crate::triangulation::Triangulation;
use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Below this nothing is fitted: gravity and the motion of the hand are no texture.
pub const HIGH_PASS: Hertz = Hertz(10.0);

/// Lowest order that the criterion may choose: fewer poles lose the shape of a real spectrum.
const MIN_ORDER: usize = 10;

/// Share of the energy of landings that an oscillation must explain to stand for them.
const MIN_TAP_EXPLAINED: f64 = 0.5;

/// Coverage below which a texture is known at hardly more than one speed or force.
const THIN_COVERAGE: f64 = 0.1;

/// How to fit; [`FitOptions::usual`] is a good start.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// Rate of the model; `None` takes the one that the bandwidth of the recordings supports.
    pub rate: Option<Hertz>,
    /// Order of the predictor; `None` asks the Bayesian information criterion.
    pub order: Option<usize>,
    /// How the model is interpolated over speed and force.
    pub interpolation: Interpolation,
}

/// A texture model, and how well it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The model, of all segments.
    pub model: TextureModel,
    /// How well it fits.
    pub report: FitReport,
}

/// How well a model fits the recordings it was made of.
#[derive(Clone, Debug, PartialEq)]
pub struct FitReport {
    /// The stationary stretches that were found, in the order of the recordings.
    pub segments: Vec<Segment>,
    /// Rate of the model.
    pub rate: Hertz,
    /// Order of the predictor.
    pub order: usize,
    /// Share of the speed-force plane (0 to the highest of each) inside the hull of the segments, 0..1.
    pub coverage: f64,
    /// Frequencies of all spectra below.
    pub frequencies: Vec<Hertz>,
    /// What landings sounded like, where there were some.
    pub tap: Option<TapFit>,
    /// Whether [`Comparison`]s are with segments that the model compared had not seen; with too few segments they are
    /// with the model's own.
    pub held_out: bool,
    /// Sentences on what was left out and why.
    pub notes: Vec<String>,
}

/// A stretch of a recording with one speed and force.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Which recording it is of.
    pub recording: usize,
    /// Where it begins, in seconds.
    pub start_secs: f64,
    /// Its length in seconds.
    pub seconds: f64,
    /// Median speed.
    pub speed: MetersPerSecond,
    /// Median force.
    pub force: Newtons,
    /// Root mean square acceleration, in m/s².
    pub level_mps2: f64,
    /// How the model compares with it.
    pub comparison: Comparison,
}

/// A segment beside what the model says of its speed and force.
///
/// Segments last tenths of a second, and so little noise has no spectrum to speak of. So the segments nearest to it in
/// speed and force, up to five seconds in all, are compared together: the mean of their spectra, each divided by the
/// power law that levels follow, beside the mean of what their models predict for windows of the same length. A model
/// that is compared with a segment was made without it, where [`FitReport::held_out`] says so; ten models, each without
/// a tenth of the segments, in blocks of neighboring ones, share the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Measured power spectral density (Welch), in (m/s²)²/Hz, at [`FitReport::frequencies`].
    pub measured_psd: Vec<f64>,
    /// The model's, smeared by the same window.
    pub model_psd: Vec<f64>,
    /// Goodness of fit of the two, 0..1.
    pub gfc: f64,
    /// Level of the model over that measured, of the same segments, in dB.
    pub level_error_db: f64,
}

/// Landings and the decaying oscillation that stands for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapFit {
    /// The oscillation.
    pub tap: Tap,
    /// How many landings were found.
    pub n_landings: usize,
    /// Share of the energy of the landings that the oscillation explains, 0..1.
    pub explained: f64,
}

impl FitOptions {
    /// Rate by bandwidth, order by criterion, barycentric.
    pub fn usual() -> Self {
        Self { rate: None, order: None, interpolation: Interpolation::Barycentric }
    }
}

impl FitReport {
    /// Median goodness of fit over the segments, 0..1.
    pub fn gfc_median(&self) -> f64 {
        median(self.segments.iter().map(|s| s.comparison.gfc).collect())
    }

    /// Median over the segments of the absolute level error, in dB.
    pub fn level_error_db_median(&self) -> f64 {
        median(self.segments.iter().map(|s| s.comparison.level_error_db.abs()).collect())
    }
}

/// Fits one texture to recordings of it.
///
/// Strokes are cut where speed or force changes ([`crate::segment`]), high-passed at [`HIGH_PASS`] and brought to the
/// rate of the model. Nodes lie at segments that are apart from each other; the predictor of a node is Burg's through
/// all segments near its speed and force at once, and its level theirs about a power law of speed and force.
///
/// # Errors
/// See [`FitError`].
pub fn fit(recordings: &[Recording], options: &FitOptions) -> Result<Fitted, FitError> {
    if recordings.is_empty() {
        return Err(FitError::Empty);
    }
    let pieces::Cut { pieces, rate, mut notes } = pieces::cut(recordings, options.rate)?;
    let highest = highest_order(rate);
    if let Some(order) = options.order.filter(|order| *order == 0 || *order > highest) {
        return Err(FitError::OrderAsked { order, highest });
    }
    let surface = surface::Surface::new(pieces.iter().collect());
    let order = match options.order {
        Some(order) => order,
        None => surface.order(MIN_ORDER..=highest)?,
    };
    let model = surface.model(rate, order, options.interpolation)?;
    let tap = landing(recordings, &mut notes);
    let model = model.with_tap(tap.map(|t| t.tap));
    let compared = heldout::compare(&pieces, rate, order, options.interpolation)?;
    let segments = pieces.iter().zip(compared.comparisons).map(|(piece, comparison)| Segment {
        recording: piece.recording,
        start_secs: piece.start_secs,
        seconds: piece.seconds,
        speed: MetersPerSecond(piece.speed_mps),
        force: Newtons(piece.force_n),
        level_mps2: piece.mean_square.sqrt(),
        comparison,
    });
    let coverage = hull_share(&surface.shares());
    if coverage < THIN_COVERAGE {
        notes.push(format!(
            "The strokes cover {:.0} % of the plane of speed and force: elsewhere the texture is that of the nearest stroke; record more speeds and forces.",
            100.0 * coverage
        ));
    }
    let report = FitReport {
        segments: segments.collect(),
        rate,
        order,
        coverage,
        frequencies: compared.frequencies,
        tap,
        held_out: compared.held_out,
        notes,
    };
    Ok(Fitted { model, report })
}

/// The oscillation of the landings, where it explains them.
fn landing(recordings: &[Recording], notes: &mut Vec<String>) -> Option<TapFit> {
    let landed = fit_landings(recordings)?;
    if landed.explained < MIN_TAP_EXPLAINED {
        notes.push(format!(
            "{} landings were found, but one decaying oscillation explains only {:.0} % of them: none was kept.",
            landed.n_landings,
            100.0 * landed.explained
        ));
        return None;
    }
    Some(TapFit { tap: landed.tap, n_landings: landed.n_landings, explained: landed.explained })
}

/// Area of the convex hull of points, whose coordinates are shares of the highest.
fn hull_share(points: &[[f64; 2]]) -> f64 {
    // Shares are finite, so points can be triangulated.
    let Ok(triangulation) = Triangulation::new(points) else { return 0.0 };
    let area = |corners: [usize; 3]| {
        let [a, b, c] = corners.map(|i| triangulation.points()[i]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs()
    };
    triangulation.triangles().map(area).sum()
}

#[cfg(test)]
mod tests;
