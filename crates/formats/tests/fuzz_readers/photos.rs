//! Photos in the formats that only photos have: BMP, WebP and TIFF.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat};
use shagreen_formats::picture::{brightness_and_colors, of_photo};
use tiff::encoder::colortype::{ColorType, Gray32Float, RGB8};
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, TiffValue};

fn file(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn tiff<C: ColorType>(width: u32, height: u32, samples: &[C::Inner], compression: Compression) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap().with_compression(compression);
    encoder.write_image::<C>(width, height, samples).unwrap();
    bytes.into_inner()
}

pub(crate) fn photo_seeds() -> Vec<Vec<u8>> {
    let levels: Vec<u8> = (0..3 * 12 * 7).map(|i| (i * i / 5 % 256) as u8).collect();
    let heights: Vec<f32> = levels.iter().map(|level| 1e-3 * f32::from(*level)).collect();
    let rgb = image::RgbImage::from_raw(12, 7, levels.clone()).unwrap();
    let rgb = DynamicImage::ImageRgb8(rgb);
    vec![
        file(&rgb, ImageFormat::Bmp),
        file(&DynamicImage::new_luma8(9, 5), ImageFormat::Bmp),
        file(&rgb, ImageFormat::WebP),
        file(&DynamicImage::new_rgba8(5, 9), ImageFormat::WebP),
        tiff::<RGB8>(12, 7, &levels, Compression::Lzw),
        tiff::<Gray32Float>(12, 21, &heights, Compression::Uncompressed),
    ]
}

/// Small files that state or hold large pictures.
pub(crate) fn photo_bombs() -> Vec<Vec<u8>> {
    let mut bmp = file(&DynamicImage::new_rgb8(4, 4), ImageFormat::Bmp);
    bmp[18..26].copy_from_slice(&[16_000_i32.to_le_bytes(), 16_000_i32.to_le_bytes()].concat());
    vec![
        bmp,
        file(&DynamicImage::new_rgb8(3000, 3000), ImageFormat::WebP),
        tiff::<RGB8>(5000, 5000, &vec![0; 3 * 5000 * 5000], Compression::Deflate(DeflateLevel::default())),
    ]
}

/// Decodes a photo in both ways; a picture that is made has a permitted size.
pub(crate) fn read_a_photo(bytes: &[u8]) -> Result<(), String> {
    // An error is fine too.
    let colors = brightness_and_colors(bytes).is_ok();
    match of_photo(bytes, 20.0) {
        Ok(picture) if !colors => {
            Err(format!("only one way decodes {} x {} pixels", picture.width, picture.height))
        }
        _ => Ok(()),
    }
}
