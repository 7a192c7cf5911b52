//! Fitting of a texture model to stroke recordings.

pub mod directional;
mod error;
mod heldout;
mod level_jump;
mod order;
mod pieces;
mod smear;
mod split;
mod strokes;
mod surface;

pub use crate::recording::fit::error::FitError;
pub use crate::recording::fit::pieces::MODEL_RATES_HZ;
pub use crate::recording::fit::strokes::{Stroke, strokes, three_axis_strokes};

use crate::dsp::spectrum::median;
use crate::maths::triangulation::Triangulation;
use crate::recording::Recording;
use crate::recording::fit::order::{ORDERS, held_out_order};
use crate::recording::fit::pieces::usual_order;
use crate::recording::fit::split::Split;
use crate::recording::fit::surface::Surface;
use crate::recording::tap_transients::fit_tap_transients;
use crate::texture::tap::Tap;
use crate::texture::{Interpolation, MAX_ORDER, TextureModel};
use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Cutoff of the high-pass filter before fitting; gravity and hand motion below it are not texture.
pub const HIGH_PASS: Hertz = Hertz(10.0);

/// Minimum share of the tap transients' energy that the fitted sinusoid must explain to be kept.
const MIN_TAP_EXPLAINED: f64 = 0.5;

/// Coverage below which the texture is known at little more than one speed or force.
const THIN_COVERAGE: f64 = 0.1;

/// Fitting options; [`FitOptions::usual`] gives the defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// Model rate; `None` selects it from the bandwidth of the recordings.
    pub rate: Option<Hertz>,
    /// Predictor order, up to [`MAX_ORDER`]; `None` selects the order that predicts held-out segments best, or about as
    /// well with fewer coefficients. In recordings too short to hold anything out, the Bayesian information criterion
    /// (BIC) selects it.
    pub order: Option<usize>,
    /// Interpolation of the model over speed and force.
    pub interpolation: Interpolation,
}

/// Fitted texture model and its validation report.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Model fitted to all segments.
    pub model: TextureModel,
    /// Validation report.
    pub report: FitReport,
}

/// Comparison of a model with the recordings it was fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct FitReport {
    /// Stationary segments, in the order of the recordings.
    pub segments: Vec<Segment>,
    /// Model rate.
    pub rate: Hertz,
    /// Predictor order.
    pub order: usize,
    /// Share of the speed-force plane (zero to the highest of each) inside the convex hull of the segments, 0 to 1.
    pub coverage: f64,
    /// Frequencies of all spectra in the report.
    pub frequencies: Vec<Hertz>,
    /// Fitted tap transient, if any.
    pub tap: Option<TapFit>,
    /// What the models of the [`Comparison`]s were not fitted to.
    pub held_out: HeldOut,
    /// Sentences on what was left out of the fit, and why, and on what the recordings make doubtful.
    pub notes: Vec<String>,
}

/// Part of the recordings that is left out of the fit of a model, to compare the model with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldOut {
    /// Segments, a tenth of them at a time (tenfold cross-validation).
    Segments,
    /// One block of about a quarter of a second at a time, because there are few segments. The blocks beside it in the
    /// same stroke remain, so that such a comparison says little about other strokes.
    Blocks,
    /// Nothing, because there are too few blocks: the compared model is the final one.
    Nothing,
}

/// Segment of a recording with nearly constant speed and force.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Index of the recording.
    pub recording: usize,
    /// Start time in seconds.
    pub start_secs: f64,
    /// Duration in seconds.
    pub seconds: f64,
    /// Median tip speed.
    pub speed: MetersPerSecond,
    /// Median normal force.
    pub force: Newtons,
    /// Root mean square acceleration, in m/s².
    pub level_mps2: f64,
    /// Comparison of the model with this segment.
    pub comparison: Comparison,
}

/// Measured segment compared with the model's prediction at its speed and force.
///
/// A segment of some tenths of a second is too short for a spectral estimate. So the segments nearest to it in speed
/// and force, up to five seconds in total, are pooled. Each measured spectrum is divided by the power law of the
/// levels, and averaged. The model's spectra for windows of the same length are averaged in the same way.
///
/// [`FitReport::held_out`] says what the model was not fitted to. Each fold of segments consists of neighboring ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Measured power spectral density (Welch) in (m/s²)²/Hz, at [`FitReport::frequencies`].
    pub measured_psd: Vec<f64>,
    /// Power spectral density of the model, with the leakage of the same window.
    pub model_psd: Vec<f64>,
    /// Goodness of fit (GFC) of the two spectra, 0 to 1.
    pub gfc: f64,
    /// Ratio of the model's level to the measured level of the pooled segments, in dB. Two segments have the same value if
    /// the same segments are pooled for both.
    pub level_error_db: f64,
}

/// Fitted tap transient and its quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapFit {
    /// Tap transient.
    pub tap: Tap,
    /// Number of tap transients found.
    pub n_landings: usize,
    /// Share of the transients' energy that the fit explains, 0 to 1.
    pub explained: f64,
}

impl FitOptions {
    /// Defaults: rate by bandwidth, order by the prediction of held-out segments, barycentric interpolation.
    pub fn usual() -> Self {
        Self { rate: None, order: None, interpolation: Interpolation::Barycentric }
    }
}

impl HeldOut {
    /// Whether anything is left out.
    pub fn is_any(self) -> bool {
        self != Self::Nothing
    }
}

impl FitReport {
    /// Median goodness of fit over the segments, 0 to 1.
    pub fn gfc_median(&self) -> f64 {
        median(self.segments.iter().map(|s| s.comparison.gfc).collect())
    }

    /// Median absolute level error over the segments, in dB.
    pub fn level_error_db_median(&self) -> f64 {
        median(self.segments.iter().map(|s| s.comparison.level_error_db.abs()).collect())
    }
}

/// Fits one texture model to one or more recordings.
///
/// Strokes are split where speed or force changes ([`crate::recording::segment`]), high-pass filtered at [`HIGH_PASS`]
/// and resampled to the model rate. Nodes lie at segments that keep a minimum distance from each other. A node's
/// predictor is estimated by Burg's method from all segments near its speed and force. Its level is estimated from the
/// same segments, relative to a power law of speed and force.
/// # Errors
/// See [`FitError`].
pub fn fit(recordings: &[Recording], options: &FitOptions) -> Result<Fitted, FitError> {
    if recordings.is_empty() {
        return Err(FitError::Empty);
    }
    let pieces::Cut { pieces, rate, mut notes } = pieces::cut(recordings, options.rate)?;
    let surface = Surface::new(pieces.iter().collect());
    notes.extend(level_jump::note(&pieces, surface.exponents(), recordings.len()));
    let split = Split::new(&pieces, rate);
    let (order, (model, compared)) = first_playable(&orders(&split, options.order)?, |order| {
        let model = surface.model(rate, order, options.interpolation)?;
        Ok((model, heldout::compare(&split, order, options.interpolation)?))
    })?;
    let tap = landing(recordings, &mut notes);
    let model = model.with_tap(tap.map(|t| t.tap));
    let segments = pieces.iter().zip(compared.comparisons).map(|(piece, comparison)| Segment {
        recording: piece.recording,
        start_secs: piece.start_secs,
        seconds: piece.seconds,
        speed: MetersPerSecond(piece.speed_mps),
        force: Newtons(piece.force_n),
        level_mps2: piece.mean_square.sqrt(),
        comparison,
    });
    let coverage = coverage_of(&surface, &mut notes);
    let report = FitReport {
        segments: segments.collect(),
        rate,
        order,
        coverage,
        frequencies: compared.frequencies,
        tap,
        held_out: split.held_out,
        notes,
    };
    Ok(Fitted { model, report })
}

/// Predictor orders to try: the one that was asked for, or the one that suits the segments and all lower ones.
fn orders(split: &Split<'_>, asked: Option<usize>) -> Result<Vec<usize>, FitError> {
    let chosen = match asked {
        Some(order) if order == 0 || order > MAX_ORDER => {
            return Err(FitError::OrderAsked { order, highest: MAX_ORDER });
        }
        Some(order) => return Ok(vec![order]),
        None if split.held_out.is_any() => held_out_order(split)?,
        None => {
            let surface = Surface::new(split.parts.iter().collect());
            surface.order(ORDERS[0]..=usual_order(split.rate))?
        }
    };
    let lower = ORDERS.into_iter().rev().filter(|order| *order < chosen);
    Ok(std::iter::once(chosen).chain(lower).collect())
}

/// Result of the first of these orders whose filters the renderer can play. The peaks of a high order can be so sharp
/// that the filter is not stable in single precision.
fn first_playable<T>(
    orders: &[usize],
    at: impl Fn(usize) -> Result<T, FitError>,
) -> Result<(usize, T), FitError> {
    let mut last = None;
    for order in orders {
        match at(*order) {
            Err(error) if error.is_too_sharp() => last = Some(error),
            result => return Ok((*order, result?)),
        }
    }
    Err(last.unwrap_or(FitError::Empty))
}

/// Share of the speed-force plane that the segments cover, with a note if it is small.
fn coverage_of(surface: &Surface<'_>, notes: &mut Vec<String>) -> f64 {
    let coverage = hull_share(&surface.shares());
    if coverage < THIN_COVERAGE {
        notes.push(format!(
            "The strokes cover {:.0} % of the speed-force plane; elsewhere the texture is extrapolated from the nearest strokes. Record more speeds and forces.",
            100.0 * coverage
        ));
    }
    coverage
}

/// Tap transient of the recordings, if the fit explains enough of the energy.
fn landing(recordings: &[Recording], notes: &mut Vec<String>) -> Option<TapFit> {
    let landed = fit_tap_transients(recordings)?;
    if landed.explained < MIN_TAP_EXPLAINED {
        notes.push(format!(
            "{} tap transients were found, but one decaying sinusoid explains only {:.0} % of their energy; the model has no tap transient.",
            landed.n_landings,
            100.0 * landed.explained
        ));
        return None;
    }
    Some(TapFit { tap: landed.tap, n_landings: landed.n_landings, explained: landed.explained })
}

/// Area of the convex hull of points with coordinates relative to the highest speed and force.
fn hull_share(points: &[[f64; 2]]) -> f64 {
    // Relative coordinates are finite, so that the points can be triangulated.
    let Ok(triangulation) = Triangulation::new(points) else { return 0.0 };
    let area = |corners: [usize; 3]| {
        let [a, b, c] = corners.map(|i| triangulation.points()[i]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs()
    };
    // Added, because the sum of no triangles is -0, which would read "-0 %".
    triangulation.triangles().map(area).sum::<f64>() + 0.0
}

#[cfg(test)]
mod tests;
