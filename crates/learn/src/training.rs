//! Training of a stroke network: Adam, RMSE loss and early stopping.
//!
//! It can be stopped before any batch and resumed with an identical result.

use std::ops::Range;

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::maths::rng::{Random, derive_seed};

use crate::cnn_lstm::{Architecture, CnnLstm};
use crate::model_file::{self, Numbers};
use crate::parameters::{Adam, AdamConfig};
use crate::stroke_model::{N_AT_ONCE, StrokeModel};
use crate::stroke_set::{Scale, Segments, StrokedTexture};

pub use crate::training_error::TrainingError;

/// Kind of the state file.
const STATE: &str = "a training of attributes from strokes";

/// Version of the training procedure; a state saved by another version cannot be resumed.
const WAY: u32 = 1;

/// Training settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingConfig {
    /// Sizes of the network.
    pub architecture: Architecture,
    /// Maximum number of epochs.
    pub n_epochs: usize,
    /// Maximum number of segments per batch.
    pub n_batch: usize,
    /// Learning rate of Adam.
    pub learning_rate: f64,
    /// Epochs without a lower validation error before training stops early.
    ///
    /// `None` disables early stopping and the validation set.
    pub patience: Option<usize>,
    /// Seed of all random draws.
    pub seed: u64,
}

impl TrainingConfig {
    /// Returns the settings of the paper: a learning rate of 0.001, and batches of 32 (which the paper does not state).
    pub fn paper(architecture: Architecture, n_epochs: usize, patience: Option<usize>, seed: u64) -> Self {
        Self { architecture, n_epochs, n_batch: 32, learning_rate: 1e-3, patience, seed }
    }
}

/// Result of an epoch; errors are in points of 0 to 100.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// Number of the epoch, from 1.
    pub number: usize,
    /// Training RMSE, averaged over the epoch.
    pub learned_rmse: f64,
    /// Validation RMSE; `None` without a validation set.
    pub aside_rmse: Option<f64>,
}

/// Metadata of a state file.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct State {
    /// The [`WAY`] of the training.
    #[serde(default)]
    way: u32,
    config: TrainingConfig,
    scale: Scale,
    textures: Vec<String>,
    aside: Vec<String>,
    epochs: Vec<Epoch>,
    n_adam_steps: usize,
    /// Number of the best epoch.
    best: usize,
    /// Epoch that was interrupted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    part: Option<PartialEpoch>,
}

/// Batches of an epoch that was interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct PartialEpoch {
    n_steps: usize,
    /// Sum of the mean squared errors of the segments so far, for attributes from 0 to 1.
    squared_errors: f64,
}

/// A network in training.
pub struct Training {
    state: State,
    network: CnnLstm,
    adam: Adam,
    segments: Segments,
    aside: Segments,
    /// Weights after the best epoch.
    best: Numbers,
    device: Device,
}

impl Training {
    /// Starts training of a new network. With patience, a tenth of the textures, at least one, is the validation set.
    ///
    /// # Errors
    /// [`TrainingError::Sizes`] for invalid settings, [`TrainingError::Axes`] for strokes with another number of axes
    /// than the network reads, [`TrainingError::TooFew`] for too little data.
    pub fn new(textures: &[&StrokedTexture], config: TrainingConfig) -> Result<Self, TrainingError> {
        let architecture = &config.architecture;
        if !architecture.is_possible() || ![1, 3].contains(&architecture.n_axes()) || config.n_batch == 0 {
            return Err(TrainingError::Sizes);
        }
        let n_aside = if config.patience.is_some() { textures.len().div_ceil(10) } else { 0 };
        let order = Random::new(derive_seed(config.seed, "aside")).shuffled(textures.len());
        let (aside, learned) = order.split_at(n_aside.min(textures.len()));
        let of = |indices: &[usize]| {
            let mut indices = indices.to_vec();
            indices.sort_unstable();
            indices.into_iter().map(|i| textures[i]).collect::<Vec<&StrokedTexture>>()
        };
        let (aside, learned) = (of(aside), of(learned));
        let scale = Scale::of(&learned);
        let n_samples = architecture.n_samples;
        let segments = Segments::of(&learned, architecture, &scale)?;
        let aside_segments = Segments::of(&aside, architecture, &scale)?;
        if segments.len() == 0 || learned.len() < 2 {
            let (n_segments, n_textures) = (segments.len(), learned.len());
            return Err(TrainingError::TooFew { n_segments, n_textures, n_samples });
        }
        let device = crate::device::best();
        let network = CnnLstm::new(architecture.clone(), derive_seed(config.seed, "network"), &device)?;
        let names =
            |textures: &[&StrokedTexture]| textures.iter().map(|texture| texture.id.clone()).collect();
        Ok(Self {
            adam: Adam::new(AdamConfig::usual(config.learning_rate)),
            aside: aside_segments,
            best: network.snapshot()?,
            state: State {
                way: WAY,
                config,
                scale,
                textures: names(&learned),
                aside: names(&aside),
                epochs: Vec::new(),
                n_adam_steps: 0,
                best: 0,
                part: None,
            },
            network,
            segments,
            device,
        })
    }

    /// Resumes training from the state of [`Training::keep`], with the same textures and settings; only `n_epochs` may
    /// differ.
    ///
    /// # Errors
    /// [`TrainingError::File`] for an invalid file, [`TrainingError::Other`] if textures or settings differ.
    pub fn resume(
        textures: &[&StrokedTexture],
        config: TrainingConfig,
        kept: &[u8],
    ) -> Result<Self, TrainingError> {
        let mut training = Self::new(textures, config)?;
        let (mut state, numbers) = model_file::read::<State>(STATE, kept, &training.device)?;
        state.config.n_epochs = training.state.config.n_epochs;
        let fresh = &training.state;
        if (state.way, &state.config, &state.scale, &state.textures, &state.aside)
            != (fresh.way, &fresh.config, &fresh.scale, &fresh.textures, &fresh.aside)
        {
            return Err(TrainingError::Other);
        }
        let of = |prefix: &str| -> Numbers {
            let of = |(name, tensor): (&String, &Tensor)| {
                Some((name.strip_prefix(prefix)?.to_owned(), tensor.clone()))
            };
            numbers.iter().filter_map(of).collect()
        };
        training.network.restore(&of("now."))?;
        training.best = of("best.");
        training.adam.n_steps = state.n_adam_steps;
        let (means, squares) = (of("mean."), of("square."));
        for (name, mean) in means {
            if let Some(square) = squares.get(&name) {
                training.adam.moments.insert(name, [mean, square.clone()]);
            }
        }
        training.state = state;
        Ok(training)
    }

    /// Returns the state file to resume from.
    ///
    /// # Errors
    /// [`TrainingError::File`] if a weight is not finite.
    pub fn keep(&self) -> Result<Vec<u8>, TrainingError> {
        let mut numbers = Numbers::new();
        let mut add = |prefix: &str, more: &mut dyn Iterator<Item = (String, Tensor)>| {
            numbers.extend(more.map(|(name, tensor)| (format!("{prefix}{name}"), tensor)));
        };
        add("now.", &mut self.network.snapshot()?.into_iter());
        add("best.", &mut self.best.clone().into_iter());
        let moments = || self.adam.moments.iter();
        add("mean.", &mut moments().map(|(name, [mean, _])| (name.clone(), mean.clone())));
        add("square.", &mut moments().map(|(name, [_, square])| (name.clone(), square.clone())));
        Ok(model_file::write(STATE, &self.state, &numbers)?)
    }

    /// Returns the results of the epochs so far.
    pub fn epochs(&self) -> &[Epoch] {
        &self.state.epochs
    }

    /// Returns the number of epochs so far; its fraction is that of an interrupted epoch.
    pub fn n_epochs(&self) -> f64 {
        let part = self.state.part.map_or(0.0, |part| part.n_steps as f64 / self.n_steps() as f64);
        self.state.epochs.len() as f64 + part
    }

    /// Number of batches of an epoch.
    fn n_steps(&self) -> usize {
        self.segments.len().div_ceil(self.state.config.n_batch)
    }

    /// Returns whether training is finished: all epochs are done, or early stopping applies.
    pub fn is_over(&self) -> bool {
        let n = self.state.epochs.len();
        n >= self.state.config.n_epochs
            || self.state.config.patience.is_some_and(|patience| n >= self.state.best + patience && n > 0)
    }

    /// Runs one epoch, or the rest of an interrupted one, and returns its result.
    ///
    /// `is_wanted` receives the completed fraction before each batch. If it returns false, the epoch is interrupted:
    /// what the network learned so far stays, the result is `None`, and the next call continues.
    ///
    /// # Errors
    /// [`TrainingError::Astray`] if the error is not finite, [`TrainingError::Tensor`] if the network fails.
    pub fn run_epoch(
        &mut self,
        mut is_wanted: impl FnMut(f64) -> bool,
    ) -> Result<Option<Epoch>, TrainingError> {
        let number = self.state.epochs.len() + 1;
        let seed = derive_seed(self.state.config.seed, &format!("epoch {number}"));
        let order = Random::new(seed).shuffled(self.segments.len());
        let n_steps = self.n_steps();
        let mut done = self.state.part.take().unwrap_or_default();
        while done.n_steps < n_steps {
            if !is_wanted(done.n_steps as f64 / n_steps as f64) {
                self.state.n_adam_steps = self.adam.n_steps;
                self.state.part = (done.n_steps > 0).then_some(done);
                return if done.squared_errors.is_finite() {
                    Ok(None)
                } else {
                    Err(TrainingError::Astray { round: number })
                };
            }
            let indices = &order[part(order.len(), n_steps, done.n_steps)];
            let (segments, targets) = self.segments.batch(indices, &self.device)?;
            let predicted = self.network.predict_learning(&segments)?;
            let error = (predicted - targets)?.sqr()?.mean_all()?;
            done.squared_errors += f64::from(error.to_scalar::<f32>()?) * indices.len() as f64;
            // The offset keeps the gradient of the square root finite at zero error.
            let gradients = (error + 1e-12)?.sqrt()?.backward()?;
            self.adam.step(&self.network.parameters, &gradients)?;
            done.n_steps += 1;
        }
        self.state.n_adam_steps = self.adam.n_steps;
        let learned_rmse = 100.0 * (done.squared_errors / order.len() as f64).sqrt();
        if !learned_rmse.is_finite() {
            return Err(TrainingError::Astray { round: number });
        }
        let aside_rmse = if self.aside.len() > 0 { Some(self.aside_rmse()?) } else { None };
        let epoch = Epoch { number, learned_rmse, aside_rmse };
        if aside_rmse.is_none_or(|rmse| rmse < self.best_aside_rmse()) {
            self.state.best = number;
            self.best = self.network.snapshot()?;
        }
        self.state.epochs.push(epoch);
        Ok(Some(epoch))
    }

    /// Returns the network with the weights of its best epoch. An interrupted epoch counts with its last batch.
    ///
    /// # Errors
    /// [`TrainingError::Tensor`] if the network fails or the weights cannot be restored.
    pub fn finish(mut self) -> Result<StrokeModel, TrainingError> {
        if !self.is_best_now()? {
            self.network.restore(&self.best)?;
        }
        Ok(StrokeModel::new(self.network, self.state.scale, self.device))
    }

    /// Returns whether the weights of an interrupted epoch are better than those of every complete one.
    fn is_best_now(&self) -> Result<bool, TrainingError> {
        if self.state.part.is_none() {
            return Ok(false);
        }
        Ok(self.aside.len() == 0 || self.aside_rmse()? < self.best_aside_rmse())
    }

    /// Lowest validation RMSE of the complete epochs; infinite without one.
    fn best_aside_rmse(&self) -> f64 {
        self.state.epochs.iter().filter_map(|epoch| epoch.aside_rmse).fold(f64::INFINITY, f64::min)
    }

    fn aside_rmse(&self) -> Result<f64, TrainingError> {
        let order: Vec<usize> = (0..self.aside.len()).collect();
        let mut sum = 0.0;
        for indices in order.chunks(N_AT_ONCE) {
            let (segments, targets) = self.aside.batch(indices, &self.device)?;
            let error = (self.network.predict(&segments)? - targets)?.sqr()?.mean_all()?;
            sum += f64::from(error.to_scalar::<f32>()?) * indices.len() as f64;
        }
        Ok(100.0 * (sum / order.len() as f64).sqrt())
    }
}

/// Returns the segments of a batch; all batches of an epoch are equally large, or differ by one.
///
/// Batch normalization needs this: statistics of a few segments are unreliable, and a single one normalizes to zero.
fn part(n_segments: usize, n_steps: usize, step: usize) -> Range<usize> {
    n_segments * step / n_steps..n_segments * (step + 1) / n_steps
}

#[cfg(test)]
mod tests;
