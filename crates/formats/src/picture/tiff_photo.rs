//! TIFF files: photos, and numbers of any type as gray levels. Of several pages, the first one is read.

use std::convert::identity;
use std::io::{Cursor, ErrorKind};

use image::error::DecodingError;
use image::metadata::Orientation;
use image::{DynamicImage, GrayImage, ImageBuffer, ImageError, ImageFormat, Luma, Rgb, RgbImage};
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{CompressionMethod, PhotometricInterpretation, Tag};
use tiff::{ColorType, TiffError, TiffUnsupportedError};

use super::error::{PictureError, VARIANT};
use super::photo_limits::{MAX_PHOTO_BYTES, check_memory};
use super::tiff_tags::check_tags;
use super::{MAX_PHOTO_SIDE, stretched_levels};

/// Largest magnitude of a number that counts as measured. Programs mark places without a measurement by the largest
/// number of single precision, 3.4e38, or by NaN.
const MAX_NUMBER: f64 = 1e30;

/// Words for what a file uses that is not read.
const PALETTE: &str = "a color palette";
const YCBCR: &str = "colors in YCbCr";
const LAB: &str = "colors in Lab";

/// A decoded TIFF.
pub(super) struct TiffPhoto {
    /// Gray or red, green and blue, with 8 or 16 bits; not yet turned.
    pub(super) photo: DynamicImage,
    /// How the photo must be turned.
    pub(super) orientation: Orientation,
    /// Whether the lowest number of the file became black and the highest white.
    pub(super) is_stretched: bool,
}

/// How the samples of a picture lie in memory.
#[derive(Clone, Copy)]
struct SampleLayout {
    width: u32,
    height: u32,
    /// Bits of a sample in the file.
    bits: u8,
    /// Samples of a pixel.
    n_samples: usize,
    /// Samples of a pixel that are used: the first ones.
    n_channels: usize,
    /// Whether each channel is an image of its own.
    is_planar: bool,
}

/// Decodes the first page of a TIFF. Transparency is ignored.
///
/// # Errors
/// [`PictureError::Unsupported`], [`PictureError::Gaps`], [`PictureError::LargePhoto`], [`PictureError::TooLarge`],
/// [`PictureError::CutOff`] and [`PictureError::Codec`].
pub(super) fn tiff_photo(bytes: &[u8]) -> Result<TiffPhoto, PictureError> {
    check_tags(bytes)?;
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(refused)?;
    let (width, height) = decoder.dimensions().map_err(refused)?;
    if width.max(height) > MAX_PHOTO_SIDE {
        return Err(PictureError::LargePhoto);
    }
    let color = decoder.colortype().map_err(refused)?;
    let buffer = decoder.image_buffer_layout().map_err(refused)?;
    let layout = SampleLayout {
        width,
        height,
        bits: color.bit_depth(),
        n_samples: usize::from(color.num_samples()),
        n_channels: n_channels(color)?,
        is_planar: buffer.planes > 1,
    };
    // The samples as they are in the file, and the levels made from them.
    let level_bytes = if layout.bits <= 8 { 1 } else { 2 };
    let n_levels = layout.n_pixels() * layout.n_channels;
    check_memory((width, height), (buffer.complete_len + level_bytes * n_levels) as u64, bytes.len())?;
    // A photo without orientation data, or with an unknown orientation, counts as upright.
    let orientation = decoder.find_tag_unsigned::<u8>(Tag::Orientation).unwrap_or_default();
    let orientation = orientation.and_then(Orientation::from_exif).unwrap_or(Orientation::NoTransforms);

    let mut limits = Limits::default();
    limits.decoding_buffer_size = buffer.complete_len;
    limits.intermediate_buffer_size = usize::try_from(MAX_PHOTO_BYTES).unwrap_or(usize::MAX);
    let mut decoder = decoder.with_limits(limits);
    let mut samples = DecodingResult::U8(Vec::new());
    decoder.read_image_to_buffer(&mut samples).map_err(refused)?;
    let (photo, is_stretched) =
        if layout.n_channels == 1 { gray(samples, layout)? } else { (colored(samples, layout)?, false) };
    Ok(TiffPhoto { photo, orientation, is_stretched })
}

/// Number of samples of a pixel that are used: one for gray, three for red, green and blue.
fn n_channels(color: ColorType) -> Result<usize, PictureError> {
    let what = match color {
        // The reader gives this name to gray values with further samples, such as transparency.
        ColorType::Gray(_) | ColorType::GrayA(_) | ColorType::Multiband { .. } => return Ok(1),
        ColorType::RGB(_) | ColorType::RGBA(_) => return Ok(3),
        ColorType::CMYK(_) | ColorType::CMYKA(_) => "printing colors (CMYK)",
        ColorType::YCbCr(_) => YCBCR,
        ColorType::Lab(_) => LAB,
        ColorType::Palette(_) => PALETTE,
        _ => VARIANT,
    };
    Err(PictureError::Unsupported { what })
}

/// Colors with 8 or 16 bits per channel.
fn colored(samples: DecodingResult, layout: SampleLayout) -> Result<DynamicImage, PictureError> {
    let SampleLayout { width, height, .. } = layout;
    let photo = match samples {
        DecodingResult::U8(samples) => {
            RgbImage::from_raw(width, height, layout.used(samples)?).map(DynamicImage::ImageRgb8)
        }
        DecodingResult::U16(samples) => {
            let levels = layout.used(samples)?;
            ImageBuffer::<Rgb<u16>, Vec<u16>>::from_raw(width, height, levels).map(DynamicImage::ImageRgb16)
        }
        _ => return Err(PictureError::Unsupported { what: "colors that are not 8 or 16 bits per channel" }),
    };
    photo.ok_or_else(too_few)
}

/// Gray values of any type, and whether they were stretched.
fn gray(samples: DecodingResult, layout: SampleLayout) -> Result<(DynamicImage, bool), PictureError> {
    let SampleLayout { width, height, .. } = layout;
    let of_8_bits =
        |levels: Vec<u8>| GrayImage::from_raw(width, height, levels).map(DynamicImage::ImageLuma8);
    let of_16_bits = |levels: Vec<u16>| {
        ImageBuffer::<Luma<u16>, Vec<u16>>::from_raw(width, height, levels).map(DynamicImage::ImageLuma16)
    };
    let stretched = match samples {
        // Whole numbers without a sign, of up to 16 bits: black and white are the limits of their type.
        DecodingResult::U8(samples) => {
            let levels = if layout.bits < 8 { unpacked(&samples, layout)? } else { layout.used(samples)? };
            return of_8_bits(levels).map(|photo| (photo, false)).ok_or_else(too_few);
        }
        DecodingResult::U16(samples) => {
            return of_16_bits(layout.used(samples)?).map(|photo| (photo, false)).ok_or_else(too_few);
        }
        DecodingResult::U32(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::U64(samples) => stretched(&layout.used(samples)?, |number| number as f64)?,
        DecodingResult::F16(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::F32(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::F64(samples) => stretched(&layout.used(samples)?, identity)?,
        DecodingResult::I8(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::I16(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::I32(samples) => stretched(&layout.used(samples)?, f64::from)?,
        DecodingResult::I64(samples) => stretched(&layout.used(samples)?, |number| number as f64)?,
    };
    of_16_bits(stretched).map(|photo| (photo, true)).ok_or_else(too_few)
}

impl SampleLayout {
    fn n_pixels(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The used samples, pixel by pixel.
    fn used<T: Copy>(self, mut samples: Vec<T>) -> Result<Vec<T>, PictureError> {
        let Self { n_samples, n_channels, is_planar, .. } = self;
        let n_pixels = self.n_pixels();
        if samples.len() < n_pixels * n_samples {
            return Err(too_few());
        }
        if n_samples == n_channels && !is_planar {
            samples.truncate(n_pixels * n_samples);
            return Ok(samples);
        }
        let [of_pixel, of_channel] = if is_planar { [1, n_pixels] } else { [n_samples, 1] };
        let mut used = Vec::with_capacity(n_pixels * n_channels);
        for pixel in 0..n_pixels {
            used.extend((0..n_channels).map(|channel| samples[of_pixel * pixel + of_channel * channel]));
        }
        Ok(used)
    }
}

/// Levels of 8 bits from gray values of 1, 2 or 4 bits. Each row begins at a whole byte.
fn unpacked(packed: &[u8], layout: SampleLayout) -> Result<Vec<u8>, PictureError> {
    let SampleLayout { width, bits, n_samples, .. } = layout;
    if !matches!(bits, 1 | 2 | 4) || n_samples > 1 {
        return Err(PictureError::Unsupported { what: "gray values of an unusual number of bits" });
    }
    let (width, bits) = (width as usize, usize::from(bits));
    let most = (1_usize << bits) - 1;
    let level = |row: &[u8], x: usize| {
        let shift = 8 - bits - x * bits % 8;
        let value = (usize::from(row[x * bits / 8]) >> shift) & most;
        (255 / most * value) as u8
    };
    let rows = packed.chunks_exact((width * bits).div_ceil(8));
    Ok(rows.flat_map(|row| (0..width).map(move |x| level(row, x))).collect())
}

/// Levels of 16 bits from numbers that have no black and white of their own: the lowest becomes black, the highest white.
fn stretched<T: Copy>(samples: &[T], to_f64: impl Fn(T) -> f64) -> Result<Vec<u16>, PictureError> {
    let numbers = samples.iter().map(|sample| to_f64(*sample));
    // False for NaN too.
    if !numbers.clone().all(|number| number.abs() <= MAX_NUMBER) {
        return Err(PictureError::Gaps);
    }
    Ok(stretched_levels(numbers).collect())
}

fn too_few() -> PictureError {
    damaged("the picture has fewer samples than its size needs")
}

fn damaged(error: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> PictureError {
    ImageError::Decoding(DecodingError::new(ImageFormat::Tiff.into(), error)).into()
}

fn refused(error: TiffError) -> PictureError {
    match error {
        TiffError::LimitsExceeded => PictureError::LargePhoto,
        TiffError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => PictureError::CutOff,
        TiffError::UnsupportedError(why) => PictureError::Unsupported { what: unsupported(&why) },
        error => damaged(error),
    }
}

/// What a file uses that the reader does not support.
fn unsupported(why: &TiffUnsupportedError) -> &'static str {
    match why {
        TiffUnsupportedError::InterpretationWithBits(PhotometricInterpretation::RGBPalette, _) => PALETTE,
        TiffUnsupportedError::InterpretationWithBits(
            PhotometricInterpretation::CIELab | PhotometricInterpretation::ItuLab,
            _,
        ) => LAB,
        TiffUnsupportedError::ChromaSubsampling => YCBCR,
        TiffUnsupportedError::UnsupportedCompressionMethod(
            CompressionMethod::JPEG | CompressionMethod::ModernJPEG,
        ) => "JPEG compression within a TIFF",
        TiffUnsupportedError::UnsupportedCompressionMethod(_) => "a compression that is not common in TIFF",
        _ => VARIANT,
    }
}

#[cfg(test)]
mod tests;
