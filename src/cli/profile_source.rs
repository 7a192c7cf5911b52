//! Profiles that a command takes: tables over position, or signals of a stroke of known speed.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use shagreen_core::profile::Profile;
use shagreen_formats::profile_csv::read_profile_csv;

use crate::cli::motion::quantity;
use crate::cli::output::{self, Usage};
use crate::cli::signal_source::SignalArgs;

#[derive(clap::Args)]
pub(crate) struct ProfileArgs {
    /// The profile: a table of positions in mm and values (.csv), or a signal (.wav) with --speed.
    #[arg(value_name = "PROFILE")]
    path: PathBuf,
    /// Of a signal: how fast it was recorded, in mm/s, which makes its times positions.
    #[arg(long, value_name = "V", value_parser = quantity)]
    speed: Option<f64>,
    #[command(flatten)]
    signals: SignalArgs,
}

impl ProfileArgs {
    /// The file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The profile in it.
    pub(crate) fn load(&self) -> anyhow::Result<Profile> {
        let is_signal = self.path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav"));
        match self.speed {
            Some(speed) if is_signal => {
                let signal = self.signals.load(&self.path)?;
                let step_m = 1e-3 * speed / signal.rate.0;
                Profile::new(step_m, signal.samples_mps2).with_context(|| output::in_file(&self.path))
            }
            None if is_signal => {
                Err(Usage("a signal becomes a profile by its speed; give --speed in mm/s".to_owned()).into())
            }
            Some(_) => {
                Err(Usage("a table has positions already; --speed is for signals (.wav)".to_owned()).into())
            }
            None => {
                let bytes = output::read_file(&self.path)?;
                read_profile_csv(&bytes).with_context(|| output::in_file(&self.path))
            }
        }
    }
}
