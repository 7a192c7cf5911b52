//! The window, used as a person would: controls found by name, pointer and keys, what is heard and seen. One program of
//! tests, which is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")]

mod support;

mod author;
mod authored;
mod build;
mod devices;
mod field;
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
