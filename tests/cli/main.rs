//! Tests of the command line: the real program in temporary folders. They form one test program, which is linked once.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and prints what it skips"
)]

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[path = "../support/disk_faults.rs"]
mod disk_faults;
#[path = "../support/mod.rs"]
mod support;

mod author;
mod axes;
mod bad_files;
mod batch;
mod bundle;
mod clips;
mod devices;
mod doctor;
mod errors;
mod evaluate;
mod export_models;
mod export_signals;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod faults;
#[cfg(target_os = "linux")]
mod full_disk;
mod guide;
mod haptic_pen;
mod height_map;
mod hostile;
mod import;
mod import_directional;
mod labelled_photos;
mod learn;
mod library;
mod photo_and_words;
mod play;
mod prediction_figures;
mod progress;
mod project;
mod prompts;
mod quality_fit;
mod render;
mod reproduce;
mod shape;
mod signals;
mod space;
mod space_ratings;
mod starter;
mod study;
mod train_networks;
