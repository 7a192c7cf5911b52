//! What a command must not write over: the files that it reads, and a neighbor that is not its own.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_formats::{library, wav};

/// Refuses an output that is one of the inputs, or a file of an input folder.
pub(crate) fn refuse_inputs(outputs: &[&Path], inputs: &[Option<&Path>]) -> anyhow::Result<()> {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() }; // What does not exist is nobody's input.
    for output in outputs {
        let is_it = |input: &&Path| {
            real(output).is_some_and(|o| {
                real(input).is_some_and(|i| i == o || (i.is_dir() && o.parent() == Some(&i)))
            })
        };
        if let Some(input) = inputs.iter().flatten().find(|input| is_it(input)) {
            bail!("this would write over the file that is read; choose another name: {}", input.display());
        }
    }
    Ok(())
}

/// Refuses to replace a file that is not of the kind which is written: what the program wrote may be replaced, somebody's
/// notes may not. `what` is what would be written.
pub(crate) fn refuse_foreign(
    output: &Path,
    what: &str,
    is_ours: impl Fn(&[u8]) -> bool,
) -> anyhow::Result<()> {
    if !output.is_file() {
        return Ok(()); // Not there, or refused on writing.
    }
    let Ok(bytes) = std::fs::read(output) else { return Ok(()) }; // What cannot be read is told on writing.
    if is_ours(&bytes) {
        return Ok(());
    }
    bail!(
        "{what} would replace a file that is something else; choose another name, or move that file: {}",
        output.display()
    );
}

/// Whether a file is the sidecar of a signal.
pub(crate) fn is_sidecar(bytes: &[u8]) -> bool {
    has_format(bytes, wav::FORMAT)
}

/// Whether a file is a library of textures, of whatever version.
pub(crate) fn is_library(bytes: &[u8]) -> bool {
    has_format(bytes, library::FORMAT)
}

/// Whether a file is a JSON object that says that it has this format.
pub(crate) fn has_format(bytes: &[u8], format: &str) -> bool {
    let header: Option<serde_json::Value> = serde_json::from_slice(bytes).ok();
    header.and_then(|h| h.get("format").cloned()) == Some(format.into())
}
