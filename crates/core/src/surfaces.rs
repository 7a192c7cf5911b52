//! Surfaces: materials, their contact physics and appearance, and the words and pictures that describe them.
//!
//! In: material parameters, a prompt or a picture. Out: height fields, simulated strokes, pictures, textures of the
//! starter library ([`starter`]), and attributes predicted from words or pictures ([`prompt`], [`generated`]).

pub mod contact_model;
pub mod felt_material;
pub mod generated;
pub mod height_field;
pub mod material;
pub mod photo_variation;
pub mod picture_doubts;
pub mod picture_features;
pub mod prompt;
pub mod prompt_material;
pub mod quilt;
pub mod random_material;
pub mod random_touch;
pub mod shading;
pub mod starter;
pub mod stroked_grain;
pub mod touch_words;
