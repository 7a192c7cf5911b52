//! What is said of a recording beside it: answers on the command line, and the file of units.

use std::path::Path;

use shagreen_formats::recording::Ask;
use shagreen_formats::wav;

use crate::cli::output::file_name;

/// An answer to a question, as KEY=VALUE.
pub(crate) fn parse_answer(text: &str) -> Result<(Ask, String), String> {
    let (key, value) = text.split_once('=').ok_or("write KEY=VALUE as in acceleration_unit=g")?;
    let what = Ask::from_key(key.trim()).ok_or_else(|| {
        let keys: Vec<&str> = Ask::ALL.iter().map(|ask| ask.key()).collect();
        format!("there is no question \"{}\"; the keys are {}", key.trim(), keys.join(", "))
    })?;
    Ok((what, value.trim().to_owned()))
}

/// The bytes of the file of units beside a WAV file; most have none.
pub(crate) fn sidecar(file: &Path) -> Result<Option<Vec<u8>>, String> {
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav")) {
        return Ok(None);
    }
    for name in wav::sidecar_names(&file_name(file)) {
        match std::fs::read(file.with_file_name(&name)) {
            Ok(bytes) => return Ok(Some(bytes)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => {
                return Err(format!("the sidecar {name} cannot be read ({error}); check your rights"));
            }
        }
    }
    Ok(None)
}
