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

pub mod backbone;
pub mod cnn_lstm;
mod dense;
mod device;
pub mod diffusion;
mod init;
mod lstm;
pub mod model_file;
mod parameters;
pub mod picture_model;
pub mod picture_predictor;
pub mod picture_set;
pub mod stroke_model;
pub mod stroke_set;
pub mod training;
mod training_error;
