use super::{AxisColumns, list_places};
use crate::axes::{placed_on, placed_with};
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::library::{Library, Place};
use shagreen_formats::project::AddedCoordinates;
use shagreen_formats::starter::simulated_library;

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// The simulated library, whose first texture has neither a position nor attributes.
fn with_an_unplaced_texture() -> Library {
    let mut library = simulated_library().unwrap();
    (library.textures[0].place, library.textures[0].attributes) = (None, None);
    library
}

#[test]
fn added_coordinates_are_used_where_nothing_else_gives_one() {
    let library = with_an_unplaced_texture();
    let id = library.textures[0].id.clone();
    let axes = named(&["hard-soft", "flat-bumpy", "centroid"]);
    let mut added = AddedCoordinates::default();
    let place = |added: &AddedCoordinates| {
        let found = list_places(&library, Some(&axes), &mut AxisColumns::default(), added);
        assert_eq!(
            found,
            placed_with(&library, &axes, added).unwrap().textures.iter().map(|t| t.place).collect::<Vec<_>>()
        );
        found[0]
    };
    added.set(&id, "hard-soft", 12.0);
    assert_eq!(place(&added), None, "flat-bumpy is missing");
    added.set(&id, "flat-bumpy", 34.0);
    // Its vibration gives the third one.
    added.set(&id, "centroid", 99.0);
    let centroid = SignalAxis::Centroid.of(&library.textures[0].model).unwrap();
    let at = SpacePoint::of(&[12.0, 34.0, centroid]).unwrap();
    assert_eq!(place(&added), Some(Place::new(at, LabelSource::Estimated)));
    // The others are as without it.
    let placed = placed_with(&library, &axes, &added).unwrap();
    assert_eq!(placed.textures[1..], placed_on(&library, &axes).unwrap().textures[1..]);
    let mut columns = AxisColumns::default();
    columns.places(&library, &axes, &added);
    let given = ["hard-soft", "flat-bumpy", "centroid", "warm-cold"].map(|axis| columns.coordinate(axis, 0));
    assert_eq!(given, [None, None, Some(centroid), None]);
    assert_eq!(columns.coordinate("flat-bumpy", 1), placed.textures[1].at().unwrap().get(1));
}

/// A space of added textures alone would be none of the library.
#[test]
fn an_axis_that_no_texture_has_stays_unknown() {
    let library = with_an_unplaced_texture();
    let mut added = AddedCoordinates::default();
    for axis in ["rough-smooth", "warm-cold"] {
        added.set(&library.textures[0].id, axis, 50.0);
    }
    let axes = named(&["rough-smooth", "warm-cold"]);
    let places = list_places(&library, Some(&axes), &mut AxisColumns::default(), &added);
    assert!(places.iter().all(Option::is_none));
    assert!(placed_with(&library, &axes, &added).is_err());
}
