//! Import: files that were dropped or named become textures of the library.
//!
//! Files are read and textures fitted by a worker; the sheet shows a [`batch::Batch`] of them and asks what
//! they do not say. Nothing joins the library before the user accepts it.

pub mod batch;
mod draft;
mod draft_ui;
mod estimate;
mod files_ui;
mod fit_ui;
mod model_ui;
mod plane_plot;
mod questions_ui;
pub mod recording_state;
pub mod sheet;
pub mod source;
pub(crate) mod spectrum_plot;
mod trace;
mod trace_plot;
pub mod worker;
