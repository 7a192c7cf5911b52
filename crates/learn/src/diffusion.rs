//! Text-to-image generation with Stable Diffusion 2.1, or any latent diffusion model with the same file layout.
//!
//! Such a model has a text encoder, a U-Net denoiser and an autoencoder (R. Rombach et al. 2022). The weights are the
//! user's files: a folder in the layout of diffusers, with safetensors. Network sizes are read from its JSON files. The
//! initial noise comes from our own random generator, so that a seed reproduces a picture.

mod files;
mod scheduler;
mod sizes;
mod text_encoder;
mod tokens;

use std::collections::HashMap;

use candle_core::{DType, Device, Tensor};
use candle_nn::VarBuilder;
use candle_transformers::models::stable_diffusion::unet_2d::UNet2DConditionModel;
use candle_transformers::models::stable_diffusion::vae::AutoEncoderKL;
use shagreen_core::maths::rng::{Random, derive_seed};
use shagreen_core::surfaces::shading::Picture;
use shagreen_core::surfaces::starter::FRAMING;

pub use self::files::{Files, Part};

use self::sizes::{AutoencoderSizes, DenoiserSizes, TextSizes};
use self::text_encoder::TextEncoder;
use self::tokens::Tokens;

/// Appended to every prompt, so that the picture shows a texture instead of an object (section II-A of the paper).
pub const DESCRIPTORS: &str = "real plain texture, zoomed-in, top view, realistic, no curl, high definition";

/// Largest side of a picture, in pixels.
pub const LONGEST_SIDE: usize = 1024;
/// Largest number of denoising steps.
pub const MOST_STEPS: usize = 500;

/// Reasons why a picture cannot be generated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DiffusionError {
    /// A file is missing.
    #[error("the folder has no {}; it must be in the layout of diffusers, with safetensors", .part.names()[0])]
    Missing {
        /// The missing file.
        part: Part,
    },
    /// A file cannot be parsed.
    #[error("{} cannot be read: {reason}; get the file again", .part.names()[0])]
    Damaged {
        /// The file.
        part: Part,
        /// Cause.
        reason: String,
    },
    /// A file requires an unsupported feature.
    #[error("{} requires {what}, which is not supported; use Stable Diffusion 1 or 2", .part.names()[0])]
    Unknown {
        /// The file.
        part: Part,
        /// Unsupported feature.
        what: String,
    },
    /// Two files belong to different models.
    #[error("the parts of the model do not match: {what}; use the files of one model")]
    Apart {
        /// Difference between the files.
        what: String,
    },
    /// The requested size, number of steps or guidance is not possible.
    #[error(
        "{what}; use at most {LONGEST_SIDE} pixels per side, in multiples of {multiple}, and at most {MOST_STEPS} steps"
    )]
    Wish {
        /// The impossible value.
        what: String,
        /// Required divisor of the side, in pixels.
        multiple: usize,
    },
    /// The generated picture has values that are not finite.
    #[error("the model output is not finite; its files do not match, or its weights need more than 16 bits")]
    NotFinite,
    /// A tensor operation failed.
    #[error("the networks could not be evaluated: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// A request for a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish<'a> {
    /// Prompt; [`DESCRIPTORS`] are appended.
    pub prompt: &'a str,
    /// Negative prompt: what the picture should not show.
    pub negative: &'a str,
    /// Pixels per side.
    pub side: usize,
    /// Number of denoising steps.
    pub n_steps: usize,
    /// Scale of classifier-free guidance; 1 disables guidance, higher values follow the prompt more closely.
    pub guidance: f64,
    /// Seed of the initial noise.
    pub seed: u64,
}

impl<'a> Wish<'a> {
    /// Returns a request with the usual settings: 512 pixels as in the paper, 30 steps, a guidance scale of 7.5.
    pub fn usual(prompt: &'a str, seed: u64) -> Self {
        Self { prompt, negative: "", side: 512, n_steps: 30, guidance: 7.5, seed }
    }
}

/// A text-to-image diffusion model.
pub struct Diffusion {
    tokens: Tokens,
    text: TextEncoder,
    denoiser: UNet2DConditionModel,
    autoencoder: AutoEncoderKL,
    scheduler: scheduler::Schedule,
    sizes: DenoiserSizes,
    latents: AutoencoderSizes,
    device: Device,
}

impl Diffusion {
    /// Returns the model of these files.
    ///
    /// Loading can take twice the size of the files in memory, or four times for half-precision weights.
    ///
    /// # Errors
    /// [`DiffusionError`] for missing, damaged, unsupported or mismatched files.
    pub fn new(mut files: Files) -> Result<Self, DiffusionError> {
        let device = crate::device::best();
        let text_sizes = TextSizes::read(&files)?;
        let sizes = DenoiserSizes::read(&files)?;
        let latents = AutoencoderSizes::read(&files)?;
        if text_sizes.hidden_size != sizes.cross_attention_dim {
            return Err(DiffusionError::Apart {
                what: format!(
                    "the text encoder has {} features per token, the denoiser takes {}",
                    text_sizes.hidden_size, sizes.cross_attention_dim
                ),
            });
        }
        if sizes.in_channels != latents.latent_channels || sizes.out_channels != latents.latent_channels {
            return Err(DiffusionError::Apart {
                what: format!(
                    "the autoencoder takes {} latent channels, the denoiser has {} inputs and {} outputs",
                    latents.latent_channels, sizes.in_channels, sizes.out_channels
                ),
            });
        }
        let tokens = Tokens::read(&files, text_sizes.max_position_embeddings, text_sizes.vocab_size)?;
        let scheduler = scheduler::Schedule::read(&files)?;
        let weights = |part: Part, files: &mut Files| -> Result<VarBuilder<'static>, DiffusionError> {
            let bytes = files.take(part)?;
            // The reader's words describe bytes of the format.
            let damaged = |_: candle_core::Error| {
                let reason = "it is not a safetensors file, or it is damaged".to_owned();
                DiffusionError::Damaged { part, reason }
            };
            let tensors: HashMap<String, Tensor> =
                candle_core::safetensors::load_buffer(&bytes, &device).map_err(damaged)?;
            Ok(VarBuilder::from_tensors(tensors, DType::F32, &device))
        };
        let damaged = |part: Part| {
            move |error: candle_core::Error| DiffusionError::Damaged {
                part,
                reason: format!(
                    "its weights do not fit the configuration of the model ({})",
                    first_line(&error)
                ),
            }
        };
        let text =
            TextEncoder::new(&weights(Part::Text, &mut files)?, &text_sizes).map_err(damaged(Part::Text))?;
        let denoiser = UNet2DConditionModel::new(
            weights(Part::Denoiser, &mut files)?,
            sizes.in_channels,
            sizes.out_channels,
            false,
            sizes.config(),
        )
        .map_err(damaged(Part::Denoiser))?;
        let autoencoder = AutoEncoderKL::new(weights(Part::Autoencoder, &mut files)?, 3, 3, latents.config())
            .map_err(damaged(Part::Autoencoder))?;
        Ok(Self { tokens, text, denoiser, autoencoder, scheduler, sizes, latents, device })
    }

    /// Returns the required divisor of picture sides, in pixels.
    pub fn multiple(&self) -> usize {
        self.latents.factor() * self.sizes.factor()
    }

    /// Returns the generated picture, deterministic for a seed; `None` if `go_on` stops the generation.
    ///
    /// `go_on` receives the number of completed steps after each step; false stops. The physical size of the pictured
    /// surface is unknown. It is assumed to equal that of starter library pictures.
    ///
    /// # Errors
    /// [`DiffusionError::Wish`] for an impossible request, [`DiffusionError::NotFinite`] or [`DiffusionError::Tensor`]
    /// if a network fails.
    pub fn picture(
        &self,
        wish: &Wish<'_>,
        mut go_on: impl FnMut(usize) -> bool,
    ) -> Result<Option<Picture>, DiffusionError> {
        self.check(wish)?;
        let prompt = format!("{}, {DESCRIPTORS}", wish.prompt.trim());
        let texts = [self.tokens.ids(wish.negative)?, self.tokens.ids(&prompt)?].concat();
        let texts = Tensor::from_vec(texts, (2, self.tokens.length()), &self.device)?;
        let words = self.text.encode(&texts)?;

        let side = wish.side / self.latents.factor();
        let shape = (1, self.latents.latent_channels, side, side);
        let mut random = Random::new(derive_seed(wish.seed, "noise"));
        let noise: Vec<f32> =
            (0..self.latents.latent_channels * side * side).map(|_| random.normal() as f32).collect();
        let mut latents = Tensor::from_vec(noise, shape, &self.device)?;
        let mut schedule = self.scheduler.of_steps(wish.n_steps)?;
        for (step, time) in schedule.timesteps().to_vec().into_iter().enumerate() {
            let both = Tensor::cat(&[&latents, &latents], 0)?;
            let predicted = self.denoiser.forward(&both, time as f64, &words)?;
            let (nothing, wished) = (predicted.narrow(0, 0, 1)?, predicted.narrow(0, 1, 1)?);
            let guided = (&nothing + ((wished - &nothing)? * wish.guidance)?)?;
            latents = schedule.step(&guided, time, &latents)?;
            if !go_on(step + 1) {
                return Ok(None);
            }
        }
        let decoded = self.autoencoder.decode(&(latents / self.latents.scaling_factor)?)?;
        let pixels = ((decoded / 2.0)? + 0.5)?.clamp(0.0, 1.0)?;
        let pixels = (pixels * 255.0)?.round()?.squeeze(0)?.permute((1, 2, 0))?.flatten_all()?;
        let pixels = pixels.to_vec1::<f32>()?;
        if pixels.iter().any(|x| !x.is_finite()) {
            return Err(DiffusionError::NotFinite);
        }
        let rgb = pixels.into_iter().map(|x| x as u8).collect();
        Ok(Some(Picture { width: wish.side, height: wish.side, rgb, millimeters: FRAMING.millimeters }))
    }

    fn check(&self, wish: &Wish<'_>) -> Result<(), DiffusionError> {
        let multiple = self.multiple();
        let wrong = |what: String| Err(DiffusionError::Wish { what, multiple });
        if wish.side == 0 || wish.side > LONGEST_SIDE || !wish.side.is_multiple_of(multiple) {
            return wrong(format!("{} pixels per side are not possible", wish.side));
        }
        if wish.n_steps == 0 || wish.n_steps > MOST_STEPS || !self.scheduler.has_steps(wish.n_steps) {
            return wrong(format!("{} steps are not possible with this model", wish.n_steps));
        }
        if !wish.guidance.is_finite() {
            return wrong("the guidance scale is not finite".to_owned());
        }
        Ok(())
    }
}

impl std::fmt::Debug for Diffusion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Diffusion").field("sizes", &self.sizes).finish_non_exhaustive()
    }
}

/// Returns the first line of an error; candle appends a backtrace if one is enabled.
fn first_line(error: &candle_core::Error) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests;
