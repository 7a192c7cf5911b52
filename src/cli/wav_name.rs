//! Names of WAV files to write.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::bail;

/// Checks the name of a WAV file to write: another ending would promise another format. A name may have no ending.
pub(crate) fn check_wav_name(path: &Path) -> anyhow::Result<()> {
    match path.extension().and_then(OsStr::to_str) {
        Some(ending) if !ending.eq_ignore_ascii_case("wav") => {
            bail!(
                "only WAV files are written, not .{ending}; choose a name ending in .wav: {}",
                path.display()
            )
        }
        _ => Ok(()),
    }
}
