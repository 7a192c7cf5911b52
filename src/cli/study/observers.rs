//! Options for how simulated participants perceive.

use serde_json::{Value, json};
use shagreen_core::people::study::simulated::Observers;

use crate::cli::quantity::{positive, quantity, within};

/// Usual values, for the help.
const USUAL: Observers = Observers::usual();

#[derive(clap::Args)]
pub(crate) struct ObserverArgs {
    /// Standard deviation of the noise in one perception of a stimulus, in points of a scale of 0 to 100.
    #[arg(long, value_name = "POINTS", default_value_t = USUAL.noise_points, value_parser = quantity)]
    noise: f64,
    /// Share of the trials in which a participant guesses, 0 to 1.
    #[arg(long, value_name = "SHARE", default_value_t = USUAL.lapse_rate, value_parser = share)]
    lapses: f64,
    /// Gap that is detected in 84.1 % of the trials, in mm: the median over the participants.
    #[arg(long, value_name = "MM", default_value_t = USUAL.gap_threshold_mm, value_parser = positive)]
    gap_threshold: f64,
    /// Difference in level that is detected in 84.1 % of the trials, in dB: the median over the participants.
    #[arg(long, value_name = "DB", default_value_t = USUAL.level_threshold_db, value_parser = positive)]
    level_threshold: f64,
}

fn share(text: &str) -> Result<f64, String> {
    within(text, &(0.0..=1.0), "of all trials")
}

impl ObserverArgs {
    /// Returns the parameters of the participants.
    pub(crate) fn observers(&self) -> Observers {
        Observers {
            noise_points: self.noise,
            lapse_rate: self.lapses,
            gap_threshold_mm: self.gap_threshold,
            level_threshold_db: self.level_threshold,
            ..USUAL
        }
    }
}

/// Returns all parameters as JSON.
pub(crate) fn observers_json(observers: &Observers) -> Value {
    json!({
        "noise_points": observers.noise_points,
        "bias_points": observers.bias_points,
        "scale_log_spread": observers.scale_log_spread,
        "criterion_points": observers.criterion_points,
        "gap_threshold_mm": observers.gap_threshold_mm,
        "level_threshold_db": observers.level_threshold_db,
        "threshold_log_spread": observers.threshold_log_spread,
        "slope": observers.slope,
        "grade_noise": observers.grade_noise,
        "lapse_rate": observers.lapse_rate,
    })
}
