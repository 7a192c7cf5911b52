//! No subcommand: the window.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::bail;
use directories::ProjectDirs;
use serde_json::json;
use shagreen_app::document::{Read, read_file};
use shagreen_app::files::Keeping;
use shagreen_app::session::OutputChoice;
use shagreen_app::window::new_project;
use shagreen_app::{Begin, Start, WindowTimes};
use shagreen_formats::project::{Project, ProjectLibrary};

use crate::cli::library_source::{LibraryArgs, built_in, load};
use crate::cli::model_folder::model_folder;
use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project to open, or a library (a file, or a folder of them) to begin one with; without it a new project on the
    /// starter library.
    file: Option<PathBuf>,
    /// Output to open, by its id; `shagreen devices` lists them. Without it the one that was chosen last in the window, and
    /// before any was, the system's default of the moment.
    #[arg(long, value_name = "ID")]
    output: Option<String>,
    /// Draw this many frames with the hand stroking, print how long they took, and close.
    #[arg(long, value_name = "N", hide = true)]
    measure_frames: Option<usize>,
}

/// Opens the window; `started` is when the program did.
pub(crate) fn run(args: &Args, started: Instant) -> anyhow::Result<()> {
    let is_unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    if cfg!(target_os = "linux") && is_unset("DISPLAY") && is_unset("WAYLAND_DISPLAY") {
        bail!(
            "there is no display to open the window on (neither DISPLAY nor WAYLAND_DISPLAY is set); \
             the commands work without one: see shagreen --help"
        );
    }
    let (project, path) = project(args.file.as_deref())?;
    let output = args.output.clone().map_or(OutputChoice::SystemDefault, OutputChoice::Id);
    // A measurement leaves nothing behind.
    let keeping = if args.measure_frames.is_some() { Keeping::default() } else { keeping() };
    let begin = Begin { project, path, output, keeping };
    let times = shagreen_app::run(Start { begin, measured_frames: args.measure_frames, started })?;
    if args.measure_frames.is_some() {
        report(&times);
    }
    Ok(())
}

/// The project of a file, or a new one on the library of a file; what is odd about it is said.
fn project(file: Option<&Path>) -> anyhow::Result<(Project, Option<PathBuf>)> {
    let on = |library: ProjectLibrary| Project { library, ..new_project() };
    let Some(path) = file else { return Ok((new_project(), None)) };
    if let Some(built_in) = built_in(path) {
        return Ok((on(ProjectLibrary::BuiltIn(built_in)), None));
    }
    if path.is_dir() {
        let merged = load(&LibraryArgs::at(Some(path.to_owned())))?;
        return Ok((on(ProjectLibrary::Inside(merged.into())), None));
    }
    match read_file(path)? {
        Read::Project(imported) => {
            warn_of(&imported.warnings, path);
            // Remembered so that it is found from every folder.
            Ok((imported.value, Some(std::path::absolute(path)?)))
        }
        Read::Library(imported) => {
            warn_of(&imported.warnings, path);
            Ok((on(ProjectLibrary::File(imported.value.into())), None))
        }
    }
}

fn warn_of(warnings: &[String], path: &Path) {
    for warning in warnings {
        output::warn(&format!("{warning}: {}", path.display()));
    }
}

/// Where the system keeps settings and unsaved work; nothing is kept where it has no such places.
fn keeping() -> Keeping {
    let Some(folders) = ProjectDirs::from("", "", "shagreen") else { return Keeping::default() };
    let state = folders.state_dir().unwrap_or_else(|| folders.data_local_dir());
    Keeping {
        recovery: Some(state.join("recovery")),
        settings: Some(folders.config_dir().join("settings.json")),
        models: model_folder().ok().map(|models| models.path().to_owned()),
    }
}

fn report(times: &WindowTimes) {
    let quantile = |secs: &[f64], share: f64| {
        let mut sorted = secs.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.get((share * (sorted.len().saturating_sub(1)) as f64) as usize).map_or(0.0, |s| 1e3 * s)
    };
    let result = json!({
        "first_frame_ms": 1e3 * times.first_frame_secs,
        "frames": times.frame_secs.len(),
        "layout_ms_median": quantile(&times.frame_secs, 0.5),
        "layout_ms_p95": quantile(&times.frame_secs, 0.95),
        "interval_ms_median": quantile(&times.interval_secs, 0.5),
        "interval_ms_p95": quantile(&times.interval_secs, 0.95),
    });
    output::print(true, &result, String::new);
}
