//! From the reports of a pen to touches.

use crate::hid::clock::ReportClock;
use crate::hid::landing::{Landing, LandingEstimator};
use crate::hid::pen::{PenDecoder, PenReport};
use crate::kinematics::{SpeedEstimator, SpeedFilter};
use crate::pressure::PressureMap;
use crate::touch::Touch;
use crate::track::PenSample;
use shagreen_synth::contact::Contact;

/// How reports become touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerOptions {
    /// How positions become a speed.
    pub speed_filter: SpeedFilter,
    /// How pressure becomes a force, for a pen that declares none.
    pub pressure_map: PressureMap,
}

/// What a pen did at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenMoment {
    /// When, in s: by the pen's own clock if it has one, else when the report arrived.
    pub time_secs: f64,
    /// What the pen reported.
    pub report: PenReport,
    /// Place to the right of and above the middle of the area, in m, where its size is known and the pen in range.
    pub place_m: Option<[f64; 2]>,
    /// Force in N, declared or by the map; zero while nothing touches.
    pub force_n: f64,
    /// What the engine is told: lifted where the size of the area is not known, since then there is no speed.
    pub touch: Touch,
    /// A landing that can be told as of this report.
    pub landing: Option<Landing>,
}

impl PenMoment {
    /// The moment as a sample of a stroke; `None` where there is no place in m.
    pub fn sample(&self) -> Option<PenSample> {
        let [x_m, y_m] = self.place_m?;
        let touching = self.report.touching();
        Some(PenSample { time_secs: self.time_secs, x_m, y_m, force_n: self.force_n, touching })
    }
}

/// The samples of a stretch of moments, for [`crate::track::Track::new`]: out of range, or without a size, there are
/// none.
pub fn stroke_samples(moments: &[PenMoment]) -> Vec<PenSample> {
    moments.iter().filter_map(PenMoment::sample).collect()
}

/// What is remembered from report to report.
#[derive(Clone, Debug)]
pub struct PenTracker {
    decoder: PenDecoder,
    options: TrackerOptions,
    clock: ReportClock,
    estimator: SpeedEstimator,
    landings: LandingEstimator,
    last_touch: Touch,
    last_pen: Option<Pen>,
}

/// Which pen it is, and which end.
type Pen = (Option<u32>, Option<u32>, bool);

impl PenTracker {
    /// A tracker before the first report.
    pub fn new(decoder: PenDecoder, options: TrackerOptions) -> Self {
        let clock = ReportClock::new(decoder.best().clock_round_secs);
        Self {
            decoder,
            options,
            clock,
            estimator: SpeedEstimator::new(options.speed_filter),
            landings: LandingEstimator::default(),
            last_touch: Touch::default(),
            last_pen: None,
        }
    }

    /// What is read, and how.
    pub fn decoder(&self) -> &PenDecoder {
        &self.decoder
    }

    /// Takes `map` for pressure from the next report on.
    pub fn set_pressure_map(&mut self, map: PressureMap) {
        self.options.pressure_map = map;
    }

    /// What the pen did by a report that arrived at `arrival_secs` (on any clock that does not go back); `None` if it
    /// is no report of a pen.
    pub fn report(&mut self, arrival_secs: f64, bytes: &[u8]) -> Option<PenMoment> {
        let (format, report) = self.decoder.decode_with_format(bytes)?;
        let size_m = format.size_m();
        let time_secs = self.clock.time_secs(arrival_secs, report.clock_secs);
        let pen = report.in_range.then_some((report.transducer, report.serial, report.inverted));
        if pen != self.last_pen {
            self.estimator.lift();
            self.landings.forget();
            self.last_pen = pen;
        }
        let touching = report.touching();
        let map = self.options.pressure_map;
        let force_n = match (report.force_n, report.pressure) {
            (Some(force_n), _) if touching => force_n,
            (_, pressure) => map.force_n(pressure.unwrap_or(0.0), touching),
        };
        let place_m = size_m
            .filter(|_| report.in_range)
            .map(|[width_m, height_m]| [(report.x_share - 0.5) * width_m, (0.5 - report.y_share) * height_m]);
        let contact = match place_m {
            Some([x_m, y_m]) if touching => {
                let speed_mps = self.estimator.report(time_secs, x_m, y_m) as f32;
                Contact { speed_mps, force_n: force_n as f32 }
            }
            _ => {
                self.estimator.lift();
                Contact::LIFTED
            }
        };
        let place = place_m.map_or([self.last_touch.x_m, self.last_touch.y_m], |p| p.map(|m| m as f32));
        let touch = Touch { x_m: place[0], y_m: place[1], contact }.sanitized();
        self.last_touch = touch;
        let landing = self.landings.report(time_secs, report.distance_m, force_n, touching);
        Some(PenMoment { time_secs, report, place_m, force_n, touch, landing })
    }

    /// The touch when the pen is gone: lifted where it was last.
    pub fn lift(&mut self) -> Touch {
        self.estimator.lift();
        self.landings.forget();
        self.last_pen = None;
        self.last_touch = self.last_touch.lifted();
        self.last_touch
    }
}

#[cfg(test)]
pub(crate) mod tests;
