//! Loading of libraries: from a file, from a folder of files, or built into the program.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::space::LabelSource;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, LibraryError, TextureEntry, USUAL_AXES, read_library};

use crate::file::{in_file, read_file};
use crate::report::Reporter;

/// Loads the library at a path: a file, a folder of files, or the name of a built-in library; without a path, the
/// starter library.
///
/// # Errors
/// The path cannot be read or contains no library.
pub fn load(path: Option<&Path>, reporter: &dyn Reporter) -> anyhow::Result<Library> {
    let library = match path {
        None => BuiltIn::Starter.read()?,
        Some(path) => match built_in(path) {
            Some(built_in) => built_in.read()?,
            None if path.is_dir() => load_folder(path, reporter)?,
            None => load_file(path, reporter)?.with_context(|| in_file(path))?,
        },
    };
    let sources: Vec<&str> = library.label_sources().into_iter().map(LabelSource::label).collect();
    if sources.len() > 1 {
        reporter.warn(&format!(
            "the positions come from different sources ({}): interpolation between textures of different sources is not meaningful; \
             `shagreen library list` shows the source of each",
            sources.join(", ")
        ));
    }
    Ok(library)
}

/// Returns the built-in library of this name, unless a file has the name. The starter library needs no name, so only
/// the simulated one has one.
pub fn built_in(path: &Path) -> Option<BuiltIn> {
    let built_in = BuiltIn::from_id(path.to_str()?).filter(|built_in| *built_in == BuiltIn::Simulated);
    built_in.filter(|_| !path.exists())
}

/// Reads a library file. The inner error is for files that are not libraries, and still lacks the path.
fn load_file(path: &Path, reporter: &dyn Reporter) -> anyhow::Result<Result<Library, LibraryError>> {
    let bytes = read_file(path, FileKind::Document)?;
    Ok(read_library(&bytes).map(|imported| {
        for warning in &imported.warnings {
            reporter.warn(&format!("{warning}: {}", path.display()));
        }
        imported.value
    }))
}

/// Axes and path of a library of a folder.
struct Stated {
    axes: Option<Vec<String>>,
    path: PathBuf,
}

/// Merges all library files of a folder; other files are ignored. The merged library has the axes of the libraries if all with
/// positions have the same, or else the usual two.
fn load_folder(folder: &Path, reporter: &dyn Reporter) -> anyhow::Result<Library> {
    let list = || -> std::io::Result<Vec<PathBuf>> {
        std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
    };
    let mut paths =
        list().context("cannot read the folder; check your permissions").with_context(|| in_file(folder))?;
    paths.retain(|path| path.is_file() && path.extension().is_some_and(|extension| extension == "json"));
    paths.sort();
    let mut merged = Library { name: folder.display().to_string(), ..Library::default() };
    let mut homes: HashMap<String, PathBuf> = HashMap::new();
    let (mut placed, mut unplaced): (Vec<Stated>, Vec<Stated>) = (Vec::new(), Vec::new());
    for path in paths {
        let library = match load_file(&path, reporter)? {
            Ok(library) => library,
            // The sidecar of a signal, or JSON of another program.
            Err(LibraryError::Format { .. }) => continue,
            Err(error) => return Err(error).with_context(|| in_file(&path)),
        };
        for texture in &library.textures {
            if let Some(other) = homes.insert(texture.id.clone(), path.clone()) {
                bail!(
                    "two libraries have a texture \"{}\"; rename one of them: {} and {}",
                    texture.id,
                    other.display(),
                    path.display()
                );
            }
            let license = library.license_of(texture).to_owned();
            merged.textures.push(TextureEntry { license, ..texture.clone() });
        }
        let has_positions = library.textures.iter().any(|texture| texture.place.is_some());
        let stated = Stated { axes: library.axes, path };
        if has_positions {
            check_axes(placed.first(), &stated)?;
            placed.push(stated);
        } else {
            unplaced.push(stated);
        }
    }
    // Axes of a library without positions count only if no library has positions.
    let mut stated = if placed.is_empty() { unplaced } else { placed }.into_iter();
    let Some(Stated { axes, .. }) = stated.next() else {
        bail!("the folder contains no texture library (.json); choose another folder: {}", folder.display());
    };
    merged.axes = axes.filter(|axes| stated.all(|other| other.axes.as_ref() == Some(axes)));
    Ok(merged)
}

/// Checks that the positions of a library can be merged with those of the first one. Positions on two axes were always merged,
/// whatever the axes are.
fn check_axes(first: Option<&Stated>, other: &Stated) -> anyhow::Result<()> {
    let Some(first) = first.filter(|first| first.axes != other.axes) else { return Ok(()) };
    if [&first.axes, &other.axes].into_iter().flatten().any(|axes| axes.len() != USUAL_AXES.len()) {
        bail!(
            "two libraries have positions on different axes; move one of them to another folder: {} and {}",
            first.path.display(),
            other.path.display()
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::load;
    use crate::axes::placed_on;
    use crate::report::Warnings;
    use shagreen_formats::library::{Library, write_library};
    use shagreen_formats::starter::starter_library;

    /// Two libraries of a folder: the first textures of the starter library, and the others, on these axes.
    fn loaded(axes: [Option<&[&str]>; 2]) -> anyhow::Result<Library> {
        let folder = tempfile::tempdir().unwrap();
        let starter = starter_library().unwrap();
        for (index, axes) in axes.into_iter().enumerate() {
            let mut library = starter.clone();
            library.textures.retain(|texture| (starter.index_of(&texture.id) < Some(5)) == (index == 0));
            if let Some(axes) = axes {
                let axes: Vec<String> = axes.iter().map(|axis| (*axis).to_owned()).collect();
                library = placed_on(&library, &axes).unwrap();
            }
            std::fs::write(folder.path().join(format!("{index}.json")), write_library(&library)).unwrap();
        }
        load(Some(folder.path()), &Warnings::default())
    }

    #[test]
    fn libraries_of_a_folder_are_merged_on_common_axes() {
        let three = ["rough-smooth", "hard-soft", "centroid"];
        let swapped = ["hard-soft", "rough-smooth"];
        let library = loaded([Some(&three), Some(&three)]).unwrap();
        assert_eq!((library.axis_names(), library.textures.len()), (three.to_vec(), 25));
        assert_eq!(loaded([Some(&swapped), Some(&swapped)]).unwrap().axis_names(), swapped);
        assert_eq!(loaded([Some(&swapped), None]).unwrap().axes, None);
        let error = loaded([None, Some(&three)]).unwrap_err().to_string();
        assert!(error.contains("different axes") && error.contains("1.json"), "{error}");
    }

    /// A library without positions, such as one of new recordings, has no axes that could differ.
    #[test]
    fn a_library_without_positions_is_merged_with_any_other() {
        let three = ["rough-smooth", "hard-soft", "centroid"];
        let mut placed = placed_on(&starter_library().unwrap(), &three.map(str::to_owned)).unwrap();
        let mut recorded = starter_library().unwrap();
        placed.textures.truncate(5);
        recorded.textures.drain(..5);
        for texture in &mut recorded.textures {
            texture.place = None;
        }
        for names in [["a.json", "b.json"], ["b.json", "a.json"]] {
            let folder = tempfile::tempdir().unwrap();
            for (name, library) in names.into_iter().zip([&placed, &recorded]) {
                std::fs::write(folder.path().join(name), write_library(library)).unwrap();
            }
            let library = load(Some(folder.path()), &Warnings::default()).unwrap();
            assert_eq!((library.axis_names(), library.textures.len()), (three.to_vec(), 25), "{names:?}");
            assert_eq!(library.positions().into_iter().flatten().count(), 5);
        }
    }
}
