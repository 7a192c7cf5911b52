//! A network that has learned attributes from strokes, and its file.

use candle_core::Device;
use serde::{Deserialize, Serialize};
use shagreen_core::fit::Stroke;

use crate::cnn_lstm::{Architecture, CnnLstm};
use crate::model_file::{self, ModelFileError};
use crate::stroke_set::{Scale, Segments, StrokedTexture};
use crate::training::TrainingError;

/// Kind of its file.
const MODEL: &str = "attributes from strokes";

/// Segments that are predicted at once.
pub(crate) const N_AT_ONCE: usize = 64;

/// A network that has learned.
#[derive(Clone, Debug)]
pub struct StrokeModel {
    network: CnnLstm,
    scale: Scale,
    device: Device,
}

/// What a network tells, how well, and what it has learned that from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCard {
    /// Names of the attributes.
    pub attributes: Vec<String>,
    /// Root mean square error of each for textures that were left out, in points of 0..100.
    pub left_out_rmse: Vec<f64>,
    /// What sort of network it is.
    pub network: String,
    /// What it has learned from, in words.
    pub learned_from: String,
    /// Where those attributes come from: identifiers as files of libraries have them.
    pub label_sources: Vec<String>,
}

/// What a file of a network says beside its numbers.
#[derive(Serialize, Deserialize)]
struct About {
    architecture: Architecture,
    scale: Scale,
    card: ModelCard,
}

impl StrokeModel {
    pub(crate) fn new(network: CnnLstm, scale: Scale, device: Device) -> Self {
        Self { network, scale, device }
    }

    /// Sizes of the network.
    pub fn architecture(&self) -> &Architecture {
        self.network.architecture()
    }

    /// The attributes of strokes, 0..100: the mean over all whole segments; `None` where there is no whole one.
    ///
    /// # Errors
    /// See [`TrainingError`].
    pub fn predict(&self, strokes: &[Stroke]) -> Result<Option<Vec<f64>>, TrainingError> {
        let n_outputs = self.architecture().n_outputs;
        let texture =
            StrokedTexture { id: String::new(), strokes: strokes.to_vec(), attributes: vec![0.0; n_outputs] };
        let segments = Segments::of(&[&texture], self.architecture().n_samples, &self.scale);
        if segments.len() == 0 {
            return Ok(None);
        }
        let mut sums = vec![0.0; n_outputs];
        let order: Vec<usize> = (0..segments.len()).collect();
        for indices in order.chunks(N_AT_ONCE) {
            let predicted = self.network.predict(&segments.batch(indices, &self.device)?.0)?;
            for (sum, value) in sums.iter_mut().zip(predicted.sum(0)?.to_vec1::<f32>()?) {
                *sum += 100.0 * f64::from(value);
            }
        }
        Ok(Some(sums.iter().map(|sum| (sum / segments.len() as f64).clamp(0.0, 100.0)).collect()))
    }

    /// The bytes of its file.
    ///
    /// # Errors
    /// See [`TrainingError`]; [`TrainingError::Card`] where the card is not of this network.
    pub fn to_bytes(&self, card: &ModelCard) -> Result<Vec<u8>, TrainingError> {
        check(card, self.architecture())?;
        let about =
            About { architecture: self.architecture().clone(), scale: self.scale, card: card.clone() };
        Ok(model_file::write(MODEL, &about, &self.network.snapshot()?)?)
    }

    /// The network of a file, and what is known of it.
    ///
    /// # Errors
    /// See [`TrainingError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<(Self, ModelCard), TrainingError> {
        let device = crate::device::best();
        let (About { architecture, scale, card }, numbers) = model_file::read(MODEL, bytes, &device)?;
        if !architecture.is_possible() {
            return Err(TrainingError::Sizes);
        }
        check(&card, &architecture)?;
        let mut network = CnnLstm::new(architecture, 0, &device)?;
        network.restore(&numbers).map_err(ModelFileError::Shape)?;
        Ok((Self { network, scale, device }, card))
    }
}

fn check(card: &ModelCard, architecture: &Architecture) -> Result<(), TrainingError> {
    let n_outputs = architecture.n_outputs;
    let fits = [card.attributes.len(), card.left_out_rmse.len()] == [n_outputs; 2]
        && card.left_out_rmse.iter().all(|rmse| rmse.is_finite() && *rmse >= 0.0);
    if fits { Ok(()) } else { Err(TrainingError::Card { n_outputs }) }
}
