//! `shagreen import`: models and recordings of other programs, into a library.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, TextureEntry, read_library, write_library};

use crate::cli::guard::refuse_inputs;
use crate::cli::output;

/// Where imported textures go.
#[derive(clap::Args)]
pub(crate) struct Destination {
    /// Library file to write; where it exists, the textures are added to it.
    #[arg(long, value_name = "L")]
    out: PathBuf,
    /// Textures of the same id in the library are replaced.
    #[arg(long)]
    replace: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl Destination {
    /// The library that the textures are added to, before any work is done: the one that is there, or a new one.
    ///
    /// # Errors
    /// The file is one of the inputs, or is there and no library.
    pub(crate) fn open(&self, inputs: &[PathBuf]) -> anyhow::Result<Library> {
        let inputs: Vec<Option<&Path>> = inputs.iter().map(|path| Some(path.as_path())).collect();
        refuse_inputs(&[&self.out], &inputs)?;
        existing(&self.out)
    }
}

/// What became of the files.
#[derive(Default)]
pub(crate) struct Outcome {
    imported: Vec<(TextureEntry, Value)>,
    failed: Vec<(PathBuf, String)>,
    warnings: Vec<String>,
}

impl Outcome {
    /// A texture came of a file; `figures` are shown beside its id.
    pub(crate) fn imported(&mut self, texture: TextureEntry, figures: Value) {
        self.imported.push((texture, figures));
    }

    /// A file is of no use.
    pub(crate) fn failed(&mut self, file: &Path, reason: String) {
        output::warn(&format!("not imported: {reason}: {}", file.display()));
        self.failed.push((file.to_owned(), reason));
    }

    /// Something about a file is odd but usable.
    pub(crate) fn warn(&mut self, file: &Path, message: &str) {
        self.warn_of_all(format!("{}: {message}", file.display()));
    }

    /// Something is to be known that concerns no single file.
    pub(crate) fn warn_of_all(&mut self, message: String) {
        output::warn(&message);
        self.warnings.push(message);
    }

    /// Writes `library` with the textures and says what was done.
    ///
    /// # Errors
    /// Nothing was imported, or the library cannot be written.
    pub(crate) fn finish(
        mut self,
        mut library: Library,
        destination: &Destination,
        more: Value,
    ) -> anyhow::Result<()> {
        let mut textures = Vec::new();
        for (mut texture, figures) in std::mem::take(&mut self.imported) {
            match library.index_of(&texture.id) {
                Some(index) if destination.replace => library.textures[index] = texture.clone(),
                taken => {
                    if taken.is_some() {
                        let free = library.free_id(&texture.id);
                        let message = format!(
                            "the library already has \"{}\": this one became \"{free}\"; --replace puts it in its place",
                            texture.id
                        );
                        self.warn_of_all(message);
                        texture.id = free;
                    }
                    library.textures.push(texture.clone());
                }
            }
            textures.push(with_id(&texture, figures));
        }
        let n_imported = textures.len();
        if n_imported > 0 {
            atomic::write(&destination.out, &write_library(&library))?;
        }
        let failed: Vec<Value> = self
            .failed
            .iter()
            .map(|(file, reason)| json!({"file": file.display().to_string(), "reason": reason}))
            .collect();
        let mut result = json!({
            "out": destination.out.display().to_string(),
            "imported": n_imported,
            "failed": failed,
            "warnings": self.warnings,
            "textures": textures,
        });
        if let (Some(result), Value::Object(more)) = (result.as_object_mut(), more) {
            result.extend(more);
        }
        // A script reads what failed and what was asked; a person has read it already.
        if destination.json || n_imported > 0 {
            output::print(destination.json, &result, || {
                format!(
                    "Imported {n_imported} of {}: {}",
                    n_imported + failed.len(),
                    destination.out.display()
                )
            });
        }
        if n_imported == 0 {
            bail!("nothing was imported; the reasons stand above");
        }
        Ok(())
    }
}

/// The library at `path`, or a new one.
fn existing(path: &Path) -> anyhow::Result<Library> {
    if !path.exists() {
        return Ok(Library {
            name: path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
            created_by: output::CREATED_BY.to_owned(),
            ..Library::default()
        });
    }
    let bytes = output::read_file(path)?;
    let read = read_library(&bytes).with_context(|| output::in_file(path))?;
    Ok(read.value)
}

fn with_id(texture: &TextureEntry, mut figures: Value) -> Value {
    figures["id"] = json!(texture.id);
    figures["name"] = json!(texture.name);
    figures
}
