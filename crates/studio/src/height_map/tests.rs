use std::cell::RefCell;
use std::io::Cursor;
use std::sync::Arc;

use shagreen_core::texture::shape::{Shape, ShapeControl};
use shagreen_formats::picture::{Rgb, encode_heights, encode_png};
use shagreen_formats::starter::starter_library;
use shagreen_formats::text_limits::MAX_NOTES;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::Gray32Float;

use super::{
    HeightMapOptions, PictureRelief, PictureTile, ReliefPlace, ReliefSize, ReliefSizeError, add_to_texture,
    join_relief, relief, with_relief,
};
use crate::project::new_project;
use crate::report::{Reporter, Warnings};

const SIZE: ReliefSize = ReliefSize { side_mm: 40.0, height_um: 50.0 };

/// A picture of `side` pixels, with a brightness from 0 to 255 at each pixel.
fn tile(side: u32, brightness: impl Fn(u32, u32) -> u8) -> PictureTile {
    let pixels = (0..side * side).flat_map(|i| [brightness(i % side, i / side); 3]).collect();
    PictureTile::read(&encode_png(&Rgb { width: side, height: side, pixels }).unwrap()).unwrap()
}

/// Ridges that fit together at the edges.
fn ridges() -> PictureTile {
    tile(64, |x, _| if (x + 8) % 32 < 16 { 60 } else { 180 })
}

/// A gray picture of ridges that fit together.
fn gray_ridges() -> Vec<u8> {
    let heights: Vec<f64> = (0..64 * 64).map(|i| if (i + 8) % 32 < 16 { 0.0 } else { 1.0 }).collect();
    encode_heights(&heights, 64).unwrap()
}

/// A TIFF of numbers of single precision.
fn float_tiff(side: u32, number: impl Fn(u32, u32) -> f32) -> Vec<u8> {
    let numbers: Vec<f32> = (0..side * side).map(|i| number(i % side, i / side)).collect();
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    encoder.write_image::<Gray32Float>(side, side, &numbers).unwrap();
    bytes.into_inner()
}

fn made(tile: &PictureTile, size: ReliefSize) -> PictureRelief {
    relief(tile, size, HeightMapOptions::HARD_PLASTIC).unwrap()
}

#[test]
fn the_heights_of_a_photo_are_said_to_be_assumed() {
    let said = made(&tile(64, |x, y| (2 * x + y) as u8), SIZE).assumption;
    assert!(said.contains("assumed, not measured") && said.contains("50 µm (white)"), "{said}");
    assert!(said.contains("faded into each other"), "{said}");
    let said = made(&PictureTile::read(&gray_ridges()).unwrap(), SIZE).assumption;
    assert!(!said.contains("assumed") && said.contains("fit together"), "{said}");
}

/// A picture of numbers has no black and white: its lowest and highest number stand for them.
#[test]
fn the_heights_of_numbers_reach_from_the_lowest_to_the_highest() {
    let relief = made(
        &PictureTile::read(&float_tiff(64, |x, _| if (x + 8) % 32 < 16 { -3.5 } else { 4.0 })).unwrap(),
        SIZE,
    );
    assert!(relief.assumption.starts_with("the number in each pixel"), "{}", relief.assumption);
    assert!(relief.assumption.contains("0 µm (lowest) to 50 µm (highest)"), "{}", relief.assumption);
    let heights_m = relief.map.heights_m().iter();
    let [low, high] = [f64::min, f64::max].map(|of| heights_m.clone().copied().fold(0.0, of));
    assert!((high - low - 50e-6).abs() < 1e-12, "{low} to {high}");
}

/// The picture that the pad shows has the width of the tile, so that it is felt where it is seen.
#[test]
fn a_relief_has_its_size_and_its_picture() {
    let relief = made(&ridges(), SIZE);
    assert!((1e3 * relief.map.side_m() - 40.0).abs() < 1e-9 && relief.is_seamless);
    assert!((relief.picture.millimeters - 1e3 * relief.map.side_m()).abs() < 1e-9);
    let highest_m = relief.map.heights_m().iter().copied().fold(0.0, f64::max);
    // Half of the difference between 60 and 180 of 255, to a step of 8 bits.
    assert!((highest_m - 50e-6 * 60.0 / 255.0).abs() < 50e-6 / 255.0, "{highest_m}");
    assert_eq!(relief.warning, None);
}

#[test]
fn sizes_out_of_range_are_named_with_their_value_and_range() {
    let error = |tile: &PictureTile, size| {
        let error = relief(tile, size, HeightMapOptions::HARD_PLASTIC).unwrap_err();
        *error.downcast_ref::<ReliefSizeError>().expect("an error of the size")
    };
    let ridges = ridges();
    for side_mm in [1.0, 1000.5, f64::NAN] {
        let error = error(&ridges, ReliefSize { side_mm, ..SIZE });
        assert!(error.to_string().contains(&format!("{side_mm} mm; it must be 1.2 to 1000 mm")), "{error}");
    }
    for height_um in [0.0, 15_000.0, f64::INFINITY] {
        let error = error(&ridges, ReliefSize { height_um, ..SIZE });
        assert!(error.to_string().contains(&format!("{height_um} µm; it must be 0.01 to 10000")), "{error}");
    }
    // Heights that alternate from sample to sample, 8 µm apart.
    let spikes = tile(256, |x, y| if (x + y) % 2 == 0 { 0 } else { 255 });
    let size = ReliefSize { side_mm: 2.0, height_um: 10_000.0 };
    let ReliefSizeError::Steep { most_um, least_mm, .. } = error(&spikes, size) else {
        panic!("it is too steep")
    };
    let is_possible = |size| relief(&spikes, size, HeightMapOptions::HARD_PLASTIC).is_ok();
    assert!(is_possible(ReliefSize { height_um: most_um, ..size }), "{most_um} µm");
    assert!(is_possible(ReliefSize { side_mm: least_mm, ..size }), "{least_mm} mm");
    // The limits are close to those that are named.
    assert!(!is_possible(ReliefSize { height_um: 1.01 * most_um, ..size }));
    assert!(!is_possible(ReliefSize { side_mm: 0.95 * least_mm, ..size }));
}

#[test]
fn heights_that_no_tip_can_follow_are_warned_of() {
    let steep = made(&ridges(), ReliefSize { side_mm: 2.0, height_um: 1000.0 });
    let said = steep.warning.expect("a cliff");
    assert!(said.contains("slopes of 8") && said.contains("smaller height or a larger side"), "{said}");
}

#[test]
fn a_texture_gets_a_relief_and_a_replaced_one_is_reported() {
    let mut library = starter_library().unwrap();
    let warnings = Warnings::default();
    let relief = made(&ridges(), SIZE);
    let before = library.textures[library.index_of("cork").unwrap()].clone();
    add_to_texture(&mut library, "cork", &relief, &warnings).unwrap();
    let larger = made(&ridges(), ReliefSize { height_um: 70.0, ..SIZE });
    add_to_texture(&mut library, "cork", &larger, &warnings).unwrap();
    let entry = &library.textures[library.index_of("cork").unwrap()];
    assert_eq!(entry.model.height_map().map(|map| map.n()), Some(64));
    assert_eq!(entry.picture.as_ref(), Some(&larger.picture));
    assert_eq!((entry.place, &entry.name), (before.place, &before.name));
    // The description states the last relief only.
    assert!(entry.description.starts_with(&before.description), "{}", entry.description);
    assert!(entry.description.contains("70 µm") && !entry.description.contains("50 µm"));
    let warnings = warnings.into_vec();
    let had_one = before.model.height_map().is_some();
    assert_eq!(warnings.len(), 1 + usize::from(had_one), "{warnings:?}");
    let error = add_to_texture(&mut library, "crok", &relief, &Warnings::default());
    assert!(error.unwrap_err().to_string().contains("did you mean cork?"));
}

/// Collects notes.
#[derive(Default)]
struct Notes(RefCell<Vec<String>>);

impl Reporter for Notes {
    fn warn(&self, _: &str) {}

    fn note(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }
}

#[test]
fn a_replaced_picture_is_noted_and_a_long_description_keeps_what_the_heights_rest_on() {
    let relief = made(&ridges(), SIZE);
    let mut entry = starter_library().unwrap().textures.remove(0);
    entry.model = entry.model.with_height_map(None);
    entry.picture = Some(relief.picture.clone());
    entry.description = "x".repeat(MAX_NOTES);
    let notes = Notes::default();
    let with = with_relief(&entry, &relief, &notes).unwrap();
    assert!(notes.0.borrow()[0].contains("the picture of \"glass\" is replaced"), "{:?}", notes.0);
    assert_eq!(with.description.chars().count(), MAX_NOTES);
    assert!(with.description.ends_with("its edges fit together."));
    entry.picture = None;
    let notes = Notes::default();
    with_relief(&entry, &relief, &notes).unwrap();
    assert!(notes.0.borrow().is_empty());
}

#[test]
fn a_project_gets_a_relief_in_its_place() {
    let library = starter_library().unwrap();
    let of_cork = |height_um| {
        let cork = &library.textures[library.index_of("cork").unwrap()];
        let relief = made(&ridges(), ReliefSize { height_um, ..SIZE });
        Arc::new(with_relief(cork, &relief, &Warnings::default()).unwrap())
    };
    let mut project = new_project();
    join_relief(&mut project, of_cork(50.0), ReliefPlace::Added);
    let larger = of_cork(70.0);
    join_relief(&mut project, Arc::clone(&larger), ReliefPlace::InPlaceOf(0));
    assert_eq!((&project.joined[..], project.solo.as_deref()), (&[larger][..], Some("cork")));
    assert!(project.is_own(0), "a copy with a relief takes part where it is pinned");
    let before = project.clone();
    join_relief(&mut project, of_cork(90.0), ReliefPlace::InPlaceOf(7));
    assert_eq!(project, before, "there is no such texture");
    // An authored texture pins the texture that was made for its point.
    let mut pinned = new_project();
    join_relief(&mut pinned, of_cork(50.0), ReliefPlace::Pinned(1));
    assert!(pinned.texture().blend.locked.contains("cork") && pinned.solo.is_some());
    assert_eq!(pinned.texture().picture, None, "its picture is interpolated from the pinned one");
    // A picture of its own would show another surface than the one that is felt.
    let mut pictured = new_project();
    Arc::make_mut(&mut pictured.authored[0]).picture = library.textures[0].picture.clone().map(Arc::new);
    join_relief(&mut pictured, of_cork(50.0), ReliefPlace::Pinned(1));
    assert_eq!(pictured.texture().picture.as_deref(), pictured.joined[0].picture.as_ref());
    let mut shaped = new_project();
    Arc::make_mut(&mut shaped.authored[0]).shape = Shape::default().with(ShapeControl::Grain, 2.0);
    join_relief(&mut shaped, of_cork(50.0), ReliefPlace::Pinned(1));
    assert_eq!((shaped.joined.len(), &shaped.solo), (1, &None));
}
