//! Training of one network on pictures: a head, or a rival.

use candle_core::{Device, Tensor};
use shagreen_core::maths::rng::{Random, derive_seed};
use shagreen_core::maths::statistics::mean;

use super::PictureConfig;
use crate::model_file::Numbers;
use crate::parameters::{Adam, AdamConfig, Parameters};

/// Returns the outputs of a network with these parameters (rows × labels) for rows of inputs.
pub(super) type Network<'a> = dyn Fn(&Parameters, &Tensor) -> Result<Tensor, candle_core::Error> + 'a;

/// A network in training.
pub(super) struct Learning<'a> {
    rows: &'a [Vec<f32>],
    labels: &'a [Vec<f32>],
    learned: Vec<usize>,
    aside: Vec<usize>,
    network: &'a Network<'a>,
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
    /// Training of a network that begins with these parameters.
    pub(super) fn new(
        rows: &'a [Vec<f32>],
        labels: &'a [Vec<f32>],
        (network, parameters): (&'a Network<'a>, Parameters),
        seed: u64,
        device: &'a Device,
    ) -> Result<Self, candle_core::Error> {
        let mut random = Random::new(derive_seed(seed, "order"));
        let order = random.shuffled(rows.len());
        let (aside, learned) = order.split_at(rows.len().div_ceil(10));
        let best = parameters.snapshot()?;
        Ok(Self {
            rows,
            labels,
            learned: learned.to_vec(),
            aside: aside.to_vec(),
            network,
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

    pub(super) fn is_over(&self, config: &PictureConfig) -> bool {
        self.n_epochs >= config.n_epochs || self.n_epochs - self.best_epoch >= config.patience.max(1)
    }

    pub(super) fn run_epoch(&mut self, config: &PictureConfig) -> Result<(), candle_core::Error> {
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
            let error = ((self.network)(&self.parameters, &x)? - y)?.sqr()?.mean_all()?;
            // The offset keeps the gradient of the square root finite at zero error.
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

    /// Returns the errors of each validation picture, label by label.
    fn aside_errors(&self) -> Result<Vec<Vec<f32>>, candle_core::Error> {
        let x = tensor(self.rows, &self.aside, self.device)?;
        let y = tensor(self.labels, &self.aside, self.device)?;
        ((self.network)(&self.parameters, &x)? - y)?.to_vec2()
    }

    /// Returns the best parameters and their validation errors.
    pub(super) fn finish(self) -> Result<(Parameters, Vec<Vec<f32>>), candle_core::Error> {
        self.parameters.restore(&self.best)?;
        let errors = self.aside_errors()?;
        Ok((self.parameters, errors))
    }
}

/// Returns the selected rows as a tensor.
pub(super) fn tensor(
    rows: &[Vec<f32>],
    indices: &[usize],
    device: &Device,
) -> Result<Tensor, candle_core::Error> {
    let values: Vec<f32> = indices.iter().flat_map(|index| rows[*index].iter().copied()).collect();
    let n_columns = rows.first().map_or(0, Vec::len);
    Tensor::from_vec(values, (indices.len(), n_columns), device)
}
