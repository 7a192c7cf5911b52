//! `shagreen import`: imports files of any kind, which it recognizes by their content.

use std::path::Path;

use anyhow::bail;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::foreign_file::Found;

use crate::cli::import::files_in;
use crate::cli::import_models::{ModelFile, import_models};
use crate::cli::output::Usage;
use crate::cli::{import_directional, import_hatt, import_recording};
use shagreen_studio::file;
use shagreen_studio::import::{HATT, RECORDING_ENDINGS, format_of_ending};
use shagreen_studio::replace::is_library;

/// Imports texture models, recordings and haptic clips of other programs into a library.
///
/// Files are recognized by their content: recordings (WAV files and tables), haptic clips (.haptic, AHAP, Macaron, and tables
/// of time, amplitude and frequency), models in the XML of HaTT, and libraries. The commands import files of one kind.
#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct ImportArgs {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    files: Option<import_recording::Args>,
}

#[derive(clap::Subcommand)]
enum Command {
    Directional(import_directional::Args),
    Hatt(import_hatt::Args),
    Recording(import_recording::Args),
}

pub(crate) fn run(args: &ImportArgs) -> anyhow::Result<()> {
    match (&args.command, &args.files) {
        (Some(Command::Directional(args)), _) => import_directional::run(args),
        (Some(Command::Hatt(args)), _) => import_hatt::run(args),
        (Some(Command::Recording(args)), _) => import_recording::run(args),
        (None, Some(args)) => import_recognized(args),
        (None, None) => bail!(Usage("name the files to import, and the library with --out".to_owned())),
    }
}

fn import_recognized(args: &import_recording::Args) -> anyhow::Result<()> {
    let (mut models, mut n_others) = (Vec::new(), 0);
    for path in args.files() {
        let found = models_in(path)?;
        n_others += usize::from(found.is_empty());
        models.extend(found);
    }
    if models.is_empty() {
        return import_recording::run(args);
    }
    if n_others > 0 {
        bail!(Usage(format!(
            "{} contains texture models, other files are recordings; import them one after the other",
            models[0].path.display()
        )));
    }
    if let Some(option) = args.only_for_recordings() {
        bail!(Usage(format!(
            "{option} applies only to recordings, but the files contain texture models; leave it out"
        )));
    }
    import_models(&models, args.destination())
}

/// The models in a file, or in a folder without recordings; empty if there are none.
fn models_in(path: &Path) -> anyhow::Result<Vec<ModelFile>> {
    if path.is_dir() {
        let has_recordings = !files_in(path, &RECORDING_ENDINGS)?.is_empty();
        let found = if has_recordings { Vec::new() } else { files_in(path, &["xml"])? };
        return Ok(found.into_iter().map(|path| ModelFile { path, format: HATT }).collect());
    }
    // A file that cannot be read is reported as a recording.
    let Ok(bytes) = file::read_file(path, FileKind::Document) else { return Ok(Vec::new()) };
    let is_xml = Found::of(&bytes) == Found::Kind("an XML or HTML file");
    let ending = if is_xml {
        "xml"
    } else if is_library(&bytes) {
        "json"
    } else {
        return Ok(Vec::new());
    };
    Ok(format_of_ending(ending)
        .map(|format| ModelFile { path: path.to_owned(), format })
        .into_iter()
        .collect())
}
