//! The Studies workspace: experiments with people, from the plan to the results.
//!
//! The left column holds the plan, the middle its preview, its results, or the calibration of the screen. The right column
//! holds the devices and the sessions. A session runs over the whole window (room `runner`).

mod log_folder;
mod open_study;
pub mod page;
mod results;
pub(crate) mod runner;
mod sessions;
