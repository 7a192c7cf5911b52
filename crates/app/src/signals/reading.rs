//! Files that become signals: recordings, haptic clips, profiles, and rows of photos or height maps.

use std::path::Path;
use std::sync::Arc;

use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::units::{MetersPerSecond, Newtons};
use shagreen_formats::clip::ClipKind;
use shagreen_formats::imported::Imported;
use shagreen_formats::picture::{brightness_row, is_picture};
use shagreen_formats::profile_csv::read_profile_csv;
use shagreen_formats::signal::{SignalHints, read_signal};

use crate::state::bench_signal::{BenchSignal, cut};
use crate::state::source::Source;
use crate::state::source::sidecar_of;
use crate::strings::signals as strings;

/// Endings of the names of files that become signals.
pub(crate) const SIGNAL_ENDINGS: [&str; 11] =
    ["wav", "haptic", "ahap", "csv", "png", "jpg", "jpeg", "webp", "bmp", "tif", "tiff"];

/// Information that a file does not contain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Terms {
    /// Tip speed of a recording, or the speed at which a profile is to be stroked.
    pub(crate) speed: MetersPerSecond,
    /// Normal force.
    pub(crate) force: Newtons,
    /// Of a recording without this information: acceleration of a sample of 1.0, in m/s².
    pub(crate) full_scale_mps2: Option<f64>,
    /// Of a recording with several channels: the channel to use, from 0. `None` combines all channels as axes.
    pub(crate) channel: Option<usize>,
    /// Of a profile without a unit: its RMS level, in m/s².
    pub(crate) level_mps2: f64,
    /// Of a picture: width of the surface that it shows, in mm.
    pub(crate) width_mm: f64,
    /// Of a picture: its row, counted from the upper edge. `None` is the middle row.
    pub(crate) row: Option<u32>,
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            speed: MetersPerSecond(0.1),
            force: Newtons(1.0),
            full_scale_mps2: None,
            channel: None,
            level_mps2: 1.0,
            width_mm: 50.0,
            row: None,
        }
    }
}

/// Detected type of a file, which determines the information to ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FileKind {
    /// Samples in m/s².
    Recording,
    /// Values over position, without a unit.
    Profile,
    /// A photo or a height map.
    Picture,
}

/// File content in memory, so that changed information does not require reading the file again.
#[derive(Clone, Debug)]
pub(crate) struct BenchFile {
    pub(crate) name: String,
    pub(crate) kind: FileKind,
    bytes: Vec<u8>,
    sidecar: Option<Arc<[u8]>>,
}

impl BenchFile {
    /// Reads a file, and the sidecar file that describes its samples.
    ///
    /// # Errors
    /// A sentence: the file cannot be read.
    pub(super) fn read(source: &Source) -> Result<Self, String> {
        let (name, bytes) = (source.name(), source.bytes()?);
        let kind = if is_picture(&bytes) {
            FileKind::Picture
        } else if bytes.starts_with(b"RIFF")
            || source.ending() == "wav"
            || ClipKind::of(&name, &bytes).is_some()
        {
            FileKind::Recording
        } else {
            FileKind::Profile
        };
        let sidecar = sidecar_of(source, &[]);
        Ok(Self { name, kind, bytes, sidecar })
    }

    /// Returns the signal in the file, interpreted with `terms`.
    ///
    /// # Errors
    /// A sentence: the file does not contain a signal.
    pub(super) fn signal(&self, terms: &Terms) -> Result<Imported<BenchSignal>, String> {
        let name = without_ending(&self.name);
        match self.kind {
            FileKind::Recording => {
                let hints = SignalHints { full_scale_mps2: terms.full_scale_mps2, channel: terms.channel };
                let read = read_signal(&self.name, &self.bytes, self.sidecar.as_deref(), hints)
                    .map_err(|error| error.to_string())?;
                let signal = read.value;
                let made = BenchSignal::of_samples(
                    &name,
                    &signal.samples_mps2,
                    signal.rate,
                    terms.speed,
                    terms.force,
                );
                let mut made = made?;
                made.warnings.extend(read.warnings);
                Ok(made)
            }
            FileKind::Profile => {
                let profile = read_profile_csv(&self.bytes).map_err(|error| error.to_string())?;
                leveled(&name, &profile, terms)
            }
            FileKind::Picture => {
                let row = brightness_row(&self.bytes, terms.row).map_err(|error| error.to_string())?;
                let step_m = 1e-3 * terms.width_mm / row.len() as f64;
                let profile = Profile::new(step_m, row).map_err(|error| error.to_string())?;
                leveled(&strings::row_of(&name, terms.row), &profile, terms)
            }
        }
    }
}

/// Profile without a unit, scaled to the level in `terms`.
fn leveled(name: &str, profile: &Profile, terms: &Terms) -> Result<Imported<BenchSignal>, String> {
    let Imported { value: profile, warnings } = cut(profile, terms.speed)?;
    let relief = Relief::of_level(&profile, terms.level_mps2, terms.force);
    let relief = relief.map_err(|error| error.to_string())?;
    let value = BenchSignal::new(name, relief.profile().clone(), terms.speed, terms.force)?;
    Ok(Imported { value, warnings })
}

fn without_ending(name: &str) -> String {
    Path::new(name).file_stem().map_or(name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::{BenchFile, FileKind, SIGNAL_ENDINGS, Terms};
    use crate::state::source::Source;
    use shagreen_core::units::MetersPerSecond;
    use shagreen_formats::picture::PHOTO_ENDINGS;
    use shagreen_formats::wav::{SidecarV1, write_wav};

    fn file(folder: &std::path::Path, name: &str, bytes: &[u8]) -> BenchFile {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        BenchFile::read(&Source::Path(path)).unwrap()
    }

    #[test]
    fn a_recording_has_the_unit_of_its_sidecar_and_the_length_of_its_speed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("carpet.wav");
        let samples: Vec<f32> = (0..4000_u16).map(|i| f32::from(i % 8) * 0.125 - 0.4).collect();
        let sidecar = SidecarV1 { full_scale: 3.0, ..SidecarV1::new(4000, 1.0, 1, "test") };
        write_wav(&path, &samples, &sidecar).unwrap();
        let file = BenchFile::read(&Source::Path(path)).unwrap();
        assert_eq!(file.kind, FileKind::Recording);
        let terms = Terms { speed: MetersPerSecond(0.05), ..Terms::default() };
        let made = file.signal(&terms).unwrap();
        assert!(made.warnings.is_empty(), "{:?}", made.warnings);
        assert_eq!(made.value.name, "carpet");
        assert!((made.value.profile.length_m() - 0.05).abs() < 1e-9);
        assert!((made.value.profile.values()[0] + 1.2).abs() < 1e-6);
    }

    #[test]
    fn a_profile_and_a_row_of_a_picture_get_the_level_that_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let rows: Vec<String> = (0..200).map(|i| format!("{},{}", 0.1 * f64::from(i), i % 5)).collect();
        let profile = file(folder.path(), "bumps.csv", rows.join("\n").as_bytes());
        assert_eq!(profile.kind, FileKind::Profile);
        let terms = Terms { level_mps2: 2.0, width_mm: 30.0, row: Some(1), ..Terms::default() };
        let made = profile.signal(&terms).unwrap().value;
        assert!((made.level_mps2() - 2.0).abs() < 1e-9 && (made.profile.length_m() - 0.02).abs() < 1e-9);

        let mut png = std::io::Cursor::new(Vec::new());
        image::GrayImage::from_fn(64, 4, |x, y| image::Luma([if y == 1 { (x % 2 * 200) as u8 } else { 9 }]))
            .write_to(&mut png, image::ImageFormat::Png)
            .unwrap();
        let picture = file(folder.path(), "weave.png", &png.into_inner());
        assert_eq!(picture.kind, FileKind::Picture);
        let made = picture.signal(&terms).unwrap().value;
        assert!((made.profile.length_m() - 0.03).abs() < 1e-9 && made.profile.values().len() == 64);
        assert!((made.level_mps2() - 2.0).abs() < 1e-9);
        for (row, expected) in [(Some(4), "rows 0 to 3"), (Some(0), "the profile is constant")] {
            let reason = picture.signal(&Terms { row, ..terms }).unwrap_err();
            assert!(reason.contains(expected), "{reason}");
        }
    }

    #[test]
    fn photos_of_all_formats_become_signals() {
        assert!(PHOTO_ENDINGS.iter().all(|ending| SIGNAL_ENDINGS.contains(ending)));
    }

    #[test]
    fn what_is_no_signal_is_said() {
        let folder = tempfile::tempdir().unwrap();
        assert!(file(folder.path(), "a.csv", b"x_mm,value\n0,1\nhello").signal(&Terms::default()).is_err());
        assert!(file(folder.path(), "a.wav", b"hello").signal(&Terms::default()).is_err());
        assert!(BenchFile::read(&Source::Path(folder.path().join("none.wav"))).is_err());
        assert!(BenchFile::read(&Source::Path(folder.path().to_owned())).is_err());
    }
}
