//! What is authored becomes what is heard: where, out of what, and when.

use std::sync::Arc;
use std::time::Instant;

use shagreen_core::authoring::Authored;
use shagreen_core::blend::Mode;
use shagreen_core::rate::at_rate;
use shagreen_core::space::SpacePoint;
use shagreen_core::units::Hertz;
use shagreen_device::synth::tap::Tap;

use super::Session;
use super::heard::Heard;
use super::models_ahead::{Ingredients, Job};
use super::path_walk::PathWalk;
use shagreen_core::drawn_path::DrawnPath;

impl Session {
    /// Where the stroke is on the path, while one is played.
    pub(super) fn follow_path(&mut self, path: Option<&DrawnPath>) -> Option<SpacePoint> {
        let touch = self.touch();
        let walk = self.walk.as_mut()?;
        let Some(route) = path.and_then(DrawnPath::route) else {
            self.walk = None;
            return None;
        };
        // What is counted may have been changed meanwhile.
        if walk.along() != route.along() {
            *walk = PathWalk::new(route.along());
        }
        walk.advance(touch, Instant::now());
        Some(route.point_at(walk.traveled()))
    }

    /// The texture of the path that is heard alone, where the stroke is on it; `None` where what is heard alone is no path.
    pub(super) fn follow_key(&mut self, solo: Option<usize>) -> Option<usize> {
        let touch = self.touch();
        let Some((texture, path)) =
            solo.and_then(|texture| Some((texture, self.library.textures[texture].path.as_ref()?)))
        else {
            self.walk_alone = None;
            return None;
        };
        let (of, walk) = self.walk_alone.get_or_insert_with(|| (texture, PathWalk::new(path.along())));
        if *of != texture {
            (*of, *walk) = (texture, PathWalk::new(path.along()));
        }
        walk.advance(touch, Instant::now());
        Some(walk.nearest_key(path))
    }

    /// What is heard alone: the texture, or that of its path where the stroke is.
    pub(super) fn alone(&self, texture: usize, key: Option<usize>, at: SpacePoint, mode: Mode) -> Authored {
        let alone = Authored::alone(texture, at, mode);
        let path = self.library.textures[texture].path.as_ref();
        match path.zip(key).and_then(|(path, key)| path.keys().get(key)) {
            Some(key) => {
                // In a space of a higher rate it is heard at that one, as its place is.
                let converted = at_rate(&key.model, Hertz(self.rates_hz[texture]));
                let model = converted.map_or_else(|_| key.model.clone(), |converted| converted.model);
                Authored { mode: Mode::Field, model: Some(model), lock: None, ..alone }
            }
            None => alone,
        }
    }

    /// What was authored is heard. Where what its mode needs is not there yet, what sounded goes on.
    pub(super) fn hear(&mut self) {
        self.n_made += 1;
        let heard = match &self.authored {
            Some(authored) => Heard::new(authored, &self.planes, self.n_made),
            None => Heard::default(),
        };
        if self.authored.is_some() && heard.voices.is_empty() && self.is_preparing() {
            return;
        }
        self.heard = heard;
        let tap_of = |texture: usize| self.library.textures[texture].model.tap();
        let tap = self.authored.as_ref().and_then(|authored| authored.tap(tap_of));
        self.player.tap = tap.map_or(Tap::SILENT, Tap::from);
        self.player.mix_is_new = true;
    }

    /// Has a worker make what the modes that make a texture need of the textures in the space.
    pub(super) fn ask_for_models(&mut self) {
        let space = self.authoring.space().clone();
        if space.sites().is_empty() {
            self.models.cancel();
            return;
        }
        let mut textures: Vec<Option<Ingredients>> = self.planes.iter().map(|_| None).collect();
        for (texture, _) in space.sites() {
            let model = &self.library.textures[*texture].model;
            let plane = Arc::clone(&self.planes[*texture]);
            textures[*texture] = Some(Ingredients::of(model, plane));
        }
        self.models.ask(Job { space, textures });
    }
}
