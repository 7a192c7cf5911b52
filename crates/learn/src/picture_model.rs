//! Attributes from pictures: dense layers over what a frozen network, or statistics, see in them (AttributeNet, "Text-Driven
//! Generative Framework for Multimodal Visual and Haptic Texture Synthesis": layers of 512, 128 and 128 to one number an
//! attribute, labels with a little noise, Adam, early stop).
//!
//! Several such heads learn from the same pictures, each with others kept aside; they predict their mean. How far they are
//! off what was kept aside, how far they are apart, and how unlike anything they learned from a picture is, say how unsure
//! that is.

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::gaussian_process::Estimate;
use shagreen_core::prompt::OPEN;
use shagreen_core::rng::{Random, derive_seed};
use shagreen_core::statistics::{mean, quantile, standard_deviation};

use crate::backbone::{Backbone, BackboneKind};
use crate::dense;
use crate::init::Uniform;
use crate::model_file::{self, ModelFileError, Numbers};
use crate::parameters::{Adam, AdamConfig, Parameters};
use crate::picture_set::Seen;

/// Kind of a file with such a model.
const MODEL: &str = "attributes from pictures";

/// Least deviation that a feature is divided by: one that is almost the same in all pictures says nothing.
const LEAST_DEVIATION: f32 = 1e-6;
/// Largest feature, in deviations: a picture unlike all others must not throw a prediction anywhere.
const LARGEST: f32 = 6.0;
/// Share of the pictures which are less unlike the others than what counts as unlike.
const USUAL_SHARE: f64 = 0.95;

/// Who looks at a picture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Eyes {
    /// [`shagreen_core::picture_features`]: nothing else is needed.
    Statistics,
    /// A network of others, by the hash of its file.
    Network {
        /// Which.
        kind: BackboneKind,
        /// Of its file.
        sha256: String,
    },
}

impl Eyes {
    /// Those of a network, or else statistics.
    pub fn of(backbone: Option<&Backbone>) -> Self {
        match backbone {
            Some(backbone) => Self::Network { kind: backbone.kind(), sha256: backbone.sha256().to_owned() },
            None => Self::Statistics,
        }
    }

    /// What they are called.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Statistics => "statistics of the picture",
            Self::Network { kind, .. } => kind.name(),
        }
    }
}

/// How heads learn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureConfig {
    /// Numbers after each layer but the last.
    pub hidden: Vec<usize>,
    /// Most rounds over all pictures.
    pub n_epochs: usize,
    /// Pictures a step.
    pub n_batch: usize,
    /// Adam's rate.
    pub learning_rate: f64,
    /// Labels are learned as if they were off by up to this, 0..1 of their range, another way at every step.
    pub label_noise: f64,
    /// Rounds without a better prediction of what is kept aside after which a head stops.
    pub patience: usize,
    /// How many heads learn.
    pub n_heads: usize,
    /// Everything that is drawn.
    pub seed: u64,
}

impl PictureConfig {
    /// The paper's; steps of 32, which it does not say.
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

/// Why nothing is learned, or predicted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureModelError {
    /// There is too little.
    #[error("{n} pictures are too few to learn from, {least} are the least")]
    TooFew {
        /// Pictures there are.
        n: usize,
        /// Pictures there should be.
        least: usize,
    },
    /// Pictures have different numbers of features or labels, or a number is not finite.
    #[error(
        "picture {index} (from 0) has {n_features} features and {n_labels} labels, or one that is not finite; {expected:?} are expected"
    )]
    Picture {
        /// Which.
        index: usize,
        /// Features it has.
        n_features: usize,
        /// Labels it has.
        n_labels: usize,
        /// Features and labels it should have.
        expected: [usize; 2],
    },
    /// A number of the settings makes no sense.
    #[error("a head cannot learn with these settings")]
    Settings,
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// Tensors do not fit.
    #[error("the head could not be worked out: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// What a file of a model says beside its numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct About {
    eyes: Eyes,
    attributes: Vec<String>,
    /// Sizes of all layers from the features on.
    sizes: Vec<usize>,
    n_heads: usize,
    /// Root mean square errors of what was kept aside, in points.
    aside_rmse: Vec<f64>,
    /// How unlike the others a picture may be before it counts as unlike.
    usual_unlikeness: f64,
    learned_from: String,
}

/// A model that has learned.
#[derive(Clone, Debug)]
pub struct PictureModel {
    about: About,
    /// Mean and deviation of each feature.
    scale: [Vec<f32>; 2],
    heads: Vec<Parameters>,
    device: Device,
}

/// What a model is told beside its pictures.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// Who looked at the pictures.
    pub eyes: Eyes,
    /// What the labels are called.
    pub attributes: Vec<String>,
    /// What was learned from, in words.
    pub learned_from: String,
}

/// Fewest pictures to learn from.
const LEAST: usize = 8;

impl PictureModel {
    /// Learns; labels go from 0 to 100, and beyond for what lies beyond. `epoch` is called with the number of rounds of all heads so far, and stops by false:
    /// what is learned until then is the model.
    ///
    /// # Errors
    /// See [`PictureModelError`].
    pub fn learn(
        pictures: &[&Seen],
        lesson: Lesson,
        config: &PictureConfig,
        mut epoch: impl FnMut(usize) -> bool,
    ) -> Result<Self, PictureModelError> {
        check(pictures, &lesson, config)?;
        let device = crate::device::best();
        let scale = scale_of(pictures);
        let n_labels = lesson.attributes.len();
        let rows: Vec<Vec<f32>> = pictures.iter().map(|seen| scaled(&seen.features, &scale)).collect();
        let unlikeness: Vec<f64> = rows.iter().map(|row| unlikeness(row)).collect();
        let labels: Vec<Vec<f32>> = pictures
            .iter()
            .map(|seen| seen.labels.iter().map(|label| (label / 100.0) as f32).collect())
            .collect();
        let sizes = [&[rows[0].len()][..], &config.hidden, &[n_labels]].concat();
        let mut heads = Vec::with_capacity(config.n_heads);
        let mut squares = vec![Vec::new(); n_labels];
        let mut n_epochs = 0;
        for head in 0..config.n_heads {
            let seed = derive_seed(config.seed, &format!("head {head}"));
            let mut learning = Learning::new(&rows, &labels, &sizes, seed, &device)?;
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

    /// Who must have looked at a picture.
    pub fn eyes(&self) -> &Eyes {
        &self.about.eyes
    }

    /// What it predicts.
    pub fn attributes(&self) -> &[String] {
        &self.about.attributes
    }

    /// What it learned from, in words.
    pub fn learned_from(&self) -> &str {
        &self.about.learned_from
    }

    /// Attributes of a picture in which these features were seen, 0..100.
    ///
    /// # Errors
    /// [`PictureModelError::Picture`] for another number of features.
    pub fn predict(&self, features: &[f32]) -> Result<Vec<Estimate>, PictureModelError> {
        let expected = [self.scale[0].len(), self.about.attributes.len()];
        if features.len() != expected[0] || features.iter().any(|x| !x.is_finite()) {
            let n_features = features.len();
            return Err(PictureModelError::Picture { index: 0, n_features, n_labels: expected[1], expected });
        }
        let row = scaled(features, &self.scale);
        let unlike = (unlikeness(&row) / self.about.usual_unlikeness).max(1.0);
        let x = Tensor::from_vec(row, (1, expected[0]), &self.device)?;
        let mut by_head = Vec::with_capacity(self.heads.len());
        for head in &self.heads {
            by_head.push(run(head, &x, self.about.sizes.len() - 1)?.flatten_all()?.to_vec1::<f32>()?);
        }
        let estimate = |(attribute, rmse): (usize, &f64)| {
            let values: Vec<f64> = by_head.iter().map(|head| 100.0 * f64::from(head[attribute])).collect();
            Estimate {
                mean: mean(&values).clamp(0.0, 100.0),
                // Nothing is less sure than what nothing is known of.
                deviation: (unlike * rmse.hypot(standard_deviation(&values))).min(OPEN.deviation),
            }
        };
        Ok(self.about.aside_rmse.iter().enumerate().map(estimate).collect())
    }

    /// The bytes of its file.
    ///
    /// # Errors
    /// See [`PictureModelError`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, PictureModelError> {
        let mut numbers = Numbers::new();
        for (index, head) in self.heads.iter().enumerate() {
            let named = head.snapshot()?;
            numbers.extend(named.into_iter().map(|(name, tensor)| (format!("head{index}.{name}"), tensor)));
        }
        for (name, values) in ["scale.mean", "scale.deviation"].into_iter().zip(&self.scale) {
            numbers.insert(name.to_owned(), Tensor::from_slice(values, values.len(), &Device::Cpu)?);
        }
        Ok(model_file::write(MODEL, &self.about, &numbers)?)
    }

    /// The model of a file.
    ///
    /// # Errors
    /// See [`PictureModelError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PictureModelError> {
        let device = crate::device::best();
        let (about, numbers) = model_file::read::<About>(MODEL, bytes, &device)?;
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
        let scale_of = |name: &str| match numbers.get(name) {
            Some(tensor) if tensor.dims() == [n_features] => tensor.to_vec1::<f32>(),
            _ => candle_core::bail!("{name} does not have {n_features} numbers"),
        };
        let scale = ["scale.mean", "scale.deviation"].map(scale_of);
        let [means, deviations] = scale.map(|part| part.map_err(ModelFileError::Shape));
        let mut heads = Vec::with_capacity(about.n_heads);
        for index in 0..about.n_heads {
            let prefix = format!("head{index}.");
            let of = |(name, tensor): (&String, &Tensor)| {
                Some((name.strip_prefix(&prefix)?.to_owned(), tensor.clone()))
            };
            let named: Numbers = numbers.iter().filter_map(of).collect();
            check_shapes(&named, &about.sizes)?;
            let head = fresh(&about.sizes, 0, &device)?;
            head.restore(&named).map_err(ModelFileError::Shape)?;
            heads.push(head);
        }
        Ok(Self { about, scale: [means?, deviations?], heads, device })
    }
}

/// Looks, before anything is made for it, whether a file has the layers that it says.
fn check_shapes(numbers: &Numbers, sizes: &[usize]) -> Result<(), ModelFileError> {
    for (index, pair) in sizes.windows(2).enumerate() {
        let name = format!("dense{index}.weight");
        let found = numbers.get(&name).map(Tensor::dims);
        if found != Some(pair) {
            let what = format!("\"{name}\" has the shape {found:?}, {pair:?} is expected");
            return Err(ModelFileError::Shape(candle_core::Error::Msg(what)));
        }
    }
    Ok(())
}

/// More numbers in a layer, layers and heads are no model of ours, but a file that asks for much memory.
const MOST_NUMBERS: usize = 1 << 14;
const MOST_LAYERS: usize = 16;
const MOST_HEADS: usize = 64;

fn check(pictures: &[&Seen], lesson: &Lesson, config: &PictureConfig) -> Result<(), PictureModelError> {
    if pictures.len() < LEAST {
        return Err(PictureModelError::TooFew { n: pictures.len(), least: LEAST });
    }
    if lesson.attributes.is_empty()
        || !(1..=MOST_HEADS).contains(&config.n_heads)
        || config.n_batch == 0
        || config.hidden.contains(&0)
        || !config.label_noise.is_finite()
    {
        return Err(PictureModelError::Settings);
    }
    let expected = [pictures[0].features.len(), lesson.attributes.len()];
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

/// Mean and deviation of each feature.
fn scale_of(pictures: &[&Seen]) -> [Vec<f32>; 2] {
    let column = |feature: usize| -> Vec<f64> {
        pictures.iter().map(|seen| f64::from(seen.features[feature])).collect()
    };
    let n_features = pictures[0].features.len();
    let means = (0..n_features).map(|feature| mean(&column(feature)) as f32).collect();
    let deviations = (0..n_features).map(|feature| standard_deviation(&column(feature)) as f32).collect();
    [means, deviations]
}

fn scaled(features: &[f32], [means, deviations]: &[Vec<f32>; 2]) -> Vec<f32> {
    let of = |((x, mean), deviation): ((&f32, &f32), &f32)| {
        ((x - mean) / deviation.max(LEAST_DEVIATION)).clamp(-LARGEST, LARGEST)
    };
    features.iter().zip(means).zip(deviations).map(of).collect()
}

/// Root mean square of scaled features: about one for a picture like those that were learned from.
fn unlikeness(row: &[f32]) -> f64 {
    mean(&row.iter().map(|x| f64::from(*x).powi(2)).collect::<Vec<f64>>()).sqrt()
}

fn fresh(sizes: &[usize], seed: u64, device: &Device) -> Result<Parameters, candle_core::Error> {
    let mut parameters = Parameters::default();
    let mut uniform = Uniform::new(seed);
    for (index, pair) in sizes.windows(2).enumerate() {
        dense::add(&mut parameters, &format!("dense{index}"), [pair[0], pair[1]], &mut uniform, device)?;
    }
    Ok(parameters)
}

fn run(parameters: &Parameters, x: &Tensor, n_layers: usize) -> Result<Tensor, candle_core::Error> {
    let mut x = x.clone();
    for index in 0..n_layers {
        x = dense::apply(parameters, &format!("dense{index}"), &x)?;
        if index + 1 < n_layers {
            x = x.relu()?;
        }
    }
    Ok(x)
}

/// A head that is learning.
struct Learning<'a> {
    rows: &'a [Vec<f32>],
    labels: &'a [Vec<f32>],
    learned: Vec<usize>,
    aside: Vec<usize>,
    n_layers: usize,
    parameters: Parameters,
    adam: Option<Adam>,
    random: Random,
    n_epochs: usize,
    best_epoch: usize,
    best_error: f64,
    best: Numbers,
    device: &'a Device,
}

impl<'a> Learning<'a> {
    fn new(
        rows: &'a [Vec<f32>],
        labels: &'a [Vec<f32>],
        sizes: &[usize],
        seed: u64,
        device: &'a Device,
    ) -> Result<Self, candle_core::Error> {
        let mut random = Random::new(derive_seed(seed, "order"));
        let order = random.shuffled(rows.len());
        let (aside, learned) = order.split_at(rows.len().div_ceil(10));
        let parameters = fresh(sizes, derive_seed(seed, "weights"), device)?;
        let best = parameters.snapshot()?;
        Ok(Self {
            rows,
            labels,
            learned: learned.to_vec(),
            aside: aside.to_vec(),
            n_layers: sizes.len() - 1,
            parameters,
            adam: None,
            random,
            n_epochs: 0,
            best_epoch: 0,
            best_error: f64::INFINITY,
            best,
            device,
        })
    }

    fn is_over(&self, config: &PictureConfig) -> bool {
        self.n_epochs >= config.n_epochs || self.n_epochs - self.best_epoch >= config.patience.max(1)
    }

    fn run_epoch(&mut self, config: &PictureConfig) -> Result<(), candle_core::Error> {
        let mut adam = self.adam.take().unwrap_or_else(|| Adam::new(AdamConfig::usual(config.learning_rate)));
        let order = self.random.shuffled(self.learned.len());
        for batch in order.chunks(config.n_batch) {
            let indices: Vec<usize> = batch.iter().map(|index| self.learned[*index]).collect();
            let x = tensor(self.rows, &indices, self.device)?;
            let mut labels: Vec<Vec<f32>> = indices.iter().map(|index| self.labels[*index].clone()).collect();
            for label in labels.iter_mut().flatten() {
                *label += (config.label_noise * (2.0 * self.random.uniform() - 1.0)) as f32;
            }
            let all: Vec<usize> = (0..labels.len()).collect();
            let y = tensor(&labels, &all, self.device)?;
            let error = (run(&self.parameters, &x, self.n_layers)? - y)?.sqr()?.mean_all()?;
            // Its slope has no end at zero.
            let gradients = (error + 1e-12)?.sqrt()?.backward()?;
            adam.step(&self.parameters, &gradients)?;
        }
        self.adam = Some(adam);
        self.n_epochs += 1;
        let squares: Vec<f64> =
            self.aside_errors()?.into_iter().flatten().map(|error| f64::from(error).powi(2)).collect();
        let error = mean(&squares);
        if error < self.best_error {
            (self.best_error, self.best_epoch) = (error, self.n_epochs);
            self.best = self.parameters.snapshot()?;
        }
        Ok(())
    }

    /// How far off each picture that was kept aside is, label by label.
    fn aside_errors(&self) -> Result<Vec<Vec<f32>>, candle_core::Error> {
        let x = tensor(self.rows, &self.aside, self.device)?;
        let y = tensor(self.labels, &self.aside, self.device)?;
        (run(&self.parameters, &x, self.n_layers)? - y)?.to_vec2()
    }

    /// The best that was learned, and how far off it is.
    fn finish(self) -> Result<(Parameters, Vec<Vec<f32>>), candle_core::Error> {
        self.parameters.restore(&self.best)?;
        let errors = self.aside_errors()?;
        Ok((self.parameters, errors))
    }
}

/// These rows, one below the other.
fn tensor(rows: &[Vec<f32>], indices: &[usize], device: &Device) -> Result<Tensor, candle_core::Error> {
    let values: Vec<f32> = indices.iter().flat_map(|index| rows[*index].iter().copied()).collect();
    let n_columns = rows.first().map_or(0, Vec::len);
    Tensor::from_vec(values, (indices.len(), n_columns), device)
}

#[cfg(test)]
mod tests;
