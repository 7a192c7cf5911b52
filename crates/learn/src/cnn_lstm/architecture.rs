//! Architecture of the CNN-LSTM network.

use serde::{Deserialize, Serialize};

/// Kernel lengths of the convolutions, in samples.
pub(super) const KERNELS: [usize; 6] = [4, 4, 4, 3, 3, 3];

/// Padding of the convolutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Padding {
    /// Zero padding: the length stays the same.
    Same,
    /// No padding: the length shrinks.
    Valid,
}

/// Streams of the network, and their arrangement. The last three are the rivals of the paper's Table 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Streams {
    /// Both streams read the segment; their features are concatenated.
    Both,
    /// Convolutional stream only (1D-CNN).
    Convolutions,
    /// LSTM stream only.
    Memory,
    /// The LSTM stream reads the sequence that the convolutional stream returns (serial CNN-LSTM).
    Series,
}

impl Streams {
    pub(super) fn has_convolutions(self) -> bool {
        self != Self::Memory
    }

    pub(super) fn has_memory(self) -> bool {
        self != Self::Convolutions
    }
}

/// Channels of a segment beside acceleration: speed and force.
const N_CONTACT_CHANNELS: usize = 2;

/// Sizes of the network.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    /// Streams in use.
    pub streams: Streams,
    /// Samples per segment.
    pub n_samples: usize,
    /// Channels per sample: one or three axes of acceleration, speed and force.
    pub n_channels: usize,
    /// Padding of the convolutions.
    pub padding: Padding,
    /// Number of filters of each convolution.
    pub filters: [usize; 6],
    /// Max pooling lengths in samples, after the second and after the last convolution.
    pub pools: [usize; 2],
    /// Units of each LSTM layer.
    pub units: [usize; 4],
    /// Units of each dense layer.
    pub dense: [usize; 2],
    /// Number of attributes.
    pub n_outputs: usize,
}

impl Architecture {
    /// Returns the network with the 320 convolutional features of the paper's text.
    pub fn paper320(n_outputs: usize) -> Self {
        Self {
            streams: Streams::Both,
            n_samples: 200,
            n_channels: 3,
            padding: Padding::Same,
            filters: [32, 64, 128, 128, 64, 32],
            pools: [4, 5],
            units: [128, 256, 256, 128],
            dense: [128, 32],
            n_outputs,
        }
    }

    /// Returns the network with the kernels and pooling of the paper's text, which gives 1408 features.
    pub fn literal(n_outputs: usize) -> Self {
        Self { padding: Padding::Valid, pools: [2, 2], ..Self::paper320(n_outputs) }
    }

    /// Returns the convolutional stream of [`Architecture::paper320`] alone (1D-CNN).
    pub fn convolutions(n_outputs: usize) -> Self {
        Self { streams: Streams::Convolutions, ..Self::paper320(n_outputs) }
    }

    /// Returns the LSTM stream of [`Architecture::paper320`] alone.
    pub fn memory(n_outputs: usize) -> Self {
        Self { streams: Streams::Memory, ..Self::paper320(n_outputs) }
    }

    /// Returns the serial CNN-LSTM: convolutions and pooling of the paper's text, whose 44 outputs of 32 filters the
    /// LSTM layers read. The paper states no sizes of its rivals, so the layers are those of its own network.
    pub fn serial(n_outputs: usize) -> Self {
        Self { streams: Streams::Series, ..Self::literal(n_outputs) }
    }

    /// Returns this network for the three axes of acceleration instead of one combined signal.
    #[must_use]
    pub fn with_three_axes(self) -> Self {
        Self { n_channels: 3 + N_CONTACT_CHANNELS, ..self }
    }

    /// Returns the number of acceleration channels: 1 for the combined signal, or 3.
    pub fn n_axes(&self) -> usize {
        self.n_channels.saturating_sub(N_CONTACT_CHANNELS)
    }

    /// Returns the number of convolutional features; 0 if a segment is too short.
    pub fn n_convolved(&self) -> usize {
        let mut n_samples = self.n_samples;
        for (index, kernel) in KERNELS.into_iter().enumerate() {
            if self.padding == Padding::Valid {
                n_samples = (n_samples + 1).saturating_sub(kernel);
            }
            match index {
                1 => n_samples /= self.pools[0].max(1),
                5 => n_samples /= self.pools[1].max(1),
                _ => {}
            }
        }
        n_samples * self.filters[5]
    }

    /// Returns the number of features before the dense layers.
    pub fn n_features(&self) -> usize {
        match self.streams {
            Streams::Both => self.n_convolved() + self.units[3],
            Streams::Convolutions => self.n_convolved(),
            Streams::Memory | Streams::Series => self.units[3],
        }
    }

    /// Returns the number of inputs of the first LSTM layer at each step.
    pub(super) fn n_memory_inputs(&self) -> usize {
        if self.streams == Streams::Series { self.filters[5] } else { self.n_channels }
    }

    /// Returns the number of trainable parameters, and that number plus the running means and variances.
    pub fn n_parameters(&self) -> (usize, usize) {
        let dense = |n_inputs: usize, n_outputs: usize| (n_inputs + 1) * n_outputs;
        let mut n = 0;
        if self.streams.has_convolutions() {
            let mut n_channels = self.n_channels;
            for (n_filters, kernel) in self.filters.into_iter().zip(KERNELS) {
                n += dense(kernel * n_channels, n_filters);
                n_channels = n_filters;
            }
        }
        if self.streams.has_memory() {
            let mut n_inputs = self.n_memory_inputs();
            for n_units in self.units {
                n += dense(n_inputs + n_units, 4 * n_units);
                n_inputs = n_units;
            }
        }
        let n_features = self.n_features();
        n += dense(n_features, self.dense[0]) + dense(self.dense[0], self.dense[1]);
        n += dense(self.dense[1], self.n_outputs) + 2 * n_features;
        (n, n + 2 * n_features)
    }

    /// Returns whether all sizes are within limits, since a file may state any size.
    pub fn is_possible(&self) -> bool {
        const LARGEST: usize = 4096;
        let sizes = [self.n_samples, self.n_channels, self.n_outputs];
        let sizes =
            sizes.iter().chain(&self.filters).chain(&self.pools).chain(&self.units).chain(&self.dense);
        sizes.clone().all(|n| (1..=LARGEST).contains(n))
            && (!self.streams.has_convolutions() || self.n_convolved() > 0)
    }
}
