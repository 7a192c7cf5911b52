//! `shagreen devices --descriptor` and `--decode`: shows raw HID report descriptors, and decodes pen reports with them.

use std::path::{Path, PathBuf};

use anyhow::bail;
use serde_json::{Value, json};
use shagreen_device::haptic_pen::controller::HapticController;
use shagreen_device::hid::pen::{PenAxis, PenDecoder, PenFormat};
use shagreen_device::hid::tracker::{PenTracker, TrackedSample, TrackerOptions};
use shagreen_device::kinematics::SpeedFilter;
use shagreen_device::pressure::PressureMap;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::stroke::{PenSample, PressUnit};
use shagreen_formats::stroke_csv::{read_stroke_csv, stroke_csv};

use crate::cli::hid_files::{DeclaredDevice, PenRecording, read_descriptors, read_pen_recording};
use crate::cli::output;
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Lists what the files declare. A file that cannot be read is listed with its error.
///
/// # Errors
/// A file, or a descriptor in it, cannot be read; all files are listed nevertheless.
pub(crate) fn list_descriptors(files: &[PathBuf], as_json: bool) -> anyhow::Result<()> {
    let mut entries: Vec<Value> = Vec::new();
    for file in files {
        match read_descriptors(file) {
            Ok(devices) => {
                entries.extend(devices.iter().map(|device| match device {
                    Ok(device) => declared_json(file, device),
                    Err(error) => broken_json(file, error),
                }));
            }
            Err(error) => entries.push(broken_json(file, &error)),
        }
    }
    output::print(as_json, &json!({"descriptors": entries}), || {
        entries.iter().map(in_words).collect::<Vec<_>>().join("\n")
    });
    match entries.iter().filter(|entry| !entry["error"].is_null()).count() {
        0 => Ok(()),
        n => bail!("{n} of {} could not be read; the list states the reason for each", entries.len()),
    }
}

fn broken_json(file: &Path, error: &anyhow::Error) -> Value {
    // The file name is a separate field.
    let causes: Vec<String> =
        error.chain().map(ToString::to_string).filter(|c| *c != file::in_file(file)).collect();
    json!({
        "file": file.display().to_string(), "name": null, "pen": false, "report_id": null, "x": null, "y": null,
        "pressure": null, "tilt": false, "reports": [], "haptic": null, "warnings": [], "error": causes.join(": "),
    })
}

fn declared_json(file: &Path, device: &DeclaredDevice) -> Value {
    let decoder = device.pen();
    let best = decoder.as_ref().map(PenDecoder::best);
    let reports = decoder.iter().flat_map(PenDecoder::formats).map(format_json).collect::<Vec<_>>();
    let warnings: Vec<String> = device.descriptor.warnings.iter().map(ToString::to_string).collect();
    let mut entry = best.map_or_else(
        || json!({"report_id": null, "x": null, "y": null, "pressure": null, "tilt": false}),
        format_json,
    );
    entry["file"] = json!(file.display().to_string());
    entry["name"] = json!(device.name);
    entry["pen"] = json!(best.is_some());
    entry["reports"] = json!(reports);
    entry["haptic"] = json!(HapticController::of_descriptor(&device.descriptor).as_ref().map(haptic_json));
    entry["warnings"] = json!(warnings);
    entry["error"] = Value::Null;
    entry
}

fn format_json(format: &PenFormat) -> Value {
    let axis = |axis: &PenAxis| {
        json!({
            "logical_min": axis.logical_min,
            "logical_max": axis.logical_max,
            "mm": axis.side_m.map(|side_m| short(1e3 * side_m)),
        })
    };
    let pressure = format.pressure.map(|pressure| {
        json!({
            "bits": pressure.bits,
            "logical_min": pressure.logical_min,
            "logical_max": pressure.logical_max,
            "newtons_max": pressure.full_n.map(short),
        })
    });
    json!({
        "report_id": format.report_id,
        "bytes": format.n_bytes,
        "x": axis(&format.x),
        "y": axis(&format.y),
        "size_doubtful": format.is_size_doubtful,
        "pressure": pressure,
        "tilt": format.has_tilt,
        "clock": format.clock_round_secs.is_some(),
    })
}

/// The haptic controller of a pen. A pen that lists its waveforms in a report is not asked for them.
fn haptic_json(controller: &HapticController) -> Value {
    let waveforms: Vec<&str> =
        controller.waveforms(&[]).iter().map(|offered| offered.waveform.name()).collect();
    json!({
        "entries": controller.n_entries(),
        "waveforms": waveforms,
        "intensity": controller.has_intensity(),
        "automatic": controller.is_automatic(),
    })
}

fn in_words(entry: &Value) -> String {
    let file = entry["file"].as_str().unwrap_or_default();
    if let Some(error) = entry["error"].as_str() {
        return format!("{file}: {error}");
    }
    let haptic =
        entry["haptic"]["entries"].as_u64().map(|n| format!("haptic output with up to {n} waveforms"));
    if entry["pen"] == json!(false) {
        return format!("{file}: {}", haptic.as_deref().unwrap_or("not a pen"));
    }
    let size = match (entry["x"]["mm"].as_f64(), entry["y"]["mm"].as_f64()) {
        (Some(width), Some(height)) if entry["size_doubtful"] == json!(true) => {
            format!("{width} x {height} mm (probably wrong)")
        }
        (Some(width), Some(height)) => format!("{width} x {height} mm"),
        _ => "size not declared".to_owned(),
    };
    let levels = entry["pressure"]["logical_max"].as_i64().map_or("no pressure".to_owned(), |max| {
        let force = entry["pressure"]["newtons_max"].as_f64();
        force.map_or(format!("pressure up to {max}"), |force| format!("pressure up to {max} ({force} N)"))
    });
    let id = entry["report_id"].as_u64().map_or("reports without id".to_owned(), |id| format!("report {id}"));
    let tilt = if entry["tilt"] == json!(true) { ", tilt" } else { "" };
    let haptic = haptic.map_or(String::new(), |haptic| format!(", {haptic}"));
    format!("{file}: pen, {id}, {size}, {levels}{tilt}{haptic}")
}

/// Decodes the reports of a file with the descriptor of another file or its own. `files` has one or two elements.
pub(crate) fn decode(
    files: &[PathBuf],
    size_m: Option<[f64; 2]>,
    out: Option<&Path>,
    as_json: bool,
) -> anyhow::Result<()> {
    let (declared, reports) = match files {
        [reports] => (None, reports),
        [descriptor, reports] => (Some(descriptor), reports),
        _ => bail!(output::Usage("give --decode DESCRIPTOR REPORTS, or --decode REPORTS".to_owned())),
    };
    if let Some(out) = out {
        refuse_inputs(&[out], &[declared.map(PathBuf::as_path), Some(reports)])?;
        refuse_foreign(out, "the stroke", |bytes| read_stroke_csv(bytes).is_ok())?;
    }
    let declared = declared.map(|file| first_pen(file).map_err(|error| error.context(file::in_file(file))));
    let bytes = file::read_file(reports, FileKind::Table);
    if let (Some(Err(first)), Err(_)) = (&declared, &bytes) {
        // Both errors are reported, so that the user can correct both at once.
        output::warn(&file::one_line(first));
    }
    let bytes = bytes?;
    let declared = declared.transpose()?;
    let recording = read_pen_recording(&bytes, declared.as_ref(), size_m)
        .map_err(|error| error.context(file::in_file(reports)))?;
    let size_m = recording.decoder.best().size_m();
    if size_m.is_none() {
        output::warn(
            "the pen declares no size, so positions in mm are unknown; state the size with --size-mm, such as 216x135",
        );
    }
    if recording.decoder.best().is_size_doubtful {
        output::warn(
            "the size that the pen declares is probably wrong; state the right one with --size-mm, such as 216x135",
        );
    }
    let Decoded { rows, start_secs, n_ignored, n_out_of_range, n_same_time } = decoded(&recording);
    if let Some(out) = out {
        write_stroke(&rows, out)?;
    }
    let touching = rows.iter().filter(|(_, moment)| moment.report.touching());
    let speed_max =
        touching.clone().map(|(_, moment)| moment.touch.contact.speed_mps).fold(0.0_f32, f32::max);
    let result = json!({
        "samples": rows.iter().map(|(secs, moment)| sample_json(*secs, moment)).collect::<Vec<_>>(),
        "start_s": start_secs,
        "ignored": n_ignored,
        "out_of_range": n_out_of_range,
        "same_time": n_same_time,
        "size_mm": size_m.map(|sides| sides.map(|side| short(1e3 * side))),
        "speed_max": size_m.map(|_| short(1e3 * f64::from(speed_max))),
        "out": out.map(|out| out.display().to_string()),
    });
    output::print(as_json, &result, || {
        let seconds = rows.last().map_or(0.0, |(secs, _)| *secs);
        format!(
            "Decoded {} pen samples in {seconds:.3} s, {} of them in contact, maximum speed {:.0} mm/s; omitted: {n_out_of_range} out of range, {n_same_time} with the same time as the next sample, {n_ignored} reports of other kinds",
            rows.len(),
            touching.count(),
            1e3 * speed_max,
        )
    });
    Ok(())
}

/// Returns the first device in a file that has a pen, otherwise the first device: the recording may identify it.
fn first_pen(file: &Path) -> anyhow::Result<DeclaredDevice> {
    let mut devices = read_descriptors(file)?.into_iter().collect::<anyhow::Result<Vec<_>>>()?;
    let index = devices.iter().position(|device| device.pen().is_some()).unwrap_or(0);
    Ok(devices.swap_remove(index))
}

/// Decoded pen samples, as printed and written.
struct Decoded {
    /// Samples with the pen in range, with the seconds since the first; of samples with the same time only the last.
    rows: Vec<(f64, TrackedSample)>,
    /// Time of the first sample in the recording, in seconds; `None` without samples.
    start_secs: Option<f64>,
    /// Number of reports that are not from the pen.
    n_ignored: usize,
    /// Number of samples with the pen out of range, which have no position.
    n_out_of_range: usize,
    /// Number of samples with the time of the next one.
    n_same_time: usize,
}

fn decoded(recording: &PenRecording) -> Decoded {
    let options = TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: PressureMap::USUAL };
    let mut tracker = PenTracker::new(recording.decoder.clone(), options);
    let reports = recording.reports.iter();
    let moments: Vec<TrackedSample> =
        reports.filter_map(|report| tracker.report(report.time_secs, &report.bytes)).collect();
    let (n_reports, n_moments) = (recording.reports.len(), moments.len());
    let in_range: Vec<TrackedSample> = moments.into_iter().filter(|moment| moment.report.in_range).collect();
    let n_in_range = in_range.len();
    let start_secs = in_range.first().map(|first| first.time_secs);
    let has_time = |i: usize| in_range.get(i + 1).is_none_or(|next| next.time_secs > in_range[i].time_secs);
    let rows: Vec<(f64, TrackedSample)> = (0..n_in_range)
        .filter(|i| has_time(*i))
        .map(|i| (in_range[i].time_secs - start_secs.unwrap_or(0.0), in_range[i]))
        .collect();
    Decoded {
        n_ignored: n_reports - n_moments,
        n_out_of_range: n_moments - n_in_range,
        n_same_time: n_in_range - rows.len(),
        rows,
        start_secs,
    }
}

fn sample_json(time_secs: f64, moment: &TrackedSample) -> Value {
    let report = &moment.report;
    let degrees = |angle: Option<f64>| angle.map(|angle| short(angle.to_degrees()));
    json!({
        "t": time_secs,
        "x_mm": report.x_m.map(|x_m| short(1e3 * x_m)),
        "y_mm": report.y_m.map(|y_m| short(1e3 * y_m)),
        "pressure": report.pressure.map(short),
        "tip": report.tip,
        "x_share": short(report.x_share),
        "y_share": short(report.y_share),
        "force_n": report.force_n.map(short),
        "in_range": report.in_range,
        "eraser": report.eraser || report.inverted && report.tip,
        "barrel": report.barrel,
        "tilt_x_deg": degrees(report.tilt_x_rad),
        "tilt_y_deg": degrees(report.tilt_y_rad),
        "speed": moment.place_m.map(|_| short(1e3 * f64::from(moment.touch.contact.speed_mps))),
        "landing_speed": moment.landing.map(|landing| short(1e3 * f64::from(landing.speed_mps))),
    })
}

/// Writes the stroke as a table: force in N if the pen declares it, otherwise pressure as a fraction of full pressure.
fn write_stroke(rows: &[(f64, TrackedSample)], out: &Path) -> anyhow::Result<()> {
    let is_in_newtons = rows.iter().all(|(_, moment)| moment.report.force_n.is_some());
    let sample = |(time_secs, moment): &(f64, TrackedSample)| {
        let report = &moment.report;
        let press = if is_in_newtons { report.force_n } else { report.pressure };
        let (x_m, y_m, touching) = (report.x_m?, report.y_m?, report.touching());
        let (press, impact_mps) = (press.unwrap_or(0.0), moment.impact_mps.map(f64::from));
        Some(PenSample { time_secs: *time_secs, x_m, y_m, press, touching, impact_mps })
    };
    if rows.is_empty() {
        bail!(
            "there is no stroke to write: no report has the pen in range; record again with the pen on its tablet"
        );
    }
    let samples: Option<Vec<PenSample>> = rows.iter().map(sample).collect();
    let Some(samples) = samples else {
        bail!(
            "the stroke has no positions in mm, because the pen declares no size; state it with --size-mm, such as 216x135"
        );
    };
    let unit = if is_in_newtons { PressUnit::Newtons } else { PressUnit::FullScale };
    Ok(atomic::write(out, stroke_csv(&samples, unit).as_bytes())?)
}

/// Rounds to a millionth, which is finer than any pen's resolution.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
