//! Export of a texture to the formats of other programs: one table for the command line, the window and the guide.
//!
//! A new format of texture models is a file below `export/`, a line in [`FORMATS`] and a row in
//! `docs/guide/files-and-formats.md`. [`WAV`] stands apart, because a signal needs a stroke too.

mod batch;
mod hatt;
mod wav;

use std::path::{Path, PathBuf};

use shagreen_core::texture::shape::Shape;
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, Provenance, TextureEntry};

use crate::replace::refuse_foreign;
use crate::report::Reporter;

pub use self::batch::{Batch, ExistingFiles, all_lost, export_all, paths_in, write_models};
pub use self::wav::{Rendered, WAV, lost_in_wav, lost_of_tap};

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

    /// Returns whether bytes are a file of this format, so that a newer one may replace it.
    fn is_like(&self, bytes: &[u8]) -> bool;
}

/// All export formats, in the order of menus.
pub static FORMATS: [&dyn ExportFormat; 1] = [&hatt::Hatt];

/// Returns all formats in the order of lists: [`WAV`], then those of [`FORMATS`].
pub fn listed() -> impl Iterator<Item = FormatInfo> {
    let info = |format: &'static dyn ExportFormat| FormatInfo {
        id: format.id(),
        name: format.name(),
        ending: format.ending(),
        help: format.help(),
    };
    std::iter::once(WAV).chain(FORMATS.into_iter().map(info))
}

/// Returns the format of texture models with this id.
pub fn format(id: &str) -> Option<&'static dyn ExportFormat> {
    FORMATS.into_iter().find(|format| format.id() == id)
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

/// Writes a texture of a library to a file.
///
/// # Errors
/// The format cannot represent the texture, a file of another kind has this name, or the file cannot be written.
pub fn export(
    library: &Library,
    texture: &TextureEntry,
    format: &dyn ExportFormat,
    (out, created_by): (&Path, &str),
    reporter: &dyn Reporter,
) -> anyhow::Result<ExportOutcome> {
    let warning = restriction_of(texture);
    if let Some(warning) = &warning {
        reporter.warn(warning);
    }
    refuse_foreign(out, format.name(), |bytes| format.is_like(bytes))?;
    atomic::write(out, &format.bytes(texture, created_by)?)?;
    let lost = format.lost(texture);
    for lost in &lost {
        reporter.note(&format!("not stored in the file: {lost}"));
    }
    Ok(ExportOutcome {
        files: vec![out.to_owned()],
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
    use super::{FORMATS, export, format, listed, shaped};
    use crate::report::Warnings;
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn every_format_has_its_own_id_and_recognizes_its_files_only() {
        let library = starter_library().unwrap();
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
        assert_eq!(ids.len(), FORMATS.len() + 1);
    }

    #[test]
    fn a_shaped_texture_is_exported_in_its_shape() {
        let library = starter_library().unwrap();
        let texture = &library.textures[0];
        assert_eq!(&shaped(texture, &Shape::default()).unwrap(), texture);
        let shape = Shape { level_db: -6.0, ..Shape::default() };
        let quiet = shaped(texture, &shape).unwrap();
        assert_eq!(quiet.model, shape.apply(&texture.model).unwrap());
        assert_eq!((quiet.place, &quiet.name), (None, &texture.name));
        for format in FORMATS {
            let bytes = |texture| format.bytes(texture, "test").unwrap();
            assert_ne!(bytes(&quiet), bytes(texture), "{}", format.id());
        }
    }

    #[test]
    fn an_export_replaces_its_like_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let library = starter_library().unwrap();
        for format in FORMATS {
            let path = folder.path().join("cork").with_extension(format.ending());
            let write =
                || export(&library, &library.textures[0], format, (&path, "test"), &Warnings::default());
            assert_eq!(write().unwrap().files, std::slice::from_ref(&path));
            assert!(write().is_ok());
            std::fs::write(&path, "my notes").unwrap();
            assert!(format!("{:#}", write().unwrap_err()).contains("would replace"));
        }
    }
}
