//! EfficientNet-Lite0 up to its last block, with frozen weights.
//!
//! From M. Tan and Q. Le 2019, in the variant for small devices: no squeeze-and-excitation, no swish, unscaled stem and
//! head.
//!
//! Blocks in the middle, at several scales, show most about the relief of a rendered material ([early
//! features](Depth::Early)). The last block recognizes what real photos show ([late features](Depth::Late)). A feature map
//! is stored as rows of pixels with interleaved channels, so that most work is matrix multiplication.

use ndarray::{Array1, Array2};
use shagreen_core::surfaces::picture_features::{SIDE, Square};

use super::{BackboneError, Depth, Numbers};

/// Per stage: kernel, stride of the first block, expansion factor, channels, number of blocks.
const STAGES: [(usize, usize, usize, usize, usize); 7] = [
    (3, 1, 1, 16, 1),
    (3, 2, 6, 24, 2),
    (5, 2, 6, 40, 2),
    (3, 2, 6, 80, 3),
    (5, 1, 6, 112, 3),
    (5, 2, 6, 192, 4),
    (3, 1, 6, 320, 1),
];
/// Channels of the stem.
const N_STEM: usize = 32;
/// Epsilon added to variances in batch normalization.
const EPSILON: f32 = 1e-3;
/// Upper limit of ReLU6.
const SIX: f32 = 6.0;

/// Stages that give early features, each after its last block; the first stage shows only colors and edges.
const EARLY: std::ops::Range<usize> = 1..5;
/// Stage that gives late features: the last one.
const LATE: usize = STAGES.len() - 1;

/// Number of early features: mean and standard deviation of each channel of those stages.
pub(super) const N_EARLY: usize = 2 * (STAGES[1].3 + STAGES[2].3 + STAGES[3].3 + STAGES[4].3);
/// Number of features of the last stage: mean and standard deviation of each channel.
pub(super) const N_LATE: usize = 2 * STAGES[LATE].3;

/// The network.
#[derive(Clone, Debug)]
pub(super) struct EfficientNet {
    stem: Dense,
    blocks: Vec<Block>,
}

/// A pointwise convolution: a matrix product along the channels.
#[derive(Clone, Debug)]
struct Dense {
    /// Inputs × outputs.
    weights: Array2<f32>,
    bias: Array1<f32>,
}

/// A depthwise convolution: each channel separately.
#[derive(Clone, Debug)]
struct Depthwise {
    /// Kernel positions × channels.
    weights: Array2<f32>,
    bias: Array1<f32>,
    kernel: usize,
    stride: usize,
}

#[derive(Clone, Debug)]
struct Block {
    expand: Option<Dense>,
    depthwise: Depthwise,
    project: Dense,
}

/// Feature map, pixels × channels.
#[derive(Clone, Debug)]
struct Map {
    side: usize,
    values: Array2<f32>,
}

impl EfficientNet {
    /// Returns the network with these weights.
    ///
    /// # Errors
    /// [`BackboneError::Missing`] or [`BackboneError::Shape`] for a missing or wrong tensor.
    pub(super) fn new(numbers: &Numbers) -> Result<Self, BackboneError> {
        let stem = Dense::new(numbers, "_conv_stem.weight", "_bn0", [N_STEM, 3, 3, 3])?;
        let mut blocks = Vec::new();
        let mut n_inputs = N_STEM;
        for (kernel, first_stride, factor, n_outputs, n_blocks) in STAGES {
            for index in 0..n_blocks {
                let name = |part: &str| format!("_blocks.{}.{part}", blocks.len());
                let n_wide = factor * n_inputs;
                let shape = [n_wide, n_inputs, 1, 1];
                let expand = (factor > 1)
                    .then(|| Dense::new(numbers, &name("_expand_conv.weight"), &name("_bn0"), shape))
                    .transpose()?;
                let stride = if index == 0 { first_stride } else { 1 };
                let weight = name("_depthwise_conv.weight");
                let depthwise = Depthwise::new(numbers, &weight, &name("_bn1"), [n_wide, kernel], stride)?;
                let shape = [n_outputs, n_wide, 1, 1];
                let project = Dense::new(numbers, &name("_project_conv.weight"), &name("_bn2"), shape)?;
                blocks.push(Block { expand, depthwise, project });
                n_inputs = n_outputs;
            }
        }
        Ok(Self { stem, blocks })
    }

    /// Returns the features of a depth: for each of its stages the channel means, then the channel standard deviations.
    pub(super) fn features(&self, square: &Square, depth: Depth) -> [Vec<f32>; 2] {
        let (has_early, has_late) = (depth != Depth::Late, depth != Depth::Early);
        let n_stages = if has_late { STAGES.len() } else { EARLY.end };
        let mut map = self.stem(square);
        let (mut early, mut late) = (Vec::new(), Vec::new());
        let mut blocks = self.blocks.iter();
        for (stage, (_, _, _, _, n_blocks)) in STAGES.into_iter().enumerate().take(n_stages) {
            for block in blocks.by_ref().take(n_blocks) {
                map = block.run(&map);
            }
            if has_early && EARLY.contains(&stage) {
                early.extend(map.means_and_deviations());
            }
            if stage == LATE {
                late = map.means_and_deviations();
            }
        }
        [early, late]
    }

    /// Returns the stem convolution of the picture, with pixels normalized as in training: (x - 127) / 128.
    fn stem(&self, square: &Square) -> Map {
        let (out, before) = strided(SIDE, 3, 2);
        let mut windows = Array2::zeros((out * out, 27));
        for (index, mut window) in windows.rows_mut().into_iter().enumerate() {
            let (y, x) = (2 * (index / out), 2 * (index % out));
            for tap in 0..9 {
                let at = |from: usize, step: usize| (from + step).checked_sub(before).filter(|at| *at < SIDE);
                if let (Some(y), Some(x)) = (at(y, tap / 3), at(x, tap % 3)) {
                    for channel in 0..3 {
                        let value = square.rgb[3 * (y * SIDE + x) + channel];
                        window[channel * 9 + tap] = (255.0 * value - 127.0) / 128.0;
                    }
                }
            }
        }
        let mut map = Map { side: out, values: self.stem.apply(&windows) };
        map.rectify();
        map
    }
}

impl Block {
    fn run(&self, map: &Map) -> Map {
        let mut wide = match &self.expand {
            Some(expand) => {
                let mut wide = Map { side: map.side, values: expand.apply(&map.values) };
                wide.rectify();
                self.depthwise.apply(&wide)
            }
            None => self.depthwise.apply(map),
        };
        wide.rectify();
        let mut values = self.project.apply(&wide.values);
        if self.depthwise.stride == 1 && values.dim() == map.values.dim() {
            values += &map.values;
        }
        Map { side: wide.side, values }
    }
}

impl Map {
    /// Returns the channel means, then the channel standard deviations.
    fn means_and_deviations(&self) -> Vec<f32> {
        let (n, n_channels) = (self.values.nrows() as f32, self.values.ncols());
        let mut features = vec![0.0; 2 * n_channels];
        let (means, deviations) = features.split_at_mut(n_channels);
        for row in self.values.rows() {
            for (mean, x) in means.iter_mut().zip(row) {
                *mean += x / n;
            }
        }
        for row in self.values.rows() {
            for ((deviation, mean), x) in deviations.iter_mut().zip(&*means).zip(row) {
                *deviation += (x - mean).powi(2) / (n - 1.0);
            }
        }
        for deviation in deviations {
            *deviation = deviation.sqrt();
        }
        features
    }

    fn rectify(&mut self) {
        self.values.mapv_inplace(|x| x.clamp(0.0, SIX));
    }
}

impl Dense {
    /// Folds a convolution (outputs × inputs × rows × columns) and its batch normalization into one layer.
    fn new(numbers: &Numbers, weight: &str, norm: &str, shape: [usize; 4]) -> Result<Self, BackboneError> {
        let values = numbers_of(numbers, weight, &shape)?;
        let [n_outputs, ..] = shape;
        let n_inputs = values.len() / n_outputs;
        let (scale, bias) = folded(numbers, norm, n_outputs)?;
        let weights =
            Array2::from_shape_fn((n_inputs, n_outputs), |(i, o)| values[o * n_inputs + i] * scale[o]);
        Ok(Self { weights, bias })
    }

    fn apply(&self, rows: &Array2<f32>) -> Array2<f32> {
        rows.dot(&self.weights) + &self.bias
    }
}

impl Depthwise {
    fn new(
        numbers: &Numbers,
        weight: &str,
        norm: &str,
        [n_channels, kernel]: [usize; 2],
        stride: usize,
    ) -> Result<Self, BackboneError> {
        let values = numbers_of(numbers, weight, &[n_channels, 1, kernel, kernel])?;
        let (scale, bias) = folded(numbers, norm, n_channels)?;
        let n_taps = kernel * kernel;
        let weights =
            Array2::from_shape_fn((n_taps, n_channels), |(tap, c)| values[c * n_taps + tap] * scale[c]);
        Ok(Self { weights, bias, kernel, stride })
    }

    fn apply(&self, map: &Map) -> Map {
        let (out, before) = strided(map.side, self.kernel, self.stride);
        let mut values = Array2::zeros((out * out, map.values.ncols()));
        for (index, mut row) in values.rows_mut().into_iter().enumerate() {
            row.assign(&self.bias);
            let Some(sums) = row.as_slice_mut() else { continue };
            let (y, x) = (self.stride * (index / out), self.stride * (index % out));
            for (tap, weights) in self.weights.rows().into_iter().enumerate() {
                let at =
                    |from: usize, step: usize| (from + step).checked_sub(before).filter(|at| *at < map.side);
                let place = (at(y, tap / self.kernel), at(x, tap % self.kernel));
                let (Some(y), Some(x)) = place else { continue };
                let pixel = map.values.row(y * map.side + x);
                if let (Some(pixel), Some(weights)) = (pixel.as_slice(), weights.as_slice()) {
                    for ((sum, x), weight) in sums.iter_mut().zip(pixel).zip(weights) {
                        *sum += x * weight;
                    }
                }
            }
        }
        Map { side: out, values }
    }
}

/// Returns output side and leading zero padding of a strided convolution ("same" padding, odd zero at the end).
fn strided(side: usize, kernel: usize, stride: usize) -> (usize, usize) {
    let out = side.div_ceil(stride);
    let padding = ((out - 1) * stride + kernel).saturating_sub(side);
    (out, padding / 2)
}

/// Returns the scale and offset per channel equivalent to a batch normalization.
fn folded(numbers: &Numbers, norm: &str, n: usize) -> Result<(Vec<f32>, Array1<f32>), BackboneError> {
    let of = |part: &str| numbers_of(numbers, &format!("{norm}.{part}"), &[n]);
    let (weight, bias, mean, variance) =
        (of("weight")?, of("bias")?, of("running_mean")?, of("running_var")?);
    let scale: Vec<f32> = weight.iter().zip(variance).map(|(w, v)| w / (v + EPSILON).sqrt()).collect();
    let offset = (0..n).map(|i| bias[i] - mean[i] * scale[i]).collect();
    Ok((scale, offset))
}

fn numbers_of<'a>(numbers: &'a Numbers, name: &str, shape: &[usize]) -> Result<&'a [f32], BackboneError> {
    match numbers.get(name) {
        Some((found, values)) if found == shape => Ok(values),
        Some((found, _)) => Err(BackboneError::Shape {
            name: name.to_owned(),
            found: found.clone(),
            expected: shape.to_vec(),
        }),
        None => Err(BackboneError::Missing { name: name.to_owned() }),
    }
}
