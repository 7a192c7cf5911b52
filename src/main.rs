//! Shagreen: an authoring tool for haptic textures. Without a subcommand it opens the window.
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")
)]

mod cli;
mod window;

fn main() -> std::process::ExitCode {
    cli::run(window::open)
}
