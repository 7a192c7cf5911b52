//! Windows of a signal around a time, at its ends too.

use std::borrow::Cow;

use crate::units::Hertz;

/// Length of the longest window, in s.
pub(super) const LONGEST_SECS: f64 = 0.05;

/// Signal whose windows stay inside it, or go on over the seam of a loop.
pub(super) struct Windows<'a> {
    /// The signal; for a loop, with a copy of its end in front and of its beginning behind.
    samples: Cow<'a, [f32]>,
    /// Number of samples in front of the signal.
    n_ahead: usize,
    n_signal: usize,
    rate: Hertz,
}

impl<'a> Windows<'a> {
    /// Windows that stay inside the signal: at its ends, they are not centered.
    pub(super) fn inside(samples: &'a [f32], rate: Hertz) -> Self {
        Self { samples: Cow::Borrowed(samples), n_ahead: 0, n_signal: samples.len(), rate }
    }

    /// Windows of a loop, in which the last sample is followed by the first.
    pub(super) fn around(samples: &'a [f32], rate: Hertz) -> Self {
        let n = samples.len();
        if n == 0 {
            return Self::inside(samples, rate);
        }
        // More than half of the longest window.
        let n_ahead = (0.5 * LONGEST_SECS * rate.0).ceil() as usize + 1;
        let first = n - n_ahead % n;
        let all = (0..n + 2 * n_ahead).map(|i| samples[(first + i) % n]).collect();
        Self { samples: Cow::Owned(all), n_ahead, n_signal: n, rate }
    }

    /// Number of samples of the signal.
    pub(super) fn n_signal(&self) -> usize {
        self.n_signal
    }

    /// Whether the last sample is followed by the first.
    pub(super) fn is_loop(&self) -> bool {
        self.n_ahead > 0
    }

    pub(super) fn rate(&self) -> Hertz {
        self.rate
    }

    /// The window of this many samples, at most those of the signal and of [`LONGEST_SECS`], around a time.
    pub(super) fn around_secs(&self, n_window: usize, time_secs: f64) -> &[f32] {
        let center = self.n_ahead + (time_secs * self.rate.0).round() as usize;
        let start = center.saturating_sub(n_window / 2).min(self.samples.len() - n_window);
        &self.samples[start..start + n_window]
    }
}
