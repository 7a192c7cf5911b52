//! Estimation of the times at which input samples were recorded, in the host's clock.
//!
//! Each callback reports the time of its first sample, often too late and never too early. The device's clock runs
//! slightly faster or slower than the host's. The estimator therefore keeps the earliest time of each second and fits a
//! line.

/// Length of the interval whose earliest time is kept, in seconds of device time.
const STRETCH_SECS: f64 = 1.0;
/// Number of intervals below which the drift is assumed to be zero, because a fit would follow the timing noise.
const LEAST_STRETCHES: f64 = 4.0;

/// Sample times `first_secs + (1 + drift) · idx / rate`, in seconds of the host's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SampleTimes {
    /// Time of sample 0, in seconds.
    pub(super) first_secs: f64,
    /// Relative excess of the device's second over the host's second; within ±1e-3 for real devices.
    pub(super) drift: f64,
}

impl SampleTimes {
    /// Returns the fractional sample index at a time in seconds; negative before the first sample.
    pub(super) fn index_at(&self, secs: f64, rate_hz: f64) -> f64 {
        (secs - self.first_secs) / (1.0 + self.drift) * rate_hz
    }
}

/// Running least-squares fit of the sample times, with a fixed number of sums for any recording length.
///
/// Let `s` be the standard deviation of the earliest times of the intervals. For a recording of `n` intervals, the
/// error at the first and the last sample is about `2 s / √n`. A delay that all callbacks share is not detected. Before
/// [`LEAST_STRETCHES`] intervals the drift is zero, an error of at most 0.4 ms for a clock that is 100 ppm off.
#[derive(Clone, Debug)]
pub(super) struct SampleClock {
    rate_hz: f64,
    /// Current interval: its number, the device time of the earliest report in seconds, and that report's offset in
    /// seconds.
    stretch: Option<(f64, f64, f64)>,
    earliest_secs: f64,
    n: f64,
    mean: [f64; 2],
    /// Sum of squared device times, and sum of products of device time and offset, both around their means.
    sums: [f64; 2],
}

impl SampleClock {
    /// An estimator before the first sample, for a device rate in Hz.
    pub(super) fn new(rate_hz: f64) -> Self {
        Self { rate_hz, stretch: None, earliest_secs: f64::INFINITY, n: 0.0, mean: [0.0; 2], sums: [0.0; 2] }
    }

    /// Records that sample `idx` was recorded at or before `secs` of the host's clock. Non-finite times are ignored.
    pub(super) fn note(&mut self, idx: u64, secs: f64) {
        let place_secs = idx as f64 / self.rate_hz;
        let late_secs = secs - place_secs;
        if !late_secs.is_finite() {
            return;
        }
        self.earliest_secs = self.earliest_secs.min(late_secs);
        let stretch = (place_secs / STRETCH_SECS).floor();
        match &mut self.stretch {
            Some((now, place, earliest)) if *now == stretch => {
                if late_secs < *earliest {
                    (*place, *earliest) = (place_secs, late_secs);
                }
            }
            before => {
                let done = before.replace((stretch, place_secs, late_secs));
                if let Some((_, place_secs, late_secs)) = done {
                    self.keep(place_secs, late_secs);
                }
            }
        }
    }

    /// Returns the current estimate, or `None` before the first sample.
    pub(super) fn times(&self) -> Option<SampleTimes> {
        let [mean_place, mean_late] = self.mean;
        let [squares, products] = self.sums;
        if self.n >= LEAST_STRETCHES && squares > 0.0 {
            let drift = products / squares;
            return Some(SampleTimes { first_secs: mean_late - drift * mean_place, drift });
        }
        self.earliest_secs.is_finite().then_some(SampleTimes { first_secs: self.earliest_secs, drift: 0.0 })
    }

    fn keep(&mut self, place_secs: f64, late_secs: f64) {
        self.n += 1.0;
        let before = place_secs - self.mean[0];
        self.mean[0] += before / self.n;
        self.mean[1] += (late_secs - self.mean[1]) / self.n;
        self.sums[0] += before * (place_secs - self.mean[0]);
        self.sums[1] += before * (late_secs - self.mean[1]);
    }
}

#[cfg(test)]
mod tests {
    use super::{SampleClock, SampleTimes};

    /// Simulates a device at 44.1 kHz with a given drift and duration: blocks of 441 samples, reported up to
    /// milliseconds late. The first sample is recorded at 2 s.
    fn recorded(drift: f64, secs: f64) -> SampleClock {
        let mut clock = SampleClock::new(44_100.0);
        let mut state = 1_u64;
        for block in 0..(secs * 100.0) as u64 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // The delay is exponentially distributed with a mean of 0.5 ms; it rarely reaches 5 ms.
            let late_secs = -5e-4 * ((state >> 11) as f64 / 2_f64.powi(53) + 1e-300).ln();
            clock.note(441 * block, 2.0 + (1.0 + drift) * 0.01 * block as f64 + late_secs);
        }
        clock
    }

    #[test]
    fn clocks_that_drift_are_followed_for_as_long_as_it_takes() {
        for drift in [-200e-6, -3e-6, 0.0, 80e-6, 200e-6] {
            for secs in [6.0, 16.0, 600.0, 7200.0] {
                let times = recorded(drift, secs).times().unwrap();
                // The earliest of 100 delays has a mean and a standard deviation of 5 µs.
                assert!((times.first_secs - 2.0).abs() < 4e-5, "{drift} in {secs} s: {times:?}");
                for share in [0.0, 0.5, 1.0] {
                    let idx = share * secs * 44_100.0;
                    let at_secs = 2.0 + (1.0 + drift) * share * secs;
                    let off_secs = (times.index_at(at_secs, 44_100.0) - idx) / 44_100.0;
                    assert!(off_secs.abs() < 4e-5, "{drift} at {at_secs} s: {off_secs} s");
                }
            }
        }
        // Control: the smallest offset alone fails over ten minutes on a device whose clock is 80 ppm fast.
        let fast = recorded(-80e-6, 600.0);
        assert!((fast.earliest_secs - 2.0).abs() > 0.045);
    }

    #[test]
    fn a_short_recording_has_its_earliest_time() {
        let mut clock = SampleClock::new(1000.0);
        assert_eq!(clock.times(), None);
        clock.note(0, f64::NAN);
        assert_eq!(clock.times(), None);
        for (idx, secs) in [(0, 1.004), (100, 1.101), (200, 1.207)] {
            clock.note(idx, secs);
        }
        let times = clock.times().unwrap();
        assert!((times.first_secs - 1.001).abs() < 1e-12 && times.drift == 0.0);
        assert!((times.index_at(1.101, 1000.0) - 100.0).abs() < 1e-9);
        let before = SampleTimes { first_secs: 1.0, drift: 0.0 }.index_at(0.5, 1000.0);
        assert!((before + 500.0).abs() < 1e-9);
    }
}
