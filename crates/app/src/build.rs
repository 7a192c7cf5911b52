//! The Build workspace: builds a space from sorting and rating data.
//!
//! The left column holds the data and options, the middle the figures printed in papers. The right column holds the
//! validation summary and the button that uses the space. A background thread builds the space, so that the window
//! stays responsive.

mod figures_ui;
mod input_ui;
mod job;
pub mod judgments;
mod options_ui;
pub mod page;
mod validation_ui;
