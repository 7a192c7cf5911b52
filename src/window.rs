//! Opens the window. This is the only file that uses both the command line and the window.

use shagreen_app::session::OutputChoice;
use shagreen_app::state::document::DocumentFile;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::{Begin, Start};

use crate::cli::window::{FrameTimes, WindowRequest};

/// Opens the window and returns its frame times once it is closed.
///
/// # Errors
/// The window cannot be opened, or the library's positions cannot be triangulated.
pub(crate) fn open(request: WindowRequest) -> anyhow::Result<FrameTimes> {
    let WindowRequest {
        project,
        file,
        take,
        output,
        folders,
        simulation_seed,
        measured_frames,
        is_on_x11,
        started,
    } = request;
    let output = output.map_or(OutputChoice::SystemDefault, OutputChoice::Id);
    let keeping = StoragePaths {
        recovery: folders.recovery,
        settings: folders.settings,
        models: folders.models,
        own: folders.own,
        desktop: folders.desktop,
    };
    let file = file.map(|(path, sha256)| DocumentFile { path, sha256: Some(sha256) });
    let begin = Begin { project, file, take, output, keeping, simulation_seed };
    let times = shagreen_app::run(Start { begin, measured_frames, is_on_x11, started })?;
    Ok(FrameTimes {
        first_frame_secs: times.first_frame_secs,
        frame_secs: times.frame_secs,
        interval_secs: times.interval_secs,
    })
}
