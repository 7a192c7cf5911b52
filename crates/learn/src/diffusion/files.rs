//! The files of a model, in the layout of diffusers.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use super::DiffusionError;

/// A file of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Sizes of the text encoder.
    TextSizes,
    /// Its numbers.
    Text,
    /// Sizes of the network that takes noise away.
    DenoiserSizes,
    /// Its numbers.
    Denoiser,
    /// Sizes of the decoder.
    AutoencoderSizes,
    /// Its numbers.
    Autoencoder,
    /// How noise goes away.
    Schedule,
    /// Parts of words.
    Vocabulary,
    /// How parts become words.
    Merges,
    /// What fills a short text; may be missing.
    TokenizerSettings,
}

impl Part {
    /// All of them.
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

    /// Where it may lie in the folder, the usual place first.
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

    /// Whether a model can do without it.
    pub fn is_optional(self) -> bool {
        self == Self::TokenizerSettings
    }
}

/// The bytes of a model's files.
#[derive(Clone, Debug, Default)]
pub struct Files {
    bytes: BTreeMap<Part, Vec<u8>>,
}

impl Files {
    /// Adds one.
    pub fn add(&mut self, part: Part, bytes: Vec<u8>) {
        self.bytes.insert(part, bytes);
    }

    /// The bytes of a file.
    pub(super) fn get(&self, part: Part) -> Result<&[u8], DiffusionError> {
        self.bytes.get(&part).map(Vec::as_slice).ok_or(DiffusionError::Missing { part })
    }

    /// The bytes of a file, which are let go of.
    pub(super) fn take(&mut self, part: Part) -> Result<Vec<u8>, DiffusionError> {
        self.bytes.remove(&part).ok_or(DiffusionError::Missing { part })
    }

    /// What a JSON file says.
    pub(super) fn json<T: DeserializeOwned>(&self, part: Part) -> Result<T, DiffusionError> {
        serde_json::from_slice(self.get(part)?)
            .map_err(|error| DiffusionError::Damaged { part, reason: error.to_string() })
    }
}
