//! Pretrained image backbones, used unchanged as feature extractors for our own heads.
//!
//! Their weights are the user's files, in safetensors. Tensor names identify the network.

mod efficientnet;

use std::collections::BTreeMap;

use candle_core::{Device, Tensor};
use candle_nn::VarBuilder;
use candle_transformers::models::resnet::resnet50_no_final_layer;
use safetensors::{Dtype, SafeTensors};
use shagreen_core::surfaces::picture_features::{SIDE, Square};

use self::efficientnet::EfficientNet;
use crate::model_file::sha256_of;

/// Python script that converts the published EfficientNet-Lite0 weights to safetensors.
///
/// Its arguments are the Python package, the name of the weights file in it, and the output file.
pub const CONVERT_EFFICIENTNET: &str = include_str!("backbone/convert.py");

/// Reasons why a file is not a usable backbone.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BackboneError {
    /// The file is damaged or not safetensors.
    #[error("it is not a safetensors file, or it is damaged; choose another file, or get this one again")]
    Tensors(safetensors::SafeTensorError),
    /// The network is unknown.
    #[error(
        "it is neither EfficientNet-Lite0 nor ResNet-50 (with the names of torchvision), the networks that can be used; choose a file of one of them"
    )]
    Unknown,
    /// A tensor is missing.
    #[error("its weights \"{name}\" are missing; get a complete file")]
    Missing {
        /// Name of the tensor.
        name: String,
    },
    /// A tensor has the wrong shape.
    #[error("its weights \"{name}\" have the shape {found:?} instead of {expected:?}; get the original file")]
    Shape {
        /// Name of the tensor.
        name: String,
        /// Its shape.
        found: Vec<usize>,
        /// Required shape.
        expected: Vec<usize>,
    },
    /// A tensor is not finite, or has an unsupported type.
    #[error("its weights \"{name}\" are not finite, or not floats of 16 or 32 bits; get the original file")]
    Numbers {
        /// Name of the tensor.
        name: String,
    },
    /// A tensor operation failed.
    #[error("the network could not be evaluated: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// The reader's words are not a cause to show: they describe bytes of the format.
impl From<safetensors::SafeTensorError> for BackboneError {
    fn from(error: safetensors::SafeTensorError) -> Self {
        Self::Tensors(error)
    }
}

/// Tensors by name, each with its shape.
type Numbers = BTreeMap<String, (Vec<usize>, Vec<f32>)>;

/// Kind of backbone network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BackboneKind {
    /// EfficientNet-Lite0, up to its last block.
    EfficientnetLite0,
    /// ResNet-50 without its last layer, with the tensor names and pixel normalization of torchvision.
    Resnet50,
}

impl BackboneKind {
    /// Returns the name of the network.
    pub fn name(self) -> &'static str {
        match self {
            Self::EfficientnetLite0 => "EfficientNet-Lite0",
            Self::Resnet50 => "ResNet-50",
        }
    }

    /// Returns the number of early features per picture ([`Backbone::features`]).
    pub fn n_features(self) -> usize {
        match self {
            Self::EfficientnetLite0 => efficientnet::N_EARLY,
            Self::Resnet50 => N_OF_RESNET,
        }
    }

    /// Returns how many features [`Backbone::late_features`] gives for a picture.
    pub fn n_late_features(self) -> usize {
        match self {
            Self::EfficientnetLite0 => efficientnet::N_LATE,
            Self::Resnet50 => N_OF_RESNET,
        }
    }
}

/// Number of features of ResNet-50, which has no separate early features.
const N_OF_RESNET: usize = 2048;

/// Layers of a network whose features are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    /// Layers in the middle of the network.
    Early,
    /// The last layer before those of the ImageNet classes.
    Late,
    /// All of them.
    Both,
}

/// A pretrained image network.
pub struct Backbone {
    kind: BackboneKind,
    network: Network,
    sha256: String,
}

enum Network {
    EfficientNet(EfficientNet),
    ResNet(candle_nn::Func<'static>, Device),
}

impl std::fmt::Debug for Backbone {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Backbone")
            .field("kind", &self.kind)
            .field("sha256", &self.sha256)
            .finish_non_exhaustive()
    }
}

impl Backbone {
    /// Returns the network of a file.
    ///
    /// # Errors
    /// See the variants of [`BackboneError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BackboneError> {
        let tensors = SafeTensors::deserialize(bytes)?;
        let sha256 = sha256_of(bytes);
        if tensors.tensor("_conv_stem.weight").is_ok() {
            let network = Network::EfficientNet(EfficientNet::new(&numbers(&tensors)?)?);
            return Ok(Self { kind: BackboneKind::EfficientnetLite0, network, sha256 });
        }
        if tensors.tensor("layer4.2.conv3.weight").is_err() {
            return Err(BackboneError::Unknown);
        }
        let device = crate::device::best();
        let of = |(name, (shape, values)): (String, (Vec<usize>, Vec<f32>))| {
            Ok((name, Tensor::from_vec(values, shape, &device)?))
        };
        let named = numbers(&tensors)?.into_iter().map(of).collect::<Result<_, BackboneError>>()?;
        let builder = VarBuilder::from_tensors(named, candle_core::DType::F32, &device);
        let network = Network::ResNet(resnet50_no_final_layer(builder)?, device);
        Ok(Self { kind: BackboneKind::Resnet50, network, sha256 })
    }

    /// Returns the kind of network.
    pub fn kind(&self) -> BackboneKind {
        self.kind
    }

    /// Returns the SHA-256 of its file.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// Returns the early features of a picture, [`BackboneKind::n_features`] values. They predict the roughness and
    /// hardness of rendered materials better than late features.
    ///
    /// # Errors
    /// [`BackboneError::Tensor`].
    pub fn features(&self, square: &Square) -> Result<Vec<f32>, BackboneError> {
        let [early, _] = self.at(square, Depth::Early)?;
        Ok(early)
    }

    /// Returns the late features of a picture, [`BackboneKind::n_late_features`] values. They recognize materials in real
    /// photos better than early features.
    ///
    /// # Errors
    /// [`BackboneError::Tensor`].
    pub fn late_features(&self, square: &Square) -> Result<Vec<f32>, BackboneError> {
        let [_, late] = self.at(square, Depth::Late)?;
        Ok(late)
    }

    /// Returns the early and the late features of a picture, in the time of the late ones.
    ///
    /// # Errors
    /// [`BackboneError::Tensor`].
    pub fn early_and_late_features(&self, square: &Square) -> Result<[Vec<f32>; 2], BackboneError> {
        self.at(square, Depth::Both)
    }

    fn at(&self, square: &Square, depth: Depth) -> Result<[Vec<f32>; 2], BackboneError> {
        match &self.network {
            Network::EfficientNet(network) => Ok(network.features(square, depth)),
            Network::ResNet(network, device) => {
                // Pixel normalization of torchvision.
                const MEAN: [f32; 3] = [0.485, 0.456, 0.406];
                const DEVIATION: [f32; 3] = [0.229, 0.224, 0.225];
                let pixels = Tensor::from_slice(&square.rgb, (SIDE * SIDE, 3), device)?;
                let pixels = pixels
                    .broadcast_sub(&Tensor::new(&MEAN, device)?)?
                    .broadcast_div(&Tensor::new(&DEVIATION, device)?)?;
                let pixels = pixels.t()?.contiguous()?.reshape((1, 3, SIDE, SIDE))?;
                let features: Vec<f32> = pixels.apply(network)?.flatten_all()?.to_vec1()?;
                Ok([features.clone(), features])
            }
        }
    }
}

/// Returns all floating-point tensors of a file in single precision.
fn numbers(tensors: &SafeTensors<'_>) -> Result<Numbers, BackboneError> {
    let mut numbers = Numbers::new();
    for (name, view) in tensors.tensors() {
        let data = view.data();
        let values: Vec<f32> = match view.dtype() {
            Dtype::F32 => data.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect(),
            Dtype::F16 => half(data, half::f16::from_le_bytes),
            Dtype::BF16 => half(data, half::bf16::from_le_bytes),
            // Batch counts of batch normalization, unused in inference.
            Dtype::I64 => continue,
            _ => return Err(BackboneError::Numbers { name }),
        };
        if values.iter().any(|value| !value.is_finite()) {
            return Err(BackboneError::Numbers { name });
        }
        numbers.insert(name, (view.shape().to_vec(), values));
    }
    Ok(numbers)
}

fn half<T: Into<f32>>(data: &[u8], read: fn([u8; 2]) -> T) -> Vec<f32> {
    data.as_chunks::<2>().0.iter().map(|bytes| read(*bytes).into()).collect()
}

#[cfg(test)]
mod tests;
