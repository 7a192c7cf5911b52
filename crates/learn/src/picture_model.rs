//! Attributes predicted from pictures: small dense networks (heads) on features of a frozen backbone or texture
//! statistics.
//!
//! The heads follow AttributeNet ("Text-Driven Generative Framework for Multimodal Visual and Haptic Texture
//! Synthesis"): layers of 512, 128 and 128 units, one output per attribute, label noise, Adam and early stopping.
//!
//! A model is an ensemble of heads, each trained with its own validation split. The prediction is their mean. Its
//! standard deviation combines the validation error and the spread of the heads, and grows for pictures unlike the
//! training set.

mod error;
mod learning;
pub mod rivals;

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::maths::statistics::{mean, quantile, standard_deviation};
use shagreen_core::surfaces::prompt::OPEN;

use self::learning::Learning;
use crate::backbone::{Backbone, BackboneKind};
use crate::dense_stack;
use crate::feature_scale::{FeatureScale, unlikeness};
use crate::model_file::{self, ModelFileError, Numbers};
use crate::parameters::Parameters;
use crate::picture_set::Seen;

pub use self::error::PictureModelError;

/// Kind of the file.
pub(crate) const MODEL: &str = "attributes from pictures";

/// Quantile of the training pictures' unlikeness that counts as usual.
const USUAL_SHARE: f64 = 0.95;

/// Feature extractor of pictures.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeatureExtractor {
    /// Texture statistics ([`shagreen_core::surfaces::picture_features`]); no other file is needed.
    Statistics,
    /// A pretrained backbone network, identified by the hash of its file.
    Network {
        /// Kind of the network.
        kind: BackboneKind,
        /// SHA-256 of the network's file.
        sha256: String,
    },
}

impl FeatureExtractor {
    /// Returns the extractor for a backbone network, or else texture statistics.
    pub fn of(backbone: Option<&Backbone>) -> Self {
        match backbone {
            Some(backbone) => Self::Network { kind: backbone.kind(), sha256: backbone.sha256().to_owned() },
            None => Self::Statistics,
        }
    }

    /// Returns the name of the extractor.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Statistics => "statistics of the picture",
            Self::Network { kind, .. } => kind.name(),
        }
    }
}

/// Training settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureConfig {
    /// Units of each hidden layer.
    pub hidden: Vec<usize>,
    /// Maximum number of epochs.
    pub n_epochs: usize,
    /// Pictures per batch.
    pub n_batch: usize,
    /// Learning rate of Adam.
    pub learning_rate: f64,
    /// Amplitude of uniform label noise, relative to the label range of 0 to 1; drawn anew at every step.
    pub label_noise: f64,
    /// Epochs without a lower validation error before a head stops early.
    pub patience: usize,
    /// Number of heads.
    pub n_heads: usize,
    /// Seed of all random draws.
    pub seed: u64,
}

impl PictureConfig {
    /// Returns the settings of the paper; it does not state the batch size, which is 32 here.
    pub fn paper(n_epochs: usize, patience: usize, n_heads: usize, seed: u64) -> Self {
        Self {
            hidden: vec![512, 128, 128],
            n_epochs,
            n_batch: 32,
            learning_rate: 1e-3,
            label_noise: 0.01,
            patience,
            n_heads,
            seed,
        }
    }
}

/// Metadata of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct About {
    eyes: FeatureExtractor,
    attributes: Vec<String>,
    /// Sizes of all layers, features and outputs included.
    sizes: Vec<usize>,
    n_heads: usize,
    /// Validation RMSE of each attribute, in points of 0 to 100.
    aside_rmse: Vec<f64>,
    /// Unlikeness up to which a picture counts as similar to the training set.
    usual_unlikeness: f64,
    learned_from: String,
}

/// A trained ensemble of heads.
#[derive(Clone, Debug)]
pub struct PictureModel {
    about: About,
    scale: FeatureScale,
    heads: Vec<Parameters>,
    device: Device,
}

/// Metadata of a training run.
#[derive(Clone, Debug)]
pub struct TrainingMetadata {
    /// Feature extractor of the pictures.
    pub eyes: FeatureExtractor,
    /// Names of the labels.
    pub attributes: Vec<String>,
    /// Description of the training data.
    pub learned_from: String,
}

/// Smallest number of training pictures.
const LEAST: usize = 8;

impl PictureModel {
    /// Trains a model; labels are on a scale of 0 to 100 and may exceed it.
    ///
    /// `epoch` receives the number of epochs so far, over all heads. If it returns false, training stops and the model
    /// keeps what it has learned so far.
    ///
    /// # Errors
    /// [`PictureModelError::TooFew`], [`PictureModelError::Picture`] or [`PictureModelError::Settings`] for unusable
    /// input.
    pub fn learn(
        pictures: &[&Seen],
        lesson: TrainingMetadata,
        config: &PictureConfig,
        mut epoch: impl FnMut(usize) -> bool,
    ) -> Result<Self, PictureModelError> {
        let n_labels = lesson.attributes.len();
        check(pictures, n_labels, config)?;
        let device = crate::device::best();
        let scale = FeatureScale::of(&pictures.iter().map(|seen| &seen.features[..]).collect::<Vec<_>>());
        let rows: Vec<Vec<f32>> = pictures.iter().map(|seen| scale.apply(&seen.features)).collect();
        let unlikeness: Vec<f64> = rows.iter().map(|row| unlikeness(row)).collect();
        let labels = labels_of(pictures);
        let sizes = [&[rows[0].len()][..], &config.hidden, &[n_labels]].concat();
        let network = |parameters: &Parameters, x: &Tensor| dense_stack::run(parameters, x, sizes.len() - 1);
        let mut heads = Vec::with_capacity(config.n_heads);
        let mut squares = vec![Vec::new(); n_labels];
        let mut n_epochs = 0;
        for head in 0..config.n_heads {
            let seed = derive_seed(config.seed, &format!("head {head}"));
            let parameters = dense_stack::fresh(&sizes, derive_seed(seed, "weights"), &device)?;
            let mut learning = Learning::new(&rows, &labels, (&network, parameters), seed, &device)?;
            let mut is_on = true;
            while is_on && !learning.is_over(config) {
                learning.run_epoch(config)?;
                n_epochs += 1;
                is_on = epoch(n_epochs);
            }
            let (parameters, errors) = learning.finish()?;
            for error in errors {
                for (squares, error) in squares.iter_mut().zip(error) {
                    squares.push((100.0 * f64::from(error)).powi(2));
                }
            }
            heads.push(parameters);
            if !is_on {
                break;
            }
        }
        let about = About {
            eyes: lesson.eyes,
            attributes: lesson.attributes,
            sizes,
            n_heads: heads.len(),
            aside_rmse: squares.iter().map(|squares| mean(squares).sqrt()).collect(),
            usual_unlikeness: quantile(&unlikeness, USUAL_SHARE).map_or(1.0, |usual| usual.max(1.0)),
            learned_from: lesson.learned_from,
        };
        Ok(Self { about, scale, heads, device })
    }

    /// Returns the feature extractor that the model needs.
    pub fn eyes(&self) -> &FeatureExtractor {
        &self.about.eyes
    }

    /// Returns the names of the predicted attributes.
    pub fn attributes(&self) -> &[String] {
        &self.about.attributes
    }

    /// Returns a description of the training data.
    pub fn learned_from(&self) -> &str {
        &self.about.learned_from
    }

    /// Returns the attributes predicted from a picture's features, 0 to 100, with standard deviations.
    ///
    /// # Errors
    /// [`PictureModelError::Picture`] for another number of features, or a feature that is not finite.
    pub fn predict(&self, features: &[f32]) -> Result<Vec<Estimate>, PictureModelError> {
        let row = self.scaled(features)?;
        let unlike = (unlikeness(&row) / self.about.usual_unlikeness).max(1.0);
        let n_features = row.len();
        let x = Tensor::from_vec(row, (1, n_features), &self.device)?;
        let mut by_head = Vec::with_capacity(self.heads.len());
        for head in &self.heads {
            let n_layers = self.about.sizes.len() - 1;
            by_head.push(dense_stack::run(head, &x, n_layers)?.flatten_all()?.to_vec1::<f32>()?);
        }
        let estimate = |(attribute, rmse): (usize, &f64)| {
            let values: Vec<f64> = by_head.iter().map(|head| 100.0 * f64::from(head[attribute])).collect();
            Estimate {
                mean: mean(&values).clamp(0.0, 100.0),
                // Never above the standard deviation of an unknown attribute.
                deviation: (unlike * rmse.hypot(standard_deviation(&values))).min(OPEN.deviation),
            }
        };
        Ok(self.about.aside_rmse.iter().enumerate().map(estimate).collect())
    }

    /// Returns how far a picture is from the training pictures; 95 % of these do not exceed 1.
    ///
    /// # Errors
    /// As [`PictureModel::predict`].
    pub fn unlikeness(&self, features: &[f32]) -> Result<f64, PictureModelError> {
        Ok(unlikeness(&self.scaled(features)?) / self.about.usual_unlikeness)
    }

    fn scaled(&self, features: &[f32]) -> Result<Vec<f32>, PictureModelError> {
        let expected = [self.scale.n_features(), self.about.attributes.len()];
        if features.len() != expected[0] || features.iter().any(|x| !x.is_finite()) {
            let n_features = features.len();
            return Err(PictureModelError::Picture { index: 0, n_features, n_labels: expected[1], expected });
        }
        Ok(self.scale.apply(features))
    }

    /// Returns the bytes of the model's file.
    ///
    /// # Errors
    /// [`PictureModelError::File`] if a weight is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, PictureModelError> {
        let mut numbers = Numbers::new();
        self.add_to(&mut numbers, "")?;
        Ok(model_file::write(MODEL, &self.about, &numbers)?)
    }

    /// Returns the model of a file.
    ///
    /// # Errors
    /// [`PictureModelError::File`] for an invalid file, [`PictureModelError::Settings`] for impossible sizes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PictureModelError> {
        let device = crate::device::best();
        let (about, numbers) = model_file::read::<About>(MODEL, bytes, &device)?;
        Self::read(about, &numbers, "", device)
    }

    /// Returns the metadata of the model.
    pub(crate) fn about(&self) -> &About {
        &self.about
    }

    /// Adds the weights to the tensors of a file, with names that begin with `prefix`.
    pub(crate) fn add_to(&self, numbers: &mut Numbers, prefix: &str) -> Result<(), candle_core::Error> {
        for (index, head) in self.heads.iter().enumerate() {
            dense_stack::add_to(head, numbers, &format!("{prefix}head{index}."))?;
        }
        self.scale.add_to(numbers, prefix)
    }

    /// Reads what [`PictureModel::add_to`] wrote.
    ///
    /// # Errors
    /// As [`PictureModel::from_bytes`].
    pub(crate) fn read(
        about: About,
        numbers: &Numbers,
        prefix: &str,
        device: Device,
    ) -> Result<Self, PictureModelError> {
        let [n_features, .., n_attributes] = about.sizes[..] else { return Err(PictureModelError::Settings) };
        let is_possible = about.sizes.iter().all(|n| (1..=MOST_NUMBERS).contains(n))
            && about.sizes.len() <= MOST_LAYERS
            && (1..=MOST_HEADS).contains(&about.n_heads)
            && [about.attributes.len(), about.aside_rmse.len()] == [n_attributes; 2]
            && about.aside_rmse.iter().all(|rmse| rmse.is_finite() && *rmse >= 0.0)
            && about.usual_unlikeness.is_finite()
            && about.usual_unlikeness > 0.0;
        if !is_possible {
            return Err(PictureModelError::Settings);
        }
        let scale = FeatureScale::read(numbers, prefix, n_features).map_err(ModelFileError::Shape)?;
        let mut heads = Vec::with_capacity(about.n_heads);
        for index in 0..about.n_heads {
            heads.push(dense_stack::read(numbers, &format!("{prefix}head{index}."), &about.sizes, &device)?);
        }
        Ok(Self { about, scale, heads, device })
    }
}

/// Limits of layer size, layers and heads; they guard against files that would allocate excessive memory.
const MOST_NUMBERS: usize = 1 << 14;
const MOST_LAYERS: usize = 16;
const MOST_HEADS: usize = 64;

/// Labels of pictures, relative to 100.
fn labels_of(pictures: &[&Seen]) -> Vec<Vec<f32>> {
    let of = |seen: &&Seen| seen.labels.iter().map(|label| (label / 100.0) as f32).collect();
    pictures.iter().map(of).collect()
}

fn check(pictures: &[&Seen], n_labels: usize, config: &PictureConfig) -> Result<(), PictureModelError> {
    if pictures.len() < LEAST {
        return Err(PictureModelError::TooFew { n: pictures.len(), least: LEAST });
    }
    if n_labels == 0
        || !(1..=MOST_HEADS).contains(&config.n_heads)
        || config.n_batch == 0
        || config.hidden.contains(&0)
        || !config.label_noise.is_finite()
    {
        return Err(PictureModelError::Settings);
    }
    let expected = [pictures[0].features.len(), n_labels];
    let is_wrong = |seen: &&Seen| {
        [seen.features.len(), seen.labels.len()] != expected
            || seen.features.iter().any(|x| !x.is_finite())
            || seen.labels.iter().any(|x| !x.is_finite())
    };
    match pictures.iter().position(is_wrong) {
        Some(index) => {
            let [n_features, n_labels] = [pictures[index].features.len(), pictures[index].labels.len()];
            Err(PictureModelError::Picture { index, n_features, n_labels, expected })
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
