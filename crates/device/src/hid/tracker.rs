//! Conversion of pen reports to touches.

use crate::hid::clock::ReportClock;
use crate::hid::landing::{ImpactSpeedEstimator, Landing};
use crate::hid::pen::{PenDecoder, PenReport};
use crate::kinematics::{SpeedEstimator, SpeedFilter};
use crate::pressure::PressureMap;
use crate::touch::Touch;
use crate::track::PenSample;
use shagreen_synth::contact::Contact;

/// Settings for the conversion of reports to touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerOptions {
    /// Speed estimator.
    pub speed_filter: SpeedFilter,
    /// Conversion of pressure to force, for a pen that declares no force.
    pub pressure_map: PressureMap,
}

/// One pen sample: a report with the quantities derived from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedSample {
    /// Time in s, by the pen's own clock if it has one, otherwise by the arrival of the report.
    pub time_secs: f64,
    /// The decoded report.
    pub report: PenReport,
    /// Position right of and above the center of the active area, in m, if its size is known and the pen is in range.
    pub place_m: Option<[f64; 2]>,
    /// Force in N, declared or from the pressure map; zero without contact.
    pub force_n: f64,
    /// Touch for the engine. It is lifted if the size of the area is unknown, because there is no speed then.
    pub touch: Touch,
    /// Contact onset that can be estimated with this report.
    pub landing: Option<Landing>,
    /// Impact speed in m/s of a contact that begins with this report, as far as it is known now: a tap transient cannot
    /// wait for more reports ([`ImpactSpeedEstimator::first_estimate_mps`]).
    pub impact_mps: Option<f32>,
}

impl TrackedSample {
    /// Returns the sample of a stroke, or `None` without a position in m.
    pub fn sample(&self) -> Option<PenSample> {
        let [x_m, y_m] = self.place_m?;
        let touching = self.report.touching();
        let impact_mps = self.impact_mps.map(f64::from);
        Some(PenSample { time_secs: self.time_secs, x_m, y_m, force_n: self.force_n, touching, impact_mps })
    }
}

/// Converts pen samples to stroke samples, for [`crate::track::Track::new`]. Pen samples out of range or without a
/// known size are skipped.
pub fn stroke_samples(moments: &[TrackedSample]) -> Vec<PenSample> {
    moments.iter().filter_map(TrackedSample::sample).collect()
}

/// Converter of pen reports to touches, with its state between reports.
#[derive(Clone, Debug)]
pub struct PenTracker {
    decoder: PenDecoder,
    options: TrackerOptions,
    clock: ReportClock,
    estimator: SpeedEstimator,
    landings: ImpactSpeedEstimator,
    last_touch: Touch,
    last_pen: Option<Pen>,
}

/// Identity of the pen: transducer index, serial number, and whether it is inverted.
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
            landings: ImpactSpeedEstimator::default(),
            last_touch: Touch::default(),
            last_pen: None,
        }
    }

    /// The decoder of the reports.
    pub fn decoder(&self) -> &PenDecoder {
        &self.decoder
    }

    /// Sets the pressure map from the next report on.
    pub fn set_pressure_map(&mut self, map: PressureMap) {
        self.options.pressure_map = map;
    }

    /// Processes a report that arrived at `arrival_secs`, on any clock that does not decrease. Returns `None` if it is
    /// not a pen report.
    pub fn report(&mut self, arrival_secs: f64, bytes: &[u8]) -> Option<TrackedSample> {
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
        let impact_mps = self.landings.first_estimate_mps();
        Some(TrackedSample { time_secs, report, place_m, force_n, touch, landing, impact_mps })
    }

    /// Returns the touch after the pen was disconnected: lifted at its last position.
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
