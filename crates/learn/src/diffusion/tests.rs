use super::sizes::TextSizes;
use super::text_encoder::TextEncoder;
use super::tokens::Tokens;
use super::{Diffusion, DiffusionError, Files, Part, Wish};
use crate::init::Uniform;
use candle_core::{DType, Device, Tensor};
use candle_nn::{VarBuilder, VarMap};
use candle_transformers::models::stable_diffusion::unet_2d::UNet2DConditionModel;
use candle_transformers::models::stable_diffusion::vae::AutoEncoderKL;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};

/// Vocabulary of a toy language: letters, and letters at the end of a word.
fn vocabulary() -> Value {
    let letters = "abcdefghijklmnopqrstuvwxyz,-";
    let mut words: Vec<String> = letters.chars().map(String::from).collect();
    words.extend(letters.chars().map(|letter| format!("{letter}</w>")));
    words.extend(["ro", "ug", "roug", "rough</w>"].map(str::to_owned));
    words.extend(["<|startoftext|>", "<|endoftext|>"].map(str::to_owned));
    let numbered = words.into_iter().enumerate().map(|(number, word)| (word, json!(number)));
    Value::Object(numbered.collect())
}

const MERGES: &str = "#version: 0.2\nr o\nu g\nro ug\nroug h</w>\n";

fn text_sizes() -> Value {
    json!({
        "vocab_size": 64, "hidden_size": 12, "intermediate_size": 20, "max_position_embeddings": 16,
        "num_hidden_layers": 2, "num_attention_heads": 3, "hidden_act": "gelu",
    })
}

fn denoiser_sizes() -> Value {
    json!({
        "in_channels": 4, "out_channels": 4, "cross_attention_dim": 12, "block_out_channels": [32, 64],
        "down_block_types": ["CrossAttnDownBlock2D", "DownBlock2D"],
        "up_block_types": ["UpBlock2D", "CrossAttnUpBlock2D"], "attention_head_dim": [2, 4],
        "layers_per_block": 1, "norm_num_groups": 32, "norm_eps": 1e-5, "flip_sin_to_cos": true,
        "freq_shift": 0, "use_linear_projection": true,
    })
}

fn autoencoder_sizes() -> Value {
    json!({"latent_channels": 4, "block_out_channels": [32, 32], "layers_per_block": 1, "norm_num_groups": 32})
}

fn schedule() -> Value {
    json!({
        "beta_start": 0.00085, "beta_end": 0.012, "beta_schedule": "scaled_linear", "steps_offset": 1,
        "num_train_timesteps": 1000, "prediction_type": "v_prediction", "set_alpha_to_one": false,
    })
}

/// Random weights for all tensors that a network requests; norm weights are near one.
fn weights(seed: u64, build: impl FnOnce(VarBuilder<'_>)) -> Vec<u8> {
    let map = VarMap::new();
    build(VarBuilder::from_varmap(&map, DType::F32, &Device::Cpu));
    let shapes: BTreeMap<String, Vec<usize>> =
        map.data().lock().unwrap().iter().map(|(name, var)| (name.clone(), var.dims().to_vec())).collect();
    let mut uniform = Uniform::new(seed);
    let tensors: HashMap<String, Tensor> = shapes
        .into_iter()
        .map(|(name, shape)| {
            let n: usize = shape.iter().product();
            let fan = (n / shape[0]).max(1);
            let mut values = uniform.within((3.0 / fan as f32).sqrt().min(0.5), n);
            if name.contains("norm") && name.ends_with("weight") {
                for x in &mut values {
                    *x += 1.0;
                }
            }
            (name, Tensor::from_vec(values, shape, &Device::Cpu).unwrap())
        })
        .collect();
    safetensors::serialize(tensors, None).unwrap()
}

fn files() -> Files {
    let mut files = Files::default();
    let json = [
        (Part::TextSizes, text_sizes()),
        (Part::DenoiserSizes, denoiser_sizes()),
        (Part::AutoencoderSizes, autoencoder_sizes()),
        (Part::Schedule, schedule()),
        (Part::Vocabulary, vocabulary()),
        (Part::TokenizerSettings, json!({"pad_token": {"content": "a"}})),
    ];
    for (part, value) in json {
        files.add(part, value.to_string().into_bytes());
    }
    files.add(Part::Merges, MERGES.as_bytes().to_vec());
    let text = TextSizes::read(&files).unwrap();
    files.add(Part::Text, weights(1, |at| drop(TextEncoder::new(&at, &text).unwrap())));
    let denoiser = super::DenoiserSizes::read(&files).unwrap();
    let build = |at: VarBuilder<'_>| {
        UNet2DConditionModel::new(at, 4, 4, false, denoiser.config()).unwrap();
    };
    files.add(Part::Denoiser, weights(2, build));
    let autoencoder = super::AutoencoderSizes::read(&files).unwrap();
    let build = |at: VarBuilder<'_>| drop(AutoEncoderKL::new(at, 3, 3, autoencoder.config()).unwrap());
    files.add(Part::Autoencoder, weights(3, build));
    files
}

fn wish(prompt: &str, seed: u64) -> Wish<'_> {
    Wish { side: 32, n_steps: 4, ..Wish::usual(prompt, seed) }
}

#[test]
fn from_words_to_pixels_the_same_for_the_same_seed() {
    let diffusion = Diffusion::new(files()).unwrap();
    assert_eq!(diffusion.multiple(), 4);
    let mut steps = Vec::new();
    let picture = diffusion
        .picture(&wish("rough wood", 1), |step| {
            steps.push(step);
            true
        })
        .unwrap()
        .unwrap();
    assert_eq!(steps, [1, 2, 3, 4]);
    assert_eq!((picture.width, picture.height, picture.rgb.len()), (32, 32, 3 * 32 * 32));
    // The picture has contrast.
    let (low, high) = (picture.rgb.iter().min().unwrap(), picture.rgb.iter().max().unwrap());
    assert!(high - low > 20, "{low} {high}");
    let again = |wish: &Wish<'_>| diffusion.picture(wish, |_| true).unwrap().unwrap();
    assert_eq!(again(&wish("rough wood", 1)), picture);
    assert_ne!(again(&wish("rough wood", 2)), picture, "another seed must give another picture");
    assert_ne!(again(&wish("smooth", 1)), picture, "another prompt must give another picture");
    assert_ne!(again(&Wish { negative: "wood", ..wish("rough wood", 1) }), picture);
    assert_eq!(
        diffusion.picture(&wish("rough", 1), |step| step < 2).unwrap(),
        None,
        "a stopped generation must give no picture"
    );
}

#[test]
fn without_guidance_the_negative_prompt_does_not_count() {
    let diffusion = Diffusion::new(files()).unwrap();
    let made = |negative| {
        let wish = Wish { negative, guidance: 1.0, n_steps: 2, ..wish("rough", 3) };
        diffusion.picture(&wish, |_| true).unwrap().unwrap().rgb
    };
    let (one, other) = (made(""), made("wood"));
    // Rounding may differ by one level.
    assert!(one.iter().zip(&other).all(|(a, b)| a.abs_diff(*b) <= 1));
}

#[test]
fn sizes_and_steps_that_cannot_be_are_refused() {
    let diffusion = Diffusion::new(files()).unwrap();
    for wrong in [
        Wish { side: 30, ..wish("x", 1) },
        Wish { side: 0, ..wish("x", 1) },
        Wish { side: 2048, ..wish("x", 1) },
        Wish { n_steps: 0, ..wish("x", 1) },
        Wish { n_steps: 501, ..wish("x", 1) },
        Wish { guidance: f64::NAN, ..wish("x", 1) },
    ] {
        let error = diffusion.picture(&wrong, |_| true).unwrap_err();
        assert!(matches!(error, DiffusionError::Wish { multiple: 4, .. }), "{error}");
    }
}

#[test]
fn every_schedule_that_is_taken_makes_a_picture_and_steps_beyond_what_was_taught_are_refused() {
    let with = |changes: &[(&str, Value)]| {
        let (mut files, mut value) = (files(), schedule());
        for (key, to) in changes {
            value[*key] = to.clone();
        }
        files.add(Part::Schedule, value.to_string().into_bytes());
        Diffusion::new(files).unwrap()
    };
    let mut pictures = Vec::new();
    for betas in ["scaled_linear", "linear"] {
        for prediction in ["epsilon", "v_prediction", "sample"] {
            for spacing in ["leading", "linspace"] {
                let diffusion = with(&[
                    ("beta_schedule", json!(betas)),
                    ("prediction_type", json!(prediction)),
                    ("timestep_spacing", json!(spacing)),
                ]);
                pictures.push(diffusion.picture(&wish("rough", 1), |_| true).unwrap().unwrap().rgb);
            }
        }
    }
    pictures.sort();
    pictures.dedup();
    assert!(pictures.len() > 8, "schedules must give different pictures: {}", pictures.len());
    let late = with(&[("steps_offset", json!(60))]);
    let far = Wish { n_steps: 30, ..wish("rough", 1) };
    assert!(matches!(late.picture(&far, |_| true), Err(DiffusionError::Wish { .. })));
    assert!(late.picture(&wish("rough", 1), |_| true).is_ok());
}

#[test]
fn the_text_encoder_of_the_first_version_and_one_number_of_heads_are_taken() {
    let mut first = files();
    let mut sizes = text_sizes();
    sizes["hidden_act"] = json!("quick_gelu");
    first.add(Part::TextSizes, sizes.to_string().into_bytes());
    let mut sizes = denoiser_sizes();
    sizes["attention_head_dim"] = json!(4);
    first.add(Part::DenoiserSizes, sizes.to_string().into_bytes());
    let made = |files| Diffusion::new(files).unwrap().picture(&wish("rough", 1), |_| true).unwrap().unwrap();
    assert_ne!(made(first), made(files()));
}

#[test]
fn what_is_missing_damaged_or_of_another_kind_is_named() {
    let failure = |change: &dyn Fn(&mut Files)| {
        let mut files = files();
        change(&mut files);
        Diffusion::new(files).unwrap_err().to_string()
    };
    for part in Part::ALL.into_iter().filter(|part| !part.is_optional()) {
        let missing = failure(&|files| drop(files.take(part)));
        assert!(missing.contains(part.names()[0]) && missing.contains("layout of diffusers"), "{missing}");
        let cut = failure(&|files| {
            let mut bytes = files.take(part).unwrap();
            bytes.truncate(bytes.len() / 2);
            files.add(part, bytes);
        });
        // Half of a merges file is valid too; then words are merged less.
        assert!(cut.contains(part.names()[0]) || part == Part::Merges, "{part:?}: {cut}");
    }
    let with = |part: Part, value: &Value, key: &str, to: Value| {
        let mut value = value.clone();
        value[key] = to;
        failure(&|files| files.add(part, value.to_string().into_bytes()))
    };
    let text = |key, to| with(Part::TextSizes, &text_sizes(), key, to);
    assert!(text("hidden_size", json!(24)).contains("do not match"));
    assert!(text("num_attention_heads", json!(0)).contains("sizes for a text encoder"));
    assert!(text("hidden_act", json!("swish")).contains("swish"));
    assert!(text("vocab_size", json!(20)).contains("vocab.json"));
    let denoiser = |key, to| with(Part::DenoiserSizes, &denoiser_sizes(), key, to);
    assert!(denoiser("addition_embed_type", json!("text_time")).contains("Stable Diffusion 1 or 2"));
    assert!(denoiser("down_block_types", json!(["AttnDownBlock2D", "DownBlock2D"])).contains("AttnDown"));
    assert!(denoiser("attention_head_dim", json!([2])).contains("one size for each block"));
    assert!(denoiser("block_out_channels", json!([32, 0])).contains("sizes for a denoiser"));
    assert!(denoiser("layers_per_block", json!(2)).contains("unet/diffusion_pytorch_model"));
    assert!(denoiser("in_channels", json!(9)).contains("autoencoder takes 4 latent channels"));
    let decoder = |key, to| with(Part::AutoencoderSizes, &autoencoder_sizes(), key, to);
    assert!(decoder("norm_num_groups", json!(0)).contains("sizes for an autoencoder"));
    assert!(decoder("latent_channels", json!(8)).contains("autoencoder takes 8 latent channels"));
    assert!(denoiser("downsample_padding", json!(1_000_000)).contains("sizes for a denoiser"));
    assert!(denoiser("norm_num_groups", json!(0)).contains("sizes for a denoiser"));
    let many = |of: &str| json!(vec![of; 12]);
    let deep = {
        let mut deep = denoiser_sizes();
        deep["block_out_channels"] = json!(vec![32; 12]);
        deep["attention_head_dim"] = json!(2);
        deep["down_block_types"] = many("DownBlock2D");
        deep["up_block_types"] = many("UpBlock2D");
        failure(&|files| files.add(Part::DenoiserSizes, deep.to_string().into_bytes()))
    };
    assert!(deep.contains("one size for each block"), "{deep}");
    assert!(text("max_position_embeddings", json!(100_000)).contains("sizes for a text encoder"));
    assert!(decoder("latent_channels", json!(100_000)).contains("sizes for an autoencoder"));
    let schedule = |key, to| with(Part::Schedule, &schedule(), key, to);
    for key in ["set_alpha_to_one", "clip_sample", "thresholding", "rescale_betas_zero_snr"] {
        assert!(schedule(key, json!(true)).contains(key));
    }
    assert!(schedule("trained_betas", json!([0.1])).contains("trained_betas"));
    assert!(schedule("beta_schedule", json!("squaredcos_cap_v2")).contains("squaredcos"));
    assert!(schedule("timestep_spacing", json!("trailing")).contains("trailing"));
    assert!(schedule("beta_schedule", json!("sine")).contains("sine"));
    assert!(schedule("num_train_timesteps", json!(0)).contains("invalid schedule"));
}

#[test]
fn parts_of_words_are_merged_by_the_rules() {
    let tokens = Tokens::read(&files(), 8, 64).unwrap();
    let number = |word: &str| vocabulary()[word].as_u64().unwrap() as u32;
    let expected: Vec<u32> =
        ["<|startoftext|>", "rough</w>", "c", "a</w>", "ro", "d</w>", "<|endoftext|>", "a"]
            .map(number)
            .to_vec();
    assert_eq!(tokens.ids("  Rough\n CA rod").unwrap(), expected);
    let long = tokens.ids(&"rough ".repeat(50)).unwrap();
    assert_eq!((long.len(), long[7]), (8, number("<|endoftext|>")));
    // Unknown letters map to the unknown token without an error.
    assert_eq!(tokens.ids("\u{7c97}").unwrap().len(), 8);
    assert_eq!(tokens.ids("").unwrap()[1], number("<|endoftext|>"));
}

#[test]
fn the_text_encoder_is_its_definition() {
    let files = files();
    let sizes = TextSizes::read(&files).unwrap();
    let tensors =
        candle_core::safetensors::load_buffer(files.get(Part::Text).unwrap(), &Device::Cpu).unwrap();
    let at = |name: &str| -> Vec<f64> {
        let tensor = &tensors[&format!("text_model.{name}")];
        tensor.flatten_all().unwrap().to_vec1::<f32>().unwrap().into_iter().map(f64::from).collect()
    };
    let ids = [3_u32, 60, 7, 7, 12];
    let n = sizes.hidden_size;
    let dense = |name: &str, x: &[f64]| -> Vec<f64> {
        let (weight, bias) = (at(&format!("{name}.weight")), at(&format!("{name}.bias")));
        let row = |o: usize| {
            bias[o] + x.iter().zip(&weight[o * x.len()..]).map(|(x, weight)| x * weight).sum::<f64>()
        };
        (0..bias.len()).map(row).collect()
    };
    let norm = |name: &str, x: &[f64]| -> Vec<f64> {
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        let variance = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / x.len() as f64;
        let (weight, bias) = (at(&format!("{name}.weight")), at(&format!("{name}.bias")));
        (0..x.len()).map(|i| (x[i] - mean) / (variance + 1e-5).sqrt() * weight[i] + bias[i]).collect()
    };
    let gelu = |x: f64| 0.5 * x * (1.0 + libm::erf(x / 2.0_f64.sqrt()));
    let (words, places) =
        (at("embeddings.token_embedding.weight"), at("embeddings.position_embedding.weight"));
    let mut x: Vec<Vec<f64>> = ids
        .iter()
        .enumerate()
        .map(|(place, id)| (0..n).map(|i| words[*id as usize * n + i] + places[place * n + i]).collect())
        .collect();
    for layer in 0..sizes.num_hidden_layers {
        let name = |part: &str| format!("encoder.layers.{layer}.{part}");
        let normed: Vec<Vec<f64>> = x.iter().map(|x| norm(&name("layer_norm1"), x)).collect();
        let of = |part: &str| -> Vec<Vec<f64>> { normed.iter().map(|x| dense(&name(part), x)).collect() };
        let (q, k, v) = (of("self_attn.q_proj"), of("self_attn.k_proj"), of("self_attn.v_proj"));
        let each = n / sizes.num_attention_heads;
        let mut heard = vec![vec![0.0; n]; ids.len()];
        for head in 0..sizes.num_attention_heads {
            for (to, heard) in heard.iter_mut().enumerate() {
                let score = |from: usize| -> f64 {
                    let sum: f64 = (head * each..(head + 1) * each).map(|i| q[to][i] * k[from][i]).sum();
                    (sum / (each as f64).sqrt()).exp()
                };
                let total: f64 = (0..=to).map(score).sum();
                for i in head * each..(head + 1) * each {
                    heard[i] = (0..=to).map(|from| score(from) / total * v[from][i]).sum();
                }
            }
        }
        for (x, heard) in x.iter_mut().zip(&heard) {
            let out = dense(&name("self_attn.out_proj"), heard);
            x.iter_mut().zip(out).for_each(|(x, out)| *x += out);
            let wide: Vec<f64> =
                dense(&name("mlp.fc1"), &norm(&name("layer_norm2"), x)).into_iter().map(gelu).collect();
            let narrow = dense(&name("mlp.fc2"), &wide);
            x.iter_mut().zip(narrow).for_each(|(x, out)| *x += out);
        }
    }
    let expected: Vec<f64> = x.iter().flat_map(|x| norm("final_layer_norm", x)).collect();
    let weights = VarBuilder::from_tensors(tensors.clone(), DType::F32, &Device::Cpu);
    let encoder = TextEncoder::new(&weights, &sizes).unwrap();
    let got = encoder.encode(&Tensor::new(&[ids], &Device::Cpu).unwrap()).unwrap();
    for (got, expected) in got.flatten_all().unwrap().to_vec1::<f32>().unwrap().into_iter().zip(expected) {
        assert!((f64::from(got) - expected).abs() < 1e-4, "{got} for {expected}");
    }
}
