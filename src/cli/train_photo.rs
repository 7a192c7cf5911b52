//! `shagreen train photo`: trains predictors of roughness and hardness from pictures and evaluates them.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context as _, ensure};
use serde_json::{Value, json};
use shagreen_core::space::LabelSource;
use shagreen_core::surfaces::picture_features::N_FEATURES;
use shagreen_core::words::counted;
use shagreen_formats::library::{Library, USUAL_AXES};
use shagreen_formats::starter::starter_anchors;
use shagreen_formats::{atomic, picture};
use shagreen_learn::backbone::Backbone;
use shagreen_learn::model_file::is_model;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::drawn_pictures::{drawn_pictures, see_all};
use crate::cli::library_args::LibraryArgs;
use crate::cli::method_predictions::{Comparison, MethodPredictions};
use crate::cli::output;
use crate::cli::progress::Progress;
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Trains predictors of roughness and hardness from pictures and reports their leave-one-texture-out errors: each
/// texture is predicted by a model trained on the other textures and on pictures of random materials.
///
/// Random materials (also called drawn materials) are simulated surfaces whose parameters are drawn at random. Their
/// roughness and hardness are computed; no person rated them. Statistics of the picture need no other file; a
/// pretrained image network (`shagreen model fetch`) is more accurate. On two cores, computing the features of 3,000
/// pictures takes half an hour, and the leave-one-out training over 25 textures takes another half hour.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    backbone: BackboneArgs,
    /// Number of random materials to train on, in addition to the library.
    #[arg(long, default_value_t = 3000, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    drawn: u32,
    /// Largest number of epochs.
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    epochs: u32,
    /// Number of epochs without a lower error on the validation pictures after which the training of a head stops.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    patience: u32,
    /// Number of heads (output networks). They are trained independently; the prediction is their mean.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=16))]
    heads: u32,
    /// Random seed of the training and of the random materials.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for the features of the pictures of random materials; they are computed only once, and an interrupted
    /// computation resumes.
    #[arg(long, value_name = "FOLDER")]
    state: Option<PathBuf>,
    /// File to write: a model trained on all pictures, with the image network if there is one, otherwise with
    /// statistics of the picture.
    #[arg(long, short, value_name = "MODEL")]
    out: Option<PathBuf>,
    /// Train once, on random materials alone. No texture of the library is used for training; all are used for
    /// evaluation.
    #[arg(long)]
    drawn_only: bool,
    /// Only train the model, without measuring its error.
    #[arg(long, requires = "out")]
    unjudged: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    let backbone = read_backbone(&args.backbone)?;
    if let Some(out) = &args.out {
        refuse_inputs(&[out], &[args.library.path(), args.backbone.path()])?;
        refuse_foreign(out, "a model", is_model)?;
        atomic::check_all(&[out])?;
    }
    if let Some(folder) = &args.state {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    let library = args.library.load()?;
    ensure!(
        library.axis_names() == USUAL_AXES,
        "the axes of \"{}\" are {}; pictures predict rough-smooth and hard-soft, so choose a library with these axes",
        library.name,
        library.axis_names().join(" and ")
    );
    let progress = Progress::endless("computing the features of the library's pictures");
    let textures = pictured(&library, backbone.as_ref())?;
    progress.finish();
    let kept = args.state.as_ref().map(|folder| folder.join(format!("drawn-{}.safetensors", args.seed)));
    let drawn = drawn_pictures(
        args.drawn as usize,
        args.seed,
        backbone.as_ref(),
        &starter_anchors()?.1,
        kept.as_deref(),
    )?;
    let values: Vec<Vec<f64>> = textures.iter().map(|seen| seen.labels.clone()).collect();

    let of_drawn = format!("pictures of {}", counted(drawn.len(), "drawn material"));
    let learned_from = if args.drawn_only {
        of_drawn
    } else {
        format!("{of_drawn} and of \"{}\" ({})", library.name, counted(textures.len(), "texture"))
    };
    let (mut all, mut n_epochs, mut model) = (Vec::new(), 0, None);
    // Statistics first, then the network; each uses its own part of the features.
    let network = backbone.as_ref().map(|backbone| FeatureExtractor::of(Some(backbone)));
    // Without an evaluation, only the model to write is trained.
    let statistics = (!args.unjudged || network.is_none()).then_some(FeatureExtractor::Statistics);
    for eyes in [statistics, network].into_iter().flatten() {
        let taught = teach(args, eyes, &learned_from, &drawn, &textures)?;
        all.push(taught.judged);
        n_epochs += taught.n_epochs;
        model = taught.of_all;
    }
    all.push(MethodPredictions::mean_of_others(&values));
    if let (Some(out), Some(model)) = (&args.out, &model) {
        atomic::write(out, &model.to_bytes()?)?;
    }
    if args.unjudged {
        let out = args.out.as_ref().map(|out| out.display().to_string());
        let result = json!({"out": out, "drawn": drawn.len(), "seconds": started.elapsed().as_secs_f64()});
        output::print(args.json, &result, || format!("Wrote the model: {}", out.clone().unwrap_or_default()));
        return Ok(());
    }
    let names = USUAL_AXES.map(str::to_owned);
    let comparison = Comparison::new(&all, &names, &values);
    let mut result = comparison.as_json();
    let more = json!({
        "textures": textures.len(),
        "drawn": drawn.len(),
        "label_source": library.label_sources().iter().map(|source| source.id()).collect::<Vec<_>>(),
        "epochs": n_epochs,
        "seconds": started.elapsed().as_secs_f64(),
    });
    result.extend(more.as_object().cloned().unwrap_or_default());
    output::print(args.json, &Value::Object(result), || {
        format!(
            "{} {}; trained on {learned_from}. The labels of drawn materials (random parameters) are computed; no person rated them.\n\n{}",
            if args.drawn_only {
                "Errors, with no texture used for training, over"
            } else {
                "Leave-one-texture-out errors over"
            },
            counted(textures.len(), "texture"),
            comparison.text()
        )
    });
    Ok(())
}

/// Result of training on one kind of features.
struct Taught {
    judged: MethodPredictions,
    /// Model trained on all pictures, if it is requested.
    of_all: Option<PictureModel>,
    /// Number of epochs of all trainings.
    n_epochs: usize,
}

/// Trains on drawn pictures and those of textures, with the features of `eyes`, without each texture in turn.
fn teach(
    args: &Args,
    eyes: FeatureExtractor,
    learned_from: &str,
    drawn: &[Seen],
    textures: &[Seen],
) -> anyhow::Result<Taught> {
    let part = |seen: &Seen| {
        let (statistics, network) = seen.features.split_at(N_FEATURES);
        let features = if eyes == FeatureExtractor::Statistics { statistics } else { network };
        Seen { features: features.to_vec(), labels: seen.labels.clone() }
    };
    let drawn: Vec<Seen> = drawn.iter().map(part).collect();
    let known: Vec<Seen> = textures.iter().map(part).collect();
    let name = eyes.name().to_owned();
    let attributes = USUAL_AXES.map(str::to_owned).to_vec();
    let lesson = TrainingMetadata { eyes, attributes, learned_from: learned_from.to_owned() };
    let config =
        PictureConfig::paper(args.epochs as usize, args.patience as usize, args.heads as usize, args.seed);
    let learned: Vec<&Seen> = if args.drawn_only { Vec::new() } else { known.iter().collect() };
    let mut n_epochs = 0;
    let mut learn = |left_out: Option<usize>| {
        let others = learned.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, seen)| *seen);
        let pictures: Vec<&Seen> = drawn.iter().chain(others).collect();
        let before = n_epochs;
        PictureModel::learn(&pictures, lesson.clone(), &config, |n| {
            n_epochs = before + n;
            true
        })
    };
    let of_all = if args.out.is_some() || args.drawn_only {
        let _progress = Progress::endless("training on all pictures");
        Some(learn(None)?)
    } else {
        None
    };
    let n_judged = if args.unjudged { 0 } else { known.len() };
    let progress = Progress::new("training without each texture", n_judged);
    let mut predicted = Vec::with_capacity(n_judged);
    for (index, left_out) in known.iter().enumerate().take(n_judged) {
        let estimates = match &of_all {
            Some(model) if args.drawn_only => model.predict(&left_out.features)?,
            _ => learn(Some(index))?.predict(&left_out.features)?,
        };
        predicted.push(estimates.iter().map(|of| of.mean).collect());
        progress.step();
    }
    progress.finish();
    Ok(Taught { judged: MethodPredictions { name, predicted }, of_all, n_epochs })
}

/// Returns the features of all textures that have a position and a picture.
fn pictured(library: &Library, backbone: Option<&Backbone>) -> anyhow::Result<Vec<Seen>> {
    let mut textures = Vec::new();
    for texture in &library.textures {
        let (Some(place), Some(packed)) = (&texture.place, &texture.picture) else { continue };
        // An estimated position is itself a prediction.
        if place.source == LabelSource::Estimated {
            continue;
        }
        let pixels = picture::decode(packed).with_context(|| format!("the picture of \"{}\"", texture.id))?;
        let picture = pixels.into_surface(packed.millimeters);
        let features =
            see_all(backbone, &picture).with_context(|| format!("the picture of \"{}\"", texture.id))?;
        let labels = vec![place.at.rough_smooth, place.at.hard_soft];
        textures.push(Seen { features, labels });
    }
    ensure!(
        textures.len() >= 3,
        "\"{}\" has only {} with a picture and a position that is not an estimate, but at least three are needed; add pictures to the library in the window",
        library.name,
        counted(textures.len(), "texture")
    );
    Ok(textures)
}
