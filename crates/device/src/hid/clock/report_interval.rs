//! Estimation of a pen's constant report interval from arrival times.
//!
//! A pen samples at constant intervals. Each report arrives after a constant minimum delay, and often up to some
//! milliseconds later. The interval is the slope of a line fitted to the last arrivals. The report times lie on a
//! regular grid below all arrivals, through the arrival with the smallest delay. A lost report leaves a grid point
//! empty.

/// Most reports for the estimate of the interval; more reports give a better estimate.
const N_KEPT: usize = 256;
/// Number of latest reports that determine the phase of the grid; over more, an error of the interval would accumulate.
const N_PHASE: usize = 64;
/// Number of latest reports in which empty grid points are counted.
const N_RECENT: usize = 32;
/// Fewest reports for the first estimate.
const N_LEAST: usize = 24;
/// Number of iterations that reassign reports to grid points with the estimated interval.
const N_COUNTS: usize = 3;
/// A report that is at least this fraction of an interval late belongs to a later grid point: an earlier report was
/// lost.
const LOST_SHARE: f64 = 0.9;
/// A report that is more than this fraction of an interval early belongs to the same grid point as the previous report.
const EARLY_SHARE: f64 = 0.5;
/// A step longer than this many median steps contains a lost report.
const LOST_STEPS: f64 = 1.9;
/// Largest fraction of empty grid points; above it, the interval has changed.
const MAX_EMPTY_SHARE: f64 = 0.25;
/// Largest spread of the delays as a fraction of the interval; above it, there is no constant interval.
const MAX_SPREAD_SHARE: f64 = 1.5;
/// A pause longer than this, in seconds, resets the phase: a returning pen has another phase.
const PAUSE_SECS: f64 = 0.050;

/// A report with its grid index, counted from the first kept report, and its arrival time in s.
#[derive(Clone, Copy, Debug, Default)]
struct Report {
    beat: f64,
    arrival_secs: f64,
}

/// Estimator of the report interval.
#[derive(Clone, Debug)]
pub(super) struct ReportIntervalEstimator {
    /// Reports since the last pause, oldest first.
    kept: [Report; N_KEPT],
    n_kept: usize,
    /// Interval in s, if known; it survives a pause.
    interval_secs: Option<f64>,
    /// Number of reports behind the estimate.
    n_fitted: usize,
    last_secs: f64,
}

impl ReportIntervalEstimator {
    /// An estimator before the first report.
    pub(super) fn new() -> Self {
        Self {
            kept: [Report::default(); N_KEPT],
            n_kept: 0,
            interval_secs: None,
            n_fitted: 0,
            last_secs: f64::NEG_INFINITY,
        }
    }

    /// Returns the time of a report that arrives now, never after its arrival and never before the previous report.
    /// Without a known interval, the result is the arrival time.
    pub(super) fn time_secs(&mut self, arrival_secs: f64) -> f64 {
        if !arrival_secs.is_finite() {
            return arrival_secs;
        }
        let last_arrival_secs = self.reports().last().map_or(f64::NEG_INFINITY, |last| last.arrival_secs);
        if arrival_secs - last_arrival_secs > PAUSE_SECS || arrival_secs < last_arrival_secs {
            (self.n_kept, self.last_secs) = (0, f64::NEG_INFINITY);
        }
        self.keep(arrival_secs);
        if self.interval_secs.is_none() && self.n_kept >= N_LEAST {
            self.find();
        } else if self.interval_secs.is_some() && self.n_kept >= N_LEAST {
            self.fit();
        }
        let time_secs = self.now_secs().unwrap_or(arrival_secs).min(arrival_secs);
        // A grid that moves backwards must not pass the previous report, which had arrived by then.
        self.last_secs = time_secs.max(self.last_secs);
        self.last_secs
    }

    fn reports(&self) -> &[Report] {
        &self.kept[..self.n_kept]
    }

    fn keep(&mut self, arrival_secs: f64) {
        if self.n_kept == N_KEPT {
            self.kept.copy_within(1.., 0);
            self.n_kept -= 1;
        }
        self.kept[self.n_kept] = Report { beat: self.next_beat(arrival_secs), arrival_secs };
        self.n_kept += 1;
    }

    /// Grid index of a report that arrives after all kept reports.
    fn next_beat(&self, arrival_secs: f64) -> f64 {
        let Some(last) = self.reports().last() else { return 0.0 };
        let Some((interval_secs, now_secs)) = self.interval_secs.zip(self.now_secs()) else {
            return last.beat + 1.0;
        };
        let late_share = (arrival_secs - now_secs) / interval_secs - 1.0;
        if late_share < -EARLY_SHARE {
            return last.beat;
        }
        last.beat + 1.0 + (late_share + 1.0 - LOST_SHARE).floor().max(0.0)
    }

    /// Estimates the interval from the kept reports, or discards them.
    fn find(&mut self) {
        let mut steps = [0.0; N_KEPT];
        for (step, pair) in steps.iter_mut().zip(self.reports().windows(2)) {
            *step = pair[1].arrival_secs - pair[0].arrival_secs;
        }
        let steps = &mut steps[..self.n_kept - 1];
        steps.sort_by(f64::total_cmp);
        let usual_secs = steps[steps.len() / 2];
        let beats_of = |step: &f64| {
            let share = step / usual_secs;
            if share > LOST_STEPS { share.round() } else { 1.0 }
        };
        self.interval_secs = Some(steps.iter().sum::<f64>() / steps.iter().map(beats_of).sum::<f64>());
        for _ in 0..N_COUNTS {
            if self.interval_secs.is_some_and(|secs| secs > 0.0) {
                let n_kept = std::mem::take(&mut self.n_kept);
                for idx in 0..n_kept {
                    self.keep(self.kept[idx].arrival_secs);
                }
                self.n_fitted = 0;
                self.fit();
            }
        }
        if self.interval_secs.is_none_or(|secs| secs <= 0.0) {
            self.forget();
        }
    }

    /// Refits the interval if at least as many reports are kept as the current estimate is based on. Discards the
    /// interval if the reports do not fit a grid.
    fn fit(&mut self) {
        let Some(known_secs) = self.interval_secs else { return };
        let interval_secs = if self.n_kept >= self.n_fitted { self.slope_secs() } else { known_secs };
        let reports = self.reports();
        let delay = |r: &Report| r.arrival_secs - interval_secs * r.beat;
        let (least, most) = reports
            .iter()
            .map(delay)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
        let recent = &reports[reports.len().saturating_sub(N_RECENT)..];
        let n_beats = recent[recent.len() - 1].beat - recent[0].beat;
        let n_empty = n_beats - (recent.len() - 1) as f64;
        // Both conditions fail for an interval that is not positive.
        let is_beat =
            most - least <= MAX_SPREAD_SHARE * interval_secs && n_empty <= MAX_EMPTY_SHARE * n_beats;
        if is_beat {
            self.interval_secs = Some(interval_secs);
            self.n_fitted = self.n_fitted.max(self.n_kept);
        } else {
            self.forget();
        }
    }

    /// Slope of the least-squares line through the arrivals, in s per grid point.
    fn slope_secs(&self) -> f64 {
        let reports = self.reports();
        let n = reports.len() as f64;
        let mean = |of: &dyn Fn(&Report) -> f64| reports.iter().map(of).sum::<f64>() / n;
        let (mean_beat, mean_secs) = (mean(&|r| r.beat), mean(&|r| r.arrival_secs));
        let squares = mean(&|r| (r.beat - mean_beat).powi(2));
        let products = mean(&|r| (r.beat - mean_beat) * (r.arrival_secs - mean_secs));
        products / squares
    }

    /// Discards the interval and restarts the estimate at the last report.
    fn forget(&mut self) {
        if let Some(last) = self.reports().last() {
            (self.kept[0], self.n_kept) = (Report { beat: 0.0, ..*last }, 1);
        }
        (self.interval_secs, self.n_fitted) = (None, 0);
    }

    /// Grid time of the last report, from the recent report with the smallest delay.
    fn now_secs(&self) -> Option<f64> {
        let interval_secs = self.interval_secs?;
        let reports = self.reports();
        let now = reports.last()?.beat;
        let recent = &reports[reports.len().saturating_sub(N_PHASE)..];
        recent.iter().map(|r| r.arrival_secs + interval_secs * (now - r.beat)).reduce(f64::min)
    }
}

#[cfg(test)]
mod tests;
