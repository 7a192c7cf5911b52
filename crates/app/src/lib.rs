//! Window of Shagreen.
//!
//! # Conventions
//!
//! - Panels read a [`panel::Panel`] and return [`command::Command`]s. They change nothing but their own view state.
//! - The project changes only through a [`state::edit::Edit`], so that undo restores it exactly.
//! - A position in the space is a [`shagreen_core::space::SpacePoint`], a position on the screen a `Pos2`.
//! - Every control has an accessible name. All texts are in [`strings`], all colors in [`look::theme`].
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")
)]

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Instant;

pub use crate::window::{Begin, WindowTimes};

pub mod author;
mod browse;
pub mod build;
pub mod choices;
pub mod command;
mod display;
mod figure_ui;
pub mod look;
pub mod panel;
pub mod session;
pub mod sheets;
pub mod signals;
pub mod state;
pub mod strings;
pub mod studies;
pub mod window;
pub mod workspace;

/// Side of the icon of the window in pixels. The system scales it for its lists.
const ICON_SIDE: usize = 128;

/// Options of a run.
#[derive(Clone, Debug)]
pub struct Start {
    /// Initial content of the window.
    pub begin: Begin,
    /// Number of frames to measure with the automatic stroke and the scope running; the window then closes. With `None`
    /// it stays open.
    pub measured_frames: Option<usize>,
    /// Whether to open the window on the X11 display although the environment names a Wayland display (Linux).
    pub is_on_x11: bool,
    /// Start time of the program, from which the first frame is timed.
    pub started: Instant,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, the graphics cannot be started, or the positions of the library do not form a space.
pub fn run(start: Start) -> anyhow::Result<WindowTimes> {
    let viewport = egui::ViewportBuilder::default()
        .with_title(strings::APP)
        .with_icon(look::icon::icon(ICON_SIDE))
        .with_app_id("shagreen")
        .with_inner_size([1280.0, 720.0])
        .with_min_inner_size([960.0, 600.0]);
    let options = eframe::NativeOptions {
        viewport,
        system_font_fallback: true,
        event_loop_builder: display::builder_hook(start.is_on_x11),
        ..eframe::NativeOptions::default()
    };
    let times = Rc::new(RefCell::new(WindowTimes::default()));
    let measured = Rc::clone(&times);
    eframe::run_native(
        strings::APP,
        options,
        Box::new(move |creation| {
            browse::allow_dialogs(&creation.egui_ctx);
            let window = window::Window::new(&creation.egui_ctx, start.begin)?;
            Ok(Box::new(window::stopwatch::Stopwatch::new(
                window,
                start.started,
                start.measured_frames,
                measured,
            )))
        }),
    )
    .map_err(|error| display::not_opened(&error))?;
    Ok(times.take())
}
