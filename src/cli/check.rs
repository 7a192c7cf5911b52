//! `shagreen check`: checks files for other programs against the rules of their formats.

use std::path::{Path, PathBuf};

use anyhow::bail;
use serde_json::{Value, json};
use shagreen_core::words::counted;
use shagreen_studio::check::{Checked, CheckedFormat, check_file};
use shagreen_studio::file::one_line;

use crate::cli::output;

/// Checks files for other programs against the rules of their formats, and lists the broken rules with their places. Checks
/// MPEG haptic files (.hjif), glTF scenes with haptic materials (.gltf), haptic clips (.haptic) and AHAP patterns (.ahap),
/// whichever program wrote them. Of an entry of a pattern, and of the values of a point of a clip, only the first broken rule is
/// listed. A file with a fault does not keep the others from being checked; the exit status is 1 if any file has one.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Files to check.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print the result as one JSON object: that of the file, or of several files a list `files`.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let (mut results, mut texts) = (Vec::new(), Vec::new());
    // Files with faults or that cannot be checked at all, and the number of all faults.
    let (mut n_bad, mut n_faults) = (0, 0);
    for path in &args.files {
        match check_file(path) {
            Ok((format, checked)) => {
                checked.warnings.iter().for_each(|warning| output::warn(warning));
                n_faults += checked.n_faults;
                n_bad += usize::from(checked.n_faults > 0);
                texts.push(text(path, format, &checked));
                results.push(result(path, format, &checked));
            }
            // The only file: its error says all.
            Err(error) if args.files.len() == 1 => return Err(error),
            Err(error) => {
                let reason = one_line(&error);
                n_bad += 1;
                texts.push(format!("not checked: {reason}"));
                results.push(json!({"file": path.display().to_string(), "valid": false, "error": reason}));
            }
        }
    }
    let printed = match results.as_slice() {
        [result] => result.clone(),
        _ => json!({"files": results, "valid": n_bad == 0, "n_invalid": n_bad}),
    };
    output::print(args.json, &printed, || texts.join("\n"));
    match args.files.as_slice() {
        _ if n_bad == 0 => Ok(()),
        [file] => bail!(
            "the file has {}; correct it, or write it again: {}",
            counted(n_faults, "fault"),
            file.display()
        ),
        files => bail!(
            "{n_bad} of {} files have faults or cannot be checked; correct them, or write them again",
            files.len()
        ),
    }
}

fn result(path: &Path, format: CheckedFormat, checked: &Checked) -> Value {
    json!({
        "file": path.display().to_string(),
        "format": format.id,
        "about": checked.about,
        "valid": checked.n_faults == 0,
        "faults": checked.faults,
        "warnings": checked.warnings,
        "n_faults": checked.n_faults,
    })
}

fn text(path: &Path, format: CheckedFormat, checked: &Checked) -> String {
    let kept = if checked.n_faults == 0 { "follows" } else { "breaks" };
    let head = format!("{} {kept} the rules of {}: {}", path.display(), format.name, checked.about);
    [head].into_iter().chain(checked.faults.clone()).collect::<Vec<_>>().join("\n")
}
