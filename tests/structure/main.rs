//! Checks of the code's structure: dependencies between crates, layers of `core`, import cycles, unsafe code, and the files
//! of packages.

#![allow(clippy::expect_used, reason = "a test may panic on an unexpected result")]

mod crates;
mod cycles;
mod file_reads;
mod packages;
mod rooms;
mod source_tree;
mod unsafe_code;
