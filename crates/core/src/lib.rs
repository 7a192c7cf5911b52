//! Texture models, spaces, blending and the physics behind the starter library.
//!
//! Pure: nothing here touches a file, a clock, a thread, the environment or unseeded randomness.
//!
//! # Conventions
//!
//! - `f64` and SI units. Across a public boundary a quantity is a type of [`units`]; a bare `f64` has no unit.
//! - A *texture* is known by its index in a library; a *point* of the space runs 0..100 on both axes, 0 = roughest and
//!   0 = hardest ([`space::SpacePoint`]).
//! - Power spectral densities are one-sided, in (m/s²)²/Hz.
//!
//! ```
//! use shagreen_core::authoring::Authoring;
//! use shagreen_core::blend::Mode;
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
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

pub mod actuator;
pub mod ar;
pub mod arma;
pub mod attribute_predictor;
pub mod authoring;
pub mod blend;
pub mod boundary;
pub mod calibration;
pub mod codec;
pub mod contact_model;
pub mod dft321;
pub mod dissimilarities;
pub mod drawn_material;
pub mod drawn_path;
pub mod features;
pub mod fidelity;
mod field;
pub mod filter;
pub mod fit;
pub mod gaussian_process;
pub mod generated;
pub mod heat_map;
pub mod height_field;
pub mod imagined;
pub mod isotonic;
pub mod least_squares;
pub mod leave_one_out;
pub mod lsf;
pub mod material;
pub mod mds;
pub mod mfcc;
pub mod natural_neighbor;
pub mod panel;
pub mod patterns;
pub mod picture_features;
pub mod plane;
pub mod procrustes;
pub mod profile;
pub mod profile_stimuli;
pub mod prompt;
pub mod property;
pub mod quality;
pub mod radial_basis;
pub mod rate;
pub mod ratings;
pub mod recording;
pub mod relief;
pub mod render;
pub mod rng;
mod sampled;
pub mod segment;
pub mod selection;
pub mod shading;
mod smoother;
pub mod sorting;
pub mod space;
pub mod space_build;
pub mod spatial_spectrogram;
pub mod spectrum;
pub mod starter;
pub mod statistics;
pub mod tap;
pub mod texture;
pub mod texture_path;
pub mod threshold;
pub mod touch_words;
pub mod triangulation;
pub mod units;
pub mod words;
