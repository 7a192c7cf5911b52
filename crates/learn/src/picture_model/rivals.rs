//! Networks to which "Text-Driven Generative Framework for Multimodal Visual and Haptic Texture Synthesis" compares
//! AttributeNet in its Table I.
//!
//! The paper takes them from other publications, with weights that were trained on large sets of photos. Those weights are
//! not at hand, and the paper states no sizes. Here, each network has the arrangement that it is known for, in small, and
//! begins with random weights. Its errors are therefore those of a network of this kind on these pictures, not those of the
//! published one.

use candle_core::{Device, Result, Tensor};
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::surfaces::picture_features::{SIDE, Square};

use super::learning::{Learning, tensor};
use super::{PictureConfig, PictureModelError, check, labels_of};
use crate::dense;
use crate::feature_scale::FeatureScale;
use crate::init::Uniform;
use crate::parameters::Parameters;
use crate::picture_set::Seen;

/// A network to which AttributeNet is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rival {
    /// Visual-CNN: modules of parallel convolutions of several sizes, on pixels.
    VisualCnn,
    /// VisionNet: five convolutions in a row, on pixels, averaged over all positions.
    VisionNet,
    /// 1D-CNN: convolutions along the features of a backbone or of the statistics of a picture.
    OneDimensional,
}

/// Pixels per side that the networks on pixels read.
const N_PIXELS: usize = SIDE / REDUCED;
/// Pixels of the usual square that one of them averages, along each side.
const REDUCED: usize = 4;
/// Colors of a pixel.
const N_COLORS: usize = 3;
/// Fewest features along which the 1D-CNN can pool three times.
const LEAST_FEATURES: usize = 8;

impl Rival {
    /// All networks, in the order of the paper's table.
    pub const ALL: [Self; 3] = [Self::VisualCnn, Self::VisionNet, Self::OneDimensional];

    /// Name in the paper.
    pub fn name(self) -> &'static str {
        match self {
            Self::VisualCnn => "Visual-CNN",
            Self::VisionNet => "VisionNet",
            Self::OneDimensional => "1D-CNN",
        }
    }

    /// Whether its features are [`pixels`], and not those of a feature extractor.
    pub fn reads_pixels(self) -> bool {
        self != Self::OneDimensional
    }

    fn design(self, n_features: usize) -> Design {
        const MODULE: &[[usize; 2]] = &[[1, 1], [3, 3], [5, 5]];
        let conv =
            |kernels: &'static [[usize; 2]], n_filters: usize| Layer::Convolution { kernels, n_filters };
        let pool = Layer::Pool([2, 2]);
        let layers = match self {
            Self::VisualCnn => {
                vec![conv(&[[5, 5]], 16), pool, conv(MODULE, 12), pool, conv(MODULE, 20), pool]
            }
            Self::VisionNet => vec![
                conv(&[[5, 5]], 16),
                pool,
                conv(&[[5, 5]], 32),
                pool,
                conv(&[[3, 3]], 48),
                conv(&[[3, 3]], 48),
                conv(&[[3, 3]], 32),
                pool,
            ],
            Self::OneDimensional => {
                let pool = Layer::Pool([1, 2]);
                vec![conv(&[[1, 5]], 16), pool, conv(&[[1, 5]], 32), pool, conv(&[[1, 3]], 32), pool]
            }
        };
        let shape = if self.reads_pixels() { [N_PIXELS, N_PIXELS, N_COLORS] } else { [1, n_features, 1] };
        Design { shape, layers, is_averaged: self.reads_pixels() }
    }
}

/// Returns the pixels of a picture as features: colors from -0.5 to 0.5 of 56 × 56 pixels, row by row.
pub fn pixels(square: &Square) -> Vec<f32> {
    let mut sums = vec![0.0; N_PIXELS * N_PIXELS * N_COLORS];
    for (index, value) in square.rgb.iter().enumerate() {
        let (pixel, color) = (index / N_COLORS, index % N_COLORS);
        let (row, column) = (pixel / SIDE / REDUCED, pixel % SIDE / REDUCED);
        if let Some(sum) = sums.get_mut((row * N_PIXELS + column) * N_COLORS + color) {
            *sum += value;
        }
    }
    let n_averaged = (REDUCED * REDUCED) as f32;
    sums.into_iter().map(|sum| sum / n_averaged - 0.5).collect()
}

/// Trains a network on pictures with labels, 0 to 100, and returns its predictions of the labels of other pictures, 0 to 100.
/// A tenth of the pictures ends the training early; [`PictureConfig::hidden`] and [`PictureConfig::n_heads`] have no effect.
///
/// `epoch` receives the number of epochs so far. If it returns false, training stops, and what was learned so far counts.
///
/// # Errors
/// [`PictureModelError::TooFew`], [`PictureModelError::Picture`] or [`PictureModelError::Settings`] for unusable input.
pub fn rival_predictions(
    rival: Rival,
    learned: &[&Seen],
    asked: &[&Seen],
    config: &PictureConfig,
    mut epoch: impl FnMut(usize) -> bool,
) -> std::result::Result<Vec<Vec<f64>>, PictureModelError> {
    let n_labels = learned.first().map_or(0, |seen| seen.labels.len());
    check(learned, n_labels, config)?;
    check(&[learned, asked].concat(), n_labels, config)?;
    let n_features = learned[0].features.len();
    let design = rival.design(n_features);
    if design.shape.iter().product::<usize>() != n_features || n_features < LEAST_FEATURES {
        return Err(PictureModelError::Settings);
    }
    let scale = (!rival.reads_pixels())
        .then(|| FeatureScale::of(&learned.iter().map(|seen| &seen.features[..]).collect::<Vec<_>>()));
    let row = |seen: &&Seen| match &scale {
        Some(scale) => scale.apply(&seen.features),
        None => seen.features.clone(),
    };
    let rows: Vec<Vec<f32>> = learned.iter().map(row).collect();
    let labels = labels_of(learned);
    let device = crate::device::best();
    let network = |parameters: &Parameters, x: &Tensor| design.run(parameters, x);
    let parameters = design.fresh(n_labels, derive_seed(config.seed, "weights"), &device)?;
    let mut learning = Learning::new(&rows, &labels, (&network, parameters), config.seed, &device)?;
    let (mut n_epochs, mut is_on) = (0, true);
    while is_on && !learning.is_over(config) {
        learning.run_epoch(config)?;
        n_epochs += 1;
        is_on = epoch(n_epochs);
    }
    let (parameters, _) = learning.finish()?;
    let mut predicted = Vec::with_capacity(asked.len());
    let rows: Vec<Vec<f32>> = asked.iter().map(row).collect();
    for index in 0..rows.len() {
        let outputs = design.run(&parameters, &tensor(&rows, &[index], &device)?)?;
        let outputs = outputs.flatten_all()?.to_vec1::<f32>()?;
        predicted.push(outputs.into_iter().map(|x| (100.0 * f64::from(x)).clamp(0.0, 100.0)).collect());
    }
    Ok(predicted)
}

/// Arrangement of a network.
#[derive(Clone, Debug)]
struct Design {
    /// Rows, columns and channels of a picture.
    shape: [usize; 3],
    layers: Vec<Layer>,
    /// Whether the dense layers read the means over all positions, and not all positions.
    is_averaged: bool,
}

#[derive(Clone, Copy, Debug)]
enum Layer {
    /// Convolutions beside each other, with kernels of so many rows and columns and so many filters each, followed by
    /// rectified linear units. Zero padding keeps the size.
    Convolution { kernels: &'static [[usize; 2]], n_filters: usize },
    /// Max pooling over so many rows and columns; a remainder at the end is dropped.
    Pool([usize; 2]),
}

/// Units of the dense layer before the outputs.
const N_DENSE: usize = 64;

impl Design {
    /// Returns new parameters, deterministic for a seed.
    fn fresh(&self, n_labels: usize, seed: u64, device: &Device) -> Result<Parameters> {
        let mut parameters = Parameters::default();
        let mut uniform = Uniform::new(seed);
        let [mut n_rows, mut n_columns, mut n_channels] = self.shape;
        for (index, layer) in self.layers.iter().enumerate() {
            match layer {
                Layer::Convolution { kernels, n_filters } => {
                    for (branch, [height, width]) in kernels.iter().enumerate() {
                        let sizes = [height * width * n_channels, *n_filters];
                        dense::add(
                            &mut parameters,
                            &convolution(index, branch),
                            sizes,
                            &mut uniform,
                            device,
                        )?;
                    }
                    n_channels = kernels.len() * n_filters;
                }
                Layer::Pool([height, width]) => {
                    n_rows /= height;
                    n_columns /= width;
                }
            }
        }
        let n_positions = if self.is_averaged { 1 } else { n_rows * n_columns };
        for (name, sizes) in [("dense", [n_positions * n_channels, N_DENSE]), ("output", [N_DENSE, n_labels])]
        {
            dense::add(&mut parameters, name, sizes, &mut uniform, device)?;
        }
        Ok(parameters)
    }

    /// Returns the outputs for rows of inputs.
    fn run(&self, parameters: &Parameters, x: &Tensor) -> Result<Tensor> {
        let [n_rows, n_columns, n_channels] = self.shape;
        let mut x = x.reshape((x.dim(0)?, n_rows, n_columns, n_channels))?;
        for (index, layer) in self.layers.iter().enumerate() {
            x = match layer {
                Layer::Convolution { kernels, .. } => {
                    let mut branches = Vec::with_capacity(kernels.len());
                    for (branch, kernel) in kernels.iter().enumerate() {
                        let windows = windows(&x, *kernel)?;
                        branches
                            .push(dense::apply(parameters, &convolution(index, branch), &windows)?.relu()?);
                    }
                    Tensor::cat(&branches, 3)?
                }
                Layer::Pool(size) => pooled(&x, *size)?,
            };
        }
        let features = if self.is_averaged { x.mean((1, 2))? } else { x.flatten_from(1)? };
        let hidden = dense::apply(parameters, "dense", &features)?.relu()?;
        dense::apply(parameters, "output", &hidden)
    }
}

/// Name of a convolution in the parameters.
fn convolution(layer: usize, branch: usize) -> String {
    format!("conv{layer}.{branch}")
}

/// Surroundings of each position (pictures × rows × columns × kernel·channels), which turn a convolution into a matrix
/// product; zeros surround the picture.
fn windows(x: &Tensor, [height, width]: [usize; 2]) -> Result<Tensor> {
    let (n_rows, n_columns) = (x.dim(1)?, x.dim(2)?);
    let x = x.pad_with_zeros(1, (height - 1) / 2, height / 2)?;
    let x = x.pad_with_zeros(2, (width - 1) / 2, width / 2)?;
    let mut shifted = Vec::with_capacity(height * width);
    for row in 0..height {
        for column in 0..width {
            shifted.push(x.narrow(1, row, n_rows)?.narrow(2, column, n_columns)?);
        }
    }
    Tensor::cat(&shifted, 3)
}

fn pooled(x: &Tensor, [height, width]: [usize; 2]) -> Result<Tensor> {
    let (n_pictures, n_rows, n_columns, n_channels) = x.dims4()?;
    let (n_high, n_wide) = (n_rows / height, n_columns / width);
    let whole = x.narrow(1, 0, n_high * height)?.narrow(2, 0, n_wide * width)?;
    whole.reshape((n_pictures, n_high, height, n_wide, width, n_channels))?.max(4)?.max(2)
}

#[cfg(test)]
mod tests;
