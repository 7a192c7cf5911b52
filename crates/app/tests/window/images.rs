//! Parts of the window compared with reference images, in both themes.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p shagreen-app --test window images` writes new references. Inspect them before
//! committing.

pub(crate) mod raster;

use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, pos2};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{SnapshotOptions, SnapshotResults, try_image_snapshot_options};
use shagreen_app::choices::scope::View;
use shagreen_app::choices::signals::Slot;
use shagreen_app::choices::signals::View as Tab;
use shagreen_app::strings;
use shagreen_app::strings::{authored, compare, document, gallery, map, scope, signals};
use shagreen_core::space::heat_map::Quantity;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::gallery::GALLERY;

use self::raster::Raster;
use crate::support::{self, Author, begin, choose, choose_mode, click, says, wait, wait_for_field, window};
use image::RgbaImage;
use image::imageops::crop_imm;

/// Tolerated number of different pixels: other processors rasterize letters slightly differently.
const PIXELS_APART: usize = 12;

/// Window on the second project of the gallery, after its pictures and its field are loaded.
fn drawn() -> Author {
    let project = GALLERY[1].read().unwrap();
    let mut harness = support::drawn_by(Raster::default(), begin(project), [1280.0, 720.0]);
    wait(&mut harness, "the output opens", |h| window(h).session().status().is_some());
    wait_for_field(&mut harness);
    wait(&mut harness, "the pictures are there", |h| {
        let n_textures = window(h).session().textures().len();
        (0..n_textures).all(|texture| window(h).pictures().thumbnail(texture).is_some())
    });
    harness.run_steps(4);
    harness
}

/// Image of an area of the window, with the pointer away from all widgets.
fn part(harness: &mut Author, area: Rect) -> RgbaImage {
    harness.hover_at(pos2(700.0, 705.0));
    // Time for all animations to end.
    harness.run_steps(30);
    wait(harness, "the surface of the pad is made", |h| !window(h).pictures().is_busy());
    harness.run_steps(4);
    let image = harness.render().unwrap();
    let area = area.intersect(Rect::from_min_max(pos2(0.0, 0.0), pos2(1280.0, 720.0)));
    let (min, size) = (area.min.round(), area.size().round());
    crop_imm(&image, min.x as u32, min.y as u32, size.x as u32, size.y as u32).to_image()
}

fn options() -> SnapshotOptions {
    SnapshotOptions::new().max_failed_pixels(PIXELS_APART)
}

/// Compares an area of the window with the reference image of this name.
fn look(harness: &mut Author, results: &mut SnapshotResults, name: &str, area: Rect) {
    results.add(try_image_snapshot_options(&part(harness, area), name, &options()));
}

fn canvas(harness: &Author) -> Rect {
    harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect()
}

fn view(harness: &Author, view: View) -> Rect {
    let plot = harness.get_by_role_and_label(Role::Canvas, scope::view(view)).rect();
    Rect::from_min_max(plot.min - egui::vec2(30.0, 30.0), plot.max + egui::vec2(0.0, 16.0))
}

fn toggle_theme(harness: &mut Author) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::T);
    harness.run_steps(3);
}

const COLUMN: Rect = Rect { min: pos2(0.0, 38.0), max: pos2(208.0, 480.0) };
const INSPECTOR: Rect = Rect { min: pos2(990.0, 38.0), max: pos2(1280.0, 480.0) };

#[test]
fn the_author_workspace_looks_as_it_was_approved() {
    let mut harness = drawn();
    let mut results = SnapshotResults::new();
    for theme in ["dark", "light"] {
        let area = canvas(&harness);
        look(&mut harness, &mut results, &format!("canvas_{theme}"), area);
        look(&mut harness, &mut results, &format!("inspector_{theme}"), INSPECTOR);
        look(&mut harness, &mut results, &format!("textures_{theme}"), COLUMN);
        let spectrum = view(&harness, View::Spectrum);
        look(&mut harness, &mut results, &format!("spectrum_{theme}"), spectrum);
        toggle_theme(&mut harness);
    }
    choose_mode(&mut harness, Mode::Shared);
    choose(&mut harness, map::MAP, map::name(Some(Quantity::Centroid)));
    wait(&mut harness, "the map is there", |h| says(h, ", from ") && !says(h, map::WAITING));
    let area = canvas(&harness);
    look(&mut harness, &mut results, "map_dark", area);
    results.unwrap();
}

#[test]
fn sheets_and_menus_look_as_they_were_approved() {
    let mut harness = drawn();
    let mut results = SnapshotResults::new();
    click(&mut harness, document::FILE);
    look(
        &mut harness,
        &mut results,
        "file_menu_dark",
        Rect::from_min_max(pos2(100.0, 0.0), pos2(380.0, 260.0)),
    );
    click(&mut harness, gallery::GALLERY);
    harness.run_steps(3);
    wait(&mut harness, "the pictures are made", |h| !says(h, gallery::MAKING));
    look(
        &mut harness,
        &mut results,
        "gallery_dark",
        Rect::from_min_max(pos2(160.0, 30.0), pos2(1120.0, 690.0)),
    );
    click(&mut harness, gallery::CLOSE);
    harness.run_steps(3);
    harness.get_by_label(&strings::texture("Glass")).click_secondary();
    harness.run_steps(3);
    click(&mut harness, strings::textures::DETAILS);
    harness.run_steps(3);
    look(
        &mut harness,
        &mut results,
        "texture_dark",
        Rect::from_min_max(pos2(230.0, 70.0), pos2(1050.0, 650.0)),
    );
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    click(&mut harness, &compare::hear("X"));
    look(&mut harness, &mut results, "blind_dark", Rect::from_min_max(pos2(0.0, 38.0), pos2(208.0, 200.0)));
    results.unwrap();
}

/// CSV table of wave packets of 10 mm at intervals of 20 mm, with a wavelength in mm.
fn packs(wave_mm: f64) -> String {
    let value = |i: u32| {
        let mm = 0.05 * f64::from(i);
        let is_there = (mm / 10.0).rem_euclid(2.0) < 1.0;
        if is_there { (std::f64::consts::TAU * mm / wave_mm).sin() } else { 0.0 }
    };
    (0..2000).map(|i| format!("{},{}", 0.05 * f64::from(i), value(i))).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_bench_looks_as_it_was_approved() {
    let mut harness = drawn();
    let mut results = SnapshotResults::new();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num3);
    harness.run_steps(2);
    for (slot, wave_mm) in Slot::ALL.into_iter().zip([1.0, 0.6]) {
        let name = format!("{}.csv", slot.name());
        support::drop_files(&mut harness, &[(name.as_str(), packs(wave_mm).as_bytes())]);
        wait(&mut harness, "a signal is there", |h| window(h).signals().signal(slot).is_some());
    }
    for (tab, name) in [(Tab::Places, "signals_places_dark"), (Tab::Differences, "signals_differences_light")]
    {
        click(&mut harness, signals::view(tab));
        wait(&mut harness, "all is known of both", |h| {
            let page = window(h).signals();
            Slot::ALL.iter().all(|slot| match tab {
                Tab::Differences => page.by_rate(*slot).is_some() && page.compared().is_some(),
                _ => page.by_window(*slot).is_some(),
            })
        });
        look(&mut harness, &mut results, name, Rect::from_min_max(pos2(0.0, 38.0), pos2(1280.0, 480.0)));
        toggle_theme(&mut harness);
    }
    results.unwrap();
}

/// Negative control: an additional button in the column is detected.
#[test]
fn a_window_that_looks_different_is_found() {
    let mut harness = drawn();
    let folder = tempfile::tempdir().unwrap();
    let reference = "textures_dark.png";
    std::fs::copy(Path::new("tests/snapshots").join(reference), folder.path().join(reference)).unwrap();
    let options = options().output_path(folder.path());
    let before = part(&mut harness, COLUMN);
    // When references are updated, this one may change too.
    let is_taking = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    assert!(try_image_snapshot_options(&before, "textures_dark", &options).is_ok() || is_taking);
    click(&mut harness, authored::KEEP);
    let after = part(&mut harness, COLUMN);
    assert!(try_image_snapshot_options(&after, "textures_dark", &options).is_err() || is_taking);
}
