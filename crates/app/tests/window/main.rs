//! Tests of the window through accessible names, the pointer, keys, and the output signal. They form one binary, which
//! is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")]

mod support;

mod author;
mod authored;
mod build;
mod devices;
mod field;
mod help;
mod images;
mod import;
mod libraries;
mod paths;
mod projects;
mod prompts;
mod rig;
mod scope;
mod signals;
mod strokes;
mod textures;
