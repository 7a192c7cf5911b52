//! Options of the signal of a stroke that is exported.

use anyhow::bail;

use crate::cli::motion::{Motion, MotionArgs, motion};
use crate::cli::output;
use crate::cli::sample_args::SampleArgs;

/// Stroke and samples.
#[derive(clap::Args)]
#[command(next_help_heading = "Options for formats of signals")]
pub(crate) struct SignalArgs {
    #[command(flatten)]
    pub(crate) samples: SampleArgs,
    #[command(flatten)]
    motion: MotionArgs,
}

/// Motion without options: speed in mm/s, force in N and duration in s.
const DEFAULT_MOTION: (f64, f64, f64) = (100.0, 1.0, 2.0);

impl SignalArgs {
    /// Returns the motion of the tip.
    pub(crate) fn motion(&self) -> anyhow::Result<Motion> {
        motion(&self.motion, Some(DEFAULT_MOTION))
    }

    /// Returns an error if an option was given: the format has the texture, not a signal.
    pub(crate) fn refuse(&self, format: &str) -> anyhow::Result<()> {
        match self.samples.given().or_else(|| self.motion.given()) {
            Some(option) => bail!(output::Usage(format!(
                "{option} applies only to formats of signals, such as wav; leave it out for the format {format}, which holds the texture at all speeds and forces"
            ))),
            None => Ok(()),
        }
    }
}
