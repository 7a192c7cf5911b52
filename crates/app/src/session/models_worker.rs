//! A worker that computes the models of the field and parametric modes: this takes seconds for a thousand textures.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::Instant;

use shagreen_core::space::Space;
use shagreen_core::space::authoring::{Layers, Models};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::height_map::HeightMap;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::texture::tap::Tap;

use crate::state::background::in_background;
use crate::strings;

/// Input of one computation.
pub(super) struct Job {
    pub(super) space: Space,
    /// Indexed like the library; `None` for textures without a position in the space.
    pub(super) textures: Vec<Option<Ingredients>>,
}

/// Interpolated properties of a texture.
pub(super) struct Ingredients {
    plane: Arc<Plane>,
    friction: Option<f64>,
    tap: Option<Tap>,
    height_map: Option<Arc<HeightMap>>,
    stick_slip: Option<StickSlip>,
    turn_rad: f64,
}

type Outcome = Result<Arc<Models>, String>;

/// One worker computes models. A newer job replaces a waiting one, and stale results are discarded.
#[derive(Default)]
pub(super) struct ModelsWorker {
    /// Counts jobs and cancellations.
    generation: u64,
    waiting: Option<Job>,
    running: Option<(u64, Receiver<Outcome>)>,
    since: Option<Instant>,
}

impl Ingredients {
    pub(super) fn of(model: &TextureModel, plane: Arc<Plane>) -> Self {
        Self {
            plane,
            friction: model.friction(),
            tap: model.tap(),
            height_map: model.height_map().cloned(),
            stick_slip: model.stick_slip(),
            turn_rad: model.turn_rad(),
        }
    }

    fn layers(&self) -> Layers<'_> {
        Layers {
            plane: &self.plane,
            along: self.plane.along(),
            friction: self.friction,
            tap: self.tap,
            height_map: self.height_map.as_ref(),
            stick_slip: self.stick_slip,
            turn_rad: self.turn_rad,
        }
    }
}

impl Job {
    /// Computes the models.
    pub(super) fn run(&self) -> Outcome {
        let layers: Vec<Option<Layers<'_>>> =
            self.textures.iter().map(|texture| texture.as_ref().map(Ingredients::layers)).collect();
        let models = Models::new(&self.space, &layers).map_err(|error| error.to_string())?;
        models.prepare_height_maps();
        Ok(Arc::new(models))
    }
}

impl ModelsWorker {
    /// Requests models and replaces earlier requests.
    pub(super) fn ask(&mut self, job: Job) {
        self.generation += 1;
        self.since = Some(Instant::now());
        self.waiting = Some(job);
    }

    /// Discards all requests.
    pub(super) fn cancel(&mut self) {
        self.generation += 1;
        (self.waiting, self.since) = (None, None);
    }

    /// Starts the waiting job if the worker is idle, once a frame.
    pub(super) fn begin(&mut self, ctx: &egui::Context) {
        if self.running.is_some() {
            return;
        }
        if let Some(job) = self.waiting.take() {
            let receiver = in_background(ctx.clone(), move || job.run());
            self.running = Some((self.generation, receiver));
        }
    }

    /// Result of the newest request when it is done, once a frame.
    pub(super) fn collect(&mut self) -> Option<Outcome> {
        let (generation, receiver) = self.running.as_ref()?;
        let outcome = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(strings::FIELD_FAILED.to_owned()),
            Ok(outcome) => outcome,
        };
        let is_wanted = *generation == self.generation;
        self.running = None;
        is_wanted.then(|| {
            self.since = None;
            outcome
        })
    }

    /// Time since the newest request in seconds, or `None` if nothing is requested.
    pub(super) fn awaited_secs(&self) -> Option<f64> {
        self.since.map(|since| since.elapsed().as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::{Ingredients, Job, ModelsWorker};
    use shagreen_core::space::authoring::Authoring;
    use shagreen_core::space::{Space, SpacePoint};
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::plane::Plane;
    use shagreen_formats::starter::starter_library;
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    fn job(n_textures: usize) -> Job {
        let library = starter_library().unwrap();
        let textures = &library.textures[..n_textures];
        let positions: Vec<Option<SpacePoint>> = textures.iter().map(|t| t.place.map(|p| p.at)).collect();
        let ingredients = textures
            .iter()
            .map(|texture| Some(Ingredients::of(&texture.model, Arc::new(Plane::new(&texture.model)))));
        Job { space: Space::new(&positions).unwrap(), textures: ingredients.collect() }
    }

    /// Results of earlier requests are discarded.
    #[test]
    fn only_what_was_asked_for_last_comes() {
        let (ctx, mut ahead) = (egui::Context::default(), ModelsWorker::default());
        ahead.ask(job(25));
        ahead.begin(&ctx);
        assert!(ahead.collect().is_none() && ahead.awaited_secs().is_some());
        ahead.ask(job(3));
        ahead.ask(job(9));
        let start = Instant::now();
        let models = loop {
            ahead.begin(&ctx);
            if let Some(outcome) = ahead.collect() {
                break outcome.unwrap();
            }
            assert!(start.elapsed() < Duration::from_mins(5));
            std::thread::sleep(Duration::from_millis(2));
        };
        let authoring = Authoring::new(job(9).space).with_models(models);
        let authored = authoring.author(SpacePoint::new(40.0, 40.0).unwrap(), &Mode::Field.into());
        assert_eq!(authored.unwrap().parents.len(), 9, "a field is over all textures of its space");
        assert!(ahead.awaited_secs().is_none() && ahead.collect().is_none());
        ahead.ask(job(25));
        ahead.begin(&ctx);
        ahead.cancel();
        let start = Instant::now();
        while ahead.running.is_some() {
            assert!(start.elapsed() < Duration::from_mins(5));
            assert!(ahead.collect().is_none(), "nobody asks for these any more");
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}
