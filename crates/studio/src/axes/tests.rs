use super::{
    AxesError, AxisColumns, AxisSource, KnownAxis, axis_poles, axis_values, evaluate, known_axes, placed_on,
    presets,
};
use crate::project::{new_project, textures_of, textures_on_axes};
use shagreen_core::space::axis_evaluation::AxisEvaluationError;
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::library::{Attribute, Attributes, Library, Place, read_library, write_library};
use shagreen_formats::project::{AddedCoordinates, read_project};
use shagreen_formats::starter::{simulated_library, starter_library};
use std::path::Path;

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn simulated() -> Library {
    simulated_library().unwrap()
}

fn attributes(source: LabelSource, values: &[(&str, f64)]) -> Attributes {
    let value = |(name, value): &(&str, f64)| Attribute { name: (*name).to_owned(), value: *value };
    Attributes { source, values: values.iter().map(value).collect() }
}

#[test]
fn axes_of_positions_come_before_attributes_and_features() {
    let known = known_axes(&simulated());
    let found: Vec<(&str, AxisSource)> = known.iter().map(|axis| (axis.name.as_str(), axis.source)).collect();
    let signals = SignalAxis::ALL.map(|axis| (axis.name(), AxisSource::Signal(axis)));
    let expected = [
        ("rough-smooth", AxisSource::Position(0)),
        ("hard-soft", AxisSource::Position(1)),
        ("flat-bumpy", AxisSource::Attribute),
        ("sticky-slippery", AxisSource::Attribute),
        ("irritating-pleasant", AxisSource::Attribute),
    ];
    assert_eq!(found, [&expected[..], &signals[..]].concat());
    assert!(known.iter().all(|axis| axis.n_known == 25), "{known:?}");
    for axis in known {
        let values: Vec<f64> = axis_values(&simulated(), &axis.name).unwrap().into_iter().flatten().collect();
        let [low, high] = axis.range;
        assert!(low < high && values.contains(&low) && values.contains(&high), "{}", axis.name);
        assert!(values.iter().all(|value| (low..=high).contains(value)), "{}", axis.name);
    }
}

#[test]
fn only_axes_that_a_texture_has_are_known() {
    let mut library = starter_library().unwrap();
    for texture in &mut library.textures {
        texture.place = None;
        texture.model = texture.model.clone().with_tap(None);
    }
    library.textures[3].attributes =
        Some(attributes(LabelSource::HumanRatings, &[("hard-soft", 30.0), ("centroid", 5.0)]));
    let known = known_axes(&library);
    // An attribute replaces an axis without positions, and a feature of the same name.
    let expected = [("hard-soft", AxisSource::Attribute, 1), ("centroid", AxisSource::Attribute, 1)];
    let is = |axis: &KnownAxis, (name, source, n_known): (&str, AxisSource, usize)| {
        (axis.name.as_str(), axis.source, axis.n_known) == (name, source, n_known)
    };
    assert!(known.iter().zip(expected).all(|(axis, expected)| is(axis, expected)), "{known:?}");
    let names: Vec<&str> = known[2..].iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["speed exponent", "force exponent"], "no texture has a tap");
    assert_eq!(axis_values(&library, "tap frequency"), None);
    assert_eq!(axis_values(&library, "rough-smooth"), None);
    assert!(known_axes(&Library::default()).is_empty());
}

#[test]
fn values_are_those_of_the_first_source_with_the_name() {
    let library = simulated();
    let texture = &library.textures[4];
    let (at, rated) = (texture.at().unwrap(), texture.attributes.as_ref().unwrap());
    let value = |name: &str| axis_values(&library, name).unwrap()[4];
    assert_eq!((value("rough-smooth"), value("hard-soft")), (Some(at.x()), Some(at.y())));
    assert_eq!(value("attribute:rough-smooth"), rated.get("rough-smooth"));
    assert_ne!(value("attribute:rough-smooth"), value("rough-smooth"));
    assert_eq!(value("flat-bumpy"), rated.get("flat-bumpy"));
    assert_eq!(value("attribute:flat-bumpy"), rated.get("flat-bumpy"));
    assert_eq!(value("tap-frequency"), SignalAxis::TapFrequency.of(&texture.model));
    assert_eq!(axis_values(&library, "attribute:centroid"), None);
    assert_eq!(axis_values(&library, "warm-cold"), None);
}

#[test]
fn own_axes_leave_the_library_as_it_is() {
    let library = simulated();
    let own = named(&["rough-smooth", "hard-soft"]);
    assert_eq!(placed_on(&library, &own).unwrap(), library);
    // Even without positions.
    assert_eq!(placed_on(&Library::default(), &own).unwrap(), Library::default());
}

#[test]
fn a_texture_without_an_axis_has_no_position() {
    let mut library = simulated();
    library.textures[3].attributes = None;
    let axes = named(&["rough-smooth", "flat-bumpy", "centroid"]);
    let placed = placed_on(&library, &axes).unwrap();
    assert_eq!((placed.axes.as_ref(), placed.textures[3].place), (Some(&axes), None));
    let before = &library.textures[0];
    let bumpy = before.attributes.as_ref().unwrap().get("flat-bumpy");
    let expected = [Some(before.at().unwrap().x()), bumpy, SignalAxis::Centroid.of(&before.model)];
    let at = placed.textures[0].at().unwrap();
    assert_eq!([0, 1, 2].map(|axis| at.get(axis)), expected);
    // The coordinates are kept for the next choice of axes, with the same result.
    let mut columns = AxisColumns::default();
    let places: Vec<Option<Place>> = placed.textures.iter().map(|texture| texture.place).collect();
    for axes in [&axes[1..], &axes[..]] {
        let found = columns.places(&library, axes, &AddedCoordinates::default());
        assert_eq!(
            found,
            placed_on(&library, axes).unwrap().textures.iter().map(|t| t.place).collect::<Vec<_>>()
        );
    }
    let nothing = AddedCoordinates::default();
    assert_eq!(columns.places(&library, &axes, &nothing), places);
    let unknown = columns.places(&library, &named(&["rough-smooth", "sour-sweet"]), &nothing);
    assert_eq!(unknown, vec![None; library.textures.len()]);
    // Nothing else changes.
    for (before, after) in library.textures.iter().zip(&placed.textures) {
        assert_eq!(before.model, after.model);
        assert_eq!((&before.id, &before.attributes), (&after.id, &after.attributes));
    }
}

#[test]
fn a_placed_library_is_written_and_read() {
    let library = simulated();
    let six =
        named(&["hard-soft", "flat-bumpy", "rough-smooth", "centroid", "speed exponent", "force exponent"]);
    for (axes, stated) in [
        (named(&["centroid"]), Some(named(&["centroid"]))),
        (named(&["sticky-slippery", "tap-frequency"]), Some(named(&["sticky-slippery", "tap frequency"]))),
        (named(&["attribute:rough-smooth", "attribute:hard-soft"]), None),
        (six.clone(), Some(six)),
    ] {
        let placed = placed_on(&library, &axes).unwrap();
        assert_eq!(placed.axes, stated);
        let back = read_library(&write_library(&placed)).unwrap().value;
        assert_eq!((back.axis_names(), back.positions().len()), (placed.axis_names(), 25));
        for (read, written) in back.positions().into_iter().zip(placed.positions()) {
            // Files keep six decimals.
            assert!(read.unwrap().distance(written.unwrap()) < 1e-5);
            assert_eq!(read.unwrap().n_axes(), axes.len());
        }
    }
}

#[test]
fn label_source_and_deviation_follow_the_axes() {
    let mut library = starter_library().unwrap();
    for texture in &mut library.textures {
        let place = texture.place.as_mut().unwrap();
        (place.source, place.deviation) = (LabelSource::Estimated, Some([3.0, 4.0]));
        texture.attributes = Some(attributes(LabelSource::HumanRatings, &[("warm-cold", 20.0)]));
    }
    let place = |axes: &[&str]| {
        let place = placed_on(&library, &named(axes)).unwrap().textures[7].place.unwrap();
        (place.source, place.deviation)
    };
    let estimated = LabelSource::Estimated;
    assert_eq!(place(&["rough-smooth", "hard-soft", "warm-cold"]), (estimated, Some([3.0, 4.0])));
    assert_eq!(place(&["hard-soft", "rough-smooth", "warm-cold"]), (estimated, None));
    assert_eq!(place(&["rough-smooth", "warm-cold"]), (estimated, None));
    assert_eq!(place(&["centroid", "warm-cold", "hard-soft"]), (LabelSource::HumanRatings, None));
    assert_eq!(place(&["centroid", "tap frequency"]), (LabelSource::PhysicalLabels, None));
    let physical = placed_on(&library, &named(&["centroid"])).unwrap();
    assert!(physical.origin.contains("Positions come from physical labels."), "{}", physical.origin);
}

#[test]
fn wrong_axes_are_named() {
    let library = starter_library().unwrap();
    let error = |names: &[&str]| placed_on(&library, &named(names)).unwrap_err();
    assert_eq!(error(&[]), AxesError::Count { n: 0 });
    assert_eq!(error(&["a", "b", "c", "d", "e", "f", "g"]), AxesError::Count { n: 7 });
    let twice = |name: &str| AxesError::Twice { name: name.to_owned() };
    assert_eq!(error(&["centroid", "rough-smooth", "centroid"]), twice("centroid"));
    assert_eq!(error(&["tap frequency", "tap-frequency"]), twice("tap frequency"));
    let text = error(&["rough-smoth"]).to_string();
    assert!(text.contains("did you mean \"rough-smooth\"?") && text.contains("speed exponent"), "{text}");
    let text = error(&["warm-cold-xyz"]).to_string();
    assert!(!text.contains("did you mean") && text.contains("choose from rough-smooth, hard-soft"), "{text}");
    // An attribute and a position of the same name would have one name in a file.
    let both = placed_on(&simulated(), &named(&["rough-smooth", "attribute:rough-smooth"])).unwrap_err();
    assert_eq!(both, twice("rough-smooth"));
    let mut apart = library.clone();
    apart.textures[0].attributes = Some(attributes(LabelSource::HumanRatings, &[("a-b", 1.0)]));
    apart.textures[1].attributes = Some(attributes(LabelSource::HumanRatings, &[("c-d", 1.0)]));
    let nothing = placed_on(&apart, &named(&["a-b", "c-d"])).unwrap_err();
    assert_eq!(nothing, AxesError::Nothing { axes: named(&["a-b", "c-d"]) });
}

#[test]
fn presets_need_all_of_their_axes() {
    let names =
        |library: &Library| presets(library).into_iter().map(|preset| preset.name).collect::<Vec<_>>();
    assert_eq!(names(&starter_library().unwrap()), ["authoring paper"]);
    assert_eq!(names(&simulated()), ["authoring paper", "CNN-LSTM paper"]);
    assert!(names(&Library::default()).is_empty());
    for preset in presets(&simulated()) {
        let placed = placed_on(&simulated(), &preset.axes).unwrap();
        assert_eq!(placed.axis_names(), preset.axes);
        assert!(placed.textures.iter().all(|texture| texture.place.is_some()));
    }
}

#[test]
fn poles_are_words() {
    for (name, expected) in [
        ("rough-smooth", ["rough", "smooth"]),
        ("attribute:rough-smooth", ["rough", "smooth"]),
        ("centroid", ["dull", "bright"]),
        ("speed-exponent", ["same at any speed", "louder when fast"]),
        ("dimension 2", ["low dimension 2", "high dimension 2"]),
        ("attribute:dimension 12", ["low dimension 12", "high dimension 12"]),
        ("warm", ["warm", ""]),
    ] {
        assert_eq!(axis_poles(name), expected, "{name}");
    }
}

#[test]
fn an_evaluation_adds_axes_to_the_first_ones() {
    let library = simulated();
    let first = named(&["rough-smooth", "hard-soft"]);
    let candidates = named(&["centroid", "hard-soft"]);
    let found = evaluate(&library, &first, Some(&candidates), &mut |_, _| true).unwrap();
    assert_eq!(found.names, named(&["rough-smooth", "hard-soft", "centroid"]));
    let steps: Vec<(usize, usize)> = found.found.steps.iter().map(|step| (step.n_axes, step.added)).collect();
    assert_eq!((steps, found.found.textures.len()), (vec![(2, 1), (3, 2)], 25));
    let error = |first: &[&str], candidates: &[&str]| {
        evaluate(&library, &named(first), Some(&named(candidates)), &mut |_, _| true).unwrap_err()
    };
    let unknown = error(&["rough-smooth"], &["centroyd"]).to_string();
    assert!(unknown.contains("did you mean \"centroid\"?"), "{unknown}");
    let twice = error(&["centroid", "centroid"], &[]);
    assert!(matches!(twice.downcast_ref(), Some(AxisEvaluationError::First)), "{twice}");
    let mut n_calls = 0;
    let stopped = evaluate(&library, &first, None, &mut |_, _| {
        n_calls += 1;
        false
    });
    assert!(stopped.is_err() && n_calls == 1);
}

/// In version 1.0, the axes of a project were its attributes, even if its positions have axes of the same names.
#[test]
fn an_older_project_keeps_its_positions() {
    let bytes = include_bytes!("../../../../vectors/project/1.0.shagreen");
    let nothing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
    let mut project = read_project(bytes, Path::new("/somewhere"), &nothing).unwrap().value;
    let place = |library: &Library| library.textures[library.index_of("cork").unwrap()].place.unwrap();
    let of_files = textures_of(&project).unwrap();
    assert_eq!(place(&of_files).at, SpacePoint::plane(40.0, 60.0));
    let on_axes = textures_on_axes(&project).unwrap();
    let rated = Place::new(SpacePoint::plane(20.0, 45.0), LabelSource::SimulatedRaters);
    assert_eq!((place(&on_axes), on_axes.axis_names()), (rated, vec!["warm-cold", "flat-bumpy"]));
    project.axes = Some(named(&["warm-cold", "flat-bumpy"]));
    assert_eq!(textures_on_axes(&project).unwrap(), of_files);
    project.axes = Some(named(&["attribute:flat-bumpy", "centroid", "warm-cold"]));
    let mixed = place(&textures_on_axes(&project).unwrap()).at;
    assert_eq!((mixed.x(), mixed.get(2)), (45.0, Some(40.0)));
    project.axes = Some(named(&["rough-smooth"]));
    assert!(format!("{:#}", textures_on_axes(&project).unwrap_err()).contains("rough-smooth"));
}

#[test]
fn a_project_without_axes_has_the_positions_of_its_files() {
    let project = new_project();
    assert_eq!(textures_on_axes(&project).unwrap(), textures_of(&project).unwrap());
}
