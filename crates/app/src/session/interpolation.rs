//! From the authored point to the audible textures.

use std::time::Instant;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authored, Blending};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::rate::at_rate;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::Hertz;
use shagreen_device::synth::tap::Tap;

use super::Session;
use super::audible::{Audible, ReadyPlane, audible_model, needs_preparation};
use super::path_walk::PathWalk;
use shagreen_core::space::texture_path::UserPath;

impl Session {
    /// Advances the stroke along a played path and returns its position.
    pub(super) fn follow_path(&mut self, path: Option<&UserPath>) -> Option<SpacePoint> {
        let touch = self.touch();
        let walk = self.authored.walk.as_mut()?;
        let Some(route) = path.and_then(UserPath::route) else {
            self.authored.walk = None;
            return None;
        };
        // The user may have switched between distance and time.
        if walk.along() != route.along() {
            *walk = PathWalk::new(route.along());
        }
        walk.advance(touch, Instant::now());
        Some(route.point_at(walk.traveled()))
    }

    /// Index of the key nearest to the stroke on the path of a soloed texture. `None` if nothing is soloed or the
    /// soloed texture has no path.
    pub(super) fn follow_key(&mut self, solo: Option<usize>) -> Option<usize> {
        let touch = self.touch();
        let Some((texture, path)) =
            solo.and_then(|texture| Some((texture, self.textures.library.textures[texture].path.as_ref()?)))
        else {
            self.authored.walk_alone = None;
            return None;
        };
        let (of, walk) =
            self.authored.walk_alone.get_or_insert_with(|| (texture, PathWalk::new(path.along())));
        if *of != texture {
            (*of, *walk) = (texture, PathWalk::new(path.along()));
        }
        walk.advance(touch, Instant::now());
        Some(walk.nearest_key(path))
    }

    /// A soloed texture, or the texture of its path at a key.
    pub(super) fn alone(&self, texture: usize, key: Option<usize>, at: SpacePoint, mode: Mode) -> Authored {
        let alone = Authored::alone(texture, at, mode);
        let path = self.textures.library.textures[texture].path.as_ref();
        match path.zip(key).and_then(|(path, key)| path.keys().get(key)) {
            Some(key) => {
                // A texture with a position plays at the sample rate of the space, so the textures of its path do too.
                let converted = at_rate(&key.model, Hertz(self.textures.rates_hz[texture]));
                let model = converted.map_or_else(|_| key.model.clone(), |converted| converted.model);
                Authored { mode: Mode::Field, model: Some(model), lock: None, ..alone }
            }
            None => alone,
        }
    }

    /// The texture at a point of the space, in a shape.
    pub(super) fn shaped_at(
        &mut self,
        at: SpacePoint,
        blending: &Blending,
        shape: &Shape,
    ) -> Option<Authored> {
        match self.authored.spaces.current().author(at, blending)?.shaped(shape) {
            Ok(authored) => Some(authored),
            Err(error) => {
                self.say(error.to_string());
                None
            }
        }
    }

    /// Makes the interpolated texture audible. While the models for its mode are being computed, or while a worker makes it,
    /// the previous texture keeps playing. The worker prepares height maps, and makes the steps of a drag: at every other
    /// change, the new texture plays at once.
    pub(super) fn hear(&mut self, is_dragged: bool) {
        let Some(authored) = self.authored.current.take() else {
            self.authored.audible.cancel();
            self.play(None, None);
            return;
        };
        let of_space = Hertz(self.textures.space_rate_hz);
        let rate = authored.model.as_ref().map_or(of_space, TextureModel::rate);
        let before = &self.sound.heard.voices;
        let is_other_rate = before.iter().any(|voice| voice.plane.rate() != rate);
        // Where nothing plays before, there would be silence until the texture is ready.
        let may_lag = is_dragged && !before.is_empty() && !is_other_rate;
        let is_asked = |model: &TextureModel, shape: &Shape| may_lag || needs_preparation(model, shape);
        let unshaped = self.sound.shaped.missing(&authored, &self.textures, is_asked);
        // The interpolated model has its shape already.
        let is_model_asked = audible_model(&authored).is_some_and(|model| is_asked(model, &Shape::default()));
        if is_model_asked || !unshaped.is_empty() {
            if is_other_rate {
                (self.sound.heard, self.sound.player.mix_is_new) = (Audible::default(), true);
            }
            self.authored.audible.ask(authored.clone(), unshaped);
        } else {
            self.authored.audible.cancel();
            self.play(Some(&authored), None);
        }
        self.authored.current = Some(authored);
    }

    /// Stops what plays, so that the next texture does not begin with it.
    pub(crate) fn fall_silent(&mut self) {
        // A signal of the Signals workspace plays on.
        if self.sound.felt.is_none() {
            self.authored.audible.cancel();
            self.play(None, None);
            self.sound.player.wanted = None;
        }
    }

    /// Plays an interpolated texture, which is made unless it is `ready`. Without one, there is silence.
    pub(super) fn play(&mut self, authored: Option<&Authored>, ready: Option<ReadyPlane>) {
        let heard = match authored {
            Some(authored) => Audible::new(
                authored,
                ready,
                &self.textures,
                &mut self.sound.shaped,
                &mut self.authored.n_made,
            ),
            None => Ok(Audible::default()),
        };
        let heard = heard.unwrap_or_else(|reason| {
            self.say(reason);
            Audible::default()
        });
        // In a blind comparison, the previous texture would be taken for this one.
        let may_wait = self.is_preparing() && !self.is_hidden();
        if authored.is_some() && heard.voices.is_empty() && may_wait {
            return;
        }
        self.sound.heard = heard;
        let tap_of = |texture: usize| self.textures.library.textures[texture].model.tap();
        let tap = authored.and_then(|authored| authored.tap(tap_of));
        self.sound.player.tap = tap.map_or(Tap::SILENT, Tap::from);
        self.sound.player.mix_is_new = true;
    }
}
