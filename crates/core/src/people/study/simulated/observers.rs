//! Parameters of simulated participants.

use crate::people::study::simulated::SimulationError;

/// How a population of simulated participants perceives and answers. All numbers are choices, not measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observers {
    /// Standard deviation of the noise in one perception of one stimulus, in points of a dimension (0 to 100).
    pub noise_points: f64,
    /// Standard deviation over participants of the constant bias on a scale, in points.
    pub bias_points: f64,
    /// Standard deviation over participants of the logarithm of the scale factor on a scale.
    pub scale_log_spread: f64,
    /// Distance beyond which two perceptions count as different, in points.
    pub criterion_points: f64,
    /// Width of a gap that is detected in 84.1 % of the trials, in mm; the median over participants.
    pub gap_threshold_mm: f64,
    /// Difference in level that is detected in 84.1 % of the trials, in dB; the median over participants.
    pub level_threshold_db: f64,
    /// Standard deviation over participants of the logarithm of their thresholds.
    pub threshold_log_spread: f64,
    /// Slope of the psychometric function: exponent of a Weibull function of the level.
    pub slope: f64,
    /// Standard deviation of the noise in one grade, as a fraction of the scale.
    pub grade_noise: f64,
    /// Probability of a guess instead of an answer, 0 to 1.
    pub lapse_rate: f64,
}

impl Observers {
    /// Attentive observers: the noise, bias and scale factors of [`crate::people::panel::PanelConfig::usual`], the mean gap
    /// threshold of the published experiment, guesses in 2 % of the trials.
    pub const fn usual() -> Self {
        Self {
            noise_points: 8.0,
            bias_points: 6.0,
            scale_log_spread: 0.2,
            criterion_points: 20.0,
            gap_threshold_mm: 0.96,
            level_threshold_db: 1.5,
            threshold_log_spread: 0.4,
            slope: 2.0,
            grade_noise: 0.12,
            lapse_rate: 0.02,
        }
    }

    /// Observers without noise, habits and lapses, who all have the same threshold.
    pub const fn exact() -> Self {
        Self {
            noise_points: 0.0,
            bias_points: 0.0,
            scale_log_spread: 0.0,
            criterion_points: 0.0,
            threshold_log_spread: 0.0,
            grade_noise: 0.0,
            lapse_rate: 0.0,
            ..Self::usual()
        }
    }

    /// Checks the range of every parameter.
    pub(super) fn check(&self) -> Result<(), SimulationError> {
        let ranges = [
            ("the noise in points", self.noise_points, 0.0, 1e3),
            ("the bias in points", self.bias_points, 0.0, 1e3),
            ("the spread of the scale", self.scale_log_spread, 0.0, 10.0),
            ("the criterion in points", self.criterion_points, 0.0, 1e3),
            ("the gap threshold in mm", self.gap_threshold_mm, 1e-3, 1e3),
            ("the level threshold in dB", self.level_threshold_db, 1e-3, 1e3),
            ("the spread of the thresholds", self.threshold_log_spread, 0.0, 10.0),
            ("the slope", self.slope, 0.1, 100.0),
            ("the noise of grades", self.grade_noise, 0.0, 10.0),
            ("the rate of lapses", self.lapse_rate, 0.0, 1.0),
        ];
        match ranges.into_iter().find(|(_, value, low, high)| !(*low..=*high).contains(value)) {
            Some((what, value, low, high)) => Err(SimulationError::Observers { what, value, low, high }),
            None => Ok(()),
        }
    }
}
