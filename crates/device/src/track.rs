//! A recorded stroke, prepared for replay.

mod coarse;

use shagreen_synth::contact::Contact;

use crate::kinematics::{SpeedEstimator, SpeedFilter, held_speed};
use crate::touch::{Touch, mix_contacts};
use crate::track::coarse::{COARSE_INTERVAL_SECS, coarse_speeds};

/// Rate of a track's points, in Hz.
pub const TRACK_RATE_HZ: f64 = 1000.0;
/// Shortest time without reports that separates two strokes, in seconds; longer for recordings with long report
/// intervals.
pub const LIFT_GAP_SECS: f64 = 0.050;
/// The same limit for recordings with long report intervals, in median report intervals; it tolerates two lost reports
/// in a row.
const LIFT_GAP_INTERVALS: f64 = 3.5;
/// Longest track, in seconds; a longer one probably has times in another unit.
pub const MAX_TRACK_SECS: f64 = 3600.0;

/// One pen report of a stroke recording.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenSample {
    /// Time in seconds on any clock.
    pub time_secs: f64,
    /// Position from the pad's center towards its right edge, in m.
    pub x_m: f64,
    /// Position from the pad's center towards its upper edge, in m.
    pub y_m: f64,
    /// Normal force in N; ignored while the tip is lifted.
    pub force_n: f64,
    /// Whether the tip touches.
    pub touching: bool,
    /// Speed of the tip towards the surface in m/s, if known; it counts where a contact begins.
    pub impact_mps: Option<f64>,
}

/// Reasons why samples do not form a track.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// There are no samples.
    #[error("the stroke has no samples; it needs at least one")]
    Empty,
    /// A value is not finite.
    #[error("sample {index} of the stroke has a value that is not finite; remove or correct it")]
    NotFinite {
        /// Index of the sample, from zero.
        index: usize,
    },
    /// A force is negative.
    #[error("sample {index} of the stroke has a negative force ({force_n} N); remove it or correct its sign")]
    NegativeForce {
        /// Index of the sample, from zero.
        index: usize,
        /// Force of the sample, in N.
        force_n: f64,
    },
    /// Times decrease.
    #[error(
        "sample {index} of the stroke is at {time_secs} s, after one at {previous_secs} s; sort them by time"
    )]
    TimeGoesBack {
        /// Index of the sample, from zero.
        index: usize,
        /// Time of the sample, in seconds.
        time_secs: f64,
        /// Time of the previous sample, in seconds.
        previous_secs: f64,
    },
    /// The stroke is longer than [`MAX_TRACK_SECS`].
    #[error("the stroke lasts {duration_secs} s, more than {MAX_TRACK_SECS} s; are its times in seconds?")]
    TooLong {
        /// Duration of the stroke, in seconds.
        duration_secs: f64,
    },
}

/// Imperfections of the samples that are not errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TrackWarnings {
    /// Number of samples that were skipped because the next sample had the same time.
    pub n_equal_timestamps: usize,
}

/// A stroke on a uniform time grid of [`TRACK_RATE_HZ`].
///
/// Each contact segment gets its speed from the Kalman filter, with the actual times of the reports. If the reports are
/// usually more than 25 ms apart, it gets its speed from the distances between them instead. Between two reports, position,
/// speed and force are interpolated linearly. Before a lift, force is held, and speed is held and decays, as for a live pen.
/// Where reports end without a lift, speed is held and decays, and the tip is lifted after [`LIFT_GAP_SECS`], or later in
/// recordings with long report intervals.
///
/// Each contact begins with a landing, except that of a first sample which is already in contact and states no impact
/// speed above zero: nobody knows when that tip landed.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    touches: Box<[Touch]>,
    landings: Box<[TrackLanding]>,
    duration_secs: f64,
    /// Imperfections of the samples.
    pub warnings: TrackWarnings,
}

/// Landing of the tip in a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackLanding {
    /// Time since the start of the track, in seconds.
    pub time_secs: f64,
    /// Impact speed in m/s, if the samples state it: the higher value of the last sample in the air and the first in
    /// contact.
    pub impact_mps: Option<f32>,
}

impl Track {
    /// Returns the track of the samples, which starts at the first one.
    ///
    /// # Errors
    /// [`TrackError`] names the first invalid sample.
    pub fn new(samples: &[PenSample]) -> Result<Self, TrackError> {
        check(samples)?;
        let reported = last_at_each_time(samples);
        let warnings = TrackWarnings { n_equal_timestamps: samples.len() - reported.len() };
        let usual_secs = usual_interval_secs(&reported);
        let gap_secs = LIFT_GAP_SECS.max(LIFT_GAP_INTERVALS * usual_secs);
        let mut reports = reports_of(&reported, gap_secs);
        if usual_secs > COARSE_INTERVAL_SECS {
            set_coarse_speeds(&mut reports, &reported, gap_secs);
        }
        let (Some(first), Some(last)) = (reports.first(), reports.last()) else {
            return Err(TrackError::Empty);
        };
        let start_secs = first.time_secs;
        let duration_secs = last.time_secs - start_secs;
        if duration_secs > MAX_TRACK_SECS {
            return Err(TrackError::TooLong { duration_secs });
        }
        // The grid ends at the last report. A millionth of a grid step is rounding, not another point.
        let n_touches = (duration_secs * TRACK_RATE_HZ - 1e-6).ceil().max(0.0) as usize + 1;
        let mut next = 0;
        let touches = (0..n_touches).map(|i| {
            let time_secs = start_secs + i as f64 / TRACK_RATE_HZ;
            while next < reports.len() && reports[next].time_secs <= time_secs {
                next += 1;
            }
            // The first grid point coincides with the first report, so there is always a report before.
            touch_between(&reports[next.saturating_sub(1)], reports.get(next), time_secs, gap_secs)
        });
        let touches = touches.collect();
        Ok(Self { touches, landings: landings_of(&reports, start_secs, gap_secs), duration_secs, warnings })
    }

    /// Duration from the first to the last sample, in seconds.
    pub fn duration_secs(&self) -> f64 {
        self.duration_secs
    }

    /// All landings, in order of time.
    pub fn landings(&self) -> &[TrackLanding] {
        &self.landings
    }

    /// Returns the landing that began the contact in progress `time_secs` after the start; `None` if that contact has no
    /// landing. Cost: one binary search.
    pub fn landing_at(&self, time_secs: f64) -> Option<TrackLanding> {
        // Between two points of the grid, a contact begins up to one step before its first report.
        let latest_secs = time_secs + 1.0 / TRACK_RATE_HZ;
        let n_begun = self.landings.partition_point(|landing| landing.time_secs <= latest_secs);
        self.landings.get(n_begun.checked_sub(1)?).copied()
    }

    /// Returns the impact speed in m/s of the contact in progress `time_secs` after the start, if the samples state it.
    /// Cost: one binary search.
    pub fn impact_mps_at(&self, time_secs: f64) -> Option<f32> {
        self.landing_at(time_secs)?.impact_mps
    }

    /// Returns the touch `time_secs` after the start, interpolated linearly between grid points; lifted outside the
    /// track. Cost: two table look-ups.
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
        let PenSample { time_secs, x_m, y_m, force_n, impact_mps, .. } = *sample;
        if ![time_secs, x_m, y_m, force_n, impact_mps.unwrap_or(0.0)].iter().all(|x| x.is_finite()) {
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

/// A sample with its estimated speed.
struct Report {
    time_secs: f64,
    touch: Touch,
    touching: bool,
    impact_mps: Option<f32>,
}

/// Returns the median interval in seconds from a sample in contact to the next one; zero without one. It decides the gap
/// after which the tip of a recorded stroke is lifted: [`LIFT_GAP_SECS`], or [`LIFT_GAP_INTERVALS`] of it.
fn usual_interval_secs(samples: &[PenSample]) -> f64 {
    let mut intervals: Vec<f64> = samples
        .windows(2)
        .filter(|pair| pair[0].touching && pair[1].time_secs > pair[0].time_secs)
        .map(|pair| pair[1].time_secs - pair[0].time_secs)
        .collect();
    intervals.sort_by(f64::total_cmp);
    intervals.get(intervals.len() / 2).copied().unwrap_or(0.0)
}

/// Returns the last sample at each time.
fn last_at_each_time(samples: &[PenSample]) -> Vec<PenSample> {
    let groups = samples.chunk_by(|a, b| a.time_secs == b.time_secs);
    groups.filter_map(|group| group.last().copied()).collect()
}

/// Replaces the speeds of reports that are far apart by those of the distances between them.
fn set_coarse_speeds(reports: &mut [Report], samples: &[PenSample], gap_secs: f64) {
    for (report, speed_mps) in reports.iter_mut().zip(coarse_speeds(samples, gap_secs)) {
        if report.touching {
            report.touch.contact.speed_mps = speed_mps as f32;
        }
    }
}

/// Returns one report per sample, with speeds.
fn reports_of(samples: &[PenSample], gap_secs: f64) -> Vec<Report> {
    let mut reports: Vec<Report> = Vec::with_capacity(samples.len());
    let mut estimator = SpeedEstimator::new(SpeedFilter::KALMAN);
    for sample in samples {
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
        reports.push(Report {
            time_secs: sample.time_secs,
            touch,
            touching: sample.touching,
            impact_mps: sample.impact_mps.map(|mps| mps as f32),
        });
    }
    reports
}

/// Returns the landings, at times since the start.
fn landings_of(reports: &[Report], start_secs: f64, gap_secs: f64) -> Box<[TrackLanding]> {
    let mut landings = Vec::new();
    let mut last: Option<&Report> = None;
    for report in reports {
        let is_first = last.is_none();
        let before = last.filter(|before| report.time_secs - before.time_secs <= gap_secs);
        last = Some(report);
        if !report.touching || before.is_some_and(|before| before.touching) {
            continue;
        }
        if is_first && report.impact_mps.is_none_or(|mps| mps <= 0.0) {
            continue; // The stroke starts in contact.
        }
        let in_air = before.and_then(|before| before.impact_mps);
        let impact_mps = [in_air, report.impact_mps].into_iter().flatten().reduce(f32::max);
        landings.push(TrackLanding { time_secs: report.time_secs - start_secs, impact_mps });
    }
    landings.into_boxed_slice()
}

/// Returns the touch at a time between two reports. Reports further apart than the gap belong to two strokes.
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
