//! Readers and writers for the files of Shagreen: texture libraries, recordings, strokes, signals, actuator profiles
//! and reports.
//!
//! # Conventions
//!
//! - A reader takes bytes and returns a value of this crate or of `shagreen-core`, checked by the constructors of core.
//!   It returns one error otherwise, which says what is wrong and what to do. The error names the place in the file;
//!   the caller that opened the file adds its path.
//! - An imperfection that leaves the data usable is a warning in [`imported::Imported`], not an error.
//! - Types whose names end in `V1` define a file format. Files use mm/s, N and mm; values in memory use SI units.
//! - Only [`atomic`] writes files, and it writes each file completely or not at all. The exception is the log of a session
//!   ([`study_log`]), which grows by whole lines and is never shortened.
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
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")
)]

pub mod acf;
pub mod actuator_toml;
pub mod ahap;
pub mod android_envelope;
pub mod atomic;
pub mod attribute_table;
pub mod axes_report;
pub mod axis_sources;
pub mod batch_manifest;
pub mod batch_record;
pub mod bounded_file;
pub mod built_in;
pub mod bundle;
pub mod calibration_report;
pub mod clip;
pub mod clip_head;
pub mod clip_scale;
pub mod codec_stream;
pub mod codec_tables;
pub mod csv_text;
pub mod evaluation_part;
pub mod evaluation_report;
pub mod figure;
pub mod first_faults;
pub mod fit_report;
pub mod foreign_file;
mod foreign_json;
pub mod gallery;
pub mod haptic_clip;
pub mod haptic_maps;
pub mod hatt;
pub mod height_picture;
pub mod hid_text;
pub mod hjif;
pub mod imported;
mod json5;
mod judgment_columns;
mod label_source_text;
mod layout;
pub mod left_out_prediction;
pub mod lexicon_toml;
pub mod library;
pub mod locked_update;
pub mod map_toml;
pub mod materials_toml;
pub mod measured_profile;
pub mod named_point;
pub mod named_table;
pub mod openxr_parametric;
mod own_json;
mod pair_columns;
mod parser_words;
mod path_json;
pub mod photo_networks;
pub mod photo_table;
pub mod picture;
pub mod placed_space;
pub mod places_csv;
pub mod prediction_report;
pub mod printed_results;
pub mod profile_csv;
pub mod project;
pub mod quality_model;
pub mod questionnaire;
pub mod rated_pairs_csv;
pub mod ratings_csv;
pub mod recording;
pub mod reproduction_report;
pub mod rig_settings;
pub mod runtime_table;
pub mod settings;
pub mod signal;
pub mod signal_description;
pub mod similar_names;
pub mod simulated_rater_labels;
pub mod sorting_csv;
pub mod space_report;
pub mod starter;
pub mod stroke;
pub mod stroke_csv;
pub mod study_log;
pub mod study_plan;
pub mod study_tables;
pub mod svc;
pub mod text_limits;
pub mod texture_files;
mod texture_parts;
pub mod thresholds;
pub mod toml_lines;
mod toml_text;
pub mod wav;
pub mod wav_encoding;
