//! Training of the networks of `shagreen train attributes`: once without each texture, saved after every epoch,
//! resumable.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::{Context as _, ensure};
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::recording::fit::Stroke;
use shagreen_core::texture::patterns::{
    PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns, render_patterns,
};
use shagreen_formats::atomic;
use shagreen_formats::attribute_table::AttributeTable;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::{Library, free_id, id_from_name};
use shagreen_learn::cnn_lstm::{Architecture, Streams};
use shagreen_learn::model_file::is_model;
use shagreen_learn::stroke_model::ModelCard;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

use crate::cli::method_predictions::MethodPredictions;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::words::words;
use shagreen_studio::file;
use shagreen_studio::parallel::{in_parallel_by, n_processors};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Network that can be trained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Network {
    Paper320,
    Literal,
    Convolutions,
    Memory,
}

impl Network {
    const ALL: [Self; 4] = [Self::Paper320, Self::Literal, Self::Convolutions, Self::Memory];

    fn id(self) -> &'static str {
        match self {
            Self::Paper320 => "paper320",
            Self::Literal => "literal",
            Self::Convolutions => "convolutions",
            Self::Memory => "memory",
        }
    }

    fn architecture(self, n_outputs: usize) -> Architecture {
        let paper = Architecture::paper320(n_outputs);
        match self {
            Self::Paper320 => paper,
            Self::Literal => Architecture::literal(n_outputs),
            Self::Convolutions => Architecture { streams: Streams::Convolutions, ..paper },
            Self::Memory => Architecture { streams: Streams::Memory, ..paper },
        }
    }
}

#[derive(clap::Args)]
pub(crate) struct NetworkArgs {
    /// Network to train in addition: paper320, with the 320 convolutional features that the text of the paper states;
    /// literal, with the pooling layers as printed in the paper; convolutions or memory, only the convolutional or the
    /// LSTM part of paper320. Can be given several times.
    #[arg(long = "network", value_name = "NETWORK", value_parser = words(Network::ALL, Network::id))]
    networks: Vec<Network>,
    /// Largest number of epochs.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    epochs: u32,
    /// Number of epochs without a lower error on the validation textures after which training stops; 0 never stops
    /// early and uses no validation textures.
    #[arg(long, default_value_t = 10)]
    patience: u32,
    /// Fraction of each training stroke of 1 s that is used, 0.2 to 1; a small fraction gives a quick test.
    #[arg(long, default_value_t = 1.0, value_parser = share)]
    share: f64,
    /// Random seed of the training and of drawn materials.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of networks trained in parallel, each with about 0.5 GB of memory. Default: the number of processors.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// File to write: a network of the first --network kind, trained on all textures.
    #[arg(long, short, value_name = "MODEL")]
    out: Option<PathBuf>,
}

impl NetworkArgs {
    /// Returns the random seed.
    pub(crate) fn seed(&self) -> u64 {
        self.seed
    }

    fn n_jobs(&self) -> usize {
        self.jobs.map_or_else(n_processors, usize::from)
    }
}

fn share(text: &str) -> Result<f64, String> {
    let share = text.parse::<f64>().ok().filter(|share| (0.2..=1.0).contains(share)); // Other values are rejected below.
    share.ok_or_else(|| "it must be a number from 0.2 to 1".to_owned())
}

/// Results of the networks.
pub(crate) struct Trained {
    pub(crate) judged: Vec<MethodPredictions>,
    /// Number of epochs of all networks together.
    pub(crate) epochs: usize,
}

/// Checks before hours of training that the trained network can be written.
pub(crate) fn check_out(args: &NetworkArgs, library: Option<&Path>) -> anyhow::Result<()> {
    let Some(out) = &args.out else { return Ok(()) };
    ensure!(!args.networks.is_empty(), "--out needs a network to train; choose one with --network");
    refuse_inputs(&[out], &[library])?;
    refuse_foreign(out, "a model", is_model)?;
    Ok(atomic::check_all(&[out])?)
}

/// Trains each requested network once without each texture, several in parallel.
pub(crate) fn train_networks(
    args: &NetworkArgs,
    state: Option<&Path>,
    library: &Library,
    table: &AttributeTable,
) -> anyhow::Result<Trained> {
    let mut trained = Trained { judged: Vec::new(), epochs: 0 };
    if args.networks.is_empty() {
        return Ok(trained);
    }
    if let Some(folder) = state {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    let rendering = Progress::endless("rendering the training strokes");
    let textures = strokes(args, library, table)?;
    rendering.finish();
    let config = |network: Network| {
        TrainingConfig::paper(
            network.architecture(table.names.len()),
            args.epochs as usize,
            (args.patience > 0).then_some(args.patience as usize),
            args.seed,
        )
    };
    for network in &args.networks {
        let progress =
            Progress::of_hours("training the network", textures.len() * in_thousandths(args.epochs));
        let failed = AtomicBool::new(false);
        let of = in_parallel_by(args.n_jobs(), textures.len(), |index| {
            let mut others: Vec<&StrokedTexture> = textures.iter().collect();
            let left_out = others.remove(index);
            let kept = state
                .map(|folder| folder.join(format!("{}-without-{}.safetensors", network.id(), left_out.id)));
            let what =
                format!("{} without {} ({} of {})", network.id(), left_out.id, index + 1, textures.len());
            let without = || {
                let training = train(&others, config(*network), kept.as_deref(), &what, &progress, &failed)?;
                let Some(training) = training else { return Ok(None) };
                let n_epochs = training.epochs().len();
                let of = training.finish()?.predict(&left_out.strokes)?;
                anyhow::Ok(Some((n_epochs, of.context("the strokes are shorter than the input segment of the network; give a larger --share")?)))
            };
            // Stops the other trainings, which would take hours.
            without().inspect_err(|_| failed.store(true, Ordering::Relaxed))
        });
        progress.finish();
        let of = of.into_iter().collect::<anyhow::Result<Vec<Option<(usize, Vec<f64>)>>>>()?;
        trained.epochs += of.iter().flatten().map(|(n_epochs, _)| n_epochs).sum::<usize>();
        let predicted = of.into_iter().flatten().map(|(_, predicted)| predicted).collect();
        trained.judged.push(MethodPredictions { name: format!("network {}", network.id()), predicted });
    }
    let rmse_of_first = trained.judged.first().map(|judged| judged.rmse(&table.values)).unwrap_or_default();
    if let (Some(out), Some(network)) = (&args.out, args.networks.first()) {
        let kept = state.map(|folder| folder.join(format!("{}-of-all.safetensors", network.id())));
        let all: Vec<&StrokedTexture> = textures.iter().collect();
        let progress = Progress::of_hours("training the network", in_thousandths(args.epochs));
        let what = format!("{} of all", network.id());
        let never = AtomicBool::new(false);
        let training = train(&all, config(*network), kept.as_deref(), &what, &progress, &never)?;
        progress.finish();
        let Some(training) = training else { unreachable!("no other training can fail") };
        let model = training.finish()?;
        let card = ModelCard {
            attributes: table.names.clone(),
            left_out_rmse: rmse_of_first,
            network: network.id().to_owned(),
            learned_from: table.of_library(&library.name),
            label_sources: table.source_ids().map(str::to_owned).collect(),
        };
        atomic::write(out, &model.to_bytes(&card)?)?;
    }
    Ok(trained)
}

/// Returns the number of steps of a progress bar for this number of epochs.
fn in_thousandths(n_epochs: u32) -> usize {
    1000 * n_epochs as usize
}

/// Trains to the end, from the saved state if there is one; `None` if another training has failed.
fn train(
    textures: &[&StrokedTexture],
    config: TrainingConfig,
    kept: Option<&Path>,
    what: &str,
    progress: &Progress,
    failed: &AtomicBool,
) -> anyhow::Result<Option<Training>> {
    let n_epochs = config.n_epochs;
    let mut training = match kept.filter(|path| path.exists()) {
        Some(path) => Training::resume(textures, config, &file::read_file(path, FileKind::Network)?)
            .with_context(|| file::in_file(path))?,
        None => Training::new(textures, config)?,
    };
    let mut done = 1000 * training.epochs().len().min(n_epochs);
    progress.leave_out(done);
    while !training.is_over() {
        let started = Instant::now();
        let before = done;
        let epoch = training.run_epoch(|share| {
            let now = before + (1000.0 * share) as usize;
            progress.steps(now - done);
            done = now;
            !failed.load(Ordering::Relaxed)
        })?;
        let Some(epoch) = epoch else { return Ok(None) };
        progress.steps(before + 1000 - done);
        done = before + 1000;
        let aside = epoch.aside_rmse.map_or(String::new(), |rmse| format!(", validation RMSE {rmse:.2}"));
        output::note(&format!(
            "{what}: epoch {} of {n_epochs}, {:.0} s, training RMSE {:.2}{aside}",
            epoch.number,
            started.elapsed().as_secs_f64(),
            epoch.learned_rmse
        ));
        if let Some(path) = kept {
            atomic::write(path, &training.keep()?)?;
        }
    }
    // Epochs that an early stop skips.
    progress.leave_out((1000 * n_epochs).saturating_sub(done));
    Ok(Some(training))
}

/// Returns the 25 strokes of the paper on each texture, each texture with its own noise.
fn strokes(
    args: &NetworkArgs,
    library: &Library,
    table: &AttributeTable,
) -> anyhow::Result<Vec<StrokedTexture>> {
    let contacts = paper_patterns();
    let mut ids: Vec<String> = Vec::new();
    let of = |(index, attributes): (&usize, &Vec<f64>)| {
        let texture = &library.textures[*index];
        let plan = PatternPlan {
            contacts: &contacts,
            seconds: PAPER_SECS * args.share,
            rate: PAPER_RATE,
            seed: derive_seed(args.seed, &texture.id),
        };
        let patterns =
            render_patterns(&texture.model, &plan).with_context(|| format!("texture \"{}\"", texture.id))?;
        for warning in &patterns.warnings {
            output::warn(&format!("{}: {warning}", texture.id));
        }
        let strokes = patterns.signals.into_iter().zip(&contacts).map(|(accel_mps2, contact)| Stroke {
            speed_mps: vec![contact.speed.0; accel_mps2.len()],
            force_n: vec![contact.force.0; accel_mps2.len()],
            accel_mps2,
        });
        // The state of each texture is saved in a file of this name.
        let id = free_id(&id_from_name(&texture.id), |id| ids.iter().any(|taken| taken == id));
        ids.push(id.clone());
        Ok(StrokedTexture { id, strokes: strokes.collect(), attributes: attributes.clone() })
    };
    table.textures.iter().zip(&table.values).map(of).collect()
}
