//! Estimation of the tip speed from reported positions.
//!
//! Reports arrive at irregular times with a position noise of some hundredths of a millimeter. The Kalman filter
//! follows a stroke with a delay of a few milliseconds. The low-pass used with the published texture models of the Penn
//! Haptic Texture Toolkit (HaTT) has a delay of about 20 ms. All filters of [`SpeedFilter`] are available, so that
//! recordings made with any of them can be reproduced. Golden values: `vectors/l_stylus`.

use std::f64::consts::TAU;

/// Time for which the last speed is held after the last report, in seconds.
pub const HOLD_SECS: f64 = 0.020;
/// Time constant of the decay after the hold, in seconds.
pub const DECAY_SECS: f64 = 0.015;

/// Filter that estimates the speed, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedFilter {
    /// A constant-velocity Kalman filter on each axis.
    Kalman {
        /// Power spectral density of the white-noise acceleration, in m²/s³.
        acceleration_density_m2ps3: f64,
        /// Standard deviation of the position noise, in m.
        position_noise_m: f64,
    },
    /// The derivative stage of a one-euro filter. The filter's other two parameters smooth the position only.
    OneEuro {
        /// Cutoff of the low-pass on the derivative, in Hz.
        cutoff_hz: f64,
    },
    /// Two equal first-order low-passes, discretized by the backward Euler method.
    LowPass {
        /// Corner frequency of each, in rad/s.
        corner_radps: f64,
    },
}

impl SpeedFilter {
    /// The default: q = 1e5 mm²/s³ and r = (0.02 mm)².
    pub const KALMAN: Self = Self::Kalman { acceleration_density_m2ps3: 0.1, position_noise_m: 2e-5 };
    /// A one-euro filter whose derivative has a cutoff of 15 Hz.
    pub const ONE_EURO: Self = Self::OneEuro { cutoff_hz: 15.0 };
    /// The low-pass used with the published (HaTT) texture models, with corner frequency 125 rad/s.
    pub const LOW_PASS: Self = Self::LowPass { corner_radps: 125.0 };
}

/// Initial variance of the velocity in m²/s²: a standard deviation of 0.1 m/s.
const FIRST_VELOCITY_VARIANCE: f64 = 0.01;

/// Filter state of one axis. Every filter keeps a velocity; some also keep a second velocity or a covariance.
#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    last_m: f64,
    position_m: f64,
    velocity_mps: f64,
    earlier_velocity_mps: f64,
    covariance: [f64; 3],
}

impl Axis {
    fn start(filter: SpeedFilter, position_m: f64) -> Self {
        let covariance = match filter {
            SpeedFilter::Kalman { position_noise_m, .. } => {
                [position_noise_m * position_noise_m, 0.0, FIRST_VELOCITY_VARIANCE]
            }
            _ => [0.0; 3],
        };
        Self { last_m: position_m, position_m, covariance, ..Self::default() }
    }

    /// Velocity in m/s after a report that is `step_secs` later.
    fn step(&mut self, filter: SpeedFilter, step_secs: f64, measured_m: f64) -> f64 {
        let difference_mps = (measured_m - self.last_m) / step_secs;
        self.last_m = measured_m;
        match filter {
            SpeedFilter::Kalman { acceleration_density_m2ps3: q, position_noise_m } => {
                let (t, r) = (step_secs, position_noise_m * position_noise_m);
                let [pp, pv, vv] = self.covariance;
                let predicted_m = self.position_m + t * self.velocity_mps;
                let pp = pp + 2.0 * t * pv + t * t * vv + q * t * t * t / 3.0;
                let pv = pv + t * vv + q * t * t / 2.0;
                let vv = vv + q * t;
                let (gain_p, gain_v) = (pp / (pp + r), pv / (pp + r));
                let surprise_m = measured_m - predicted_m;
                self.position_m = predicted_m + gain_p * surprise_m;
                self.velocity_mps += gain_v * surprise_m;
                self.covariance = [pp - gain_p * pp, pv - gain_p * pv, vv - gain_v * pv];
            }
            SpeedFilter::OneEuro { cutoff_hz } => {
                let share = 1.0 / (1.0 + 1.0 / (TAU * cutoff_hz * step_secs));
                self.velocity_mps += share * (difference_mps - self.velocity_mps);
            }
            SpeedFilter::LowPass { corner_radps } => {
                let product = step_secs * corner_radps;
                let q = 1.0 + product;
                let next = (product / q).powi(2) * difference_mps + 2.0 / q * self.velocity_mps
                    - self.earlier_velocity_mps / (q * q);
                self.earlier_velocity_mps = self.velocity_mps;
                self.velocity_mps = next;
            }
        }
        self.velocity_mps
    }
}

/// Speed filter with its state during a stroke.
#[derive(Clone, Debug)]
pub struct SpeedEstimator {
    filter: SpeedFilter,
    last_secs: Option<f64>,
    x: Axis,
    y: Axis,
    speed_mps: f64,
}

impl SpeedEstimator {
    /// An estimator before its first report.
    pub fn new(filter: SpeedFilter) -> Self {
        Self { filter, last_secs: None, x: Axis::default(), y: Axis::default(), speed_mps: 0.0 }
    }

    /// Processes a position and returns the speed in m/s: zero at the first report of a stroke.
    ///
    /// A report that is not later than the last one, or not finite, is ignored.
    pub fn report(&mut self, time_secs: f64, x_m: f64, y_m: f64) -> f64 {
        if !(time_secs.is_finite() && x_m.is_finite() && y_m.is_finite()) {
            return self.speed_mps;
        }
        match self.last_secs {
            None => {
                self.x = Axis::start(self.filter, x_m);
                self.y = Axis::start(self.filter, y_m);
            }
            Some(last_secs) => {
                let step_secs = time_secs - last_secs;
                if step_secs <= 0.0 {
                    return self.speed_mps;
                }
                let x_mps = self.x.step(self.filter, step_secs, x_m);
                let y_mps = self.y.step(self.filter, step_secs, y_m);
                self.speed_mps = x_mps.hypot(y_mps);
            }
        }
        self.last_secs = Some(time_secs);
        self.speed_mps
    }

    /// Ends the stroke. The next report starts another one.
    pub fn lift(&mut self) {
        self.last_secs = None;
        self.speed_mps = 0.0;
    }
}

/// Returns the speed to play `age_secs` after the report that gave `speed_mps`. The speed is held for [`HOLD_SECS`] and
/// then decays with the time constant [`DECAY_SECS`], because a stylus at rest sends no reports.
pub fn held_speed(speed_mps: f64, age_secs: f64) -> f64 {
    // A negative or invalid age counts as zero.
    let late_secs = (age_secs - HOLD_SECS).max(0.0);
    speed_mps * (-late_secs / DECAY_SECS).exp()
}

#[cfg(test)]
mod tests {
    use super::{DECAY_SECS, HOLD_SECS, SpeedEstimator, SpeedFilter, held_speed};

    fn golden() -> serde_json::Value {
        serde_json::from_str(include_str!("../../../vectors/l_stylus/kin_vectors.json")).unwrap()
    }

    fn numbers(value: &serde_json::Value) -> Vec<f64> {
        value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    }

    #[test]
    fn every_filter_gives_its_golden_speeds() {
        let vec = &golden()["vec"];
        let (times, places_mm) = (numbers(&vec["t"]), numbers(&vec["x"]));
        for (name, filter) in [
            ("kalman", SpeedFilter::KALMAN),
            ("one_euro", SpeedFilter::ONE_EURO),
            ("lp2", SpeedFilter::LOW_PASS),
        ] {
            // Along either axis, and along a diagonal (3-4-5), the speed is the same.
            for (cos, sin) in [(1.0, 0.0), (0.0, -1.0), (0.6, 0.8)] {
                let mut estimator = SpeedEstimator::new(filter);
                for ((&t, &x_mm), expected) in times.iter().zip(&places_mm).zip(numbers(&vec[name])) {
                    let mmps = 1e3 * estimator.report(t, 1e-3 * x_mm * cos, 1e-3 * x_mm * sin);
                    assert!(
                        (mmps - expected).abs() <= 1e-9 * expected,
                        "{name} at {t}: {mmps} for {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_steady_stroke_is_measured_exactly() {
        for filter in [SpeedFilter::KALMAN, SpeedFilter::ONE_EURO, SpeedFilter::LOW_PASS] {
            let mut estimator = SpeedEstimator::new(filter);
            let mut speed = 0.0;
            for i in 0..400 {
                // Times are irregular.
                let t = f64::from(i) * 0.005 + 0.001 * f64::from(i % 3);
                speed = estimator.report(t, 0.1 * t, 0.0);
            }
            assert!((speed - 0.1).abs() < 1e-9, "{filter:?}: {speed}");
        }
    }

    #[test]
    fn late_equal_and_nonsense_reports_change_nothing() {
        let mut estimator = SpeedEstimator::new(SpeedFilter::KALMAN);
        estimator.report(0.0, 0.0, 0.0);
        let speed = estimator.report(0.01, 0.001, 0.0);
        assert!(speed > 0.0);
        for (t, x) in [(0.01, 5.0), (0.005, 5.0), (f64::NAN, 5.0), (0.02, f64::NAN)] {
            assert_eq!(estimator.report(t, x, 0.0), speed);
        }
        estimator.lift();
        assert_eq!(estimator.report(0.03, 9.0, 9.0), 0.0);
    }

    #[test]
    fn speed_is_held_and_then_decays() {
        assert_eq!(held_speed(0.2, 0.0), 0.2);
        assert_eq!(held_speed(0.2, HOLD_SECS), 0.2);
        assert!((held_speed(0.2, HOLD_SECS + DECAY_SECS) - 0.2 / std::f64::consts::E).abs() < 1e-15);
        assert_eq!(held_speed(0.2, -5.0), 0.2);
        assert!(held_speed(0.2, 1.0) < 1e-20);
    }
}
