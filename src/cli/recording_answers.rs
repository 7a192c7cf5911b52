//! Information about a recording outside its file: answers on the command line, and the sidecar with units.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::map_toml::read_map;
use shagreen_formats::recording::{Ask, ColumnMap};
use shagreen_formats::wav;

use crate::cli::output;
use shagreen_studio::file::{self, file_name};

/// Parses an answer to a question, as KEY=VALUE.
pub(crate) fn parse_answer(text: &str) -> Result<(Ask, String), String> {
    let (key, value) = text.split_once('=').ok_or("write KEY=VALUE as in acceleration_unit=g")?;
    let what = Ask::from_key(key.trim()).ok_or_else(|| {
        let keys: Vec<&str> = Ask::ALL.iter().map(|ask| ask.key()).collect();
        format!("there is no key \"{}\"; the keys are {}", key.trim(), keys.join(", "))
    })?;
    Ok((what, value.trim().to_owned()))
}

/// Returns the column map that the arguments specify.
pub(crate) fn map_of(path: Option<&Path>, answers: &[(Ask, String)]) -> anyhow::Result<ColumnMap> {
    let mut map = match path {
        None => ColumnMap::default(),
        Some(path) => {
            read_map(&file::read_file(path, FileKind::Small)?).with_context(|| file::in_file(path))?
        }
    };
    for (i, (what, answer)) in answers.iter().enumerate() {
        if let Some((_, other)) =
            answers[..i].iter().find(|(earlier, other)| earlier == what && other != answer)
        {
            bail!(output::Usage(format!(
                "--set gives two values for {}: {other} and {answer}; give one",
                what.key()
            )));
        }
        let before = map.clone();
        map.answer(*what, answer).map_err(|error| output::Usage(error.to_string()))?;
        for (column, now) in [(before.speed, &map.speed), (before.force, &map.force)] {
            if let (Some(column), None) = (column, now) {
                output::note(&format!("--set {}={answer} overrides {column} of the column map", what.key()));
            }
        }
    }
    Ok(map)
}

/// Returns the bytes of a WAV file's sidecar with units; `None` if there is none.
pub(crate) fn sidecar(file: &Path) -> Result<Option<Vec<u8>>, String> {
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav")) {
        return Ok(None);
    }
    for name in wav::sidecar_names(&file_name(file)) {
        match bounded_file::read(&file.with_file_name(&name), FileKind::Small) {
            Ok(bytes) => return Ok(Some(bytes)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => {
                return Err(format!("the sidecar {name} cannot be read ({error}); check your permissions"));
            }
        }
    }
    Ok(None)
}
