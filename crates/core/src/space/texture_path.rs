//! Texture paths: textures that change along a stroke, for example from wood to cloth over some millimeters or seconds.
//!
//! A route connects stops (waypoints) in the space by straight lines. For playback it becomes a path: a sequence of
//! keys (keyframe textures). Neighboring keys are so close that mixing two of them under one excitation is as good as
//! interpolating a texture. Playback therefore needs only the keys, not the space.

mod drawn;
mod render;
mod route;
mod traveler;

use crate::space::authoring::{Authoring, Blending};
use crate::space::texture_path::route::{between, check, mean};
use crate::texture::TextureModel;
use crate::texture::shape::Shape;

pub use crate::space::texture_path::drawn::{LEAST_STEP, UserPath};
pub use crate::space::texture_path::render::{PathPlan, path_mix, render_path};
pub use crate::space::texture_path::route::{Along, AtEnd, Route, Stop, TexturePathError};
pub use crate::space::texture_path::traveler::{PathProgress, PrecomputedProgress};

/// Maximum distance of neighboring keys in the space, in points of the axes. Routes that would need more than
/// [`MAX_KEYS`] keys use a larger distance.
const KEY_STEP: f64 = 4.0;
/// Maximum number of keys of a path, computed or read from a file: an output must hold the textures of all keys at
/// once.
pub const MAX_KEYS: usize = 48;

/// Keyframe of a path: a texture at a place of the stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Place along the stroke, in m or s, and position in the space.
    pub stop: Stop,
    /// Whether the key is a stop of the route; otherwise it was inserted between two stops.
    pub is_stop: bool,
    /// Texture of the key.
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
    /// Path through keys of one sample rate; the first key is at 0, and places along the stroke increase strictly.
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

    /// Path of a route: a key at every stop, and between two stops a key every few points of the axes.
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
        let n_keys = |step: f64| route.stops().windows(2).map(|pair| n_steps(pair, step)).sum::<usize>() + 1;
        let mut step = KEY_STEP;
        while n_keys(step) > MAX_KEYS {
            step *= 1.1;
        }
        let mut places: Vec<(Stop, bool)> = Vec::new();
        for pair in route.stops().windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let n = n_steps(pair, step);
            places.extend((0..n).map(|i| {
                let share = i as f64 / n as f64;
                let along = from.along + share * (to.along - from.along);
                (Stop { at: mean(from.at, to.at, share), along }, i == 0)
            }));
        }
        places.extend(route.stops().last().map(|stop| (*stop, true)));
        let key = |(stop, is_stop): (Stop, bool)| {
            let model = authoring.model(stop.at, blending);
            let model = model.ok_or(TexturePathError::NoTexture { at: stop.at })?;
            Ok(Key { stop, is_stop, model })
        };
        Self::new(route.along(), route.at_end(), places.into_iter().map(key).collect::<Result<_, _>>()?)
    }

    /// The path with every texture in this shape.
    ///
    /// # Errors
    /// [`TexturePathError::Shape`].
    pub fn shaped(mut self, shape: &Shape) -> Result<Self, TexturePathError> {
        for key in &mut self.keys {
            key.model = shape.apply(&key.model).map_err(TexturePathError::Shape)?;
        }
        Ok(self)
    }

    /// Quantity that is measured along the path.
    pub fn along(&self) -> Along {
        self.along
    }

    /// Behavior at the end of the path.
    pub fn at_end(&self) -> AtEnd {
        self.at_end
    }

    /// Keys of the path, at least two, in the order of the stroke.
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// Length of the path, in m or s.
    pub fn length(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.stop.along)
    }

    /// Largest distance of neighboring keys in the space, in points of the axes.
    pub fn widest_step(&self) -> f64 {
        self.keys.windows(2).map(|pair| pair[0].stop.at.distance(pair[1].stop.at)).fold(0.0, f64::max)
    }

    /// Index of the key at or before the given traveled distance or time (m or s), and the weight of the next key,
    /// 0..1.
    pub fn between(&self, traveled: f64) -> (usize, f64) {
        let place = self.at_end.folded(self.length(), traveled);
        between(self.keys.iter().map(|key| key.stop.along), place)
    }
}

#[cfg(test)]
mod tests;
