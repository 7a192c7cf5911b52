//! What is authored becomes what is heard: where, out of what, and when.

use std::sync::Arc;
use std::time::Instant;

use shagreen_core::space::SpacePoint;

use super::Session;
use super::heard::Heard;
use super::models_ahead::{Ingredients, Job};
use crate::drawn_path::DrawnPath;

impl Session {
    /// Where the stroke is on the path, while one is played.
    pub(super) fn follow_path(&mut self, path: Option<&DrawnPath>) -> Option<SpacePoint> {
        if !self.walk.is_playing() {
            return None;
        }
        let Some(route) = path.and_then(DrawnPath::route) else {
            self.walk.set_playing(false);
            return None;
        };
        self.walk.advance(self.touch(), route.along(), Instant::now());
        Some(route.point_at(self.walk.traveled()))
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
            textures[*texture] = Some(Ingredients { plane, friction: model.friction(), tap: model.tap() });
        }
        self.models.ask(Job { space, textures });
    }
}
