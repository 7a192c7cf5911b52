//! Export of a texture to the formats of other programs: one table for the command line, the window and the guide.
//!
//! A new format is a file below `export/`, a line in a table and a row in `docs/guide/files-and-formats.md`: in [`FORMATS`] if
//! its files hold the texture itself, and in [`SIGNAL_FORMATS`] if they hold what one stroke over the texture gives.

mod ahap;
mod android;
mod batch;
mod envelopes;
mod haptic;
mod hatt;
mod hjif;
mod maps;
mod model_files;
mod openxr;
mod runtime;
mod signal_format;
mod signals;
mod stroke_losses;
#[cfg(test)]
mod test_support;
mod wav;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::{Library, Provenance, TextureEntry};

use self::model_files::{model_files, warn_of_stale};
use crate::figure_files::write_together;
use crate::report::Reporter;

pub use self::batch::{
    Batch, ExistingFiles, all_lost, check_folder, export_all, paths_in, refuse_existing, write_models,
};
pub use self::model_files::{ExportContext, model_paths, refuse_foreign_model};
pub use self::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal, path_of};
pub use self::signals::{refuse_foreign_files, shared_full_scale_mps2, signal_paths, write_signal};
pub use self::stroke_losses::{Rendered, lost_of_stroke, lost_of_tap};
pub use self::wav::WAV;

/// What a list of formats shows about one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormatInfo {
    /// Identifier for scripts.
    pub id: &'static str,
    /// Name for menus.
    pub name: &'static str,
    /// Ending of the files, without the dot.
    pub ending: &'static str,
    /// One sentence that names the programs that read it.
    pub help: &'static str,
}

/// A file format for textures.
pub trait ExportFormat: Sync {
    /// Identifier for scripts.
    fn id(&self) -> &'static str;

    /// Name of the format, for menus.
    fn name(&self) -> &'static str;

    /// Ending of its files, without the dot.
    fn ending(&self) -> &'static str;

    /// One sentence that names the programs that read it.
    fn help(&self) -> &'static str;

    /// Properties of a texture that the format cannot hold.
    fn lost(&self, texture: &TextureEntry) -> Vec<String>;

    /// Returns the bytes of the file.
    ///
    /// # Errors
    /// The format cannot represent the texture.
    fn bytes(&self, texture: &TextureEntry, created_by: &str) -> anyhow::Result<Vec<u8>>;

    /// Why the format cannot represent the texture, and what to do; `None` if it can. Files of a texture that is not refused
    /// fail only where the texture is damaged.
    fn refusal(&self, _: &TextureEntry) -> Option<String> {
        None
    }

    /// Suffixes of all files that an export may write ([`suffixed_path`]), the first one empty.
    fn suffixes(&self) -> &'static [&'static str] {
        &[""]
    }

    /// Whether its files describe the actuator that they are made for.
    fn describes_actuator(&self) -> bool {
        false
    }

    /// Returns all files: the first suffix always, others where the texture needs them. `stem` is the name of the first file
    /// without its ending, for files that refer to each other.
    ///
    /// # Errors
    /// The format cannot represent the texture.
    fn files(
        &self,
        texture: &TextureEntry,
        _stem: &str,
        context: &ExportContext<'_>,
    ) -> anyhow::Result<Vec<FilePart>> {
        Ok(vec![FilePart { suffix: "", bytes: self.bytes(texture, context.created_by)? }])
    }

    /// Returns whether bytes are a file of this format, the first one of its files, so that a newer one may replace it.
    fn is_like(&self, bytes: &[u8]) -> bool;
}

/// All export formats of texture models, in the order of menus.
pub static FORMATS: [&dyn ExportFormat; 4] = [&hatt::Hatt, &hjif::Hjif, &maps::HapticMaps, &runtime::Runtime];

/// All formats of signals of one stroke, in the order of menus.
pub static SIGNAL_FORMATS: [&dyn SignalFormat; 5] =
    [&wav::Wav, &haptic::Haptic, &ahap::Ahap, &android::Android, &openxr::OpenXr];

/// Returns all formats in the order of lists: those of [`SIGNAL_FORMATS`], then those of [`FORMATS`].
pub fn listed() -> impl Iterator<Item = FormatInfo> {
    let of_signals = |format: &'static dyn SignalFormat| FormatInfo {
        id: format.id(),
        name: format.name(),
        ending: format.ending(),
        help: format.help(),
    };
    let of_models = |format: &'static dyn ExportFormat| FormatInfo {
        id: format.id(),
        name: format.name(),
        ending: format.ending(),
        help: format.help(),
    };
    SIGNAL_FORMATS.into_iter().map(of_signals).chain(FORMATS.into_iter().map(of_models))
}

/// Returns the format of signals with this id.
pub fn signal_format(id: &str) -> Option<&'static dyn SignalFormat> {
    SIGNAL_FORMATS.into_iter().find(|format| format.id() == id)
}

/// Returns the format of texture models with this id.
pub fn format(id: &str) -> Option<&'static dyn ExportFormat> {
    FORMATS.into_iter().find(|format| format.id() == id)
}

/// Returns a path without this ending (which may contain dots) if it has it, otherwise without any ending.
pub fn without_ending(path: &Path, ending: &str) -> PathBuf {
    let name = path.file_name().and_then(OsStr::to_str);
    let stem =
        name.and_then(|name| name.strip_suffix(ending)?.strip_suffix('.')).filter(|stem| !stem.is_empty());
    stem.map_or_else(|| path.with_extension(""), |stem| path.with_file_name(stem))
}

/// Returns the path of a file with this suffix beside `out`, the path of a file with this ending. The suffix replaces the ending,
/// or any other ending; without a suffix, it is `out` itself.
pub fn suffixed_path(out: &Path, ending: &str, suffix: &str) -> PathBuf {
    if suffix.is_empty() {
        return out.to_owned();
    }
    let mut name = without_ending(out, ending).into_os_string();
    name.push(suffix);
    PathBuf::from(name)
}

/// Returns a texture of a library in a shape. Positions, attributes and physical labels are those of the texture without
/// the shape, so that a texture with another shape than the neutral one has none.
///
/// # Errors
/// The texture cannot be shaped.
pub fn shaped(texture: &TextureEntry, shape: &Shape) -> anyhow::Result<TextureEntry> {
    if shape.is_neutral() {
        return Ok(texture.clone());
    }
    let path = texture.path.clone().map(|path| path.shaped(shape)).transpose()?;
    let model = shape.apply(&texture.model)?;
    Ok(TextureEntry { model, path, place: None, attributes: None, physical: None, ..texture.clone() })
}

/// Result of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportOutcome {
    /// Written files.
    pub files: Vec<PathBuf>,
    /// Properties that the format cannot hold.
    pub lost: Vec<String>,
    /// Terms of use of the texture.
    pub license: String,
    /// Warnings, also given to the reporter.
    pub warnings: Vec<String>,
}

/// Writes a texture of a library to a file, and to files beside it if the format has several: all or none.
///
/// # Errors
/// The format cannot represent the texture, a file of another kind has one of the names, or a file cannot be written.
pub fn export(
    library: &Library,
    texture: &TextureEntry,
    format: &dyn ExportFormat,
    (out, context): (&Path, &ExportContext<'_>),
    reporter: &dyn Reporter,
) -> anyhow::Result<ExportOutcome> {
    let warning = restriction_of(texture);
    if let Some(warning) = &warning {
        reporter.warn(warning);
    }
    refuse_foreign_model(format, out)?;
    let written = model_files(&library.with_terms(texture), format, out, context)?;
    write_together(&written, None)?;
    let files: Vec<PathBuf> = written.into_iter().map(|(path, _)| path).collect();
    warn_of_stale(format, out, &files, reporter);
    let lost = format.lost(texture);
    for lost in &lost {
        reporter.note(&format!("not stored in the file: {lost}"));
    }
    Ok(ExportOutcome {
        files,
        lost,
        license: library.license_of(texture).to_owned(),
        warnings: warning.into_iter().collect(),
    })
}

/// Returns the warning about a texture that must not be redistributed.
fn restriction_of(texture: &TextureEntry) -> Option<String> {
    let restricted = (texture.provenance == Provenance::Restricted).then_some(texture.name.as_str());
    Provenance::warning(&restricted.into_iter().collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::test_support::library_with_heights;
    use super::{
        ExportContext, FORMATS, SIGNAL_FORMATS, export, format, listed, model_paths, shaped, signal_format,
        without_ending,
    };
    use crate::report::Warnings;
    use shagreen_core::space::LabelSource;
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::library::Attributes;
    use std::path::Path;

    #[test]
    fn an_ending_with_dots_is_one_ending() {
        for (path, ending, expected) in [
            ("/a/oak.wav", "wav", "/a/oak"),
            ("/a/oak.android.json", "android.json", "/a/oak"),
            ("/a/oak.json", "android.json", "/a/oak"),
            ("/a/oak", "wav", "/a/oak"),
            ("/a/my.oak.wav", "wav", "/a/my.oak"),
            (".wav", "wav", ".wav"),
        ] {
            assert_eq!(without_ending(Path::new(path), ending), Path::new(expected), "{path}");
        }
    }

    #[test]
    fn every_format_has_its_own_id_and_recognizes_its_files_only() {
        let library = library_with_heights();
        for (i, one) in FORMATS.into_iter().enumerate() {
            assert!(format(one.id()).is_some_and(|found| found.name() == one.name()));
            let bytes = one.bytes(&library.textures[0], "test").unwrap();
            for (j, other) in FORMATS.into_iter().enumerate() {
                assert_eq!(other.is_like(&bytes), i == j, "{} {}", one.id(), other.id());
            }
            assert!(!one.is_like(b"my notes"));
        }
        assert!(format("none").is_none());
        let ids: std::collections::BTreeSet<&str> = listed().map(|format| format.id).collect();
        assert_eq!(ids.len(), FORMATS.len() + SIGNAL_FORMATS.len());
        assert!(SIGNAL_FORMATS.into_iter().all(|one| signal_format(one.id()).is_some()));
    }

    #[test]
    fn every_format_says_that_it_lacks_attributes() {
        let mut texture = library_with_heights().textures.swap_remove(0);
        texture.attributes = Some(Attributes { source: LabelSource::PhysicalLabels, values: Vec::new() });
        for format in FORMATS {
            let lost = format.lost(&texture);
            assert_eq!(lost.iter().filter(|lost| *lost == "the attributes").count(), 1, "{}", format.id());
        }
    }

    #[test]
    fn a_shaped_texture_is_exported_in_its_shape() {
        let library = library_with_heights();
        let texture = &library.textures[0];
        assert_eq!(&shaped(texture, &Shape::default()).unwrap(), texture);
        let shape = Shape { level_db: -6.0, ..Shape::default() };
        let quiet = shaped(texture, &shape).unwrap();
        assert_eq!(quiet.model, shape.apply(&texture.model).unwrap());
        assert_eq!((quiet.place, &quiet.name), (None, &texture.name));
        for format in FORMATS {
            assert_eq!(format.refusal(&quiet), None, "{}", format.id());
            let bytes = |texture| format.bytes(texture, "test").unwrap();
            assert_ne!(bytes(&quiet), bytes(texture), "{}", format.id());
        }
    }

    #[test]
    fn an_export_replaces_its_like_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let library = library_with_heights();
        for format in FORMATS {
            let path = folder.path().join("cork").with_extension(format.ending());
            let to = (path.as_path(), &ExportContext::new("test"));
            let write = || export(&library, &library.textures[0], format, to, &Warnings::default());
            assert_eq!(write().unwrap().files, model_paths(format, &path));
            assert!(write().is_ok());
            std::fs::write(&path, "my notes").unwrap();
            assert!(format!("{:#}", write().unwrap_err()).contains("would replace"));
        }
    }
}
