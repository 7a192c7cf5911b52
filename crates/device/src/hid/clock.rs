//! Time stamps of reports: by the device's own clock while it is plausible, otherwise by arrival time.
//!
//! The device's clock is free of transport jitter, which matters because speed is a difference of positions over a
//! difference of times. Some devices send a clock that stands still or has an undeclared rate. The clock is therefore
//! compared with the arrival times and permanently ignored if it disagrees. Without a clock, the arrival times are
//! fitted to the constant report rate of pens, if there is one.

mod report_interval;

use self::report_interval::ReportIntervalEstimator;

/// Largest deviation of the device's clock from the arrival times, in s; it exceeds the transport jitter.
const MAX_DISAGREEMENT_SECS: f64 = 0.050;
/// Number of disagreements after which the clock is ignored.
const MAX_DISAGREEMENTS: u32 = 3;

/// Time stamps for the reports of one device.
#[derive(Clone, Debug)]
pub struct ReportClock {
    round_secs: Option<f64>,
    n_disagreements: u32,
    beat: ReportIntervalEstimator,
    last: Option<Last>,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    /// All values in s.
    arrival: f64,
    reading: Option<f64>,
    time: f64,
}

impl ReportClock {
    /// For a device whose clock wraps around after `round_secs`; `None` if it has no clock.
    pub fn new(round_secs: Option<f64>) -> Self {
        Self { round_secs, n_disagreements: 0, beat: ReportIntervalEstimator::new(), last: None }
    }

    /// Returns the time of a report in s, on the clock of `arrival_secs` and never before the previous report. Without
    /// the device's clock, it is never after the arrival time.
    pub fn time_secs(&mut self, arrival_secs: f64, reading_secs: Option<f64>) -> f64 {
        let beat_secs = self.beat.time_secs(arrival_secs);
        let time_secs = match self.last {
            None => arrival_secs,
            Some(last) => {
                let by_clock = self.by_clock_secs(last, arrival_secs, reading_secs);
                by_clock.unwrap_or(beat_secs).max(last.time)
            }
        };
        self.last = Some(Last { arrival: arrival_secs, reading: reading_secs, time: time_secs });
        time_secs
    }

    /// Returns the time by the device's own clock, or `None` if that clock is absent or ignored.
    fn by_clock_secs(&mut self, last: Last, arrival_secs: f64, reading_secs: Option<f64>) -> Option<f64> {
        let is_trusted = self.n_disagreements < MAX_DISAGREEMENTS;
        let round_secs = self.round_secs.filter(|_| is_trusted)?;
        let (before_secs, now_secs) = last.reading.zip(reading_secs)?;
        let time_secs = last.time + (now_secs - before_secs).rem_euclid(round_secs);
        if (time_secs - arrival_secs).abs() <= MAX_DISAGREEMENT_SECS {
            return Some(time_secs);
        }
        // After a pause the clock may have wrapped around. Only consecutive reports count as a disagreement.
        if arrival_secs - last.arrival <= MAX_DISAGREEMENT_SECS {
            self.n_disagreements += 1;
        }
        Some(arrival_secs)
    }
}

#[cfg(test)]
mod tests {
    use super::ReportClock;

    /// Steps of 5 ms that arrive with a jitter of up to 4 ms, and a clock that wraps around every 6.5536 s.
    fn arrival_and_reading(i: u32) -> (f64, f64) {
        let time = f64::from(i) * 0.005;
        (10.0 + time + 0.001 * f64::from(i % 5), (3.0 + time).rem_euclid(6.5536))
    }

    #[test]
    fn a_good_clock_takes_the_jitter_away() {
        let mut clock = ReportClock::new(Some(6.5536));
        let times: Vec<f64> = (0..4000)
            .map(|i| {
                let (arrival, reading) = arrival_and_reading(i);
                clock.time_secs(arrival, Some(reading))
            })
            .collect();
        // 20 s are three wraparounds.
        for pair in times.windows(2) {
            assert!((pair[1] - pair[0] - 0.005).abs() < 1e-9);
        }
    }

    #[test]
    fn without_a_clock_the_times_of_arrival_count_on_their_even_beat() {
        for (round, reading) in [(None, None), (None, Some(1.0)), (Some(6.5536), None)] {
            let mut clock = ReportClock::new(round);
            let mut before = 0.0;
            for i in 0..400 {
                let (arrival, _) = arrival_and_reading(i);
                let time = clock.time_secs(arrival, reading);
                assert!(time <= arrival, "{i}");
                // The undelayed reports define the report interval.
                assert!(i < 128 || (time - before - 0.005).abs() < 1e-4, "{i}: {}", time - before);
                before = time;
            }
        }
    }

    #[test]
    fn a_clock_that_stands_or_runs_wrong_is_given_up() {
        for rate in [0.0, 0.1, 10.0] {
            let mut clock = ReportClock::new(Some(6.5536));
            let mut time = 0.0;
            for i in 0..1000 {
                let (arrival, _) = arrival_and_reading(i);
                let before = time;
                time = clock.time_secs(arrival, Some((f64::from(i) * 0.005 * rate).rem_euclid(6.5536)));
                assert!(time >= before, "{rate}");
                // Afterwards, the fitted time is at most the jitter before the arrival time.
                if i > 100 {
                    assert!((-1e-12..0.005).contains(&(arrival - time)), "{rate} {i}");
                }
            }
        }
    }

    #[test]
    fn a_pause_is_as_long_as_it_was() {
        let mut clock = ReportClock::new(Some(6.5536));
        for pause_secs in [1.0, 6.0, 7.0, 100.0] {
            for i in 0..10 {
                let arrival = pause_secs * 10.0 + f64::from(i) * 0.005;
                let time = clock.time_secs(arrival, Some(arrival.rem_euclid(6.5536)));
                assert!((time - arrival).abs() < 1e-6);
            }
        }
        assert_eq!(clock.n_disagreements, 0);
    }
}
