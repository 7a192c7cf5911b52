//! A worker that makes textures audible: it makes the plane of an interpolated texture and of the textures of the library that
//! get its shape, and prepares them with their height maps for the renderer. Meanwhile the previous texture plays.

use std::sync::mpsc::{Receiver, TryRecvError};

use shagreen_core::space::authoring::Authored;

use super::audible::{ReadyPlane, Shaped, Unshaped, audible_model};
use crate::state::background::in_background;

/// One worker makes textures. A newer texture replaces a waiting one.
#[derive(Default)]
pub(super) struct AudibleWorker {
    waiting: Option<(Authored, Vec<Unshaped>)>,
    running: Option<Receiver<ReadyTexture>>,
    /// Whether nobody waits for the running texture anymore.
    is_stale: bool,
    /// Whether the newest texture that was requested has not come.
    is_behind: bool,
}

/// A texture that is ready to play.
pub(super) struct ReadyTexture {
    pub(super) authored: Authored,
    /// The interpolated texture, if it is one of the voices.
    pub(super) made: Option<ReadyPlane>,
    /// Requested textures of the library in the shape.
    pub(super) shaped: Vec<Shaped>,
}

impl ReadyTexture {
    fn new(authored: Authored, unshaped: Vec<Unshaped>) -> Self {
        let made = audible_model(&authored).map(ReadyPlane::of);
        let shaped = unshaped.into_iter().filter_map(Unshaped::shaped).collect();
        Self { authored, made, shaped }
    }
}

impl AudibleWorker {
    /// Requests a texture, and textures of the library in its shape.
    pub(super) fn ask(&mut self, authored: Authored, unshaped: Vec<Unshaped>) {
        (self.waiting, self.is_behind) = (Some((authored, unshaped)), true);
    }

    /// Discards all requests.
    pub(super) fn cancel(&mut self) {
        (self.waiting, self.is_stale, self.is_behind) = (None, true, false);
    }

    /// Starts the waiting texture if the worker is idle, once a frame.
    pub(super) fn begin(&mut self, ctx: &egui::Context) {
        if self.running.is_some() {
            return;
        }
        if let Some((authored, unshaped)) = self.waiting.take() {
            self.is_stale = false;
            self.running = Some(in_background(ctx.clone(), move || ReadyTexture::new(authored, unshaped)));
        }
    }

    /// The texture that has become ready, once a frame. One that a newer texture replaced while it was made comes, too, so that
    /// a point that is dragged is heard on its way.
    pub(super) fn collect(&mut self) -> Option<ReadyTexture> {
        let outcome = self.running.as_ref()?.try_recv();
        if matches!(outcome, Err(TryRecvError::Empty)) {
            return None;
        }
        self.running = None;
        // A worker that broke off has no texture.
        let ready = outcome.ok().filter(|_| !self.is_stale)?;
        self.is_behind = self.waiting.is_some();
        Some(ready)
    }

    /// Whether the newest texture that was requested has not come, so that a previous one plays.
    pub(super) fn is_behind(&self) -> bool {
        self.is_behind
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::mpsc::channel;
    use std::time::{Duration, Instant};

    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::authoring::Authored;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
    use shagreen_core::texture::plane::Plane;
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::starter::starter_library;

    use super::{AudibleWorker, ReadyTexture};
    use crate::session::audible::{audible_model, needs_preparation};

    /// An interpolated texture with a height map, at a point whose first coordinate is a number.
    fn authored(number: f64) -> Authored {
        let model = starter_library().unwrap().textures[0].model.clone();
        let heights_m = (0..256).map(|i| 1e-6 * f64::from(i % 16)).collect();
        let map = HeightMap::new(heights_m, 0.02, HeightMapOptions::HARD_PLASTIC).unwrap();
        let model = model.with_height_map(Some(Arc::new(map)));
        let alone = Authored::alone(0, SpacePoint::new(number, 50.0).unwrap(), Mode::Field);
        Authored { model: Some(model), lock: None, ..alone }
    }

    /// Whether the height map must be prepared before the texture plays.
    fn is_slow(authored: &Authored) -> bool {
        needs_preparation(audible_model(authored).unwrap(), &Shape::default())
    }

    /// The next texture that becomes ready; `None` if none is requested.
    fn next(worker: &mut AudibleWorker, ctx: &egui::Context) -> Option<ReadyTexture> {
        let begun = Instant::now();
        loop {
            worker.begin(ctx);
            let ready = worker.collect();
            if ready.is_some() || (!worker.is_behind() && worker.running.is_none()) {
                return ready;
            }
            assert!(begun.elapsed() < Duration::from_mins(1), "nothing came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Number of the next texture that becomes ready.
    fn next_number(worker: &mut AudibleWorker, ctx: &egui::Context) -> Option<f64> {
        let ready = next(worker, ctx)?;
        assert!(ready.made.is_some() && !is_slow(&ready.authored));
        Some(ready.authored.location.at.x())
    }

    #[test]
    fn the_latest_texture_comes_and_what_was_cancelled_does_not() {
        let (ctx, mut worker) = (egui::Context::default(), AudibleWorker::default());
        assert!(is_slow(&authored(1.0)) && next_number(&mut worker, &ctx).is_none());
        worker.ask(authored(1.0), Vec::new());
        worker.ask(authored(2.0), Vec::new());
        assert!(worker.is_behind());
        assert_eq!(next_number(&mut worker, &ctx), Some(2.0));
        assert!(!worker.is_behind());
        assert_eq!(next_number(&mut worker, &ctx), None);
        // One that is running comes although newer ones wait, and then the newest one.
        worker.ask(authored(3.0), Vec::new());
        worker.begin(&ctx);
        worker.ask(authored(4.0), Vec::new());
        worker.ask(authored(5.0), Vec::new());
        assert_eq!(next_number(&mut worker, &ctx), Some(3.0));
        assert!(worker.is_behind(), "the newest one has not come");
        assert_eq!(next_number(&mut worker, &ctx), Some(5.0));
        worker.ask(authored(6.0), Vec::new());
        worker.begin(&ctx);
        worker.cancel();
        assert!(!worker.is_behind());
        assert_eq!(next_number(&mut worker, &ctx), None);
        worker.ask(authored(7.0), Vec::new());
        assert_eq!(next_number(&mut worker, &ctx), Some(7.0));
    }

    #[test]
    fn what_comes_only_needs_a_number() {
        let (ctx, mut worker) = (egui::Context::default(), AudibleWorker::default());
        let asked = authored(1.0);
        worker.ask(asked.clone(), Vec::new());
        let made = next(&mut worker, &ctx).and_then(|ready| ready.made).unwrap();
        let mut n_made = 6;
        let (plane, made) = made.numbered(&mut n_made);
        assert_eq!((made.number, n_made), (7, 7));
        let expected = Plane::new(asked.model.as_ref().unwrap());
        assert!(*made.prepared == expected.prepare() && plane.rate() == expected.rate());
        // At its position, a pinned texture plays alone.
        worker.ask(Authored { lock: Some((0, 1.0)), ..asked }, Vec::new());
        assert!(next(&mut worker, &ctx).unwrap().made.is_none());
    }

    /// Otherwise the texture before would be saved as this one.
    #[test]
    fn a_worker_that_broke_off_stays_behind() {
        let mut worker = AudibleWorker::default();
        worker.ask(authored(1.0), Vec::new());
        // Its sender is gone.
        (worker.waiting, worker.running) = (None, Some(channel().1));
        assert!(worker.collect().is_none() && worker.running.is_none());
        assert!(worker.is_behind());
    }
}
