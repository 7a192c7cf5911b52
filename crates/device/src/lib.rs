//! Device access: actuator outputs, styluses, and the real-time engine between them.
//!
//! # Conventions
//!
//! - SI units, stated in names: `x_m`, `speed_mps`, `force_n`, `time_secs`, `rate_hz`; accelerations are in m/s²
//!   (`_mps2`). Only the drive signal is dimensionless: -1..1 of the device's full scale.
//! - The engine has two halves: an [`engine::Handle`] for the controlling thread and an [`engine::Engine`] for the
//!   audio callback. Controls that must agree are sent as one `Copy` struct. Textures and strokes are sent through
//!   bounded queues and returned to be freed. A full queue returns the value to the sender.
//! - An output is opened by its id and never replaced by another one. If the output is lost, nothing plays, and
//!   [`status::Status`] reports the loss.
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
//!     friction: None,
//! })?;
//! // Body of an audio callback. No texture is loaded, so the output is silent.
//! let mut out = [f32::NAN; 512];
//! engine.process(&mut out, 2);
//! assert_eq!(out, [0.0; 512]);
//! assert_eq!(handle.status().frames_played, 256);
//! # Ok::<(), engine::ConfigError>(())
//! ```
#![deny(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, reason = "tests"))]

#[cfg(target_os = "linux")]
#[expect(unsafe_code, reason = "ALSA writes to standard error unless a C function pointer is set")]
mod alsa_messages;
mod audio;
pub mod audio_input;
pub mod controls;
mod edge;
pub mod engine;
pub mod error;
pub mod hand;
pub mod haptic_pen;
pub mod hid;
pub mod impact;
pub mod kinematics;
mod link;
pub mod live;
pub mod measure;
mod null_output;
pub mod operating_system;
pub mod output;
mod output_claim;
mod output_options;
pub mod pen_backend;
pub mod pressure;
#[cfg(target_os = "linux")]
mod pulse;
pub mod repeat;
mod running;
pub mod sensor;
pub mod serial;
pub mod signal;
pub mod sound_server;
pub mod status;
pub mod stylus;
pub mod texture;
pub mod touch;
pub mod track;
pub mod urgency;

/// Rendering types that an engine takes: `Mix`, `Contact`, `DriveConfig`, `Node`, `Tap`, `Triangle`.
pub use shagreen_synth as synth;
