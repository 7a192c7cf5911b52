//! Route of a texture through the space along a stroke.

use crate::space::SpacePoint;
use crate::space::texture_path::MAX_KEYS;
use crate::texture::TextureModelError;

/// Quantity that is measured along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Along {
    /// Distance that the tip has traveled since contact, in m.
    #[default]
    Distance,
    /// Time since contact, in s.
    Time,
}

/// Behavior at the end of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtEnd {
    /// Holds the last texture.
    #[default]
    Hold,
    /// Reverses direction at each end.
    Turn,
    /// Restarts from the beginning.
    Repeat,
}

/// Waypoint of a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Position in the space.
    pub at: SpacePoint,
    /// Place along the stroke, in m or s.
    pub along: f64,
}

/// Route of a texture through the space: straight lines from stop to stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    along: Along,
    at_end: AtEnd,
    stops: Vec<Stop>,
}

/// Reasons why stops do not form a route or keys do not form a path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TexturePathError {
    /// There are fewer than two stops.
    #[error("a path needs at least two points, got {n}; add points")]
    TooFew {
        /// Number of points.
        n: usize,
    },
    /// There are too many stops or keys.
    #[error("a path has at most {MAX_KEYS} points, got {n}; leave some out")]
    TooMany {
        /// Number of points.
        n: usize,
    },
    /// The places along the stroke do not start at 0 or do not increase.
    #[error(
        "point {number} of the path is at {} {} of the stroke; the first point must be at 0, and every later point farther than the one before it",
        .at / .along.unit().0,
        .along.unit().1
    )]
    Order {
        /// Number of the point, counted from one.
        number: usize,
        /// Place along the stroke, in m or s.
        at: f64,
        /// Quantity that is measured along the path.
        along: Along,
    },
    /// The textures have different sample rates.
    #[error(
        "the textures of a path have different sample rates, {first_hz} and {other_hz} Hz; convert them to one rate"
    )]
    Rates {
        /// Sample rate of the first texture in Hz.
        first_hz: f64,
        /// A different sample rate in Hz.
        other_hz: f64,
    },
    /// The interpolation mode gives no single texture.
    #[error("a path needs interpolated textures at its points: choose mode field or parametric")]
    Mode,
    /// There is no texture at a point.
    #[error("there is no texture at {at}; place textures around it first")]
    NoTexture {
        /// Position of the point.
        at: SpacePoint,
    },
    /// A texture of the path cannot have a shape.
    #[error("a texture of the path cannot have this shape: {0}")]
    Shape(TextureModelError),
}

impl Along {
    /// Both quantities.
    pub const ALL: [Self; 2] = [Self::Distance, Self::Time];

    /// Display unit: its size in m or s, and its symbol.
    pub fn unit(self) -> (f64, &'static str) {
        match self {
            Self::Distance => (1e-3, "mm"),
            Self::Time => (1.0, "s"),
        }
    }

    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Time => "time",
        }
    }

    /// Quantity with this [`Along::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|along| along.id() == id)
    }
}

impl AtEnd {
    /// All behaviors.
    pub const ALL: [Self; 3] = [Self::Hold, Self::Turn, Self::Repeat];

    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Hold => "hold",
            Self::Turn => "turn",
            Self::Repeat => "repeat",
        }
    }

    /// Behavior with this [`AtEnd::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|at_end| at_end.id() == id)
    }

    /// Place on a path of this length after the given traveled distance or time, 0..=length.
    pub(super) fn folded(self, length: f64, traveled: f64) -> f64 {
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
    /// Route through stops; the first is at 0, and places along the stroke increase strictly.
    ///
    /// # Errors
    /// See [`TexturePathError`].
    pub fn new(along: Along, at_end: AtEnd, stops: Vec<Stop>) -> Result<Self, TexturePathError> {
        check(along, stops.iter().map(|stop| stop.along))?;
        Ok(Self { along, at_end, stops })
    }

    /// Quantity that is measured along the route.
    pub fn along(&self) -> Along {
        self.along
    }

    /// Behavior at the end of the route.
    pub fn at_end(&self) -> AtEnd {
        self.at_end
    }

    /// Stops of the route, at least two.
    pub fn stops(&self) -> &[Stop] {
        &self.stops
    }

    /// Length of the route, in m or s.
    pub fn length(&self) -> f64 {
        self.stops.last().map_or(0.0, |stop| stop.along)
    }

    /// Position in the space after the given traveled distance or time, in m or s.
    pub fn point_at(&self, traveled: f64) -> SpacePoint {
        let place = self.at_end.folded(self.length(), traveled);
        let (index, share) = between(self.stops.iter().map(|stop| stop.along), place);
        mean(self.stops[index].at, self.stops[(index + 1).min(self.stops.len() - 1)].at, share)
    }
}

/// Checks the number of places along a stroke, that the first is 0, and that they increase strictly.
pub(super) fn check(
    along: Along,
    places: impl ExactSizeIterator<Item = f64>,
) -> Result<(), TexturePathError> {
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

/// Index of the last of the ascending places that does not exceed `place`, and the fraction of the way to the next.
pub(super) fn between(places: impl Iterator<Item = f64>, place: f64) -> (usize, f64) {
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

pub(super) fn mean(from: SpacePoint, to: SpacePoint, share: f64) -> SpacePoint {
    from.toward(to, share)
}
