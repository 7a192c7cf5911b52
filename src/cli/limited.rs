//! What the limits of an output and its actuator took from what was played.

use shagreen_device::status::Status;

/// Less of the samples than this is not worth a word: the highest peaks of noise.
const FEW: f64 = 1e-3;
/// A gain above this keeps the level as it is, to a tenth of a dB.
const NEARLY_ALL: f64 = 0.99;

/// What was turned down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limited {
    /// Samples that the ceiling turned down or bent.
    pub(crate) n_samples: u64,
    /// The same as a share of what was played, 0..1.
    pub(crate) share: f64,
    /// Lowest gain that kept the coil cool, 0..1.
    pub(crate) heat_gain: f64,
    /// Whether the ceiling is that of an actuator, else that of the full scale.
    has_actuator: bool,
}

impl Limited {
    /// Of an output that had played so many frames when the motion began, and was turned down to `heat_gain`.
    pub(crate) fn new(status: &Status, n_frames_before: u64, heat_gain: f32, has_actuator: bool) -> Self {
        let n_frames = status.frames_played.saturating_sub(n_frames_before);
        // Two limiters in a row may both count a sample.
        let n_samples = status.limited_samples.min(n_frames);
        let share = if n_frames > 0 { n_samples as f64 / n_frames as f64 } else { 0.0 };
        Self { n_samples, share, heat_gain: f64::from(heat_gain), has_actuator }
    }

    /// In a few words.
    pub(crate) fn in_words(&self) -> String {
        if self.n_samples == 0 { "none".to_owned() } else { format!("{:.2} %", 100.0 * self.share) }
    }

    /// What to do about it, by the limit that was met.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.share > FEW {
            let (limit, advice) = if self.has_actuator {
                (
                    "of what the actuator and the output stand",
                    "a lower --speed or --force, or a smoother texture",
                )
            } else {
                ("of the output's full scale", "a higher --full-scale, or a lower --speed or --force")
            };
            warnings.push(format!(
                "{:.1} % of the samples met the ceiling {limit} and were turned down: peaks are weaker than the texture's; try {advice}",
                100.0 * self.share
            ));
        }
        if self.heat_gain < NEARLY_ALL {
            warnings.push(format!(
                "all was turned down to {:.0} % at times so that the coil stays cool: it is weaker than the texture; try a lower --speed or --force, or shorter strokes",
                100.0 * self.heat_gain
            ));
        }
        warnings
    }
}

#[cfg(test)]
mod tests {
    use super::{Limited, Status};

    fn limited(limited_samples: u64, heat_gain: f32, has_actuator: bool) -> Limited {
        let status = Status { limited_samples, frames_played: 1500, ..Status::default() };
        Limited::new(&status, 500, heat_gain, has_actuator)
    }

    #[test]
    fn the_share_is_one_of_what_was_played() {
        for (n, share) in [(0, 0.0), (250, 0.25), (1000, 1.0), (1800, 1.0)] {
            let limited = limited(n, 1.0, false);
            assert_eq!((limited.share, limited.n_samples), (share, n.min(1000)));
        }
        assert_eq!(Limited::new(&Status::default(), 0, 1.0, false).share, 0.0);
    }

    #[test]
    fn the_limit_is_named_with_what_to_do() {
        assert_eq!(limited(1, 0.995, true).warnings(), [""; 0]);
        let ceiling = limited(250, 1.0, false).warnings().join("\n");
        assert!(ceiling.contains("25.0 %") && ceiling.contains("--full-scale"), "{ceiling}");
        let peak = limited(250, 1.0, true).warnings().join("\n");
        assert!(peak.contains("the actuator") && !peak.contains("--full-scale"), "{peak}");
        let heat = limited(0, 0.63, true).warnings().join("\n");
        assert!(heat.contains("63 %") && heat.contains("cool") && !heat.contains("ceiling"), "{heat}");
    }
}
