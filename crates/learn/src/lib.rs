//! Trained predictors: attributes from strokes and from pictures, and pictures from text.
//!
//! Everything else works without this crate. Networks are those of candle, on the processor, or on a graphics card with
//! the feature `cuda`; files are safetensors and nothing else. Nothing here touches the network or a file: bytes come in
//! and go out.
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

pub mod backbone;
pub mod cnn_lstm;
mod dense;
mod device;
pub mod diffusion;
mod init;
pub mod looking;
mod lstm;
pub mod model_file;
mod parameters;
pub mod picture_model;
pub mod picture_set;
pub mod stroke_model;
pub mod stroke_set;
pub mod training;
