//! Pictures of surfaces: pixels to compressed bytes and back.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::metadata::Orientation;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder as _, ImageError, ImageFormat,
    ImageReader,
};
use shagreen_core::shading::Picture as Surface;

/// Quality of the JPEG pictures in a library, 1..100.
pub const JPEG_QUALITY: u8 = 85;

/// Longest side of a picture that is read, in pixels.
pub const MAX_SIDE: u32 = 4096;

/// Longest side of a photo that is made a picture of, in pixels.
pub const MAX_PHOTO_SIDE: u32 = 16_384;
/// Bytes of a photo that is unpacked, at most.
const MAX_PHOTO_BYTES: u64 = 1 << 30;
/// Longest side of the picture that is made of a photo, in pixels.
pub const PHOTO_SIDE: u32 = 768;

/// Memory that a picture may take to unpack, whatever its length: the largest in full color, and some.
const MEMORY_BYTES: u64 = 56 << 20;
/// Memory beyond that, by the length of its bytes.
const MEMORY_FACTOR: u64 = 8;

/// How the bytes of a picture are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// JPEG.
    Jpeg,
    /// PNG.
    Png,
}

impl PictureFormat {
    /// The media type that stands in files.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Jpeg => "image/jpeg",
            Self::Png => "image/png",
        }
    }

    /// The format that has this [`PictureFormat::media_type`].
    pub fn from_media_type(media_type: &str) -> Option<Self> {
        [Self::Jpeg, Self::Png].into_iter().find(|format| format.media_type() == media_type)
    }
}

/// A compressed picture of a piece of surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row, 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Rows, 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Length of surface that the width covers, in mm.
    pub millimeters: f64,
    /// How `bytes` are compressed.
    pub format: PictureFormat,
    /// The compressed picture.
    pub bytes: Vec<u8>,
}

/// Pixels: red, green and blue (sRGB) of each, row after row from the upper left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Three bytes a pixel.
    pub pixels: Vec<u8>,
}

impl Rgb {
    /// The same as what is lit and looked at; `millimeters` is the length of surface that the width covers.
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

/// Why a picture cannot be packed or unpacked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The number of bytes does not fit the size, or the size is outside 1 to [`MAX_SIDE`].
    #[error("a picture of {width} x {height} pixels cannot have {n_bytes} bytes of color")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes given.
        n_bytes: usize,
    },
    /// The compressed bytes have another size than the file says.
    #[error("the picture is {found_width} x {found_height} pixels, the library says {width} x {height}")]
    Mismatch {
        /// Pixels in a row, by the library.
        width: u32,
        /// Rows, by the library.
        height: u32,
        /// Pixels in a row, by the picture.
        found_width: u32,
        /// Rows, by the picture.
        found_height: u32,
    },
    /// Unpacking would take far more memory than a picture of so many bytes is worth.
    #[error(
        "the picture is {width} x {height} pixels in {n_bytes} bytes, too large to unpack; make it smaller"
    )]
    TooLarge {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Compressed bytes.
        n_bytes: usize,
    },
    /// There is no such row.
    #[error("the picture has rows 0 to {}, there is no row {row}", .rows - 1)]
    Row {
        /// The row that was asked for.
        row: u32,
        /// How many there are.
        rows: u32,
    },
    /// The bytes are neither JPEG nor PNG.
    #[error("this is no photo that can be read; save it as JPEG or PNG")]
    NoPhoto,
    /// A photo of more than [`MAX_PHOTO_SIDE`] pixels a side, or of more than 1 GiB once it is unpacked.
    #[error("the photo is too large; make it at most {MAX_PHOTO_SIDE} pixels a side, with 8 bits a color")]
    LargePhoto,
    /// A photo that ends before its last row.
    #[error("the photo is cut off; get it again")]
    CutOff,
    /// The compressed bytes are damaged.
    #[error("the picture is damaged")]
    Codec(#[from] ImageError),
}

/// Packs pixels as JPEG at [`JPEG_QUALITY`]; `millimeters` is the length of surface that the width covers.
///
/// # Errors
/// [`PictureError::Size`] where pixels and size do not fit.
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

/// A PNG of pixels, without loss.
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

/// A square of heights as a PNG of 16 bits: the lowest is 0, the highest 65,535. What that is in meters is told elsewhere.
///
/// # Errors
/// [`PictureError::Size`] where there are not as many rows as columns.
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

/// Unpacks a picture.
///
/// # Errors
/// [`PictureError::Codec`] where the bytes are damaged, [`PictureError::Mismatch`] where they are of another size,
/// [`PictureError::TooLarge`] where few bytes would unpack to more than ten times their length and 64 MB.
pub fn decode(picture: &Picture) -> Result<Rgb, PictureError> {
    let rgb = DynamicImage::from_decoder(decoder(picture)?)?.into_rgb8();
    check_size(picture, rgb.dimensions())?;
    Ok(Rgb { width: picture.width, height: picture.height, pixels: rgb.into_raw() })
}

/// A picture of a photo, whatever its size: upright, and no larger than [`PHOTO_SIDE`]; `millimeters` is the length of surface
/// that the width covers.
///
/// # Errors
/// [`PictureError::NoPhoto`] for what is neither JPEG nor PNG, [`PictureError::LargePhoto`] for more than
/// [`MAX_PHOTO_SIDE`] pixels a side, [`PictureError::CutOff`] and [`PictureError::Codec`] for damaged bytes.
pub fn of_photo(bytes: &[u8], millimeters: f64) -> Result<Picture, PictureError> {
    encode_jpeg(&photo_pixels(bytes)?, millimeters)
}

/// The pixels of such a picture, before it is packed.
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

/// The brightness along a row of a photo or of a height map, 0 (black) to 1, pixel by pixel: as finely as the file has it,
/// which in a PNG may be 16 bits. Row 0 is the upper one; `None` is the one in the middle.
///
/// # Errors
/// As [`of_photo`], and [`PictureError::Row`] where there is no such row.
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

/// Whether bytes begin as JPEG or PNG do.
pub fn is_picture(bytes: &[u8]) -> bool {
    photo_format(bytes).is_some()
}

fn photo_format(bytes: &[u8]) -> Option<ImageFormat> {
    image::guess_format(bytes).ok().filter(|f| matches!(f, ImageFormat::Jpeg | ImageFormat::Png))
}

/// A photo as it was held.
fn upright(bytes: &[u8]) -> Result<DynamicImage, PictureError> {
    let mut reader = ImageReader::new(Cursor::new(bytes));
    let format = photo_format(bytes).ok_or(PictureError::NoPhoto)?;
    if format == ImageFormat::Jpeg && is_cut_off(bytes) {
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
    // A photo that does not say how it was held was held upright.
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut photo = DynamicImage::from_decoder(decoder).map_err(refused)?;
    photo.apply_orientation(orientation);
    Ok(photo)
}

/// Whether a JPEG ends before its marker of the end: decoders fill what is missing with gray and say nothing. A whole one
/// whose writer left the marker out cannot be told from one that lost its last row.
fn is_cut_off(bytes: &[u8]) -> bool {
    const BEGIN: u8 = 0xD8;
    const END: u8 = 0xD9;
    const SCAN: u8 = 0xDA;
    let mut rest = bytes;
    loop {
        match rest {
            [0xFF, 0xFF, ..] => rest = &rest[1..],
            [0xFF, BEGIN, ..] => rest = &rest[2..],
            // Within a scan 0xFF is always followed by something else than this.
            [0xFF, SCAN, data @ ..] => return !data.windows(2).any(|pair| pair == [0xFF, END]),
            // What is before the scans says how long it is; it may hold a small picture that has an end of its own.
            [0xFF, 0xC0..=0xFE, high, low, ..] => {
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                let Some(after) = rest.get(2 + length..) else { return true };
                rest = after;
            }
            [] | [0xFF] | [0xFF, 0xC0..=0xFE, ..] => return true,
            // Something else is wrong with it; whoever decodes it says so.
            _ => return false,
        }
    }
}

/// Looks at the head of a picture, in microseconds: whether it is one, of the size that it should have. Damage further
/// in shows only in [`decode`].
///
/// # Errors
/// As [`decode`].
pub fn check(picture: &Picture) -> Result<(), PictureError> {
    decoder(picture).map(|_| ())
}

/// A decoder that has seen the head of a picture, and found it good.
fn decoder(picture: &Picture) -> Result<impl ImageDecoder + '_, PictureError> {
    let decoder = reader(picture).into_decoder()?;
    let (width, height) = decoder.dimensions();
    check_size(picture, (width, height))?;
    let n_pixels = u64::from(width) * u64::from(height);
    let converted = if decoder.color_type() == ColorType::Rgb8 { 0 } else { 3 * n_pixels };
    // A progressive JPEG is kept as 16-bit coefficients until its last pass.
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

fn reader(picture: &Picture) -> ImageReader<Cursor<&[u8]>> {
    let format = match picture.format {
        PictureFormat::Jpeg => ImageFormat::Jpeg,
        PictureFormat::Png => ImageFormat::Png,
    };
    let mut reader = ImageReader::with_format(Cursor::new(picture.bytes.as_slice()), format);
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
        assert!(rgb.pixels[0] < 12 && rgb.pixels[rgb.pixels.len() - 3] > 240, "it is the same way up");
        let small = encode_jpeg(&gradient(), 20.0).unwrap();
        assert_eq!(of_photo(&small.bytes, 20.0).unwrap().width, 32);
        assert!(matches!(of_photo(b"GIF89a", 20.0), Err(PictureError::NoPhoto)));
        assert!(matches!(of_photo(b"", 20.0), Err(PictureError::NoPhoto)));
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
        // A small picture in the head has an end of its own; what follows the end belongs to somebody else.
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
            // Half a level of 16 bits.
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
        // At quality 85 a smooth gradient is off by about one step of 255.
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
            // The head of a JPEG ends with its tables, which take more than this.
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
