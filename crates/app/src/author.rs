//! The Author workspace: canvas of the space, texture list, inspector, stroke pad, scope and prompt.
//!
//! Input: a [`Panel`](crate::panel::Panel). Output: [`Command`](crate::command::Command)s.

pub(crate) mod authored_menu;
pub(crate) mod authored_panel;
pub(crate) mod axis_sliders;
pub mod blend_choice;
pub mod canvas;
pub(crate) mod compare_ui;
pub(crate) mod context_menu;
pub(crate) mod details;
pub(crate) mod exact;
pub(crate) mod filter_menu;
pub mod inspector;
pub mod library_filter;
pub mod library_panel;
pub(crate) mod locks;
pub(crate) mod lost_pins;
pub(crate) mod new_texture;
pub mod pad;
pub mod prompt;
pub(crate) mod renamed_row;
pub mod scope;
pub(crate) mod shape_ui;
pub(crate) mod solo;
pub(crate) mod texture_drag;
pub(crate) mod texture_menu;
pub(crate) mod texture_picture;
pub(crate) mod texture_row;
pub(crate) mod texture_sheet;
pub(crate) mod whole_space;
