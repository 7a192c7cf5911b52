//! A trained network that predicts attributes from strokes, and its file.

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::recording::fit::Stroke;

use crate::cnn_lstm::{Architecture, CnnLstm};
use crate::model_card::ModelCard;
use crate::model_file::{self, ModelFileError};
use crate::stroke_set::{Scale, Segments, StrokedTexture};
use crate::training_error::TrainingError;

/// Kind of the file.
pub const MODEL: &str = "attributes from strokes";

/// Segments per inference batch.
pub(crate) const N_AT_ONCE: usize = 64;

/// A trained CNN-LSTM network.
#[derive(Clone, Debug)]
pub struct StrokeModel {
    network: CnnLstm,
    scale: Scale,
    device: Device,
}

/// Metadata of a network file.
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

    /// Returns the sizes of the network.
    pub fn architecture(&self) -> &Architecture {
        self.network.architecture()
    }

    /// Returns the attributes predicted from strokes, 0 to 100, averaged over all whole segments.
    ///
    /// `None` if no stroke contains a whole segment.
    ///
    /// # Errors
    /// [`TrainingError::Axes`] if a stroke has another number of axes than [`Architecture::n_axes`],
    /// [`TrainingError::Tensor`] if the network fails.
    pub fn predict(&self, strokes: &[Stroke]) -> Result<Option<Vec<f64>>, TrainingError> {
        let n_outputs = self.architecture().n_outputs;
        let texture =
            StrokedTexture { id: String::new(), strokes: strokes.to_vec(), attributes: vec![0.0; n_outputs] };
        let segments = Segments::of(&[&texture], self.architecture(), &self.scale)?;
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

    /// Returns the bytes of the model's file.
    ///
    /// # Errors
    /// [`TrainingError::Card`] if the card does not match this network, [`TrainingError::File`] if a weight is not
    /// finite.
    pub fn to_bytes(&self, card: &ModelCard) -> Result<Vec<u8>, TrainingError> {
        check(card, self.architecture())?;
        let about =
            About { architecture: self.architecture().clone(), scale: self.scale, card: card.clone() };
        Ok(model_file::write(MODEL, &about, &self.network.snapshot()?)?)
    }

    /// Returns the network and model card of a file.
    ///
    /// # Errors
    /// [`TrainingError::File`] for an invalid file, [`TrainingError::Sizes`] and [`TrainingError::Card`] for invalid
    /// metadata.
    pub fn from_bytes(bytes: &[u8]) -> Result<(Self, ModelCard), TrainingError> {
        let device = crate::device::best();
        let (About { architecture, scale, card }, numbers) = model_file::read(MODEL, bytes, &device)?;
        if !architecture.is_possible() {
            return Err(TrainingError::Sizes);
        }
        check(&card, &architecture)?;
        // Before a network of any size is made: the file must hold its weights.
        let (n_stated, n_held) =
            (architecture.n_parameters().1, numbers.values().map(Tensor::elem_count).sum::<usize>());
        if n_held < n_stated {
            let what = format!("they have {n_held} values, the network of the header has {n_stated}");
            return Err(ModelFileError::Shape(candle_core::Error::Msg(what)).into());
        }
        let mut network = CnnLstm::new(architecture, 0, &device)?;
        network.restore(&numbers).map_err(ModelFileError::Shape)?;
        Ok((Self { network, scale, device }, card))
    }
}

fn check(card: &ModelCard, architecture: &Architecture) -> Result<(), TrainingError> {
    let n_outputs = architecture.n_outputs;
    if card.fits(n_outputs) { Ok(()) } else { Err(TrainingError::Card { n_outputs }) }
}
