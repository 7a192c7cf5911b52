//! Tests of the window through accessible names, the pointer, keys, and the output signal. They form one binary, which
//! is linked once.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic on an unexpected result")]

mod frame;
mod support;
mod views;

mod about;
mod accessibility;
mod audible;
mod author;
mod authored;
mod axes;
mod build;
mod canvas_words;
mod clipboard;
mod devices;
mod dialogs;
mod exports;
mod field;
mod first_use;
mod gallery;
mod help;
mod images;
mod import;
mod inspector;
mod layouts;
mod libraries;
mod listening;
mod menus;
mod motion;
mod networks;
mod opening;
mod outside_library;
mod paths;
mod photos;
mod projects;
mod prompts;
mod reliefs;
mod rig;
mod scope;
mod screenshots;
mod seen_materials;
mod shape;
mod signals;
mod strokes;
mod studies;
mod textures;
mod tooltips;
mod tour;
