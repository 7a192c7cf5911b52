//! A recorded stroke, made ready to be replayed.

use shagreen_synth::contact::Contact;

use crate::kinematics::{SpeedEstimator, SpeedFilter, held_speed};
use crate::touch::{Touch, mix_contacts};

/// Points of a track a second, in Hz.
pub const TRACK_RATE_HZ: f64 = 1000.0;
/// Reports further apart than this are two strokes, in seconds, where they do not usually come as seldom.
pub const LIFT_GAP_SECS: f64 = 0.050;
/// Usual intervals after which they are: two reports in a row may be lost.
const LIFT_GAP_INTERVALS: f64 = 3.5;
/// Longest track, in seconds: what is longer is more likely a wrong unit.
pub const MAX_TRACK_SECS: f64 = 3600.0;

/// One report of a pen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenSample {
    /// When, in seconds on any clock.
    pub time_secs: f64,
    /// Position to the right of the middle of the pad, in m.
    pub x_m: f64,
    /// Position above the middle of the pad, in m.
    pub y_m: f64,
    /// Force in N; counts for nothing while the tip is off.
    pub force_n: f64,
    /// Whether the tip touches.
    pub touching: bool,
}

/// Why samples do not make a track.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// There is no sample.
    #[error("a stroke needs at least one sample, got none")]
    Empty,
    /// A number is not finite.
    #[error("sample {index} of the stroke holds a number that is not finite")]
    NotFinite {
        /// Which sample, from zero.
        index: usize,
    },
    /// A force is negative.
    #[error("sample {index} of the stroke has a force of {force_n} N; it must be at least zero")]
    NegativeForce {
        /// Which sample, from zero.
        index: usize,
        /// Its force, in N.
        force_n: f64,
    },
    /// Time goes back.
    #[error("sample {index} of the stroke is at {time_secs} s, before the sample at {previous_secs} s")]
    TimeGoesBack {
        /// Which sample, from zero.
        index: usize,
        /// Its time, in seconds.
        time_secs: f64,
        /// The time before it, in seconds.
        previous_secs: f64,
    },
    /// The stroke is longer than [`MAX_TRACK_SECS`].
    #[error("the stroke lasts {duration_secs} s, more than {MAX_TRACK_SECS} s: are its times in seconds?")]
    TooLong {
        /// How long it lasts, in seconds.
        duration_secs: f64,
    },
}

/// What was not quite as it should be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TrackWarnings {
    /// Samples left out because the next had the same time.
    pub n_equal_timestamps: usize,
}

/// A stroke on a uniform grid of [`TRACK_RATE_HZ`].
///
/// Each pen-down stretch has its speed from the Kalman filter on the real times of the reports. Between two reports
/// place, speed and force go in straight lines; towards a lift they stay, as they do for a live pen, until the lift.
/// Where reports end without a lift, speed is held and decays and the tip is off [`LIFT_GAP_SECS`] later, or after some of the
/// intervals of a slower recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    touches: Box<[Touch]>,
    duration_secs: f64,
    /// What was not quite as it should be.
    pub warnings: TrackWarnings,
}

impl Track {
    /// The track of the samples, which starts at the first of them.
    ///
    /// # Errors
    /// [`TrackError`] names the first sample that is not usable.
    pub fn new(samples: &[PenSample]) -> Result<Self, TrackError> {
        check(samples)?;
        let gap_secs = lift_gap_secs(samples);
        let (reports, warnings) = reports_of(samples, gap_secs);
        let (Some(first), Some(last)) = (reports.first(), reports.last()) else {
            return Err(TrackError::Empty);
        };
        let start_secs = first.time_secs;
        let duration_secs = last.time_secs - start_secs;
        if duration_secs > MAX_TRACK_SECS {
            return Err(TrackError::TooLong { duration_secs });
        }
        // Up to the last report: a millionth of a point is rounding of the times, not one more point.
        let n_touches = (duration_secs * TRACK_RATE_HZ - 1e-6).ceil().max(0.0) as usize + 1;
        let mut next = 0;
        let touches = (0..n_touches).map(|i| {
            let time_secs = start_secs + i as f64 / TRACK_RATE_HZ;
            while next < reports.len() && reports[next].time_secs <= time_secs {
                next += 1;
            }
            // The first report is at the first point of the grid, so there is one before.
            touch_between(&reports[next.saturating_sub(1)], reports.get(next), time_secs, gap_secs)
        });
        Ok(Self { touches: touches.collect(), duration_secs, warnings })
    }

    /// From the first sample to the last, in seconds.
    pub fn duration_secs(&self) -> f64 {
        self.duration_secs
    }

    /// The touch `time_secs` after the start, in a straight line between points of the grid; lifted outside the track.
    /// Costs two look-ups.
    pub fn touch_at(&self, time_secs: f64) -> Touch {
        let inside = time_secs >= 0.0 && time_secs <= self.duration_secs;
        let position = if inside { time_secs * TRACK_RATE_HZ } else { 0.0 };
        let index = position as usize;
        let edge = if time_secs > 0.0 { self.touches.last() } else { self.touches.first() };
        let Some(&edge) = edge else { return Touch::default() };
        if !inside {
            return edge.lifted();
        }
        let from = self.touches.get(index).copied().unwrap_or(edge);
        let to = self.touches.get(index + 1).copied().unwrap_or(from);
        let share = (position - index as f64) as f32;
        Touch {
            x_m: from.x_m + share * (to.x_m - from.x_m),
            y_m: from.y_m + share * (to.y_m - from.y_m),
            contact: mix_contacts(from.contact, to.contact, share),
        }
    }
}

fn check(samples: &[PenSample]) -> Result<(), TrackError> {
    let mut previous_secs = f64::NEG_INFINITY;
    for (index, sample) in samples.iter().enumerate() {
        let PenSample { time_secs, x_m, y_m, force_n, .. } = *sample;
        if ![time_secs, x_m, y_m, force_n].iter().all(|x| x.is_finite()) {
            return Err(TrackError::NotFinite { index });
        }
        if sample.touching && force_n < 0.0 {
            return Err(TrackError::NegativeForce { index, force_n });
        }
        if time_secs < previous_secs {
            return Err(TrackError::TimeGoesBack { index, time_secs, previous_secs });
        }
        previous_secs = time_secs;
    }
    Ok(())
}

/// A sample with the speed of its stroke.
struct Report {
    time_secs: f64,
    touch: Touch,
    touching: bool,
}

/// After how long without a report the tip of a recorded stroke is off, in seconds: [`LIFT_GAP_SECS`], or so many usual
/// intervals of a slower recording.
fn lift_gap_secs(samples: &[PenSample]) -> f64 {
    let mut intervals: Vec<f64> = samples
        .windows(2)
        .filter(|pair| pair[0].touching && pair[1].time_secs > pair[0].time_secs)
        .map(|pair| pair[1].time_secs - pair[0].time_secs)
        .collect();
    intervals.sort_by(f64::total_cmp);
    let usual_secs = intervals.get(intervals.len() / 2).copied().unwrap_or(0.0);
    LIFT_GAP_SECS.max(LIFT_GAP_INTERVALS * usual_secs)
}

/// One report a time, with speeds.
fn reports_of(samples: &[PenSample], gap_secs: f64) -> (Vec<Report>, TrackWarnings) {
    let mut reports: Vec<Report> = Vec::with_capacity(samples.len());
    let mut warnings = TrackWarnings::default();
    let mut estimator = SpeedEstimator::new(SpeedFilter::KALMAN);
    for (index, sample) in samples.iter().enumerate() {
        if samples.get(index + 1).is_some_and(|next| next.time_secs == sample.time_secs) {
            warnings.n_equal_timestamps += 1;
            continue;
        }
        let is_new_stroke = reports
            .last()
            .is_none_or(|previous| !previous.touching || sample.time_secs - previous.time_secs > gap_secs);
        if is_new_stroke {
            estimator.lift();
        }
        let contact = if sample.touching {
            let speed_mps = estimator.report(sample.time_secs, sample.x_m, sample.y_m) as f32;
            Contact { speed_mps, force_n: sample.force_n as f32 }
        } else {
            Contact::LIFTED
        };
        let touch = Touch { x_m: sample.x_m as f32, y_m: sample.y_m as f32, contact };
        reports.push(Report { time_secs: sample.time_secs, touch, touching: sample.touching });
    }
    (reports, warnings)
}

/// The touch at a time from `from` on and before `to`; reports further apart than the gap are of two strokes.
fn touch_between(from: &Report, to: Option<&Report>, time_secs: f64, gap_secs: f64) -> Touch {
    let age_secs = time_secs - from.time_secs;
    let near = to.filter(|to| to.time_secs - from.time_secs <= gap_secs);
    let mut touch = from.touch;
    if let Some(to) = near {
        let share = (age_secs / (to.time_secs - from.time_secs)) as f32;
        touch.x_m += share * (to.touch.x_m - touch.x_m);
        touch.y_m += share * (to.touch.y_m - touch.y_m);
        if from.touching && to.touching {
            touch.contact = mix_contacts(from.touch.contact, to.touch.contact, share);
            return touch;
        }
    } else if age_secs >= gap_secs {
        return touch.lifted();
    }
    touch.contact.speed_mps = held_speed(f64::from(touch.contact.speed_mps), age_secs) as f32;
    touch
}

#[cfg(test)]
mod tests;
