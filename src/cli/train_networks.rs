//! Training of the networks of `shagreen train attributes`: once without each texture, saved after every epoch,
//! resumable.

mod network_kind;
mod run;
mod time_budget;
mod trained;
mod training_strokes;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::{Context as _, bail, ensure};
use shagreen_core::maths::shard::Shard;
use shagreen_formats::atomic;
use shagreen_formats::attribute_table::AttributeTable;
use shagreen_formats::library::Library;
use shagreen_learn::model_card::{GaussianProcessComparison, ModelCard, StrokeOrigin, TrainingExtent};
use shagreen_learn::model_file::is_model;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

use crate::cli::method_predictions::MethodPredictions;
use crate::cli::progress::Progress;
use crate::cli::train_networks::network_kind::{Axes, Network, name_of};
use crate::cli::train_networks::run::{Run, train};
use crate::cli::train_networks::time_budget::{TimeBudget, n_rounds};
use crate::cli::train_networks::trained::{Trained, TrainedKind};
use crate::cli::train_networks::training_strokes::{RecordingTableArgs, ranges, recorded, rendered};
use crate::cli::words::words;
use shagreen_studio::file;
use shagreen_studio::parallel::{in_parallel_by, n_processors};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

#[derive(clap::Args)]
pub(crate) struct NetworkArgs {
    /// Network to train in addition: paper320, with the 320 convolutional features that the text of the paper states;
    /// literal, with the pooling layers as printed in the paper; convolutions (or 1d-cnn) and memory (or lstm), only the
    /// convolutional or the LSTM part of paper320; serial, the convolutions of literal followed by the LSTM layers. The
    /// last three are the 1D-CNN, the LSTM and the CNN-LSTM to which the paper compares its network in Table 3; it states
    /// no sizes for them. Can be given several times.
    #[arg(long = "network", value_name = "NETWORK", value_parser = Network::parser())]
    networks: Vec<Network>,
    /// Acceleration that the networks read: combined, one signal from all axes of the sensor (DFT321); three, the three
    /// axes of recordings. Texture models hold the combined signal only, so three needs --recordings.
    #[arg(long, value_parser = words(Axes::ALL, Axes::id), default_value = "combined")]
    axes: Axes,
    #[command(flatten)]
    table: RecordingTableArgs,
    /// Largest number of epochs.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    epochs: u32,
    /// Time budget in minutes, divided evenly among all networks. A network keeps what it has learned when its time is
    /// over, also within an epoch. The result then depends on the speed of the machine.
    #[arg(long, value_name = "N", value_parser = minutes)]
    minutes: Option<f64>,
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
    /// Train only the networks that leave out a part of the textures, such as 2/4, and keep them in the folder --state, to divide
    /// the work among computers. Once all parts are trained, the command without --shard, on a folder with all files of these
    /// folders, evaluates them without training again.
    #[arg(
        long,
        value_name = "I/N",
        requires_all = ["state", "networks"],
        conflicts_with_all = ["out", "minutes", "figures", "drawn"]
    )]
    shard: Option<Shard>,
}

impl NetworkArgs {
    /// Returns the random seed.
    pub(crate) fn seed(&self) -> u64 {
        self.seed
    }

    /// Returns the part of the textures to train for.
    pub(crate) fn shard(&self) -> Option<Shard> {
        self.shard
    }

    fn n_jobs(&self) -> usize {
        self.jobs.map_or_else(n_processors, usize::from)
    }
}

fn share(text: &str) -> Result<f64, String> {
    let share = text.parse::<f64>().ok().filter(|share| (0.2..=1.0).contains(share)); // Other values are rejected below.
    share.ok_or_else(|| "it must be a number from 0.2 to 1".to_owned())
}

/// Longest time budget in minutes, about ten weeks.
const MAX_MINUTES: f64 = 1e5;

fn minutes(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(minutes) if minutes > 0.0 && minutes <= MAX_MINUTES => Ok(minutes),
        _ => Err(format!("it must be a number above 0, at most {MAX_MINUTES}")),
    }
}

/// Checks, before hours of training, that the arguments fit each other and that the trained network can be written.
pub(crate) fn check_arguments(args: &NetworkArgs, library: Option<&Path>) -> anyhow::Result<()> {
    let recordings = args.table.path();
    let of_networks = [
        ("--out", args.out.is_some()),
        ("--recordings", recordings.is_some()),
        ("--axes three", args.axes == Axes::Three),
        ("--minutes", args.minutes.is_some()),
    ];
    let given = of_networks.iter().find(|(_, is_given)| *is_given);
    if let (Some((option, _)), true) = (given, args.networks.is_empty()) {
        bail!("{option} needs a network to train; choose one with --network");
    }
    ensure!(
        args.axes == Axes::Combined || recordings.is_some(),
        "--axes three needs recordings with three axes: the texture models of a library hold one acceleration, combined by DFT321, from which the axes cannot be computed; give a table of recordings with --recordings, or leave --axes out"
    );
    let Some(out) = &args.out else { return Ok(()) };
    refuse_inputs(&[out], &[library, recordings])?;
    refuse_foreign(out, "a model", is_model)?;
    Ok(atomic::check_all(&[out])?)
}

/// What all networks are trained with.
struct Course<'a> {
    args: &'a NetworkArgs,
    /// Folder of the saved states.
    state: Option<&'a Path>,
    textures: &'a [StrokedTexture],
    n_attributes: usize,
    budget: Option<TimeBudget>,
}

/// Trains each requested network once without each texture, several in parallel, and writes the network that is trained
/// on all textures. `gaussian_process` holds the predictions of the Gaussian process for the same textures.
pub(crate) fn train_networks(
    args: &NetworkArgs,
    state: Option<&Path>,
    library: &Library,
    table: &AttributeTable,
    gaussian_process: &MethodPredictions,
) -> anyhow::Result<Trained> {
    let mut trained = Trained {
        judged: Vec::new(),
        kinds: Vec::new(),
        most_epochs: args.epochs as usize,
        minutes: args.minutes,
    };
    let Some(first) = args.networks.first() else { return Ok(trained) };
    let budget = args.minutes.map(|minutes| TimeBudget::starting(Instant::now(), minutes));
    let textures = prepared_textures(args, (*first, state), library, table)?;
    let course = Course { args, state, textures: &textures, n_attributes: table.names.len(), budget };
    let rounds_of_all = usize::from(args.out.is_some());
    for (kind_idx, network) in args.networks.iter().enumerate() {
        let name = name_of(*network, args.axes);
        let n_kinds_after = args.networks.len() - 1 - kind_idx;
        let rounds_after = n_kinds_after * course.n_rounds() + rounds_of_all;
        let (epochs, predicted) = course.leave_each_out(*network, rounds_after)?;
        let judged = MethodPredictions { name: format!("network {name}"), predicted };
        let comparison =
            GaussianProcessComparison::new(judged.mae(&table.values), gaussian_process.mae(&table.values));
        trained.judged.push(judged);
        trained.kinds.push(TrainedKind { name, method: network.method(), epochs, comparison });
    }
    if let Some(out) = &args.out {
        let training = course.train_on_all(*first)?;
        let card = ModelCard {
            attributes: table.names.clone(),
            left_out_rmse: trained.judged.first().map(|of| of.rmse(&table.values)).unwrap_or_default(),
            network: name_of(*first, args.axes),
            learned_from: table.of_library(&library.name),
            label_sources: table.source_ids().map(str::to_owned).collect(),
            gaussian_process: trained.kinds.first().map(|kind| kind.comparison.clone()),
            extent: Some(extent_of(args, &textures, &trained, training.n_epochs())),
        };
        atomic::write(out, &training.finish()?.to_bytes(&card)?)?;
    }
    Ok(trained)
}

/// Trains the requested networks without each texture of a part, and keeps them in the folder `state`. Returns the identifiers of
/// these textures.
pub(crate) fn train_part(
    args: &NetworkArgs,
    state: &Path,
    library: &Library,
    table: &AttributeTable,
    shard: Shard,
) -> anyhow::Result<Vec<String>> {
    let Some(first) = args.networks.first() else { return Ok(Vec::new()) };
    let textures = prepared_textures(args, (*first, Some(state)), library, table)?;
    let n_attributes = table.names.len();
    let course = Course { args, state: Some(state), textures: &textures, n_attributes, budget: None };
    for network in &args.networks {
        course.train_some(*network, shard)?;
    }
    Ok(shard.indices(textures.len()).map(|index| textures[index].id.clone()).collect())
}

/// Creates the folder of the saved states, and returns the strokes to train on.
fn prepared_textures(
    args: &NetworkArgs,
    (first, state): (Network, Option<&Path>),
    library: &Library,
    table: &AttributeTable,
) -> anyhow::Result<Vec<StrokedTexture>> {
    if let Some(folder) = state {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    let preparing = Progress::endless("preparing the training strokes");
    let textures = match args.table.path() {
        Some(path) => {
            let n_samples = first.architecture(args.axes, table.names.len()).n_samples;
            recorded(&args.table, path, (library, table), args.axes, n_samples)?
        }
        None => rendered(library, table, args.share, args.seed)?,
    };
    preparing.finish();
    Ok(textures)
}

impl Course<'_> {
    /// Number of rounds in which the networks of one kind are trained, several at a time.
    fn n_rounds(&self) -> usize {
        n_rounds(self.textures.len(), self.args.n_jobs())
    }

    /// Trains a network once without each texture. Returns the epochs of each, and its prediction of the texture.
    /// `rounds_after` is the number of rounds of networks that are trained afterwards.
    fn leave_each_out(
        &self,
        network: Network,
        rounds_after: usize,
    ) -> anyhow::Result<(Vec<f64>, Vec<Vec<f64>>)> {
        let (textures, n_jobs) = (self.textures, self.args.n_jobs());
        let progress = self.progress(textures.len());
        let failed = AtomicBool::new(false);
        let of = in_parallel_by(n_jobs, textures.len(), |index| {
            let until = self.until(self.n_rounds() - index / n_jobs + rounds_after);
            let without = || {
                let Some(training) = self.without(network, index, (until, &progress, &failed))? else {
                    return Ok(None);
                };
                let n_epochs = training.n_epochs();
                let of = training.finish()?.predict(&textures[index].strokes)?;
                anyhow::Ok(Some((n_epochs, of.context("the strokes are shorter than the input segment of the network; give a larger --share")?)))
            };
            // Stops the other trainings, which would take hours.
            without().inspect_err(|_| failed.store(true, Ordering::Relaxed))
        });
        progress.finish();
        let of = of.into_iter().collect::<anyhow::Result<Vec<Option<(f64, Vec<f64>)>>>>()?;
        Ok(of.into_iter().flatten().unzip())
    }

    /// Trains a network once without each texture of a part, and keeps it.
    fn train_some(&self, network: Network, shard: Shard) -> anyhow::Result<()> {
        let indices: Vec<usize> = shard.indices(self.textures.len()).collect();
        let progress = self.progress(indices.len());
        let failed = AtomicBool::new(false);
        let done = in_parallel_by(self.args.n_jobs(), indices.len(), |turn| {
            let trained = self.without(network, indices[turn], (None, &progress, &failed));
            trained.map(drop).inspect_err(|_| failed.store(true, Ordering::Relaxed))
        });
        progress.finish();
        done.into_iter().collect()
    }

    /// Trains a network without one texture, to the end or until its time is over; `None` if another training has failed.
    fn without(
        &self,
        network: Network,
        index: usize,
        (until, progress, failed): (Option<Instant>, &Progress, &AtomicBool),
    ) -> anyhow::Result<Option<Training>> {
        let name = name_of(network, self.args.axes);
        let mut others: Vec<&StrokedTexture> = self.textures.iter().collect();
        let left_out = others.remove(index);
        let run = Run {
            kept: self.kept(&format!("{name}-without-{}", left_out.id)),
            what: format!("{name} without {} ({} of {})", left_out.id, index + 1, self.textures.len()),
            until,
            progress,
            failed,
        };
        train(&others, self.config(network), &run)
    }

    fn train_on_all(&self, network: Network) -> anyhow::Result<Training> {
        let name = name_of(network, self.args.axes);
        let progress = self.progress(1);
        let run = Run {
            kept: self.kept(&format!("{name}-of-all")),
            what: format!("{name} of all"),
            until: self.until(1),
            progress: &progress,
            failed: &AtomicBool::new(false),
        };
        let all: Vec<&StrokedTexture> = self.textures.iter().collect();
        let training = train(&all, self.config(network), &run)?;
        progress.finish();
        let Some(training) = training else { unreachable!("no other training can fail") };
        Ok(training)
    }

    fn config(&self, network: Network) -> TrainingConfig {
        let NetworkArgs { axes, epochs, patience, seed, .. } = *self.args;
        TrainingConfig::paper(
            network.architecture(axes, self.n_attributes),
            epochs as usize,
            (patience > 0).then_some(patience as usize),
            seed,
        )
    }

    fn kept(&self, name: &str) -> Option<PathBuf> {
        self.state.map(|folder| folder.join(format!("{name}.safetensors")))
    }

    fn until(&self, n_rounds: usize) -> Option<Instant> {
        self.budget.map(|budget| budget.deadline(Instant::now(), n_rounds))
    }

    /// Returns the progress of `n` networks. With a time budget, the number of epochs to do is unknown.
    fn progress(&self, n: usize) -> Progress {
        let task = "training the network";
        match self.budget {
            Some(_) => Progress::endless(task),
            None => Progress::of_hours(task, n * 1000 * self.args.epochs as usize),
        }
    }
}

/// Returns how the network that is written was trained: for `epochs`, and its leave-one-out errors as the first kind.
fn extent_of(
    args: &NetworkArgs,
    textures: &[StrokedTexture],
    trained: &Trained,
    epochs: f64,
) -> TrainingExtent {
    let (speed_mm_per_s, force_n) = ranges(textures);
    let is_recorded = args.table.path().is_some();
    TrainingExtent {
        most_epochs: trained.most_epochs,
        epochs,
        left_out_epochs: trained.kinds.first().map(|kind| kind.epochs.clone()).unwrap_or_default(),
        minutes: trained.minutes,
        strokes: if is_recorded { StrokeOrigin::Recorded } else { StrokeOrigin::Rendered },
        speed_mm_per_s,
        force_n,
    }
}
