//! Errors of pictures.

use image::ImageError;

use super::SAFE_PHOTO_SIDE;
#[cfg(doc)]
use super::{MAX_PHOTO_SIDE, MAX_SIDE};
use crate::foreign_file::Found;

/// Words for a variant of a format that is not read and has no name of its own here.
pub(super) const VARIANT: &str = "a rare variant of its format";

/// Why a picture cannot be encoded or decoded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The number of bytes does not match the size, or the size is outside 1 to [`MAX_SIDE`].
    #[error(
        "a picture of {width} x {height} pixels cannot have {n_bytes} bytes of color; correct its size or its data"
    )]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Number of bytes given.
        n_bytes: usize,
    },
    /// The compressed picture has another size than its file states.
    #[error(
        "the picture is {found_width} x {found_height} pixels, but the library states {width} x {height}; correct the stated size or replace the picture"
    )]
    Mismatch {
        /// Width in pixels, as stated.
        width: u32,
        /// Height in pixels, as stated.
        height: u32,
        /// Width in pixels, of the picture.
        found_width: u32,
        /// Height in pixels, of the picture.
        found_height: u32,
    },
    /// Decoding would take too much memory for a picture of this file size.
    #[error(
        "the picture is {width} x {height} pixels in {n_bytes} bytes, too large to decode; use a smaller picture"
    )]
    TooLarge {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Number of compressed bytes.
        n_bytes: usize,
    },
    /// The requested row does not exist.
    #[error("the picture has rows 0 to {}, but row {row} was requested; choose a row in this range", .rows - 1)]
    Row {
        /// The requested row.
        row: u32,
        /// Number of rows.
        rows: u32,
    },
    /// The bytes are in no format of photos that is read.
    #[error("{}", .found.instead_of_photo())]
    NoPhoto {
        /// Content of the file.
        found: Found,
    },
    /// A photo whose format is read, but not this variant of it.
    #[error("the photo uses {what}, which cannot be read; save it as PNG, in gray or RGB")]
    Unsupported {
        /// What the file uses.
        what: &'static str,
    },
    /// A picture of heights with places that were not measured.
    #[error(
        "the picture has numbers that are no measurements (NaN, infinite, or beyond 1e30); fill these gaps, and save it again"
    )]
    Gaps,
    /// A photo with a side above [`MAX_PHOTO_SIDE`] pixels, or above 1 GiB when decoded.
    #[error(
        "the photo is too large; scale it to at most {SAFE_PHOTO_SIDE} pixels per side, with 8 bits per color channel"
    )]
    LargePhoto,
    /// A photo that ends before its last row.
    #[error("the photo is truncated; get a complete copy")]
    CutOff,
    /// The compressed bytes are damaged.
    #[error("the picture is damaged; replace it")]
    Codec(ImageError),
}

/// The decoder's words are not a cause to show: they name its own types.
impl From<ImageError> for PictureError {
    fn from(error: ImageError) -> Self {
        Self::Codec(error)
    }
}
