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
use shagreen_formats::photo_networks::PhotoNetworks;
use shagreen_formats::picture::{Picture, Rgb, encode_jpeg, photo_pixels};
use shagreen_learn::diffusion::Wish;
use shagreen_learn::picture_predictor::PicturePredictor;

use super::Arrived;
use super::position_estimate::{MaterialEstimate, Origin, PositionEstimate, on_axes};
use crate::state::background::in_background;
use crate::state::course::Course;
use crate::state::source::Source;
use crate::strings::prompt as strings;
use shagreen_studio::generate::{generate_by_diffusion, generate_procedurally};
use shagreen_studio::models::{AddedDiffusion, ModelFolder};
use shagreen_studio::photo_predictor::photo_predictor;
use shagreen_studio::seen_materials::{doubt_with_advice, seen_materials};

/// Width and height of a generated picture, in pixels.
const SIDE: usize = 512;
/// Maximum length of a texture name, in characters.
const LONGEST_NAME: usize = 40;

/// Input of a job.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    Words {
        prompt: String,
        seed: u64,
    },
    /// Photo, and a description of what it shows if the user gave one.
    Photo {
        source: Source,
        prompt: Option<String>,
    },
}

/// Networks that make and interpret pictures.
#[derive(Clone, Debug)]
pub(super) struct Maker {
    pub(super) models: Option<ModelFolder>,
    /// Networks that predict attributes from pictures, if the user has chosen any.
    pub(super) networks: Option<PhotoNetworks>,
    /// Makes the pictures instead of the procedural generator.
    pub(super) diffusion: Option<AddedDiffusion>,
}

/// Running job; dropping it stops it.
pub(super) struct Job {
    course: Arc<Course>,
    replaces: Option<(u32, Arc<Picture>)>,
    axes: Vec<String>,
    arriving: Receiver<Result<Option<PositionEstimate>, String>>,
}

impl Job {
    pub(super) fn begin(
        wanted: Wanted,
        replaces: Option<(u32, Arc<Picture>)>,
        maker: Maker,
        axes: Vec<String>,
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
    axes: &[String],
    course: &Course,
    ctx: &Context,
) -> anyhow::Result<Option<PositionEstimate>> {
    let looker = photo_predictor(maker.networks.as_ref(), maker.models.as_ref())?;
    match wanted {
        Wanted::Words { prompt, seed } => of_words(&looker, prompt, seed, maker, axes, course, ctx),
        Wanted::Photo { source, prompt } => of_photo(&looker, &source, prompt, axes).map(Some),
    }
}

/// Makes the estimate of a prompt and of its picture; `None` if the job was stopped.
fn of_words(
    looker: &PicturePredictor,
    prompt: String,
    seed: u64,
    maker: &Maker,
    axes: &[String],
    course: &Course,
    ctx: &Context,
) -> anyhow::Result<Option<PositionEstimate>> {
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
    let told = told(looker, Some(&understood), &made.picture, axes, witness)?;
    let mut said = strings::said_of_words(&understood);
    let made_by = strings::made_by(&made.by, seed);
    let is_disputed = witness == Witness::OnItsOwn && !told.disputed.is_empty();
    if is_disputed {
        said.insert(0, strings::disputed(&told.disputed));
    }
    match witness {
        Witness::OfTheWords => {
            said.extend([made_by, strings::BY_WORDS.to_owned()]);
            if !told.disputed.is_empty() {
                said.push(strings::picture_differs(&told.disputed));
            }
        }
        Witness::OnItsOwn => {
            let eyes = looker.model().eyes().name();
            said.extend([made_by, strings::NO_SCALE.to_owned(), strings::seen_with_words(eyes)]);
        }
    }
    Ok(Some(PositionEstimate {
        surface: made.relief.map(|relief| relief.surface),
        is_disputed,
        ..guess(Origin::Words { prompt, seed }, made.by, name, &made.picture, told, said)?
    }))
}

/// Makes the estimate of a photo, and of a description of what it shows.
fn of_photo(
    looker: &PicturePredictor,
    source: &Source,
    prompt: Option<String>,
    axes: &[String],
) -> anyhow::Result<PositionEstimate> {
    let name = source.name();
    let bytes = source.bytes().map_err(anyhow::Error::msg)?;
    let pixels = photo_pixels(&bytes).with_context(|| name.clone())?;
    let surface = pixels.into_surface(FRAMING.millimeters);
    let understood = match &prompt {
        Some(prompt) => Some(interpret(prompt, built_in_lexicon()?)),
        None => None,
    };
    let told = told(looker, understood.as_ref(), &surface, axes, Witness::OnItsOwn)?;
    let eyes = looker.model().eyes().name();
    let is_disputed = !told.disputed.is_empty();
    let mut said = Vec::new();
    if is_disputed {
        said.push(strings::disputed(&told.disputed));
    }
    match &understood {
        Some(understood) => {
            said.extend(strings::said_of_words(understood));
            said.push(strings::seen_with_words(eyes));
        }
        None => said.push(strings::seen_by(eyes)),
    }
    said.push(strings::NO_SCALE.to_owned());
    let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem).to_owned();
    let origin = Origin::Photo { name, prompt };
    let guess = guess(origin, strings::A_PHOTO.to_owned(), stem, &surface, told, said)?;
    Ok(PositionEstimate { is_disputed, ..guess })
}

/// What words and picture say together.
struct Told {
    names: Vec<String>,
    axes: Vec<Estimate>,
    /// Names of the axes on which they disagree.
    disputed: Vec<String>,
    materials: Vec<MaterialEstimate>,
    doubts: Vec<String>,
}

/// Combines the estimates from words and picture.
fn told(
    looker: &PicturePredictor,
    words: Option<&PromptInterpretation>,
    surface: &Surface,
    axes: &[String],
    witness: Witness,
) -> anyhow::Result<Told> {
    let seen = looker.look(surface)?;
    let (estimates, disputed) = on_axes(axes, words, &seen.attributes, witness);
    let disputed = disputed.into_iter().map(str::to_owned).collect();
    let names = axes.to_vec();
    if witness == Witness::OfTheWords {
        // What such a picture looks like is known from the words.
        return Ok(Told { names, axes: estimates, disputed, materials: Vec::new(), doubts: Vec::new() });
    }
    let materials = seen_materials(&seen.materials, built_in_lexicon()?);
    Ok(Told {
        names,
        axes: estimates,
        disputed,
        materials: materials.iter().map(|material| MaterialEstimate::new(material, axes)).collect(),
        doubts: seen.doubts.iter().map(|doubt| strings::doubt(&doubt_with_advice(*doubt))).collect(),
    })
}

fn guess(
    origin: Origin,
    made_by: String,
    name: String,
    surface: &Surface,
    told: Told,
    said: Vec<String>,
) -> anyhow::Result<PositionEstimate> {
    let picture = Arc::new(encode_jpeg(&Rgb::from(surface), surface.millimeters)?);
    let Told { names, axes, materials, doubts, .. } = told;
    Ok(PositionEstimate {
        key: None,
        origin,
        made_by,
        picture,
        surface: None,
        name,
        names,
        axes,
        means: Vec::new(),
        said,
        is_disputed: false,
        materials,
        doubts,
        taken: None,
    })
}
