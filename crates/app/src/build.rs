//! The workspace Build: what people sorted and rated becomes a space.
//!
//! On the left what the space is made of and how, in the middle the figures that papers print, on the right how far it
//! can be believed, and the button that puts it to use. Building runs in a thread of its own; the window goes on.

mod figures_ui;
mod input_ui;
mod job;
pub mod judgments;
mod options_ui;
pub mod page;
mod panel_truth;
mod verdict_ui;
