//! The window of Shagreen.
//!
//! # Conventions
//!
//! - Panels read a [`panel::Panel`] and return [`command::Command`]s; they change nothing but their own view state.
//! - The project changes only by an [`edit::Edit`], so that undo restores it exactly.
//! - A place says its space: `pos_in_space` or a [`shagreen_core::space::SpacePoint`] against `Pos2` of the screen.
//! - Every control has an accessible name; every word stands in [`strings`]; every color in [`theme`].
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Instant;

use anyhow::anyhow;
use shagreen_formats::project::Project;

use crate::files::Keeping;
use crate::session::OutputChoice;

mod authored_panel;
pub mod axes;
mod axes_choice;
mod background;
pub mod blend_choice;
pub mod build;
pub mod canvas;
mod chart_ui;
pub mod command;
pub mod compare;
mod compare_ui;
mod details;
pub mod devices;
pub mod document;
mod drag;
pub mod edit;
mod figure_ui;
mod file_menu;
pub mod files;
mod filter_menu;
mod gallery_sheet;
pub mod heat_map;
pub mod history;
pub mod import;
pub mod inspector;
mod kept_path;
mod label_places;
mod leaving;
pub mod libraries;
pub mod library_filter;
pub mod library_panel;
mod locks;
mod map_plot;
pub mod models;
mod open_sheet;
pub mod pad;
pub mod panel;
mod photo;
pub mod pictures;
mod plot;
pub mod prompt;
pub mod recorded_stroke;
mod recorder;
mod recovered_ui;
pub mod recovery;
pub mod rig;
mod rig_memory;
pub mod save;
mod scale;
pub mod scope;
pub mod scope_buffer;
pub mod session;
mod settings_file;
mod sheet_frame;
mod sheets;
mod shortcuts_ui;
pub mod signals;
mod solo;
pub mod status_bar;
mod stopwatch;
pub mod strings;
mod texture_menu;
mod texture_row;
mod texture_sheet;
pub mod theme;
pub mod tour;
pub mod window;
pub mod workspace;

/// What the window opens with.
#[derive(Clone, Debug)]
pub struct Begin {
    /// What somebody makes.
    pub project: Project,
    /// The file that it was read from.
    pub path: Option<PathBuf>,
    /// The output to open.
    pub output: OutputChoice,
    /// Where the program keeps what outlives it.
    pub keeping: Keeping,
}

/// How the window starts.
#[derive(Clone, Debug)]
pub struct Start {
    /// What the window opens with.
    pub begin: Begin,
    /// Measure this many frames with the hand stroking and the scope running, then close; `None` stays open.
    pub measured_frames: Option<usize>,
    /// When the program started: what the first frame is timed from.
    pub started: Instant,
}

/// How fast the window was, where it was asked to measure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WindowTimes {
    /// From the start of the program until the first frame has been handed to the screen, in seconds.
    pub first_frame_secs: f64,
    /// Time that each later frame took to lay out, in seconds; painting comes on top.
    pub frame_secs: Vec<f64>,
    /// Time from each later frame to the next, in seconds.
    pub interval_secs: Vec<f64>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, the graphics cannot be started, or the library makes no space.
pub fn run(start: Start) -> anyhow::Result<WindowTimes> {
    let viewport = egui::ViewportBuilder::default()
        .with_title(strings::APP)
        .with_app_id("shagreen")
        .with_inner_size([1280.0, 720.0])
        .with_min_inner_size([960.0, 600.0]);
    let options =
        eframe::NativeOptions { viewport, system_font_fallback: false, ..eframe::NativeOptions::default() };
    let times = Rc::new(RefCell::new(WindowTimes::default()));
    let measured = Rc::clone(&times);
    eframe::run_native(
        strings::APP,
        options,
        Box::new(move |creation| {
            let window = window::Window::new(&creation.egui_ctx, start.begin)?;
            Ok(Box::new(stopwatch::Stopwatch::new(window, start.started, start.measured_frames, measured)))
        }),
    )
    .map_err(|error| anyhow!("the window could not be opened: {error}"))?;
    Ok(times.take())
}
