//! CNN-LSTM network that predicts attributes from strokes.
//!
//! After "Predicting Perceptual Haptic Attributes of Textured Surface from Tactile Data Based on Deep CNN-LSTM
//! Network", VRST 2023, section 4.
//!
//! A stroke segment has the channels acceleration (one combined signal, or three axes), speed and force. The
//! convolutional stream has six convolutions and two pooling layers; the recurrent stream has four LSTM layers.
//! Features of both streams are concatenated and batch-normalized. Two dense layers follow, with one output per
//! attribute.
//!
//! The sizes in the paper contradict each other. `paper320` has the 320 features of the text, through pooling by 4 and
//! 5. `literal` has the pooling of the text without padding, which gives 1408 features.
//!
//! The paper compares its network with a 1D-CNN, an LSTM and a serial CNN-LSTM of other authors (Table 3), whose sizes
//! it does not state. Here they are built of the same layers: one stream alone, or the LSTM layers after the
//! convolutions.

mod architecture;
mod normalization;

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, bail};

pub use self::architecture::{Architecture, Padding, Streams};

use self::architecture::KERNELS;
use self::normalization::Normalization;
use crate::dense;
use crate::init::Uniform;
use crate::lstm::{Exactness, lstm};
use crate::parameters::Parameters;

/// A network with its weights.
#[derive(Clone, Debug)]
pub(crate) struct CnnLstm {
    architecture: Architecture,
    pub(crate) parameters: Parameters,
    normalization: Normalization,
}

impl CnnLstm {
    /// Returns an untrained network, deterministic for a seed.
    pub(crate) fn new(architecture: Architecture, seed: u64, device: &Device) -> Result<Self> {
        let mut parameters = Parameters::default();
        let mut uniform = Uniform::new(seed);
        let mut weights =
            |parameters: &mut Parameters, name: &str, [n_inputs, n_outputs]: [usize; 2], kernel: usize| {
                // Fan-out of a convolution: each input reaches as many positions as the kernel is long.
                let values = uniform.glorot(n_inputs, n_outputs * kernel, n_inputs * n_outputs);
                parameters.add(&format!("{name}.weight"), &[n_inputs, n_outputs], values, device)
            };
        let bias = |parameters: &mut Parameters, name: &str, values: Vec<f32>| {
            parameters.add(&format!("{name}.bias"), &[values.len()], values, device)
        };
        let a = &architecture;
        if a.streams.has_convolutions() {
            let mut n_channels = a.n_channels;
            for (index, (n_filters, kernel)) in a.filters.into_iter().zip(KERNELS).enumerate() {
                let name = format!("conv{index}");
                weights(&mut parameters, &name, [kernel * n_channels, n_filters], kernel)?;
                bias(&mut parameters, &name, vec![0.0; n_filters])?;
                n_channels = n_filters;
            }
        }
        if a.streams.has_memory() {
            let mut n_inputs = a.n_memory_inputs();
            for (index, n_units) in a.units.into_iter().enumerate() {
                let name = format!("lstm{index}.input");
                weights(&mut parameters, &name, [n_inputs, 4 * n_units], 1)?;
                // Forget-gate bias of 1, so that memory persists at the start of training.
                let forget = |gate| if gate / n_units == 1 { 1.0 } else { 0.0 };
                bias(&mut parameters, &name, (0..4 * n_units).map(forget).collect())?;
                weights(&mut parameters, &format!("lstm{index}.state"), [n_units, 4 * n_units], 1)?;
                n_inputs = n_units;
            }
        }
        let n_features = a.n_features();
        let [first, second] = a.dense;
        for (name, shape) in
            [("dense0", [n_features, first]), ("dense1", [first, second]), ("output", [second, a.n_outputs])]
        {
            dense::add(&mut parameters, name, shape, &mut uniform, device)?;
        }
        let normalization = Normalization::new("norm", n_features, &mut parameters, device)?;
        Ok(Self { architecture, parameters, normalization })
    }

    pub(crate) fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// Returns the attributes of each segment (segments × samples × channels) in inference mode.
    pub(crate) fn predict(&self, segments: &Tensor) -> Result<Tensor> {
        let features = self.features(segments, Exactness::Sixteen)?;
        self.attributes(&self.normalization.apply(&features, &self.parameters)?)
    }

    /// Returns the attributes in training mode: batch statistics normalize the features and update the running
    /// statistics.
    pub(crate) fn predict_learning(&mut self, segments: &Tensor) -> Result<Tensor> {
        let features = self.features(segments, Exactness::Full)?;
        let normalized = self.normalization.apply_learning(&features, &self.parameters)?;
        self.attributes(&normalized)
    }

    /// Returns a copy of all weights and running statistics, by name.
    pub(crate) fn snapshot(&self) -> Result<BTreeMap<String, Tensor>> {
        let mut numbers = self.parameters.snapshot()?;
        numbers.extend(self.normalization.snapshot()?);
        Ok(numbers)
    }

    /// Restores the weights and running statistics of a network with the same architecture.
    pub(crate) fn restore(&mut self, numbers: &BTreeMap<String, Tensor>) -> Result<()> {
        self.parameters.restore(numbers)?;
        self.normalization.restore(numbers)
    }

    fn features(&self, segments: &Tensor, exactness: Exactness) -> Result<Tensor> {
        let (_, n_samples, n_channels) = segments.dims3()?;
        let a = &self.architecture;
        if (n_samples, n_channels) != (a.n_samples, a.n_channels) {
            bail!(
                "segments have {n_samples} samples of {n_channels} channels, the network takes {} of {}",
                a.n_samples,
                a.n_channels
            );
        }
        match a.streams {
            Streams::Convolutions => self.convolved(segments)?.flatten_from(1),
            Streams::Memory => self.remembered(segments, exactness),
            Streams::Series => self.remembered(&self.convolved(segments)?, exactness),
            Streams::Both => {
                let convolved = self.convolved(segments)?.flatten_from(1)?;
                Tensor::cat(&[convolved, self.remembered(segments, exactness)?], 1)
            }
        }
    }

    /// Output of the last pooling layer (sequences × samples × filters).
    fn convolved(&self, segments: &Tensor) -> Result<Tensor> {
        let mut x = segments.clone();
        for (index, kernel) in KERNELS.into_iter().enumerate() {
            x = self
                .dense(&windows(&x, kernel, self.architecture.padding)?, &format!("conv{index}"))?
                .relu()?;
            match index {
                1 => x = pooled(&x, self.architecture.pools[0])?,
                5 => x = pooled(&x, self.architecture.pools[1])?,
                _ => {}
            }
        }
        Ok(x)
    }

    /// States of the last LSTM layer after the last step of the sequences (sequences × steps × inputs).
    fn remembered(&self, sequences: &Tensor, exactness: Exactness) -> Result<Tensor> {
        let mut x = sequences.transpose(0, 1)?.contiguous()?;
        for index in 0..self.architecture.units.len() {
            let gates = self.dense(&x, &format!("lstm{index}.input"))?;
            x = lstm(&gates, self.parameters.get(&format!("lstm{index}.state.weight"))?, exactness)?;
        }
        x.get(x.dim(0)? - 1)
    }

    fn attributes(&self, features: &Tensor) -> Result<Tensor> {
        let x = self.dense(features, "dense0")?.relu()?;
        let x = self.dense(&x, "dense1")?.relu()?;
        self.dense(&x, "output")
    }

    fn dense(&self, x: &Tensor, name: &str) -> Result<Tensor> {
        dense::apply(&self.parameters, name, x)
    }
}

/// Sliding windows (sequences × samples × kernel·channels), which turn a convolution into a matrix product.
fn windows(x: &Tensor, kernel: usize, padding: Padding) -> Result<Tensor> {
    let x = match padding {
        Padding::Valid => x.clone(),
        // Odd total padding puts the extra zero at the end.
        Padding::Same => x.pad_with_zeros(1, (kernel - 1) / 2, kernel / 2)?,
    };
    let n_windows = x.dim(1)? + 1 - kernel;
    let shifted: Vec<Tensor> = (0..kernel).map(|k| x.narrow(1, k, n_windows)).collect::<Result<_>>()?;
    Tensor::cat(&shifted, 2)
}

/// Max pooling over `n` samples; a remainder at the end is dropped.
fn pooled(x: &Tensor, n: usize) -> Result<Tensor> {
    let (n_sequences, n_samples, n_channels) = x.dims3()?;
    let n_pools = n_samples / n;
    x.narrow(1, 0, n_pools * n)?.reshape((n_sequences, n_pools, n, n_channels))?.max(2)
}

#[cfg(test)]
mod tests;
