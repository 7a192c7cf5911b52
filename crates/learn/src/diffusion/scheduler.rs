//! Noise schedule: DDIM (denoising diffusion implicit models, J. Song et al. 2021) of candle, configured by diffusers
//! JSON.

use candle_transformers::models::stable_diffusion::ddim::DDIMSchedulerConfig;
use candle_transformers::models::stable_diffusion::schedulers::{
    BetaSchedule, PredictionType, Scheduler, SchedulerConfig as _, TimestepSpacing,
};
use serde::Deserialize;

use super::{DiffusionError, Files, Part};

/// Fields of the scheduler file that matter for DDIM.
#[derive(Debug, Deserialize)]
#[expect(clippy::struct_excessive_bools, reason = "the fields of the file")]
struct Wire {
    beta_start: f64,
    beta_end: f64,
    beta_schedule: String,
    num_train_timesteps: usize,
    #[serde(default = "epsilon")]
    prediction_type: String,
    #[serde(default)]
    steps_offset: usize,
    #[serde(default = "leading")]
    timestep_spacing: String,
    #[serde(default)]
    set_alpha_to_one: bool,
    #[serde(default)]
    clip_sample: bool,
    #[serde(default)]
    thresholding: bool,
    #[serde(default)]
    rescale_betas_zero_snr: bool,
    trained_betas: Option<serde_json::Value>,
}

fn epsilon() -> String {
    "epsilon".to_owned()
}

fn leading() -> String {
    "leading".to_owned()
}

/// A DDIM noise schedule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    config: DDIMSchedulerConfig,
}

impl Schedule {
    pub(super) fn read(files: &Files) -> Result<Self, DiffusionError> {
        let part = Part::Schedule;
        let wire: Wire = files.json(part)?;
        let unknown = |what: String| DiffusionError::Unknown { part, what };
        let is_share = |beta: f64| beta > 0.0 && beta < 1.0;
        if !is_share(wire.beta_start)
            || !is_share(wire.beta_end)
            || !(2..=100_000).contains(&wire.num_train_timesteps)
            || wire.steps_offset >= wire.num_train_timesteps
        {
            return Err(DiffusionError::Damaged { part, reason: "invalid schedule values".to_owned() });
        }
        for (is_asked, what) in [
            (wire.set_alpha_to_one, "a final step without noise (set_alpha_to_one)"),
            (wire.clip_sample, "sample clipping (clip_sample)"),
            (wire.thresholding, "dynamic thresholding (thresholding)"),
            (wire.rescale_betas_zero_snr, "zero terminal SNR (rescale_betas_zero_snr)"),
            (wire.trained_betas.is_some(), "a custom beta schedule (trained_betas)"),
        ] {
            if is_asked {
                return Err(unknown(what.to_owned()));
            }
        }
        let config = DDIMSchedulerConfig {
            beta_start: wire.beta_start,
            beta_end: wire.beta_end,
            beta_schedule: match wire.beta_schedule.as_str() {
                "scaled_linear" => BetaSchedule::ScaledLinear,
                "linear" => BetaSchedule::Linear,
                other => return Err(unknown(format!("the beta schedule \"{other}\""))),
            },
            eta: 0.0,
            steps_offset: wire.steps_offset,
            prediction_type: match wire.prediction_type.as_str() {
                "epsilon" => PredictionType::Epsilon,
                "v_prediction" => PredictionType::VPrediction,
                "sample" => PredictionType::Sample,
                other => return Err(unknown(format!("the prediction type \"{other}\""))),
            },
            train_timesteps: wire.num_train_timesteps,
            timestep_spacing: match wire.timestep_spacing.as_str() {
                "leading" => TimestepSpacing::Leading,
                "linspace" => TimestepSpacing::Linspace,
                other => return Err(unknown(format!("the timestep spacing \"{other}\""))),
            },
        };
        Ok(Self { config })
    }

    /// Returns whether all timesteps of such a schedule are within the training range.
    pub(super) fn has_steps(&self, n_steps: usize) -> bool {
        let n_taught = self.config.train_timesteps;
        match self.config.timestep_spacing {
            TimestepSpacing::Leading => {
                n_steps <= n_taught
                    && (n_steps - 1) * (n_taught / n_steps) + self.config.steps_offset < n_taught
            }
            TimestepSpacing::Trailing | TimestepSpacing::Linspace => n_steps <= n_taught,
        }
    }

    pub(super) fn of_steps(&self, n_steps: usize) -> Result<Box<dyn Scheduler>, candle_core::Error> {
        self.config.build(n_steps)
    }
}
