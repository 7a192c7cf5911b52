//! Pictures in libraries: JPEG and PNG.

use shagreen_formats::picture::{Picture, PictureFormat, Rgb, check, decode, encode_jpeg};

fn rgb(width: u32, height: u32) -> Rgb {
    let pixels = (0..3 * width * height).map(|i| (i * i / 7 % 256) as u8).collect();
    Rgb { width, height, pixels }
}

pub(crate) fn jpeg_seeds() -> Vec<Vec<u8>> {
    vec![encode_jpeg(&rgb(16, 16), 20.0).unwrap().bytes, encode_jpeg(&rgb(40, 24), 20.0).unwrap().bytes]
}

/// Two headers that state the largest possible pictures, baseline and progressive.
pub(crate) fn jpeg_bombs() -> Vec<Vec<u8>> {
    let large = |change: fn(&mut [u8])| {
        let mut bytes = encode_jpeg(&rgb(16, 16), 20.0).unwrap().bytes;
        let frame = bytes.windows(2).position(|pair| pair == [0xFF, 0xC0]).unwrap();
        bytes[frame + 5..frame + 9].copy_from_slice(&[0x10, 0, 0x10, 0]);
        change(&mut bytes[frame..]);
        bytes
    };
    vec![large(|_| {}), large(|frame| frame[1] = 0xC2)]
}

/// The size in the header, so that the reader does not stop at a size mismatch.
fn jpeg_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let frame = bytes.windows(2).position(|pair| pair[0] == 0xFF && (0xC0..=0xC2).contains(&pair[1]))?;
    let side = |at: usize| Some(u32::from(u16::from_be_bytes([*bytes.get(at)?, *bytes.get(at + 1)?])));
    Some((side(frame + 7)?, side(frame + 5)?))
}

pub(crate) fn read_a_jpeg(bytes: &[u8]) -> Result<(), String> {
    let (width, height) = jpeg_size(bytes).unwrap_or((1, 1));
    read_a_picture(bytes, width, height, PictureFormat::Jpeg)
}

fn png(image: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

pub(crate) fn png_seeds() -> Vec<Vec<u8>> {
    vec![
        png(&image::DynamicImage::new_rgb8(12, 7)),
        png(&image::DynamicImage::new_rgba16(5, 9)),
        png(&image::DynamicImage::new_luma8(9, 5)),
    ]
}

/// Empty pictures of the largest size: some kB that decode to hundreds of MB.
pub(crate) fn png_bombs() -> Vec<Vec<u8>> {
    vec![png(&image::DynamicImage::new_luma8(4096, 4096)), png(&image::DynamicImage::new_rgba16(4096, 4096))]
}

pub(crate) fn read_a_png(bytes: &[u8]) -> Result<(), String> {
    let side = |at: usize| {
        bytes.get(at..at + 4).and_then(|b| <[u8; 4]>::try_from(b).ok()).map_or(1, u32::from_be_bytes)
    };
    read_a_picture(bytes, side(16), side(20), PictureFormat::Png)
}

fn read_a_picture(bytes: &[u8], width: u32, height: u32, format: PictureFormat) -> Result<(), String> {
    let picture = Picture { width, height, millimeters: 20.0, format, bytes: bytes.to_vec() };
    let head_is_sound = check(&picture).is_ok();
    match decode(&picture) {
        Ok(_) if !head_is_sound => Err("a picture with a damaged header was decoded".into()),
        _ => Ok(()),
    }
}
