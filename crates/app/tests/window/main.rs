//! Tests of the window through accessible names, the pointer, keys, and the output signal. They form one binary, which
//! is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")]

mod frame;
mod support;
mod views;

mod accessibility;
mod author;
mod authored;
mod build;
mod clipboard;
mod devices;
mod exports;
mod field;
mod gallery;
mod help;
mod images;
mod import;
mod layouts;
mod libraries;
mod menus;
mod motion;
mod outside_library;
mod paths;
mod projects;
mod prompts;
mod rig;
mod scope;
mod screenshots;
mod shape;
mod signals;
mod strokes;
mod textures;
mod tooltips;
mod tour;
