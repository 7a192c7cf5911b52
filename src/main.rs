//! Shagreen: an authoring tool for haptic textures. Without a subcommand it opens the window.
#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")
)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
