//! Points outside the convex hull in a space with more axes than the canvas: what plays, what the canvas says, and the map.

use egui::accesskit::Role;
use egui::{Key, Rect};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::Command;
use shagreen_app::state::edit::Edit;
use shagreen_app::strings::{self, axes as words, map};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authored, Outside};
use shagreen_core::space::heat_map::Quantity;

use super::{THIRD, click_at, point, set, sliced, third};
use crate::support::{Author, click, painted, says, wait, window, words as words_of};
use crate::views::carry_out;

fn on_canvas(harness: &Author) -> Vec<String> {
    painted(harness, strings::CANVAS).iter().filter_map(words_of).collect()
}

fn authored(harness: &Author) -> Authored {
    window(harness).session().authored().expect("a texture").clone()
}

#[test]
fn the_canvas_says_which_coordinate_of_the_point_that_plays_differs() {
    let mut harness = sliced();
    // All textures have a higher spectral centroid.
    set(&mut harness, THIRD, 0.0);
    let (wanted, used) = (point(&harness), authored(&harness).location);
    assert!(used.clamped && third(used.at) > 20.0, "{used:?}");
    let said = words::nearest("centroid", third(used.at), 0.0);
    assert!(on_canvas(&harness).contains(&said), "{:?}", on_canvas(&harness));
    // A point that looks like one of the hull counts as inside.
    let slightly = used.at.toward(wanted, 0.02 / used.at.distance(wanted));
    carry_out(&mut harness, Command::Edit(Edit::MovePoint(slightly)));
    assert!(authored(&harness).location.clamped, "the point of the hull plays");
    let texts = on_canvas(&harness);
    assert!(!texts.iter().any(|text| text.contains("Outside")), "{texts:?}");
}

/// Number field beside the slider of the third axis.
fn number(harness: &Author) -> Rect {
    let slider = harness.get_by_role_and_label(Role::Slider, THIRD).rect();
    let numbers = harness.get_all_by_role(Role::SpinButton).map(|number| number.rect());
    let mut beside = numbers
        .filter(|number| slider.y_range().contains(number.center().y) && number.left() > slider.left());
    beside.next().expect("a number")
}

#[test]
fn a_click_on_a_number_keeps_its_further_decimals() {
    let mut harness = sliced();
    let exact = SpacePoint::of(&[48.86, 49.74, 70.03]).expect("a point");
    carry_out(&mut harness, Command::Edit(Edit::MovePoint(exact)));
    let number = number(&harness);
    click_at(&mut harness, number.center());
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(point(&harness), exact);
}

/// Where all points of a slice are outside the hull, the map shows what plays.
#[test]
fn a_map_outside_the_hull_shows_the_nearest_points() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 0.0);
    assert!(authored(&harness).location.clamped);
    carry_out(&mut harness, Command::ShowMap(Some(Quantity::Level)));
    let is_there = |h: &Author| says(h, ", from ") && !says(h, map::WAITING);
    wait(&mut harness, "the map is there", is_there);
    assert!(!says(&harness, map::NO_VALUES));
    let outside = [Outside::Clamped, Outside::Extrapolated].map(map::outside);
    assert!(says(&harness, outside[0]) && !says(&harness, outside[1]));
    click(&mut harness, strings::BEYOND);
    assert!(says(&harness, outside[1]) && !says(&harness, outside[0]));
    carry_out(&mut harness, Command::ShowMap(Some(Quantity::Distance)));
    assert!(!says(&harness, outside[1]), "it does not depend on what plays");
}
