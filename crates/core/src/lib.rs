//! Texture models, authoring spaces, interpolation between textures, and the contact model behind the starter library.
//!
//! This crate is pure: it uses no files, no clock, no threads of its own, no environment variables and no unseeded randomness.
//!
//! # Conventions
//!
//! - Numbers are `f64` in SI units. A quantity in a public signature has a type of [`units`]; a bare `f64` is
//!   dimensionless.
//! - A *texture* is identified by its index in a library.
//! - A *point* of the authoring space has two coordinates, 0 to 100; 0 is the roughest or the hardest
//!   ([`space::SpacePoint`]).
//! - Power spectral densities are one-sided, in (m/s²)²/Hz.
//!
//! # Modules
//!
//! Each module uses only the modules listed before it, plus [`units`] and [`words`] (checked by
//! `tests/structure/rooms.rs`):
//! [`maths`], [`dsp`], [`texture`], [`recording`], [`people`], [`space`], [`surfaces`], [`signals`], [`actuator`].
//!
//! ```
//! use shagreen_core::space::authoring::Authoring;
//! use shagreen_core::texture::blend::Mode;
//! use shagreen_core::space::{Space, SpacePoint};
//!
//! let at = |rs, hs| SpacePoint::new(rs, hs).map(Some);
//! let space = Space::new(&[at(0.0, 0.0)?, at(100.0, 0.0)?, at(0.0, 100.0)?])?;
//! let authoring = Authoring::new(space);
//! let authored = authoring.author(SpacePoint::new(25.0, 25.0)?, &Mode::Power.into()).expect("there are textures");
//! assert_eq!(authored.parents[0], (0, 0.5));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected value")
)]

pub mod actuator;
pub mod dsp;
pub mod maths;
pub mod people;
pub mod recording;
pub mod signals;
pub mod space;
pub mod surfaces;
pub mod texture;
pub mod units;
pub mod words;
