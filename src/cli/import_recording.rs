//! `shagreen import recording`: fits texture models to recorded strokes.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};
use serde_json::{Value, json};
use shagreen_core::actuator::Drive;
use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::{self, FitReport, Fitted, HeldOut, MODEL_RATES_HZ};
use shagreen_formats::acf::{AcfV1, acf, read_acf};
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::fit_report::{fit_report_csv, fit_report_svg, is_fit_report_csv, is_fit_report_svg};
use shagreen_formats::library::{TextureEntry, name_from_file};
use shagreen_formats::recording::{Ask, ColumnMap};

use crate::cli::actuator_source::load_actuator;
use crate::cli::fit_args::{FitArgs, tap_json, tap_text};
use crate::cli::import::{Destination, Outcome, files_in};
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::recording_answers::{map_of, parse_answer};
use crate::cli::recording_source::read_recording_file;
use shagreen_studio::file::{self, file_name};
use shagreen_studio::import::RECORDING_ENDINGS;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Fits texture models to recorded strokes: acceleration, speed and force, as WAV files or tables. Haptic clips (.haptic, AHAP,
/// Macaron, and tables of time, amplitude and frequency) are made into signals first.
///
/// If a file does not state a property, such as the unit of acceleration, the command infers it from the data where
/// possible and prints a warning. Otherwise it rejects the file until you state the property with --set or --map.
#[derive(clap::Args)]
// `shagreen import FILE` has these arguments only if the group has one. The derived group is empty, because it ignores structs
// with flattened fields.
#[group(args = ["files"])]
pub(crate) struct Args {
    /// Recordings: .wav, tables such as .csv and .txt, haptic clips, or folders of them. Each file becomes a texture.
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
    /// Actuator for which haptic clips were made: a built-in one by its id, a profile file, or a configuration (.acf).
    /// Frequencies from 0 to 1 in clips are mapped to its band. Default: 60 to 300 Hz, or frequency_range of --set and --map.
    #[arg(long, value_name = "ID_OR_FILE")]
    actuator: Option<String>,
    /// Treat all files as strokes on one texture with this name.
    #[arg(long, value_name = "NAME", value_parser = texture_name)]
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

impl Args {
    /// Returns the named files and folders.
    pub(crate) fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Returns the library to write.
    pub(crate) fn destination(&self) -> &Destination {
        &self.destination
    }

    /// Returns the first option that was given and has no effect on texture models.
    pub(crate) fn only_for_recordings(&self) -> Option<&'static str> {
        let options = [
            ("--map", self.map.is_some()),
            ("--set", !self.answers.is_empty()),
            ("--actuator", self.actuator.is_some()),
            ("--name", self.name.is_some()),
            ("--licence", !self.licence.is_empty()),
            ("--report", self.report.is_some()),
        ];
        options.into_iter().find(|(_, is_given)| *is_given).map(|(option, _)| option)
    }

    /// Returns what is known about the files.
    fn column_map(&self) -> anyhow::Result<ColumnMap> {
        let mut map = map_of(self.map.as_deref(), &self.answers)?;
        if let (Some(actuator), None) = (&self.actuator, map.frequency_range_hz) {
            map.frequency_range_hz = Some(band_hz(actuator)?);
        }
        Ok(map)
    }
}

/// Parses the name of a texture, which must not be blank.
fn texture_name(text: &str) -> Result<String, String> {
    if text.trim().is_empty() { Err("a texture needs a name".to_owned()) } else { Ok(text.to_owned()) }
}

/// Returns the frequencies to which a player of clips on this actuator maps 0 and 1, in Hz.
fn band_hz(actuator: &str) -> anyhow::Result<[f64; 2]> {
    let path = Path::new(actuator);
    let configuration: AcfV1 = if file::ending_of(path) == "acf" {
        let bytes = file::read_file(path, FileKind::Small)?;
        read_acf(&bytes).with_context(|| file::in_file(path))?
    } else {
        acf(&load_actuator(actuator, None)?, Drive::ASSUMED, output::CREATED_BY)?
    };
    let [low, high] = [configuration.continuous.frequency_min, configuration.continuous.frequency_max];
    ensure!(
        low >= 0.0 && high > low && high.is_finite(),
        "the actuator plays frequencies from {low} to {high} Hz, which is no band; state one with --set frequency_range=60-300"
    );
    Ok([low, high])
}

/// A texture to fit, and its files.
struct Job<'a> {
    name: String,
    files: &'a [PathBuf],
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let paths = recording_files(&args.files)?;
    let mut outcome = Outcome::new(&args.destination, &paths)?;
    let map = args.column_map()?;
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
    let compared = match report.held_out {
        HeldOut::Segments => "held-out segments",
        HeldOut::Blocks => "held-out blocks of the same strokes",
        HeldOut::Nothing => "the fitted segments",
    };
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
        "held_out": report.held_out.is_any(),
        "held_out_blocks": report.held_out == HeldOut::Blocks,
        "tap": tap_json(report.tap.as_ref()),
    })
}

#[cfg(test)]
mod tests {
    use super::summary;
    use shagreen_core::recording::Recording;
    use shagreen_core::recording::fit::{FitReport, HeldOut, TapFit};
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
            held_out: HeldOut::Segments,
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
    fn the_summary_says_what_was_held_out() {
        for (held_out, words) in [
            (HeldOut::Segments, "against held-out segments:"),
            (HeldOut::Blocks, "against held-out blocks of the same strokes:"),
            (HeldOut::Nothing, "against the fitted segments:"),
        ] {
            let said = summary(&FitReport { held_out, ..report(1000.0, None) }, &[recording(1000.0)]);
            assert!(said.contains(words), "{said}");
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
