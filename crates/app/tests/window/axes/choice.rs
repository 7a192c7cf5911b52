//! The sheet that chooses axes: its list, presets, order and evaluation.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::strings::{axes as words, help, sentence};
use shagreen_core::space::MOST_AXES;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::starter::simulated_library;
use shagreen_studio::axes::known_axes;

use super::{point, sliced};
use crate::support::{
    Author, author, author_on, click, says, unnamed_controls, wait, wait_for_field, window, write_into,
};

/// Opens the sheet and waits until it knows the axes.
fn open(harness: &mut Author) {
    click(harness, words::BUTTON);
    wait(harness, "the axes are read", |h| h.query_by_label(words::AS_PLACED).is_some());
    // The sheet grows with its content, and is centered in the next frames.
    harness.run_steps(6);
}

fn is_disabled(harness: &Author, name: &str) -> bool {
    harness.get_by_label(name).accesskit_node().is_disabled()
}

fn tick(harness: &mut Author, axis: &str) {
    harness.get_by_role_and_label(Role::CheckBox, axis).click();
    harness.run_steps(3);
}

fn axes(harness: &Author) -> Vec<String> {
    window(harness).session().axes().to_vec()
}

#[test]
fn a_preset_has_five_axes_and_four_sliders_more_than_one() {
    let mut harness = author_on(simulated_library().unwrap(), [1280.0, 720.0]);
    wait_for_field(&mut harness);
    let before = window(&harness).project().clone();
    open(&mut harness);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &sentence("CNN-LSTM paper"));
    let n = window(&harness).session().textures().len();
    assert!(says(&harness, &words::n_placed(n, n)));
    click(&mut harness, words::USE);
    harness.run_steps(3);
    assert_eq!(axes(&harness), ATTRIBUTES);
    assert!(says(&harness, &words::further(3)) && says(&harness, &words::slice(5)));
    for slider in ["Flat to bumpy", "Sticky to slippery", "Irritating to pleasant"] {
        assert!(harness.query_by_role_and_label(Role::Slider, slider).is_some(), "{slider}");
    }
    assert_eq!(point(&harness).on(2), before.texture().at);
    open(&mut harness);
    click(&mut harness, words::AS_PLACED);
    click(&mut harness, words::USE);
    assert_eq!(*window(&harness).project(), before, "the axes of the positions");
}

#[test]
fn axes_are_chosen_ordered_and_limited() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    let known = known_axes(window(&harness).session().library());
    assert!((4..=MOST_AXES).contains(&known.len()), "{known:?}");
    // Rows stay where they are, so that the next click does not hit another axis.
    let rows = |h: &Author| {
        let top = |name: &str| h.get_by_role_and_label(Role::CheckBox, name).rect().top();
        known.iter().map(|axis| (top(&axis.name) - top("rough-smooth")).round()).collect::<Vec<f32>>()
    };
    let before = rows(&harness);
    assert!(before.windows(2).all(|pair| pair[0] < pair[1]), "{before:?}");
    for axis in &known[2..] {
        tick(&mut harness, &axis.name);
        assert_eq!(rows(&harness), before, "{}", axis.name);
    }
    tick(&mut harness, "hard-soft");
    assert_eq!(rows(&harness), before);
    tick(&mut harness, "hard-soft");
    assert!(says(&harness, &words::place(known.len() - 1)));
    click(&mut harness, words::CANCEL);
    assert_eq!(axes(&harness), ["rough-smooth", "hard-soft"], "nothing was chosen");

    open(&mut harness);
    tick(&mut harness, "hard-soft");
    assert!(is_disabled(&harness, "rough-smooth"), "the last one stays");
    tick(&mut harness, "centroid");
    tick(&mut harness, "hard-soft");
    click(&mut harness, &words::earlier("hard-soft"));
    assert!(is_disabled(&harness, &words::earlier("rough-smooth")));
    assert!(is_disabled(&harness, &words::later("centroid")));
    click(&mut harness, words::SWAP_FIRST);
    click(&mut harness, words::USE);
    harness.run_steps(3);
    assert_eq!(axes(&harness), ["hard-soft", "rough-smooth", "centroid"]);
    assert_eq!(point(&harness).n_axes(), 3);
}

#[test]
fn the_palette_swaps_the_axes_of_the_canvas() {
    let mut harness = sliced();
    let commands: Vec<&str> = shagreen_app::command::listed()
        .filter_map(|command| command.entry().map(|entry| entry.label))
        .filter(|label| label.to_lowercase().contains("axes"))
        .collect();
    assert_eq!(commands, [words::BUTTON, words::SWAP]);
    let before = point(&harness);
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    harness.run_steps(3);
    write_into(&mut harness, help::FIND_COMMAND, "swap the axes");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(axes(&harness)[..2], ["hard-soft", "rough-smooth"]);
    assert_eq!((point(&harness).x(), point(&harness).y()), (before.y(), before.x()));
}

/// The evaluation runs in the background and can be stopped; its result adds axes.
#[test]
fn axes_are_evaluated_in_the_order_of_what_they_add() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    click(&mut harness, words::EVALUATE);
    assert!(harness.query_by_label(words::STOP).is_some());
    click(&mut harness, words::STOP);
    assert!(harness.query_by_label(words::STOP).is_none() && !says(&harness, words::RANK1));
    click(&mut harness, words::EVALUATE);
    wait(&mut harness, "the axes are evaluated", |h| h.query_by_label(words::STOP).is_none());
    harness.run_steps(3);
    assert!(says(&harness, words::RANK1) && says(&harness, "not rated by people"));
    let first = ["rough-smooth", "hard-soft"].map(str::to_owned);
    assert!(says(&harness, &words::first_axes(&first)), "the axes of the first row");
    let mut rows: Vec<(f32, &str)> = ["centroid", "speed exponent", "force exponent", "tap frequency"]
        .into_iter()
        .filter_map(|axis| Some((harness.query_by_label(&words::add(axis))?.rect().top(), axis)))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let added: Vec<&str> = rows.into_iter().map(|(_, axis)| axis).collect();
    assert!(added.len() > 2 && added.iter().all(|axis| says(&harness, &words::added(axis))), "{added:?}");
    // A row has the axes of the rows above it, too.
    add(&mut harness, added[1]);
    assert!(added[..2].iter().all(|axis| harness.query_by_label(&words::add(axis)).is_none()));
    assert!(harness.query_by_label(&words::add(added[2])).is_some());
    click(&mut harness, words::USE);
    harness.run_steps(3);
    assert_eq!(axes(&harness), ["rough-smooth", "hard-soft", added[0], added[1]]);

    // The result is there again, and still says what the next row adds.
    open(&mut harness);
    assert!(says(&harness, &words::first_axes(&first)) && says(&harness, words::RANK1));
    assert!(!says(&harness, &words::of_another_choice(&first)));
    assert!(harness.query_by_label(&words::add(added[1])).is_none());
    assert!(harness.query_by_label(&words::add(added[2])).is_some());
    // It says nothing about a choice without the first axes.
    tick(&mut harness, "hard-soft");
    assert!(says(&harness, &words::of_another_choice(&first)));
    assert!(added.iter().all(|axis| harness.query_by_label(&words::add(axis)).is_none()));
}

fn add(harness: &mut Author, axis: &str) {
    harness.get_by_label(&words::add(axis)).scroll_to_me();
    harness.run_steps(4);
    click(harness, &words::add(axis));
}
