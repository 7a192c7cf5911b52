//! `shagreen batch`: renders the textures of a manifest to files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::actuator::Actuator;
use shagreen_core::maths::shard::Shard;
use shagreen_core::units::Contact;
use shagreen_core::words::counted;
use shagreen_formats::batch_manifest::{
    BatchChoice, BatchManifest, BatchMotion, BatchSource, batch_manifest_with_problems, batch_problems,
};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, Provenance};
use shagreen_formats::project::sha256_hex;
use shagreen_studio::batch::{
    BatchOptions, BatchOutcome, BatchProject, BatchSources, JobOutcome, LoadedStroke, add_problem, plan,
};
use shagreen_studio::file::{self, file_name, folder_of, one_line};
use shagreen_studio::library;
use shagreen_studio::parallel::n_processors;
use shagreen_studio::project::{load_project, textures_by_id, textures_on_axes};

use crate::cli::actuator_source::load_actuator;
use crate::cli::out_name::refuse_dash;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;
use crate::cli::progress::Progress;
use crate::cli::stroke;
use crate::cli::stroke_args::StrokeArgs;

/// Renders textures along strokes to files of any export format, in parallel. A manifest (TOML) lists the textures, the strokes and
/// the formats; the guide page "batch" describes it.
///
/// A run that was interrupted goes on where it stopped, and a run after a change makes only the files that depend on it. The
/// files do not depend on the number of threads, nor on --shard.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Manifest of the batch. Paths in it are relative to its folder.
    #[arg(value_name = "MANIFEST.toml")]
    manifest: PathBuf,
    /// Folder of the files: a new or empty one, or that of an earlier run.
    #[arg(short, long, value_name = "FOLDER")]
    out: PathBuf,
    /// Number of textures that are rendered at the same time. Default: the number of processors.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Part of the textures to render, such as 2/4, to divide a batch among computers. All parts may have the same folder.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE, hide_default_value = true)]
    shard: Shard,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_dash(&args.out)?;
    let bytes = file::read_file(&args.manifest, FileKind::Table)?;
    let (manifest, mut problems) =
        batch_manifest_with_problems(&bytes).with_context(|| file::in_file(&args.manifest))?;
    let folder = folder_of(&args.manifest);
    let (library, project) = known_textures(&manifest, &folder, &mut problems);
    let strokes = strokes(&manifest, &folder, &mut problems);
    let actuators = actuators(&manifest, &folder, &mut problems);
    let sources = BatchSources { library, project, strokes, actuators };
    let plan = plan(manifest, sources, (problems, output::CREATED_BY), &Printed)
        .map_err(|problems| batch_problems(&String::from_utf8_lossy(&bytes), problems))
        .with_context(|| file::in_file(&args.manifest))?;
    let apart = plan.scaled_apart();
    if !apart.is_empty() {
        output::note(&format!(
            "each signal of {} has a scale of its own, so that weaker textures are as strong as others; state full_scale_mps2 to keep differences in level",
            apart.join(", ")
        ));
    }
    let n_jobs = plan.n_jobs(args.shard);
    let progress = Progress::of_hours("rendering the batch", n_jobs);
    let options = BatchOptions {
        folder: &args.out,
        n_threads: args.jobs.map_or_else(n_processors, usize::from),
        shard: args.shard,
        created_by: output::CREATED_BY,
    };
    let outcome = plan.run(&options, &|| {
        progress.step();
        true
    })?;
    progress.finish();
    let warnings = warnings(&outcome);
    for warning in &warnings {
        output::warn(warning);
    }
    print(args, &outcome, &warnings);
    match outcome.failed().count() {
        0 => Ok(()),
        n => bail!(
            "{n} of {} failed; the others are done. Correct what the list above says and run the command again",
            counted(outcome.n_jobs, "job")
        ),
    }
}

/// As [`textures`]. If they cannot be read, that is a problem, and there are none.
fn known_textures(
    manifest: &BatchManifest,
    folder: &Path,
    problems: &mut Vec<(String, String)>,
) -> (Library, Option<BatchProject>) {
    // Nobody knows which textures are meant.
    if problems.iter().any(|(key, _)| BatchSource::KEYS.contains(&key.as_str())) {
        return (Library::default(), None);
    }
    textures(manifest, folder).unwrap_or_else(|error| {
        add_problem(problems, manifest.source.key().to_owned(), one_line(&error));
        (Library::default(), None)
    })
}

/// The library of a manifest, and the project if it names one.
fn textures(manifest: &BatchManifest, folder: &Path) -> anyhow::Result<(Library, Option<BatchProject>)> {
    match &manifest.source {
        BatchSource::Library(name) => {
            let path = folder.join(name);
            let library = match BuiltIn::from_id(name).filter(|_| !path.exists()) {
                Some(built_in) => built_in.read()?,
                None => library::load(Some(&path), &Printed)?,
            };
            Ok((library, None))
        }
        BatchSource::Project(name) => {
            let project = load_project(&folder.join(name), &permitted_libraries(), &Printed)?;
            let needs_space = manifest
                .textures
                .iter()
                .any(|texture| !matches!(texture.choice, BatchChoice::All | BatchChoice::Ids(_)));
            let placed =
                if needs_space { textures_on_axes(&project)? } else { textures_by_id(&project, &Printed)? };
            let library = project.with_places_of(&placed, |_| false);
            Ok((library, Some(BatchProject { project, placed })))
        }
    }
}

/// The strokes of a manifest, in its order. A stroke that cannot be read is a problem.
fn strokes(
    manifest: &BatchManifest,
    folder: &Path,
    problems: &mut Vec<(String, String)>,
) -> Vec<LoadedStroke> {
    let mut strokes = Vec::new();
    for (index, stroke) in manifest.strokes.iter().enumerate() {
        match loaded(&stroke.motion, folder) {
            Ok(stroke) => strokes.push(stroke),
            Err(error) => {
                add_problem(problems, format!("stroke[{}].file", index + 1), one_line(&error));
                // In its place, so that other problems are found too.
                let contact = Contact::from_mm_per_s_and_n(0.0, 0.0);
                strokes.push(LoadedStroke::Steady { contact, seconds: 0.0 });
            }
        }
    }
    strokes
}

fn loaded(motion: &BatchMotion, folder: &Path) -> anyhow::Result<LoadedStroke> {
    match motion {
        BatchMotion::Steady { speed_mm_per_s, force_n, seconds } => Ok(LoadedStroke::Steady {
            contact: Contact::from_mm_per_s_and_n(*speed_mm_per_s, *force_n),
            seconds: *seconds,
        }),
        BatchMotion::File(name) => {
            let path = folder.join(name);
            let bytes = file::read_file(&path, FileKind::Table)?;
            let contacts = stroke::of_bytes(&bytes, &path, &StrokeArgs::default())?;
            Ok(LoadedStroke::Recorded { contacts, file_name: file_name(&path), sha256: sha256_hex(&bytes) })
        }
    }
}

/// The actuator of each output of a manifest. One that does not exist is a problem.
fn actuators(
    manifest: &BatchManifest,
    folder: &Path,
    problems: &mut Vec<(String, String)>,
) -> Vec<Option<Actuator>> {
    let mut actuators = Vec::new();
    for (index, output) in manifest.outputs.iter().enumerate() {
        let actuator = output.actuator.as_ref().map(|name| {
            let path = folder.join(name);
            let name = if path.is_file() { path.display().to_string() } else { name.clone() };
            load_actuator(&name, None)
        });
        match actuator.transpose() {
            Ok(actuator) => actuators.push(actuator),
            Err(error) => {
                add_problem(problems, format!("output[{}].actuator", index + 1), one_line(&error));
                actuators.push(None);
            }
        }
    }
    actuators
}

/// Warnings of all jobs, each once with the number of its jobs, and the warning about textures that must not be redistributed.
fn warnings(outcome: &BatchOutcome) -> Vec<String> {
    let records = || outcome.jobs.iter().filter_map(|job| job.record.as_ref());
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for warning in records().flat_map(|record| &record.warnings) {
        *counts.entry(warning).or_default() += 1;
    }
    let counted = |(warning, n): (&str, usize)| {
        if n == 1 { warning.to_owned() } else { format!("{warning} ({})", counted(n, "job")) }
    };
    let mut warnings: Vec<String> = counts.into_iter().map(counted).collect();
    let restricted: BTreeSet<&str> =
        records().flat_map(|record| record.restricted.iter().map(String::as_str)).collect();
    warnings.extend(Provenance::warning(&restricted.into_iter().collect::<Vec<_>>()));
    warnings
}

fn print(args: &Args, outcome: &BatchOutcome, warnings: &[String]) {
    let failed: Vec<Value> =
        outcome.failed().map(|(job, reason)| json!({"job": job, "reason": reason})).collect();
    let job = |job: &JobOutcome| {
        let record = job.record.as_ref()?;
        let files: Vec<&str> = record.files.iter().map(|file| file.path.as_str()).collect();
        Some(json!({"job": job.name, "files": files, "lost": record.lost, "licence": record.licence}))
    };
    let jobs: Vec<Value> = outcome.jobs.iter().filter_map(job).collect();
    let result = json!({
        "out": args.out.display().to_string(),
        "shard": args.shard.to_string(),
        "jobs": outcome.n_jobs,
        "written": outcome.n_written(),
        "kept": outcome.n_kept(),
        "failed": failed,
        "warnings": warnings,
        "done": jobs,
    });
    output::print(args.json, &result, || {
        let failed: Vec<String> =
            outcome.failed().map(|(job, reason)| format!("failed: {job}: {reason}\n")).collect();
        let failed = failed.concat();
        format!(
            "{failed}{} written, {} done before, of {}: {}",
            outcome.n_written(),
            outcome.n_kept(),
            counted(outcome.n_jobs, "job"),
            args.out.display()
        )
    });
}
