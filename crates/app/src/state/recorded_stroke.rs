//! Stroke recording that the automatic stroke can repeat: recorded on the pad, or read from a CSV table.

use std::io::Read as _;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use anyhow::{Context as _, bail};
use egui::DroppedFileHandle;
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_device::pressure::PressureMap;
use shagreen_device::repeat::Repeat;
use shagreen_device::track::{PenSample, Track, TrackError};
use shagreen_formats::bounded_file;
use shagreen_formats::stroke::{self, PressUnit, Stroke, TimedContact};
use shagreen_formats::stroke_csv::{is_stroke_table, read_stroke_csv, stroke_csv};

use crate::state::background::in_background;
use crate::state::source::Source;
use crate::strings::stroke as strings;
use shagreen_studio::file::{ending_of, is_special};

/// Maximum duration of a stroke that is read, in seconds.
const LONGEST_SECS: f64 = 600.0;
/// File endings of tables, in lower case.
pub(crate) const TABLE_ENDINGS: [&str; 3] = ["csv", "tsv", "txt"];
/// Maximum length of the header line of a table, in bytes.
const HEAD_BYTES: u64 = 4096;
/// Radius in m of the circle along which given speeds are traveled; a straight line would leave the pad.
const WALK_RADIUS_M: f64 = 0.02;
/// Time step of the samples on this circle, in seconds.
const WALK_STEP_SECS: f64 = 0.002;
/// Time step of the mean contact, in seconds.
const MEAN_STEP_SECS: f64 = 0.01;

/// Stroke recording, and the track that an output plays.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedStroke {
    samples: Vec<PenSample>,
    track: Arc<Track>,
    usual: Contact,
}

impl RecordedStroke {
    /// Stroke recording of these samples.
    ///
    /// # Errors
    /// Those of [`Track::new`].
    pub fn new(samples: Vec<PenSample>) -> Result<Self, TrackError> {
        let track = Track::new(&samples)?;
        let usual = usual_contact(&track);
        Ok(Self { samples, track: Arc::new(track), usual })
    }

    /// Samples of the tip: time, position, force and contact.
    pub fn samples(&self) -> &[PenSample] {
        &self.samples
    }

    /// Track that an output plays.
    pub fn track(&self) -> &Track {
        &self.track
    }

    /// The same track, for work in the background.
    pub(crate) fn shared_track(&self) -> Arc<Track> {
        Arc::clone(&self.track)
    }

    /// Mean tip speed and normal force during contact, scaled by the tempo and the force of `repeat`.
    pub fn usual_contact(&self, repeat: Repeat) -> Contact {
        Contact {
            speed: MetersPerSecond(self.usual.speed.0 * f64::from(repeat.tempo)),
            force: Newtons(self.usual.force.0 * f64::from(repeat.force)),
        }
    }

    /// The samples as a CSV file.
    pub fn csv(&self) -> Vec<u8> {
        let sample = |sample: &PenSample| {
            let PenSample { time_secs, x_m, y_m, force_n, touching, impact_mps } = *sample;
            let press = if touching { force_n } else { 0.0 };
            stroke::PenSample { time_secs, x_m, y_m, press, touching, impact_mps }
        };
        let samples: Vec<stroke::PenSample> = self.samples.iter().map(sample).collect();
        stroke_csv(&samples, PressUnit::Newtons).into_bytes()
    }

    /// Reads a CSV file and returns the stroke with warnings about assumptions. `map` converts pressure to force.
    ///
    /// # Errors
    /// The file is no stroke, the stroke is too long or never touches, or its samples are invalid.
    pub fn read(bytes: &[u8], map: PressureMap) -> anyhow::Result<(Self, Vec<String>)> {
        let imported = read_stroke_csv(bytes)?;
        let samples = match imported.value {
            Stroke::Pen { samples, press_unit } => {
                samples.iter().map(|sample| pen_sample(sample, press_unit, map)).collect()
            }
            Stroke::Contacts(contacts) => {
                check_length(contacts.last().map_or(0.0, |last| last.time_secs))?;
                walked(&contacts)
            }
        };
        check_length(samples.last().map_or(0.0, |last| last.time_secs))?;
        if !samples.iter().any(|sample| sample.touching) {
            bail!(strings::NEVER_TOUCHES);
        }
        Ok((Self::new(samples)?, imported.warnings))
    }
}

fn check_length(secs: f64) -> anyhow::Result<()> {
    if secs > LONGEST_SECS {
        bail!(strings::too_long(secs, LONGEST_SECS));
    }
    Ok(())
}

fn pen_sample(sample: &stroke::PenSample, press_unit: PressUnit, map: PressureMap) -> PenSample {
    let stroke::PenSample { time_secs, x_m, y_m, press, touching, impact_mps } = *sample;
    let force_n = match press_unit {
        PressUnit::FullScale => map.force_n(press, touching),
        PressUnit::Newtons if touching => press,
        PressUnit::Newtons => 0.0,
    };
    PenSample { time_secs, x_m, y_m, force_n, touching, impact_mps }
}

/// Positions on a circle at which the tip has the given speeds, linearly interpolated between the contacts.
fn walked(contacts: &[TimedContact]) -> Vec<PenSample> {
    let mut samples = Vec::new();
    let mut distance_m = 0.0_f64;
    let at = |time_secs: f64, distance_m: f64, force_n: f64, impact_mps: Option<f64>| {
        let (sin, cos) = (distance_m / WALK_RADIUS_M).sin_cos();
        let (x_m, y_m) = (WALK_RADIUS_M * cos, WALK_RADIUS_M * sin);
        PenSample { time_secs, x_m, y_m, force_n, touching: force_n > 0.0, impact_mps }
    };
    for pair in contacts.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let secs = to.time_secs - from.time_secs;
        let impact_mps = from.impact_mps_before(&to);
        let n_steps = (secs / WALK_STEP_SECS).ceil().max(1.0);
        for step in 0..n_steps as u32 {
            let mix = |a: f64, b: f64, steps: f64| a + steps / n_steps * (b - a);
            let steps = f64::from(step);
            let time_secs = mix(from.time_secs, to.time_secs, steps);
            samples.push(at(time_secs, distance_m, mix(from.force_n, to.force_n, steps), impact_mps));
            distance_m += mix(from.speed_mps, to.speed_mps, steps + 0.5) * secs / n_steps;
        }
    }
    samples.extend(contacts.last().map(|last| at(last.time_secs, distance_m, last.force_n, last.impact_mps)));
    samples
}

fn usual_contact(track: &Track) -> Contact {
    let n_steps = (track.duration_secs() / MEAN_STEP_SECS) as usize;
    let (mut n, mut speed_mps, mut force_n) = (0.0_f64, 0.0, 0.0);
    for step in 0..=n_steps {
        let contact = track.touch_at(step as f64 * MEAN_STEP_SECS).contact;
        if contact.force_n > 0.0 {
            n += 1.0;
            speed_mps += f64::from(contact.speed_mps);
            force_n += f64::from(contact.force_n);
        }
    }
    let n = n.max(1.0);
    Contact { speed: MetersPerSecond(speed_mps / n), force: Newtons(force_n / n) }
}

/// Whether a dropped file is a stroke, according to its ending and the column names. Only its beginning is read.
pub(crate) fn is_stroke_file(file: &DroppedFileHandle) -> bool {
    // A file without a path in the file system is dropped with its bytes.
    is_stroke_path(file.path(), || {
        file.bytes().is_ok_and(|bytes| is_stroke_table(&bytes[..bytes.len().min(HEAD_BYTES as usize)]))
    })
}

/// Whether the file at `path` is a stroke recording; `otherwise` answers for a file that is not there.
pub(crate) fn is_stroke_path(path: &Path, otherwise: impl FnOnce() -> bool) -> bool {
    if !TABLE_ENDINGS.contains(&ending_of(path).as_str()) {
        return false;
    }
    // The importer reports files that cannot be read.
    if is_special(path) {
        return false;
    }
    if path.exists() {
        let mut head = Vec::new();
        let read = bounded_file::open(path).and_then(|from| from.take(HEAD_BYTES).read_to_end(&mut head));
        return read.is_ok() && is_stroke_table(&head);
    }
    otherwise()
}

/// Stroke recording, and warnings about it.
type Read = (RecordedStroke, Vec<String>);

/// Stroke recording that is being read.
#[derive(Default)]
pub(crate) struct StrokeReader {
    reading: Option<Receiver<anyhow::Result<Read>>>,
    /// Note about other files that were dropped with it.
    note: Option<String>,
}

impl StrokeReader {
    /// Reads the first of these files in the background.
    pub(crate) fn read(&mut self, sources: Vec<Source>, map: PressureMap, ctx: &egui::Context) {
        let mut sources = sources.into_iter();
        let Some(source) = sources.next() else { return };
        let others: Vec<String> = sources.map(|source| source.name()).collect();
        self.note = (!others.is_empty()).then(|| strings::only_one(&source.name(), &others));
        let work = move || {
            let bytes = source.bytes().map_err(anyhow::Error::msg);
            bytes.and_then(|bytes| RecordedStroke::read(&bytes, map)).with_context(|| source.name())
        };
        self.reading = Some(in_background(ctx.clone(), work));
    }

    /// Discards the stroke that is being read; returns whether there is one.
    pub(crate) fn cancel(&mut self) -> bool {
        self.note = None;
        self.reading.take().is_some()
    }

    /// The stroke with its warnings, or the error, when reading is complete.
    pub(crate) fn collect(&mut self) -> Option<Result<Read, String>> {
        let outcome = match self.reading.as_ref()?.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(strings::BROKE_OFF.to_owned()),
            Ok(outcome) => outcome.map_err(|error| format!("{error:#}")),
        };
        self.reading = None;
        let note = self.note.take();
        Some(match outcome {
            Ok((stroke, mut warnings)) => {
                warnings.extend(note);
                Ok((stroke, warnings))
            }
            Err(reason) => Err(std::iter::once(reason).chain(note).collect::<Vec<_>>().join("; ")),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{PenSample, PressureMap, RecordedStroke, Repeat, Track};

    fn straight() -> Vec<PenSample> {
        let sample = |i: u32| PenSample {
            time_secs: 0.01 * f64::from(i),
            x_m: 1e-3 * f64::from(i),
            y_m: -2e-3,
            force_n: 0.7,
            touching: i < 60,
            impact_mps: (i == 0).then_some(0.2),
        };
        (0..=60).map(sample).collect()
    }

    #[test]
    fn a_stroke_comes_back_from_its_table() {
        let stroke = RecordedStroke::new(straight()).unwrap();
        let (read, warnings) = RecordedStroke::read(&stroke.csv(), PressureMap::USUAL).unwrap();
        assert_eq!(warnings, Vec::<String>::new());
        assert_eq!(read.samples().len(), stroke.samples().len());
        for (a, b) in read.samples().iter().zip(stroke.samples()) {
            // The conversion to millimeters and back is subject to rounding.
            assert!((a.x_m - b.x_m).abs() < 1e-12 && (a.y_m - b.y_m).abs() < 1e-12);
            assert!(a.time_secs == b.time_secs && a.touching == b.touching && a.impact_mps == b.impact_mps);
            assert_eq!(a.force_n, if b.touching { b.force_n } else { 0.0 });
        }
        let repeat = Repeat { tempo: 2.0, force: 0.5 };
        let usual = stroke.usual_contact(repeat);
        // The first of sixty samples is at rest.
        assert!((usual.speed.0 - 0.2).abs() < 0.01 && (usual.force.0 - 0.35).abs() < 1e-6, "{usual:?}");
    }

    #[test]
    fn given_speeds_are_walked() {
        let table = "t_s,speed,force\n0,100,1\n1,100,0.5\n1.2,100,0\n";
        let (stroke, _) = RecordedStroke::read(table.as_bytes(), PressureMap::USUAL).unwrap();
        for i in 2..10 {
            let touch = stroke.track().touch_at(0.1 * f64::from(i));
            assert!((touch.contact.speed_mps - 0.1).abs() < 1e-3, "{touch:?}");
            assert!((touch.x_m.hypot(touch.y_m) - 0.02).abs() < 1e-4);
            assert!((f64::from(touch.contact.force_n) - 1.0 + 0.05 * f64::from(i)).abs() < 1e-3);
        }
    }

    #[test]
    fn a_table_of_speeds_may_state_how_fast_the_tip_lands() {
        let table =
            "t_s,speed,force,speed_normal\n0,0,0,50\n0.1,100,1,0\n0.2,0,0,0\n0.3,0,0,200\n0.4,100,1,0\n";
        let (stroke, _) = RecordedStroke::read(table.as_bytes(), PressureMap::USUAL).unwrap();
        let impact_at = |secs| stroke.track().impact_mps_at(secs);
        assert_eq!([impact_at(0.05), impact_at(0.35)], [Some(0.05), Some(0.2)]);
    }

    #[test]
    fn what_cannot_be_repeated_is_said() {
        for (table, words) in [
            ("t_s,speed,force\n0,100,1\n601,100,1\n", "600 s"),
            ("t_s,x_mm,y_mm,force_n\n0,0,0,1\n601,1,1,1\n", "600 s"),
            ("t_s,x_mm,y_mm,force_n,touching\n0,0,0,1,0\n1,1,1,1,0\n", "never touches"),
            ("my notes", "line"),
        ] {
            let error = RecordedStroke::read(table.as_bytes(), PressureMap::USUAL).unwrap_err();
            assert!(format!("{error:#}").contains(words), "{error:#}");
        }
    }

    #[test]
    fn a_track_is_that_of_the_samples() {
        let stroke = RecordedStroke::new(straight()).unwrap();
        assert_eq!(*stroke.track(), Track::new(&straight()).unwrap());
        assert!(RecordedStroke::new(Vec::new()).is_err());
    }
}
