//! From recordings to a texture model.

use crate::recording::Recording;
use crate::tap::Tap;
use crate::texture::{Interpolation, TextureModel};
use crate::units::{Hertz, MetersPerSecond, Newtons};

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
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Measured power spectral density (Welch), in (m/s²)²/Hz, at [`FitReport::frequencies`].
    pub measured_psd: Vec<f64>,
    /// The model's, smeared by the same window.
    pub model_psd: Vec<f64>,
    /// Goodness of fit of the two, 0..1.
    pub gfc: f64,
    /// Level of the model over that of the segment, in dB.
    pub level_error_db: f64,
}

/// Landings and the decaying oscillation that stands for them.
#[derive(Clone, Debug, PartialEq)]
pub struct TapFit {
    /// The oscillation.
    pub tap: Tap,
    /// How many landings were found.
    pub n_landings: usize,
    /// Share of the energy of the landings that the oscillation explains, 0..1.
    pub explained: f64,
}

/// Why recordings do not make a texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// There is nothing to fit.
    #[error("there is no recording to fit")]
    Empty,
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

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { 0.5 * (values[(n - 1) / 2] + values[n / 2]) }
}

/// Fits one texture to recordings of it.
///
/// # Errors
/// See [`FitError`].
pub fn fit(_recordings: &[Recording], _options: &FitOptions) -> Result<Fitted, FitError> {
    Err(FitError::Empty)
}
