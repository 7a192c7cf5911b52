//! Background job that simulates the texture of a generated picture, while the interpolated texture is audible.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::surfaces::felt_material::n_steps;
use shagreen_core::texture::TextureModel;
use shagreen_formats::picture::Picture;
use shagreen_studio::felt::{GeneratedSurface, felt};

use crate::state::background::in_background;
use crate::state::course::Course;
use crate::strings::prompt as strings;

/// Running simulation; dropping it stops it.
pub(super) struct Simulation {
    course: Arc<Course>,
    key: u32,
    picture: Arc<Picture>,
    arriving: Receiver<Result<Option<TextureModel>, String>>,
}

/// Result of a simulation.
#[derive(Debug)]
pub(crate) struct Simulated {
    /// Key of the authored texture, and its picture when the simulation began.
    pub(crate) of: (u32, Arc<Picture>),
    pub(crate) model: TextureModel,
}

impl Simulation {
    /// Begins to simulate the surface that a picture shows, for the authored texture with this key.
    pub(super) fn begin(surface: GeneratedSurface, key: u32, picture: Arc<Picture>, ctx: &Context) -> Self {
        let course = Arc::new(Course::default());
        course.set_steps(n_steps(&surface.material));
        let (on_the_way, screen) = (Arc::clone(&course), ctx.clone());
        let work =
            move || felt(&surface, |_, _| on_the_way.step(&screen)).map_err(|error| format!("{error:#}"));
        Self { course, key, picture, arriving: in_background(ctx.clone(), work) }
    }

    /// Progress, 0 to 1.
    pub(super) fn progress(&self) -> f32 {
        self.course.progress().unwrap_or(0.0)
    }

    /// Result, once the simulation has finished.
    pub(super) fn collect(&mut self) -> Option<Result<Simulated, String>> {
        match self.arriving.try_recv() {
            Ok(Ok(model)) => {
                let of = (self.key, Arc::clone(&self.picture));
                model.map(|model| Ok(Simulated { of, model }))
            }
            Ok(Err(reason)) => Some(Err(reason)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(strings::SIMULATION_BROKEN_OFF.to_owned())),
        }
    }
}

impl Drop for Simulation {
    fn drop(&mut self) {
        self.course.stop();
    }
}
