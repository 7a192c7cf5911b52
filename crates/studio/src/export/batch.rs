//! Export of several textures at once, one file each.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_formats::library::{Library, Provenance, TextureEntry, free_id, id_from_name};

use super::{
    ExportContext, ExportFormat, ExportOutcome, model_files, refuse_foreign_model, restriction_of,
    warn_of_stale,
};
use crate::figure_files::write_together;
use crate::report::Reporter;

/// Folder and rules of an export of several textures.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// Folder of the files; it is created if it does not exist.
    pub folder: &'a Path,
    /// Whether files of the same format are replaced.
    pub replaces: bool,
    /// What the files hold beside the textures.
    pub context: ExportContext<'a>,
}

/// Several files exist and may not be replaced.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}; choose another name or folder: {}", existing(*.n_existing, *.n), .first.display())]
pub struct ExistingFiles {
    /// Number of files that exist.
    pub n_existing: usize,
    /// Number of all files.
    pub n: usize,
    /// The first file that exists.
    pub first: PathBuf,
}

/// How many of the files exist, as the begin of an error.
fn existing(n_existing: usize, n: usize) -> String {
    if n == 1 {
        "this file exists already".to_owned()
    } else {
        format!("{n_existing} of the {n} files exist already")
    }
}

/// Returns the paths of files with these names in a folder. No two are the same: names that can be those of files stay as they
/// are, and the others become lower-case words with hyphens, with a number if that is taken.
pub fn paths_in<S: AsRef<str>>(
    folder: &Path,
    names: impl IntoIterator<Item = S>,
    ending: &str,
) -> Vec<PathBuf> {
    let names: Vec<S> = names.into_iter().collect();
    let wanted: Vec<String> = names.iter().map(|name| id_from_name(name.as_ref())).collect();
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let unchanged = |(name, wanted): (&S, &String)| {
        let name: &str = name.as_ref();
        (name == wanted && taken.insert(wanted.clone())).then(|| wanted.clone())
    };
    let kept: Vec<Option<String>> = names.iter().zip(&wanted).map(unchanged).collect();
    let ids = kept.into_iter().zip(&wanted).map(|(kept, wanted)| {
        kept.unwrap_or_else(|| {
            let id = free_id(wanted, |id| taken.contains(id));
            taken.insert(id.clone());
            id
        })
    });
    ids.map(|id| folder.join(id).with_extension(ending)).collect()
}

/// Checks the folder of several files.
///
/// # Errors
/// It is a file.
pub fn check_folder(folder: &Path) -> anyhow::Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!(
            "several textures are written into a folder, but this is a file; choose another folder: {}",
            folder.display()
        );
    }
    Ok(())
}

/// Checks that no file exists at these paths, unless files may be replaced.
///
/// # Errors
/// Files exist.
pub fn refuse_existing(paths: &[PathBuf], replaces: bool) -> Result<(), ExistingFiles> {
    let mut existing = paths.iter().filter(|path| path.exists());
    match existing.next().filter(|_| !replaces) {
        None => Ok(()),
        Some(first) => {
            let n_existing = 1 + existing.count();
            Err(ExistingFiles { n_existing, n: paths.len(), first: first.clone() })
        }
    }
}

/// Writes the models of textures to these paths, in the same order, and to files beside them if the format has several: all or
/// none. `folder` is created if it does not exist. Returns the paths of the files of each texture. It warns of files of an earlier
/// export that belong to no file of this one.
///
/// # Errors
/// The format cannot represent a texture, which the message names, or a file cannot be written.
pub fn write_models(
    entries: &[TextureEntry],
    paths: &[PathBuf],
    format: &dyn ExportFormat,
    (folder, context): (Option<&Path>, &ExportContext<'_>),
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<Vec<PathBuf>>> {
    let (mut files, mut written) = (Vec::new(), Vec::<Vec<PathBuf>>::with_capacity(paths.len()));
    for (entry, path) in entries.iter().zip(paths) {
        let of_texture = model_files(entry, format, path, context);
        let of_texture = of_texture.with_context(|| format!("\"{}\"", entry.name))?;
        written.push(of_texture.iter().map(|(path, _)| path.clone()).collect());
        files.extend(of_texture);
    }
    write_together(&files, folder)?;
    for (path, written) in paths.iter().zip(&written) {
        warn_of_stale(format, path, written, reporter);
    }
    Ok(written)
}

/// Writes textures of a library into a folder, each to a file that is named after its id ([`paths_in`]), and to files beside it
/// if the format has several. Returns an outcome for each texture, in their order. Each property that files cannot hold is
/// reported once.
///
/// # Errors
/// There is no texture, the folder is a file, a file of another kind has one of the names, a file of the same format has one
/// and may not be replaced ([`ExistingFiles`]), the format cannot represent a texture, or a file cannot be written. No file is
/// then written.
pub fn export_all(
    library: &Library,
    entries: &[TextureEntry],
    format: &dyn ExportFormat,
    batch: &Batch<'_>,
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<ExportOutcome>> {
    let Batch { folder, replaces, ref context } = *batch;
    if entries.is_empty() {
        bail!("there is no texture to export; choose another library");
    }
    check_folder(folder)?;
    let paths = paths_in(folder, entries.iter().map(|entry| &entry.id), format.ending());
    for path in &paths {
        refuse_foreign_model(format, path)?;
    }
    refuse_existing(&paths, replaces)?;
    let restricted = entries.iter().filter(|entry| entry.provenance == Provenance::Restricted);
    if let Some(warning) = Provenance::warning(&restricted.map(|entry| &*entry.name).collect::<Vec<_>>()) {
        reporter.warn(&warning);
    }
    // A file does not carry the library along.
    let with_terms: Vec<TextureEntry> = entries.iter().map(|entry| library.with_terms(entry)).collect();
    let written = write_models(&with_terms, &paths, format, (Some(folder), context), reporter)?;
    let outcome = |(entry, files): (&TextureEntry, Vec<PathBuf>)| ExportOutcome {
        files,
        lost: format.lost(entry),
        license: library.license_of(entry).to_owned(),
        warnings: restriction_of(entry).into_iter().collect(),
    };
    let outcomes: Vec<ExportOutcome> = entries.iter().zip(written).map(outcome).collect();
    for lost in all_lost(outcomes.iter().map(|outcome| &*outcome.lost)) {
        reporter.note(&format!("not stored in the files: {lost}"));
    }
    Ok(outcomes)
}

/// Returns the properties that at least one of the files cannot hold, each once, from those of each file.
pub fn all_lost<'a>(each: impl IntoIterator<Item = &'a [String]>) -> Vec<&'a str> {
    let mut all: Vec<&str> = Vec::new();
    for lost in each.into_iter().flatten() {
        if !all.contains(&lost.as_str()) {
            all.push(lost);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{Batch, ExistingFiles, all_lost, export_all, paths_in};
    use crate::export::test_support::library_with_heights;
    use crate::export::{ExportContext, FORMATS, model_paths};
    use crate::report::Warnings;
    use std::path::Path;

    #[test]
    fn names_of_files_never_clash() {
        let paths = paths_in(Path::new("/a"), ["Oak", "oak", "Oak 2", "…"], "xml");
        let expected = ["/a/oak-2.xml", "/a/oak.xml", "/a/oak-2-2.xml", "/a/texture.xml"];
        assert_eq!(paths, expected.map(Path::new));
        // A file has the name of an id that needs no change, whatever comes before it.
        let paths = paths_in(Path::new("/a"), ["a_1", "a-1", "a-1-2", "a 1"], "xml");
        assert_eq!(paths, ["/a/a-1-3.xml", "/a/a-1.xml", "/a/a-1-2.xml", "/a/a-1-4.xml"].map(Path::new));
    }

    #[test]
    fn all_textures_are_written_or_none() {
        let library = library_with_heights();
        let entries = &library.textures[..3];
        for format in FORMATS {
            let parent = tempfile::tempdir().unwrap();
            let folder = parent.path().join("made");
            let export = |replaces: bool| {
                let batch = Batch { folder: &folder, replaces, context: ExportContext::new("test") };
                export_all(&library, entries, format, &batch, &Warnings::default())
            };
            let outcomes = export(false).unwrap();
            assert_eq!(outcomes.len(), 3);
            for (outcome, entry) in outcomes.iter().zip(entries) {
                let path = folder.join(&entry.id).with_extension(format.ending());
                assert_eq!(outcome.files, model_paths(format, &path));
                assert_eq!(outcome.lost, format.lost(entry));
                assert!(outcome.files[0].is_file() && !outcome.license.is_empty());
            }
            let lost = all_lost(outcomes.iter().map(|outcome| &*outcome.lost));
            assert!(entries.iter().flat_map(|entry| format.lost(entry)).all(|text| lost.contains(&&*text)));
            let refused = export(false).unwrap_err();
            let first = outcomes[0].files[0].clone();
            let expected = ExistingFiles { n_existing: 3, n: 3, first };
            assert_eq!(refused.downcast_ref::<ExistingFiles>(), Some(&expected));
            let refused = refused.to_string();
            assert!(refused.contains("3 of the 3 files") && !refused.contains("--"), "{refused}");
            assert!(export(true).is_ok());
            // A file of another kind is never replaced, and then no other file is written.
            let path = &outcomes[2].files[0];
            std::fs::write(path, "my notes").unwrap();
            for file in &outcomes[0].files {
                std::fs::remove_file(file).unwrap();
            }
            assert!(export(true).unwrap_err().to_string().contains("would replace"));
            assert_eq!(std::fs::read(path).unwrap(), b"my notes");
            assert!(!outcomes[0].files[0].exists());
        }
    }
}
