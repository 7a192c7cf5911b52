//! Trained models: attributes predicted from strokes and pictures, and pictures generated from text.
//!
//! No other crate needs this one. Networks run with candle on the CPU, or on a GPU with the feature `cuda`. Model files
//! are safetensors only. This crate accesses neither the internet nor the file system: callers pass bytes in and
//! receive bytes.
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")
)]

pub mod attribute_model;
pub mod backbone;
pub mod cnn_lstm;
mod dense;
mod dense_stack;
mod device;
pub mod diffusion;
mod feature_scale;
mod init;
mod lstm;
pub mod model_card;
pub mod model_file;
mod parameters;
pub mod photo_card;
pub mod photo_config;
mod photo_deviation;
mod photo_evidence;
pub mod photo_folds;
pub mod photo_heads;
pub mod photo_model;
pub mod photo_set;
pub mod photo_validation;
pub mod picture_model;
pub mod picture_prediction;
pub mod picture_predictor;
pub mod picture_set;
pub mod stroke_model;
pub mod stroke_set;
pub mod training;
mod training_error;
