//! Photos and pictures of heights: files of other programs in several formats, decoded and upright.

use std::io::{Cursor, ErrorKind};

use image::metadata::Orientation;
use image::{DynamicImage, GrayImage, ImageDecoder as _, ImageError, ImageFormat, ImageReader};

use super::error::{PictureError, VARIANT};
use super::photo_limits::{MAX_PHOTO_BYTES, check_memory};
use super::png_chunks::without_large_texts;
use super::tiff_photo::{TiffPhoto, tiff_photo};
use super::webp_chunks::webp_orientation;
use super::{MAX_PHOTO_SIDE, Picture, Rgb, encode_jpeg};
use crate::foreign_file::Found;

/// Endings of the names of photos in lower case, without the dot.
pub const PHOTO_ENDINGS: [&str; 7] = ["jpg", "jpeg", "png", "webp", "bmp", "tif", "tiff"];

/// Maximum side of the picture made from a photo, in pixels.
pub const PHOTO_SIDE: u32 = 768;

/// Memory in bytes per pixel that the decoder of WebP takes beside the decoded picture: a frame and a canvas, both with
/// transparency.
const WEBP_BYTES_BESIDE: u64 = 8;

/// Brightness of the pixels of a photo or a height map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Brightness {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// 0 (black) to 65,535 (white), row by row from the upper left.
    pub values: Vec<u16>,
    /// Whether the file stores colors, as photos do, and not gray values.
    pub is_colored: bool,
    /// Whether black and white are the lowest and the highest number in the file, because numbers of this type have no
    /// black and white of their own: a TIFF with floating-point numbers, signed numbers or more than 16 bits.
    pub is_stretched: bool,
}

/// A decoded photo.
struct Decoded {
    photo: DynamicImage,
    /// See [`Brightness::is_stretched`].
    is_stretched: bool,
}

/// Converts a photo of any size to a picture: upright, and scaled to at most [`PHOTO_SIDE`]. `millimeters` is the width
/// of the surface patch.
///
/// Formats are JPEG, PNG, WebP (of an animation, the first frame), BMP and TIFF (the first page).
///
/// # Errors
/// [`PictureError::NoPhoto`] for another format, [`PictureError::Unsupported`] for a variant that is not read,
/// [`PictureError::LargePhoto`] above [`MAX_PHOTO_SIDE`] pixels per side or 1 GiB of memory, [`PictureError::TooLarge`]
/// for a small file that states a huge picture, [`PictureError::CutOff`] and [`PictureError::Codec`] for damaged bytes.
pub fn of_photo(bytes: &[u8], millimeters: f64) -> Result<Picture, PictureError> {
    encode_jpeg(&photo_pixels(bytes)?, millimeters)
}

/// Returns the pixels of a photo as [`of_photo`] does, before compression.
///
/// # Errors
/// As [`of_photo`].
pub fn photo_pixels(bytes: &[u8]) -> Result<Rgb, PictureError> {
    let mut photo = upright(bytes)?.photo;
    if photo.width().max(photo.height()) > PHOTO_SIDE {
        photo = photo.thumbnail(PHOTO_SIDE, PHOTO_SIDE);
    }
    let rgb = photo.into_rgb8();
    Ok(Rgb { width: rgb.width(), height: rgb.height(), pixels: rgb.into_raw() })
}

/// Returns the brightness along one row of a photo or a height map, 0 (black) to 1, per pixel. The resolution is that
/// of the file, up to 16 bits. Row 0 is the top row; `None` selects the middle row.
///
/// # Errors
/// As [`of_photo`], and [`PictureError::Row`] if the row does not exist.
pub fn brightness_row(bytes: &[u8], row: Option<u32>) -> Result<Vec<f64>, PictureError> {
    let photo = upright(bytes)?.photo.into_luma16();
    let rows = photo.height();
    let row = row.unwrap_or(rows / 2);
    if row >= rows {
        return Err(PictureError::Row { row, rows });
    }
    let pixel = |x: u32| f64::from(photo.get_pixel(x, row).0[0]) / f64::from(u16::MAX);
    Ok((0..photo.width()).map(pixel).collect())
}

/// Returns the brightness of all pixels of a photo or a height map, upright, with the resolution of the file up to 16
/// bits, and its colors if the file stores colors.
///
/// # Errors
/// As [`of_photo`].
pub fn brightness_and_colors(bytes: &[u8]) -> Result<(Brightness, Option<Rgb>), PictureError> {
    let Decoded { photo, is_stretched } = upright(bytes)?;
    let (gray, colors) = if photo.color().has_color() {
        let gray = photo.to_luma16();
        let rgb = photo.into_rgb8();
        (gray, Some(Rgb { width: rgb.width(), height: rgb.height(), pixels: rgb.into_raw() }))
    } else {
        (photo.into_luma16(), None)
    };
    let (width, height) = (gray.width() as usize, gray.height() as usize);
    let is_colored = colors.is_some();
    Ok((Brightness { width, height, values: gray.into_raw(), is_colored, is_stretched }, colors))
}

/// Returns whether bytes begin like a photo of one of the formats that are read.
pub fn is_picture(bytes: &[u8]) -> bool {
    photo_format(bytes).is_some()
}

fn photo_format(bytes: &[u8]) -> Option<ImageFormat> {
    // TIFF with 64-bit offsets (BigTIFF).
    if [b"II+\0", b"MM\0+"].iter().any(|beginning| bytes.starts_with(*beginning)) {
        return Some(ImageFormat::Tiff);
    }
    // A file without a known beginning is no photo.
    let format = image::guess_format(bytes).ok()?;
    let is_read = match format {
        ImageFormat::Jpeg | ImageFormat::Png | ImageFormat::WebP | ImageFormat::Tiff => true,
        // A table may begin with the same two letters; a BMP has four zeros after the size of the file.
        ImageFormat::Bmp => bytes.get(6..10) == Some(&[0; 4][..]),
        _ => false,
    };
    is_read.then_some(format)
}

/// Decodes a photo and applies its stored orientation.
fn upright(bytes: &[u8]) -> Result<Decoded, PictureError> {
    let format = photo_format(bytes).ok_or_else(|| PictureError::NoPhoto { found: Found::of(bytes) })?;
    if format == ImageFormat::Tiff {
        let TiffPhoto { mut photo, orientation, is_stretched } = tiff_photo(bytes)?;
        photo.apply_orientation(orientation);
        return Ok(Decoded { photo, is_stretched });
    }
    if format == ImageFormat::Jpeg && is_cut_off(bytes) {
        return Err(PictureError::CutOff);
    }
    let of_webp = if format == ImageFormat::WebP { Some(webp_orientation(bytes)?) } else { None };
    let refused = |error| match error {
        ImageError::Limits(_) => PictureError::LargePhoto,
        ImageError::Unsupported(_) => PictureError::Unsupported { what: VARIANT },
        // Rows of a BMP have no markers: only the end of the file tells that some are missing.
        ImageError::IoError(error)
            if format == ImageFormat::Bmp && error.kind() == ErrorKind::UnexpectedEof =>
        {
            PictureError::CutOff
        }
        error => error.into(),
    };
    let kept = without_large_texts(bytes);
    let mut reader = ImageReader::with_format(Cursor::new(&*kept), format);
    let mut limits = image::Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MAX_PHOTO_SIDE), Some(MAX_PHOTO_SIDE));
    limits.max_alloc = Some(MAX_PHOTO_BYTES);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(refused)?;
    let (width, height) = decoder.dimensions();
    let beside = match format {
        ImageFormat::WebP => WEBP_BYTES_BESIDE * u64::from(width) * u64::from(height),
        _ => 0,
    };
    check_memory((width, height), decoder.total_bytes().saturating_add(beside), bytes.len())?;
    // A photo without orientation data counts as upright.
    let orientation = of_webp.unwrap_or_else(|| decoder.orientation().unwrap_or(Orientation::NoTransforms));
    let mut photo = DynamicImage::from_decoder(decoder).map_err(refused)?;
    // Their decoders return colors for every picture.
    if matches!(format, ImageFormat::Bmp | ImageFormat::WebP) {
        photo = gray_if_colorless(photo);
    }
    photo.apply_orientation(orientation);
    Ok(Decoded { photo, is_stretched: false })
}

/// Returns a picture with gray values instead of colors if all its colors are gray.
fn gray_if_colorless(photo: DynamicImage) -> DynamicImage {
    let gray = match &photo {
        DynamicImage::ImageRgb8(rgb) if rgb.pixels().all(|pixel| pixel.0 == [pixel.0[0]; 3]) => {
            GrayImage::from_raw(rgb.width(), rgb.height(), rgb.pixels().map(|pixel| pixel.0[0]).collect())
        }
        _ => None,
    };
    gray.map_or(photo, DynamicImage::ImageLuma8)
}

/// Returns whether a JPEG ends before its end marker. Decoders silently fill missing rows with gray. A complete file
/// whose writer omitted the marker is indistinguishable from one without its last row.
fn is_cut_off(bytes: &[u8]) -> bool {
    const BEGIN: u8 = 0xD8;
    const END: u8 = 0xD9;
    const SCAN: u8 = 0xDA;
    let mut rest = bytes;
    loop {
        match rest {
            [0xFF, 0xFF, ..] => rest = &rest[1..],
            [0xFF, BEGIN, ..] => rest = &rest[2..],
            // Within scan data, the end marker never follows 0xFF.
            [0xFF, SCAN, data @ ..] => return !data.windows(2).any(|pair| pair == [0xFF, END]),
            // Segments before the scans state their length; they may contain a thumbnail with its own end marker.
            [0xFF, 0xC0..=0xFE, high, low, ..] => {
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                let Some(after) = rest.get(2 + length..) else { return true };
                rest = after;
            }
            [] | [0xFF] | [0xFF, 0xC0..=0xFE, ..] => return true,
            // Other damage; the decoder reports it.
            _ => return false,
        }
    }
}

#[cfg(test)]
mod tests;
