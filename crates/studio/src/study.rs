//! Studies with people: plans, sessions, simulated participants, analysis and power.
//!
//! A study is a plan file ([`plans`]) and a folder of logs, one for each participant ([`logs`]). A [`session`] asks the
//! trials of one participant and keeps every answer on the disk before the next trial. [`stimuli`] makes what
//! participants feel. [`simulation`] answers in the place of people, [`analysis`] computes the results of the logs, and
//! [`power`] estimates how many participants a plan needs.
//!
//! `core::people::study` decides what comes next and what follows from the answers; this module reads and writes the files.
//! Results of simulated participants are never mixed with those of people.

pub mod analysis;
pub mod logs;
pub mod new_plan;
pub mod plans;
pub mod power;
mod presented;
pub mod preview;
pub mod session;
pub mod simulation;
pub mod stimuli;
pub mod textures;

use crate::about::VERSION;

/// Name and version of the program, for the files of a study.
fn program() -> String {
    format!("shagreen {VERSION}")
}
