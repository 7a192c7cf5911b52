//! Files of a model in the layout of diffusers.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use super::DiffusionError;

/// A file of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Configuration of the text encoder.
    TextSizes,
    /// Weights of the text encoder.
    Text,
    /// Configuration of the denoiser (U-Net).
    DenoiserSizes,
    /// Weights of the denoiser.
    Denoiser,
    /// Configuration of the autoencoder (VAE).
    AutoencoderSizes,
    /// Weights of the autoencoder.
    Autoencoder,
    /// Noise schedule.
    Schedule,
    /// Vocabulary of the tokenizer.
    Vocabulary,
    /// Byte-pair merges of the tokenizer.
    Merges,
    /// Configuration of the tokenizer, with its padding token; optional.
    TokenizerSettings,
}

impl Part {
    /// All files.
    pub const ALL: [Self; 10] = [
        Self::TextSizes,
        Self::Text,
        Self::DenoiserSizes,
        Self::Denoiser,
        Self::AutoencoderSizes,
        Self::Autoencoder,
        Self::Schedule,
        Self::Vocabulary,
        Self::Merges,
        Self::TokenizerSettings,
    ];

    /// Returns the possible paths in the folder, the usual path first.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::TextSizes => &["text_encoder/config.json"],
            Self::Text => &["text_encoder/model.safetensors", "text_encoder/model.fp16.safetensors"],
            Self::DenoiserSizes => &["unet/config.json"],
            Self::Denoiser => {
                &["unet/diffusion_pytorch_model.safetensors", "unet/diffusion_pytorch_model.fp16.safetensors"]
            }
            Self::AutoencoderSizes => &["vae/config.json"],
            Self::Autoencoder => {
                &["vae/diffusion_pytorch_model.safetensors", "vae/diffusion_pytorch_model.fp16.safetensors"]
            }
            Self::Schedule => &["scheduler/scheduler_config.json"],
            Self::Vocabulary => &["tokenizer/vocab.json"],
            Self::Merges => &["tokenizer/merges.txt"],
            Self::TokenizerSettings => &["tokenizer/tokenizer_config.json"],
        }
    }

    /// Returns whether a model works without this file.
    pub fn is_optional(self) -> bool {
        self == Self::TokenizerSettings
    }
}

/// Contents of a model's files.
#[derive(Clone, Debug, Default)]
pub struct Files {
    bytes: BTreeMap<Part, Vec<u8>>,
}

impl Files {
    /// Adds a file.
    pub fn add(&mut self, part: Part, bytes: Vec<u8>) {
        self.bytes.insert(part, bytes);
    }

    /// Returns the bytes of a file.
    pub(super) fn get(&self, part: Part) -> Result<&[u8], DiffusionError> {
        self.bytes.get(&part).map(Vec::as_slice).ok_or(DiffusionError::Missing { part })
    }

    /// Removes a file and returns its bytes, so that its memory can be freed.
    pub(super) fn take(&mut self, part: Part) -> Result<Vec<u8>, DiffusionError> {
        self.bytes.remove(&part).ok_or(DiffusionError::Missing { part })
    }

    /// Returns the parsed content of a JSON file.
    pub(super) fn json<T: DeserializeOwned>(&self, part: Part) -> Result<T, DiffusionError> {
        serde_json::from_slice(self.get(part)?)
            .map_err(|error| DiffusionError::Damaged { part, reason: error.to_string() })
    }
}
