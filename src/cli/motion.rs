//! Motion of the tip: a steady contact or a recorded stroke.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::units::Contact;
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::wav::TraceV1;
use shagreen_studio::stroke_contacts::StrokeContacts;
use shagreen_studio::trace::steady_trace;

use crate::cli::output;
use crate::cli::quantity::{force, quantity, speed};
use crate::cli::stroke;
use crate::cli::stroke_args::StrokeArgs;

#[derive(clap::Args)]
pub(crate) struct MotionArgs {
    /// Tip speed, in mm/s.
    #[arg(long, value_name = "V", value_parser = speed, conflicts_with = "stroke")]
    speed: Option<f64>,
    /// Normal force, in N.
    #[arg(long, value_name = "F", value_parser = force, conflicts_with = "stroke")]
    force: Option<f64>,
    /// Duration, in s.
    #[arg(long, value_name = "S", value_parser = quantity, conflicts_with = "stroke")]
    seconds: Option<f64>,
    /// Recorded stroke: pen samples (.svc); a table (.csv) with the columns t, x, y and pressure or force, or t, speed
    /// and force, optionally with speed_normal, the speed of a landing in mm/s; or pen reports with their descriptor,
    /// recorded with hid-recorder or usbhid-dump. A first row in contact is a landing only
    /// if it states a speed_normal above 0.
    #[arg(long, value_name = "FILE")]
    stroke: Option<PathBuf>,
    #[command(flatten)]
    reading: StrokeArgs,
}

impl MotionArgs {
    /// Returns the name of the first option that was given.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let options = [
            ("--speed", self.speed.is_some()),
            ("--force", self.force.is_some()),
            ("--seconds", self.seconds.is_some()),
            ("--stroke", self.stroke.is_some()),
        ];
        let given = options.into_iter().find(|(_, is_given)| *is_given).map(|(name, _)| name);
        given.or_else(|| self.reading.given().next())
    }
}

/// Longest steady contact that is rendered or played, in seconds: the same limit as for a stroke.
const MAX_SECS: f64 = MAX_TRACK_SECS;

/// Motion of the tip, of at most [`MAX_SECS`].
pub(crate) enum Motion {
    /// Constant speed and force.
    Steady {
        /// Speed and force.
        contact: Contact,
        /// Duration in seconds.
        seconds: f64,
    },
    /// Recorded stroke.
    Stroke {
        /// Speed and force over time.
        contacts: StrokeContacts,
        /// File of the stroke.
        path: PathBuf,
    },
}

/// Returns the motion that the arguments specify. `default` gives speed in mm/s, force in N and duration in seconds
/// where the arguments give none; without it, missing arguments are wrong usage.
pub(crate) fn motion(args: &MotionArgs, default: Option<(f64, f64, f64)>) -> anyhow::Result<Motion> {
    if let Some(path) = &args.stroke {
        return Ok(Motion::Stroke { contacts: stroke::load(path, &args.reading)?, path: path.clone() });
    }
    if let Some(option) = args.reading.given().next() {
        bail!(output::Usage(format!(
            "{option} applies only to recorded strokes; give --stroke FILE, or leave the option out"
        )));
    }
    let (speed, force, seconds) = match (args.speed, args.force, args.seconds, default) {
        (Some(speed), Some(force), Some(seconds), _) => (speed, force, seconds),
        (speed, force, seconds, Some(default)) => {
            (speed.unwrap_or(default.0), force.unwrap_or(default.1), seconds.unwrap_or(default.2))
        }
        _ => bail!(output::Usage("give --speed V --force F --seconds S, or --stroke FILE".to_owned())),
    };
    if seconds > MAX_SECS {
        bail!("--seconds is {seconds}, but must be from 0 to {MAX_SECS}; choose a shorter duration");
    }
    Ok(Motion::Steady { contact: Contact::from_mm_per_s_and_n(speed, force), seconds })
}

impl Motion {
    /// Returns the duration in seconds.
    pub(crate) fn seconds(&self) -> f64 {
        match self {
            Self::Steady { seconds, .. } => *seconds,
            Self::Stroke { contacts, .. } => contacts.duration_secs(),
        }
    }

    /// Returns speed and force `time_secs` after the start.
    pub(crate) fn contact_at(&self, time_secs: f64) -> Contact {
        match self {
            Self::Steady { contact, .. } => *contact,
            Self::Stroke { contacts, .. } => contacts.contact_at(time_secs),
        }
    }

    /// Returns the position of the tip `time_secs` after the start, to the right and upwards, in m; `None` if only the
    /// speed is known.
    pub(crate) fn place_m_at(&self, time_secs: f64) -> Option<[f64; 2]> {
        match self {
            Self::Stroke { contacts: StrokeContacts::Track(track), .. } => {
                let touch = track.touch_at(time_secs);
                Some([touch.x_m, touch.y_m].map(f64::from))
            }
            Self::Steady { .. } | Self::Stroke { contacts: StrokeContacts::Given(_), .. } => None,
        }
    }

    /// Returns the file of the stroke.
    pub(crate) fn stroke_path(&self) -> Option<&Path> {
        match self {
            Self::Steady { .. } => None,
            Self::Stroke { path, .. } => Some(path),
        }
    }

    /// Returns the motion over time, for a sidecar.
    pub(crate) fn trace(&self) -> TraceV1 {
        match self {
            Self::Steady { contact, seconds } => steady_trace(*contact, *seconds),
            Self::Stroke { contacts, .. } => contacts.trace(),
        }
    }
}
