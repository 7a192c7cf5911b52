//! Small network: one hidden layer that predicts the hardness from features.

use candle_core::{Device, Result, Tensor};
use shagreen_core::maths::rng::{Random, derive_seed};

use super::rows::Rows;
use crate::dense;
use crate::dense_stack::{fresh, run};
use crate::parameters::{Adam, AdamConfig, Parameters};
use crate::photo_config::SmallNetworkConfig;

/// Number of layers with weights.
pub(super) const N_LAYERS: usize = 2;

/// Returns the sizes of the layers, inputs and outputs included.
pub(super) fn sizes(n_features: usize, config: &SmallNetworkConfig) -> [usize; N_LAYERS + 1] {
    [n_features, config.n_hidden, 1]
}

/// Trains a network on the rows, with the weighted mean square error as loss.
pub(super) fn learn(
    rows: &Rows,
    config: &SmallNetworkConfig,
    seed: u64,
    device: &Device,
) -> Result<Parameters> {
    let n_features = rows.features.ncols();
    let parameters = fresh(&sizes(n_features, config), derive_seed(seed, "weights"), device)?;
    let mut adam = Adam::new(AdamConfig::usual(config.learning_rate));
    let mut random = Random::new(derive_seed(seed, "order and dropout"));
    let left = 1.0 - config.dropout;
    for _ in 0..config.n_epochs {
        for batch in random.shuffled(rows.weights.len()).chunks(config.n_batch) {
            let n = batch.len();
            let mut values = Vec::with_capacity(n * n_features);
            for index in batch {
                values.extend(rows.features.row(*index).iter().map(|x| *x as f32));
            }
            let x = Tensor::from_vec(values, (n, n_features), device)?;
            let column = |value: &dyn Fn(usize) -> f64| {
                let values: Vec<f32> = batch.iter().map(|index| value(*index) as f32).collect();
                Tensor::from_vec(values, (n, 1), device)
            };
            let y = column(&|index| 0.01 * rows.hard_soft[index])?;
            let weights = column(&|index| rows.weights[index])?;
            let mask: Vec<f32> = (0..n * config.n_hidden)
                .map(|_| if random.uniform() < left { (1.0 / left) as f32 } else { 0.0 })
                .collect();
            let mask = Tensor::from_vec(mask, (n, config.n_hidden), device)?;
            let hidden = (dense::apply(&parameters, "dense0", &x)?.relu()? * mask)?;
            let errors = (dense::apply(&parameters, "dense1", &hidden)? - y)?;
            let loss = (errors.sqr()? * weights)?.mean_all()?;
            adam.step(&parameters, &loss.backward()?)?;
            decay(&parameters, config)?;
        }
    }
    Ok(parameters)
}

/// Moves all weights toward zero; biases stay.
fn decay(parameters: &Parameters, config: &SmallNetworkConfig) -> Result<()> {
    let left = 1.0 - config.learning_rate * config.weight_decay;
    for (_, var) in parameters.iter().filter(|(name, _)| name.ends_with(".weight")) {
        var.set(&(var.as_tensor() * left)?.detach())?;
    }
    Ok(())
}

/// Returns the predicted hardness of each row of scaled features, on a scale of 0 to 100.
pub(super) fn predict(parameters: &Parameters, rows: &[Vec<f32>], device: &Device) -> Result<Vec<f64>> {
    let n_features = rows.first().map_or(0, Vec::len);
    let x = Tensor::from_vec(rows.concat(), (rows.len(), n_features), device)?;
    let y: Vec<f32> = run(parameters, &x, N_LAYERS)?.flatten_all()?.to_vec1()?;
    Ok(y.into_iter().map(|y| 100.0 * f64::from(y)).collect())
}
