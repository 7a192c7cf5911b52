//! When a report was made: by the device's own clock while that can be trusted, else by when it arrived.
//!
//! The device's clock has none of the jitter of the way to us, and speed is a difference of places over a difference of
//! times. But some devices send a clock that stands still or runs at another rate than they declare: it is held against
//! the times of arrival, and given up for good where it disagrees. Without a clock the times of arrival are laid on the
//! even beat that pens report at, as far as they have one.

mod beat;

use self::beat::Beat;

/// Furthest that the device's clock may be from the times of arrival, in s: more than the way to us may jitter.
const MAX_DISAGREEMENT_SECS: f64 = 0.050;
/// So many disagreements end the trust. A pause longer than a round of the clock is one too.
const MAX_DISAGREEMENTS: u32 = 3;

/// The times of one device's reports.
#[derive(Clone, Debug)]
pub struct ReportClock {
    round_secs: Option<f64>,
    n_disagreements: u32,
    beat: Beat,
    last: Option<Last>,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    /// All in s.
    arrival: f64,
    reading: Option<f64>,
    time: f64,
}

impl ReportClock {
    /// For a device whose clock starts over after `round_secs`; `None` if it has no clock.
    pub fn new(round_secs: Option<f64>) -> Self {
        Self { round_secs, n_disagreements: 0, beat: Beat::new(), last: None }
    }

    /// The time of a report in s, on the clock of `arrival_secs` and never before the report ahead of it. By the times of
    /// arrival it is never after its own.
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

    /// What the device's own clock says, as far as it can be trusted.
    fn by_clock_secs(&mut self, last: Last, arrival_secs: f64, reading_secs: Option<f64>) -> Option<f64> {
        let is_trusted = self.n_disagreements < MAX_DISAGREEMENTS;
        let round_secs = self.round_secs.filter(|_| is_trusted)?;
        let (before_secs, now_secs) = last.reading.zip(reading_secs)?;
        let time_secs = last.time + (now_secs - before_secs).rem_euclid(round_secs);
        if (time_secs - arrival_secs).abs() <= MAX_DISAGREEMENT_SECS {
            return Some(time_secs);
        }
        // After a pause anything goes: only what happens between reports that follow each other counts.
        if arrival_secs - last.arrival <= MAX_DISAGREEMENT_SECS {
            self.n_disagreements += 1;
        }
        Some(arrival_secs)
    }
}

#[cfg(test)]
mod tests {
    use super::ReportClock;

    /// Steps of 5 ms that arrive with a jitter of up to 4 ms, by a clock of 0.1 ms that starts over each 6.5536 s.
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
        // 20 s: three rounds.
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
                // The reports that have no delay are its own beat.
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
                // Then the beat is at most a jitter ahead.
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
