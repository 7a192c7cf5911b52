//! What a command must not write over: the files that it reads, and a neighbor that is not its own.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_formats::wav;

/// Refuses an output that is one of the inputs.
pub(crate) fn refuse_inputs(outputs: &[&Path], inputs: &[Option<&Path>]) -> anyhow::Result<()> {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() }; // What does not exist is nobody's input.
    for output in outputs {
        let is_it = |input: &&Path| real(output).is_some_and(|o| real(input) == Some(o));
        if let Some(input) = inputs.iter().flatten().find(|input| is_it(input)) {
            bail!("this would write over the file that is read; choose another name: {}", input.display());
        }
    }
    Ok(())
}

/// Refuses a sidecar that would replace a file which is none: a signal's description may be replaced with its signal,
/// somebody's notes may not.
pub(crate) fn refuse_foreign_sidecar(sidecar: &Path) -> anyhow::Result<()> {
    if !sidecar.is_file() {
        return Ok(()); // Not there, or refused on writing.
    }
    let Ok(bytes) = std::fs::read(sidecar) else { return Ok(()) }; // What cannot be read is told on writing.
    let header: Option<serde_json::Value> = serde_json::from_slice(&bytes).ok();
    if header.and_then(|h| h.get("format").cloned()) == Some(wav::FORMAT.into()) {
        return Ok(());
    }
    bail!(
        "the signal's sidecar would replace a file that is no sidecar; choose another name for the signal: {}",
        sidecar.display()
    );
}
