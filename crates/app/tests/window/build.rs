//! The Build workspace: reading judgments, building, viewing, saving and using a space, and undo.

mod figures;
mod judgments;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use shagreen_app::command::Command;
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::strings::{self, build};
use shagreen_app::workspace::Workspace;
use shagreen_core::space::LabelSource;
use shagreen_core::space::space_build::FeatureKind;
use shagreen_formats::space_report::RATING_FIGURE;
use shagreen_formats::starter::starter_library;

use crate::support::{Author, author, author_on, choose, click, says, shown, unnamed_controls, wait, window};
use crate::views::carry_out;

/// Window in the Build workspace.
fn builder() -> Author {
    let mut harness = author();
    click(&mut harness, Workspace::Build.info().name);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    harness
}

/// Space built from simulated raters, with the fastest options.
fn built() -> Author {
    let mut harness = builder();
    click(&mut harness, build::SIMULATE);
    wait(&mut harness, "the panel has judged", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
    set_number(&mut harness, build::PERMUTATIONS, 19.0);
    choose(&mut harness, build::FEATURES, build::features(FeatureKind::Physical));
    click(&mut harness, build::BUILD_SPACE);
    assert!(window(&harness).build().is_building());
    wait(&mut harness, "the space is built", |h| !window(h).build().is_building());
    assert!(window(&harness).build().built().is_some(), "{:?}", shown(&harness));
    harness.run_steps(2);
    harness
}

/// Uses the built space and shows the Author workspace.
fn use_space(harness: &mut Author) {
    click(harness, build::USE_SPACE);
    harness.run_steps(2);
    click(harness, build::GO_TO_AUTHOR);
    harness.run_steps(2);
}

fn set_number(harness: &mut Author, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::SpinButton, name).set_value_accesskit(value);
    harness.run_steps(2);
}

/// Shows the figure with this name; those of mean ratings share a tab, in which the adjective pair is chosen.
fn show_figure(harness: &mut Author, name: &str) {
    let tab = build::figure(name);
    click(harness, tab);
    harness.run_steps(2);
    if let Some(number) = name.strip_prefix(RATING_FIGURE) {
        let number: usize = number.parse().unwrap();
        let pair = window(harness).build().built().unwrap().build.adjectives[number - 1].pair.name();
        choose(harness, build::RATED_PAIR, &pair);
    }
}

/// Main use: from judgments to a space in use, and back.
#[test]
fn a_space_is_built_looked_at_used_and_undone() {
    let mut harness = built();
    let space = window(&harness).build().built().unwrap().build.clone();
    assert_eq!(space.source, LabelSource::SimulatedRaters);
    for (name, figure) in window(&harness).build().built().unwrap().figures.clone() {
        show_figure(&mut harness, &name);
        assert!(says(&harness, &figure.title()), "{name} is not shown");
        assert!(figure.title().contains("simulated raters"), "{}", figure.title());
    }
    assert!(says(&harness, "nested cross-validation") && says(&harness, "no person felt the textures"));

    let before = window(&harness).session().library().clone();
    let (space_before, source_before) =
        (window(&harness).session().space().clone(), window(&harness).session().label_source());
    click(&mut harness, build::USE_SPACE);
    harness.run_steps(2);
    let session = window(&harness).session();
    assert_eq!(session.label_source(), "simulated raters");
    assert!(says(&harness, "positions: simulated raters"));
    for (index, texture) in session.textures().iter().enumerate() {
        let at = space.textures.iter().position(|id| *id == texture.id).map(|i| space.positions[i]);
        assert_eq!(session.space().position(index), at);
        assert!(texture.attributes.as_ref().is_some_and(|a| a.source == LabelSource::SimulatedRaters));
    }
    assert!(session.library().space_report.is_some());

    // The interpolated texture has the new contributing textures and is audible.
    click(&mut harness, build::GO_TO_AUTHOR);
    assert_eq!(window(&harness).workspace(), Workspace::Author);
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 1e-4);
    click(&mut harness, strings::HAND_STOP);

    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    let session = window(&harness).session();
    assert_eq!(*session.library(), before, "places, attributes and report are as they were");
    assert_eq!((session.space(), session.label_source()), (&space_before, source_before));
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).session().label_source(), "simulated raters");
}

#[test]
fn two_attributes_of_a_space_become_the_axes() {
    let mut harness = built();
    use_space(&mut harness);
    let places = window(&harness).session().space().clone();
    // The positions have an axis of the same name.
    let axes = ["attribute:rough-smooth", "sticky-slippery"].map(str::to_owned).to_vec();
    carry_out(&mut harness, Command::Axes(AxesCommand::Use(axes.clone())));
    let session = window(&harness).session();
    assert_eq!(window(&harness).project().axes, Some(axes));
    assert_eq!(session.poles(), &[["rough", "smooth"], ["sticky", "slippery"]]);
    for (index, texture) in session.textures().iter().enumerate() {
        let at = session.space().position(index).unwrap();
        let attributes = texture.attributes.as_ref().unwrap();
        assert_eq!(Some(at.x()), attributes.get("rough-smooth"));
        assert_eq!(Some(at.y()), attributes.get("sticky-slippery"));
    }
    assert!(harness.query_by_role_and_label(Role::Slider, "Sticky to slippery").is_some());
    assert!(harness.query_by_role_and_label(Role::Slider, strings::HARD_SOFT).is_none());
    click(&mut harness, strings::UNDO);
    assert_eq!(*window(&harness).session().space(), places);
    assert!(harness.query_by_role_and_label(Role::Slider, strings::HARD_SOFT).is_some());
}

#[test]
fn building_can_be_cancelled_and_what_was_built_stays() {
    let mut harness = built();
    let before = window(&harness).build().built().unwrap().build.clone();
    set_number(&mut harness, build::SEED, 7.0);
    set_number(&mut harness, build::PERMUTATIONS, 200.0);
    assert!(says(&harness, build::CHANGED));
    click(&mut harness, build::BUILD_AGAIN);
    assert!(window(&harness).build().is_building());
    click(&mut harness, build::CANCEL);
    assert!(!window(&harness).build().is_building());
    // The job checks for cancellation many times a second, so it may have stopped before the next frame. Until then the
    // button is disabled.
    if says(&harness, build::STOPPING) {
        assert!(harness.get_by_label(build::CANCEL).accesskit_node().is_disabled());
    }
    wait(&mut harness, "it has stopped", |h| !window(h).build().is_stopping());
    harness.run_steps(2);
    let now = window(&harness).build().built().unwrap().build.clone();
    assert!(std::sync::Arc::ptr_eq(&before, &now), "what is late reaches nobody");
    assert!(harness.query_by_label(build::BUILD_AGAIN).is_some(), "it can be tried again");
}

/// All build options are visible without scrolling, with and without judgments.
#[test]
fn nothing_of_the_options_is_cut_off() {
    for size in [[1280.0, 720.0], [1000.0, 700.0]] {
        let mut harness = author_on(starter_library().unwrap(), size);
        click(&mut harness, Workspace::Build.info().name);
        for is_read in [false, true] {
            if is_read {
                click(&mut harness, build::SIMULATE);
                wait(&mut harness, "the panel has judged", |h| !window(h).build().judgments().is_reading());
            }
            harness.run_steps(3);
            let button = harness.get_by_label(build::BUILD_SPACE).rect();
            let rows = [build::DIMENSIONS, build::PERMUTATIONS, build::SEED]
                .map(|name| harness.get_by_role_and_label(Role::SpinButton, name).rect());
            let last = harness.get_by_role_and_label(Role::CheckBox, build::ORTHOGONAL).rect();
            let ties = harness.get_by_role_and_label(Role::ComboBox, build::TIES).rect();
            for rect in rows.into_iter().chain([last, ties]) {
                assert!(rect.bottom() <= button.top(), "{rect:?} is below {button:?} at {size:?}, {is_read}");
                assert!(
                    rect.right() <= button.right() + 1.0,
                    "{rect:?} is wider than {button:?} at {size:?}"
                );
            }
        }
    }
}

#[test]
fn the_keyboard_changes_workspaces_and_the_hand_does_not_start_unseen() {
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num2);
    harness.run_steps(2);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    harness.key_press(Key::Space);
    harness.run_steps(2);
    assert!(!window(&harness).session().hand_is_running());
    assert!(harness.query_by_role_and_label(Role::ComboBox, strings::OUTPUT).is_some(), "the status stays");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num1);
    harness.run_steps(2);
    assert_eq!(window(&harness).workspace(), Workspace::Author);
}

#[test]
fn every_control_has_a_name() {
    let harness = builder();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    for name in [build::TIES, build::FIRST_AXIS, build::SECOND_AXIS, build::FEATURES, build::SELECTION] {
        assert!(harness.query_by_role_and_label(Role::ComboBox, name).is_some(), "{name}");
    }
    for name in [build::DIMENSIONS, build::PERMUTATIONS, build::SEED, build::SCALE_LOW, build::SCALE_HIGH] {
        assert!(harness.query_by_role_and_label(Role::SpinButton, name).is_some(), "{name}");
    }
    let harness = built();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}
