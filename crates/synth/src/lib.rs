//! Real-time texture rendering for the audio callback.
//!
//! This crate links neither `std` nor `alloc`: it cannot allocate, lock, wait, log or read a clock, and no function
//! panics. Textures are prepared elsewhere and borrowed as slices ([`texture::Texture`]).
//!
//! # Conventions
//!
//! - Samples are `f32` in m/s², speeds in m/s (`speed_mps`), forces in N (`force_n`), times in seconds.
//! - A *tick* is the control interval, at most [`renderer::TICK_SECS`]. Coefficients change once a tick; levels and
//!   weights change linearly within it. Ticks lie on a fixed grid of the model clock, so the output does not depend on
//!   block sizes.
//! - A *model sample* is one sample at the texture's own rate (usually 1 kHz). [`stream::Stream`] converts model
//!   samples to device samples.
//!
//! ```
//! use shagreen_synth::contact::Contact;
//! use shagreen_synth::lsf::ar_from_lsf;
//! use shagreen_synth::limiter::Limiter;
//!
//! // Two line spectral frequencies define an order-2 linear predictor.
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
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, reason = "tests may panic"))]

pub mod budget;
pub mod contact;
pub mod direction;
pub mod drive;
pub mod equalizer;
pub mod height_map;
mod high_pass;
pub mod impact;
pub mod lift_gate;
pub mod limiter;
mod limits;
pub mod look_ahead;
pub mod lsf;
mod moving_average;
pub mod noise;
mod octave;
mod power_gain;
pub mod relief;
pub mod renderer;
pub mod resampler;
pub mod runtime_table;
pub mod runtime_voice;
pub mod stick_slip;
pub mod stream;
pub mod tap;
pub mod texture;
pub mod voice;
