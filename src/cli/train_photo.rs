//! `shagreen train photo`: trains predictors of roughness and hardness from pictures and evaluates them.

mod kept_predictions;

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, ensure};
use serde_json::{Value, json};
use shagreen_core::maths::shard::Shard;
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::left_out_prediction::LeftOutPrediction;
use shagreen_formats::library::USUAL_AXES;
use shagreen_formats::starter::starter_anchors;
use shagreen_learn::backbone::Backbone;
use shagreen_learn::model_file::is_model;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::drawn_pictures::{drawn_pictures, see_all, seen_by};
use crate::cli::labelled_photos::PhotoFiles;
use crate::cli::library_args::LibraryArgs;
use crate::cli::method_predictions::{Comparison, MethodPredictions};
use crate::cli::output;
use crate::cli::prediction_figures::{FigureArgs, Judged};
use crate::cli::progress::Progress;
use crate::cli::texture_pictures::{PictureArgs, PicturedTexture};
use crate::cli::train_labelled_photos::{LabelledArgs, Training};
use crate::cli::train_photo::kept_predictions::KeptPredictions;
use shagreen_studio::file;
use shagreen_studio::picture_predictions::predict_texture;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Trains predictors of roughness and hardness from pictures and reports their leave-one-texture-out errors: each
/// texture is predicted by a model trained on the other textures and on pictures of random materials.
///
/// Random materials (also called drawn materials) are simulated surfaces whose parameters are drawn at random. Their
/// roughness and hardness are computed; no person rated them. Statistics of the picture need no other file; a
/// pretrained image network (`shagreen model fetch`) is more accurate. On two cores, computing the features of 3,000
/// pictures takes half an hour, and the leave-one-out training over 25 textures takes another half hour.
///
/// With --photos, the model learns from labelled photos of real materials too, and the errors are those on classes and
/// sources of photos that were left out of the training.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    backbone: BackboneArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    labelled: LabelledArgs,
    /// Number of random materials to train on, in addition to the library or to the labelled photos.
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
    /// Folder for the features of the pictures of random materials and of labelled photos, and for the predictions without
    /// each texture; they are computed only once, and an interrupted computation resumes.
    #[arg(long, value_name = "FOLDER")]
    state: Option<PathBuf>,
    /// Train only without each texture of a part, such as 2/4, and keep the predictions in the folder --state, to divide the
    /// work among computers. Once all parts are done, the command without --shard, on a folder with all files of these
    /// folders, evaluates them without training again.
    #[arg(
        long,
        value_name = "I/N",
        requires = "state",
        conflicts_with_all = ["out", "photos", "drawn_only", "unjudged", "figures"]
    )]
    shard: Option<Shard>,
    /// File to write: a model trained on all pictures, with the image network if there is one, otherwise with
    /// statistics of the picture.
    #[arg(long, short, value_name = "MODEL")]
    out: Option<PathBuf>,
    /// Train once, on random materials alone. No texture of the library is used for training; all are used for
    /// evaluation.
    #[arg(long)]
    drawn_only: bool,
    /// Only train the model, without measuring its error.
    #[arg(long, requires = "out", conflicts_with = "figures")]
    unjudged: bool,
    #[command(flatten)]
    figures: FigureArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let started = Instant::now();
    let backbone = read_backbone(&args.backbone)?;
    let [table, heads] = args.labelled.inputs();
    let inputs = [args.library.path(), args.backbone.path(), args.pictures.path(), table, heads];
    if let Some(out) = &args.out {
        refuse_inputs(&[out], &inputs)?;
        refuse_foreign(out, "a model", is_model)?;
        atomic::check_all(&[out])?;
    }
    let names = USUAL_AXES.map(str::to_owned);
    args.figures.check(&names, &inputs)?;
    if let Some(folder) = &args.state {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    if let Some(table) = args.labelled.table() {
        return train_on_photos(args, table, backbone.as_ref());
    }
    let library = args.library.load()?;
    ensure!(
        library.axis_names() == USUAL_AXES,
        "the axes of \"{}\" are {}; pictures predict rough-smooth and hard-soft, so choose a library with these axes",
        library.name,
        library.axis_names().join(" and ")
    );
    let progress = Progress::endless("computing the features of the library's pictures");
    let textures = args.pictures.textures(&library, |picture| Ok(see_all(backbone.as_ref(), picture)?))?;
    progress.finish();
    let drawn = drawn_of(args, backbone.as_ref())?;
    let first = textures.iter().filter_map(|texture| texture.pictures.first());
    let values: Vec<Vec<f64>> = first.map(|seen| seen.labels.clone()).collect();
    let n_pictures: usize = textures.iter().map(|texture| texture.pictures.len()).sum();
    let mut extent = counted(textures.len(), "texture");
    if n_pictures > textures.len() {
        extent = format!("{extent} with {}", counted(n_pictures, "picture"));
    }

    let of_drawn = described(&drawn);
    let learned_from =
        if args.drawn_only { of_drawn } else { format!("{of_drawn} and of \"{}\" ({extent})", library.name) };
    let (mut all, mut deviations, mut n_epochs, mut model) = (Vec::new(), Vec::new(), 0, None);
    // Statistics first, then the network; each uses its own part of the features.
    let network = backbone.as_ref().map(|backbone| FeatureExtractor::of(Some(backbone)));
    // Without an evaluation, only the model to write is trained.
    let statistics = (!args.unjudged || network.is_none()).then_some(FeatureExtractor::Statistics);
    for eyes in [statistics, network].into_iter().flatten() {
        let taught = teach(args, eyes, &learned_from, &drawn, &textures)?;
        deviations.push((taught.judged.name.clone(), taught.deviations));
        all.push(taught.judged);
        n_epochs += taught.n_epochs;
        model = taught.of_all;
    }
    if let Some(shard) = args.shard {
        print_part(args, shard, &textures);
        return Ok(());
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
    let sources = library.label_sources();
    let known_sources = sources.iter().filter(|source| **source != LabelSource::Estimated);
    let drawing = args.figures.write(&Judged {
        methods: &all,
        deviations: &deviations,
        textures: &textures.iter().map(|texture| texture.name.clone()).collect::<Vec<_>>(),
        attributes: &names,
        actual: &values,
        validation: if args.drawn_only { "trained on drawn materials only" } else { "leave-one-texture-out" },
        source: &known_sources.map(|source| source.label()).collect::<Vec<_>>().join(", "),
    });
    let comparison = Comparison::new(&all, &names, &values);
    let mut result = comparison.as_json();
    let more = json!({
        "textures": textures.len(),
        "pictures": n_pictures,
        "drawn": drawn.len(),
        "label_source": sources.iter().map(|source| source.id()).collect::<Vec<_>>(),
        "epochs": n_epochs,
        "figures": args.figures.folder().map(|folder| folder.display().to_string()),
        "seconds": started.elapsed().as_secs_f64(),
    });
    result.extend(more.as_object().cloned().unwrap_or_default());
    output::print(args.json, &Value::Object(result), || {
        format!(
            "{} {extent}; trained on {learned_from}. The labels of drawn materials (random parameters) are computed; no person rated them.\n\n{}",
            if args.drawn_only {
                "Errors, with no texture used for training, over"
            } else {
                "Leave-one-texture-out errors over"
            },
            comparison.text()
        )
    });
    // After the result, which took hours and must not be lost with the figures.
    drawing
}

/// Prints which textures a part has predicted.
fn print_part(args: &Args, shard: Shard, textures: &[PicturedTexture]) {
    let names: Vec<&str> = shard.indices(textures.len()).map(|index| &*textures[index].name).collect();
    let state = args.state.as_ref().map(|folder| folder.display().to_string());
    let result = json!({"shard": shard.to_string(), "state": state, "textures": names});
    output::print(args.json, &result, || {
        format!(
            "Trained without each of {} ({}); when all parts are trained, run the command without --shard: {}",
            counted(names.len(), "texture"),
            names.join(", "),
            state.clone().unwrap_or_default()
        )
    });
}

/// Result of training on one kind of features.
struct Taught {
    judged: MethodPredictions,
    /// Standard deviations that the method states: textures × attributes, in points.
    deviations: Vec<Vec<f64>>,
    /// Model trained on all pictures, if it is requested.
    of_all: Option<PictureModel>,
    /// Number of epochs of all trainings.
    n_epochs: usize,
}

/// Trains on drawn pictures and those of textures, with the features of `eyes`, without all pictures of each texture in
/// turn.
fn teach(
    args: &Args,
    eyes: FeatureExtractor,
    learned_from: &str,
    drawn: &[Seen],
    textures: &[PicturedTexture],
) -> anyhow::Result<Taught> {
    let drawn: Vec<Seen> = drawn.iter().map(|seen| seen_by(&eyes, seen)).collect();
    let pictures = |texture: &PicturedTexture| -> Vec<Seen> {
        texture.pictures.iter().map(|seen| seen_by(&eyes, seen)).collect()
    };
    let known: Vec<Vec<Seen>> = textures.iter().map(pictures).collect();
    let name = eyes.name().to_owned();
    let (lesson, config) = lesson(args, eyes, learned_from);
    let learned: &[Vec<Seen>] = if args.drawn_only { &[] } else { &known };
    // A model and the number of its epochs.
    let learn = |left_out: Option<usize>| -> anyhow::Result<(PictureModel, usize)> {
        let others = learned.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
        let others = others.flat_map(|(_, pictures)| pictures);
        let pictures: Vec<&Seen> = drawn.iter().chain(others).collect();
        let mut n_epochs = 0;
        let model = PictureModel::learn(&pictures, lesson.clone(), &config, |n| {
            n_epochs = n;
            true
        })?;
        Ok((model, n_epochs))
    };
    let (of_all, mut n_epochs) = if args.out.is_some() || args.drawn_only {
        let _progress = Progress::endless("training on all pictures");
        let (model, n_epochs) = learn(None)?;
        (Some(model), n_epochs)
    } else {
        (None, 0)
    };
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let judged: Vec<usize> = shard.indices(if args.unjudged { 0 } else { known.len() }).collect();
    let kept = KeptPredictions::new(args.state.as_deref(), (&lesson, &config), &drawn, &known);
    let predict = |index: usize| -> anyhow::Result<LeftOutPrediction> {
        let estimates = |model: &PictureModel| predict_texture(model, &known[index]);
        if let Some(model) = of_all.as_ref().filter(|_| args.drawn_only) {
            return Ok(LeftOutPrediction { estimates: estimates(model)?, n_epochs: 0 });
        }
        if let Some(prediction) = kept.read(index) {
            return Ok(prediction);
        }
        let (model, n_epochs) = learn(Some(index))?;
        let prediction = LeftOutPrediction { estimates: estimates(&model)?, n_epochs };
        kept.write(index, &prediction)?;
        Ok(prediction)
    };
    let progress = Progress::new("training without each texture", judged.len());
    let (mut predicted, mut deviations) =
        (Vec::with_capacity(judged.len()), Vec::with_capacity(judged.len()));
    for index in judged {
        let prediction = predict(index)?;
        n_epochs += prediction.n_epochs;
        predicted.push(prediction.estimates.iter().map(|of| of.mean).collect());
        deviations.push(prediction.estimates.iter().map(|of| of.deviation).collect());
        progress.step();
    }
    progress.finish();
    Ok(Taught { judged: MethodPredictions { name, predicted }, deviations, of_all, n_epochs })
}

/// Returns the metadata and the settings of a training of heads.
fn lesson(args: &Args, eyes: FeatureExtractor, learned_from: &str) -> (TrainingMetadata, PictureConfig) {
    let attributes = USUAL_AXES.map(str::to_owned).to_vec();
    let lesson = TrainingMetadata { eyes, attributes, learned_from: learned_from.to_owned() };
    let config =
        PictureConfig::paper(args.epochs as usize, args.patience as usize, args.heads as usize, args.seed);
    (lesson, config)
}

/// Returns the features of the drawn pictures.
fn drawn_of(args: &Args, backbone: Option<&Backbone>) -> anyhow::Result<Vec<Seen>> {
    let kept = args.state.as_ref().map(|folder| folder.join(format!("drawn-{}.safetensors", args.seed)));
    drawn_pictures(args.drawn as usize, args.seed, backbone, &starter_anchors()?.1, kept.as_deref())
}

fn described(drawn: &[Seen]) -> String {
    format!("pictures of {}", counted(drawn.len(), "drawn material"))
}

/// Trains on the labelled photos of a table, and on drawn pictures unless the heads for these are given.
fn train_on_photos(args: &Args, table: &Path, backbone: Option<&Backbone>) -> anyhow::Result<()> {
    let photos = PhotoFiles::read(table, backbone, args.seed, args.labelled.n_variations())?;
    let training = Training {
        eyes: FeatureExtractor::of(backbone),
        state: args.state.as_deref(),
        out: args.out.as_deref(),
        figures: &args.figures,
        seed: args.seed,
        is_json: args.json,
    };
    args.labelled.train(&photos, &training, || {
        let drawn = drawn_of(args, backbone)?;
        let (lesson, config) = lesson(args, training.eyes.clone(), &described(&drawn));
        let pictures: Vec<Seen> = drawn.iter().map(|seen| seen_by(&training.eyes, seen)).collect();
        let _progress = Progress::endless("training on drawn materials");
        Ok(PictureModel::learn(&pictures.iter().collect::<Vec<_>>(), lesson, &config, |_| true)?)
    })
}
