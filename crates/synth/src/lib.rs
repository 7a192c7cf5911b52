//! What runs inside the audio callback.
//!
//! This crate links neither `std` nor `alloc`: it cannot allocate, lock, wait, log or read a clock, and every
//! function in it is total. Textures are prepared elsewhere and lent as slices ([`texture::Texture`]).
//!
//! # Conventions
//!
//! - `f32` samples in m/s², speeds in m/s (`speed_mps`), forces in N (`force_n`), time in seconds.
//! - A *tick* is the control interval, at most [`renderer::TICK_SECS`]: coefficients change once a tick, levels
//!   and weights move linearly within it. Ticks lie on the grid of the model clock, so output never depends on
//!   the size of the blocks that it is asked for in.
//! - A *model sample* is one sample at the texture's own rate (usually 1 kHz); [`stream::Stream`] turns model
//!   samples into device samples.
//!
//! ```
//! use shagreen_synth::contact::Contact;
//! use shagreen_synth::lsf::ar_from_lsf;
//! use shagreen_synth::limiter::Limiter;
//!
//! // Two line spectral frequencies make an order-2 predictor.
//! let mut ar = [0.0_f32; 2];
//! ar_from_lsf(&[0.5, 0.7], &mut ar);
//! assert!((ar[0] + 1.642_424_5).abs() < 1e-5);
//!
//! // The limiter never exceeds its ceiling.
//! let mut limiter = Limiter::new(1.0, 0.8);
//! assert!(limiter.limit(1.0e9) <= 1.0);
//! assert_eq!(Contact::default().speed_mps, 0.0);
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

pub mod budget;
pub mod contact;
pub mod drive;
pub mod equalizer;
pub mod limiter;
pub mod look_ahead;
pub mod lsf;
mod moving_average;
pub mod noise;
pub mod relief;
pub mod renderer;
pub mod resampler;
pub mod stream;
pub mod tap;
pub mod texture;
pub mod voice;
