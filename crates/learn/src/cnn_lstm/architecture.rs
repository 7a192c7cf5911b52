//! Sizes of the network.

use serde::{Deserialize, Serialize};

/// Samples of the convolutions' kernels.
pub(super) const KERNELS: [usize; 6] = [4, 4, 4, 3, 3, 3];

/// What becomes of the ends of a segment in a convolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Padding {
    /// Zeros stand around it: it stays as long as it is.
    Same,
    /// It gets shorter.
    Valid,
}

/// Which halves of the network there are: the paper compares it with networks of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Streams {
    /// Both.
    Both,
    /// Convolutions alone.
    Convolutions,
    /// Long short-term memory alone.
    Memory,
}

impl Streams {
    pub(super) fn has_convolutions(self) -> bool {
        self != Self::Memory
    }

    pub(super) fn has_memory(self) -> bool {
        self != Self::Convolutions
    }
}

/// Sizes of the network.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    /// Which halves there are.
    pub streams: Streams,
    /// Samples of a segment.
    pub n_samples: usize,
    /// Values a sample.
    pub n_channels: usize,
    /// What becomes of the ends.
    pub padding: Padding,
    /// Filters of the convolutions.
    pub filters: [usize; 6],
    /// Samples of which the largest stays, after the second and after the last convolution.
    pub pools: [usize; 2],
    /// Units of the layers of long short-term memory.
    pub units: [usize; 4],
    /// Units of the dense layers.
    pub dense: [usize; 2],
    /// Attributes.
    pub n_outputs: usize,
}

impl Architecture {
    /// The network with the 320 features of the paper's text.
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

    /// The network with the paper's kernels and poolings, as they are written.
    pub fn literal(n_outputs: usize) -> Self {
        Self { padding: Padding::Valid, pools: [2, 2], ..Self::paper320(n_outputs) }
    }

    /// Features of the convolutions; 0 where a segment is too short for them.
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

    /// Features that are normalized together.
    pub fn n_features(&self) -> usize {
        let convolved = if self.streams.has_convolutions() { self.n_convolved() } else { 0 };
        convolved + if self.streams.has_memory() { self.units[3] } else { 0 }
    }

    /// Numbers that are learned, and those together with the means and variances that are remembered.
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
            let mut n_inputs = self.n_channels;
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

    /// Whether every size can be had: a file may say anything.
    pub fn is_possible(&self) -> bool {
        const LARGEST: usize = 4096;
        let sizes = [self.n_samples, self.n_channels, self.n_outputs];
        let sizes =
            sizes.iter().chain(&self.filters).chain(&self.pools).chain(&self.units).chain(&self.dense);
        sizes.clone().all(|n| (1..=LARGEST).contains(n))
            && (!self.streams.has_convolutions() || self.n_convolved() > 0)
    }
}
