use std::io::Cursor;

use image::DynamicImage;
use tiff::encoder::colortype::{
    CMYK8, ColorType, Gray8, Gray16, Gray32, Gray32Float, Gray64Float, GrayI16, RGB8, RGB16, RGB32Float,
    RGBA8,
};
use tiff::encoder::{Compression, TiffEncoder, TiffValue};

use super::{MAX_PHOTO_SIDE, PictureError, tiff_photo};

fn encoded<C: ColorType>(width: u32, height: u32, samples: &[C::Inner], compression: Compression) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap().with_compression(compression);
    encoder.write_image::<C>(width, height, samples).unwrap();
    bytes.into_inner()
}

fn plain<C: ColorType>(width: u32, height: u32, samples: &[C::Inner]) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    encoded::<C>(width, height, samples, Compression::Uncompressed)
}

/// A TIFF of tags with 16-bit values, and of strips with equal lengths, written out here as an oracle of the encoder.
fn by_hand(tags: &[(u16, &[u16])], n_strips: u16, data: &[u8]) -> Vec<u8> {
    let strip_bytes = u16::try_from(data.len()).unwrap() / n_strips;
    let mut tags: Vec<(u16, Vec<u16>)> = tags.iter().map(|(tag, values)| (*tag, values.to_vec())).collect();
    let n_tags = tags.len() + 2;
    let outside = 8 + 2 + 12 * n_tags + 4;
    let is_outside = |values: &[u16]| values.len() > 2;
    let n_strip_values = usize::from(n_strips);
    tags.push((279, vec![strip_bytes; n_strip_values]));
    tags.push((273, vec![0; n_strip_values]));
    let n_outside: usize =
        tags.iter().filter(|(_, values)| is_outside(values)).map(|(_, values)| 2 * values.len()).sum();
    let data_begin = u16::try_from(outside + n_outside).unwrap();
    tags.pop();
    tags.push((273, (0..n_strips).map(|strip| data_begin + strip * strip_bytes).collect()));
    tags.sort();
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    bytes.extend(u16::try_from(n_tags).unwrap().to_le_bytes());
    let mut behind = Vec::new();
    for (tag, values) in &tags {
        let raw: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        bytes.extend(tag.to_le_bytes());
        bytes.extend(3_u16.to_le_bytes());
        bytes.extend(u32::try_from(values.len()).unwrap().to_le_bytes());
        if is_outside(values) {
            bytes.extend(u32::try_from(outside + behind.len()).unwrap().to_le_bytes());
            behind.extend(raw);
        } else {
            bytes.extend(raw.iter().copied().chain([0; 4]).take(4));
        }
    }
    bytes.extend([0; 4]);
    [bytes, behind, data.to_vec()].concat()
}

/// Gray levels of 16 bits, and whether they were stretched.
fn levels(bytes: &[u8]) -> (Vec<u16>, bool) {
    let photo = tiff_photo(bytes).unwrap();
    let DynamicImage::ImageLuma16(levels) = photo.photo else { panic!("{:?}", photo.photo.color()) };
    (levels.into_raw(), photo.is_stretched)
}

fn failure(bytes: &[u8]) -> PictureError {
    tiff_photo(bytes).map(|photo| photo.photo.color()).unwrap_err()
}

/// Whole numbers of up to 16 bits count from black to white, whatever values occur.
#[test]
fn gray_values_of_8_and_16_bits_stay_as_they_are() {
    let values: Vec<u16> = (0..7 * 5).map(|i| 300 + 1000 * i).collect();
    for compression in [Compression::Uncompressed, Compression::Lzw, Compression::Packbits] {
        assert_eq!(levels(&encoded::<Gray16>(7, 5, &values, compression)), (values.clone(), false));
    }
    let values: Vec<u8> = (0..7 * 5).map(|i| 10 + 4 * i).collect();
    let photo = tiff_photo(&plain::<Gray8>(7, 5, &values)).unwrap();
    let DynamicImage::ImageLuma8(levels) = photo.photo else { panic!("{:?}", photo.photo.color()) };
    assert_eq!((levels.into_raw(), photo.is_stretched), (values, false));
}

/// Numbers without a black and a white of their own: the level is (value - lowest) / (highest - lowest) of 65,535.
#[test]
fn other_numbers_are_stretched_from_the_lowest_to_the_highest() {
    let heights: Vec<f64> = (0..9 * 4).map(|i| -0.012 + 0.003 * f64::from(i * i % 25)).collect();
    let (low, high) = (-0.012, -0.012 + 0.003 * 24.0);
    let expected = |x: f64| (65_535.0 * (x - low) / (high - low)).round();
    let check = |bytes: &[u8], heights: &[f64], slack: f64| {
        let (levels, is_stretched) = levels(bytes);
        assert!(is_stretched && levels.len() == heights.len());
        for (level, height) in levels.iter().zip(heights) {
            assert!((f64::from(*level) - expected(*height)).abs() <= slack, "{level} for {height}");
        }
        assert_eq!((levels.iter().min(), levels.iter().max()), (Some(&0), Some(&65_535)));
    };
    check(&plain::<Gray64Float>(9, 4, &heights), &heights, 1.0);
    let singles: Vec<f32> = heights.iter().map(|height| *height as f32).collect();
    check(&plain::<Gray32Float>(9, 4, &singles), &heights, 1.0);
    // Whole multiples of 3 mm from -12 mm: the same heights.
    let steps: Vec<i32> = (0..9 * 4).map(|i| i * i % 25 - 4).collect();
    let signed: Vec<i16> = steps.iter().map(|step| *step as i16).collect();
    check(&plain::<GrayI16>(9, 4, &signed), &heights, 1.0);
    let wide: Vec<u32> = steps.iter().map(|step| 3_000_000_000 + 1000 * (step + 4) as u32).collect();
    check(&plain::<Gray32>(9, 4, &wide), &heights, 1.0);
    let flat = levels(&plain::<Gray32Float>(2, 1, &[5.0, 5.0]));
    assert_eq!(flat, (vec![0, 0], true));
    // Half precision, which the encoder does not write: 0, 1, -2 and 0.5.
    let halves = [0x0000_u16, 0x3C00, 0xC000, 0x3800].map(u16::to_le_bytes).concat();
    let tags: [(u16, &[u16]); 7] =
        [(256, &[4]), (257, &[1]), (258, &[16]), (259, &[1]), (262, &[1]), (278, &[1]), (339, &[3])];
    assert_eq!(levels(&by_hand(&tags, 1, &halves)), (vec![43_690, 65_535, 0, 54_613], true));
}

#[test]
fn places_without_a_measurement_are_no_heights() {
    for gap in [f32::NAN, f32::INFINITY, f32::MIN] {
        let error = failure(&plain::<Gray32Float>(3, 1, &[1.0, gap, 2.0]));
        assert!(matches!(error, PictureError::Gaps), "{error}");
        assert!(error.to_string().contains("fill these gaps"), "{error}");
    }
}

#[test]
fn colors_of_8_and_16_bits_are_read_without_transparency() {
    let pixels: Vec<u8> = (0..5 * 3 * 3).map(|i| 5 * i).collect();
    let rgb = |bytes: &[u8]| match tiff_photo(bytes).unwrap().photo {
        DynamicImage::ImageRgb8(photo) => photo.into_raw(),
        photo => panic!("{:?}", photo.color()),
    };
    assert_eq!(rgb(&plain::<RGB8>(5, 3, &pixels)), pixels);
    let clear: Vec<u8> = pixels.chunks(3).flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 7]).collect();
    assert_eq!(rgb(&plain::<RGBA8>(5, 3, &clear)), pixels);
    let wide: Vec<u16> = pixels.iter().map(|level| 257 * u16::from(*level)).collect();
    let photo = tiff_photo(&plain::<RGB16>(5, 3, &wide)).unwrap();
    let DynamicImage::ImageRgb16(photo) = photo.photo else { panic!("{:?}", photo.photo.color()) };
    assert_eq!(photo.into_raw(), wide);
    // Each channel as an image of its own.
    let planes: Vec<u8> = (0..3).flat_map(|c| pixels.iter().skip(c).step_by(3).copied()).collect();
    let tags: [(u16, &[u16]); 8] = [
        (256, &[5]),
        (257, &[3]),
        (258, &[8, 8, 8]),
        (259, &[1]),
        (262, &[2]),
        (277, &[3]),
        (278, &[3]),
        (284, &[2]),
    ];
    assert_eq!(rgb(&by_hand(&tags, 3, &planes)), pixels);
}

#[test]
fn packed_bits_become_levels() {
    let of = |bits: u16, width: u16, row: &[u8]| {
        let tags: [(u16, &[u16]); 6] =
            [(256, &[width]), (257, &[1]), (258, &[bits]), (259, &[1]), (262, &[1]), (278, &[1])];
        match tiff_photo(&by_hand(&tags, 1, row)).unwrap().photo {
            DynamicImage::ImageLuma8(photo) => photo.into_raw(),
            photo => panic!("{:?}", photo.color()),
        }
    };
    assert_eq!(of(1, 10, &[0b1010_0001, 0b1000_0000]), [255, 0, 255, 0, 0, 0, 0, 255, 255, 0]);
    assert_eq!(of(2, 4, &[0b0001_1011]), [0, 85, 170, 255]);
    assert_eq!(of(4, 3, &[0x0F, 0x70]), [0, 255, 119]);
}

#[test]
fn variants_that_are_not_read_are_named() {
    let check = |bytes: &[u8], words: &str| {
        let error = failure(bytes).to_string();
        assert!(error.contains(words) && error.contains("save it as PNG"), "{error}");
    };
    check(&plain::<CMYK8>(2, 1, &[1, 2, 3, 4, 5, 6, 7, 8]), "printing colors (CMYK)");
    check(&plain::<RGB32Float>(1, 1, &[0.5, 0.5, 0.5]), "colors that are not 8 or 16 bits");
    let colors = [0; 3 * 256];
    let palette: [(u16, &[u16]); 7] =
        [(256, &[2]), (257, &[1]), (258, &[8]), (259, &[1]), (262, &[3]), (278, &[1]), (320, &colors)];
    check(&by_hand(&palette, 1, &[1, 2]), "a color palette");
    let odd: [(u16, &[u16]); 6] =
        [(256, &[2]), (257, &[1]), (258, &[8]), (259, &[9999]), (262, &[1]), (278, &[1])];
    check(&by_hand(&odd, 1, &[1, 2]), "a compression that is not common");
}

#[test]
fn sizes_are_checked_before_anything_is_decoded() {
    let of = |width: u16, height: u16| {
        let tags: [(u16, &[u16]); 6] =
            [(256, &[width]), (257, &[height]), (258, &[8]), (259, &[1]), (262, &[1]), (278, &[height])];
        failure(&by_hand(&tags, 1, &[0; 64]))
    };
    let most = u16::try_from(MAX_PHOTO_SIDE).unwrap();
    assert!(matches!(of(most + 1, 1), PictureError::LargePhoto));
    assert!(matches!(of(most, most), PictureError::TooLarge { .. }));
    assert!(matches!(of(100, 100), PictureError::CutOff));
}
