//! A texture that changes along a stroke: from wood to cloth, say, over some millimeters or seconds.
//!
//! A route goes from stop to stop through the space. What is played is a path: textures at keys so close that between two of
//! them a mixture under one excitation is as good as a texture of its own, so that it needs no space to be played.

use crate::authoring::{Authoring, Blending};
use crate::space::SpacePoint;
use crate::texture::TextureModel;
use crate::units::Contact;

/// Largest distance of neighboring keys in the space, in points of the axes; longer routes than [`MAX_KEYS`] of them
/// reach have wider ones.
const KEY_STEP: f64 = 4.0;
/// Most keys of a path that is made, and of one that is read: an output holds as many textures.
pub const MAX_KEYS: usize = 48;

/// What is counted along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Along {
    /// What the tip has traveled since it landed, in m.
    #[default]
    Distance,
    /// How long ago it landed, in s.
    Time,
}

/// What happens at the end of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtEnd {
    /// The last texture stays.
    #[default]
    Hold,
    /// Back the same way, to and fro.
    Turn,
    /// From the beginning again.
    Repeat,
}

/// A point that a route goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Where in the space.
    pub at: SpacePoint,
    /// Where along the stroke, in m or s.
    pub along: f64,
}

/// The way of a texture through the space: straight from stop to stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    along: Along,
    at_end: AtEnd,
    stops: Vec<Stop>,
}

/// Why stops are no route, or keys no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TexturePathError {
    /// Fewer than two stops.
    #[error("a path needs at least two points, got {n}")]
    TooFew {
        /// How many there are.
        n: usize,
    },
    /// Too many stops or keys.
    #[error("a path has at most {MAX_KEYS} points, got {n}; leave some out")]
    TooMany {
        /// How many there are.
        n: usize,
    },
    /// The stops do not go on.
    #[error(
        "point {number} of the path is at {} {} of the stroke; the first must be at 0, and each farther on than the one \
         before it",
        .at / .along.unit().0,
        .along.unit().1
    )]
    Order {
        /// Which point, counted from one.
        number: usize,
        /// Where along the stroke, in m or s.
        at: f64,
        /// What is counted along it.
        along: Along,
    },
    /// Textures of different rates.
    #[error("the textures of a path have different rates, {first_hz} and {other_hz} Hz")]
    Rates {
        /// Rate of the first.
        first_hz: f64,
        /// One that differs.
        other_hz: f64,
    },
    /// The mode makes no texture.
    #[error("a path is made of textures that are made for its points: choose the mode field or parametric")]
    Mode,
    /// There is no texture at a point.
    #[error("there is no texture at {at}; place textures around it first")]
    NoTexture {
        /// Where.
        at: SpacePoint,
    },
}

impl Along {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Distance, Self::Time];

    /// What people count it in: how many m or s one is, and its name.
    pub fn unit(self) -> (f64, &'static str) {
        match self {
            Self::Distance => (1e-3, "mm"),
            Self::Time => (1.0, "s"),
        }
    }

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Time => "time",
        }
    }

    /// What has this [`Along::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|along| along.id() == id)
    }
}

impl AtEnd {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Hold, Self::Turn, Self::Repeat];

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Hold => "hold",
            Self::Turn => "turn",
            Self::Repeat => "repeat",
        }
    }

    /// What has this [`AtEnd::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|at_end| at_end.id() == id)
    }

    /// The place on a path of this length where so much was traveled, 0..=length.
    fn folded(self, length: f64, traveled: f64) -> f64 {
        let traveled = if traveled > 0.0 { traveled } else { 0.0 };
        match self {
            Self::Hold => traveled.min(length),
            Self::Turn => {
                let turn = traveled % (2.0 * length);
                if turn > length { 2.0 * length - turn } else { turn }
            }
            Self::Repeat => traveled % length,
        }
    }
}

impl Route {
    /// A route through stops; the first lies at zero, each other beyond the one before.
    ///
    /// # Errors
    /// See [`TexturePathError`].
    pub fn new(along: Along, at_end: AtEnd, stops: Vec<Stop>) -> Result<Self, TexturePathError> {
        check(along, stops.iter().map(|stop| stop.along))?;
        Ok(Self { along, at_end, stops })
    }

    /// What is counted along it.
    pub fn along(&self) -> Along {
        self.along
    }

    /// Its stops, at least two.
    pub fn stops(&self) -> &[Stop] {
        &self.stops
    }

    /// Its length in m or s.
    pub fn length(&self) -> f64 {
        self.stops.last().map_or(0.0, |stop| stop.along)
    }

    /// The point of the space where so much was traveled, in m or s.
    pub fn point_at(&self, traveled: f64) -> SpacePoint {
        let place = self.at_end.folded(self.length(), traveled);
        let (index, share) = between(self.stops.iter().map(|stop| stop.along), place);
        mean(self.stops[index].at, self.stops[(index + 1).min(self.stops.len() - 1)].at, share)
    }
}

/// A texture at a place of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Where along the stroke, in m or s, and where in the space.
    pub stop: Stop,
    /// Whether somebody put it there; else it only stands between two that were put.
    pub is_stop: bool,
    /// The texture.
    pub model: TextureModel,
}

/// A texture that changes along a stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct TexturePath {
    along: Along,
    at_end: AtEnd,
    keys: Vec<Key>,
}

impl TexturePath {
    /// A path through keys of one rate; the first lies at zero, each other beyond the one before.
    ///
    /// # Errors
    /// See [`TexturePathError`].
    pub fn new(along: Along, at_end: AtEnd, keys: Vec<Key>) -> Result<Self, TexturePathError> {
        check(along, keys.iter().map(|key| key.stop.along))?;
        let rate = |key: &Key| key.model.rate().0;
        let first_hz = rate(&keys[0]);
        if let Some(other) = keys.iter().find(|key| rate(key) != first_hz) {
            return Err(TexturePathError::Rates { first_hz, other_hz: rate(other) });
        }
        Ok(Self { along, at_end, keys })
    }

    /// The path of a route: a key at every stop, and between them every few points of the axes.
    ///
    /// # Errors
    /// See [`TexturePathError`].
    pub fn of_route(
        authoring: &Authoring,
        route: &Route,
        blending: &Blending,
    ) -> Result<Self, TexturePathError> {
        if !blending.mode.makes_a_model() {
            return Err(TexturePathError::Mode);
        }
        let n_steps =
            |pair: &[Stop], step: f64| ((pair[0].at.distance(pair[1].at) / step).ceil() as usize).max(1);
        let n_keys = |step: f64| route.stops.windows(2).map(|pair| n_steps(pair, step)).sum::<usize>() + 1;
        let mut step = KEY_STEP;
        while n_keys(step) > MAX_KEYS {
            step *= 1.1;
        }
        let mut places: Vec<(Stop, bool)> = Vec::new();
        for pair in route.stops.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let n = n_steps(pair, step);
            places.extend((0..n).map(|i| {
                let share = i as f64 / n as f64;
                let along = from.along + share * (to.along - from.along);
                (Stop { at: mean(from.at, to.at, share), along }, i == 0)
            }));
        }
        places.extend(route.stops.last().map(|stop| (*stop, true)));
        let key = |(stop, is_stop): (Stop, bool)| {
            let model = authoring.model(stop.at, blending);
            let model = model.ok_or(TexturePathError::NoTexture { at: stop.at })?;
            Ok(Key { stop, is_stop, model })
        };
        Self::new(route.along, route.at_end, places.into_iter().map(key).collect::<Result<_, _>>()?)
    }

    /// What is counted along it.
    pub fn along(&self) -> Along {
        self.along
    }

    /// What happens at its end.
    pub fn at_end(&self) -> AtEnd {
        self.at_end
    }

    /// Its textures, at least two, in the order of the stroke.
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// Its length in m or s.
    pub fn length(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.stop.along)
    }

    /// Largest distance of neighboring keys in the space, in points of the axes.
    pub fn widest_step(&self) -> f64 {
        self.keys.windows(2).map(|pair| pair[0].stop.at.distance(pair[1].stop.at)).fold(0.0, f64::max)
    }

    /// The key at or before the place where so much was traveled, in m or s, and the share of the one after it, 0..1.
    pub fn between(&self, traveled: f64) -> (usize, f64) {
        let place = self.at_end.folded(self.length(), traveled);
        between(self.keys.iter().map(|key| key.stop.along), place)
    }
}

/// How far a stroke has come along a path: while it touches it goes on, in the air it stands still, and each landing begins
/// a new stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traveler {
    along: Along,
    traveled: f64,
    touches: bool,
}

impl Traveler {
    /// Before the first landing.
    pub fn new(along: Along) -> Self {
        Self { along, traveled: 0.0, touches: false }
    }

    /// What is counted.
    pub fn along(&self) -> Along {
        self.along
    }

    /// How far the stroke has come, in m or s.
    pub fn traveled(&self) -> f64 {
        self.traveled
    }

    /// The tip is like this for so long.
    pub fn go(&mut self, contact: Contact, secs: f64) {
        let touches = contact.force.0 > 0.0;
        if touches && !self.touches {
            self.traveled = 0.0;
        }
        self.touches = touches;
        if touches {
            self.traveled += match self.along {
                Along::Distance => contact.speed.0.abs() * secs,
                Along::Time => secs,
            };
        }
    }
}

/// How far a stroke comes along a path, worked out ahead of it in steps.
#[derive(Clone, Debug, PartialEq)]
pub struct TraveledAhead {
    step_secs: f64,
    /// At the beginning of each step, in m or s; at least one.
    traveled: Vec<f64>,
}

impl TraveledAhead {
    /// That of a stroke of this length whose tip is as `contact_at` says, time in seconds.
    pub fn new(
        along: Along,
        length_secs: f64,
        step_secs: f64,
        contact_at: &mut dyn FnMut(f64) -> Contact,
    ) -> Self {
        let mut traveler = Traveler::new(along);
        let step = |step: usize| {
            let now = traveler.traveled();
            traveler.go(contact_at(step_secs * (step as f64 + 0.5)), step_secs);
            now
        };
        Self { step_secs, traveled: (0..=(length_secs / step_secs).ceil() as usize).map(step).collect() }
    }

    /// How far it has come at a time, to the nearest step, in m or s.
    pub fn at(&self, time_secs: f64) -> f64 {
        let step = (time_secs.max(0.0) / self.step_secs).round() as usize;
        self.traveled[step.min(self.traveled.len() - 1)]
    }
}

/// Whether places along a stroke are a way.
fn check(along: Along, places: impl ExactSizeIterator<Item = f64>) -> Result<(), TexturePathError> {
    let n = places.len();
    if n < 2 {
        return Err(TexturePathError::TooFew { n });
    }
    if n > MAX_KEYS {
        return Err(TexturePathError::TooMany { n });
    }
    let mut before = None;
    for (i, at) in places.enumerate() {
        let goes_on = before.map_or(at == 0.0, |before| at > before && at.is_finite());
        if !goes_on {
            return Err(TexturePathError::Order { number: i + 1, at, along });
        }
        before = Some(at);
    }
    Ok(())
}

/// The index of the last of ascending places that is not beyond `place`, and the share of the way to the next.
fn between(places: impl Iterator<Item = f64>, place: f64) -> (usize, f64) {
    let mut found = (0, 0.0);
    let mut before = 0.0;
    for (i, along) in places.enumerate() {
        if along > place {
            let share = if i == 0 { 0.0 } else { (place - before) / (along - before) };
            return (found.0, share);
        }
        (found, before) = ((i, 0.0), along);
    }
    found
}

fn mean(from: SpacePoint, to: SpacePoint, share: f64) -> SpacePoint {
    let between = |a: f64, b: f64| a + share * (b - a);
    SpacePoint {
        rough_smooth: between(from.rough_smooth, to.rough_smooth),
        hard_soft: between(from.hard_soft, to.hard_soft),
    }
}

#[cfg(test)]
mod tests {
    use super::{
        Along, AtEnd, Key, MAX_KEYS, Route, Stop, TexturePath, TexturePathError, TraveledAhead, Traveler,
    };
    use crate::authoring::tests::world;
    use crate::blend::Mode;
    use crate::space::SpacePoint;
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
            assert!(
                (at.rough_smooth - want.0).abs() < 1e-9 && (at.hard_soft - want.1).abs() < 1e-9,
                "{at:?}"
            );
        }
        let nan = route(AtEnd::Turn).point_at(f64::NAN);
        assert!((nan.rough_smooth, nan.hard_soft) == (30.0, 30.0));
    }

    #[test]
    fn a_path_follows_its_route() {
        let world = world(12, 1.0, 2);
        let route = route(AtEnd::Hold);
        let path = TexturePath::of_route(&world.authoring, &route, &Mode::Field.into()).unwrap();
        // Forty points in steps of four, then thirty.
        assert_eq!(path.keys().len(), 10 + 8 + 1);
        assert_eq!(path.keys().iter().filter(|key| key.is_stop).count(), 3);
        for i in 0..=50 {
            let traveled = 0.001 * f64::from(i);
            let (key, share) = path.between(traveled);
            let [a, b] = [key, (key + 1).min(path.keys().len() - 1)].map(|k| path.keys()[k].stop.at);
            let at = route.point_at(traveled);
            let between = a.rough_smooth + share * (b.rough_smooth - a.rough_smooth);
            assert!((between - at.rough_smooth).abs() < 1e-9, "{traveled}");
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
        let model =
            world.authoring.author(stop(50.0, 50.0, 0.0).at, &Mode::Field.into()).unwrap().model.unwrap();
        let key = |along: f64| Key { stop: stop(1.0, 1.0, along), is_stop: true, model: model.clone() };
        assert!(TexturePath::new(Along::Time, AtEnd::Hold, vec![key(0.0), key(1.0)]).is_ok());
        assert!(TexturePath::new(Along::Time, AtEnd::Hold, vec![key(1.0), key(0.0)]).is_err());
    }

    #[test]
    fn a_stroke_counts_its_way_or_its_time_and_each_landing_begins_anew() {
        let [down, up] = [1.0, 0.0].map(|force_n| Contact::from_mm_per_s_and_n(200.0, force_n));
        for (along, want) in [(Along::Distance, 0.1), (Along::Time, 0.5)] {
            let mut traveler = Traveler::new(along);
            (0..25).for_each(|_| traveler.go(down, 0.02));
            assert!((traveler.traveled() - want).abs() < 1e-12, "{}", traveler.traveled());
            (0..9).for_each(|_| traveler.go(up, 0.02));
            assert!((traveler.traveled() - want).abs() < 1e-12, "a lifted tip stays");
            traveler.go(down, 0.02);
            assert!((traveler.traveled() - 0.04 * want).abs() < 1e-12, "{}", traveler.traveled());
            let mut contact_at = |secs| if secs < 0.5 { down } else { up };
            let ahead = TraveledAhead::new(along, 0.6, 0.02, &mut contact_at);
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
}
