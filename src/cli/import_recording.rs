//! `shagreen import recording`: fits texture models to recorded strokes.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::{self, FitReport, Fitted, MODEL_RATES_HZ};
use shagreen_formats::atomic;
use shagreen_formats::fit_report::{fit_report_csv, fit_report_svg, is_fit_report_csv, is_fit_report_svg};
use shagreen_formats::library::{TextureEntry, name_from_file};
use shagreen_formats::recording::{Ask, ColumnMap};

use crate::cli::fit_args::{FitArgs, tap_json, tap_text};
use crate::cli::import::{Destination, Outcome, files_in};
use crate::cli::progress::Progress;
use crate::cli::recording_answers::{map_of, parse_answer};
use crate::cli::recording_source::read_recording_file;
use shagreen_studio::file::{self, file_name};
use shagreen_studio::import::RECORDING_ENDINGS;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Fits texture models to recorded strokes: acceleration, speed and force, as WAV files or tables.
///
/// If a file does not state a property, such as the unit of acceleration, the command infers it from the data where
/// possible and prints a warning. Otherwise it rejects the file until you state the property with --set or --map.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Recordings: .wav, or tables such as .csv and .txt, or folders of them. Each file becomes a texture.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    destination: Destination,
    /// Column map: a TOML file that states the columns and their units.
    #[arg(long, value_name = "MAP.toml")]
    map: Option<PathBuf>,
    /// State a property that a file does not contain, for example acceleration_unit=g or speed="100 mm/s"; overrides
    /// the column map. Can be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_answer)]
    answers: Vec<(Ask, String)>,
    /// Treat all files as strokes on one texture with this name.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    #[command(flatten)]
    fit: FitArgs,
    /// License of the textures, for example an SPDX expression.
    #[arg(long, default_value = "", hide_default_value = true)]
    licence: String,
    /// Folder for a page of plots (SVG) and a table of the fitted segments (CSV) of each texture.
    #[arg(long, value_name = "FOLDER")]
    report: Option<PathBuf>,
}

/// A texture to fit, and its files.
struct Job<'a> {
    name: String,
    files: &'a [PathBuf],
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let paths = recording_files(&args.files)?;
    let mut outcome = Outcome::new(&args.destination, &paths)?;
    let map = map_of(args.map.as_deref(), &args.answers)?;
    if let Some(folder) = &args.report {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder of reports; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    let jobs: Vec<Job<'_>> = match &args.name {
        Some(name) => vec![Job { name: name.clone(), files: &paths }],
        None => {
            paths.chunks(1).map(|files| Job { name: name_from_file(&file_name(&files[0])), files }).collect()
        }
    };
    let mut questions = Vec::new();
    let progress = Progress::new("fitting the recordings", jobs.len());
    for job in &jobs {
        import(args, &paths, &map, job, &mut outcome, &mut questions)?;
        progress.step();
    }
    progress.finish();
    outcome.finish(json!({"questions": questions}))
}

/// Returns the named files, and the recordings in the named folders, sorted by name.
fn recording_files(paths: &[PathBuf]) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let found = files_in(path, &RECORDING_ENDINGS)?;
        if found.is_empty() {
            bail!(
                "the folder contains no recording (.{}); choose the folder of the recordings: {}",
                RECORDING_ENDINGS.join(", ."),
                path.display()
            );
        }
        files.extend(found);
    }
    Ok(files)
}

/// Fits a texture, or records the reason why it cannot be fitted.
fn import(
    args: &Args,
    paths: &[PathBuf],
    map: &ColumnMap,
    job: &Job<'_>,
    outcome: &mut Outcome<'_>,
    questions: &mut Vec<Value>,
) -> anyhow::Result<()> {
    let (mut files, mut recordings) = (Vec::new(), Vec::new());
    for file in job.files {
        match read(file, map, outcome, questions) {
            Ok(recording) => {
                files.push(file.as_path());
                recordings.push(recording);
            }
            Err(reason) => outcome.failed(file, reason),
        }
    }
    if recordings.is_empty() {
        return Ok(());
    }
    let options = args.fit.options();
    let fitted = match fit::fit(&recordings, &options) {
        Ok(fitted) => fitted,
        Err(error) => {
            for file in files {
                outcome.failed(file, error.to_string());
            }
            return Ok(());
        }
    };
    let names: Vec<String> = files.iter().map(|file| file_name(file)).collect();
    for note in &fitted.report.notes {
        outcome.warn_of_all(format!("{}: {note}", names.join(", ")));
    }
    outcome.note(Path::new(&job.name), &summary(&fitted.report, &recordings));
    let id = outcome.claim_id(&job.name);
    if let Some(folder) = &args.report {
        write_report(args, paths, (folder, &id), &job.name, &fitted)?;
    }
    let figures = figures(&files, &fitted);
    let texture = TextureEntry {
        license: args.licence.clone(),
        origin: format!("Fitted to recordings: {}", names.join(", ")),
        ..TextureEntry::new(id, &job.name, fitted.model)
    };
    outcome.imported(texture, figures);
    Ok(())
}

/// Returns rate, order and errors of a fit, what the rate loses, and the tap transient.
fn summary(report: &FitReport, recordings: &[Recording]) -> String {
    let compared = if report.held_out { "held-out segments" } else { "the fitted segments" };
    let mut parts = vec![format!(
        "model rate {:.0} Hz, order {}; against {compared}: GFC {:.3}, level error {:.2} dB (medians)",
        report.rate.0,
        report.order,
        report.gfc_median(),
        report.level_error_db_median()
    )];
    let lowest_hz = recordings.iter().map(|recording| recording.rate.0).fold(f64::INFINITY, f64::min);
    // The clock of a recording deviates slightly from its nominal rate.
    let is_possible = |rate_hz: &f64| *rate_hz > report.rate.0 && *rate_hz <= 1.001 * lowest_hz;
    if let Some(next_hz) = MODEL_RATES_HZ.into_iter().find(is_possible) {
        parts.push(format!(
            "the recording has {lowest_hz:.0} Hz, of which the model keeps what lies below {:.0} Hz (--rate {next_hz:.0} keeps more)",
            0.5 * report.rate.0
        ));
    }
    parts.extend(report.tap.as_ref().map(tap_text));
    parts.join("; ")
}

/// Writes the page of plots and the table of segments, and never replaces an input.
fn write_report(
    args: &Args,
    paths: &[PathBuf],
    (folder, id): (&Path, &str),
    name: &str,
    fitted: &Fitted,
) -> anyhow::Result<()> {
    let (page, table) = (folder.join(format!("{id}.svg")), folder.join(format!("{id}.csv")));
    let inputs: Vec<Option<&Path>> = paths.iter().chain(&args.map).map(|path| Some(path.as_path())).collect();
    refuse_inputs(&[&page, &table], &inputs)?;
    refuse_foreign(&page, "a page of plots", is_fit_report_svg)?;
    refuse_foreign(&table, "a table of segments", is_fit_report_csv)?;
    atomic::write(&page, fit_report_svg(name, &fitted.report).as_bytes())?;
    atomic::write(&table, &fit_report_csv(&fitted.report))?;
    Ok(())
}

/// Returns the recording in a file, or the reason why it cannot be used.
fn read(
    file: &Path,
    map: &ColumnMap,
    outcome: &mut Outcome<'_>,
    questions: &mut Vec<Value>,
) -> Result<Recording, String> {
    let read = read_recording_file(file, map);
    questions.extend(read.questions.iter().map(|question| {
        json!({
            "file": file.display().to_string(),
            "key": question.what.key(),
            "text": question.text,
            "guess": question.guess,
            "choices": question.choices,
        })
    }));
    for warning in &read.warnings {
        outcome.warn(file, warning);
    }
    for note in &read.notes {
        outcome.note(file, note);
    }
    read.recording
}

fn figures(files: &[&Path], fitted: &Fitted) -> Value {
    let report = &fitted.report;
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    json!({
        "files": files,
        "segments": report.segments.len(),
        "nodes": fitted.model.n_nodes(),
        "order": report.order,
        "rate_hz": report.rate.0,
        "coverage": report.coverage,
        "gfc_median": report.gfc_median(),
        "level_error_db_median": report.level_error_db_median(),
        "held_out": report.held_out,
        "tap": tap_json(report.tap.as_ref()),
    })
}

#[cfg(test)]
mod tests {
    use super::summary;
    use shagreen_core::recording::Recording;
    use shagreen_core::recording::fit::{FitReport, TapFit};
    use shagreen_core::texture::tap::Tap;
    use shagreen_core::units::Hertz;

    fn recording(rate_hz: f64) -> Recording {
        Recording {
            rate: Hertz(rate_hz),
            acceleration_mps2: Vec::new(),
            speed_mps: Vec::new(),
            force_n: Vec::new(),
            usable: Vec::new(),
        }
    }

    fn report(rate_hz: f64, tap: Option<TapFit>) -> FitReport {
        FitReport {
            segments: Vec::new(),
            rate: Hertz(rate_hz),
            order: 20,
            coverage: 1.0,
            frequencies: Vec::new(),
            tap,
            held_out: true,
            notes: Vec::new(),
        }
    }

    #[test]
    fn the_summary_states_a_lower_rate_and_how_to_keep_more() {
        let said = summary(&report(1000.0, None), &[recording(1999.6), recording(10_000.0)]);
        assert!(said.starts_with("model rate 1000 Hz, order 20; against held-out segments: GFC "), "{said}");
        assert!(said.contains("below 500 Hz (--rate 2000 keeps more)"), "{said}");
        for rate_hz in [1000.0, 1500.0] {
            let said = summary(&report(1000.0, None), &[recording(rate_hz)]);
            assert!(!said.contains("--rate"), "{said}");
        }
    }

    #[test]
    fn the_impact_speed_of_a_tap_is_stated_as_assumed() {
        let tap = Tap { frequency: Hertz(250.0), decay_per_sec: 250.0, amplitude_mps2: 30.0 };
        let fit = TapFit { tap, n_landings: 10, explained: 0.9 };
        let said = summary(&report(1000.0, Some(fit)), &[recording(1000.0)]);
        let words =
            "tap transient of 250 Hz and 30.0 m/s² from 10 landings, which are assumed to land at 100 mm/s";
        assert!(said.contains(words), "{said}");
    }
}
