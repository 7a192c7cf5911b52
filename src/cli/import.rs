//! `shagreen import`: imports models and recordings of other programs into a library.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::{Library, TextureEntry, free_id, id_from_name, read_library, write_library};
use shagreen_formats::locked_update::update;

use crate::cli::out_name::refuse_dash;
use crate::cli::output;
use shagreen_studio::file;
use shagreen_studio::replace::refuse_inputs;

/// Library that textures are imported into.
#[derive(clap::Args)]
pub(crate) struct Destination {
    /// Library file to write; if it exists, the textures are added to it.
    #[arg(long, value_name = "L")]
    out: PathBuf,
    /// Replace textures of the library that have the same id.
    #[arg(long)]
    replace: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Result of an import.
pub(crate) struct Outcome<'a> {
    destination: &'a Destination,
    library: Library,
    /// Identifiers of the textures of this import.
    claimed: Vec<String>,
    imported: Vec<(TextureEntry, Value)>,
    failed: Vec<(PathBuf, String)>,
    warnings: Vec<String>,
    notes: Vec<String>,
}

impl<'a> Outcome<'a> {
    /// Creates an empty result, and reads the library if it exists.
    ///
    /// # Errors
    /// The library would overwrite an input, or the file exists and is not a library.
    pub(crate) fn new(destination: &'a Destination, inputs: &[PathBuf]) -> anyhow::Result<Self> {
        refuse_dash(&destination.out)?;
        let inputs: Vec<Option<&Path>> = inputs.iter().map(|path| Some(path.as_path())).collect();
        refuse_inputs(&[&destination.out], &inputs)?;
        if destination.out.is_dir() {
            let example = destination.out.join("mine.json");
            bail!(output::Usage(format!(
                "--out is a folder; give a file in it, such as {}: {}",
                example.display(),
                destination.out.display()
            )));
        }
        let library = existing(&destination.out)?;
        let (claimed, imported, failed, warnings, notes) = Default::default();
        Ok(Self { destination, library, claimed, imported, failed, warnings, notes })
    }

    /// Returns an identifier for a texture with this name: a free one, or that of the texture to replace.
    pub(crate) fn claim_id(&mut self, name: &str) -> String {
        let wanted = id_from_name(name);
        let is_claimed = |id: &str| self.claimed.iter().any(|claimed| claimed == id);
        let is_kept = |id: &str| self.library.index_of(id).is_some() && !self.destination.replace;
        let id = free_id(&wanted, |id| is_claimed(id) || is_kept(id));
        if id != wanted {
            let hint = if is_kept(&wanted) { "; --replace replaces the existing one" } else { "" };
            self.warn_of_all(format!(
                "a texture \"{wanted}\" already exists: this one gets the id \"{id}\"{hint}"
            ));
        }
        self.claimed.push(id.clone());
        id
    }

    /// Adds a texture whose identifier was claimed; `figures` are its fields in the result.
    pub(crate) fn imported(&mut self, texture: TextureEntry, figures: Value) {
        self.imported.push((texture, figures));
    }

    /// Records a file that cannot be imported.
    pub(crate) fn failed(&mut self, file: &Path, reason: String) {
        output::warn(&format!("not imported: {reason}: {}", file.display()));
        self.failed.push((file.to_owned(), reason));
    }

    /// Records a warning about a file.
    pub(crate) fn warn(&mut self, file: &Path, message: &str) {
        self.warn_of_all(format!("{}: {message}", file.display()));
    }

    /// Records a note about a file.
    pub(crate) fn note(&mut self, file: &Path, message: &str) {
        let note = format!("{}: {message}", file.display());
        output::note(&note);
        self.notes.push(note);
    }

    /// Records a warning that concerns no single file.
    pub(crate) fn warn_of_all(&mut self, message: String) {
        output::warn(&message);
        self.warnings.push(message);
    }

    /// Writes the library with the imported textures and prints the result.
    ///
    /// # Errors
    /// Nothing was imported, or the library cannot be written.
    pub(crate) fn finish(self, more: Value) -> anyhow::Result<()> {
        let Self { destination, library, imported, mut warnings, .. } = self;
        let mut textures = Vec::new();
        if !imported.is_empty() {
            // Recordings take seconds to read: another process may have added textures since the library was read.
            let written = update(&destination.out, FileKind::Document, |present| {
                let now = match present {
                    Some(bytes) => parsed(bytes, &destination.out)?,
                    None => library.clone(),
                };
                let joined =
                    joined(now, imported, |id| !destination.replace && library.index_of(id).is_none());
                textures = joined.figures;
                for warning in joined.warnings {
                    output::warn(&warning);
                    warnings.push(warning);
                }
                anyhow::Ok(write_library(&joined.library))
            });
            written??;
        }
        let n_imported = textures.len();
        let failed: Vec<Value> = self
            .failed
            .iter()
            .map(|(file, reason)| json!({"file": file.display().to_string(), "reason": reason}))
            .collect();
        let mut result = json!({
            "out": destination.out.display().to_string(),
            "imported": n_imported,
            "failed": failed,
            "warnings": warnings,
            "notes": self.notes,
            "textures": textures,
        });
        if let (Some(result), Value::Object(more)) = (result.as_object_mut(), more) {
            result.extend(more);
        }
        // A script needs the failures and questions; a person has already read them.
        if destination.json || n_imported > 0 {
            output::print(destination.json, &result, || {
                let ids: Vec<&str> = textures.iter().filter_map(|texture| texture["id"].as_str()).collect();
                let left_out = match failed.len() {
                    0 => String::new(),
                    n => format!("; not imported: {}", counted(n, "file")),
                };
                format!(
                    "Imported {} ({}){left_out}: {}",
                    counted(n_imported, "texture"),
                    ids.join(", "),
                    destination.out.display()
                )
            });
        }
        if n_imported == 0 {
            bail!("nothing was imported; the warnings above give the reasons");
        }
        Ok(())
    }
}

/// Returns the files in a folder with one of these endings, sorted by name.
pub(crate) fn files_in(folder: &Path, endings: &[&str]) -> anyhow::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)
        .context("cannot list the folder; check its name and your permissions")
        .with_context(|| file::in_file(folder))?;
    let is_wanted = |path: &PathBuf| {
        path.extension().is_some_and(|ending| endings.iter().any(|e| ending.eq_ignore_ascii_case(e)))
            && !path.is_dir()
    };
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(is_wanted).collect();
    found.sort();
    Ok(found)
}

/// Reads the library at `path`, or creates a new one.
fn existing(path: &Path) -> anyhow::Result<Library> {
    if !path.exists() {
        file::check_ending("a library", "json", path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            bail!(
                "the folder of the library file does not exist; create it, or choose another: {}",
                folder.display()
            );
        }
        return Ok(Library {
            name: path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
            created_by: output::CREATED_BY.to_owned(),
            ..Library::default()
        });
    }
    parsed(&file::read_file(path, FileKind::Document)?, path)
}

fn parsed(bytes: &[u8], path: &Path) -> anyhow::Result<Library> {
    Ok(read_library(bytes).with_context(|| file::in_file(path))?.value)
}

/// Library with imported textures.
struct Joined {
    library: Library,
    /// Fields of each texture in the result.
    figures: Vec<Value>,
    warnings: Vec<String>,
}

/// Adds textures to a library. A texture with the same id is replaced, unless it `is_new`: then another process added it
/// meanwhile, and both are kept.
fn joined(
    mut library: Library,
    imported: Vec<(TextureEntry, Value)>,
    is_new: impl Fn(&str) -> bool,
) -> Joined {
    let (mut figures, mut warnings) = (Vec::new(), Vec::new());
    let added_meanwhile: Vec<String> =
        library.textures.iter().map(|texture| texture.id.clone()).filter(|id| is_new(id)).collect();
    let claimed: Vec<String> = imported.iter().map(|(texture, _)| texture.id.clone()).collect();
    for (mut texture, of_texture) in imported {
        if added_meanwhile.contains(&texture.id) {
            let id = free_id(&texture.id, |id| {
                library.index_of(id).is_some() || claimed.iter().any(|claimed| claimed == id)
            });
            warnings.push(format!(
                "another program added a texture \"{}\" to the library meanwhile: this one gets the id \"{id}\"",
                texture.id
            ));
            texture.id = id;
        }
        figures.push(with_id(&texture, of_texture));
        match library.index_of(&texture.id) {
            Some(index) => library.textures[index] = texture,
            None => library.textures.push(texture),
        }
    }
    Joined { library, figures, warnings }
}

fn with_id(texture: &TextureEntry, mut figures: Value) -> Value {
    figures["id"] = json!(texture.id);
    figures["name"] = json!(texture.name);
    figures
}
