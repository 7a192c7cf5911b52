//! Everything that can block, fail or vanish: actuator outputs, styluses, and the engine between them.
//!
//! # Conventions
//!
//! - SI units, in the name of every number: `x_m`, `speed_mps`, `force_n`, `time_secs`, `rate_hz`; accelerations are
//!   in m/s² (`_mps2`). Only the last step before the actuator is without a unit: -1..1 of the device's full scale.
//! - Two halves: a [`engine::Handle`] for whoever is in charge, an [`engine::Engine`] for the callback. What must agree
//!   goes down in one `Copy` struct, textures and strokes go down in bounded rings and come back to be freed, and a
//!   full ring gives the value back.
//! - An output is opened by identity and never replaced by another: if it goes, there is silence, and
//!   [`status::Status`] says so.
//!
//! ```
//! use shagreen_device::engine::{self, ChannelMask, EngineConfig};
//! use shagreen_device::synth::drive::DriveConfig;
//!
//! let (mut handle, mut engine) = engine::new(EngineConfig {
//!     model_rate_hz: 1000.0,
//!     device_rate_hz: 48_000.0,
//!     seed: 1,
//!     drive: DriveConfig::proportional(20.0, 0.9),
//!     channels: ChannelMask::FIRST_TWO,
//! })?;
//! // What a callback does: here nothing is loaded, so it is silence.
//! let mut out = [f32::NAN; 512];
//! engine.process(&mut out, 2);
//! assert_eq!(out, [0.0; 512]);
//! assert_eq!(handle.status().frames_played, 256);
//! # Ok::<(), engine::ConfigError>(())
//! ```
#![deny(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, reason = "tests"))]

mod audio;
pub mod audio_input;
pub mod controls;
mod edge;
pub mod engine;
pub mod error;
pub mod hand;
pub mod hid;
pub mod kinematics;
mod link;
pub mod live;
pub mod measure;
mod null_output;
pub mod output;
pub mod pressure;
#[cfg(target_os = "linux")]
mod pulse;
pub mod repeat;
pub mod serial;
pub mod signal;
pub mod status;
pub mod stylus;
pub mod texture;
pub mod touch;
pub mod track;
mod urgency;

/// The types that an engine is fed with: `Mix`, `Contact`, `DriveConfig`, `Node`, `Tap`, `Triangle`.
pub use shagreen_synth as synth;
