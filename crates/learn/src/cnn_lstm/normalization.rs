//! Batch normalization of features, with running statistics for inference (S. Ioffe and C. Szegedy 2015).

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, bail};

use crate::parameters::Parameters;

/// Epsilon added to variances.
const EPSILON: f64 = 1e-3;
/// Momentum of the running statistics; the first batches are averaged with equal weight.
///
/// An average over more than about ten batches lags behind the network when epochs are short. The training error then
/// falls while inference fails.
const MOMENTUM: f64 = 0.9;

/// Batch normalization of a network's features.
#[derive(Clone, Debug)]
pub(super) struct Normalization {
    name: String,
    mean: Tensor,
    variance: Tensor,
    /// Number of batches seen.
    n_seen: Tensor,
}

impl Normalization {
    pub(super) fn new(
        name: &str,
        n_features: usize,
        parameters: &mut Parameters,
        device: &Device,
    ) -> Result<Self> {
        parameters.add(&format!("{name}.scale"), &[n_features], vec![1.0; n_features], device)?;
        parameters.add(&format!("{name}.shift"), &[n_features], vec![0.0; n_features], device)?;
        Ok(Self {
            name: name.to_owned(),
            mean: Tensor::zeros(n_features, candle_core::DType::F32, device)?,
            variance: Tensor::ones(n_features, candle_core::DType::F32, device)?,
            n_seen: Tensor::zeros(1, candle_core::DType::F32, device)?,
        })
    }

    /// Normalizes with the running statistics.
    pub(super) fn apply(&self, features: &Tensor, parameters: &Parameters) -> Result<Tensor> {
        self.normalized(features, &self.mean, &self.variance, parameters)
    }

    /// Normalizes with the statistics of the batch, and updates the running statistics.
    pub(super) fn apply_learning(&mut self, features: &Tensor, parameters: &Parameters) -> Result<Tensor> {
        let mean = features.mean(0)?;
        let variance = features.broadcast_sub(&mean)?.sqr()?.mean(0)?;
        let n_seen = f64::from(self.n_seen.to_vec1::<f32>()?[0]);
        let stays = MOMENTUM.min(n_seen / (n_seen + 1.0));
        let mixed = |old: &Tensor, new: &Tensor| (old * stays)? + (new.detach() * (1.0 - stays))?;
        self.mean = mixed(&self.mean, &mean)?;
        self.variance = mixed(&self.variance, &variance)?;
        self.n_seen = (&self.n_seen + 1.0)?;
        self.normalized(features, &mean, &variance, parameters)
    }

    fn normalized(
        &self,
        features: &Tensor,
        mean: &Tensor,
        variance: &Tensor,
        parameters: &Parameters,
    ) -> Result<Tensor> {
        let deviation = (variance + EPSILON)?.sqrt()?;
        let normalized = features.broadcast_sub(mean)?.broadcast_div(&deviation)?;
        normalized
            .broadcast_mul(parameters.get(&format!("{}.scale", self.name))?)?
            .broadcast_add(parameters.get(&format!("{}.shift", self.name))?)
    }

    pub(super) fn snapshot(&self) -> Result<BTreeMap<String, Tensor>> {
        let numbers = [("mean", &self.mean), ("variance", &self.variance), ("seen", &self.n_seen)];
        numbers.into_iter().map(|(name, tensor)| Ok((self.full_name(name), tensor.copy()?))).collect()
    }

    pub(super) fn restore(&mut self, numbers: &BTreeMap<String, Tensor>) -> Result<()> {
        let names = ["mean", "variance", "seen"].map(|name| self.full_name(name));
        for (name, into) in names.iter().zip([&mut self.mean, &mut self.variance, &mut self.n_seen]) {
            match numbers.get(name) {
                Some(tensor) if tensor.shape() == into.shape() => *into = tensor.to_device(into.device())?,
                Some(tensor) => {
                    bail!("tensor \"{name}\" has the shape {:?}, needs {:?}", tensor.shape(), into.shape())
                }
                None => bail!("tensor \"{name}\" is missing"),
            }
        }
        Ok(())
    }

    fn full_name(&self, name: &str) -> String {
        format!("{}.{name}", self.name)
    }
}
