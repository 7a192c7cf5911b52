//! A worker that prepares the height maps of an interpolated texture and of the textures of the library that get its shape.
//! Meanwhile the previous texture plays.

use std::sync::mpsc::{Receiver, TryRecvError};

use shagreen_core::space::authoring::{Authored, Voice};
use shagreen_core::texture::TextureModel;

use super::audible::{Shaped, Unshaped};
use crate::state::background::in_background;

/// One worker prepares height maps. A newer texture replaces a waiting one.
#[derive(Default)]
pub(super) struct HeightMapsWorker {
    waiting: Option<(Authored, Vec<Unshaped>)>,
    running: Option<Receiver<(Authored, Vec<Shaped>)>>,
    /// Whether nobody waits for the running texture anymore.
    is_stale: bool,
}

/// Whether the interpolated texture has a height map that is not prepared. Sums of prepared maps are; a stretched one is not.
pub(super) fn needs_preparation(authored: &Authored) -> bool {
    let unprepared = |(voice, _): (Voice<'_>, f64)| match voice {
        Voice::Made(model) => model.height_map().is_some_and(|map| !map.is_prepared()),
        Voice::Texture(_) => false,
    };
    authored.voices().into_iter().any(unprepared)
}

impl HeightMapsWorker {
    /// Requests a texture with a prepared height map, and textures of the library in its shape.
    pub(super) fn ask(&mut self, authored: Authored, unshaped: Vec<Unshaped>) {
        self.waiting = Some((authored, unshaped));
    }

    /// Discards all requests.
    pub(super) fn cancel(&mut self) {
        (self.waiting, self.is_stale) = (None, true);
    }

    /// Starts the waiting texture if the worker is idle, once a frame.
    pub(super) fn begin(&mut self, ctx: &egui::Context) {
        if self.running.is_some() {
            return;
        }
        if let Some((authored, unshaped)) = self.waiting.take() {
            self.is_stale = false;
            self.running = Some(in_background(ctx.clone(), move || {
                if let Some(map) = authored.model.as_ref().and_then(TextureModel::height_map) {
                    // The map keeps what it prepares.
                    map.prepare();
                }
                (authored, unshaped.into_iter().filter_map(Unshaped::shaped).collect())
            }));
        }
    }

    /// The texture that has become ready, with those of the library, once a frame. One that a newer texture replaced while it was prepared comes, too, so
    /// that a point that is dragged is heard on its way.
    pub(super) fn collect(&mut self) -> Option<(Authored, Vec<Shaped>)> {
        let outcome = self.running.as_ref()?.try_recv();
        if matches!(outcome, Err(TryRecvError::Empty)) {
            return None;
        }
        self.running = None;
        // A worker that broke off has no texture.
        outcome.ok().filter(|_| !self.is_stale)
    }

    /// Whether a texture is requested.
    pub(super) fn is_busy(&self) -> bool {
        self.waiting.is_some() || (self.running.is_some() && !self.is_stale)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::authoring::Authored;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
    use shagreen_formats::starter::starter_library;

    use super::{HeightMapsWorker, needs_preparation};

    /// An interpolated texture with a height map, at a point whose first coordinate is a number.
    fn authored(number: f64) -> Authored {
        let model = starter_library().unwrap().textures[0].model.clone();
        let heights_m = (0..256).map(|i| 1e-6 * f64::from(i % 16)).collect();
        let map = HeightMap::new(heights_m, 0.02, HeightMapOptions::HARD_PLASTIC).unwrap();
        let model = model.with_height_map(Some(Arc::new(map)));
        let alone = Authored::alone(0, SpacePoint::new(number, 50.0).unwrap(), Mode::Field);
        Authored { model: Some(model), lock: None, ..alone }
    }

    /// The next texture that becomes ready; `None` if none is requested.
    fn next(worker: &mut HeightMapsWorker, ctx: &egui::Context) -> Option<f64> {
        let begun = Instant::now();
        loop {
            worker.begin(ctx);
            if let Some((ready, _)) = worker.collect() {
                assert!(!needs_preparation(&ready));
                return Some(ready.location.at.x());
            }
            if !worker.is_busy() && worker.running.is_none() {
                return None;
            }
            assert!(begun.elapsed() < Duration::from_mins(1), "nothing came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn the_latest_texture_comes_and_what_was_cancelled_does_not() {
        let (ctx, mut worker) = (egui::Context::default(), HeightMapsWorker::default());
        assert!(needs_preparation(&authored(1.0)) && next(&mut worker, &ctx).is_none());
        worker.ask(authored(1.0), Vec::new());
        worker.ask(authored(2.0), Vec::new());
        assert!(worker.is_busy());
        assert_eq!(next(&mut worker, &ctx), Some(2.0));
        assert_eq!(next(&mut worker, &ctx), None);
        // One that is running comes although newer ones wait, and then the newest one.
        worker.ask(authored(3.0), Vec::new());
        worker.begin(&ctx);
        worker.ask(authored(4.0), Vec::new());
        worker.ask(authored(5.0), Vec::new());
        assert_eq!(next(&mut worker, &ctx), Some(3.0));
        assert_eq!(next(&mut worker, &ctx), Some(5.0));
        worker.ask(authored(6.0), Vec::new());
        worker.begin(&ctx);
        worker.cancel();
        assert!(!worker.is_busy());
        assert_eq!(next(&mut worker, &ctx), None);
        worker.ask(authored(7.0), Vec::new());
        assert_eq!(next(&mut worker, &ctx), Some(7.0));
    }
}
