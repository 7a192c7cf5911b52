use std::cell::RefCell;

use super::{Sound, is_mostly_below};
use crate::report::Reporter;
use crate::trace::steady_trace;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::Contact;
use shagreen_formats::starter::starter_library;
use shagreen_formats::wav::TraceV1;

#[derive(Default)]
struct Notes(RefCell<Vec<String>>);

impl Reporter for Notes {
    fn warn(&self, message: &str) {
        self.note(message);
    }

    fn note(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }
}

/// The starter textures are measured from 30 mm/s and 0.15 N.
#[test]
fn strokes_outside_the_measured_range_are_noted() {
    let library = starter_library().unwrap();
    let cork = Sound::of_texture(&library, "cork", Mode::Field, &Shape::default()).unwrap();
    for (mm_per_s, force_n, words) in [
        (100.0, 1.0, None),
        (30.0, 0.15, None),
        (20.0, 1.0, Some("measured from 30 mm/s and 0.15 N")),
        (100.0, 0.1, Some("fade to silence")),
        (9000.0, 1.0, Some("measured up to")),
        (0.0, 1.0, None),
    ] {
        let notes = Notes::default();
        let trace = steady_trace(Contact::from_mm_per_s_and_n(mm_per_s, force_n), 1.0);
        cork.note_limits(&library, &trace, &notes);
        let said = notes.0.into_inner();
        assert_eq!(said.len(), usize::from(words.is_some()), "{said:?}");
        assert!(words.is_none_or(|words| said[0].contains(words)), "{said:?}");
    }
}

#[test]
fn only_points_that_look_different_from_those_of_the_hull_are_outside() {
    let library = starter_library().unwrap();
    let blending = Blending::default();
    let sound = |at: SpacePoint| {
        let notes = Notes::default();
        let sound = Sound::of_point(&library, at, (&blending, &Shape::default()), &notes).unwrap();
        let of_hull = notes.0.into_inner().into_iter().filter(|said| said.contains("convex hull"));
        (sound, of_hull.collect::<Vec<String>>())
    };
    let corner = SpacePoint::plane(99.0, 99.0);
    let (moved, said) = sound(corner);
    let nearest = moved.at.unwrap();
    assert!(moved.clamped && said.len() == 1 && said[0].contains(&nearest.to_string()), "{said:?}");
    // Outside by a hundredth: the nearest point plays, and nothing is said.
    let slightly = nearest.toward(corner, 0.01 / nearest.distance(corner));
    let (moved, said) = sound(slightly);
    assert!(moved.clamped && moved.at.unwrap().distance(nearest) < 1e-6);
    assert_eq!(said, Vec::<String>::new());
}

#[test]
fn a_stroke_that_starts_at_rest_is_not_below() {
    let trace = |speed_mm_per_s: Vec<f64>| TraceV1 {
        force_n: vec![1.0; speed_mm_per_s.len()],
        time_s: (0..speed_mm_per_s.len()).map(|i| i as f64).collect(),
        speed_mm_per_s,
        ..TraceV1::default()
    };
    assert!(!is_mostly_below(&trace(vec![0.0, 10.0, 100.0, 100.0, 10.0, 0.0]), 50.0, 0.5));
    assert!(is_mostly_below(&trace(vec![0.0, 10.0, 20.0, 100.0]), 50.0, 0.5));
    assert!(!is_mostly_below(&trace(Vec::new()), 50.0, 0.5));
}
