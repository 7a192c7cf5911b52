//! `shagreen check`: checks a file for other programs against the rules of its format.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_core::words::counted;
use shagreen_studio::check::{Checked, check_file};

use crate::cli::output;

/// Checks a file for other programs against the rules of its format, and lists the broken rules with their places. Checks MPEG
/// haptic files (.hjif), glTF scenes with haptic materials (.gltf), haptic clips (.haptic) and AHAP patterns (.ahap), whichever
/// program wrote them. Of a clip or a pattern, only the first broken rule is listed.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// File to check.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let (format, Checked { about, faults, warnings, n_faults }) = check_file(&args.file)?;
    for warning in &warnings {
        output::warn(warning);
    }
    let file = args.file.display().to_string();
    output::print(
        args.json,
        &json!({
            "file": file,
            "format": format.id,
            "about": about,
            "valid": n_faults == 0,
            "faults": faults,
            "warnings": warnings,
            "n_faults": n_faults,
        }),
        || {
            let kept = if n_faults == 0 { "follows" } else { "breaks" };
            let head = format!("{file} {kept} the rules of {}: {about}", format.name);
            [head].into_iter().chain(faults.clone()).collect::<Vec<_>>().join("\n")
        },
    );
    if n_faults > 0 {
        bail!("the file has {}; correct it, or write it again: {file}", counted(n_faults, "fault"));
    }
    Ok(())
}
