//! The program without a subcommand: opens the window.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::bail;
use directories::{BaseDirs, ProjectDirs};
use serde_json::json;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_studio::doctor::{DisplayFact, DisplayFacts};
use shagreen_studio::open::{Opened, is_other_kind, is_study_plan, open};
use shagreen_studio::permitted_libraries::{OutsideLibrary, Permitted};
use shagreen_studio::project::new_project;

use crate::cli::displays::displays;
use crate::cli::model_folder::model_folder;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::own_folder;
use shagreen_studio::library::{built_in, load};

/// Function that opens the window and returns its frame times once it is closed.
pub(crate) type OpenWindow = fn(WindowRequest) -> anyhow::Result<FrameTimes>;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project to open, a library (a file or a folder of files) to start a project with, the plan of a study (.toml), or a
    /// recording, model, stroke or photo to take. Default: a new project with the starter library.
    file: Option<PathBuf>,
    /// Output to play on, by id; `shagreen devices` lists them. Default: the output that was last selected in the
    /// window, otherwise the default output of the system.
    #[arg(long, value_name = "ID")]
    output: Option<String>,
    /// Let a simulated participant with this seed take part in the study of the plan, in the window. An interrupted session
    /// of a simulated participant goes on.
    #[arg(long, value_name = "SEED", hide = true)]
    simulate_participant: Option<u64>,
    /// Draw this many frames with the automatic stroke, print their times, and close.
    #[arg(long, value_name = "N", hide = true)]
    measure_frames: Option<usize>,
}

/// Request to open the window.
pub(crate) struct WindowRequest {
    /// Project to show.
    pub(crate) project: Project,
    /// File of the project with its SHA-256; `None` for a new one.
    pub(crate) file: Option<(PathBuf, String)>,
    /// File to take at once: neither a project nor a library, or a project about which the window asks a question first.
    pub(crate) take: Option<PathBuf>,
    /// Id of the output to open; `None` for the default.
    pub(crate) output: Option<String>,
    /// Folders and files of the user.
    pub(crate) folders: UserFolders,
    /// Seed of a simulated participant of the study to open.
    pub(crate) simulation_seed: Option<u64>,
    /// Number of frames to measure before closing; `None` keeps the window open.
    pub(crate) measured_frames: Option<usize>,
    /// Whether the window opens on the X11 display, because the Wayland display does not respond.
    pub(crate) is_on_x11: bool,
    /// Start time of the program.
    pub(crate) started: Instant,
}

/// Folders and files of the user; `None` stores nothing.
#[derive(Default)]
pub(crate) struct UserFolders {
    /// Folder of recovery files.
    pub(crate) recovery: Option<PathBuf>,
    /// File of the settings.
    pub(crate) settings: Option<PathBuf>,
    /// Folder of downloaded networks.
    pub(crate) models: Option<PathBuf>,
    /// Folder of all files that Shagreen keeps for the user; libraries in it are read without a question.
    pub(crate) own: Option<PathBuf>,
    /// Folder in which the desktop keeps its settings.
    pub(crate) desktop: Option<PathBuf>,
}

/// Measured times of a window, in seconds.
#[expect(clippy::struct_field_names, reason = "the ending is the unit")]
pub(crate) struct FrameTimes {
    /// Time from the start of the program to the first frame.
    pub(crate) first_frame_secs: f64,
    /// Layout time of each later frame.
    pub(crate) frame_secs: Vec<f64>,
    /// Time from each later frame to the next.
    pub(crate) interval_secs: Vec<f64>,
}

/// Opens the window with `open_window`; `started` is the start time of the program.
pub(crate) fn run(args: &Args, started: Instant, open_window: OpenWindow) -> anyhow::Result<()> {
    if let Some(file) = args.file.as_deref().filter(|file| built_in(file).is_none() && !file.exists()) {
        bail!("there is no command and no file \"{}\"; `shagreen --help` lists the commands", file.display());
    }
    let is_unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    if cfg!(target_os = "linux") && is_unset("DISPLAY") && is_unset("WAYLAND_DISPLAY") {
        bail!(
            "there is no display for the window (neither DISPLAY nor WAYLAND_DISPLAY is set); \
             the commands work without one: see shagreen --help"
        );
    }
    let is_on_x11 = is_better_on_x11(displays());
    if is_on_x11 {
        output::warn(
            "no Wayland display responds where WAYLAND_DISPLAY says; the window opens on the X11 display",
        );
    }
    let named = args.file.as_deref();
    let is_plan = named.is_some_and(is_study_plan);
    if args.simulate_participant.is_some() && !is_plan {
        bail!("--simulate-participant needs the plan of a study; name its .toml file");
    }
    let is_other = named.is_some_and(|file| (is_plan || is_other_kind(file)) && file.is_file());
    let opened = if is_other { None } else { opened(named)? };
    // What is not opened here, the window takes.
    let take = named.filter(|_| opened.is_none()).map(std::path::absolute).transpose()?;
    let (project, file) = opened.unwrap_or_else(|| (new_project(), None));
    // A measurement writes no user files.
    let folders = if args.measure_frames.is_some() { UserFolders::default() } else { user_folders() };
    let times = open_window(WindowRequest {
        project,
        file,
        take,
        output: args.output.clone(),
        folders,
        simulation_seed: args.simulate_participant,
        measured_frames: args.measure_frames,
        is_on_x11,
        started,
    })?;
    if args.measure_frames.is_some() {
        report(&times);
    }
    Ok(())
}

/// Whether only the X11 display responds, although the environment names a Wayland display too.
fn is_better_on_x11(displays: DisplayFacts) -> bool {
    displays == DisplayFacts { x11: DisplayFact::Responds, wayland: DisplayFact::Silent }
}

/// Project to show, with its file and the SHA-256 of the file.
type Shown = (Project, Option<(PathBuf, String)>);

/// As [`project`]; `None` for a project with a library about which the window must ask.
fn opened(file: Option<&Path>) -> anyhow::Result<Option<Shown>> {
    match project(file) {
        Ok(opened) => Ok(Some(opened)),
        Err(error) if error.is::<OutsideLibrary>() => Ok(None),
        Err(error) => Err(error),
    }
}

/// Returns the project of a file, or a new project with the library of a file; warnings are printed.
fn project(file: Option<&Path>) -> anyhow::Result<Shown> {
    let on = |library: ProjectLibrary| Project { library, ..new_project() };
    let Some(path) = file else { return Ok((new_project(), None)) };
    if let Some(built_in) = built_in(path) {
        return Ok((on(ProjectLibrary::BuiltIn(built_in)), None));
    }
    if path.is_dir() {
        let merged = load(Some(path), &Printed)?;
        return Ok((on(ProjectLibrary::Inside(merged.into())), None));
    }
    match open(path, &Permitted::Only(own_folder().into_iter().collect()))? {
        Opened::Project(opened) => {
            warn_of(&opened.warnings, path);
            // An absolute path is valid from every working directory.
            Ok((opened.project, Some((std::path::absolute(path)?, opened.sha256))))
        }
        Opened::Library(imported) => {
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

fn user_folders() -> UserFolders {
    let Some(folders) = ProjectDirs::from("", "", "shagreen") else { return UserFolders::default() };
    let state = folders.state_dir().unwrap_or_else(|| folders.data_local_dir());
    UserFolders {
        recovery: Some(state.join("recovery")),
        settings: Some(folders.config_dir().join("settings.json")),
        models: model_folder().ok().map(|models| models.path().to_owned()),
        own: own_folder(),
        desktop: BaseDirs::new().map(|folders| folders.config_dir().to_owned()),
    }
}

fn report(times: &FrameTimes) {
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

#[cfg(test)]
mod tests {
    use super::{DisplayFact, DisplayFacts, is_better_on_x11};

    #[test]
    fn the_x11_display_replaces_only_a_wayland_display_that_does_not_respond() {
        use DisplayFact::{Responds, Silent, Unset, Untried};
        for (x11, wayland, expected) in [
            (Responds, Silent, true),
            (Responds, Responds, false),
            (Responds, Unset, false),
            (Silent, Silent, false),
            (Untried, Silent, false),
            (Unset, Silent, false),
        ] {
            assert_eq!(is_better_on_x11(DisplayFacts { x11, wayland }), expected, "{x11:?} {wayland:?}");
        }
    }
}
