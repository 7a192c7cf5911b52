//! Pictures of surfaces: encoding and decoding.

mod error;
mod png_chunks;

pub use self::error::PictureError;

use self::png_chunks::without_large_texts;

use std::borrow::Cow;
use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::metadata::Orientation;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder as _, ImageError, ImageFormat,
    ImageReader,
};
use shagreen_core::surfaces::shading::Picture as Surface;

use crate::foreign_file::Found;

/// JPEG quality of the pictures in a library, 1..100.
pub const JPEG_QUALITY: u8 = 85;

/// Maximum side of a decoded picture, in pixels.
pub const MAX_SIDE: u32 = 4096;

/// Maximum side of a photo to import, in pixels.
pub const MAX_PHOTO_SIDE: u32 = 16_384;
/// Maximum size of a decoded photo, in bytes.
const MAX_PHOTO_BYTES: u64 = 1 << 30;
/// Maximum side of the picture made from a photo, in pixels.
pub const PHOTO_SIDE: u32 = 768;

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
    let Rgb { width, height, ref pixels } = *rgb;
    let fits = |side: u32| (1..=MAX_SIDE).contains(&side);
    if !(fits(width) && fits(height) && pixels.len() == 3 * width as usize * height as usize) {
        return Err(PictureError::Size { width, height, n_bytes: pixels.len() });
    }
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
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
    let side = u32::try_from(n_columns).unwrap_or(u32::MAX);
    if n_columns == 0 || heights_m.len() != n_columns * n_columns {
        return Err(PictureError::Size { width: side, height: side, n_bytes: heights_m.len() });
    }
    let low = heights_m.iter().copied().fold(f64::INFINITY, f64::min);
    let high = heights_m.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let span = if high > low { high - low } else { 1.0 };
    let level = |height: &f64| (f64::from(u16::MAX) * (height - low) / span).round() as u16;
    let pixels: Vec<u8> = heights_m.iter().flat_map(|height| level(height).to_ne_bytes()).collect();
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(&pixels, side, side, ExtendedColorType::L16)?;
    Ok(bytes)
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

/// Converts a photo of any size to a picture: upright, and scaled to at most [`PHOTO_SIDE`]. `millimeters` is the width
/// of the surface patch.
///
/// # Errors
/// [`PictureError::NoPhoto`] if the bytes are neither JPEG nor PNG, [`PictureError::LargePhoto`] above
/// [`MAX_PHOTO_SIDE`] pixels per side, [`PictureError::CutOff`] and [`PictureError::Codec`] for damaged bytes.
pub fn of_photo(bytes: &[u8], millimeters: f64) -> Result<Picture, PictureError> {
    encode_jpeg(&photo_pixels(bytes)?, millimeters)
}

/// Returns the pixels of a photo as [`of_photo`] does, before compression.
///
/// # Errors
/// As [`of_photo`].
pub fn photo_pixels(bytes: &[u8]) -> Result<Rgb, PictureError> {
    let mut photo = upright(bytes)?;
    if photo.width().max(photo.height()) > PHOTO_SIDE {
        photo = photo.thumbnail(PHOTO_SIDE, PHOTO_SIDE);
    }
    let rgb = photo.into_rgb8();
    Ok(Rgb { width: rgb.width(), height: rgb.height(), pixels: rgb.into_raw() })
}

/// Returns the brightness along one row of a photo or a height map, 0 (black) to 1, per pixel. The resolution is that
/// of the file, up to 16 bits in a PNG. Row 0 is the top row; `None` selects the middle row.
///
/// # Errors
/// As [`of_photo`], and [`PictureError::Row`] if the row does not exist.
pub fn brightness_row(bytes: &[u8], row: Option<u32>) -> Result<Vec<f64>, PictureError> {
    let photo = upright(bytes)?.into_luma16();
    let rows = photo.height();
    let row = row.unwrap_or(rows / 2);
    if row >= rows {
        return Err(PictureError::Row { row, rows });
    }
    let pixel = |x: u32| f64::from(photo.get_pixel(x, row).0[0]) / f64::from(u16::MAX);
    Ok((0..photo.width()).map(pixel).collect())
}

/// Returns the brightness of all pixels of a photo or a height map, upright, with the resolution of the file, and its
/// colors if the file stores colors.
///
/// # Errors
/// As [`of_photo`].
pub fn brightness_and_colors(bytes: &[u8]) -> Result<(Brightness, Option<Rgb>), PictureError> {
    let photo = upright(bytes)?;
    let (gray, colors) = if photo.color().has_color() {
        let gray = photo.to_luma16();
        let rgb = photo.into_rgb8();
        (gray, Some(Rgb { width: rgb.width(), height: rgb.height(), pixels: rgb.into_raw() }))
    } else {
        (photo.into_luma16(), None)
    };
    let (width, height) = (gray.width() as usize, gray.height() as usize);
    let brightness = Brightness { width, height, values: gray.into_raw(), is_colored: colors.is_some() };
    Ok((brightness, colors))
}

/// Returns whether bytes begin like a JPEG or PNG.
pub fn is_picture(bytes: &[u8]) -> bool {
    photo_format(bytes).is_some()
}

fn photo_format(bytes: &[u8]) -> Option<ImageFormat> {
    image::guess_format(bytes).ok().filter(|f| matches!(f, ImageFormat::Jpeg | ImageFormat::Png))
}

/// Decodes a photo and applies its stored orientation.
fn upright(bytes: &[u8]) -> Result<DynamicImage, PictureError> {
    let bytes = without_large_texts(bytes);
    let mut reader = ImageReader::new(Cursor::new(&*bytes));
    let format = photo_format(&bytes).ok_or_else(|| PictureError::NoPhoto { found: Found::of(&bytes) })?;
    if format == ImageFormat::Jpeg && is_cut_off(&bytes) {
        return Err(PictureError::CutOff);
    }
    reader.set_format(format);
    let mut limits = image::Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MAX_PHOTO_SIDE), Some(MAX_PHOTO_SIDE));
    limits.max_alloc = Some(MAX_PHOTO_BYTES);
    reader.limits(limits.clone());
    let refused = |error| match error {
        ImageError::Limits(_) => PictureError::LargePhoto,
        error => error.into(),
    };
    let mut decoder = reader.into_decoder().map_err(refused)?;
    limits.reserve(decoder.total_bytes()).map_err(refused)?;
    // A photo without orientation data counts as upright.
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut photo = DynamicImage::from_decoder(decoder).map_err(refused)?;
    photo.apply_orientation(orientation);
    Ok(photo)
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
mod tests {
    use super::{
        MAX_PHOTO_SIDE, PHOTO_SIDE, PictureError, PictureFormat, Rgb, brightness_row, check, decode,
        encode_heights, encode_jpeg, encode_png, is_picture, of_photo,
    };

    fn gradient() -> Rgb {
        let pixels = (0..32 * 24).flat_map(|i| [(i % 32) * 8, (i / 32) * 10, 128]).map(|v| v as u8).collect();
        Rgb { width: 32, height: 24, pixels }
    }

    #[test]
    fn a_photo_becomes_a_picture_of_bounded_size() {
        let photo =
            image::RgbImage::from_fn(2000, 1000, |x, y| image::Rgb([(x / 8) as u8, (y / 4) as u8, 7]));
        let mut bytes = std::io::Cursor::new(Vec::new());
        photo.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        let picture = of_photo(bytes.get_ref(), 60.0).unwrap();
        assert_eq!((picture.width, picture.height, picture.millimeters), (PHOTO_SIDE, PHOTO_SIDE / 2, 60.0));
        let rgb = decode(&picture).unwrap();
        assert!(rgb.pixels[0] < 12 && rgb.pixels[rgb.pixels.len() - 3] > 240, "the picture is upside down");
        let small = encode_jpeg(&gradient(), 20.0).unwrap();
        assert_eq!(of_photo(&small.bytes, 20.0).unwrap().width, 32);
        let gif = of_photo(b"GIF89a", 20.0).unwrap_err();
        assert!(gif.to_string().contains("a GIF picture"), "{gif}");
        assert!(matches!(of_photo(b"", 20.0), Err(PictureError::NoPhoto { .. })));
        assert!(matches!(of_photo(&bytes.get_ref()[..200], 20.0), Err(PictureError::Codec(_))));
        let wide = image::GrayImage::new(MAX_PHOTO_SIDE + 1, 1);
        let mut bytes = std::io::Cursor::new(Vec::new());
        wide.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        assert!(matches!(of_photo(bytes.get_ref(), 20.0), Err(PictureError::LargePhoto)));
    }

    #[test]
    fn a_photo_that_is_cut_off_is_none_wherever_it_is_cut() {
        let whole = encode_jpeg(&gradient(), 20.0).unwrap().bytes;
        for end in 3..whole.len() {
            assert!(matches!(of_photo(&whole[..end], 20.0), Err(PictureError::CutOff)), "cut to {end}");
        }
        // A thumbnail in the header has its own end marker; bytes after the end of the image are ignored.
        let (begin, rest) = whole.split_at(2);
        let length = ((whole.len() + 2) as u16).to_be_bytes();
        let with_small = [begin, &[0xFF, 0xE1], &length, &whole, rest, b"more"].concat();
        assert_eq!(of_photo(&with_small, 20.0).unwrap().width, 32);
        let cut = &with_small[..with_small.len() - 20];
        assert!(matches!(of_photo(cut, 20.0), Err(PictureError::CutOff)));
    }

    #[test]
    fn a_row_is_as_fine_as_its_file() {
        let map = image::ImageBuffer::from_fn(300, 5, |x, y| image::Luma([(200 * x + y) as u16]));
        let mut bytes = std::io::Cursor::new(Vec::new());
        map.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        for (row, y) in [(None, 2), (Some(0), 0), (Some(4), 4)] {
            let values = brightness_row(bytes.get_ref(), row).unwrap();
            let wanted = (0..300).map(|x| f64::from(200 * x + y) / 65_535.0);
            assert!(values.into_iter().eq(wanted), "row {row:?}");
        }
        let error = brightness_row(bytes.get_ref(), Some(5)).unwrap_err();
        assert!(error.to_string().contains("rows 0 to 4"), "{error}");
        assert!(is_picture(bytes.get_ref()) && !is_picture(b"0,1"));
    }

    #[test]
    fn heights_and_pixels_come_back_exactly() {
        let heights: Vec<f64> = (0..64 * 64).map(|i| 1e-6 * f64::from(i % 977)).collect();
        let bytes = encode_heights(&heights, 64).unwrap();
        let row = brightness_row(&bytes, Some(20)).unwrap();
        for (got, height) in row.iter().zip(&heights[20 * 64..]) {
            // Half a step of 16 bits.
            assert!((got * 976e-6 - height).abs() < 976e-6 / 65_535.0 / 1.9);
        }
        assert!(
            brightness_row(&encode_heights(&[1.0; 4], 2).unwrap(), None).unwrap().iter().all(|x| *x == 0.0)
        );
        assert!(matches!(encode_heights(&heights, 63), Err(PictureError::Size { .. })));

        let rgb = gradient();
        let bytes = encode_png(&rgb).unwrap();
        let picture = super::Picture {
            width: rgb.width,
            height: rgb.height,
            millimeters: 20.0,
            format: PictureFormat::Png,
            bytes,
        };
        assert_eq!(decode(&picture).unwrap(), rgb);
        assert!(encode_png(&Rgb { width: 3, ..rgb }).is_err());
    }

    #[test]
    fn comes_back_nearly_the_same() {
        let picture = encode_jpeg(&gradient(), 20.0).unwrap();
        let back = decode(&picture).unwrap();
        let error: f64 =
            back.pixels.iter().zip(gradient().pixels).map(|(a, b)| f64::from(a.abs_diff(b))).sum();
        // At quality 85 a smooth gradient deviates by about one step of 255.
        assert!(error / (back.pixels.len() as f64) < 3.0, "{error}");
    }

    #[test]
    fn damage_and_wrong_sizes_are_named() {
        let picture = encode_jpeg(&gradient(), 20.0).unwrap();
        check(&picture).unwrap();
        for end in 0..picture.bytes.len().min(200) {
            let mut cut = picture.clone();
            cut.bytes.truncate(end);
            assert!(decode(&cut).is_err());
            // A JPEG header ends with its tables, which take more bytes than this.
            assert!(check(&cut).is_err() || end > 100, "{end}");
        }
        let wider = super::Picture { width: 33, ..picture.clone() };
        assert!(matches!(decode(&wider), Err(PictureError::Mismatch { found_width: 32, .. })));
        assert!(matches!(check(&wider), Err(PictureError::Mismatch { found_width: 32, .. })));
        let other = super::Picture { format: PictureFormat::Png, ..picture };
        assert!(decode(&other).is_err() && check(&other).is_err());
        let short = Rgb { width: 100, ..gradient() };
        assert!(matches!(encode_jpeg(&short, 1.0), Err(PictureError::Size { width: 100, .. })));
    }
}
