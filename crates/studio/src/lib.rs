//! The functions of the program that the window and the command line share.
//!
//! # Conventions
//!
//! - Each function opens no window, parses no arguments and prints nothing.
//! - Warnings and notes go to a [`report::Reporter`]. Long work takes a closure that receives its progress and returns
//!   whether to continue.
//! - Errors are [`anyhow::Error`]s with the file as a separate context ([`file::in_file`]).
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")
)]

pub mod about;
pub mod added_places;
pub mod attribute_prediction;
pub mod authoring;
pub mod axes;
pub mod batch;
pub mod blend_options;
pub mod bundle;
pub mod check;
pub mod doctor;
pub mod driven_channels;
pub mod evaluation;
pub mod export;
pub mod felt;
pub mod figure_files;
pub mod file;
pub mod generate;
pub mod guide;
pub mod height_map;
pub mod import;
pub mod judgments;
pub mod levels;
pub mod library;
pub mod library_names;
pub mod method_predictions;
pub mod models;
pub mod near_names;
pub mod open;
pub mod parallel;
pub mod pen_backends;
pub mod permitted_libraries;
pub mod photo_predictor;
pub mod picture_predictions;
pub mod place_estimate;
pub mod points;
pub mod project;
pub mod quality_fit;
pub mod quality_model;
pub mod questionnaire;
pub mod render;
pub mod replace;
pub mod report;
pub mod reproduce;
pub mod seen_materials;
pub mod short_text;
pub mod signal_quality;
pub mod silence;
pub mod sound;
pub mod sound_entry;
pub mod sound_render;
pub mod sound_sidecar;
pub mod space;
pub mod stroke_contacts;
pub mod study;
pub mod tap_transients;
pub mod texture_difference;
pub mod trace;
pub mod training_strokes;
pub mod weighted_blend;
