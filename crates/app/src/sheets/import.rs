//! Import of dropped or named files as textures of the library.
//!
//! A worker reads the files and fits textures. The sheet shows them as a [`batch::Batch`] and asks for missing
//! information. No texture is added to the library before the user accepts it.

pub mod batch;
mod directional_folder;
mod draft;
mod draft_ui;
mod files_ui;
mod fit_ui;
pub mod import_context;
mod model_ui;
mod plane_plot;
mod questions_ui;
pub mod recording_state;
pub mod sheet;
mod shown_model;
mod trace;
mod trace_plot;
pub mod worker;
