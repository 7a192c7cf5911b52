//! The command line from outside: the real program, in folders of its own. One program of tests, which is linked once.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may stop at what it did not expect, and says what it skips"
)]

#[path = "../support/mod.rs"]
mod support;

mod author;
mod devices;
mod errors;
mod evaluate;
mod import;
mod learn;
mod library;
mod play;
mod project;
mod render;
mod signals;
mod space;
mod starter;
