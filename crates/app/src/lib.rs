//! The window of Shagreen.
//!
//! # Conventions
//!
//! - Panels read a [`panel::Panel`] and return [`command::Command`]s; they change nothing but their own view state.
//! - The project changes only by an [`project::Edit`], so that undo restores it exactly.
//! - A place says its space: `pos_in_space` or a [`shagreen_core::space::SpacePoint`] against `Pos2` of the screen.
//! - Every control has an accessible name; every word stands in [`strings`]; every color in [`theme`].
#![forbid(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect"))]

use anyhow::anyhow;
use shagreen_formats::library::Library;

pub mod axes;
pub mod canvas;
pub mod command;
pub mod history;
pub mod inspector;
pub mod library_panel;
pub mod pad;
pub mod panel;
pub mod pictures;
pub mod project;
pub mod scope;
pub mod scope_buffer;
pub mod session;
pub mod status_bar;
pub mod strings;
pub mod theme;
pub mod window;

/// How the window starts.
#[derive(Clone, Debug)]
pub struct Start {
    /// The textures to author from.
    pub library: Library,
    /// Identity of the output to open; `None` opens none.
    pub output: Option<String>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, the graphics cannot be started, or the library makes no space.
pub fn run(start: Start) -> anyhow::Result<()> {
    let viewport = egui::ViewportBuilder::default()
        .with_title(strings::APP)
        .with_app_id("shagreen")
        .with_inner_size([1280.0, 720.0])
        .with_min_inner_size([960.0, 600.0])
        .with_position([0.0, 0.0]);
    let options =
        eframe::NativeOptions { viewport, system_font_fallback: false, ..eframe::NativeOptions::default() };
    eframe::run_native(
        strings::APP,
        options,
        Box::new(move |creation| {
            let window = window::Window::new(&creation.egui_ctx, start.library, start.output.as_deref())?;
            Ok(Box::new(window))
        }),
    )
    .map_err(|error| anyhow!("the window could not be opened: {error}"))
}
