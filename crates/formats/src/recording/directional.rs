//! Folders of strokes in several directions, with one table for each stroke and quantity.
//!
//! The name of each file states its stroke: `{texture}_{direction}_{speed in mm/s}_{force in mN}_{repeat}`. The folder of
//! the file, or a word at the beginning or end of its name, states the quantity: acceleration (`time,X,Y,Z` in s and g),
//! force (`time,force` in s and N) or position (`time,X,Y` in s and mm). A header may state other units; without a
//! header, the columns have this order. This is the layout of the Cluster Haptic Texture Dataset.
//!
//! A stroke needs its acceleration. Without a force or position file, the force or speed of the name is used.

mod direction;
mod folder;
mod name;
mod quantity_table;
mod slow_track;
mod stroke;

pub use crate::recording::directional::direction::{NamedDirections, mean_direction_rad, name_directions};
pub use crate::recording::directional::folder::{
    StrokeFiles, StrokeFolder, StrokeFolderError, TextureStrokes, find_strokes, unused_others,
};
pub use crate::recording::directional::name::{Quantity, StrokeName};
pub use crate::recording::directional::stroke::{DirectionalStroke, StrokeBytes, StrokeError, read_stroke};

#[cfg(test)]
mod tests;
