//! A library whose positions have three axes.

use shagreen_formats::starter::starter_library;
use shagreen_studio::axes::placed_on;

use super::{AXES, point};
use crate::support::{author_on, wait_for_field, window};

/// The point of a new project has two coordinates before it has a space.
#[test]
fn a_new_project_has_a_point_on_all_axes_of_its_library() {
    let library = placed_on(&starter_library().unwrap(), &AXES.map(str::to_owned)).unwrap();
    let mut harness = author_on(library, [1280.0, 720.0]);
    wait_for_field(&mut harness);
    assert_eq!(point(&harness).coordinates(), [50.0; 3]);
    assert!(!window(&harness).document().is_changed(), "that is no edit");
}
