//! Recorded strokes from files.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_device::hid::tracker::{PenTracker, TrackerOptions, stroke_samples};
use shagreen_device::kinematics::SpeedFilter;
use shagreen_device::pressure::PressureMap;
use shagreen_device::track::{PenSample as TrackSample, Track};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::hid_text::is_hid_text;
use shagreen_formats::stroke::{PenSample, PressUnit, Stroke};
use shagreen_formats::stroke_csv::read_stroke_csv;
use shagreen_formats::svc::{PenMapping, pen_samples, read_svc};

use crate::cli::hid_files::{meters, read_pen_recording};
use crate::cli::output;
use crate::cli::stroke_args::{OF_HID, OF_PRESSURE, OF_SVC, StrokeArgs};
use shagreen_studio::file;
use shagreen_studio::stroke_contacts::{CORRECT, StrokeContacts};

/// Reads the stroke of a file; assumptions are printed.
pub(crate) fn load(path: &Path, args: &StrokeArgs) -> anyhow::Result<StrokeContacts> {
    let PressureMap { activation_n: low, full_n: high, .. } = args.pressure_map();
    if high <= low {
        return Err(output::Usage(format!("--force-max {high} must be above --force-min {low}")).into());
    }
    of_bytes(&file::read_file(path, FileKind::Table)?, path, args)
}

/// Reads the stroke of a file with this content; assumptions are printed.
pub(crate) fn of_bytes(bytes: &[u8], path: &Path, args: &StrokeArgs) -> anyhow::Result<StrokeContacts> {
    contacts(bytes, path, args).with_context(|| file::in_file(path))
}

fn contacts(bytes: &[u8], path: &Path, args: &StrokeArgs) -> anyhow::Result<StrokeContacts> {
    if is_hid_text(bytes) {
        return Ok(StrokeContacts::Track(track_of(&read_hid(bytes, args)?)?));
    }
    let (samples, press_unit) = if is_svc(bytes, path) {
        args.refuse_but(&[OF_SVC, OF_PRESSURE].concat(), "a .svc file")?;
        (read_pen(bytes, args)?, PressUnit::FullScale)
    } else {
        let imported = read_stroke_csv(bytes)?;
        imported.warnings.iter().for_each(|warning| output::warn(warning));
        match imported.value {
            Stroke::Contacts(contacts) => {
                args.refuse_but(&[], "a table of speed and force")?;
                return StrokeContacts::given(contacts);
            }
            Stroke::Pen { samples, press_unit: PressUnit::Newtons } => {
                args.refuse_but(&[], "a table with force in N")?;
                (samples, PressUnit::Newtons)
            }
            Stroke::Pen { samples, press_unit } => {
                args.refuse_but(&OF_PRESSURE, "a table with pressure")?;
                (samples, press_unit)
            }
        }
    };
    let map = args.pressure_map();
    let sample = |sample: &PenSample| TrackSample {
        time_secs: sample.time_secs,
        x_m: sample.x_m,
        y_m: sample.y_m,
        force_n: match press_unit {
            PressUnit::FullScale => map.force_n(sample.press, sample.touching),
            PressUnit::Newtons if sample.touching => sample.press,
            PressUnit::Newtons => 0.0,
        },
        touching: sample.touching,
        impact_mps: sample.impact_mps,
    };
    Ok(StrokeContacts::Track(track_of(&samples.iter().map(sample).collect::<Vec<_>>())?))
}

fn track_of(samples: &[TrackSample]) -> anyhow::Result<Track> {
    if !samples.iter().any(|sample| sample.touching) {
        output::warn("the tip never touches the surface in this stroke: the output is silent");
    }
    let track = Track::new(samples).context(CORRECT)?;
    let n_equal = track.warnings.n_equal_timestamps;
    if n_equal > 0 {
        output::warn(&format!("{n_equal} samples have the same time as the next one and were omitted"));
    }
    Ok(track)
}

/// Reads the reports of a pen: force as the pen declares it, otherwise from pressure.
fn read_hid(bytes: &[u8], args: &StrokeArgs) -> anyhow::Result<Vec<TrackSample>> {
    let recording = read_pen_recording(bytes, None, meters(args.size_mm))?;
    if recording.decoder.best().pressure.is_some_and(|pressure| pressure.full_n.is_some()) {
        args.refuse_but(&[OF_HID], "a pen that declares its force in N")?;
    }
    args.refuse_but(&[&[OF_HID][..], &OF_PRESSURE[..]].concat(), "a recorded HID pen")?;
    let Some(size_m) = recording.decoder.best().size_m() else {
        bail!(
            "the pen declares no size, so its speed is unknown; state the size with --size-mm, such as 216x135"
        );
    };
    output::note(&format!(
        "the active area of the pen is {:.1} x {:.1} mm",
        1e3 * size_m[0],
        1e3 * size_m[1]
    ));
    let options = TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: args.pressure_map() };
    let mut tracker = PenTracker::new(recording.decoder, options);
    let moments =
        recording.reports.iter().filter_map(|report| tracker.report(report.time_secs, &report.bytes));
    Ok(stroke_samples(&moments.collect::<Vec<_>>()))
}

/// Returns whether bytes are a .svc pen recording: by the file ending, or by a first line that is only a count.
fn is_svc(bytes: &[u8], path: &Path) -> bool {
    let first = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let is_count = !first.trim_ascii().is_empty() && first.trim_ascii().iter().all(u8::is_ascii_digit);
    is_count || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svc"))
}

fn read_pen(bytes: &[u8], args: &StrokeArgs) -> anyhow::Result<Vec<PenSample>> {
    let recording = read_svc(bytes)?;
    recording.warnings.iter().for_each(|warning| output::warn(warning));
    let recording = recording.value;
    let assumed = PenMapping::of(recording.flavor);
    let mapping = PenMapping {
        mm_per_unit: args.mm_per_count.unwrap_or(assumed.mm_per_unit),
        secs_per_unit: args.ms_per_tick.map_or(assumed.secs_per_unit, |ms| 1e-3 * ms),
        pressure_full_scale: args.pressure_max.unwrap_or(assumed.pressure_full_scale),
    };
    let options = "--mm-per-count, --ms-per-tick and --pressure-max";
    output::note(&format!(
        "the recording states no units; it contains {}, read as {mapping} (change this with {options})",
        recording.flavor
    ));
    let samples = pen_samples(&recording, &mapping).with_context(|| format!("see {options}"))?;
    samples.warnings.iter().for_each(|warning| output::warn(&format!("{warning} (--pressure-max)")));
    Ok(samples.value)
}
