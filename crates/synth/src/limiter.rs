//! Final limiter before the actuator: always on, never above its ceiling, silent after a non-finite sample.

/// A memoryless soft-knee limiter with a latch that trips on a non-finite sample.
///
/// Below the knee a sample is unchanged. Above the knee the normalized excess `u` is compressed to `u / (1 + u)`. The
/// curve and its slope are continuous, and the output stays below the ceiling for any input. Cost: one comparison per
/// sample below the knee.
#[derive(Clone, Debug)]
pub struct Limiter {
    ceiling: f32,
    knee: f32,
    tripped: bool,
    limited_samples: u64,
}

impl Limiter {
    /// A limiter with output between `-ceiling` and `ceiling`, linear up to the fraction `knee_share` (0..1) of the
    /// ceiling.
    ///
    /// Arguments outside their range are clamped to the nearest permitted value. A ceiling that is not finite gives
    /// silence.
    pub fn new(ceiling: f32, knee_share: f32) -> Self {
        let ceiling = if ceiling.is_finite() { ceiling.max(0.0) } else { 0.0 };
        let knee_share = if knee_share.is_finite() { knee_share.clamp(0.0, 0.999) } else { 0.0 };
        Self { ceiling, knee: ceiling * knee_share, tripped: false, limited_samples: 0 }
    }

    /// Returns the limited sample. After a non-finite sample it returns zero until [`Limiter::reset`].
    pub fn limit(&mut self, sample: f32) -> f32 {
        if !sample.is_finite() {
            self.tripped = true;
        }
        if self.tripped {
            return 0.0;
        }
        let magnitude = sample.abs();
        if magnitude <= self.knee {
            return sample;
        }
        self.limited_samples += 1;
        let bent = bend(magnitude, self.knee, self.ceiling);
        if sample < 0.0 { -bent } else { bent }
    }

    /// Whether a non-finite sample has latched silence.
    pub fn is_tripped(&self) -> bool {
        self.tripped
    }

    /// Number of samples above the knee since the start.
    pub fn limited_samples(&self) -> u64 {
        self.limited_samples
    }

    /// Ends the latched silence. Only a person's action may lead to this call.
    pub fn reset(&mut self) {
        self.tripped = false;
    }
}

/// Soft-knee curve above the knee: the excess `u`, in units of `ceiling - knee`, becomes `u / (1 + u)` in the same
/// units. Returns zero if the ceiling is not above the knee.
pub(crate) fn bend(magnitude: f32, knee: f32, ceiling: f32) -> f32 {
    let room = ceiling - knee;
    if room <= 0.0 {
        return 0.0;
    }
    let excess = (magnitude - knee) / room;
    // 1 - 1/(1+u) equals u/(1+u) without the overflow of u/u for a very large u.
    (knee + room * (1.0 - 1.0 / (1.0 + excess))).min(ceiling)
}

#[cfg(test)]
mod tests {
    use super::Limiter;

    #[test]
    fn passes_below_the_knee_and_never_exceeds_the_ceiling() {
        let mut limiter = Limiter::new(0.9, 0.8);
        for sample in [0.0, 0.1, -0.7, 0.71] {
            assert_eq!(limiter.limit(sample), sample);
        }
        for sample in [0.73, 1.0, -5.0, 1e30, f32::MAX, -f32::MAX] {
            let out = limiter.limit(sample);
            assert!(out.abs() <= 0.9 && out * sample > 0.0, "{sample} -> {out}");
        }
        assert_eq!(limiter.limited_samples(), 6);
    }

    #[test]
    fn is_monotone_with_a_continuous_slope() {
        let mut limiter = Limiter::new(1.0, 0.5);
        let (mut last, mut last_slope) = (0.0_f32, 1.0_f32);
        for i in 1..4000 {
            let out = limiter.limit(i as f32 * 1e-3);
            let slope = (out - last) / 1e-3;
            assert!(out >= last && (slope - last_slope).abs() < 0.01, "slope jumps at {i}");
            (last, last_slope) = (out, slope);
        }
    }

    #[test]
    fn nonsense_latches_silence_until_reset() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut limiter = Limiter::new(1.0, 0.8);
            assert_eq!(limiter.limit(bad), 0.0);
            assert_eq!(limiter.limit(0.5), 0.0);
            assert!(limiter.is_tripped());
            limiter.reset();
            assert_eq!(limiter.limit(0.5), 0.5);
        }
    }

    #[test]
    fn nonsense_settings_are_silence() {
        assert_eq!(Limiter::new(f32::NAN, 0.5).limit(0.3), 0.0);
        assert_eq!(Limiter::new(-1.0, 0.5).limit(0.3), 0.0);
    }
}
