//! Appearance of the window: colors and sizes, charts, plots, labels and the frame of a sheet.
//!
//! Input: values and text. Output: egui shapes. Nothing here depends on a project.

pub mod axes;
pub(crate) mod border;
pub(crate) mod chart_ui;
pub(crate) mod color_bar;
pub(crate) mod drag;
pub mod icon;
pub(crate) mod icons;
pub(crate) mod label_places;
pub(crate) mod list;
pub(crate) mod map_plot;
pub(crate) mod menu_checkbox;
pub(crate) mod motion;
pub(crate) mod notice;
pub(crate) mod plot;
pub(crate) mod primary;
pub(crate) mod scale;
pub(crate) mod scroll_to_focus;
pub(crate) mod sheet_frame;
pub(crate) mod spectrum_plot;
pub(crate) mod text_selection;
pub mod theme;
pub(crate) mod together;
pub(crate) mod tooltips;
