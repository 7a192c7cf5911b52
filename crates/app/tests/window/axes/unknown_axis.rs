//! Axes on which no texture has a value, and axes that only the project stores.

use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::Command;
use shagreen_app::strings::{self, axes as words};
use shagreen_studio::project::new_project;

use super::{point, sliced, use_axes};
use crate::support::{author_of, begin, click, says, unnamed_controls, wait, wait_for_field, window};
use crate::views::carry_out;

#[test]
fn the_canvas_names_an_axis_that_no_texture_has_and_offers_others() {
    let mut project = new_project();
    project.axes = Some(["rough-smooth", "warm-cold"].map(str::to_owned).to_vec());
    let mut harness = author_of(begin(project), [1280.0, 720.0]);
    harness.run_steps(4);
    assert!(says(&harness, &words::missing(&["warm-cold"])));
    assert!(!says(&harness, strings::NO_PLACES));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, words::CHOOSE);
    wait(&mut harness, "the axes are read", |h| h.query_by_label(words::AS_PLACED).is_some());
    harness.run_steps(6);
    click(&mut harness, words::AS_PLACED);
    click(&mut harness, words::USE);
    wait_for_field(&mut harness);
    assert_eq!(window(&harness).session().axes(), ["rough-smooth", "hard-soft"]);
    assert!(!says(&harness, "No texture of") && harness.query_by_label(words::CHOOSE).is_none());
    assert_eq!(point(&harness).n_axes(), 2);
}

#[test]
fn a_saved_library_keeps_its_own_axes_and_the_sheet_says_so() {
    let mut harness = sliced();
    let stored = words::stored(&["rough-smooth", "hard-soft"]);
    carry_out(&mut harness, Command::OpenSave);
    assert!(says(&harness, &stored));
    carry_out(&mut harness, Command::CloseSheet);
    use_axes(&mut harness, &["rough-smooth", "hard-soft"]);
    carry_out(&mut harness, Command::OpenSave);
    assert!(!says(&harness, &stored));
}
