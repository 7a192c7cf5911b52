//! Profiles given to a command: tables over position, signals of a stroke at known speed, or rows of pictures.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use shagreen_core::signals::spatial_spectrogram::Framing;
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::felt_profile;
use shagreen_core::units::{Hertz, MetersPerSecond};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::foreign_file::Found;
use shagreen_formats::picture::{brightness_row, is_picture};
use shagreen_formats::profile_csv::read_profile_csv;

use crate::cli::output::Usage;
use crate::cli::quantity::positive;
use crate::cli::signal_source::SignalArgs;
use shagreen_studio::file;

#[derive(clap::Args)]
pub(crate) struct ProfileArgs {
    /// Surface profile: a table of positions in mm and values (.csv), a signal (.wav) with --speed, or one row of a
    /// photo or height map (.png, .jpg) with --width.
    #[arg(value_name = "PROFILE")]
    path: PathBuf,
    /// Tip speed at which the signal was recorded, in mm/s; it converts time to position.
    #[arg(long, value_name = "V", value_parser = positive)]
    speed: Option<f64>,
    /// Width of the surface in the picture, in mm.
    #[arg(long, value_name = "MM", value_parser = positive)]
    width: Option<f64>,
    /// Row of the picture, counted from 0 at its upper edge. Default: the middle row.
    #[arg(long, value_name = "ROW", requires = "width")]
    row: Option<u32>,
    #[command(flatten)]
    signals: SignalArgs,
}

impl ProfileArgs {
    /// Returns windows of a width in mm: at least four steps, at most the length of the profile.
    pub(crate) fn framing(&self, profile: &Profile, window_mm: f64) -> anyhow::Result<Framing> {
        let window_m = 1e-3 * window_mm;
        let (narrowest_m, widest_m) = (4.0 * profile.step_m(), profile.length_m());
        // The tolerance covers rounding: lengths are products of steps.
        if !(0.999 * narrowest_m..=1.001 * widest_m).contains(&window_m) {
            bail!(
                "a window of {window_mm} mm does not fit a profile of {:.4} mm in steps of {:.4} mm; choose {:.4} to {:.4} mm: {}",
                1e3 * widest_m,
                1e3 * profile.step_m(),
                1e3 * narrowest_m,
                1e3 * widest_m,
                self.path.display()
            );
        }
        Ok(Framing::of_length(window_m, profile.step_m()))
    }

    /// Returns the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Loads a row of the picture.
    fn load_row(&self, width_mm: f64) -> anyhow::Result<Profile> {
        if self.speed.is_some() || self.signals.is_given() {
            return Err(Usage(
                "--width is for pictures; --speed, --full-scale and --channel are for signals (.wav); give one kind only"
                    .to_owned(),
            )
            .into());
        }
        let bytes = file::read_file(&self.path, FileKind::Recording)?;
        let values = brightness_row(&bytes, self.row).with_context(|| file::in_file(&self.path))?;
        let step_m = 1e-3 * width_mm / values.len() as f64;
        Profile::new(step_m, values)
            .with_context(|| {
                format!("with a width of {width_mm} mm the row is not a valid profile; check --width")
            })
            .with_context(|| file::in_file(&self.path))
    }

    /// Returns whether the values are accelerations, as in a signal.
    pub(crate) fn is_signal(&self) -> bool {
        self.speed.is_some()
    }

    /// Loads the profile for playback: a recording without imperceptible frequencies.
    pub(crate) fn load_felt(&self) -> anyhow::Result<Profile> {
        let profile = self.load()?;
        let Some(speed) = self.speed.map(MetersPerSecond::from_mm_per_s) else { return Ok(profile) };
        let rate = Hertz(speed.0 / profile.step_m());
        felt_profile(profile.values(), rate, speed).with_context(|| file::in_file(&self.path))
    }

    /// Loads the profile.
    pub(crate) fn load(&self) -> anyhow::Result<Profile> {
        if let Some(width_mm) = self.width {
            return self.load_row(width_mm);
        }
        let is_signal = self.path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav"));
        match self.speed {
            Some(speed) if is_signal => {
                let signal = self.signals.load(&self.path)?;
                let step_m = 1e-3 * speed / signal.rate.0;
                Profile::new(step_m, signal.samples_mps2)
                    .with_context(|| format!("at {speed} mm/s the signal is not a valid profile; check --speed"))
                    .with_context(|| file::in_file(&self.path))
            }
            None if is_signal => {
                Err(Usage("a signal is converted to a profile by its tip speed; give --speed in mm/s".to_owned()).into())
            }
            speed if speed.is_some() || self.signals.is_given() => Err(Usage(
                "a table already has positions and values; leave out --speed, --full-scale and --channel, which are for signals (.wav)"
                    .to_owned(),
            )
            .into()),
            _ => {
                let bytes = file::read_file(&self.path, FileKind::Recording)?;
                if is_picture(&bytes) {
                    return Err(Usage("a picture is converted to a profile by the width of its surface; give --width in mm".to_owned()).into());
                }
                // A table can begin with the letters of a picture format, such as "P1 (mm)".
                let profile = read_profile_csv(&bytes).map_err(|error| {
                    let found = Found::of(&bytes);
                    if found.is_picture() { anyhow!(found.instead_of_photo()) } else { error.into() }
                });
                profile.with_context(|| file::in_file(&self.path))
            }
        }
    }
}
