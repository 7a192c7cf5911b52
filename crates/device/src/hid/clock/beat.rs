//! The even beat of a pen's reports, found in the times of their arrival.
//!
//! A pen measures at even intervals; a report of it comes later by what the way to us takes, at least by some time that is
//! always the same and often by some milliseconds more. So the interval is the slope of a line through the last arrivals,
//! and the beat lies beneath them all, touching the one with the least delay. A report that was lost leaves its beat empty.

/// Reports that the interval is found from at most: the more, the better it is known.
const N_KEPT: usize = 256;
/// The last of them, above which the beat lies: an interval that is a little off does not add up over more.
const N_PHASE: usize = 64;
/// The last of them, of which few beats may be empty.
const N_RECENT: usize = 32;
/// Fewest that it is found from for the first time.
const N_LEAST: usize = 24;
/// How often the reports are counted anew with the interval that the last count gave.
const N_COUNTS: usize = 3;
/// A report this share of an interval after the beat that it was due at belongs to a later one: the one that was due is lost.
const LOST_SHARE: f64 = 0.9;
/// A report this share ahead of its beat belongs to the one before: that was taken for a later one's.
const EARLY_SHARE: f64 = 0.5;
/// A step of more than this many usual ones has a lost report in it.
const LOST_STEPS: f64 = 1.9;
/// Of more empty beats than this share, the interval is another.
const MAX_EMPTY_SHARE: f64 = 0.25;
/// What is further than this share of an interval from the line is no beat.
const MAX_SPREAD_SHARE: f64 = 1.5;
/// A pause of more than this, in seconds, begins anew where the beat lies: a pen that came back has another.
const PAUSE_SECS: f64 = 0.050;

/// A report: how many beats after the first that is kept, and when it arrived in s.
#[derive(Clone, Copy, Debug, Default)]
struct Report {
    beat: f64,
    arrival_secs: f64,
}

/// The beat so far.
#[derive(Clone, Debug)]
pub(super) struct Beat {
    /// The last reports since the last pause, oldest first.
    kept: [Report; N_KEPT],
    n_kept: usize,
    /// Interval in s, where it is known; it outlasts a pause.
    interval_secs: Option<f64>,
    /// How many reports it was found from.
    n_fitted: usize,
    last_secs: f64,
}

impl Beat {
    /// Before the first report.
    pub(super) fn new() -> Self {
        Self {
            kept: [Report::default(); N_KEPT],
            n_kept: 0,
            interval_secs: None,
            n_fitted: 0,
            last_secs: f64::NEG_INFINITY,
        }
    }

    /// When a report was made that arrived now: never later than that, nor before the report ahead of it. Until there is a
    /// beat, and where there is none, it is when it arrived.
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
        // A beat that moves back must not pass the report before; that had arrived by then.
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

    /// The beat that a report belongs to which arrives after all that are kept.
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

    /// Looks for an interval in the reports that are kept, or forgets them.
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

    /// Takes the interval from the reports that are kept, where they are as many as those that it is known from; forgets it
    /// where they have no beat.
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
        // Without an interval above zero nothing here is so.
        let is_beat =
            most - least <= MAX_SPREAD_SHARE * interval_secs && n_empty <= MAX_EMPTY_SHARE * n_beats;
        if is_beat {
            self.interval_secs = Some(interval_secs);
            self.n_fitted = self.n_fitted.max(self.n_kept);
        } else {
            self.forget();
        }
    }

    /// The slope of the straight line that is nearest to the arrivals.
    fn slope_secs(&self) -> f64 {
        let reports = self.reports();
        let n = reports.len() as f64;
        let mean = |of: &dyn Fn(&Report) -> f64| reports.iter().map(of).sum::<f64>() / n;
        let (mean_beat, mean_secs) = (mean(&|r| r.beat), mean(&|r| r.arrival_secs));
        let squares = mean(&|r| (r.beat - mean_beat).powi(2));
        let products = mean(&|r| (r.beat - mean_beat) * (r.arrival_secs - mean_secs));
        products / squares
    }

    /// There is no beat: another is looked for from the last report on.
    fn forget(&mut self) {
        if let Some(last) = self.reports().last() {
            (self.kept[0], self.n_kept) = (Report { beat: 0.0, ..*last }, 1);
        }
        (self.interval_secs, self.n_fitted) = (None, 0);
    }

    /// The beat of the last report: that of the report with the least delay, and as many intervals later.
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
