//! Where textures come from: a library file, a folder of them, or the starter library built into the program.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::space::LabelSource;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, LibraryError, TextureEntry, read_library};

use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct LibraryArgs {
    /// Library file, or a folder of them; without it the starter library. "simulated" is the starter library as a
    /// simulated panel sorted and rated it.
    #[arg(long, value_name = "L")]
    library: Option<PathBuf>,
}

impl LibraryArgs {
    /// The file or folder that was named.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.library.as_deref()
    }

    /// As if `path` had been given.
    pub(crate) fn at(path: Option<PathBuf>) -> Self {
        Self { library: path }
    }
}

/// The library that the arguments name; what is odd about it is said.
pub(crate) fn load(args: &LibraryArgs) -> anyhow::Result<Library> {
    let library = match &args.library {
        None => BuiltIn::Starter.read()?,
        Some(path) => match built_in(path) {
            Some(built_in) => built_in.read()?,
            None if path.is_dir() => load_folder(path)?,
            None => load_file(path)?.with_context(|| output::in_file(path))?,
        },
    };
    let sources: Vec<&str> = library.label_sources().into_iter().map(LabelSource::label).collect();
    if sources.len() > 1 {
        output::warn(&format!(
            "the positions come from different sources ({}): what lies between textures of two sources means little; \
             `shagreen library list` says which is which",
            sources.join(", ")
        ));
    }
    Ok(library)
}

/// The library of the program that a name stands for, where no file has it: only the second needs one.
pub(crate) fn built_in(path: &Path) -> Option<BuiltIn> {
    let built_in = BuiltIn::from_id(path.to_str()?).filter(|built_in| *built_in == BuiltIn::Simulated);
    built_in.filter(|_| !path.exists())
}

/// A library file; the inner error is for bytes that are none, and still lacks the path.
fn load_file(path: &Path) -> anyhow::Result<Result<Library, LibraryError>> {
    let bytes = output::read_file(path)?;
    Ok(read_library(&bytes).map(|imported| {
        for warning in &imported.warnings {
            output::warn(&format!("{warning}: {}", path.display()));
        }
        imported.value
    }))
}

/// All library files of a folder as one; other files are left alone.
fn load_folder(folder: &Path) -> anyhow::Result<Library> {
    let list = || -> std::io::Result<Vec<PathBuf>> {
        std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
    };
    let mut paths = list()
        .context("cannot read the folder; check your rights")
        .with_context(|| output::in_file(folder))?;
    paths.retain(|path| path.is_file() && path.extension().is_some_and(|extension| extension == "json"));
    paths.sort();
    let mut merged = Library { name: folder.display().to_string(), ..Library::default() };
    let mut homes: HashMap<String, PathBuf> = HashMap::new();
    let mut n_libraries = 0;
    for path in paths {
        let library = match load_file(&path)? {
            Ok(library) => library,
            // The sidecar of a signal, or JSON of any other program.
            Err(LibraryError::Format { .. }) => continue,
            Err(error) => return Err(error).with_context(|| output::in_file(&path)),
        };
        n_libraries += 1;
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
    }
    if n_libraries == 0 {
        bail!("the folder holds no texture library (.json); name another: {}", folder.display());
    }
    Ok(merged)
}
