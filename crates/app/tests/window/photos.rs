//! Photos and height maps in all formats that are read, dropped on the window.

use std::f32::consts::TAU;
use std::io::Cursor;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use image::{DynamicImage, ImageFormat, RgbImage};
use shagreen_app::strings::relief as words;
use shagreen_formats::picture::{Rgb, decode};
use shagreen_formats::starter::starter_library;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::{Gray32Float, RGB8};

use crate::support::{Author, author, click, drop_files, says, wait, window};

/// The picture of brick.
fn brick() -> Rgb {
    let library = starter_library().unwrap();
    let texture = &library.textures[library.index_of("brick").unwrap()];
    decode(texture.picture.as_ref().unwrap()).unwrap()
}

fn land(harness: &mut Author, name: &str, bytes: &[u8]) {
    let n = window(harness).project().authored.len();
    drop_files(harness, &[(name, bytes)]);
    click(harness, words::FIND_POINT);
    wait(harness, "it landed", |h| window(h).project().authored.len() == n + 1);
    harness.run_steps(4);
}

#[test]
fn photos_in_all_formats_find_the_same_place() {
    let Rgb { width, height, pixels } = brick();
    let mut tiff = Cursor::new(Vec::new());
    TiffEncoder::new(&mut tiff).unwrap().write_image::<RGB8>(width, height, &pixels).unwrap();
    let image = DynamicImage::ImageRgb8(RgbImage::from_raw(width, height, pixels).unwrap());
    let mut harness = author();
    let formats = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::WebP].map(|format| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        (format!("a wall.{}", format.extensions_str()[0]), bytes.into_inner())
    });
    for (name, bytes) in formats.into_iter().chain([("a wall.TIF".to_owned(), tiff.into_inner())]) {
        land(&mut harness, &name, &bytes);
    }
    let landed = &window(&harness).project().authored[1..];
    assert!(landed.iter().all(|texture| texture.at == landed[0].at && texture.picture == landed[0].picture));
}

#[test]
fn a_tiff_of_measured_heights_becomes_a_relief() {
    let heights: Vec<f32> = (0..64 * 64).map(|i| 1.5 + 0.01 * (TAU * (i % 64) as f32 / 16.0).cos()).collect();
    let mut tiff = Cursor::new(Vec::new());
    TiffEncoder::new(&mut tiff).unwrap().write_image::<Gray32Float>(64, 64, &heights).unwrap();
    let mut harness = author();
    drop_files(&mut harness, &[("measured.tiff", tiff.get_ref())]);
    click(&mut harness, &words::use_as_relief("New texture"));
    wait(&mut harness, "it is said what the heights rest on", |h| says(h, "µm (highest)"));
    let can_apply = |h: &Author| {
        h.query_by_label(words::APPLY).is_some_and(|button| !button.accesskit_node().is_disabled())
    };
    wait(&mut harness, "the relief is computed", can_apply);
}
