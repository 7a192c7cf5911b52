//! Files of an export: their paths, what they would replace, what they cannot store, and their content. All of it is
//! computed in the background.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use shagreen_core::units::Hertz;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::{Provenance, TextureEntry};
use shagreen_formats::wav_encoding::Level;
use shagreen_studio::export::{
    ExportContext, ExportFormat, Rendered, SignalFormat, model_paths, path_of, paths_in,
    shared_full_scale_mps2, write_models,
};
use shagreen_studio::file::one_line;
use shagreen_studio::report::Warnings;

use crate::session::authored_sources::AuthoredSources;
use crate::state::audible_texture::AudibleTexture;
use crate::state::bench_signal::BenchSignal;
use crate::state::document::CREATED_BY;
use crate::state::signal_file::{SignalFile, SignalOptions, Sounding};
use crate::strings::{export as strings, import};

/// What is exported.
pub(super) enum What {
    /// The audible texture.
    Audible(Arc<AudibleTexture>),
    /// All authored textures.
    All(Arc<AuthoredSources>),
}

/// Format of the files, with its options.
pub(super) enum Format {
    /// Signals of a stroke.
    Signal(&'static dyn SignalFormat, SignalOptions),
    /// Texture models.
    Model(&'static dyn ExportFormat),
}

/// An export.
pub(super) struct Job {
    pub(super) what: What,
    pub(super) format: Format,
    /// Path of the file, or of the folder of several files.
    pub(super) path: PathBuf,
}

/// Result of an export.
pub(super) enum Outcome {
    /// The files were written.
    Saved(Saved),
    /// Nothing was written, because these files would be replaced.
    Exists(Vec<PathBuf>),
    /// Why the export failed.
    Failed(String),
}

/// Written files.
pub(super) struct Saved {
    pub(super) paths: Vec<PathBuf>,
    /// What is not as the user may expect, such as silence.
    pub(super) warnings: Vec<String>,
}

/// What the user must know before an export.
#[derive(Default)]
pub(super) struct Summary {
    /// Properties that the files cannot store.
    pub(super) lost: Vec<String>,
    /// Names of contained textures that may not be redistributed.
    pub(super) restricted: Vec<String>,
}

impl Job {
    /// Writes the files. Existing files are replaced only with `replaces`, and only by files of the same format. Nothing
    /// is written before all paths are checked. Texture models are written all or none; signals are rendered and written
    /// one after the other.
    pub(super) fn run(&self, replaces: bool) -> Outcome {
        let paths = self.paths();
        match self.replaced(&paths) {
            Err(reason) => return Outcome::Failed(reason),
            Ok(existing) if !existing.is_empty() && !replaces => return Outcome::Exists(existing),
            Ok(_) => {}
        }
        match self.write(&paths) {
            Ok(warnings) => Outcome::Saved(Saved { paths, warnings }),
            Err(reason) => Outcome::Failed(reason),
        }
    }

    /// Lists what the files cannot store.
    ///
    /// # Errors
    /// States why a texture cannot be exported.
    pub(super) fn summary(&self) -> Result<Summary, String> {
        let mut summary = Summary { lost: self.lost_of_paths().into_iter().collect(), ..Summary::default() };
        match &self.format {
            Format::Signal(format, options) => {
                if self.scales_several(*format, options) && !options.shares_scale {
                    summary.lost.push(strings::LEVELS_LOST.to_owned());
                }
                let texture = match &self.what {
                    What::Audible(audible) => audible.entry.as_ref().ok(),
                    What::All(_) => None,
                };
                for signal in self.signals()? {
                    let follows_stroke = options.follows_stroke && signal.stroke.is_some();
                    let rate = Hertz(f64::from(options.rate_hz));
                    let rendered = Rendered { texture, tap: signal.tap, rate, follows_stroke };
                    add(&mut summary.lost, format.lost(rendered));
                    add(&mut summary.restricted, signal.restricted);
                }
            }
            Format::Model(format) => {
                for entry in self.entries()? {
                    if let Some(reason) = format.refusal(&entry) {
                        return Err(reason);
                    }
                    add(&mut summary.lost, format.lost(&entry));
                    if entry.provenance == Provenance::Restricted {
                        add(&mut summary.restricted, [entry.name]);
                    }
                }
            }
        }
        Ok(summary)
    }

    /// States that paths of authored textures are not stored. A texture model is that of the point, and so is the signal of
    /// a texture whose path does not play.
    fn lost_of_paths(&self) -> Option<String> {
        match &self.what {
            What::All(sources) => {
                let names: Vec<&str> = sources.names_with_paths().collect();
                (!names.is_empty()).then(|| strings::paths_lost(&names))
            }
            What::Audible(audible) => {
                let plays = audible.plays_path() && matches!(self.format, Format::Signal(..));
                (audible.has_path && !plays).then(|| strings::PATH_LOST.to_owned())
            }
        }
    }

    /// Whether several signals are scaled.
    fn scales_several(&self, format: &dyn SignalFormat, options: &SignalOptions) -> bool {
        let is_scaled = !format.stores_samples() || options.encoding.level == Level::Peak;
        matches!(self.what, What::All(_)) && is_scaled
    }

    /// Acceleration in m/s² at full scale that all signals share; `None` if each has its own.
    ///
    /// # Errors
    /// A signal cannot be rendered.
    fn shared_scale(
        &self,
        signals: &[SignalFile],
        format: &dyn SignalFormat,
        options: &SignalOptions,
    ) -> Result<Option<f64>, String> {
        if !(self.scales_several(format, options) && options.shares_scale) {
            return Ok(None);
        }
        // Rendered once more when it is written: all samples at once may not fit into memory.
        let mut each = Vec::with_capacity(signals.len());
        for signal in signals {
            each.push(signal.full_scale_mps2(format, options)?);
        }
        Ok(Some(shared_full_scale_mps2(each)))
    }

    /// Signal of the Signals workspace that is exported.
    pub(super) fn bench_signal(&self) -> Option<Arc<BenchSignal>> {
        match (&self.what, &self.format) {
            (What::Audible(audible), Format::Signal(..)) => match &audible.signal.as_ref().ok()?.sounding {
                Sounding::Bench(signal) => Some(Arc::clone(signal)),
                Sounding::Mix(..) | Sounding::Path(_) => None,
            },
            _ => None,
        }
    }

    /// Paths of the files. All authored textures get files of their own names in the folder.
    fn paths(&self) -> Vec<PathBuf> {
        let What::All(sources) = &self.what else { return vec![self.path.clone()] };
        let ending = match &self.format {
            Format::Signal(format, _) => format.ending(),
            Format::Model(format) => format.ending(),
        };
        paths_in(&self.path, sources.names(), ending)
    }

    /// Files that exist already.
    ///
    /// # Errors
    /// Names a file that must not be replaced, because it is of another kind or cannot be read.
    fn replaced(&self, paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
        let mut existing = Vec::new();
        for path in paths {
            let refused = |path: &Path| strings::not_replaced(&path.display().to_string());
            for beside in self.beside(path) {
                if beside.symlink_metadata().is_ok() && !self.may_replace(&beside)? {
                    return Err(refused(&beside));
                }
            }
            if path.symlink_metadata().is_err() {
                if let Format::Model(format) = &self.format
                    && let Some(beside) = model_paths(*format, path).iter().find(|beside| beside.exists())
                {
                    return Err(refused(beside));
                }
                continue;
            }
            existing.push(path.clone());
            if !self.may_replace(path)? {
                return Err(refused(path));
            }
        }
        Ok(existing)
    }

    /// Files of a signal that may be written beside the one at `path`.
    fn beside(&self, path: &Path) -> Vec<PathBuf> {
        let Format::Signal(format, _) = &self.format else { return Vec::new() };
        format.suffixes(false).iter().skip(1).map(|suffix| path_of(*format, path, suffix)).collect()
    }

    /// Whether a file may be replaced: one of the same format.
    ///
    /// # Errors
    /// It cannot be read.
    fn may_replace(&self, path: &Path) -> Result<bool, String> {
        let bytes = bounded_file::read(path, FileKind::Recording)
            .map_err(|error| import::cannot_be_checked(&error.to_string()))?;
        Ok(match &self.format {
            Format::Signal(format, _) => format.may_replace(path, &bytes),
            Format::Model(format) => format.is_like(&bytes),
        })
    }

    /// Writes the files and returns the warnings; those of one of several signals name it.
    fn write(&self, paths: &[PathBuf]) -> Result<Vec<String>, String> {
        match &self.format {
            Format::Signal(format, options) => {
                let signals = self.signals()?;
                let scale_mps2 = self.shared_scale(&signals, *format, options)?;
                if let Some(folder) = self.folder() {
                    let no_folder = |error: std::io::Error| {
                        strings::no_folder(&error.to_string(), &folder.display().to_string())
                    };
                    std::fs::create_dir_all(folder).map_err(no_folder)?;
                }
                let mut warnings = Vec::new();
                for (signal, path) in signals.iter().zip(paths) {
                    let of_file = signal.write(*format, path, options, scale_mps2)?;
                    let name = signal.sidecar.name.as_ref().filter(|_| matches!(self.what, What::All(_)));
                    warnings.extend(of_file.into_iter().map(|warning| match name {
                        Some(name) => strings::of_texture(name, &warning),
                        None => warning,
                    }));
                }
                Ok(warnings)
            }
            Format::Model(format) => {
                let (context, warnings) = (ExportContext::new(CREATED_BY), Warnings::default());
                let to = (self.folder(), &context);
                let written = write_models(&self.entries()?, paths, *format, to, &warnings);
                written.map_err(|error| one_line(&error))?;
                Ok(warnings.into_vec())
            }
        }
    }

    /// Folder of several files, which is created if it does not exist.
    fn folder(&self) -> Option<&Path> {
        matches!(self.what, What::All(_)).then_some(&*self.path)
    }

    fn signals(&self) -> Result<Vec<SignalFile>, String> {
        match &self.what {
            What::Audible(audible) => audible.signal.clone().map(|signal| vec![signal]),
            What::All(sources) => sources.signals(),
        }
    }

    fn entries(&self) -> Result<Vec<TextureEntry>, String> {
        match &self.what {
            What::Audible(audible) => audible.entry.clone().map(|entry| vec![entry]),
            What::All(sources) => sources.entries(),
        }
    }
}

/// Adds the texts that are not in the list yet.
fn add(list: &mut Vec<String>, texts: impl IntoIterator<Item = String>) {
    for text in texts {
        if !list.contains(&text) {
            list.push(text);
        }
    }
}

#[cfg(test)]
mod tests;
