//! `shagreen export` in a format of signals: the signal of one stroke over one texture, or over each of a library.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::actuator::{Actuator, Drive};
use shagreen_core::units::Hertz;
use shagreen_formats::acf::{AcfV1, acf};
use shagreen_formats::library::{Library, Provenance};
use shagreen_studio::export::{
    ExistingFiles, Rendered, SignalFormat, SignalSamples, StrokeSignal, all_lost, check_folder, paths_in,
    refuse_existing, refuse_foreign_files, shared_full_scale_mps2, signal_paths, write_signal,
};
use shagreen_studio::replace::refuse_inputs;
use shagreen_studio::report::Reporter;
use shagreen_studio::sound_entry::terms_of_sound;

use crate::cli::motion::Motion;
use crate::cli::output::{self, Printed};
use crate::cli::signal_args::SignalArgs;
use crate::cli::stroke_signal::{Rendering, StrokeSamples, stroke_samples};
use crate::cli::target::NamedSound;

/// What is exported, and where to.
pub(crate) struct Request<'a> {
    /// The format.
    pub(crate) format: &'static dyn SignalFormat,
    /// The textures, in their shape.
    pub(crate) textures: Vec<NamedSound>,
    /// Whether they are all textures of the library, each with files of its own in a folder.
    pub(crate) is_all: bool,
    /// Library of the textures.
    pub(crate) library: Library,
    /// Stroke and samples.
    pub(crate) args: &'a SignalArgs,
    /// Actuator that shall play the files.
    pub(crate) actuator: Option<Actuator>,
    /// Files that are read, without the stroke.
    pub(crate) inputs: Vec<Option<&'a Path>>,
    /// First file, or folder of all files.
    pub(crate) out: &'a Path,
    /// Whether files of the same format are replaced.
    pub(crate) replaces: bool,
    /// Whether the result is printed as JSON.
    pub(crate) as_json: bool,
}

/// One texture with its files.
struct Item<'a> {
    texture: &'a NamedSound,
    licence: String,
    provenance: Provenance,
    rendering: Rendering,
    /// Path of its first file.
    out: PathBuf,
    lost: Vec<String>,
}

/// Adds to the error that files exist which option replaces them.
pub(crate) fn or_replace(error: anyhow::Error) -> anyhow::Error {
    let can_replace = error.is::<ExistingFiles>();
    if can_replace { error.context("nothing was written; --replace replaces the files") } else { error }
}

/// Renders the signals and writes their files, after all checks. With several textures, all files have one full scale.
pub(crate) fn export_signals(request: &Request<'_>) -> anyhow::Result<()> {
    let Request { format, library, args, .. } = request;
    if let Some(option) = args.samples.of_encoding().filter(|_| !format.stores_samples()) {
        bail!(output::Usage(format!(
            "{option} applies only to files of samples; leave it out for the format {}",
            format.id()
        )));
    }
    let motion = args.motion()?;
    let acf = request.acf()?;
    let items = request.items(&motion)?;
    request.check_paths(&items, &motion, acf.is_some())?;
    let restricted = items.iter().filter(|item| item.provenance == Provenance::Restricted);
    let warning = Provenance::warning(&restricted.map(|item| &*item.texture.name).collect::<Vec<_>>());
    if let Some(warning) = &warning {
        output::warn(warning);
    }
    let lost = all_lost(items.iter().map(|item| &*item.lost));
    for lost in &lost {
        output::note(&format!("not stored in the {}: {lost}", if request.is_all { "files" } else { "file" }));
    }
    let reporter = Once::default();
    let render = |item: &Item<'_>| {
        stroke_samples(library, &item.texture.sound, &motion, item.rendering, &reporter)
            .with_context(|| format!("\"{}\"", item.texture.id()))
    };
    let scale_of = |item: &Item<'_>, rendered: &StrokeSamples| {
        format.full_scale_mps2(signal_samples(rendered, item.rendering), args.samples.encoding())
    };
    // Rendered once more when they are written: the samples of all textures may not fit into memory.
    let shared = if request.is_all {
        let scale = |item: &Item<'_>| -> anyhow::Result<f64> { Ok(scale_of(item, &render(item)?)) };
        Some(shared_full_scale_mps2(items.iter().map(scale).collect::<anyhow::Result<Vec<f64>>>()?))
    } else {
        None
    };
    if request.is_all {
        std::fs::create_dir_all(request.out).with_context(|| {
            format!("cannot create the folder; choose another: {}", request.out.display())
        })?;
    }
    let mut written: Vec<(Vec<String>, f64)> = Vec::with_capacity(items.len());
    for item in &items {
        let rendered = render(item)?;
        let full_scale_mps2 = shared.unwrap_or_else(|| shared_full_scale_mps2([scale_of(item, &rendered)]));
        let signal = StrokeSignal {
            samples: signal_samples(&rendered, item.rendering),
            sidecar: &rendered.sidecar,
            encoding: args.samples.encoding(),
            full_scale_mps2,
            acf: acf.as_ref(),
        };
        let files = write_signal(*format, &signal, (&item.out, output::CREATED_BY), &Printed)?;
        written.push((files.iter().map(|file| file.display().to_string()).collect(), full_scale_mps2));
    }
    request.print(&items, &written, (&lost, warning.as_deref()), &motion);
    Ok(())
}

fn signal_samples(rendered: &StrokeSamples, rendering: Rendering) -> SignalSamples<'_> {
    SignalSamples {
        all: &rendered.samples,
        without_taps: rendered.without_taps.as_deref(),
        rate: Hertz(f64::from(rendering.rate_hz)),
        loops: rendering.loops,
    }
}

impl Request<'_> {
    /// Returns the configuration of the actuator.
    fn acf(&self) -> anyhow::Result<Option<AcfV1>> {
        let Some(actuator) = &self.actuator else { return Ok(None) };
        Ok(Some(acf(actuator, Drive::ASSUMED, output::CREATED_BY)?))
    }

    /// Selects the textures, and the paths of their first files.
    fn items(&self, motion: &Motion) -> anyhow::Result<Vec<Item<'_>>> {
        let library = &self.library;
        if self.textures.is_empty() {
            bail!("there is no texture to export; choose another library");
        }
        let outs = if self.is_all {
            paths_in(self.out, self.textures.iter().map(NamedSound::id), self.format.ending())
        } else {
            vec![self.out.to_owned()]
        };
        let follows_stroke = motion.stroke_path().is_some();
        let items = self.textures.iter().zip(outs).map(|(texture, out)| {
            let sound = &texture.sound;
            let (licence, provenance) = terms_of_sound(library, sound);
            let rendering = self.args.samples.rendering(library, sound)?;
            let rate = Hertz(f64::from(rendering.rate_hz));
            let lost = self.format.lost(Rendered::of_sound(library, sound, rate, follows_stroke));
            Ok(Item { texture, licence, provenance, rendering, out, lost })
        });
        items.collect()
    }

    /// Checks that the files replace no input, no file of another kind, and nothing that must stay.
    fn check_paths(&self, items: &[Item<'_>], motion: &Motion, has_actuator: bool) -> anyhow::Result<()> {
        if self.out.as_os_str().is_empty() {
            bail!(output::Usage("--out is empty; give a file name".to_owned()));
        }
        let paths = items.iter().map(|item| signal_paths(self.format, &item.out, has_actuator));
        let paths: Vec<PathBuf> = paths.collect::<anyhow::Result<Vec<_>>>()?.concat();
        if self.is_all {
            check_folder(self.out)?;
        }
        let mut inputs = self.inputs.clone();
        inputs.push(motion.stroke_path());
        refuse_inputs(&paths.iter().map(PathBuf::as_path).collect::<Vec<_>>(), &inputs)?;
        refuse_foreign_files(self.format, &paths)?;
        // Nothing but a sidecar marks a file as one of ours that nobody has changed.
        if self.is_all || !self.format.has_sidecar() {
            refuse_existing(&paths, self.replaces).map_err(|error| or_replace(error.into()))?;
        }
        Ok(())
    }

    fn print(
        &self,
        items: &[Item<'_>],
        written: &[(Vec<String>, f64)],
        (lost, warning): (&[&str], Option<&str>),
        motion: &Motion,
    ) {
        let files: Vec<&String> = written.iter().flat_map(|(files, _)| files).collect();
        let result = if let (false, [item]) = (self.is_all, items) {
            json!({
                "files": files,
                "lost": lost,
                "warnings": Vec::from_iter(warning),
                "licence": item.licence,
                "full_scale": written.first().map(|(_, full_scale_mps2)| *full_scale_mps2),
                "rate_hz": item.rendering.rate_hz,
                "seconds": motion.seconds(),
            })
        } else {
            let each = |(item, (files, full_scale_mps2)): (&Item<'_>, &(Vec<String>, f64))| {
                json!({
                    "id": item.texture.id(),
                    "files": files,
                    "lost": item.lost,
                    "licence": item.licence,
                    "full_scale": full_scale_mps2,
                    "rate_hz": item.rendering.rate_hz,
                })
            };
            json!({
                "files": files,
                "lost": lost,
                "warnings": Vec::from_iter(warning),
                "exported": items.iter().zip(written).map(each).collect::<Vec<Value>>(),
                "folder": self.out.display().to_string(),
                "seconds": motion.seconds(),
            })
        };
        let id = self.format.id();
        output::print(self.as_json, &result, || {
            let line = |(item, (files, _)): (&Item<'_>, &(Vec<String>, f64))| {
                format!("{}: {}\n", item.texture.id(), files.join(", "))
            };
            if let (false, [item], [(files, _)]) = (self.is_all, items, written) {
                return format!("Wrote \"{}\" as {id}: {}", item.texture.name, files.join(", "));
            }
            let lines: String = items.iter().zip(written).map(line).collect();
            let n = items.len();
            format!("{lines}Exported the signals of {n} textures as {id} into {}", self.out.display())
        });
    }
}

/// Prints each message once: several textures have the same limits, and each is rendered twice.
#[derive(Default)]
struct Once(RefCell<BTreeSet<String>>);

impl Once {
    fn is_new(&self, message: &str) -> bool {
        self.0.borrow_mut().insert(message.to_owned())
    }
}

impl Reporter for Once {
    fn warn(&self, message: &str) {
        if self.is_new(message) {
            output::warn(message);
        }
    }

    fn note(&self, message: &str) {
        if self.is_new(message) {
            output::note(message);
        }
    }
}
