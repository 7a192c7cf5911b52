use super::{
    PictureError, PictureFormat, Rgb, brightness_row, check, decode, encode_heights, encode_jpeg,
    encode_levels, encode_png, recompressed,
};

fn gradient() -> Rgb {
    let pixels = (0..32 * 24).flat_map(|i| [(i % 32) * 8, (i / 32) * 10, 128]).map(|v| v as u8).collect();
    Rgb { width: 32, height: 24, pixels }
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
    assert!(brightness_row(&encode_heights(&[1.0; 4], 2).unwrap(), None).unwrap().iter().all(|x| *x == 0.0));
    assert!(matches!(encode_heights(&heights, 63), Err(PictureError::Size { .. })));
    let levels = [0, 1, 40_000, u16::MAX];
    let row = brightness_row(&encode_levels(&levels, 2).unwrap(), Some(1)).unwrap();
    assert!((row[0] - 40_000.0 / 65_535.0).abs() < 1e-12 && row[1] == 1.0, "{row:?}");
    assert!(matches!(encode_levels(&levels, 4), Err(PictureError::Size { .. })));

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
    let error: f64 = back.pixels.iter().zip(gradient().pixels).map(|(a, b)| f64::from(a.abs_diff(b))).sum();
    // At quality 85 a smooth gradient deviates by about one step of 255.
    assert!(error / (back.pixels.len() as f64) < 3.0, "{error}");
}

#[test]
fn compression_loses_more_at_a_lower_quality() {
    let pixels = (0..64 * 64 * 3_usize).map(|i| (i * 7919 % 256) as u8).collect();
    let rgb = Rgb { width: 64, height: 64, pixels };
    let loss = |quality: u8| {
        let after = recompressed(&rgb, quality).unwrap();
        assert_eq!((after.width, after.height), (64, 64));
        after.pixels.iter().zip(&rgb.pixels).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum::<f64>()
    };
    assert!(loss(50) > loss(92) && loss(92) > 0.0);
    assert_eq!(recompressed(&rgb, 85).unwrap(), decode(&encode_jpeg(&rgb, 20.0).unwrap()).unwrap());
    assert!(recompressed(&Rgb { width: 65, ..rgb }, 50).is_err());
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
