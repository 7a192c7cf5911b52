use std::f64::consts::TAU;
use std::io::Cursor;

use image::{ImageBuffer, ImageFormat, Luma, Rgb};
use shagreen_core::texture::height_map::{HeightMap, HeightMapError, HeightMapOptions};
use shagreen_core::units::{Hertz, Newtons};

use super::{HeightPictureError, HeightScale, PictureTile, overlaps};
use crate::picture::decode;

const SCALE: HeightScale = HeightScale { side_m: 0.04, height_m: 1e-4 };
const OPTIONS: HeightMapOptions = HeightMapOptions::HARD_PLASTIC;

/// A height map, and how it was made.
#[derive(Debug)]
struct Made {
    map: HeightMap,
    is_seamless: bool,
    is_colored: bool,
}

fn height_picture(
    bytes: &[u8],
    scale: HeightScale,
    options: HeightMapOptions,
) -> Result<Made, HeightPictureError> {
    let tile = PictureTile::read(bytes)?;
    let map = tile.height_map(scale, options)?;
    Ok(Made { map, is_seamless: tile.is_seamless, is_colored: tile.is_colored })
}

/// A 16-bit gray PNG of a brightness from 0 to 1.
fn png(width: u32, height: u32, brightness: impl Fn(f64, f64) -> f64) -> Vec<u8> {
    let level = |x: u32, y: u32| (65_535.0 * brightness(f64::from(x), f64::from(y))).round() as u16;
    let map = ImageBuffer::from_fn(width, height, |x, y| Luma([level(x, y)]));
    let mut bytes = Cursor::new(Vec::new());
    map.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Largest step between neighbors, across the edges of the tile and inside it.
fn steps(heights_m: &[f64]) -> [f64; 2] {
    let n = heights_m.len().isqrt();
    let step = |from: usize, to: usize| {
        let lines = (0..n).flat_map(|line| {
            [
                heights_m[line * n + to] - heights_m[line * n + from],
                heights_m[to * n + line] - heights_m[from * n + line],
            ]
        });
        lines.fold(0.0_f64, |most, step| most.max(step.abs()))
    };
    [step(n - 1, 0), (1..n).map(|to| step(to - 1, to)).fold(0.0, f64::max)]
}

/// A tile keeps its heights; its first row is the lowest one of the picture.
#[test]
fn a_seamless_picture_is_the_tile() {
    let wave = |x: f64, y: f64| 0.5 + 0.2 * (TAU * (3.0 * x - 2.0 * y) / 64.0).cos();
    let made = height_picture(&png(64, 64, wave), SCALE, OPTIONS).unwrap();
    assert!(made.is_seamless && !made.is_colored);
    assert_eq!((made.map.n(), made.map.side_m()), (64, 0.04));
    for (index, height_m) in made.map.heights_m().iter().enumerate() {
        let (x, y) = ((index % 64) as f64, 63.0 - (index / 64) as f64);
        // Half a step of 16 bits.
        assert!((height_m - 1e-4 * (wave(x, y) - 0.5)).abs() < 1e-9);
    }
}

/// Eye and hand agree: the heights at (x, y) are those of the pixel at (x, y), and a tip that passes it is accelerated
/// downwards there.
#[test]
fn a_bump_is_felt_where_it_is_seen() {
    // A bump in the upper left of a picture that is wider than high: only its central square counts.
    let (column, row) = (60.0, 40.0);
    let bump = |x: f64, y: f64| {
        let distance = (x - 64.0 - column).hypot(y - row);
        (-0.5 * (distance / 6.0).powi(2)).exp()
    };
    let map = height_picture(&png(384, 256, bump), SCALE, OPTIONS).unwrap().map;
    assert_eq!((map.n(), map.side_m()), (256, 0.04));
    let highest = (0..256 * 256).max_by(|a, b| map.heights_m()[*a].total_cmp(&map.heights_m()[*b])).unwrap();
    assert_eq!((highest % 256, highest / 256), (60, 255 - 40));
    let pixel_m = 0.04 / 256.0;
    let (x_m, y_m) = (pixel_m * column, pixel_m * (255.0 - row));
    for axis in [0, 1] {
        let path_m: Vec<[f64; 2]> = (0..60)
            .map(|i| {
                let along_m = 5e-5 * f64::from(i - 30);
                if axis == 0 { [x_m + along_m, y_m] } else { [x_m, y_m + along_m] }
            })
            .collect();
        let felt = map.acceleration(&path_m, Newtons(1.0), Hertz(1000.0));
        let lowest = (0..60).min_by(|a, b| felt[*a].total_cmp(&felt[*b])).unwrap();
        let off_m = path_m[lowest][axis] - [x_m, y_m][axis];
        assert!(off_m.abs() < 0.6 * pixel_m && felt[lowest] < 0.0, "off by {off_m} m along axis {axis}");
    }
}

/// A photo with a slope of brightness and other edges gets none of both at its edges, and keeps its middle.
#[test]
fn other_pictures_lose_their_plane_and_their_edges() {
    let wave = |x: f64, y: f64| 0.1 * (TAU * x / 57.0).sin() + 0.1 * (TAU * y / 83.0).cos();
    let photo = |x: f64, y: f64| 0.5 + 0.001 * (x - 144.0) - 0.0007 * (y - 144.0) + wave(x, y);
    let made = height_picture(&png(288, 288, photo), SCALE, OPTIONS).unwrap();
    assert!(!made.is_seamless);
    assert_eq!(made.map.n(), 256);
    assert!((made.map.side_m() - 0.04 * 8.0 / 9.0).abs() < 1e-15);
    let heights_m = made.map.heights_m();
    let [across, inside] = steps(heights_m);
    assert!(across < 1.2 * inside, "{across} m across the edges, {inside} m inside");
    // Outside of the border, the heights are the waves, except for a plane: the waves themselves have a small slope.
    let error = |x: usize, y: usize| heights_m[(255 - y) * 256 + x] - 1e-4 * wave(x as f64, y as f64 + 32.0);
    let [a, b, c, d] = [(60, 20), (240, 20), (60, 200), (240, 200)].map(|(x, y)| error(x, y));
    assert!((a - b - c + d).abs() < 2e-8, "{}", a - b - c + d);
    assert!([a, b, c, d].iter().all(|error| error.abs() < 1e-5), "{a} {b} {c} {d}");
    // The same photo in color: brightness is the height.
    let mut bytes = Cursor::new(Vec::new());
    let colored =
        ImageBuffer::from_fn(288, 288, |x, y| Rgb([(photo(f64::from(x), f64::from(y)) * 255.0) as u8; 3]));
    colored.write_to(&mut bytes, ImageFormat::Png).unwrap();
    let made = height_picture(bytes.get_ref(), SCALE, OPTIONS).unwrap();
    assert!(made.is_colored);
    for (a, b) in made.map.heights_m().iter().zip(heights_m) {
        // One step of 8 bits.
        assert!((a - b).abs() < 1e-4 / 255.0 * 1.5, "{a} is not {b}");
    }
}

/// The picture of a tile shows its heights where they are, in the colors of the photo.
#[test]
fn the_picture_of_a_tile_is_cut_as_its_heights() {
    let bump = |x: f64, y: f64| (-0.5 * ((x - 40.0).hypot(y - 90.0) / 9.0).powi(2)).exp();
    let tile = PictureTile::read(&png(128, 128, bump)).unwrap();
    let picture = tile.picture(0.04).unwrap();
    assert!(tile.is_seamless && (picture.millimeters - 40.0).abs() < 1e-9);
    let rgb = decode(&picture).unwrap();
    let brightest = (0..128 * 128).max_by_key(|pixel| rgb.pixels[3 * pixel]).unwrap();
    let (x, y) = (brightest % 128, brightest / 128);
    // The compression may move the middle of a smooth bump by some pixels.
    assert!(x.abs_diff(40) <= 3 && y.abs_diff(90) <= 3, "{x}, {y}");
    let slope = ImageBuffer::from_fn(90, 144, |x, y| Rgb([200, (x + y) as u8, 20]));
    let mut bytes = Cursor::new(Vec::new());
    slope.write_to(&mut bytes, ImageFormat::Png).unwrap();
    let tile = PictureTile::read(bytes.get_ref()).unwrap();
    let picture = tile.picture(0.045).unwrap();
    assert_eq!((tile.is_seamless, tile.is_colored, picture.width), (false, true, 64));
    assert!((picture.millimeters - 40.0).abs() < 1e-9);
    let rgb = decode(&picture).unwrap();
    let mean = |color: usize| {
        let values = rgb.pixels.iter().skip(color).step_by(3);
        values.map(|value| f64::from(*value)).sum::<f64>() / 4096.0
    };
    // The middle of the green slope is that of the central square.
    assert!((mean(0) - 200.0).abs() < 3.0 && (mean(1) - 116.0).abs() < 12.0 && (mean(2) - 20.0).abs() < 3.0);
}

/// Pictures of any size are averaged: every pixel counts with its area.
#[test]
fn cells_are_means_over_their_pixels() {
    for (side, n) in [(18, 16), (100, 64), (64, 64), (1000, 256), (999, 288)] {
        let mut cells = vec![0.0; n];
        for pixel in 0..side {
            let parts = overlaps(pixel, side, n);
            assert!((parts[0].1 + parts[1].1 - n as f64 / side as f64).abs() < 1e-12);
            for (cell, share) in parts {
                cells[cell] += share;
            }
        }
        assert!(cells.iter().all(|sum| (sum - 1.0).abs() < 1e-12), "{side} pixels in {n} cells");
    }
    // Stripes of two pixels: little of them is left in means over six pixels, whereas picked pixels would keep them.
    let stripes = |x: f64, _: f64| if (x / 2.0).floor() % 2.0 == 0.0 { 0.2 } else { 0.8 };
    let made = height_picture(&png(1600, 1600, stripes), SCALE, OPTIONS).unwrap();
    let highest = made.map.heights_m().iter().copied().fold(0.0, f64::max);
    assert_eq!(made.map.n(), 256);
    assert!(highest < 0.15 * 0.6e-4, "{highest}");
}

#[test]
fn what_is_no_height_map_is_named() {
    let fails = |bytes: &[u8], scale| height_picture(bytes, scale, OPTIONS).unwrap_err();
    let noise = |x: f64, y: f64| (0.37 * x + 0.71 * y * y).fract();
    assert!(matches!(fails(&png(17, 40, noise), SCALE), HeightPictureError::Small { pixels: 17 }));
    assert!(matches!(fails(&png(40, 40, |_, _| 0.3), SCALE), HeightPictureError::Flat));
    assert!(matches!(fails(b"GIF89a", SCALE), HeightPictureError::Picture(_)));
    for height_m in [0.0, -1e-4, f64::NAN] {
        let error = fails(&png(40, 40, noise), HeightScale { height_m, ..SCALE });
        assert!(matches!(error, HeightPictureError::Height { .. }));
    }
    let error = fails(&png(40, 40, noise), HeightScale { side_m: 3.0, ..SCALE });
    assert!(matches!(error, HeightPictureError::Map(HeightMapError::Side { .. })));
    let error = fails(&png(40, 40, noise), HeightScale { height_m: 0.1, ..SCALE });
    assert!(matches!(error, HeightPictureError::Map(HeightMapError::Height { .. })));
    assert!(height_picture(&png(18, 18, noise), SCALE, OPTIONS).is_ok_and(|made| made.map.n() == 16));
}
