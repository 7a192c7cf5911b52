//! Background job that makes an estimate from words or a photo.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use anyhow::Context as _;
use egui::Context;
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::generated::Witness;
use shagreen_core::surfaces::prompt::{PromptInterpretation, interpret, title};
use shagreen_core::surfaces::shading::Picture as Surface;
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::picture::{Picture, Rgb, encode_jpeg, photo_pixels};
use shagreen_learn::diffusion::Wish;
use shagreen_learn::picture_predictor::PicturePredictor;

use super::Arrived;
use super::course::Course;
use super::position_estimate::{Origin, PositionEstimate, on_axes};
use crate::state::background::in_background;
use crate::state::source::Source;
use crate::strings::prompt as strings;
use shagreen_studio::generate::{generate_by_diffusion, generate_procedurally};
use shagreen_studio::models::{AddedDiffusion, ModelFolder};

/// Width and height of a generated picture, in pixels.
const SIDE: usize = 512;
/// Maximum length of a texture name, in characters.
const LONGEST_NAME: usize = 40;

/// Input of a job.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    Words { prompt: String, seed: u64 },
    Photo(Source),
}

/// Networks that make and interpret pictures.
#[derive(Clone, Debug)]
pub(super) struct Maker {
    pub(super) models: Option<ModelFolder>,
    /// Makes the pictures instead of the procedural generator.
    pub(super) diffusion: Option<AddedDiffusion>,
}

/// Running job; dropping it stops it.
pub(super) struct Job {
    course: Arc<Course>,
    replaces: Option<(u32, Arc<Picture>)>,
    axes: [String; 2],
    arriving: Receiver<Result<Option<PositionEstimate>, String>>,
}

impl Job {
    pub(super) fn begin(
        wanted: Wanted,
        replaces: Option<(u32, Arc<Picture>)>,
        maker: Maker,
        axes: [String; 2],
        ctx: &Context,
    ) -> Self {
        let course = Arc::new(Course::default());
        let of_space = axes.clone();
        let (on_the_way, screen) = (Arc::clone(&course), ctx.clone());
        let work = move || {
            made(wanted, &maker, &of_space, &on_the_way, &screen).map_err(|error| format!("{error:#}"))
        };
        Self { course, replaces, axes, arriving: in_background(ctx.clone(), work) }
    }

    /// Progress, 0 to 1, if the job has steps.
    pub(super) fn progress(&self) -> Option<f32> {
        self.course.progress()
    }

    /// Result, once the job has finished.
    pub(super) fn collect(&mut self) -> Option<Result<Arrived, String>> {
        match self.arriving.try_recv() {
            Ok(Ok(guess)) => guess
                .map(|guess| Ok(Arrived { guess, replaces: self.replaces.clone(), axes: self.axes.clone() })),
            Ok(Err(reason)) => Some(Err(reason)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(strings::BROKEN_OFF.to_owned())),
        }
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.course.stop();
    }
}

/// Makes the estimate; `None` if the job was stopped.
fn made(
    wanted: Wanted,
    maker: &Maker,
    axes: &[String; 2],
    course: &Course,
    ctx: &Context,
) -> anyhow::Result<Option<PositionEstimate>> {
    let looker = match &maker.models {
        Some(models) => models.looker()?,
        None => PicturePredictor::built_in(None)?,
    };
    match wanted {
        Wanted::Words { prompt, seed } => {
            let understood = interpret(&prompt, built_in_lexicon()?);
            let name = title(&prompt, LONGEST_NAME).unwrap_or_else(|| strings::NOTHING_SAID.to_owned());
            let made = match &maker.diffusion {
                None => generate_procedurally(&name, &understood, SIDE, seed)?,
                Some(added) => {
                    let models = maker.models.as_ref().context(strings::NO_MODELS)?;
                    let wish = Wish::usual(&prompt, seed);
                    course.set_steps(wish.n_steps);
                    let Some(made) = generate_by_diffusion(models, added, &wish, || course.step(ctx))? else {
                        return Ok(None);
                    };
                    made
                }
            };
            let witness = made.witness();
            let (made_by, picture) = (made.by, made.picture);
            let (axes, disputed) = told(&looker, Some(&understood), &picture, axes, witness)?;
            let mut said = strings::said_of_words(&understood);
            if !disputed.is_empty() {
                said.insert(0, strings::disputed(&disputed));
            }
            said.push(strings::made_by(&made_by, seed));
            if maker.diffusion.is_some() {
                said.push(strings::NO_SCALE.to_owned());
            }
            said.push(strings::seen_by(looker.model().eyes().name()));
            let made = PositionEstimate {
                surface: made.relief.map(|relief| relief.surface),
                is_disputed: !disputed.is_empty(),
                ..guess(Origin::Words { prompt, seed }, made_by, name, &picture, axes, said)?
            };
            Ok(Some(made))
        }
        Wanted::Photo(source) => {
            let name = source.name();
            let bytes = source.bytes().map_err(anyhow::Error::msg)?;
            let pixels = photo_pixels(&bytes).with_context(|| name.clone())?;
            let surface = pixels.into_surface(FRAMING.millimeters);
            let (axes, _) = told(&looker, None, &surface, axes, Witness::OnItsOwn)?;
            let said = vec![strings::seen_by(looker.model().eyes().name()), strings::NO_SCALE.to_owned()];
            let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem).to_owned();
            let made = guess(Origin::Photo(name), strings::A_PHOTO.to_owned(), stem, &surface, axes, said)?;
            Ok(Some(made))
        }
    }
}

type Told = ([Estimate; 2], Vec<String>);

/// Combines the estimates from words and picture. Also returns the axes on which they disagree.
fn told(
    looker: &PicturePredictor,
    words: Option<&PromptInterpretation>,
    surface: &Surface,
    axes: &[String; 2],
    witness: Witness,
) -> anyhow::Result<Told> {
    let seen = looker.look(surface)?;
    let (estimates, disputed) = on_axes(axes, words, &seen, witness);
    Ok((estimates, disputed.into_iter().map(str::to_owned).collect()))
}

fn guess(
    origin: Origin,
    made_by: String,
    name: String,
    surface: &Surface,
    axes: [Estimate; 2],
    said: Vec<String>,
) -> anyhow::Result<PositionEstimate> {
    let picture = Arc::new(encode_jpeg(&Rgb::from(surface), surface.millimeters)?);
    Ok(PositionEstimate {
        key: None,
        origin,
        made_by,
        picture,
        surface: None,
        name,
        axes,
        said,
        is_disputed: false,
    })
}
