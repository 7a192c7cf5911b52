//! What a model predicts for a texture that it was not trained on, as a file: a training without each texture in turn takes long,
//! and several computers can divide it.

use serde::{Deserialize, Serialize};
use shagreen_core::maths::gaussian_process::Estimate;

use crate::layout;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-left-out-prediction";
/// Version of the format.
pub const VERSION: &str = "1.0";

/// Prediction of a model for a texture that it was not trained on.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOutPrediction {
    /// Predicted attributes, 0 to 100, with their standard deviations.
    pub estimates: Vec<Estimate>,
    /// Number of epochs of the training.
    pub n_epochs: usize,
}

#[derive(Serialize, Deserialize)]
struct PredictionV1 {
    format: String,
    version: String,
    /// Hash of everything that the prediction depends on.
    inputs: String,
    n_epochs: usize,
    /// Mean and standard deviation of each attribute.
    estimates: Vec<[f64; 2]>,
}

impl LeftOutPrediction {
    /// Returns the bytes of the file. `inputs` is the hash of everything that the prediction depends on.
    pub fn to_bytes(&self, inputs: &str) -> Vec<u8> {
        let wire = PredictionV1 {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            inputs: inputs.to_owned(),
            n_epochs: self.n_epochs,
            estimates: self.estimates.iter().map(|of| [of.mean, of.deviation]).collect(),
        };
        layout::to_bytes(&wire, 1)
    }

    /// Reads the prediction with these inputs; `None` if the bytes are no prediction of this version or have other inputs. It is
    /// then made again.
    pub fn read(bytes: &[u8], inputs: &str) -> Option<Self> {
        let wire: PredictionV1 = serde_json::from_slice(bytes).ok()?; // A damaged file counts as none.
        let is_it = wire.format == FORMAT && wire.version == VERSION && wire.inputs == inputs;
        let estimate = |[mean, deviation]: [f64; 2]| Estimate { mean, deviation };
        is_it.then(|| Self {
            estimates: wire.estimates.into_iter().map(estimate).collect(),
            n_epochs: wire.n_epochs,
        })
    }
}

#[cfg(test)]
mod tests {
    use shagreen_core::maths::gaussian_process::Estimate;

    use super::{LeftOutPrediction, VERSION};

    #[test]
    fn a_prediction_comes_back_exactly_and_only_for_its_inputs() {
        let of = |mean, deviation| Estimate { mean, deviation };
        let prediction =
            LeftOutPrediction { estimates: vec![of(0.1 + 0.2, 1.0 / 3.0), of(99.9, 1e-17)], n_epochs: 12 };
        let bytes = prediction.to_bytes("ab");
        assert_eq!(LeftOutPrediction::read(&bytes, "ab"), Some(prediction));
        assert_eq!(LeftOutPrediction::read(&bytes, "cd"), None);
        assert_eq!(LeftOutPrediction::read(&bytes[..bytes.len() / 2], "ab"), None);
        assert_eq!(LeftOutPrediction::read(b"my notes", "ab"), None);
        let newer = String::from_utf8(bytes).unwrap().replace(VERSION, "2.0");
        assert_eq!(LeftOutPrediction::read(newer.as_bytes(), "ab"), None);
    }
}
