use super::{
    Along, AtEnd, Key, MAX_KEYS, PathProgress, PrecomputedProgress, Route, Stop, TexturePath,
    TexturePathError,
};
use crate::space::SpacePoint;
use crate::space::authoring::tests::world;
use crate::texture::blend::Mode;
use crate::texture::shape::Shape;
use crate::units::Contact;

fn stop(rs: f64, hs: f64, along: f64) -> Stop {
    Stop { at: SpacePoint::new(rs, hs).unwrap(), along }
}

fn route(at_end: AtEnd) -> Route {
    let stops = vec![stop(30.0, 30.0, 0.0), stop(70.0, 30.0, 0.04), stop(70.0, 60.0, 0.05)];
    Route::new(Along::Distance, at_end, stops).unwrap()
}

#[test]
fn a_route_is_straight_between_stops_and_ends_as_it_was_told() {
    for (at_end, traveled, want) in [
        (AtEnd::Hold, -1.0, (30.0, 30.0)),
        (AtEnd::Hold, 0.01, (40.0, 30.0)),
        (AtEnd::Hold, 0.045, (70.0, 45.0)),
        (AtEnd::Hold, 9.0, (70.0, 60.0)),
        (AtEnd::Turn, 0.055, (70.0, 45.0)),
        (AtEnd::Turn, 0.09, (40.0, 30.0)),
        (AtEnd::Turn, 0.11, (40.0, 30.0)),
        (AtEnd::Repeat, 0.06, (40.0, 30.0)),
    ] {
        let at = route(at_end).point_at(traveled);
        assert!((at.x() - want.0).abs() < 1e-9 && (at.y() - want.1).abs() < 1e-9, "{at:?}");
    }
    let nan = route(AtEnd::Turn).point_at(f64::NAN);
    assert!((nan.x(), nan.y()) == (30.0, 30.0));
}

#[test]
fn a_path_follows_its_route() {
    let world = world(12, 1.0, 2);
    let route = route(AtEnd::Hold);
    let path = TexturePath::of_route(&world.authoring, &route, &Mode::Field.into()).unwrap();
    // A segment of forty points in steps of four, then one of thirty points.
    assert_eq!(path.keys().len(), 10 + 8 + 1);
    assert_eq!(path.keys().iter().filter(|key| key.is_stop).count(), 3);
    for i in 0..=50 {
        let traveled = 0.001 * f64::from(i);
        let (key, share) = path.between(traveled);
        let [a, b] = [key, (key + 1).min(path.keys().len() - 1)].map(|k| path.keys()[k].stop.at);
        let at = route.point_at(traveled);
        let between = a.x() + share * (b.x() - a.x());
        assert!((between - at.x()).abs() < 1e-9, "{traveled}");
    }
    let own = world.authoring.author(route.stops()[1].at, &Mode::Field.into()).unwrap().model;
    assert_eq!(
        path.keys().iter().find(|key| key.stop == route.stops()[1]).map(|key| &key.model),
        own.as_ref()
    );
}

#[test]
fn long_routes_of_many_stops_stay_within_the_limit() {
    let world = world(5, 1.0, 2);
    for n in [2, 20, MAX_KEYS] {
        let stops = (0..n).map(|i| stop(100.0 * f64::from(i as u32 % 2), 50.0, i as f64)).collect();
        let route = Route::new(Along::Time, AtEnd::Turn, stops).unwrap();
        let path = TexturePath::of_route(&world.authoring, &route, &Mode::Parametric.into()).unwrap();
        assert!(path.keys().len() <= MAX_KEYS, "{} of {n}", path.keys().len());
    }
}

#[test]
fn what_is_no_path_is_said() {
    let new = |stops: Vec<Stop>| Route::new(Along::Time, AtEnd::Hold, stops).unwrap_err();
    assert_eq!(new(vec![stop(1.0, 1.0, 0.0)]), TexturePathError::TooFew { n: 1 });
    let back = new(vec![stop(1.0, 1.0, 0.0), stop(2.0, 2.0, 1.0), stop(3.0, 3.0, 1.0)]);
    assert_eq!(back, TexturePathError::Order { number: 3, at: 1.0, along: Along::Time });
    assert!(back.to_string().contains("point 3 of the path is at 1 s"), "{back}");
    assert!(matches!(new(vec![stop(1.0, 1.0, 0.5); 2]), TexturePathError::Order { number: 1, .. }));
    assert!(matches!(
        new(vec![stop(1.0, 1.0, 0.0), stop(1.0, 1.0, f64::NAN)]),
        TexturePathError::Order { .. }
    ));
    let world = world(5, 1.0, 2);
    let mixed = TexturePath::of_route(&world.authoring, &route(AtEnd::Hold), &Mode::Shared.into());
    assert_eq!(mixed.unwrap_err(), TexturePathError::Mode);
    let model = world.authoring.author(stop(50.0, 50.0, 0.0).at, &Mode::Field.into()).unwrap().model.unwrap();
    let key = |along: f64| Key { stop: stop(1.0, 1.0, along), is_stop: true, model: model.clone() };
    assert!(TexturePath::new(Along::Time, AtEnd::Hold, vec![key(0.0), key(1.0)]).is_ok());
    assert!(TexturePath::new(Along::Time, AtEnd::Hold, vec![key(1.0), key(0.0)]).is_err());
}

#[test]
fn a_stroke_counts_its_way_or_its_time_and_each_landing_begins_anew() {
    let [down, up] = [1.0, 0.0].map(|force_n| Contact::from_mm_per_s_and_n(200.0, force_n));
    for (along, want) in [(Along::Distance, 0.1), (Along::Time, 0.5)] {
        let mut traveler = PathProgress::new(along);
        (0..25).for_each(|_| traveler.go(down, 0.02));
        assert!((traveler.traveled() - want).abs() < 1e-12, "{}", traveler.traveled());
        (0..9).for_each(|_| traveler.go(up, 0.02));
        assert!((traveler.traveled() - want).abs() < 1e-12, "a lifted tip does not move along the path");
        traveler.go(down, 0.02);
        assert!((traveler.traveled() - 0.04 * want).abs() < 1e-12, "{}", traveler.traveled());
        let mut contact_at = |secs| if secs < 0.5 { down } else { up };
        let ahead = PrecomputedProgress::new(along, 0.6, 0.02, &mut contact_at);
        let [begin, middle, end, after] = [-1.0, 0.25, 0.6, 9.0].map(|secs| ahead.at(secs));
        assert_eq!((begin, end), (0.0, after));
        assert!((middle - 0.52 * want).abs() < 1e-12 && (end - want).abs() < 1e-12, "{middle} {end}");
    }
}

#[test]
fn words_round_trip() {
    for at_end in AtEnd::ALL {
        assert_eq!(AtEnd::from_id(at_end.id()), Some(at_end));
    }
    for along in Along::ALL {
        assert_eq!(Along::from_id(along.id()), Some(along));
    }
}

#[test]
fn a_shape_is_that_of_every_texture_along_the_path() {
    let world = world(12, 1.0, 2);
    let path = TexturePath::of_route(&world.authoring, &route(AtEnd::Hold), &Mode::Field.into()).unwrap();
    let shape = Shape { level_db: -6.0, ..Shape::default() };
    let shaped = path.clone().shaped(&shape).unwrap();
    for (key, before) in shaped.keys().iter().zip(path.keys()) {
        assert_eq!(key.model, shape.apply(&before.model).unwrap());
        assert_eq!((key.stop, key.is_stop), (before.stop, before.is_stop));
    }
    assert_eq!(path.clone().shaped(&Shape::default()), Ok(path));
}
