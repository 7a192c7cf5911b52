//! Layout of the inspector: the cards of the contributing textures, and its scroll bar.

use egui::accesskit::Role;
use egui::{Rect, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::look::theme::INSPECTOR_WIDTH;
use shagreen_app::strings;
use shagreen_studio::project::new_project;

use crate::frame::painted;
use crate::support::{Author, author_of, begin, says, wait_for_field, window};

/// Least opacity of the handle of a scroll bar that is visible, of 255.
const LEAST_ALPHA: u8 = 80;

fn opened(size: [f32; 2]) -> Author {
    let mut harness = author_of(begin(new_project()), size);
    wait_for_field(&mut harness);
    harness.remove_cursor();
    harness.run_steps(10);
    harness
}

/// Names of the cards, heaviest texture first.
fn card_names(harness: &Author) -> Vec<String> {
    let session = window(harness).session();
    let textures = session.textures();
    let card = |(texture, weight): &(usize, f64)| strings::parent(&textures[*texture].name, 100.0 * weight);
    let names = session.authored().expect("a texture").parents.iter().map(card);
    names.filter(|name| harness.query_by_label(name).is_some()).collect()
}

fn area(harness: &Author, name: &str) -> Rect {
    harness.get_by_label(name).rect()
}

/// Upper edge of the row with pad and scope.
fn stage_top(harness: &Author) -> f32 {
    harness.get_by_label(strings::HAND_START).rect().top()
}

/// Scroll bar of the inspector.
fn bar(harness: &Author, size: [f32; 2]) -> Option<Rect> {
    let nodes = harness.root().children_recursive();
    let bars = nodes.filter(|node| {
        let inner = node.accesskit_node();
        inner.role() == Role::ScrollBar && inner.raw_bounds().is_some()
    });
    let mut areas = bars.map(|node| node.rect());
    areas.find(|bar| bar.left() > size[0] - INSPECTOR_WIDTH && bar.top() < stage_top(harness))
}

#[test]
fn three_cards_fit_at_1280_by_720() {
    let size = [1280.0, 720.0];
    let harness = opened(size);
    let cards = card_names(&harness);
    assert_eq!(cards.len(), 3, "{cards:?}");
    for card in &cards {
        let area = area(&harness, card);
        assert!(area.bottom() < stage_top(&harness), "{card} at {area:?}");
    }
    assert_eq!(bar(&harness, size), None, "nothing scrolls");
}

#[test]
fn the_smallest_window_scrolls_to_the_cards_with_a_visible_bar() {
    let size = [960.0, 600.0];
    let mut harness = opened(size);
    let last = card_names(&harness).pop().expect("a card");
    assert!(area(&harness, &last).bottom() > stage_top(&harness), "it needs scrolling");
    let bar = bar(&harness, size).expect("a scroll bar").expand(1.0);
    let is_handle = |shape: &Shape| match shape {
        Shape::Rect(rect) => rect.fill.a() >= LEAST_ALPHA && bar.contains_rect(rect.rect),
        _ => false,
    };
    assert!(painted(&harness).iter().any(|painted| is_handle(painted.shape)), "no handle in {bar:?}");
    harness.get_by_label(&last).scroll_to_me();
    harness.run_steps(20);
    let area = area(&harness, &last);
    assert!(area.bottom() < stage_top(&harness), "{area:?}");
}

/// A large window has cards for more textures, and counts the others.
#[test]
fn a_large_window_has_more_cards() {
    let size = [2560.0, 1440.0];
    let harness = opened(size);
    let cards = card_names(&harness);
    assert!(cards.len() > 5, "{cards:?}");
    for card in &cards {
        assert!(area(&harness, card).bottom() < stage_top(&harness), "{card}");
    }
    let n_parents = window(&harness).session().authored().expect("a texture").parents.len();
    assert!(says(&harness, &strings::more_parents(n_parents - cards.len())));
    assert_eq!(bar(&harness, size), None);
}
