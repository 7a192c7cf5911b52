//! State of the window without its panels: the project and its edits, files, recovery, the device setup, and
//! recordings.
//!
//! In: edits, files and device reports. Out: values that panels read.

pub(crate) mod audible_texture;
pub mod axes_change;
pub(crate) mod background;
pub mod bench_signal;
pub(crate) mod blank_file;
pub mod clipboard;
pub mod compare;
pub mod conflict;
pub(crate) mod course;
pub(crate) mod desktop_motion;
pub mod document;
pub mod edit;
pub(crate) mod figure_file;
pub mod files;
pub(crate) mod gallery_pictures;
pub mod heat_map;
pub mod history;
pub(crate) mod leave;
pub(crate) mod lost_coordinates;
pub(crate) mod mouse_report;
mod moved_points;
pub(crate) mod own_surface;
pub(crate) mod pad_surface;
pub(crate) mod photo;
pub mod pictures;
pub mod recorded_stroke;
pub(crate) mod recorder;
pub mod recovery;
pub mod rig;
pub(crate) mod rig_memory;
pub mod scope_buffer;
pub(crate) mod settings_file;
pub(crate) mod signal_file;
pub(crate) mod source;
pub(crate) mod stroke_file;
