//! Pictures of surfaces: encoding and decoding. Libraries store them as JPEG or PNG; photos have further formats.

mod error;
mod photo;
mod photo_limits;
mod png_chunks;
mod tiff_photo;
mod tiff_tags;
mod webp_chunks;

pub use self::error::PictureError;
pub use self::photo::{
    Brightness, PHOTO_ENDINGS, PHOTO_SIDE, brightness_and_colors, brightness_row, is_picture, of_photo,
    photo_pixels,
};

use self::png_chunks::without_large_texts;

use std::borrow::Cow;
use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder as _, ImageFormat, ImageReader,
};
use shagreen_core::surfaces::shading::Picture as Surface;

/// JPEG quality of the pictures in a library, 1..100.
pub const JPEG_QUALITY: u8 = 85;

/// Maximum side of a decoded picture, in pixels.
pub const MAX_SIDE: u32 = 4096;

/// Maximum side of a photo to import, in pixels.
pub const MAX_PHOTO_SIDE: u32 = 16_384;
/// Side in pixels up to which photos of all formats can be decoded, with 8 bits per color channel: some decoders need
/// more memory for a pixel than others.
const SAFE_PHOTO_SIDE: u32 = 8192;

/// Memory in bytes that decoding a picture may take regardless of its file size: the largest picture in full color,
/// with a margin.
const MEMORY_BYTES: u64 = 56 << 20;
/// Additional memory, in bytes per compressed byte.
const MEMORY_FACTOR: u64 = 8;

/// Compression format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// JPEG.
    Jpeg,
    /// PNG.
    Png,
}

impl PictureFormat {
    /// Media type, as files store it.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Jpeg => "image/jpeg",
            Self::Png => "image/png",
        }
    }

    /// Returns the format with this [`PictureFormat::media_type`].
    pub fn from_media_type(media_type: &str) -> Option<Self> {
        [Self::Jpeg, Self::Png].into_iter().find(|format| format.media_type() == media_type)
    }
}

/// A compressed picture of a surface patch.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels, 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Height in pixels, 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Width of the surface patch, in mm.
    pub millimeters: f64,
    /// Compression format of `bytes`.
    pub format: PictureFormat,
    /// The compressed picture.
    pub bytes: Vec<u8>,
}

/// Uncompressed pixels: red, green and blue (sRGB), row by row from the upper left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Three bytes per pixel.
    pub pixels: Vec<u8>,
}

impl Rgb {
    /// Converts to a surface picture for shading; `millimeters` is the width of the surface patch.
    pub fn into_surface(self, millimeters: f64) -> Surface {
        Surface { width: self.width as usize, height: self.height as usize, rgb: self.pixels, millimeters }
    }
}

impl From<&Surface> for Rgb {
    fn from(picture: &Surface) -> Self {
        let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
        Self { width: side(picture.width), height: side(picture.height), pixels: picture.rgb.clone() }
    }
}

/// Encodes pixels as JPEG at [`JPEG_QUALITY`]; `millimeters` is the width of the surface patch.
///
/// # Errors
/// [`PictureError::Size`] if the number of pixels does not match the size.
pub fn encode_jpeg(rgb: &Rgb, millimeters: f64) -> Result<Picture, PictureError> {
    encode_jpeg_at(rgb, millimeters, JPEG_QUALITY)
}

/// Returns pixels as they are after compression to JPEG at a quality of 1 to 100, with its loss.
///
/// # Errors
/// As [`encode_jpeg`].
pub fn recompressed(rgb: &Rgb, quality: u8) -> Result<Rgb, PictureError> {
    // The width of the surface does not matter for pixels.
    decode(&encode_jpeg_at(rgb, 1.0, quality)?)
}

fn encode_jpeg_at(rgb: &Rgb, millimeters: f64, quality: u8) -> Result<Picture, PictureError> {
    let Rgb { width, height, ref pixels } = *rgb;
    let fits = |side: u32| (1..=MAX_SIDE).contains(&side);
    if !(fits(width) && fits(height) && pixels.len() == 3 * width as usize * height as usize) {
        return Err(PictureError::Size { width, height, n_bytes: pixels.len() });
    }
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, quality.clamp(1, 100));
    encoder.encode(pixels, width, height, ExtendedColorType::Rgb8)?;
    Ok(Picture { width, height, millimeters, format: PictureFormat::Jpeg, bytes })
}

/// Encodes pixels as PNG, lossless.
///
/// # Errors
/// As [`encode_jpeg`].
pub fn encode_png(rgb: &Rgb) -> Result<Vec<u8>, PictureError> {
    let Rgb { width, height, ref pixels } = *rgb;
    if pixels.len() != 3 * width as usize * height as usize {
        return Err(PictureError::Size { width, height, n_bytes: pixels.len() });
    }
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(pixels, width, height, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

/// Encodes a square height map as 16-bit PNG: the lowest height becomes 0, the highest 65,535. The caller stores the
/// range in meters.
///
/// # Errors
/// [`PictureError::Size`] unless there are as many rows as columns.
pub fn encode_heights(heights_m: &[f64], n_columns: usize) -> Result<Vec<u8>, PictureError> {
    let levels: Vec<u16> = stretched_levels(heights_m.iter().copied()).collect();
    encode_levels(&levels, n_columns)
}

/// Encodes a square of gray levels as 16-bit PNG, row by row from the upper left.
///
/// # Errors
/// [`PictureError::Size`] unless there are as many rows as columns.
pub fn encode_levels(levels: &[u16], n_columns: usize) -> Result<Vec<u8>, PictureError> {
    let side = u32::try_from(n_columns).unwrap_or(u32::MAX);
    if n_columns == 0 || levels.len() != n_columns * n_columns {
        return Err(PictureError::Size { width: side, height: side, n_bytes: levels.len() });
    }
    let pixels: Vec<u8> = levels.iter().copied().flat_map(u16::to_ne_bytes).collect();
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(&pixels, side, side, ExtendedColorType::L16)?;
    Ok(bytes)
}

/// Levels from 0 for the lowest number to 65,535 for the highest one. The numbers are finite.
fn stretched_levels(numbers: impl Iterator<Item = f64> + Clone) -> impl Iterator<Item = u16> {
    let low = numbers.clone().fold(f64::INFINITY, f64::min);
    let high = numbers.clone().fold(f64::NEG_INFINITY, f64::max);
    let span = if high > low { high - low } else { 1.0 };
    numbers.map(move |number| (f64::from(u16::MAX) * (number - low) / span).round() as u16)
}

/// Decodes a picture.
///
/// # Errors
/// [`PictureError::Codec`] if the bytes are damaged, [`PictureError::Mismatch`] if the size differs from the stated
/// one, [`PictureError::TooLarge`] if decoding takes more memory than a fixed amount plus a multiple of the compressed
/// size.
pub fn decode(picture: &Picture) -> Result<Rgb, PictureError> {
    let rgb = DynamicImage::from_decoder(decoder(picture)?)?.into_rgb8();
    check_size(picture, rgb.dimensions())?;
    Ok(Rgb { width: picture.width, height: picture.height, pixels: rgb.into_raw() })
}

/// Checks the header of a picture, in microseconds: its format and its size. Only [`decode`] finds damage in the image
/// data.
///
/// # Errors
/// As [`decode`].
pub fn check(picture: &Picture) -> Result<(), PictureError> {
    decoder(picture).map(|_| ())
}

/// Returns a decoder after checking the header of a picture.
fn decoder(picture: &Picture) -> Result<impl ImageDecoder + '_, PictureError> {
    let decoder = reader(picture).into_decoder()?;
    let (width, height) = decoder.dimensions();
    check_size(picture, (width, height))?;
    let n_pixels = u64::from(width) * u64::from(height);
    let converted = if decoder.color_type() == ColorType::Rgb8 { 0 } else { 3 * n_pixels };
    // The decoder keeps a progressive JPEG as 16-bit coefficients until its last pass.
    let is_progressive =
        picture.format == PictureFormat::Jpeg && picture.bytes.windows(2).any(|pair| pair == [0xFF, 0xC2]);
    let coefficients = if is_progressive { 6 * n_pixels } else { 0 };
    let n_bytes = picture.bytes.len();
    let most = MEMORY_BYTES + MEMORY_FACTOR * n_bytes as u64;
    if decoder.total_bytes().saturating_add(converted + coefficients) > most {
        return Err(PictureError::TooLarge { width, height, n_bytes });
    }
    Ok(decoder)
}

fn reader(picture: &Picture) -> ImageReader<Cursor<Cow<'_, [u8]>>> {
    let format = match picture.format {
        PictureFormat::Jpeg => ImageFormat::Jpeg,
        PictureFormat::Png => ImageFormat::Png,
    };
    let mut reader = ImageReader::with_format(Cursor::new(without_large_texts(&picture.bytes)), format);
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    reader.limits(limits);
    reader
}

fn check_size(picture: &Picture, found: (u32, u32)) -> Result<(), PictureError> {
    let (&Picture { width, height, .. }, (found_width, found_height)) = (picture, found);
    if (found_width, found_height) == (width, height) {
        Ok(())
    } else {
        Err(PictureError::Mismatch { width, height, found_width, found_height })
    }
}

#[cfg(test)]
mod tests;
