//! Network sizes from the JSON files of diffusers.

use candle_transformers::models::stable_diffusion::unet_2d::{BlockConfig, UNet2DConditionModelConfig};
use candle_transformers::models::stable_diffusion::vae::AutoEncoderKLConfig;
use serde::Deserialize;
use serde_json::Value;

use super::{DiffusionError, Files, Part};

/// Limits of sizes and layers; they guard against files that would allocate excessive memory.
const LARGEST: usize = 1 << 17;
const MOST_LAYERS: usize = 64;
/// Largest number of resolution levels; more halvings would leave no pixels.
const MOST_BLOCKS: usize = 6;
/// Largest text length, in tokens.
const LONGEST_TEXT: usize = 1024;
/// Largest number of latent channels.
const MOST_LATENTS: usize = 64;

/// Sizes of the text encoder.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct TextSizes {
    pub(super) vocab_size: usize,
    pub(super) hidden_size: usize,
    pub(super) intermediate_size: usize,
    pub(super) max_position_embeddings: usize,
    pub(super) num_hidden_layers: usize,
    pub(super) num_attention_heads: usize,
    #[serde(default = "usual_epsilon")]
    pub(super) layer_norm_eps: f64,
    pub(super) hidden_act: String,
}

fn usual_epsilon() -> f64 {
    1e-5
}

/// Sizes of the denoiser (U-Net).
#[expect(clippy::struct_excessive_bools, reason = "the fields of the file")]
#[derive(Clone, Debug, Deserialize)]
pub(super) struct DenoiserSizes {
    pub(super) in_channels: usize,
    pub(super) out_channels: usize,
    pub(super) cross_attention_dim: usize,
    block_out_channels: Vec<usize>,
    down_block_types: Vec<String>,
    up_block_types: Vec<String>,
    attention_head_dim: OneOrMany,
    layers_per_block: usize,
    norm_num_groups: usize,
    norm_eps: f64,
    #[serde(default)]
    center_input_sample: bool,
    #[serde(default)]
    use_linear_projection: bool,
    flip_sin_to_cos: bool,
    freq_shift: f64,
    #[serde(default = "one")]
    downsample_padding: usize,
    #[serde(default = "one_of_scale")]
    mid_block_scale_factor: f64,
    #[serde(default = "silu")]
    act_fn: String,
    class_embed_type: Option<Value>,
    addition_embed_type: Option<Value>,
    #[serde(default)]
    dual_cross_attention: bool,
}

fn one() -> usize {
    1
}

fn one_of_scale() -> f64 {
    1.0
}

fn silu() -> String {
    "silu".to_owned()
}

/// One value for all blocks, or one per block.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum OneOrMany {
    One(usize),
    Many(Vec<usize>),
}

/// Sizes of the autoencoder.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct AutoencoderSizes {
    pub(super) latent_channels: usize,
    block_out_channels: Vec<usize>,
    layers_per_block: usize,
    norm_num_groups: usize,
    #[serde(default = "usual_scaling")]
    pub(super) scaling_factor: f64,
}

fn usual_scaling() -> f64 {
    0.18215
}

fn damaged(part: Part, reason: &str) -> DiffusionError {
    DiffusionError::Damaged { part, reason: reason.to_owned() }
}

impl TextSizes {
    pub(super) fn read(files: &Files) -> Result<Self, DiffusionError> {
        let part = Part::TextSizes;
        let sizes: Self = files.json(part)?;
        let numbers = [
            sizes.vocab_size,
            sizes.hidden_size,
            sizes.intermediate_size,
            sizes.max_position_embeddings,
            sizes.num_attention_heads,
        ];
        if numbers.iter().any(|n| !(1..=LARGEST).contains(n))
            || !(1..=MOST_LAYERS).contains(&sizes.num_hidden_layers)
            || !(3..=LONGEST_TEXT).contains(&sizes.max_position_embeddings)
            || !sizes.hidden_size.is_multiple_of(sizes.num_attention_heads)
        {
            return Err(damaged(part, "invalid sizes for a text encoder"));
        }
        Ok(sizes)
    }
}

impl DenoiserSizes {
    pub(super) fn read(files: &Files) -> Result<Self, DiffusionError> {
        let part = Part::DenoiserSizes;
        let sizes: Self = files.json(part)?;
        let unknown = |what: &str| Err(DiffusionError::Unknown { part, what: what.to_owned() });
        if sizes.act_fn != "silu" {
            return unknown(&format!("the activation \"{}\"", sizes.act_fn));
        }
        if sizes.class_embed_type.is_some() || sizes.addition_embed_type.is_some() {
            return unknown("conditioning on more than text");
        }
        if sizes.dual_cross_attention {
            return unknown("dual cross-attention");
        }
        let n = sizes.block_out_channels.len();
        let heads = sizes.heads();
        if n == 0
            || n > MOST_BLOCKS
            || [sizes.down_block_types.len(), sizes.up_block_types.len(), heads.len()] != [n; 3]
        {
            return Err(damaged(part, "it needs one size for each block"));
        }
        for (index, kind) in sizes.down_block_types.iter().enumerate() {
            let mirrored = kind.replace("Down", "Up");
            match kind.as_str() {
                "CrossAttnDownBlock2D" | "DownBlock2D" if mirrored == sizes.up_block_types[n - 1 - index] => {
                }
                _ => {
                    return unknown(&format!(
                        "blocks \"{kind}\" and \"{}\"",
                        sizes.up_block_types[n - 1 - index]
                    ));
                }
            }
        }
        let channels = &sizes.block_out_channels;
        let numbers =
            [sizes.in_channels, sizes.out_channels, sizes.cross_attention_dim, sizes.norm_num_groups];
        let fits = |(channels, heads): (&usize, &usize)| {
            (1..=LARGEST).contains(channels)
                && *heads > 0
                && channels.is_multiple_of(*heads)
                && sizes.norm_num_groups > 0
                && channels.is_multiple_of(sizes.norm_num_groups)
        };
        if numbers.iter().any(|n| !(1..=LARGEST).contains(n))
            || !(1..=MOST_LAYERS).contains(&sizes.layers_per_block)
            || sizes.downsample_padding > 1
            || sizes.in_channels.max(sizes.out_channels) > MOST_LATENTS
            || !channels.iter().zip(&heads).all(fits)
        {
            return Err(damaged(part, "invalid sizes for a denoiser"));
        }
        Ok(sizes)
    }

    /// Returns the number of attention heads per block.
    fn heads(&self) -> Vec<usize> {
        match &self.attention_head_dim {
            OneOrMany::One(n) => vec![*n; self.block_out_channels.len()],
            OneOrMany::Many(heads) => heads.clone(),
        }
    }

    /// Returns the required divisor of input sides, so that halving and doubling restore the size.
    pub(super) fn factor(&self) -> usize {
        1 << (self.block_out_channels.len() - 1)
    }

    pub(super) fn config(&self) -> UNet2DConditionModelConfig {
        let block = |((out_channels, kind), heads): ((&usize, &String), usize)| BlockConfig {
            out_channels: *out_channels,
            use_cross_attn: kind.starts_with("CrossAttn").then_some(1),
            attention_head_dim: heads,
        };
        UNet2DConditionModelConfig {
            center_input_sample: self.center_input_sample,
            flip_sin_to_cos: self.flip_sin_to_cos,
            freq_shift: self.freq_shift,
            blocks: self
                .block_out_channels
                .iter()
                .zip(&self.down_block_types)
                .zip(self.heads())
                .map(block)
                .collect(),
            layers_per_block: self.layers_per_block,
            downsample_padding: self.downsample_padding,
            mid_block_scale_factor: self.mid_block_scale_factor,
            norm_num_groups: self.norm_num_groups,
            norm_eps: self.norm_eps,
            cross_attention_dim: self.cross_attention_dim,
            sliced_attention_size: None,
            use_linear_projection: self.use_linear_projection,
        }
    }
}

impl AutoencoderSizes {
    pub(super) fn read(files: &Files) -> Result<Self, DiffusionError> {
        let part = Part::AutoencoderSizes;
        let sizes: Self = files.json(part)?;
        let fits = |n: &usize| (1..=LARGEST).contains(n) && n.is_multiple_of(sizes.norm_num_groups.max(1));
        let channels = &sizes.block_out_channels;
        if channels.is_empty()
            || channels.len() > MOST_BLOCKS
            || sizes.norm_num_groups == 0
            || !channels.iter().all(fits)
            || !(1..=MOST_LATENTS).contains(&sizes.latent_channels)
            || !(1..=MOST_LAYERS).contains(&sizes.layers_per_block)
            || !sizes.scaling_factor.is_normal()
        {
            return Err(damaged(part, "invalid sizes for an autoencoder"));
        }
        Ok(sizes)
    }

    /// Returns the pixels per latent along one side.
    pub(super) fn factor(&self) -> usize {
        1 << (self.block_out_channels.len() - 1)
    }

    pub(super) fn config(&self) -> AutoEncoderKLConfig {
        AutoEncoderKLConfig {
            block_out_channels: self.block_out_channels.clone(),
            layers_per_block: self.layers_per_block,
            latent_channels: self.latent_channels,
            norm_num_groups: self.norm_num_groups,
            use_quant_conv: true,
            use_post_quant_conv: true,
        }
    }
}
