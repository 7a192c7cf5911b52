//! The tour: cards beside their places, and clicks that change nothing else.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::choices::tour::Step;
use shagreen_app::command::Command;
use shagreen_app::strings;
use shagreen_app::strings::{authored, document, help};

use crate::support::{Author, author, click, says, window};
use crate::views::carry_out;

fn press(harness: &mut Author, at: Pos2) {
    for pressed in [true, false] {
        let button = PointerButton::Primary;
        harness.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
        harness.run_steps(1);
    }
}

/// Clicks at a position of the window.
fn click_at(harness: &mut Author, at: Pos2) {
    harness.hover_at(at);
    harness.run_steps(1);
    press(harness, at);
    harness.run_steps(1);
}

fn area_of(harness: &Author, name: &str) -> Rect {
    harness.get_by_label(name).rect()
}

/// Area of the card of a step, from its heading to its buttons.
fn card(harness: &Author, step: Step) -> Rect {
    let next = if step == Step::Keep { help::DONE } else { help::NEXT };
    area_of(harness, help::step(step)[0]).union(area_of(harness, next))
}

fn canvas(harness: &Author) -> Rect {
    harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect()
}

#[test]
fn a_card_covers_nothing_that_it_names_and_its_buttons_stay() {
    let mut harness = author();
    carry_out(&mut harness, Command::BeginTour);
    let mut buttons = Vec::new();
    for step in Step::ALL {
        let heading = area_of(&harness, help::step(step)[0]).min;
        let next = if step == Step::Keep { help::DONE } else { help::NEXT };
        let from_heading = |name: &str| area_of(&harness, name).min - heading;
        buttons.push([from_heading(help::BACK), from_heading(next)]);
        let card = card(&harness, step);
        let status = harness.get_by_role_and_label(Role::ComboBox, strings::OUTPUT).rect();
        assert!(!card.intersects(status), "{step:?}: {card:?} on {status:?}");
        match step {
            Step::Drag => assert!(!card.intersects(canvas(&harness)), "{card:?}"),
            Step::Stroke => {
                let pad = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect();
                assert!(!card.intersects(pad), "{card:?} on {pad:?}");
            }
            Step::Blend => {
                let slider = harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).rect();
                assert!(!card.intersects(slider), "{card:?} on {slider:?}");
            }
            Step::Keep => {
                click(&mut harness, document::FILE);
                harness.run_steps(2);
                for entry in [document::NEW, document::SAVE_AS, document::QUIT, authored::ADD] {
                    for named in harness.get_all_by_label(entry) {
                        assert!(!card.intersects(named.rect()), "{entry}: {card:?} on {:?}", named.rect());
                    }
                }
            }
        }
        if step != Step::Keep {
            click(&mut harness, help::NEXT);
            harness.run_steps(4);
        }
    }
    for moved in &buttons {
        for (button, first) in moved.iter().zip(buttons[0]) {
            assert!((*button - first).length() < 1.0, "{buttons:?}");
        }
    }
}

/// A second click at the same place neither changes the project nor reaches another button.
#[test]
fn a_double_click_on_a_card_is_one_step() {
    let mut harness = author();
    let before = window(&harness).project().clone();
    carry_out(&mut harness, Command::BeginTour);
    for (i, step) in Step::ALL.into_iter().enumerate() {
        assert!(says(&harness, &help::progress(i + 1, Step::ALL.len())), "{step:?}");
        let next = if step == Step::Keep { help::DONE } else { help::NEXT };
        let at = area_of(&harness, next).center();
        harness.hover_at(at);
        harness.run_steps(1);
        press(&mut harness, at);
        harness.run_steps(1);
        press(&mut harness, at);
        harness.run_steps(3);
        assert_eq!(window(&harness).project(), &before, "after {step:?}");
    }
    assert!(harness.query_by_label(help::DONE).is_none());
}

#[test]
fn clicks_beside_the_place_change_nothing_until_the_tour_ends() {
    let mut harness = author();
    let before = window(&harness).project().clone();
    carry_out(&mut harness, Command::BeginTour);
    let slider = harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).rect();
    let texture = area_of(&harness, &strings::texture("Glass"));
    for at in [slider.right_center() - egui::vec2(4.0, 0.0), texture.center()] {
        click_at(&mut harness, at);
        assert_eq!(window(&harness).project(), &before, "{at:?}");
    }
    click(&mut harness, help::NEXT);
    harness.run_steps(4);
    let somewhere = canvas(&harness).lerp_inside(egui::vec2(0.3, 0.3));
    click_at(&mut harness, somewhere);
    assert_eq!(window(&harness).project(), &before, "the pad is the place of this card");
    click(&mut harness, help::BACK);
    harness.run_steps(4);
    assert!(says(&harness, help::step(Step::Drag)[0]));
    harness.key_press(Key::Escape);
    harness.run_steps(4);
    assert!(!says(&harness, help::SKIP));
    click_at(&mut harness, somewhere);
    assert_ne!(window(&harness).project(), &before, "the same click moves the point now");
}
