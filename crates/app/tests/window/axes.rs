//! Spaces with more axes than the canvas: the slice, the further sliders, the choice of the axes, and undo.

mod choice;
mod hull;
mod inspector;
mod of_library;
mod own_textures;
mod played_path;
mod prompts;
mod snapshots;
mod unknown_axis;

use egui::accesskit::Role;
use egui::{Key, Pos2, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::author::blend_choice::mode_entry;
use shagreen_app::command::Command;
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::state::edit::Edit;
use shagreen_app::strings::{self, axes as words, map, path};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::heat_map::Quantity;
use shagreen_core::texture::blend::Mode;

use crate::support::{
    Author, author, choose, choose_mode, click, double_click, drag, painted, says, shown, unnamed_controls,
    wait, wait_for_field, window,
};
use crate::views::carry_out;

/// Axes of the starter library, with one that is computed from the vibration.
const AXES: [&str; 3] = ["rough-smooth", "hard-soft", "centroid"];
/// Name of the slider of the third one.
const THIRD: &str = "Dull to bright";

fn use_axes(harness: &mut Author, axes: &[&str]) {
    let axes = axes.iter().map(|name| (*name).to_owned()).collect();
    carry_out(harness, Command::Axes(AxesCommand::Use(axes)));
    wait_for_field(harness);
}

/// Window on the starter library with three axes.
fn sliced() -> Author {
    let mut harness = author();
    wait_for_field(&mut harness);
    use_axes(&mut harness, &AXES);
    harness
}

fn point(harness: &Author) -> SpacePoint {
    window(harness).project().texture().at
}

fn third(at: SpacePoint) -> f64 {
    at.get(2).expect("a third axis")
}

fn set(harness: &mut Author, slider: &str, value: f64) {
    harness.get_by_role_and_label(Role::Slider, slider).set_value_accesskit(value);
    harness.run_steps(3);
}

/// Names and positions of the textures.
fn placed(harness: &Author) -> Vec<(String, SpacePoint)> {
    let session = window(harness).session();
    session.placed().map(|(texture, at)| (session.textures()[texture].name.clone(), at)).collect()
}

/// Center and width of a texture on the canvas.
fn dot(harness: &Author, name: &str) -> (Pos2, f32) {
    let area = harness.get_by_label(&strings::play_texture(name)).rect();
    (area.center(), area.width())
}

/// Opacity of the largest disc around a position of the canvas, of 255.
fn opacity(harness: &Author, center: Pos2) -> u8 {
    let disc = |shape: Shape| match shape {
        Shape::Circle(circle) if circle.center.distance(center) < 0.5 && circle.fill.a() > 0 => {
            Some((circle.radius, circle.fill.a()))
        }
        Shape::Rect(rect) if rect.rect.center().distance(center) < 0.5 && rect.fill.a() > 0 => {
            Some((0.5 * rect.rect.width(), rect.fill.a()))
        }
        _ => None,
    };
    let discs = painted(harness, strings::CANVAS).into_iter().filter_map(disc);
    discs.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a disc").1
}

fn has_pictures(harness: &Author) -> bool {
    let n_textures = window(harness).session().textures().len();
    (0..n_textures).all(|texture| window(harness).pictures().thumbnail(texture).is_some())
}

#[test]
fn textures_far_from_the_slice_are_small_and_faint() {
    let mut harness = sliced();
    wait(&mut harness, "the pictures are there", has_pictures);
    let lowest = placed(&harness).iter().map(|(_, at)| third(*at)).fold(100.0, f64::min);
    set(&mut harness, THIRD, lowest);
    let mut sites: Vec<(f64, String)> =
        placed(&harness).into_iter().map(|(name, at)| (third(at) - lowest, name)).collect();
    sites.sort_by(|a, b| a.0.total_cmp(&b.0));
    let dots: Vec<(Pos2, f32)> = sites.iter().map(|(_, name)| dot(&harness, name)).collect();
    for (pair, names) in dots.windows(2).zip(sites.windows(2)) {
        assert!(pair[0].1 >= pair[1].1 - 0.1, "{names:?} are {pair:?}");
    }
    let (near, far) = (dots[0], dots[dots.len() - 1]);
    assert!(near.1 > 2.0 * far.1 && far.1 > 4.0, "from {near:?} to {far:?}, still visible");
    let (nearest, farthest) = (opacity(&harness, near.0), opacity(&harness, far.0));
    assert!(nearest > 2 * farthest && farthest > 40, "{nearest} and {farthest} of 255");
    // The tooltip of a faint one has all coordinates.
    let is_alone = |at: usize| {
        let others = dots.iter().enumerate().filter(|(other, _)| *other != at);
        others.map(|(_, (center, _))| center.distance(dots[at].0)).fold(f32::INFINITY, f32::min) > 30.0
    };
    let alone = (0..dots.len()).rev().find(|at| is_alone(*at)).expect("one that no other covers");
    let name = sites[alone].1.clone();
    let at = placed(&harness).into_iter().find(|(other, _)| *other == name).expect("it is placed").1;
    let all = strings::place_in_words(at, window(&harness).session().poles());
    assert!(all.contains(THIRD), "{all}");
    harness.hover_at(dots[alone].0);
    wait(&mut harness, "the tooltip is shown", |h| says(h, &all));
    // On the slice, the farthest one is as large as the nearest one was.
    let highest = placed(&harness).iter().map(|(_, at)| third(*at)).fold(0.0, f64::max);
    set(&mut harness, THIRD, highest);
    assert!((dot(&harness, &sites[sites.len() - 1].1).1 - near.1).abs() < 0.1);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

#[test]
fn the_canvas_says_that_it_is_a_slice_and_has_no_triangles() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let n_lines = |h: &Author| {
        painted(h, strings::CANVAS).iter().filter(|shape| matches!(shape, Shape::LineSegment { .. })).count()
    };
    let before = n_lines(&harness);
    assert!(!says(&harness, &words::slice(2)) && window(&harness).session().space().triangles().count() > 20);
    use_axes(&mut harness, &AXES);
    assert!(says(&harness, &words::slice(3)));
    assert!(n_lines(&harness) + 40 < before, "{} of {before} lines", n_lines(&harness));
    // A map of the slice, which changes with the slice.
    carry_out(&mut harness, Command::ShowMap(Some(Quantity::Centroid)));
    let is_there = |h: &Author| says(h, ", from ") && !says(h, map::WAITING);
    wait(&mut harness, "the map is there", is_there);
    let range = |h: &Author| {
        let texts = shown(h);
        texts.into_iter().find(|text| text.contains(", from ")).expect("the scale")
    };
    let (mean, before) = (third(point(&harness)), range(&harness));
    set(&mut harness, THIRD, mean + 8.0);
    wait(&mut harness, "the map follows the slice", |h| is_there(h) && range(h) != before);
    use_axes(&mut harness, &["rough-smooth"]);
    assert!(harness.query_by_role_and_label(Role::Slider, strings::HARD_SOFT).is_none());
    assert_eq!(point(&harness).n_axes(), 1);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

#[test]
fn a_further_slider_moves_the_point_and_returns_to_the_local_mean() {
    let mut harness = sliced();
    let before = point(&harness);
    assert!(says(&harness, &words::further(1)) && says(&harness, "centroid"));
    set(&mut harness, THIRD, 80.0);
    assert_eq!(point(&harness), before.with(2, 80.0));
    let authored = window(&harness).session().authored().expect("a texture").clone();
    assert_eq!(authored.location.at.n_axes(), 3);
    harness.get_by_role_and_label(Role::Slider, THIRD).focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    let moved = third(point(&harness));
    assert!(moved > 80.0, "{moved}");
    click(&mut harness, &words::reset("centroid"));
    let mean = window(&harness).session().at_local_mean(before, 2);
    assert_eq!(point(&harness), mean);
    assert!(mean.distance(before) < 1e-6, "a new axis began there");
    click(&mut harness, strings::UNDO);
    assert_eq!(point(&harness).get(2), Some(moved));
}

/// Clicks once at a position.
fn click_at(harness: &mut Author, at: Pos2) {
    harness.hover_at(at);
    harness.run_steps(2);
    harness.drag_at(at);
    harness.run_steps(1);
    harness.drop_at(at);
    harness.run_steps(2);
}

/// Position of the canvas far from all textures and from the point.
fn free_place(harness: &Author) -> Pos2 {
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    let inner = canvas.shrink2(egui::vec2(80.0, 90.0));
    let mut taken: Vec<Pos2> = placed(harness).iter().map(|(name, _)| dot(harness, name).0).collect();
    taken.push(harness.get_by_role_and_label(Role::Slider, strings::POINT).rect().center());
    let distance = |at: &Pos2| taken.iter().map(|other| other.distance(*at)).fold(f32::INFINITY, f32::min);
    let places = (0..40).flat_map(|column| (0..40).map(move |row| [column, row].map(|i| i as f32 / 39.0)));
    let places = places.map(|[x, y]| inner.min + inner.size() * egui::vec2(x, y));
    places.max_by(|a, b| distance(a).total_cmp(&distance(b))).expect("places")
}

/// Drags and arrow keys on the canvas keep the further coordinates.
#[test]
fn moves_on_the_canvas_keep_the_further_coordinates() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 70.0);
    let handle = harness.get_by_role_and_label(Role::Slider, strings::POINT).rect().center();
    drag(&mut harness, handle, handle + egui::vec2(60.0, 30.0));
    let dragged = point(&harness);
    assert!(dragged.x() > 52.0 && dragged.get(2) == Some(70.0), "{dragged}");
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    assert!((point(&harness).x() - dragged.x() + 1.0).abs() < 1e-9 && third(point(&harness)) == 70.0);
    let free = free_place(&harness);
    click_at(&mut harness, free);
    let clicked = point(&harness);
    assert!(clicked.distance(dragged) > 3.0 && third(clicked) == 70.0, "{clicked}");
}

/// A path has the further coordinates of the slice where it is drawn, and those of a texture on it.
#[test]
fn paths_and_textures_have_all_coordinates() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 70.0);
    carry_out(&mut harness, Command::TogglePathTool);
    let free = free_place(&harness);
    click_at(&mut harness, free);
    click(&mut harness, &strings::play_texture("Brick"));
    let points = |h: &Author| window(h).project().texture().path.clone().expect("a path").points;
    let brick = placed(&harness).into_iter().find(|(name, _)| name == "Brick").expect("it is placed").1;
    let before = points(&harness);
    assert_eq!((before[0].get(2), before[1]), (Some(70.0), brick));
    set(&mut harness, THIRD, third(brick));
    let first = harness.get_by_label(&path::point(1)).rect().center();
    drag(&mut harness, first, first + egui::vec2(-20.0, -10.0));
    let moved = points(&harness)[0];
    assert!(moved.distance(before[0]) > 1.0 && third(moved) == 70.0, "{moved}");
    carry_out(&mut harness, Command::TogglePathTool);
    let (center, _) = dot(&harness, "Brick");
    double_click(&mut harness, center);
    wait_for_field(&mut harness);
    assert_eq!(point(&harness), brick);
    let authored = window(&harness).session().authored().expect("a texture").clone();
    let weights: Vec<f64> = authored.parents.iter().map(|(_, weight)| *weight).collect();
    assert!(weights.len() == 1 && (weights[0] - 1.0).abs() < 1e-9, "pinned at its position: {weights:?}");
}

#[test]
fn modes_with_triangles_wait_for_two_axes() {
    let mut harness = author();
    wait_for_field(&mut harness);
    choose_mode(&mut harness, Mode::Paper);
    use_axes(&mut harness, &AXES);
    let mode = |h: &Author| window(h).session().authored().expect("a texture").mode;
    assert_eq!(mode(&harness), Mode::Field);
    assert!(says(&harness, strings::BEYOND), "the options of the field");
    let waits = words::waits(strings::PAPER);
    assert!(says(&harness, &waits), "a line in the inspector");
    harness.get_by_role_and_label(Role::ComboBox, strings::BLEND_MODE).click();
    harness.run_steps(3);
    for each in Mode::ALL {
        let name = mode_entry(each);
        let entry = harness.get_by_role_and_label(Role::Button, &name);
        assert_eq!(entry.accesskit_node().is_disabled(), each != Mode::Field, "{each:?}");
    }
    let entry = harness.get_by_role_and_label(Role::Button, &mode_entry(Mode::Shared)).rect().center();
    harness.hover_at(entry);
    wait(&mut harness, "the reason is shown", |h| says(h, words::NEEDS_TRIANGLES));
    harness.get_by_role_and_label(Role::Button, &mode_entry(Mode::Field)).click();
    harness.run_steps(3);
    use_axes(&mut harness, &["rough-smooth", "hard-soft"]);
    assert_eq!((window(&harness).project().texture().blend.mode, mode(&harness)), (Mode::Paper, Mode::Paper));
    assert!(!says(&harness, &waits));
    choose(&mut harness, strings::BLEND_MODE, &mode_entry(Mode::Shared));
    assert_eq!(mode(&harness), Mode::Shared);
}

/// Swapping the axes of the canvas moves no point, and undo restores the project exactly.
#[test]
fn swapped_axes_keep_the_point_and_undo_restores_everything() {
    let mut harness = author();
    wait_for_field(&mut harness);
    carry_out(&mut harness, Command::Edit(Edit::KeepSnapshot));
    set(&mut harness, strings::ROUGH_SMOOTH, 30.0);
    let start = window(&harness).project().clone();
    let heard = |h: &Author| window(h).session().authored().expect("a texture").clone();
    let in_plane = heard(&harness);
    use_axes(&mut harness, &AXES);
    set(&mut harness, THIRD, 64.0);
    let (before, sound) = (point(&harness), heard(&harness));
    carry_out(&mut harness, Command::Axes(AxesCommand::Swap));
    wait_for_field(&mut harness);
    let swapped = point(&harness);
    assert_eq!(swapped.coordinates(), [before.y(), before.x(), 64.0]);
    assert_eq!(window(&harness).session().poles()[0], ["hard", "soft"]);
    let snapshot = &window(&harness).project().snapshots[0];
    assert_eq!(snapshot.at, SpacePoint::plane(50.0, 50.0), "it stays on its axes");
    assert_eq!(snapshot.axes, Some(AXES[..2].iter().map(|name| (*name).to_owned()).collect()));
    let apart = |a: &[(usize, f64)], b: &[(usize, f64)]| {
        let weight =
            |texture: usize| b.iter().find(|(of, _)| *of == texture).map_or(0.0, |(_, weight)| *weight);
        a.iter().map(|(texture, of)| (of - weight(*texture)).abs()).fold(0.0, f64::max)
    };
    assert!(apart(&sound.parents, &heard(&harness).parents) < 1e-6, "the same textures contribute");
    // The swap, the slider and the axes.
    for _ in 0..3 {
        click(&mut harness, strings::UNDO);
    }
    wait_for_field(&mut harness);
    assert_eq!(*window(&harness).project(), start);
    assert_eq!(heard(&harness), in_plane);
    for _ in 0..3 {
        click(&mut harness, strings::REDO);
    }
    assert_eq!(point(&harness), swapped);
}
