//! How the network learns from strokes: Adam, root mean square error, early stop; it can be stopped at any epoch and goes
//! on as if it had not been.

use std::ops::Range;

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::rng::{Random, derive_seed};

use crate::cnn_lstm::{Architecture, CnnLstm};
use crate::model_file::{self, ModelFileError, Numbers};
use crate::parameters::{Adam, AdamConfig};
use crate::stroke_model::{N_AT_ONCE, StrokeModel};
use crate::stroke_set::{N_CHANNELS, Scale, Segments, StrokedTexture};

/// Kind of a file with a network that is learning.
const STATE: &str = "a training of attributes from strokes";

/// Version of everything below that a training would not go on with as it began.
const WAY: u32 = 1;

/// How to learn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingConfig {
    /// Sizes of the network.
    pub architecture: Architecture,
    /// Most rounds over all segments.
    pub n_epochs: usize,
    /// Segments a step, at most.
    pub n_batch: usize,
    /// Adam's rate.
    pub learning_rate: f64,
    /// Rounds without a better prediction of what is kept aside after which it stops; `None` never stops and keeps nothing
    /// aside.
    pub patience: Option<usize>,
    /// Everything that is drawn.
    pub seed: u64,
}

impl TrainingConfig {
    /// The paper's: steps of 32 (the paper does not say), at a rate of 0.001.
    pub fn paper(architecture: Architecture, n_epochs: usize, patience: Option<usize>, seed: u64) -> Self {
        Self { architecture, n_epochs, n_batch: 32, learning_rate: 1e-3, patience, seed }
    }
}

/// Why nothing is learned.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrainingError {
    /// There is too little.
    #[error(
        "{n_segments} segments of {n_textures} textures are too few to learn from; two textures with strokes of {n_samples} samples are the least"
    )]
    TooFew {
        /// Segments there are.
        n_segments: usize,
        /// Textures there are.
        n_textures: usize,
        /// Samples of a segment.
        n_samples: usize,
    },
    /// A size is zero or larger than anything could be.
    #[error("the network cannot have these sizes")]
    Sizes,
    /// What it has learned is no number any more.
    #[error("the learning went astray in round {round}; begin anew by another seed, in another folder")]
    Astray {
        /// Number of the round, from 1.
        round: usize,
    },
    /// What is said of a network is not of this one.
    #[error("what is said of the network does not fit its {n_outputs} attributes")]
    Card {
        /// Attributes of the network.
        n_outputs: usize,
    },
    /// What was kept belongs to another training.
    #[error(
        "what was kept belongs to a training with other settings or textures; begin anew in another folder"
    )]
    Other,
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// Tensors do not fit.
    #[error("the network could not be worked out: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// What a round over all segments came to, in points of 0..100.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// Number of the round, from 1.
    pub number: usize,
    /// Root mean square error of what was learned from, over the round.
    pub learned_rmse: f64,
    /// That of what was kept aside.
    pub aside_rmse: Option<f64>,
}

/// What a file of a training says beside its numbers.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct State {
    /// The [`WAY`] that it has learned by.
    #[serde(default)]
    way: u32,
    config: TrainingConfig,
    scale: Scale,
    textures: Vec<String>,
    aside: Vec<String>,
    epochs: Vec<Epoch>,
    n_adam_steps: usize,
    /// Number of the best round.
    best: usize,
}

/// A network that is learning.
pub struct Training {
    state: State,
    network: CnnLstm,
    adam: Adam,
    segments: Segments,
    aside: Segments,
    /// What the network had learned after its best round.
    best: Numbers,
    device: Device,
}

impl Training {
    /// Begins with a network that has learned nothing. With patience, a tenth of the textures, at least one, is kept aside.
    ///
    /// # Errors
    /// See [`TrainingError`].
    pub fn new(textures: &[&StrokedTexture], config: TrainingConfig) -> Result<Self, TrainingError> {
        if !config.architecture.is_possible()
            || config.architecture.n_channels != N_CHANNELS
            || config.n_batch == 0
        {
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
        let n_samples = config.architecture.n_samples;
        let segments = Segments::of(&learned, n_samples, &scale);
        if segments.len() == 0 || learned.len() < 2 {
            let (n_segments, n_textures) = (segments.len(), learned.len());
            return Err(TrainingError::TooFew { n_segments, n_textures, n_samples });
        }
        let device = crate::device::best();
        let network =
            CnnLstm::new(config.architecture.clone(), derive_seed(config.seed, "network"), &device)?;
        let names =
            |textures: &[&StrokedTexture]| textures.iter().map(|texture| texture.id.clone()).collect();
        Ok(Self {
            adam: Adam::new(AdamConfig::usual(config.learning_rate)),
            aside: Segments::of(&aside, n_samples, &scale),
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
            },
            network,
            segments,
            device,
        })
    }

    /// Goes on from what [`Training::keep`] gave for the same textures and settings; the number of rounds may be another.
    ///
    /// # Errors
    /// See [`TrainingError`]; [`TrainingError::Other`] where it is of something else.
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

    /// All there is to go on from.
    ///
    /// # Errors
    /// See [`TrainingError`].
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

    /// The rounds so far.
    pub fn epochs(&self) -> &[Epoch] {
        &self.state.epochs
    }

    /// Whether there is nothing more to learn.
    pub fn is_over(&self) -> bool {
        let n = self.state.epochs.len();
        n >= self.state.config.n_epochs
            || self.state.config.patience.is_some_and(|patience| n >= self.state.best + patience && n > 0)
    }

    /// One round over all segments. `is_wanted` is asked before each step with the share that is done; once it says no, the
    /// round is not counted: the training has to be resumed from what was kept.
    ///
    /// # Errors
    /// See [`TrainingError`].
    pub fn run_epoch(
        &mut self,
        mut is_wanted: impl FnMut(f64) -> bool,
    ) -> Result<Option<Epoch>, TrainingError> {
        let number = self.state.epochs.len() + 1;
        let seed = derive_seed(self.state.config.seed, &format!("epoch {number}"));
        let order = Random::new(seed).shuffled(self.segments.len());
        let mut sum = 0.0;
        let n_steps = order.len().div_ceil(self.state.config.n_batch);
        for step in 0..n_steps {
            let indices = &order[part(order.len(), n_steps, step)];
            if !is_wanted(step as f64 / n_steps as f64) {
                return Ok(None);
            }
            let (segments, targets) = self.segments.batch(indices, &self.device)?;
            let predicted = self.network.predict_learning(&segments)?;
            let error = (predicted - targets)?.sqr()?.mean_all()?;
            sum += f64::from(error.to_scalar::<f32>()?) * indices.len() as f64;
            // Its slope has no end at zero.
            let gradients = (error + 1e-12)?.sqrt()?.backward()?;
            self.adam.step(&self.network.parameters, &gradients)?;
        }
        self.state.n_adam_steps = self.adam.n_steps;
        let learned_rmse = 100.0 * (sum / order.len() as f64).sqrt();
        if !learned_rmse.is_finite() {
            return Err(TrainingError::Astray { round: number });
        }
        let aside_rmse = if self.aside.len() > 0 { Some(self.aside_rmse()?) } else { None };
        let epoch = Epoch { number, learned_rmse, aside_rmse };
        let best =
            self.state.epochs.iter().filter_map(|epoch| epoch.aside_rmse).fold(f64::INFINITY, f64::min);
        if aside_rmse.is_none_or(|rmse| rmse < best) {
            self.state.best = number;
            self.best = self.network.snapshot()?;
        }
        self.state.epochs.push(epoch);
        Ok(Some(epoch))
    }

    /// What the network knew after its best round.
    ///
    /// # Errors
    /// See [`TrainingError`].
    pub fn finish(mut self) -> Result<StrokeModel, TrainingError> {
        self.network.restore(&self.best)?;
        Ok(StrokeModel::new(self.network, self.state.scale, self.device))
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

/// The segments of a step, where all steps of a round have as many but for one: a batch of a few has no mean to speak of,
/// and of a single one nothing is left once it is normalized.
fn part(n_segments: usize, n_steps: usize, step: usize) -> Range<usize> {
    n_segments * step / n_steps..n_segments * (step + 1) / n_steps
}

#[cfg(test)]
mod tests;
