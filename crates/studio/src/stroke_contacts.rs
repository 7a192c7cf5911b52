//! Strokes as speed and force over time: measured, or estimated from the positions of a pen.

use anyhow::Context as _;
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_device::track::{MAX_TRACK_SECS, PenSample, Track, TrackError};
use shagreen_formats::stroke::TimedContact;
use shagreen_formats::wav::TraceV1;

use crate::trace::{stroke_trace, track_trace};

/// Speed and force over time, for at most [`MAX_TRACK_SECS`].
#[derive(Clone, Debug)]
pub enum StrokeContacts {
    /// Estimated from the positions of a pen.
    Track(Track),
    /// As given, with linear interpolation.
    Given(Vec<TimedContact>),
}

/// Advice for a stroke that cannot be replayed.
pub const CORRECT: &str = "the stroke cannot be replayed; correct it, or the options that describe it";

impl StrokeContacts {
    /// Returns speed and force as given. A stroke longer than a [`Track`] may be is an error, as it is for the track.
    ///
    /// # Errors
    /// The stroke is longer than [`MAX_TRACK_SECS`].
    pub fn given(contacts: Vec<TimedContact>) -> anyhow::Result<Self> {
        let given = Self::Given(contacts);
        let duration_secs = given.duration_secs();
        if duration_secs > MAX_TRACK_SECS {
            return Err(TrackError::TooLong { duration_secs }).context(CORRECT);
        }
        Ok(given)
    }

    /// Returns the time from the first sample to the last, in seconds.
    pub fn duration_secs(&self) -> f64 {
        match self {
            Self::Track(track) => track.duration_secs(),
            Self::Given(contacts) => contacts.last().map_or(0.0, |last| last.time_secs),
        }
    }

    /// Returns speed and force `time_secs` after the start; zero outside the stroke.
    pub fn contact_at(&self, time_secs: f64) -> Contact {
        match self {
            Self::Track(track) => track.touch_at(time_secs).contact.into(),
            Self::Given(contacts) => given_at(contacts, time_secs),
        }
    }

    /// Returns speed, force and known positions and impact speeds over time, for a sidecar.
    pub fn trace(&self) -> TraceV1 {
        match self {
            Self::Track(track) => track_trace(track),
            Self::Given(contacts) => {
                let impacts = TimedContact::known_impacts(contacts);
                stroke_trace(self.duration_secs(), &mut |secs: f64| given_at(contacts, secs), &impacts)
            }
        }
    }

    /// Returns the stroke for an output, which replays positions: given speeds are integrated along a line.
    ///
    /// # Errors
    /// A given speed or force is not finite, or a force is negative.
    pub fn into_track(self) -> anyhow::Result<Track> {
        let duration_secs = self.duration_secs();
        match self {
            Self::Track(track) => Ok(track),
            Self::Given(contacts) => {
                let n_steps = (duration_secs / WALK_STEP_SECS).ceil() as usize;
                let mut x_m = 0.0;
                let samples: Vec<PenSample> = (0..=n_steps)
                    .map(|i| {
                        let time_secs = (i as f64 * WALK_STEP_SECS).min(duration_secs);
                        let contact = given_at(&contacts, time_secs);
                        let force_n = contact.force.0;
                        let sample = PenSample {
                            time_secs,
                            x_m,
                            y_m: 0.0,
                            force_n,
                            touching: force_n > 0.0,
                            impact_mps: impact_mps_at(&contacts, time_secs),
                        };
                        x_m += given_at(&contacts, time_secs + 0.5 * WALK_STEP_SECS).speed.0 * WALK_STEP_SECS;
                        sample
                    })
                    .collect();
                Track::new(&samples).context("the stroke cannot be played; correct it")
            }
        }
    }
}

/// Integration step of given speeds, in seconds.
const WALK_STEP_SECS: f64 = 0.002;

/// Returns the last contact up to a time, and the first after it.
fn around(contacts: &[TimedContact], time_secs: f64) -> (Option<&TimedContact>, Option<&TimedContact>) {
    let after = contacts.partition_point(|contact| contact.time_secs <= time_secs);
    (after.checked_sub(1).and_then(|i| contacts.get(i)), contacts.get(after))
}

/// Returns the impact speed of a contact that begins at this time, if the table states it.
fn impact_mps_at(contacts: &[TimedContact], time_secs: f64) -> Option<f64> {
    match around(contacts, time_secs) {
        (Some(from), Some(to)) => from.impact_mps_before(to),
        (Some(last), None) => last.impact_mps,
        (None, _) => None,
    }
}

/// Interpolates given speed and force linearly; zero outside the stroke.
fn given_at(contacts: &[TimedContact], time_secs: f64) -> Contact {
    let contact = |c: &TimedContact| (c.speed_mps, c.force_n);
    let (speed_mps, force_n) = match around(contacts, time_secs) {
        (Some(from), Some(to)) => {
            let share = (time_secs - from.time_secs) / (to.time_secs - from.time_secs);
            let mix = |a: f64, b: f64| a + share * (b - a);
            (mix(from.speed_mps, to.speed_mps), mix(from.force_n, to.force_n))
        }
        (Some(last), None) if last.time_secs == time_secs => contact(last),
        _ => (0.0, 0.0),
    };
    Contact { speed: MetersPerSecond(speed_mps), force: Newtons(force_n) }
}

#[cfg(test)]
mod tests {
    use super::{StrokeContacts, given_at};
    use shagreen_formats::stroke::TimedContact;

    fn given() -> Vec<TimedContact> {
        let contact =
            |time_secs, speed_mps, force_n| TimedContact { time_secs, speed_mps, force_n, impact_mps: None };
        vec![contact(0.0, 0.1, 1.0), contact(1.0, 0.3, 0.5), contact(1.5, 0.0, 0.5)]
    }

    #[test]
    fn between_given_contacts_lie_straight_lines() {
        for (time_secs, speed_mps, force_n) in [
            (0.0, 0.1, 1.0),
            (0.5, 0.2, 0.75),
            (1.0, 0.3, 0.5),
            (1.5, 0.0, 0.5),
            (1.6, 0.0, 0.0),
            (-1.0, 0.0, 0.0),
        ] {
            let contact = given_at(&given(), time_secs);
            assert!((contact.speed.0 - speed_mps).abs() < 1e-12 && (contact.force.0 - force_n).abs() < 1e-12);
        }
    }

    #[test]
    fn a_stroke_of_ages_is_refused_before_it_is_walked() {
        let lasting = |time_secs| {
            let contact =
                |time_secs| TimedContact { time_secs, speed_mps: 0.1, force_n: 1.0, impact_mps: None };
            StrokeContacts::given(vec![contact(0.0), contact(time_secs)])
        };
        assert!(lasting(3600.0).is_ok());
        for time_secs in [3600.1, 1e12, 1e300] {
            assert!(lasting(time_secs).is_err(), "{time_secs} s");
        }
    }

    #[test]
    fn a_landing_has_the_impact_speed_that_the_table_states() {
        let contact =
            |time_secs, force_n, impact_mps| TimedContact { time_secs, speed_mps: 0.0, force_n, impact_mps };
        let landings = vec![
            contact(0.0, 0.0, None),
            contact(0.1, 0.0, Some(0.05)),
            contact(0.2, 1.0, Some(0.0)),
            contact(0.3, 0.0, None),
            contact(0.4, 0.0, None),
            contact(0.5, 1.0, Some(0.2)),
            contact(0.6, 0.0, None),
            contact(0.7, 1.0, None),
        ];
        let track = StrokeContacts::Given(landings).into_track().unwrap();
        for (time_secs, impact_mps) in [(0.15, Some(0.05)), (0.45, Some(0.2)), (0.65, None)] {
            assert_eq!(track.impact_mps_at(time_secs), impact_mps, "{time_secs} s");
        }
    }

    #[test]
    fn a_table_that_starts_in_contact_lands_only_if_its_first_line_states_an_impact() {
        let contact =
            |time_secs, force_n, impact_mps| TimedContact { time_secs, speed_mps: 0.1, force_n, impact_mps };
        // The speed of the second line is not that of an impact.
        let landings = |impact_mps| {
            let table = vec![
                contact(0.0, 1.0, impact_mps),
                contact(0.5, 1.0, Some(0.3)),
                contact(0.6, 0.0, None),
                contact(0.7, 0.0, None),
                contact(0.8, 1.0, None),
            ];
            let track = StrokeContacts::Given(table).into_track().unwrap();
            track.landings().iter().map(|landing| (landing.time_secs, landing.impact_mps)).collect::<Vec<_>>()
        };
        for impact_mps in [None, Some(0.0)] {
            let landings = landings(impact_mps);
            assert!(landings.len() == 1 && (landings[0].0 - 0.7).abs() < 0.003, "{landings:?}");
        }
        let landings = landings(Some(0.2));
        assert_eq!((landings.len(), landings[0]), (2, (0.0, Some(0.2))));
    }

    #[test]
    fn given_speeds_are_played_as_they_are() {
        let track = StrokeContacts::Given(given()).into_track().unwrap();
        assert!((track.duration_secs() - 1.5).abs() < 1e-9);
        for i in 10..140 {
            let time_secs = f64::from(i) * 0.01;
            let played = f64::from(track.touch_at(time_secs).contact.speed_mps);
            // The speed filter lags a ramp of 0.6 m/s² by a few milliseconds.
            assert!((played - given_at(&given(), time_secs).speed.0).abs() < 0.005, "{time_secs}: {played}");
        }
    }
}
