//! Coordinates that a change of the axes drops: a message names them, and a snapshot brings them back.

use shagreen_app::command::Command;
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::state::edit::Edit;
use shagreen_app::strings::authored;
use shagreen_app::strings::axes as words;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::ProjectLibrary;

use super::{AXES, THIRD, point, set, sliced};
use crate::support::{Author, click, says, window};
use crate::views::carry_out;

fn named(axes: &[&str]) -> Vec<String> {
    axes.iter().map(|name| (*name).to_owned()).collect()
}

/// Chooses axes, and does not wait: the message disappears by itself.
fn choose(harness: &mut Author, axes: &[&str]) {
    carry_out(harness, Command::Axes(AxesCommand::Use(named(axes))));
}

fn drops(harness: &Author, axes: &[&str]) -> bool {
    says(harness, &words::coordinates_dropped(&named(axes), ""))
}

#[test]
fn dropped_coordinates_are_named_and_a_snapshot_brings_them_back() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 71.0);
    carry_out(&mut harness, Command::Edit(Edit::KeepSnapshot));
    let (taken, name) = (point(&harness), window(&harness).project().texture().name.clone());
    choose(&mut harness, &["tap frequency", "speed exponent"]);
    assert!(drops(&harness, &AXES));
    choose(&mut harness, &AXES[..2]);
    assert!(drops(&harness, &["tap frequency", "speed exponent"]));
    click(&mut harness, &authored::snapshot(1, &name));
    assert!(says(&harness, &authored::restored(1, &name, "")));
    assert_eq!(point(&harness), taken.on(2));
    // On an axis of which it states nothing, it has the local mean, which a message says.
    choose(&mut harness, &["rough-smooth", "centroid", "tap frequency"]);
    assert!(drops(&harness, &["hard-soft"]));
    click(&mut harness, &authored::snapshot(1, &name));
    let means = named(&["tap frequency"]);
    assert!(says(&harness, &authored::restored_on(&means, 1, &name, "")));
    let told = [taken.get(0), taken.get(2), None];
    assert_eq!(point(&harness), window(&harness).session().completed(&told));
    // Axes that stay drop nothing.
    choose(&mut harness, &["rough-smooth", "centroid", "tap frequency", "hard-soft"]);
    assert!(says(&harness, &words::chosen(4, &[], "")));
}

#[test]
fn another_library_keeps_the_axes_that_it_knows_and_names_those_that_it_drops() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 71.0);
    let before = point(&harness);
    let open = |harness: &mut Author, library: BuiltIn| {
        carry_out(harness, Command::Edit(Edit::OpenLibrary(ProjectLibrary::BuiltIn(library))));
    };
    open(&mut harness, BuiltIn::Simulated);
    assert_eq!((window(&harness).session().axes(), point(&harness)), (&named(&AXES)[..], before));
    assert!(!says(&harness, "are dropped"));
    choose(&mut harness, &["rough-smooth", "hard-soft", "flat-bumpy", "centroid"]);
    open(&mut harness, BuiltIn::Starter);
    assert!(drops(&harness, &["flat-bumpy", "centroid"]));
    assert_eq!((window(&harness).session().n_axes(), point(&harness)), (2, before.on(2)));
}
