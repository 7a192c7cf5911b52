//! The jobs of one texture: rendered, written, and recorded.

mod signals;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::space::authoring::Blending;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::batch_record::{BatchRecordV1, FORMAT, RecordedFileV1, VERSION};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::{Library, Provenance};
use shagreen_formats::project::sha256_hex;

use self::signals::{LastSamples, PreparedSound};
use super::folder::RECORDS;
use super::outcome::{BatchOptions, JobOutcome, JobState};
use super::{BatchPlan, OutputFormat, PlannedOutput, Target, TargetChoice};
use crate::export::{ExportContext, FilePart, suffixed_path};
use crate::figure_files::write_together;
use crate::file::one_line;
use crate::project::find_authored;
use crate::report::Warnings;
use crate::sound::Sound;
use crate::sound_entry::{entry_of_sound, terms_of_sound};

/// A job: an output of a texture, along a stroke if the output is a signal.
#[derive(Clone, Copy)]
struct Job {
    output: usize,
    stroke: Option<usize>,
}

/// Name, record and inputs of a job.
struct JobPlace {
    /// Name for people: `wav/cork--slow`.
    name: String,
    /// Path of the first file, from the folder of the batch.
    out: PathBuf,
    /// Path of the record.
    record: PathBuf,
    inputs: String,
}

/// Does the jobs of a texture that are not done yet. `on_job` is called after each of them and returns whether to continue.
pub(super) fn perform(
    plan: &BatchPlan,
    target: &Target,
    options: &BatchOptions<'_>,
    on_job: &(dyn Fn() -> bool + Sync),
) -> Vec<JobOutcome> {
    let of_target = plan.inputs_of_target(target);
    let mut worker = TargetWorker { plan, target, options, made: None, last: None };
    let mut outcomes = Vec::new();
    for job in plan.jobs() {
        let place = plan.place(target, job, &of_target, options);
        let outcome = worker.outcome(job, &place);
        outcomes.push(outcome);
        if !on_job() {
            break;
        }
    }
    outcomes
}

impl BatchPlan {
    /// Jobs of each texture. Outputs of the same stroke and rate follow each other.
    fn jobs(&self) -> Vec<Job> {
        let mut jobs: Vec<Job> = Vec::with_capacity(self.n_jobs_each());
        for (output, PlannedOutput { format, strokes, .. }) in self.outputs.iter().enumerate() {
            match format {
                OutputFormat::Signal(_) => {
                    jobs.extend(strokes.iter().map(|stroke| Job { output, stroke: Some(*stroke) }));
                }
                OutputFormat::Model(_) => jobs.push(Job { output, stroke: None }),
            }
        }
        jobs.sort_by_key(|job| (job.stroke, self.manifest.outputs[job.output].rate_hz, job.output));
        jobs
    }

    fn place(&self, target: &Target, job: Job, of_target: &str, options: &BatchOptions<'_>) -> JobPlace {
        let output = &self.manifest.outputs[job.output];
        let stem = match job.stroke {
            // Two hyphens are in no identifier, so that no two jobs have the same name.
            Some(stroke) => format!("{}--{}", target.stem, self.manifest.strokes[stroke].id),
            None => target.stem.clone(),
        };
        let ending = match self.outputs[job.output].format {
            OutputFormat::Signal(format) => format.ending(),
            OutputFormat::Model(format) => format.ending(),
        };
        JobPlace {
            name: format!("{}/{stem}", output.id),
            out: Path::new(&output.id).join(format!("{stem}.{ending}")),
            record: options.folder.join(RECORDS).join(&output.id).join(format!("{stem}.json")),
            inputs: self.inputs(of_target, (job.output, job.stroke), options.created_by),
        }
    }

    /// The sound of a texture, and the library with its textures.
    fn sound(&self, target: &Target, reporter: &Warnings) -> anyhow::Result<(Cow<'_, Library>, Sound)> {
        let library = &self.sources.library;
        let shape = target.shape.unwrap_or_default();
        let space = |id: &str| {
            self.spaces.get(id).context("the space of the textures is missing; run the batch again")
        };
        match &target.choice {
            TargetChoice::Texture(id) => {
                Ok((Cow::Borrowed(library), Sound::of_texture(library, id, target.blend, &shape)?))
            }
            TargetChoice::Point(point) => {
                let blending = Blending::from(target.blend);
                let space = space(target.blend.id())?;
                let sound = Sound::of_point_in(space, library, *point, (&blending, &shape), reporter)?;
                Ok((Cow::Borrowed(library), sound))
            }
            TargetChoice::Authored(name) => {
                let project =
                    self.sources.project.as_ref().context("the batch has no project; state `project`")?;
                let authored = find_authored(&project.project, name)?;
                let shape: Shape = target.shape.unwrap_or(authored.shape);
                let locked = &authored.blend.locked;
                let own = project.project.with_places_of(&project.placed, |id| locked.contains(id));
                // The common space serves all that use the same positions.
                let sound = if own.positions() == library.positions() {
                    let mode = authored.blend.mode_in_space(own.axis_names().len());
                    Sound::of_authored_in(space(mode.id())?, &own, authored, &shape, reporter)?
                } else {
                    Sound::of_authored(&own, authored, &shape, reporter)?
                };
                Ok((Cow::Owned(own), sound))
            }
        }
    }
}

/// Does the jobs of one texture.
struct TargetWorker<'a> {
    plan: &'a BatchPlan,
    target: &'a Target,
    options: &'a BatchOptions<'a>,
    /// The sound, once a job needs it, or why there is none; with its warnings.
    made: Option<Result<MadeSound<'a>, String>>,
    last: Option<LastSamples>,
}

struct MadeSound<'a> {
    library: Cow<'a, Library>,
    sound: Sound,
    prepared: Option<PreparedSound>,
    warnings: Vec<String>,
}

impl TargetWorker<'_> {
    fn outcome(&mut self, job: Job, place: &JobPlace) -> JobOutcome {
        let name = place.name.clone();
        if let Some(record) = kept(place, self.options.folder) {
            return JobOutcome { name, state: JobState::Kept, record: Some(record) };
        }
        match self.done(job, place) {
            Ok(record) => JobOutcome { name, state: JobState::Written, record: Some(record) },
            Err(error) => JobOutcome { name, state: JobState::Failed(one_line(&error)), record: None },
        }
    }

    /// Makes and writes the files of a job, and then its record.
    fn done(&mut self, job: Job, place: &JobPlace) -> anyhow::Result<BatchRecordV1> {
        self.make()?;
        let reporter = Warnings::default();
        let (parts, lost, ending) = match self.plan.outputs[job.output].format {
            OutputFormat::Signal(format) => {
                let stroke = job.stroke.context("a signal needs a stroke; add one")?;
                let (parts, lost) = self.signal_parts(format, job.output, stroke, &reporter)?;
                (parts, lost, format.ending())
            }
            OutputFormat::Model(format) => {
                let MadeSound { library, sound, .. } = self.made_sound()?;
                let entry = entry_of_sound(library, sound, &self.target.name)?;
                if let Some(reason) = format.refusal(&entry) {
                    bail!(reason);
                }
                let context = ExportContext {
                    created_by: self.options.created_by,
                    actuator: self.plan.sources.actuators[job.output].as_ref(),
                };
                (format.files(&entry, &self.target.stem, &context)?, format.lost(&entry), format.ending())
            }
        };
        let MadeSound { library, sound, warnings, .. } = self.made_sound()?;
        let (licence, provenance) = terms_of_sound(library, sound);
        let is_restricted = provenance == Provenance::Restricted;
        let parents = sound.parents.iter().map(|(texture, _)| &library.textures[*texture]);
        let restricted = parents.filter(|entry| is_restricted && entry.provenance == Provenance::Restricted);
        let mut record = BatchRecordV1 {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            inputs: place.inputs.clone(),
            files: Vec::new(),
            licence,
            restricted: restricted.map(|entry| entry.name.clone()).collect(),
            lost,
            warnings: warnings.iter().cloned().chain(reporter.into_vec()).collect(),
        };
        let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::with_capacity(parts.len() + 1);
        for FilePart { suffix, bytes } in parts {
            let path = suffixed_path(&place.out, ending, suffix);
            record.files.push(RecordedFileV1 {
                path: slashed(&path),
                bytes: bytes.len() as u64,
                sha256: sha256_hex(&bytes),
            });
            files.push((self.options.folder.join(path), bytes));
        }
        // Last, so that a job that was killed halfway has no record.
        files.push((place.record.clone(), record.to_bytes()));
        write_together(&files, None)?;
        Ok(record)
    }

    /// Makes the sound if no earlier job has.
    fn make(&mut self) -> anyhow::Result<()> {
        if self.made.is_none() {
            let reporter = Warnings::default();
            let made = self.plan.sound(self.target, &reporter).map(|(library, sound)| MadeSound {
                library,
                sound,
                prepared: None,
                warnings: reporter.into_vec(),
            });
            self.made = Some(made.map_err(|error| one_line(&error)));
        }
        self.made_sound().map(drop)
    }

    fn made_sound(&self) -> anyhow::Result<&MadeSound<'_>> {
        match &self.made {
            Some(Ok(made)) => Ok(made),
            Some(Err(reason)) => bail!(reason.clone()),
            None => bail!("the texture was not made; run the batch again"),
        }
    }
}

/// The record of a job that need not be done again: its inputs and its files are still the same.
fn kept(place: &JobPlace, folder: &Path) -> Option<BatchRecordV1> {
    let bytes = bounded_file::read(&place.record, FileKind::Small).ok()?; // A job without a readable record is done again.
    let record = BatchRecordV1::read(&bytes)?;
    let is_same = |file: &RecordedFileV1| {
        let path = Path::new(&file.path);
        // A record names files of its own job only.
        let is_own = path.parent() == place.out.parent() && slashed(path).starts_with(&place.name);
        is_own
            && bounded_file::read(&folder.join(path), FileKind::Recording)
                .is_ok_and(|bytes| bytes.len() as u64 == file.bytes && sha256_hex(&bytes) == file.sha256)
    };
    (record.inputs == place.inputs && !record.files.is_empty() && record.files.iter().all(is_same))
        .then_some(record)
}

/// A relative path with slashes on every system.
fn slashed(path: &Path) -> String {
    path.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}
