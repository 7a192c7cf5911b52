//! No subcommand: the window.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use serde_json::json;
use shagreen_app::session::OutputChoice;
use shagreen_app::{Start, WindowTimes};

use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// Library file, or a folder of them, to author from; without it the starter library.
    file: Option<PathBuf>,
    /// Output to open, by its id; `shagreen devices` lists them. Without it the system's default of the moment.
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
    let library = load(&LibraryArgs::at(args.file.clone()))?;
    let output = args.output.clone().map_or(OutputChoice::SystemDefault, OutputChoice::Id);
    let times = shagreen_app::run(Start { library, output, measured_frames: args.measure_frames, started })?;
    if args.measure_frames.is_some() {
        report(&times);
    }
    Ok(())
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
