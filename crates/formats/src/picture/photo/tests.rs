use std::io::Cursor;

use image::{DynamicImage, ImageFormat, RgbImage};
use shagreen_core::maths::rng::Random;
use tiff::encoder::{TiffEncoder, colortype};
use tiff::tags::Tag;

use super::{
    MAX_PHOTO_SIDE, PHOTO_ENDINGS, PHOTO_SIDE, PictureError, Rgb, brightness_and_colors, brightness_row,
    encode_jpeg, is_picture, of_photo, photo_pixels,
};
use crate::picture::decode;

/// Formats without loss.
const LOSSLESS: [ImageFormat; 4] = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::WebP, ImageFormat::Tiff];

fn gradient() -> Rgb {
    let pixels = (0..32 * 24).flat_map(|i| [(i % 32) * 8, (i / 32) * 10, 128]).map(|v| v as u8).collect();
    Rgb { width: 32, height: 24, pixels }
}

/// The file of a picture. A TIFF has this orientation, from 1 (upright) to 8; other formats have none.
fn file(rgb: &Rgb, format: ImageFormat, orientation: u16) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    if format == ImageFormat::Tiff {
        let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
        let mut image = encoder.new_image::<colortype::RGB8>(rgb.width, rgb.height).unwrap();
        image.encoder().write_tag(Tag::Orientation, orientation).unwrap();
        image.write_data(&rgb.pixels).unwrap();
    } else {
        let image = RgbImage::from_raw(rgb.width, rgb.height, rgb.pixels.clone()).unwrap();
        DynamicImage::ImageRgb8(image).write_to(&mut bytes, format).unwrap();
    }
    bytes.into_inner()
}

/// EXIF data with one entry: the orientation.
fn exif(orientation: u8) -> Vec<u8> {
    let mut data = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01".to_vec();
    data.extend([0, orientation, 0, 0]);
    data
}

/// A chunk of a RIFF file.
fn riff_chunk(name: &[u8], data: &[u8]) -> Vec<u8> {
    let length = u32::try_from(data.len()).unwrap().to_le_bytes();
    [name, &length, data, &vec![0; data.len() % 2]].concat()
}

/// A WebP of chunks that begin with its header: its kind and its size in pixels.
fn webp(flags: u8, rgb: &Rgb, chunks: &[Vec<u8>]) -> Vec<u8> {
    let side = |pixels: u32| (pixels - 1).to_le_bytes();
    let size = [&side(rgb.width)[..3], &side(rgb.height)[..3]].concat();
    let header = riff_chunk(b"VP8X", &[&[flags, 0, 0, 0][..], &size].concat());
    riff_chunk(b"RIFF", &[b"WEBP".to_vec(), header, chunks.concat()].concat())
}

/// The chunk of a picture in a WebP.
fn webp_picture(rgb: &Rgb) -> Vec<u8> {
    let file = file(rgb, ImageFormat::WebP, 1);
    assert_eq!(&file[12..16], b"VP8L");
    file[12..].to_vec()
}

#[test]
fn a_photo_becomes_a_picture_of_bounded_size() {
    let photo = RgbImage::from_fn(2000, 1000, |x, y| image::Rgb([(x / 8) as u8, (y / 4) as u8, 7]));
    let mut bytes = Cursor::new(Vec::new());
    photo.write_to(&mut bytes, ImageFormat::Png).unwrap();
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
    let mut bytes = Cursor::new(Vec::new());
    wide.write_to(&mut bytes, ImageFormat::Png).unwrap();
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
    let mut bytes = Cursor::new(Vec::new());
    map.write_to(&mut bytes, ImageFormat::Png).unwrap();
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
fn all_formats_show_the_same() {
    let rgb = gradient();
    for format in LOSSLESS {
        let bytes = file(&rgb, format, 1);
        assert!(is_picture(&bytes), "{format:?}");
        assert_eq!(photo_pixels(&bytes).unwrap(), rgb, "{format:?}");
        let (brightness, colors) = brightness_and_colors(&bytes).unwrap();
        assert_eq!((colors, brightness.is_stretched), (Some(rgb.clone()), false), "{format:?}");
        let ending = format.extensions_str()[0];
        assert!(PHOTO_ENDINGS.contains(&ending), "{ending}");
    }
    for table in [&b"BM,speed,force\n1,2,3"[..], b"MM,1", b"RIFF\0\0\0\0WAVE"] {
        assert!(!is_picture(table));
    }
}

/// A height map in a format without gray values is none of a photo.
#[test]
fn gray_pictures_have_no_colors_in_any_format() {
    let pixels = (0..9 * 7).flat_map(|i| [4 * i; 3]).collect();
    let rgb = Rgb { width: 9, height: 7, pixels };
    for format in [ImageFormat::Bmp, ImageFormat::WebP] {
        let (brightness, colors) = brightness_and_colors(&file(&rgb, format, 1)).unwrap();
        assert!(colors.is_none() && !brightness.is_colored, "{format:?}");
        assert!(brightness.values.iter().zip(0..).all(|(level, i)| *level == 257 * 4 * i), "{format:?}");
    }
}

/// Each orientation is its definition in EXIF: which side of the scene the first row and the first column are.
#[test]
fn photos_are_turned_upright() {
    let (width, height) = (3_usize, 2_usize);
    let stored = |row: usize, column: usize| (10 * row + column) as u8;
    let pixels = (0..6).flat_map(|i| [stored(i / 3, i % 3), 100, 200]).collect();
    let rgb = Rgb { width: 3, height: 2, pixels };
    for orientation in 1_u8..=8 {
        // The pixel of the file that is at (x, y) of the upright photo.
        let at = |x: usize, y: usize| match orientation {
            1 => stored(y, x),
            2 => stored(y, width - 1 - x),
            3 => stored(height - 1 - y, width - 1 - x),
            4 => stored(height - 1 - y, x),
            5 => stored(x, y),
            6 => stored(height - 1 - x, y),
            7 => stored(height - 1 - x, width - 1 - y),
            _ => stored(x, width - 1 - y),
        };
        let (w, h) = if orientation < 5 { (width, height) } else { (height, width) };
        let upright = (0..h).flat_map(|y| (0..w).flat_map(move |x| [at(x, y), 100, 200])).collect();
        let expected = Rgb { width: w as u32, height: h as u32, pixels: upright };
        let tiff = file(&rgb, ImageFormat::Tiff, u16::from(orientation));
        assert_eq!(photo_pixels(&tiff).unwrap(), expected, "TIFF, {orientation}");
        let webp = webp(0x08, &rgb, &[webp_picture(&rgb), riff_chunk(b"EXIF", &exif(orientation))]);
        assert_eq!(photo_pixels(&webp).unwrap(), expected, "WebP, {orientation}");
        let png = png_with_exif(&rgb, orientation);
        assert_eq!(photo_pixels(&png).unwrap(), expected, "PNG, {orientation}");
    }
    // A JPEG is turned too: its upper half becomes its right half.
    let halves = (0..32 * 16).flat_map(|i| [if i < 32 * 8 { 250 } else { 5 }; 3]).collect();
    let jpeg = encode_jpeg(&Rgb { width: 32, height: 16, pixels: halves }, 20.0).unwrap().bytes;
    let data = [b"Exif\0\0".to_vec(), exif(6)].concat();
    let length = u16::try_from(data.len() + 2).unwrap().to_be_bytes();
    let turned = photo_pixels(&[&jpeg[..2], &[0xFF, 0xE1], &length, &data, &jpeg[2..]].concat()).unwrap();
    assert_eq!((turned.width, turned.height), (16, 32));
    assert!(turned.pixels[0] < 60 && turned.pixels[3 * 15] > 200, "{:?}", &turned.pixels[..48]);
}

/// A PNG with the orientation in a chunk before the image.
fn png_with_exif(rgb: &Rgb, orientation: u8) -> Vec<u8> {
    let bytes = file(rgb, ImageFormat::Png, 1);
    let named = [b"eXIf".to_vec(), exif(orientation)].concat();
    let length = u32::try_from(named.len() - 4).unwrap().to_be_bytes();
    let sum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&named).to_be_bytes();
    // Behind the signature and the header.
    let (begin, rest) = bytes.split_at(8 + 25);
    [begin, &length, &named, &sum, rest].concat()
}

#[test]
fn of_an_animation_the_first_frame_counts() {
    let [first, second] = [[200, 30, 40], [10, 200, 90]].map(|color: [u8; 3]| {
        let pixels = (0..8 * 6).flat_map(|i| color.map(|level| level + i)).collect();
        Rgb { width: 8, height: 6, pixels }
    });
    let frame = |rgb: &Rgb| {
        // Position, width and height minus one, duration, and flags: no blending.
        let place = [0, 0, 0, 0, 0, 0, 7, 0, 0, 5, 0, 0, 100, 0, 0, 2];
        riff_chunk(b"ANMF", &[&place[..], &webp_picture(rgb)].concat())
    };
    let animation = riff_chunk(b"ANIM", &[0, 0, 0, 255, 0, 0]);
    let bytes = webp(0x02, &first, &[animation, frame(&first), frame(&second)]);
    assert_eq!(photo_pixels(&bytes).unwrap(), first);
}

#[test]
fn files_that_are_cut_off_are_no_photos() {
    for format in LOSSLESS {
        let whole = file(&gradient(), format, 1);
        // The last bytes are checksums and padding.
        for end in 0..whole.len() * 3 / 4 {
            let cut = photo_pixels(&whole[..end]);
            assert!(cut.is_err(), "{format:?} cut to {end} of {} bytes", whole.len());
        }
        let half = photo_pixels(&whole[..whole.len() / 2]).unwrap_err();
        let is_named = matches!(half, PictureError::CutOff);
        assert!(is_named || format == ImageFormat::Png, "{format:?}: {half}");
    }
}

#[test]
fn small_files_that_state_huge_pictures_are_refused() {
    let mut bmp = file(&gradient(), ImageFormat::Bmp, 1);
    let side = |pixels: i32| pixels.to_le_bytes();
    bmp[18..26].copy_from_slice(&[side(9000), side(9000)].concat());
    let refused = of_photo(&bmp, 20.0);
    assert!(matches!(refused, Err(PictureError::TooLarge { width: 9000, .. })), "{refused:?}");
    bmp[18..26].copy_from_slice(&[side(20_000), side(1)].concat());
    assert!(matches!(of_photo(&bmp, 20.0), Err(PictureError::LargePhoto)));
    let rgb = gradient();
    let large = Rgb { width: 12_000, height: 12_000, pixels: Vec::new() };
    let refused = of_photo(&webp(0, &large, &[webp_picture(&rgb)]), 20.0);
    assert!(matches!(refused, Err(PictureError::LargePhoto)), "{refused:?}");
}

/// Whatever the bytes are, there is a picture or an error.
#[test]
fn damaged_photos_give_an_error_or_a_picture() {
    const N_INPUTS: usize = 150;
    let rgb = Rgb { width: 12, height: 8, pixels: gradient().pixels[..12 * 8 * 3].to_vec() };
    for format in LOSSLESS {
        let seed = file(&rgb, format, 1);
        let mut random = Random::new(5);
        for input in 0..N_INPUTS {
            let mut bytes = seed.clone();
            for _ in 0..=input % 3 {
                let at = (random.next_u64() % bytes.len() as u64) as usize;
                bytes[at] = random.next_u64() as u8;
            }
            if let Ok(picture) = of_photo(&bytes, 20.0) {
                assert!(picture.width.max(picture.height) <= PHOTO_SIDE);
            }
            let _ = brightness_row(&bytes, None);
        }
    }
}
