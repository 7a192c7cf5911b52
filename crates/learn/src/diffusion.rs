//! Pictures from words by Stable Diffusion 2.1, or by any model whose files are laid out as its are: a text encoder, a network
//! that takes noise away step by step, and a decoder (R. Rombach et al. 2022).
//!
//! The weights are the user's files, a folder in the layout of diffusers with safetensors; sizes are read from its JSON. The
//! noise is drawn by our own seed, so that the same seed gives the same picture again.

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
use shagreen_core::rng::{Random, derive_seed};
use shagreen_core::shading::Picture;
use shagreen_core::starter::FRAMING;

pub use self::files::{Files, Part};

use self::sizes::{AutoencoderSizes, DenoiserSizes, TextSizes};
use self::text_encoder::TextEncoder;
use self::tokens::Tokens;

/// What is added to every prompt, so that a texture is shown and not a thing (the paper's section II-A).
pub const DESCRIPTORS: &str = "real plain texture, zoomed-in, top view, realistic, no curl, high definition";

/// Longest side of a picture, in pixels.
pub const LONGEST_SIDE: usize = 1024;
/// Most steps.
pub const MOST_STEPS: usize = 500;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DiffusionError {
    /// A file is not there.
    #[error("the folder has no {}; it must be in the layout of diffusers, with safetensors", .part.names()[0])]
    Missing {
        /// Which.
        part: Part,
    },
    /// A file cannot be read.
    #[error("{} cannot be read: {reason}", .part.names()[0])]
    Damaged {
        /// Which.
        part: Part,
        /// Why.
        reason: String,
    },
    /// A file asks for what is not known here.
    #[error("{} asks for {what}, which this program cannot do; Stable Diffusion 1 and 2 can be used", .part.names()[0])]
    Unknown {
        /// Which.
        part: Part,
        /// What it asks for.
        what: String,
    },
    /// Two files do not belong together.
    #[error("the parts do not belong together: {what}")]
    Apart {
        /// In what.
        what: String,
    },
    /// A picture of this size, in so many steps, cannot be made.
    #[error(
        "{what}; {LONGEST_SIDE} pixels a side and {MOST_STEPS} steps are the most, and sides are multiples of {multiple}"
    )]
    Wish {
        /// What is wrong.
        what: String,
        /// What sides must be multiples of.
        multiple: usize,
    },
    /// What came of it is no picture.
    #[error(
        "the model made numbers that are not finite; its files do not fit one another, or need more than 16 bits"
    )]
    NotFinite,
    /// The networks cannot be worked out.
    #[error("the networks could not be worked out: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// What a picture is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish<'a> {
    /// What it is to show; [`DESCRIPTORS`] are added.
    pub prompt: &'a str,
    /// What it is not to show.
    pub negative: &'a str,
    /// Pixels along each side.
    pub side: usize,
    /// Steps from noise to picture.
    pub n_steps: usize,
    /// How much more the prompt counts than nothing; 1 is as much as it was taught.
    pub guidance: f64,
    /// Of the noise.
    pub seed: u64,
}

impl<'a> Wish<'a> {
    /// The usual one: the paper's 512 pixels, 30 steps, a guidance of 7.5.
    pub fn usual(prompt: &'a str, seed: u64) -> Self {
        Self { prompt, negative: "", side: 512, n_steps: 30, guidance: 7.5, seed }
    }
}

/// A model that makes pictures.
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
    /// The model of these files, which may take twice their size of memory while they are read, four times where they are of half precision.
    ///
    /// # Errors
    /// See [`DiffusionError`].
    pub fn new(mut files: Files) -> Result<Self, DiffusionError> {
        let device = crate::device::best();
        let text_sizes = TextSizes::read(&files)?;
        let sizes = DenoiserSizes::read(&files)?;
        let latents = AutoencoderSizes::read(&files)?;
        if text_sizes.hidden_size != sizes.cross_attention_dim {
            return Err(DiffusionError::Apart {
                what: format!(
                    "the text encoder gives {} numbers a word, the network takes {}",
                    text_sizes.hidden_size, sizes.cross_attention_dim
                ),
            });
        }
        if sizes.in_channels != latents.latent_channels || sizes.out_channels != latents.latent_channels {
            return Err(DiffusionError::Apart {
                what: format!(
                    "the decoder takes {} channels, the network has {} and {}",
                    latents.latent_channels, sizes.in_channels, sizes.out_channels
                ),
            });
        }
        let tokens = Tokens::read(&files, text_sizes.max_position_embeddings, text_sizes.vocab_size)?;
        let scheduler = scheduler::Schedule::read(&files)?;
        let weights = |part: Part, files: &mut Files| -> Result<VarBuilder<'static>, DiffusionError> {
            let bytes = files.take(part)?;
            let damaged =
                |error: candle_core::Error| DiffusionError::Damaged { part, reason: first_line(&error) };
            let tensors: HashMap<String, Tensor> =
                candle_core::safetensors::load_buffer(&bytes, &device).map_err(damaged)?;
            Ok(VarBuilder::from_tensors(tensors, DType::F32, &device))
        };
        let damaged = |part: Part| {
            move |error: candle_core::Error| DiffusionError::Damaged { part, reason: first_line(&error) }
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

    /// What sides of pictures are multiples of.
    pub fn multiple(&self) -> usize {
        self.latents.factor() * self.sizes.factor()
    }

    /// The picture that is wished for, the same for the same seed. `go_on` is called after each step with how many are done,
    /// and stops by false: then there is none.
    ///
    /// What it covers of a surface nobody knows; it is taken for as much as pictures of the starter library show.
    ///
    /// # Errors
    /// [`DiffusionError::Wish`] for a size or a number of steps that cannot be, [`DiffusionError::Tensor`].
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
            return wrong(format!("{} pixels a side cannot be", wish.side));
        }
        if wish.n_steps == 0 || wish.n_steps > MOST_STEPS || !self.scheduler.has_steps(wish.n_steps) {
            return wrong(format!("{} steps cannot be", wish.n_steps));
        }
        if !wish.guidance.is_finite() {
            return wrong("the guidance is no number".to_owned());
        }
        Ok(())
    }
}

impl std::fmt::Debug for Diffusion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Diffusion").field("sizes", &self.sizes).finish_non_exhaustive()
    }
}

/// What an error says, without where it came from: candle adds a trace of the program where one is asked for.
fn first_line(error: &candle_core::Error) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests;
