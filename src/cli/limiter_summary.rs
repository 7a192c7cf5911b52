//! How much the limits of an output and its actuator attenuated a signal.

use shagreen_device::status::Status;

/// Fraction of limited samples up to which no warning is printed: only the highest peaks of the noise.
const FEW: f64 = 1e-3;
/// Gain above which the level changes by less than 0.1 dB.
const NEARLY_ALL: f64 = 0.99;

/// Attenuation by the limiters during a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LimiterSummary {
    /// Number of samples that the peak limiters attenuated.
    pub(crate) n_samples: u64,
    /// The same as a fraction of all samples played, 0..1.
    pub(crate) share: f64,
    /// Lowest gain of the thermal limiter, 0..1.
    pub(crate) heat_gain: f64,
    /// Whether the peak limit is that of an actuator; otherwise it is that of digital full scale.
    has_actuator: bool,
}

impl LimiterSummary {
    /// Returns the attenuation of an output that had played `n_frames_before` frames when the motion began. `heat_gain`
    /// is the lowest gain of the thermal limiter.
    pub(crate) fn new(status: &Status, n_frames_before: u64, heat_gain: f32, has_actuator: bool) -> Self {
        let n_frames = status.frames_played.saturating_sub(n_frames_before);
        // Two limiters in series may both count the same sample.
        let n_samples = status.limited_samples.min(n_frames);
        let share = if n_frames > 0 { n_samples as f64 / n_frames as f64 } else { 0.0 };
        Self { n_samples, share, heat_gain: f64::from(heat_gain), has_actuator }
    }

    /// Returns the fraction of limited samples as text.
    pub(crate) fn in_words(&self) -> String {
        if self.n_samples == 0 { "none".to_owned() } else { format!("{:.2} %", 100.0 * self.share) }
    }

    /// Returns a warning with advice for each limit that was exceeded.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.share > FEW {
            let (limit, advice) = if self.has_actuator {
                ("of the actuator and the output", "a lower --speed or --force, or a smoother texture")
            } else {
                ("of the output's full scale", "a higher --full-scale, or a lower --speed or --force")
            };
            warnings.push(format!(
                "{:.1} % of the samples exceeded the limit {limit} and were attenuated: the peaks are lower than those of the texture; try {advice}",
                100.0 * self.share
            ));
        }
        if self.heat_gain < NEARLY_ALL {
            warnings.push(format!(
                "the thermal limiter attenuated the output to {:.0} % at times, to keep the coil cool: the output is weaker than the texture; try a lower --speed or --force, or shorter strokes",
                100.0 * self.heat_gain
            ));
        }
        warnings
    }
}

#[cfg(test)]
mod tests {
    use super::{LimiterSummary, Status};

    fn limited(limited_samples: u64, heat_gain: f32, has_actuator: bool) -> LimiterSummary {
        let status = Status { limited_samples, frames_played: 1500, ..Status::default() };
        LimiterSummary::new(&status, 500, heat_gain, has_actuator)
    }

    #[test]
    fn the_share_is_one_of_what_was_played() {
        for (n, share) in [(0, 0.0), (250, 0.25), (1000, 1.0), (1800, 1.0)] {
            let limited = limited(n, 1.0, false);
            assert_eq!((limited.share, limited.n_samples), (share, n.min(1000)));
        }
        assert_eq!(LimiterSummary::new(&Status::default(), 0, 1.0, false).share, 0.0);
    }

    #[test]
    fn the_limit_is_named_with_what_to_do() {
        assert_eq!(limited(1, 0.995, true).warnings(), [""; 0]);
        let ceiling = limited(250, 1.0, false).warnings().join("\n");
        assert!(ceiling.contains("25.0 %") && ceiling.contains("--full-scale"), "{ceiling}");
        let peak = limited(250, 1.0, true).warnings().join("\n");
        assert!(peak.contains("the actuator") && !peak.contains("--full-scale"), "{peak}");
        let heat = limited(0, 0.63, true).warnings().join("\n");
        assert!(
            heat.contains("63 %") && heat.contains("cool") && !heat.contains("samples exceeded"),
            "{heat}"
        );
    }
}
