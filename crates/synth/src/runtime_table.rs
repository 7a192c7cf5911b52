//! Runtime table (`.shgt`): a prepared texture as bytes, for programs that render it without the authoring tool.
//!
//! This module is the definition of the format. All numbers are little-endian.
//!
//! | bytes | content |
//! |---|---|
//! | 0 to 3 | `SHGT` |
//! | 4 and 5, 6 and 7 | major and minor version |
//! | 8 to 11 | length of the table in bytes |
//! | from 12 on | sections: four letters, the length of the content in bytes (`u32`), the content |
//! | last 4 | CRC-32 (ISO-HDLC) of all bytes before |
//!
//! | section | content |
//! |---|---|
//! | `HEAD` | model rate in Hz, highest speed in m/s, highest force in N, rotation in rad (`f32` each); order of the predictor, 1 to 64, order of the moving average, 0 to 32 (`u16` each); flags (`u32`), of which the lowest bit forbids redistribution |
//! | `NODE` | for each node across the lay: level in m/s², and as many line spectral frequencies in rad as the predictor has orders (`f32`) |
//! | `TRIA` | for each triangle across the lay: indices of its nodes, indices of its neighbors (three `u16` each), weights, logarithmic gains (six `f32` each), as in [`Triangle`](crate::texture::Triangle) |
//! | `EXCI` | for each node of a published model: variance in (m/s²)², gain, frequencies of the moving average in rad (`f32`) |
//! | `NODL`, `TRIL` | nodes and triangles along the lay, of a texture that has one |
//! | `RELI` | step in m, reference force in N (`f32`), samples of octave 0 (`u32`), all octaves in m/s² (`f32`) |
//! | `HMAP` | side in m (`f64`), reference force in N, speed exponent (`f32`), samples along a side (`u32`), coefficients in m (`f32`) |
//! | `FRIC` | kinetic coefficient, static ratio, Stribeck speed in m/s (`f32`) |
//! | `TAPS` | frequency in Hz, decay in 1/s and amplitude in m/s² of the tap transient (`f32`) |
//! | `NAME`, `TERM`, `ORIG`, `MADE` | name, terms of use, origin, program that wrote the table: UTF-8 without NUL |
//!
//! `HEAD`, `NODE` and `TRIA` are required. A section that is absent means that the texture lacks the property. No section
//! occurs twice, and their order is free. A reader skips unknown sections, and the end of a `HEAD`, `FRIC` or `TAPS` that is
//! longer than stated here: a minor version may add either. It refuses another major version.

mod fields;
mod head;
mod read;
mod sections;
mod write;

use crate::height_map::HeightMapError;
use crate::relief::ReliefError;
use crate::tap::Tap;
use crate::texture::{Parts, TextureError};

pub use crate::runtime_table::head::{Arrays, Head, Lengths};
pub use crate::runtime_table::read::{Memory, Table};
pub use crate::runtime_table::write::write;

/// First bytes of every table.
pub const MAGIC: [u8; 4] = *b"SHGT";
/// Major and minor version that this module writes.
pub const VERSION: [u16; 2] = [1, 0];

/// Reasons why bytes are no table, or a texture cannot be one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// The bytes do not begin like a table.
    Foreign,
    /// The major version is unknown.
    Version,
    /// The number of bytes is not the stated length, or a table would be longer than 4 GiB.
    Length,
    /// The checksum differs.
    Checksum,
    /// A section is missing, occurs twice, or has a length that its content cannot have.
    Section,
    /// A text is not UTF-8, or contains a NUL.
    Text,
    /// A value of the tap transient is negative or not finite.
    Tap,
    /// The memory for the arrays is shorter than [`Table::lengths`].
    Memory,
    /// The nodes, triangles or numbers form no valid texture.
    Texture(TextureError),
    /// The relief is invalid.
    Relief(ReliefError),
    /// The height map is invalid.
    HeightMap(HeightMapError),
}

impl TableError {
    /// Returns one sentence: what is wrong, and what to do.
    pub fn text(self) -> &'static str {
        match self {
            Self::Foreign => "this is not a runtime table; export one from Shagreen",
            Self::Version => {
                "the runtime table has a newer version than this runtime reads; use a newer runtime, or export the table again"
            }
            Self::Length => "the runtime table is incomplete or has extra bytes; copy or export it again",
            Self::Checksum => "the runtime table is damaged (its checksum differs); copy or export it again",
            Self::Section => {
                "a section of the runtime table is missing, repeated or cut off; export it again"
            }
            Self::Text => "a text of the runtime table is not UTF-8 or contains a zero byte; export it again",
            Self::Tap => {
                "the tap transient is negative or not finite; correct the texture and export it again"
            }
            Self::Memory => "the memory for the texture is too small; give as much as the table states",
            Self::Texture(_) => {
                "the numbers of the texture are invalid; correct the texture and export it again"
            }
            Self::Relief(_) => {
                "the relief of the texture is invalid; correct it and export the texture again"
            }
            Self::HeightMap(_) => {
                "the height map of the texture is invalid; correct it and export the texture again"
            }
        }
    }
}

/// Words about a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct About<'a> {
    /// Name of the texture.
    pub name: &'a str,
    /// Terms of use; empty if they are not known.
    pub terms: &'a str,
    /// Where the texture comes from; empty if that is not known.
    pub origin: &'a str,
    /// Program that wrote the table, with its version.
    pub created_by: &'a str,
    /// Whether the texture must not be redistributed.
    pub is_restricted: bool,
}

/// All that a table contains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content<'a> {
    /// Data of the texture.
    pub parts: Parts<'a>,
    /// Tap transient at [`crate::tap::REFERENCE_IMPACT_MPS`], if the texture has one.
    pub tap: Option<Tap>,
    /// Words about the texture.
    pub about: About<'a>,
}

/// Returns whether a text can be stored: programs in C end it by a NUL.
fn is_storable(text: &str) -> bool {
    !text.bytes().any(|byte| byte == 0)
}

/// Returns whether a tap transient can be stored.
fn is_valid(tap: Tap) -> bool {
    let Tap { frequency_hz, decay_per_sec, amplitude_mps2 } = tap;
    [frequency_hz, decay_per_sec, amplitude_mps2].iter().all(|x| x.is_finite() && *x >= 0.0)
}

#[cfg(test)]
mod tests;
