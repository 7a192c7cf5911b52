//! What can just be felt: a threshold over frequency, and how far a vibration lies above it.
//!
//! A threshold is a table of displacements in dB re 1 µm peak. Between two points it is linear in the logarithm of the
//! frequency, and beyond the table it goes on as it ends. A displacement `x` of a frequency `f` is an acceleration
//! `(2πf)² x`, so a threshold that falls by 12 dB an octave is one acceleration.

use std::f64::consts::TAU;

use crate::units::Hertz;

/// Where vibrations are counted, in Hz: below it a model says nothing of what is felt, above it nothing is.
const COUNTED_HZ: (f64, f64) = (10.0, 1000.0);

/// Why points make no threshold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThresholdError {
    /// Fewer than two.
    #[error("a threshold of {n} points has no slope; give two at least")]
    TooFew {
        /// How many there are.
        n: usize,
    },
    /// A frequency that is not above the one before, or a number that is none.
    #[error("point {index} of the threshold is out of order; give finite numbers at rising frequencies")]
    Order {
        /// Which, from one.
        index: usize,
    },
}

/// The least displacement that is felt, over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// Binary logarithm of the frequency in Hz, rising, and the displacement in dB re 1 µm peak.
    points: Vec<(f64, f64)>,
}

impl Threshold {
    /// The threshold through points of a frequency and a displacement in dB re 1 µm peak.
    ///
    /// # Errors
    /// [`ThresholdError`] where there are fewer than two, or their frequencies do not rise.
    pub fn new(points: &[(Hertz, f64)]) -> Result<Self, ThresholdError> {
        if points.len() < 2 {
            return Err(ThresholdError::TooFew { n: points.len() });
        }
        let points: Vec<(f64, f64)> = points.iter().map(|(f, db)| (f.0.log2(), *db)).collect();
        let is_fine = |i: usize| {
            points[i].0.is_finite() && points[i].1.is_finite() && (i == 0 || points[i].0 > points[i - 1].0)
        };
        match (0..points.len()).find(|i| !is_fine(*i)) {
            Some(i) => Err(ThresholdError::Order { index: i + 1 }),
            None => Ok(Self { points }),
        }
    }

    /// The same threshold, so many dB more sensitive.
    #[must_use]
    pub fn lowered(&self, db: f64) -> Self {
        Self { points: self.points.iter().map(|(octave, x)| (*octave, x - db)).collect() }
    }

    /// The displacement in dB re 1 µm peak.
    pub fn displacement_db_um(&self, frequency: Hertz) -> f64 {
        let octave = frequency.0.log2();
        let above = self.points.partition_point(|point| point.0 < octave);
        let first = above.clamp(1, self.points.len() - 1) - 1;
        let (low, high) = (self.points[first], self.points[first + 1]);
        low.1 + (octave - low.0) * (high.1 - low.1) / (high.0 - low.0)
    }

    /// The peak of the acceleration of a tone, in m/s².
    pub fn peak_mps2(&self, frequency: Hertz) -> f64 {
        let peak_m = 1e-6 * 10.0_f64.powf(self.displacement_db_um(frequency) / 20.0);
        (TAU * frequency.0).powi(2) * peak_m
    }

    /// The density in (m/s²)²/Hz of a noise a third of an octave wide that has the power of a tone at the threshold: what a
    /// power spectral density can be looked at against.
    pub fn density(&self, frequency: Hertz) -> f64 {
        let width_hz = frequency.0 * (2.0_f64.powf(1.0 / 6.0) - 2.0_f64.powf(-1.0 / 6.0));
        0.5 * self.peak_mps2(frequency).powi(2) / width_hz
    }

    /// How many times stronger a vibration is than what can just be felt: the root of the sum of its power over that of a
    /// tone at the threshold of each frequency between 10 and 1000 Hz. `density` is in (m/s²)²/Hz on evenly spaced
    /// frequencies; a tone at the threshold has 1, silence 0.
    pub fn multiple(&self, density: &[(Hertz, f64)]) -> f64 {
        let [first, second, ..] = density else { return 0.0 };
        let step = Hertz(second.0.0 - first.0.0);
        density.iter().map(|(f, d)| d * self.weight(*f, step)).sum::<f64>().sqrt()
    }

    /// What a density in (m/s²)²/Hz over a `step` of frequencies counts for in the square of [`Threshold::multiple`].
    pub fn weight(&self, frequency: Hertz, step: Hertz) -> f64 {
        let is_counted = (COUNTED_HZ.0..=COUNTED_HZ.1).contains(&frequency.0);
        if is_counted { step.0 / (0.5 * self.peak_mps2(frequency).powi(2)) } else { 0.0 }
    }
}

/// The displacement in dB re 1 µm peak of a tone whose acceleration has this peak in m/s².
pub fn displacement_db_um(frequency: Hertz, peak_mps2: f64) -> f64 {
    20.0 * (1e6 * peak_mps2 / (TAU * frequency.0).powi(2)).log10()
}

#[cfg(test)]
mod tests {
    use super::{Threshold, ThresholdError, displacement_db_um};
    use std::f64::consts::TAU;

    use crate::spectrum::welch;
    use crate::units::Hertz;

    /// Falls by 12 dB an octave: one acceleration at all frequencies.
    fn falling() -> Threshold {
        let at = |hz: f64| (Hertz(hz), displacement_db_um(Hertz(hz), 0.25));
        Threshold::new(&[at(40.0), at(250.0)]).unwrap()
    }

    #[test]
    fn a_slope_of_twelve_db_is_one_acceleration() {
        for hz in [10.0, 40.0, 100.0, 250.0, 800.0] {
            assert!((falling().peak_mps2(Hertz(hz)) - 0.25).abs() < 1e-12, "{hz} Hz");
            assert!((falling().lowered(20.0).peak_mps2(Hertz(hz)) - 0.025).abs() < 1e-12, "{hz} Hz");
        }
    }

    #[test]
    fn the_points_themselves_are_met() {
        let points = [(40.0, 12.0), (63.0, 4.0), (100.0, -4.0), (1000.0, 8.0)].map(|(f, x)| (Hertz(f), x));
        let threshold = Threshold::new(&points).unwrap();
        for (frequency, x) in points {
            assert!((threshold.displacement_db_um(frequency) - x).abs() < 1e-12);
        }
        let middle = Hertz((63.0_f64 * 100.0).sqrt());
        assert!(threshold.displacement_db_um(middle).abs() < 1e-12, "halfway in octaves is halfway in dB");
    }

    /// A tone `k` times above the threshold is felt as `k`, whatever its frequency, and so is a noise of that power in the band.
    #[test]
    fn a_tone_is_a_multiple_of_what_is_felt() {
        let (rate, n) = (2000.0, 8000);
        for (hz, k) in [(60.0, 1.0), (125.0, 3.0), (250.0, 12.0)] {
            let tone: Vec<f64> = (0..n).map(|i| k * 0.25 * (TAU * hz * f64::from(i) / rate).sin()).collect();
            let multiple = falling().multiple(&welch(&tone, Hertz(rate), 512));
            assert!((multiple / k - 1.0).abs() < 0.01, "{hz} Hz: {multiple} for {k}");
        }
        assert_eq!(falling().multiple(&[]), 0.0);
        assert_eq!(falling().multiple(&welch(&vec![0.0; 2000], Hertz(rate), 512)), 0.0);
    }

    #[test]
    fn a_third_of_an_octave_of_the_drawn_density_is_just_felt() {
        let threshold = falling();
        let center = 160.0;
        let (low, high) = (center * 2.0_f64.powf(-1.0 / 6.0), center * 2.0_f64.powf(1.0 / 6.0));
        let density: Vec<(Hertz, f64)> = (0..10_000)
            .map(|i| 0.1 * f64::from(i))
            .map(|f| {
                (Hertz(f), if (low..high).contains(&f) { threshold.density(Hertz(center)) } else { 0.0 })
            })
            .collect();
        assert!((threshold.multiple(&density) - 1.0).abs() < 0.01);
    }

    #[test]
    fn what_is_no_threshold_is_refused() {
        assert_eq!(Threshold::new(&[(Hertz(1.0), 1.0)]), Err(ThresholdError::TooFew { n: 1 }));
        for second in [(Hertz(1.0), 1.0), (Hertz(0.5), 1.0), (Hertz(2.0), f64::NAN), (Hertz(f64::NAN), 1.0)] {
            let refused = Threshold::new(&[(Hertz(1.0), 1.0), second]);
            assert_eq!(refused, Err(ThresholdError::Order { index: 2 }), "{second:?}");
        }
        let below = Threshold::new(&[(Hertz(-1.0), 1.0), (Hertz(1.0), 1.0)]);
        assert_eq!(below, Err(ThresholdError::Order { index: 1 }));
    }
}
