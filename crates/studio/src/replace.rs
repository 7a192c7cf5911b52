//! Protection of files: an output replaces no input, and only files of its own kind.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::{Library, TextureEntry, read_library};
use shagreen_formats::text_limits::begin_of;
use shagreen_formats::{library, wav};

use crate::file::shown_name;

/// Longest name of a texture in an error, in characters.
const NAME_IN_ERROR: usize = 60;

/// Returns an error if an output is one of the inputs, or a file of an input folder.
///
/// # Errors
/// An output is an input.
pub fn refuse_inputs(outputs: &[&Path], inputs: &[Option<&Path>]) -> anyhow::Result<()> {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() }; // A file that does not exist is no input.
    for output in outputs {
        let is_it = |input: &&Path| {
            real(output).is_some_and(|o| {
                real(input).is_some_and(|i| i == o || (i.is_dir() && o.parent() == Some(&i)))
            })
        };
        if let Some(input) = inputs.iter().flatten().find(|input| is_it(input)) {
            bail!("the output would overwrite an input file; choose another name: {}", input.display());
        }
    }
    Ok(())
}

/// Returns an error if a signal at `out`, or the sidecar beside it, is one of the inputs.
///
/// # Errors
/// As [`refuse_inputs`]; the message says which file is the sidecar.
pub fn refuse_signal_over_inputs(out: &Path, inputs: &[Option<&Path>]) -> anyhow::Result<()> {
    refuse_inputs(&[out], inputs)?;
    let beside = wav::sidecar_path(out);
    refuse_inputs(&[&beside], inputs).map_err(|_| {
        anyhow::anyhow!(
            "the signal {} gets a sidecar file of the same name with .json, which would overwrite an input; choose another name for the signal: {}",
            shown_name(out),
            beside.display()
        )
    })
}

/// Returns an error if the output would replace a file of another kind: files of this program may be replaced, others
/// may not. `what` names the output in the error.
///
/// # Errors
/// The file at `output` is of another kind.
pub fn refuse_foreign(output: &Path, what: &str, is_ours: impl Fn(&[u8]) -> bool) -> anyhow::Result<()> {
    if !output.is_file() {
        return Ok(()); // It does not exist, or writing it fails.
    }
    let Ok(bytes) = bounded_file::read(output, FileKind::Recording) else { return Ok(()) }; // Writing an unreadable file reports the error.
    if is_ours(&bytes) {
        return Ok(());
    }
    bail!(
        "{what} would replace a file of another kind; choose another name, or move that file: {}",
        output.display()
    );
}

/// Returns whether a signal may replace the file at `path` with these bytes: only a WAV file that has a sidecar of this
/// program next to it.
pub fn is_own_signal(path: &Path, bytes: &[u8]) -> bool {
    let is_wave = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE");
    is_wave
        && bounded_file::read(&wav::sidecar_path(path), FileKind::Small)
            .is_ok_and(|beside| is_sidecar(&beside))
}

/// Returns an error if a signal would replace a file that is no signal of this program, or whose sidecar is another file.
///
/// # Errors
/// As [`refuse_foreign`].
pub fn refuse_foreign_signal(out: &Path) -> anyhow::Result<()> {
    refuse_foreign(&wav::sidecar_path(out), "the signal's sidecar", is_sidecar)?;
    refuse_foreign(out, "the signal", |bytes| is_own_signal(out, bytes))
}

/// Returns an error if `library` would replace a library at `output` that has textures which `library` has not.
///
/// # Errors
/// Textures would be lost.
pub fn refuse_lost_textures(output: &Path, library: &Library) -> anyhow::Result<()> {
    if !output.is_file() {
        return Ok(()); // Nothing is there, or writing it fails.
    }
    let present = bounded_file::read(output, FileKind::Document)
        .map_err(anyhow::Error::from)
        .and_then(|bytes| Ok(read_library(&bytes)?));
    let Ok(present) = present else {
        bail!("the file there is not a library that can be read; choose another name: {}", output.display());
    };
    let stays = |lost: &&TextureEntry| library.textures.iter().any(|texture| texture.id == lost.id);
    let lost: Vec<&TextureEntry> = present.value.textures.iter().filter(|texture| !stays(texture)).collect();
    let Some(first) = lost.first() else { return Ok(()) };
    bail!(
        "the library there has {} textures that the new one has not, such as \"{}\"; choose another name: {}",
        lost.len(),
        begin_of(first.name.clone(), NAME_IN_ERROR),
        output.display()
    );
}

/// Returns whether a file is the sidecar of a signal.
pub fn is_sidecar(bytes: &[u8]) -> bool {
    has_format(bytes, wav::FORMAT)
}

/// Returns whether a file is a texture library of any version.
pub fn is_library(bytes: &[u8]) -> bool {
    has_format(bytes, library::FORMAT)
}

/// Returns whether a file is a JSON object with this value of `format`.
pub fn has_format(bytes: &[u8], format: &str) -> bool {
    let header: Option<serde_json::Value> = serde_json::from_slice(bytes).ok();
    header.and_then(|h| h.get("format").cloned()) == Some(format.into())
}
