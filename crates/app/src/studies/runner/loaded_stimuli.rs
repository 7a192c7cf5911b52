//! Stimuli of a study, made and prepared for the output in the background.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::people::study::schedule::trials;
use shagreen_core::people::study::trial::Trial;
use shagreen_core::units::Hertz;
use shagreen_formats::project::Project;
use shagreen_studio::file::one_line;
use shagreen_studio::report::Warnings;
use shagreen_studio::study::plans::StudyPlan;
use shagreen_studio::study::stimuli::{Stimuli, StimulusSound};
use shagreen_studio::study::textures::StudyTextures;

use crate::session::PresentedTexture;
use crate::state::background::in_background;
use crate::state::course::Course;
use crate::strings::studies as strings;

/// Stimuli of a plan, prepared for the output.
pub(crate) struct LoadedStimuli {
    stimuli: Stimuli,
    /// By hash and sample rate in Hz.
    prepared: BTreeMap<(String, u64), Arc<PresentedTexture>>,
}

/// What a trial presents, in the order of its labels, or both sides of a detection.
#[derive(Debug, Default)]
pub(super) struct TrialStimuli {
    pub(super) textures: Vec<Arc<PresentedTexture>>,
    pub(super) hashes: Vec<String>,
}

/// Stimuli that are being made. Dropping it stops the work.
pub(crate) struct Loading {
    course: Arc<Course>,
    arriving: Receiver<Result<LoadedStimuli, String>>,
}

impl Loading {
    /// Begins to make the stimuli of a plan from the textures of a project.
    pub(crate) fn begin(study: StudyPlan, project: Project, ctx: &Context) -> Self {
        let course = Arc::new(Course::default());
        let (on_the_way, screen) = (Arc::clone(&course), ctx.clone());
        let arriving =
            in_background(ctx.clone(), move || LoadedStimuli::make(&study, &project, &on_the_way, &screen));
        Self { course, arriving }
    }

    /// Progress, 0 to 1, once it is known.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.course.progress()
    }

    /// The stimuli once they are made, or why they cannot be made.
    pub(crate) fn collect(&self) -> Option<Result<LoadedStimuli, String>> {
        match self.arriving.try_recv() {
            Ok(loaded) => Some(loaded),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(strings::BROKEN_OFF.to_owned())),
        }
    }
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.course.stop();
    }
}

impl LoadedStimuli {
    fn make(study: &StudyPlan, project: &Project, course: &Course, ctx: &Context) -> Result<Self, String> {
        let mut on_step = |n_done: usize, n_all: usize| course.reach(n_done, n_all, ctx);
        let made = StudyTextures::of_project(project)
            .and_then(|textures| Stimuli::make(study, &textures, &Warnings::default(), &mut on_step));
        let stimuli = made.map_err(|error| one_line(&error))?;
        let mut loaded = Self { stimuli, prepared: BTreeMap::new() };
        // The trials of all participants present the same stimuli, except those that depend on the answers before.
        for part in &study.plan.parts {
            for trial in trials(&study.plan, part, 1) {
                let TrialStimuli { textures, hashes } = loaded.of_trial(&trial)?;
                for (texture, hash) in textures.into_iter().zip(hashes) {
                    loaded.prepared.insert(key_of(&hash, texture.rate()), texture);
                }
            }
        }
        Ok(loaded)
    }

    /// What a trial presents. What is not prepared yet, because it depends on the answers before, is prepared now.
    ///
    /// # Errors
    /// States which stimulus cannot be made.
    pub(super) fn of_trial(&self, trial: &Trial) -> Result<TrialStimuli, String> {
        let sounds = self.stimuli.of_trial(trial).map_err(|error| one_line(&error))?;
        let rate = Hertz(sounds.iter().map(|sound| sound.rate().0).fold(0.0, f64::max));
        let textures = sounds.iter().map(|sound| self.texture(sound, rate)).collect::<Result<_, _>>()?;
        Ok(TrialStimuli { textures, hashes: Stimuli::hashes(&sounds) })
    }

    /// A stimulus at a sample rate.
    fn texture(&self, sound: &StimulusSound, rate: Hertz) -> Result<Arc<PresentedTexture>, String> {
        match self.prepared.get(&key_of(sound.sha256(), rate)) {
            Some(known) => Ok(Arc::clone(known)),
            None => Ok(Arc::new(PresentedTexture::new(sound, rate)?)),
        }
    }
}

/// Key of a stimulus at a sample rate.
fn key_of(sha256: &str, rate: Hertz) -> (String, u64) {
    (sha256.to_owned(), rate.0.round() as u64)
}
