//! Motion of the tip from arguments: a steady contact, or a stroke with speed and force at each row.

use pyo3::{Bound, PyAny, PyResult};
use shagreen_core::texture::{FORCES_N, SPEEDS_MPS};
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_formats::stroke::TimedContact;
use shagreen_studio::stroke_contacts::StrokeContacts;

use crate::arguments::number;
use crate::arrays::Track;
use crate::errors::{failed, refused};

/// Longest motion, in seconds.
const MAX_SECS: f64 = 3600.0;

/// Motion of the tip.
pub(crate) enum Motion {
    /// Constant speed and force.
    Steady {
        /// Speed and force.
        contact: Contact,
        /// Duration in seconds.
        seconds: f64,
    },
    /// Speed and force over time.
    Stroke(StrokeContacts),
}

impl Motion {
    /// Reads speed in m/s and force in N: numbers with a duration, or arrays with `rate_hz` rows a second, of which one may be a
    /// number.
    pub(crate) fn of(
        speed_mps: &Bound<'_, PyAny>,
        force_n: &Bound<'_, PyAny>,
        seconds: Option<&Bound<'_, PyAny>>,
        rate_hz: f64,
    ) -> PyResult<Self> {
        let speeds = speeds(speed_mps)?;
        let forces = forces(force_n)?;
        let n_rows = match (speeds.n_rows(), forces.n_rows()) {
            (None, None) => {
                let Some(seconds) = seconds else {
                    return Err(refused(
                        "seconds is missing; state the duration, or give arrays of speed and force",
                    ));
                };
                let seconds = number(seconds, "seconds", &(0.0..=MAX_SECS), " s")?;
                return Ok(Self::Steady { contact: contact(speeds.at(0), forces.at(0)), seconds });
            }
            (Some(n), Some(other)) if n != other => {
                return Err(refused(format!(
                    "speed_mps has {n} rows and force_n has {other}; give both the same number"
                )));
            }
            (Some(n), _) | (None, Some(n)) => n,
        };
        if seconds.is_some() {
            return Err(refused("the arrays state the duration; leave seconds out"));
        }
        if n_rows < 2 {
            return Err(refused(format!("a stroke needs at least 2 rows, got {n_rows}")));
        }
        let row = |row: usize| TimedContact {
            time_secs: row as f64 / rate_hz,
            speed_mps: speeds.at(row),
            force_n: forces.at(row),
            impact_mps: None,
        };
        let stroke = StrokeContacts::given((0..n_rows).map(row).collect());
        stroke.map(Self::Stroke).map_err(|error| failed(&error))
    }

    /// Duration in seconds, from the first row to the last.
    pub(crate) fn seconds(&self) -> f64 {
        match self {
            Self::Steady { seconds, .. } => *seconds,
            Self::Stroke(stroke) => stroke.duration_secs(),
        }
    }
}

/// Reads a constant contact.
pub(crate) fn contact_of(speed_mps: &Bound<'_, PyAny>, force_n: &Bound<'_, PyAny>) -> PyResult<Contact> {
    let speed_mps = number(speed_mps, "speed_mps", &(0.0..=*SPEEDS_MPS.end()), " m/s")?;
    let force_n = number(force_n, "force_n", &(0.0..=*FORCES_N.end()), " N")?;
    Ok(contact(speed_mps, force_n))
}

/// Reads speeds in m/s.
pub(crate) fn speeds(value: &Bound<'_, PyAny>) -> PyResult<Track> {
    Track::of(value, "speed_mps", &(0.0..=*SPEEDS_MPS.end()), " m/s")
}

/// Reads forces in N.
pub(crate) fn forces(value: &Bound<'_, PyAny>) -> PyResult<Track> {
    Track::of(value, "force_n", &(0.0..=*FORCES_N.end()), " N")
}

fn contact(speed_mps: f64, force_n: f64) -> Contact {
    Contact { speed: MetersPerSecond(speed_mps), force: Newtons(force_n) }
}
