//! Interpolated textures: level, pinning, extrapolation and messages.

use std::time::{Duration, Instant};

use egui::Shape;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::state::edit::Edit;
use shagreen_app::strings;
use shagreen_core::space::authoring::{Authored, Outside, Weights};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Contact;
use shagreen_formats::library::{Library, Place};
use shagreen_formats::starter::starter_library;

use crate::support::{
    Author, author, author_on, choose_mode, click, is_locked, painted, says, unnamed_controls, wait,
    wait_for_field, window, words,
};

fn authored(harness: &Author) -> Authored {
    window(harness).session().authored().expect("a texture").clone()
}

fn listen(harness: &mut Author, seconds: f64) {
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < seconds {
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn set(harness: &mut Author, slider: &str, value: f64) {
    harness.get_by_role_and_label(Role::Slider, slider).set_value_accesskit(value);
    harness.run_steps(3);
}

fn move_to(harness: &mut Author, rough_smooth: f64, hard_soft: f64) {
    set(harness, strings::ROUGH_SMOOTH, rough_smooth);
    set(harness, strings::HARD_SOFT, hard_soft);
}

/// Level of the shown spectrum of the mixture, in m/s².
fn shown_level_mps2(harness: &Author) -> f64 {
    let spectra = window(harness).session().spectra();
    let steps = spectra.frequencies.windows(2).map(|f| f[1].0 - f[0].0);
    steps.zip(&spectra.blend).map(|(df, p)| df * p).sum::<f64>().sqrt()
}

fn on_canvas(harness: &Author) -> Vec<String> {
    painted(harness, strings::CANVAS).iter().filter_map(words).collect()
}

/// In both modes that interpolate a texture, the output signal and the shown spectrum have the level of its model.
#[test]
fn what_is_made_is_heard_and_shown() {
    let mut harness = author();
    wait_for_field(&mut harness);
    for (mode, rough_smooth) in [(Mode::Field, 20.0), (Mode::Field, 62.0), (Mode::Parametric, 40.0)] {
        choose_mode(&mut harness, mode);
        move_to(&mut harness, rough_smooth, 45.0);
        let model = authored(&harness).model.expect("a texture was made");
        let level_mps2 = Plane::new(&model).at(Contact::from_mm_per_s_and_n(100.0, 0.8)).level_mps2;
        // Without contact, the spectrum is computed for the speed and force of the automatic stroke.
        let ratio = shown_level_mps2(&harness) / level_mps2;
        assert!(
            (0.8..1.2).contains(&ratio),
            "{mode:?}: the spectrum has {ratio} times the level of the model"
        );
        click(&mut harness, strings::HAND_START);
        listen(&mut harness, 1.2);
        let heard_mps2 = window(&harness).session().scope().rms(0.7);
        click(&mut harness, strings::HAND_STOP);
        wait(&mut harness, "the hand stops", |h| window(h).session().touch().contact.force_n == 0.0);
        let ratio = heard_mps2 / level_mps2;
        assert!(
            (1.0 / 1.5..1.5).contains(&ratio),
            "{mode:?}: heard {heard_mps2}, the model has {level_mps2} m/s²"
        );
        assert_eq!(window(&harness).session().spectra().parents.len(), 3);
    }
}

/// All textures contribute; three have cards and the others one line.
#[test]
fn a_field_shows_its_three_largest_parents_and_counts_the_rest() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let field = authored(&harness);
    assert!(field.parents.len() == 25 && field.parents.iter().any(|(_, weight)| *weight < 0.0));
    let textures = window(&harness).session().textures();
    let card = |(texture, weight): &(usize, f64)| strings::parent(&textures[*texture].name, 100.0 * weight);
    for parent in &field.parents[..3] {
        assert!(harness.query_by_label(&card(parent)).is_some(), "no card says {}", card(parent));
    }
    assert!(harness.query_by_label(&card(&field.parents[3])).is_none());
    assert!(says(&harness, &strings::more_parents(22)));
    // Modes that interpolate within a triangle fill it.
    let is_filled = |h: &Author| {
        painted(h, strings::CANVAS).iter().any(|s| matches!(s, Shape::Mesh(m) if m.indices.len() == 3))
    };
    assert!(!is_filled(&harness));
    choose_mode(&mut harness, Mode::Shared);
    assert!(is_filled(&harness) && authored(&harness).parents.len() == 3);
    assert!(!says(&harness, "more, total"));
}

/// A pinned texture is exact, others are smoothed. Undo reverts pinning.
#[test]
fn a_locked_texture_is_met_exactly() {
    let mut harness = author();
    wait_for_field(&mut harness);
    // A click plays exactly the texture; the field at its position smooths it.
    click(&mut harness, &strings::play_texture("Sanded wood"));
    harness.run_steps(2);
    let wood = window(&harness).session().textures().iter().position(|t| t.name == "Sanded wood").unwrap();
    assert_eq!(authored(&harness).parents, [(wood, 1.0)]);
    let at = window(&harness).session().space().position(wood).unwrap();
    move_to(&mut harness, at.x() + 1.0, at.y());
    move_to(&mut harness, at.x(), at.y());
    let smoothed = authored(&harness);
    assert!(smoothed.lock.is_none() && smoothed.parents[0].1 < 0.9, "{:?}", smoothed.parents[0]);
    click(&mut harness, &strings::lock("Sanded wood", true));
    harness.run_steps(2);
    assert!(is_locked(&harness, wood));
    assert_eq!(authored(&harness).lock, Some((wood, 1.0)));
    assert!(says(&harness, &strings::locked_share("Sanded wood", 100.0)));
    let level = |h: &Author| shown_level_mps2(h);
    let model = &window(&harness).session().textures()[wood].model;
    let exact_mps2 = Plane::new(model).at(Contact::from_mm_per_s_and_n(100.0, 0.8)).level_mps2;
    assert!((level(&harness) / exact_mps2 - 1.0).abs() < 0.15, "{} for {exact_mps2}", level(&harness));
    click(&mut harness, strings::UNDO);
    assert!(!is_locked(&harness, wood));
    // The context menu of the texture on the canvas also pins it.
    harness.get_by_label(&strings::play_texture("Felt")).click_secondary();
    harness.run_steps(3);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &strings::lock("Felt", true));
    let felt = window(&harness).session().textures().iter().position(|t| t.name == "Felt").unwrap();
    assert!(is_locked(&harness, felt));
    // Near a pinned texture, both the texture and the field play.
    let at = window(&harness).session().space().position(felt).unwrap();
    move_to(&mut harness, at.x(), at.y() - 4.0);
    let (locked, share) = authored(&harness).lock.expect("the circle of felt");
    assert!(locked == felt && share > 0.1 && share < 0.9, "{share}");
    wait(&mut harness, "both are loaded", |h| window(h).session().n_loaded() >= 2);
    // Other modes ignore pins and keep them.
    choose_mode(&mut harness, Mode::Power);
    assert!(!is_locked(&harness, felt));
    choose_mode(&mut harness, Mode::Field);
    assert!(is_locked(&harness, felt));
}

/// Outside the convex hull the point is clamped to it, or the field is extrapolated as far as it allows.
#[test]
fn beyond_the_textures_only_where_that_is_asked_for() {
    let mut harness = author();
    wait_for_field(&mut harness);
    // A little outside the hull, of which the softest texture is a corner.
    move_to(&mut harness, 99.0, 99.0);
    let clamped = authored(&harness);
    assert!(clamped.location.clamped && !clamped.is_extrapolated);
    assert!(on_canvas(&harness).iter().any(|text| text == strings::CLAMPED));
    click(&mut harness, strings::BEYOND);
    assert_eq!(window(&harness).project().texture().blend.outside, Outside::Extrapolated);
    let beyond = authored(&harness);
    assert!(beyond.is_extrapolated);
    assert!(
        on_canvas(&harness).iter().any(|text| text == strings::EXTRAPOLATED),
        "{:?}",
        on_canvas(&harness)
    );
    let at = beyond.location.at;
    // A limit that is not visibly nearer than the point is not mentioned.
    let is_moved = SpacePoint::plane(99.0, 99.0).most_different_axis(at).is_some();
    let said = if beyond.location.clamped && is_moved {
        strings::extrapolated_to(at)
    } else {
        strings::EXTRAPOLATED_HERE.to_owned()
    };
    assert!(on_canvas(&harness).contains(&said), "{:?}", on_canvas(&harness));
    assert_ne!(clamped.model, beyond.model);
    click(&mut harness, strings::UNDO);
    assert_eq!(authored(&harness), clamped);
}

/// Natural-neighbor weights use more than three textures, and only the parametric mode offers them.
#[test]
fn natural_neighbors_are_a_choice_of_the_parametric_mode() {
    let mut harness = author();
    wait_for_field(&mut harness);
    assert!(harness.query_by_label(strings::NATURAL).is_none());
    choose_mode(&mut harness, Mode::Parametric);
    move_to(&mut harness, 48.0, 52.0);
    assert!(harness.query_by_label(strings::BEYOND).is_none() && authored(&harness).parents.len() == 3);
    click(&mut harness, strings::NATURAL);
    assert_eq!(window(&harness).project().texture().blend.weights, Weights::Natural);
    let natural = authored(&harness);
    assert!(natural.parents.len() > 3 && natural.model.is_some(), "{:?}", natural.parents);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    choose_mode(&mut harness, Mode::Paper);
    assert!(harness.query_by_label(strings::NATURAL).is_none());
    assert!(on_canvas(&harness).iter().any(|text| text == strings::JUMPS || text == strings::JUMPS_HERE));
}

/// A drag ten times as long as usual: loaded textures do not accumulate, and none leak.
#[test]
fn a_long_drag_keeps_nothing() {
    let mut harness = author();
    wait_for_field(&mut harness);
    click(&mut harness, strings::HAND_START);
    let ctx = harness.ctx.clone();
    let mut most = 0;
    let dropouts = window(&harness).session().status().unwrap().underruns;
    let start = Instant::now();
    for i in 0..2000 {
        let (a, b) = (0.05 * f64::from(i), 0.031 * f64::from(i));
        let point = SpacePoint::plane(50.0 + 45.0 * a.sin(), 50.0 + 45.0 * b.cos());
        let command = shagreen_app::command::Command::Edit(Edit::MovePoint(point));
        harness.state_mut().as_mut().unwrap().carry_out(command, &ctx);
        harness.step();
        most = most.max(window(&harness).session().n_loaded());
    }
    let n_before = window(&harness).session().n_loaded();
    // The playing texture and the next one.
    assert!(most <= 2 && n_before <= 2, "up to {most} textures were loaded");
    let took_secs = start.elapsed().as_secs_f64();
    let status = window(&harness).session().status().unwrap();
    assert_eq!(status.leaked, 0);
    assert_eq!(status.underruns, dropouts, "dropouts in {took_secs} s");
    listen(&mut harness, 0.3);
    assert_eq!(window(&harness).session().n_loaded(), 1);
    assert!(window(&harness).session().scope().rms(0.2) > 1e-3, "it still sounds");
}

/// Copies of the textures of the starter library, spread over the whole space.
fn thousand() -> Library {
    let mut library = starter_library().unwrap();
    let textures = library.textures.clone();
    library.textures = (0..1000)
        .map(|i| {
            let mut texture = textures[i % textures.len()].clone();
            texture.id = format!("copy-{i}");
            texture.name = format!("Copy {i}");
            texture.picture = None;
            let at = SpacePoint::plane((i * 617 % 1000) as f64 * 0.1, i as f64 * 0.1);
            texture.place = Some(Place::new(at, LabelSource::PhysicalLabels));
            texture
        })
        .collect();
    library
}

/// A field over a thousand textures is computed without blocking the window, which shows a notice.
#[test]
fn a_thousand_textures_do_not_hold_the_window_up() {
    let mut harness = author_on(thousand(), [1280.0, 720.0]);
    let mut slowest = Duration::ZERO;
    let mut has_said = false;
    let start = Instant::now();
    let mut i = 0_u32;
    while window(&harness).session().is_preparing() || i < 40 {
        let begin = Instant::now();
        i += 1;
        let value = 50.0 + 30.0 * f64::from(i % 7) / 7.0;
        harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(value);
        harness.step();
        slowest = slowest.max(begin.elapsed());
        has_said |= says(&harness, strings::PREPARING);
        assert!(start.elapsed() < Duration::from_mins(5), "the field never came");
    }
    let took_secs = start.elapsed().as_secs_f64();
    assert!(has_said || took_secs < 1.0, "what lasts {took_secs} s is worth a word");
    wait_for_field(&mut harness);
    assert!(!says(&harness, strings::PREPARING));
    assert_eq!(authored(&harness).parents.len(), 1000);
    assert!(authored(&harness).model.is_some());
    assert!(slowest < Duration::from_millis(FRAME_LIMIT_MS), "a frame took {slowest:?}");
}

/// Generous, because tests use an unoptimized build and run in parallel.
const FRAME_LIMIT_MS: u64 = 400;
