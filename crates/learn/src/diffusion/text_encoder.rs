//! CLIP text encoder (A. Radford et al. 2021) of any size; candle's version only has the sizes of published models.

use candle_core::{DType, Result, Tensor};
use candle_nn::{Embedding, LayerNorm, Linear, Module as _, VarBuilder, embedding, layer_norm, linear};

use super::sizes::TextSizes;

/// The encoder.
#[derive(Debug)]
pub(super) struct TextEncoder {
    words: Embedding,
    places: Tensor,
    layers: Vec<Layer>,
    norm: LayerNorm,
    n_heads: usize,
    activation: Activation,
}

#[derive(Debug)]
struct Layer {
    before_attention: LayerNorm,
    query: Linear,
    key: Linear,
    value: Linear,
    out: Linear,
    before_dense: LayerNorm,
    wide: Linear,
    narrow: Linear,
}

#[derive(Clone, Copy, Debug)]
enum Activation {
    /// `x σ(1.702 x)`.
    QuickGelu,
    /// Exact GELU, with the error function.
    Gelu,
}

impl TextEncoder {
    pub(super) fn new(weights: &VarBuilder<'_>, sizes: &TextSizes) -> Result<Self> {
        let weights = weights.pp("text_model");
        let n = sizes.hidden_size;
        let norm = |at: VarBuilder<'_>| layer_norm(n, sizes.layer_norm_eps, at);
        let layer = |index: usize| {
            let at = weights.pp(format!("encoder.layers.{index}"));
            let attention = at.pp("self_attn");
            Ok(Layer {
                before_attention: norm(at.pp("layer_norm1"))?,
                query: linear(n, n, attention.pp("q_proj"))?,
                key: linear(n, n, attention.pp("k_proj"))?,
                value: linear(n, n, attention.pp("v_proj"))?,
                out: linear(n, n, attention.pp("out_proj"))?,
                before_dense: norm(at.pp("layer_norm2"))?,
                wide: linear(n, sizes.intermediate_size, at.pp("mlp.fc1"))?,
                narrow: linear(sizes.intermediate_size, n, at.pp("mlp.fc2"))?,
            })
        };
        let embeddings = weights.pp("embeddings");
        Ok(Self {
            words: embedding(sizes.vocab_size, n, embeddings.pp("token_embedding"))?,
            places: embeddings.get((sizes.max_position_embeddings, n), "position_embedding.weight")?,
            layers: (0..sizes.num_hidden_layers).map(layer).collect::<Result<_>>()?,
            norm: norm(weights.pp("final_layer_norm"))?,
            n_heads: sizes.num_attention_heads,
            activation: match sizes.hidden_act.as_str() {
                "quick_gelu" => Activation::QuickGelu,
                "gelu" => Activation::Gelu,
                other => candle_core::bail!("the activation \"{other}\" is not supported"),
            },
        })
    }

    /// Returns the contextual embedding of each token (texts × tokens × features), from token ids (texts × tokens).
    pub(super) fn encode(&self, ids: &Tensor) -> Result<Tensor> {
        let (_, length) = ids.dims2()?;
        let mut x = self.words.forward(ids)?.broadcast_add(&self.places.narrow(0, 0, length)?)?;
        // Causal mask: no token attends to later tokens.
        let mask: Vec<f32> = (0..length * length)
            .map(|i| if i % length > i / length { f32::NEG_INFINITY } else { 0.0 })
            .collect();
        let mask = Tensor::from_vec(mask, (length, length), ids.device())?.to_dtype(DType::F32)?;
        for layer in &self.layers {
            x = (&x + layer.attend(&layer.before_attention.forward(&x)?, self.n_heads, &mask)?)?;
            let wide = layer.wide.forward(&layer.before_dense.forward(&x)?)?;
            x = (&x + layer.narrow.forward(&self.activation.apply(&wide)?)?)?;
        }
        self.norm.forward(&x)
    }
}

impl Layer {
    fn attend(&self, x: &Tensor, n_heads: usize, mask: &Tensor) -> Result<Tensor> {
        let (n_texts, length, n) = x.dims3()?;
        let n_each = n / n_heads;
        let by_head = |of: &Linear| {
            of.forward(x)?.reshape((n_texts, length, n_heads, n_each))?.transpose(1, 2)?.contiguous()
        };
        let (query, key, value) = (by_head(&self.query)?, by_head(&self.key)?, by_head(&self.value)?);
        let scores =
            (query.matmul(&key.t()?.contiguous()?)? / (n_each as f64).sqrt())?.broadcast_add(mask)?;
        let heard = candle_nn::ops::softmax_last_dim(&scores)?.matmul(&value)?;
        self.out.forward(&heard.transpose(1, 2)?.reshape((n_texts, length, n))?)
    }
}

impl Activation {
    fn apply(self, x: &Tensor) -> Result<Tensor> {
        match self {
            Self::QuickGelu => x * candle_nn::ops::sigmoid(&(x * 1.702)?)?,
            Self::Gelu => x.gelu_erf(),
        }
    }
}
