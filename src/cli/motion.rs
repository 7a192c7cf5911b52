//! What the tip does: a steady contact, or a recorded stroke.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::units::Contact;
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::wav::TraceV1;

use crate::cli::output;
use crate::cli::stroke::{self, StrokeContacts};
use crate::cli::stroke_args::StrokeArgs;

#[derive(clap::Args)]
pub(crate) struct MotionArgs {
    /// Speed of the tip, in mm/s.
    #[arg(long, value_name = "V", value_parser = quantity, conflicts_with = "stroke")]
    speed: Option<f64>,
    /// Normal force of the tip, in N.
    #[arg(long, value_name = "F", value_parser = quantity, conflicts_with = "stroke")]
    force: Option<f64>,
    /// Length, in seconds.
    #[arg(long, value_name = "S", value_parser = quantity, conflicts_with = "stroke")]
    seconds: Option<f64>,
    /// Recorded stroke: pen samples (.svc), or a table with t, x, y, pressure or force; or with t, speed, force (.csv); or
    /// reports of a pen with its descriptor, as hid-recorder and usbhid-dump write them.
    #[arg(long, value_name = "FILE")]
    stroke: Option<PathBuf>,
    #[command(flatten)]
    reading: StrokeArgs,
}

/// Longest steady contact that is rendered or played, in seconds: as long as a stroke may be.
const MAX_SECS: f64 = MAX_TRACK_SECS;

/// What the tip does, and for how long: [`MAX_SECS`] at most.
pub(crate) enum Motion {
    /// The same all the time.
    Steady {
        /// Speed and force.
        contact: Contact,
        /// How long, in seconds.
        seconds: f64,
    },
    /// As it was recorded.
    Stroke {
        /// The recording.
        contacts: StrokeContacts,
        /// Its file.
        path: PathBuf,
    },
}

/// A finite number from zero up.
pub(crate) fn quantity(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("it must be a number from 0 up".to_owned()),
    }
}

/// A quantity within a range, in words with its unit as in "0.8 to 60 seconds".
pub(crate) fn within(text: &str, range: &std::ops::RangeInclusive<f64>, unit: &str) -> Result<f64, String> {
    let value = quantity(text)?;
    if range.contains(&value) {
        Ok(value)
    } else {
        Err(format!("it must be {} to {} {unit}", range.start(), range.end()))
    }
}

/// A quantity above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let value = quantity(text)?;
    if value > 0.0 { Ok(value) } else { Err("it must be above 0".to_owned()) }
}

/// What the arguments say. `default` is taken where they say nothing; without it, saying nothing is wrong usage.
pub(crate) fn motion(args: &MotionArgs, default: Option<(f64, f64, f64)>) -> anyhow::Result<Motion> {
    if let Some(path) = &args.stroke {
        return Ok(Motion::Stroke { contacts: stroke::load(path, &args.reading)?, path: path.clone() });
    }
    if let Some(option) = args.reading.given().next() {
        bail!(output::Usage(format!(
            "{option} says how a stroke is read; give --stroke FILE, or leave it out"
        )));
    }
    let (speed, force, seconds) = match (args.speed, args.force, args.seconds, default) {
        (Some(speed), Some(force), Some(seconds), _) => (speed, force, seconds),
        (speed, force, seconds, Some(default)) => {
            (speed.unwrap_or(default.0), force.unwrap_or(default.1), seconds.unwrap_or(default.2))
        }
        _ => bail!(output::Usage("say --speed V --force F --seconds S, or --stroke FILE".to_owned())),
    };
    if seconds > MAX_SECS {
        bail!("--seconds must be from 0 to {MAX_SECS}, got {seconds}; choose a shorter time");
    }
    Ok(Motion::Steady { contact: Contact::from_mm_per_s_and_n(speed, force), seconds })
}

/// Most points of a trace in a sidecar.
const MAX_TRACE_POINTS: f64 = 20_000.0;
/// Usual distance of the points of a trace, in seconds.
const TRACE_STEP_SECS: f64 = 0.01;

impl Motion {
    /// How long, in seconds.
    pub(crate) fn seconds(&self) -> f64 {
        match self {
            Self::Steady { seconds, .. } => *seconds,
            Self::Stroke { contacts, .. } => contacts.duration_secs(),
        }
    }

    /// Speed and force `time_secs` after the start.
    pub(crate) fn contact_at(&self, time_secs: f64) -> Contact {
        match self {
            Self::Steady { contact, .. } => *contact,
            Self::Stroke { contacts, .. } => contacts.contact_at(time_secs),
        }
    }

    /// Where the tip is along x `time_secs` after the start, in m; `None` where only its speed is known.
    pub(crate) fn place_m_at(&self, time_secs: f64) -> Option<f64> {
        match self {
            Self::Stroke { contacts: StrokeContacts::Track(track), .. } => {
                Some(f64::from(track.touch_at(time_secs).x_m))
            }
            Self::Steady { .. } | Self::Stroke { contacts: StrokeContacts::Given(_), .. } => None,
        }
    }

    /// The file of the stroke.
    pub(crate) fn stroke_path(&self) -> Option<&Path> {
        match self {
            Self::Steady { .. } => None,
            Self::Stroke { path, .. } => Some(path),
        }
    }

    /// Speed and force over time, for a sidecar.
    pub(crate) fn trace(&self) -> TraceV1 {
        let seconds = self.seconds();
        let times: Vec<f64> = match self {
            Self::Steady { .. } => vec![0.0, seconds],
            Self::Stroke { .. } => {
                let step_secs = TRACE_STEP_SECS.max(seconds / MAX_TRACE_POINTS);
                (0..=(seconds / step_secs) as usize).map(|i| i as f64 * step_secs).collect()
            }
        };
        let contacts: Vec<Contact> = times.iter().map(|t| self.contact_at(*t)).collect();
        TraceV1 {
            time_s: times.into_iter().map(short).collect(),
            speed_mm_per_s: contacts.iter().map(|c| short(c.speed.mm_per_s())).collect(),
            force_n: contacts.iter().map(|c| short(c.force.0)).collect(),
        }
    }
}

/// Rounded to four decimals: a tenth of a millisecond, of a µm/s, of a mN.
fn short(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
