//! Bytes to types and back: texture libraries, pen strokes, rendered signals, material parameters.
//!
//! # Conventions
//!
//! - A reader takes bytes and gives a value of this crate or of `shagreen-core`, checked by core's own constructors, or
//!   one error that says what is wrong and what to do. It names the place in the file; whoever opened the file adds its path.
//! - What is not quite as it should be and yet usable is a warning in [`imported::Imported`], not an error.
//! - Types that end in `V1` own a wire format. Files are in the units of hands (mm/s, N, mm); values are SI.
//! - Files are written by [`atomic`] alone: whole, or not at all.
//!
//! ```
//! let library = shagreen_formats::starter::starter_library()?;
//! let bytes = shagreen_formats::library::write_library(&library);
//! assert_eq!(shagreen_formats::library::read_library(&bytes)?.value, library);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

pub mod acf;
pub mod actuator_toml;
pub mod atomic;
pub mod attribute_table;
pub mod built_in;
pub mod calibration_report;
pub mod codec_stream;
pub mod codec_tables;
pub mod csv_text;
pub mod evaluation_report;
pub mod figure;
pub mod fit_report;
pub mod gallery;
pub mod hatt;
pub mod hid_text;
pub mod imported;
mod layout;
pub mod lexicon_toml;
pub mod library;
pub mod look_alikes;
pub mod map_toml;
pub mod materials_toml;
pub mod measured_profile;
pub mod named_table;
mod own_json;
mod pair_columns;
pub mod panel_labels;
pub mod picture;
mod place_origin;
pub mod placed_space;
pub mod places_csv;
pub mod profile_csv;
pub mod project;
pub mod quality_model;
pub mod ratings_csv;
pub mod recording;
pub mod rig_settings;
pub mod settings;
pub mod signal;
pub mod sorting_csv;
pub mod space_report;
pub mod starter;
pub mod stroke;
pub mod stroke_csv;
pub mod svc;
pub mod thresholds;
pub mod wav;
