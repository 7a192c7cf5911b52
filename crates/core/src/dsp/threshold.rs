//! Vibrotactile detection threshold over frequency, and the level of a vibration relative to it.
//!
//! A threshold is a table of displacements in dB re 1 µm peak. It is linear in the logarithm of frequency between
//! points, and extrapolated with the slopes of its end segments. A displacement `x` at frequency `f` corresponds to the
//! acceleration `(2πf)² x`. A threshold with a slope of -12 dB per octave is therefore a constant acceleration.

use std::f64::consts::TAU;

use crate::units::Hertz;

/// Frequency range in Hz for [`Threshold::multiple`]. Below it the model makes no statement; above it vibration is
/// imperceptible.
const COUNTED_HZ: (f64, f64) = (10.0, 1000.0);

/// Error of creating a threshold from points.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThresholdError {
    /// There are fewer than two points.
    #[error("a threshold needs at least two points, got {n}; add points")]
    TooFew {
        /// Number of points.
        n: usize,
    },
    /// A frequency does not exceed the previous one, or a number is not finite.
    #[error(
        "point {index} of the threshold is invalid; use finite numbers at increasing positive frequencies"
    )]
    Order {
        /// Number of the point, counted from one.
        index: usize,
    },
}

/// Detection threshold: smallest perceptible displacement over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// Binary logarithm of the frequency in Hz, increasing, and the displacement in dB re 1 µm peak.
    points: Vec<(f64, f64)>,
}

impl Threshold {
    /// Creates a threshold from pairs of frequency and displacement in dB re 1 µm peak.
    ///
    /// # Errors
    /// [`ThresholdError`] if there are fewer than two points, or if frequencies are not positive, finite and
    /// increasing.
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

    /// Threshold lowered by `db` decibels (more sensitive).
    #[must_use]
    pub fn lowered(&self, db: f64) -> Self {
        Self { points: self.points.iter().map(|(octave, x)| (*octave, x - db)).collect() }
    }

    /// Threshold displacement in dB re 1 µm peak.
    pub fn displacement_db_um(&self, frequency: Hertz) -> f64 {
        let octave = frequency.0.log2();
        let above = self.points.partition_point(|point| point.0 < octave);
        let first = above.clamp(1, self.points.len() - 1) - 1;
        let (low, high) = (self.points[first], self.points[first + 1]);
        low.1 + (octave - low.0) * (high.1 - low.1) / (high.0 - low.0)
    }

    /// Peak acceleration of a tone at threshold, in m/s².
    pub fn peak_mps2(&self, frequency: Hertz) -> f64 {
        let peak_m = 1e-6 * 10.0_f64.powf(self.displacement_db_um(frequency) / 20.0);
        (TAU * frequency.0).powi(2) * peak_m
    }

    /// Density in (m/s²)²/Hz of third-octave noise that has the power of a tone at threshold. Power spectral densities
    /// can be plotted against it.
    pub fn density(&self, frequency: Hertz) -> f64 {
        let width_hz = frequency.0 * (2.0_f64.powf(1.0 / 6.0) - 2.0_f64.powf(-1.0 / 6.0));
        0.5 * self.peak_mps2(frequency).powi(2) / width_hz
    }

    /// Ratio of a vibration's amplitude to the detection threshold; a tone at threshold has 1, silence has 0.
    ///
    /// It is the square root of the sum, from 10 to 1000 Hz, of the power at each frequency divided by the power of a
    /// tone at threshold. `density` is in (m/s²)²/Hz at equidistant frequencies.
    pub fn multiple(&self, density: &[(Hertz, f64)]) -> f64 {
        let [first, second, ..] = density else { return 0.0 };
        let step = Hertz(second.0.0 - first.0.0);
        density.iter().map(|(f, d)| d * self.weight(*f, step)).sum::<f64>().sqrt()
    }

    /// Weight of a density in (m/s²)²/Hz over a frequency `step`, in the square of [`Threshold::multiple`].
    pub fn weight(&self, frequency: Hertz, step: Hertz) -> f64 {
        let is_counted = (COUNTED_HZ.0..=COUNTED_HZ.1).contains(&frequency.0);
        if is_counted { step.0 / (0.5 * self.peak_mps2(frequency).powi(2)) } else { 0.0 }
    }
}

/// Displacement in dB re 1 µm peak of a tone with the peak acceleration `peak_mps2` in m/s².
pub fn displacement_db_um(frequency: Hertz, peak_mps2: f64) -> f64 {
    20.0 * (1e6 * peak_mps2 / (TAU * frequency.0).powi(2)).log10()
}

#[cfg(test)]
mod tests {
    use super::{Threshold, ThresholdError, displacement_db_um};
    use std::f64::consts::TAU;

    use crate::dsp::spectrum::welch;
    use crate::units::Hertz;

    /// Threshold of constant acceleration, a slope of -12 dB per octave.
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
        assert!(
            threshold.displacement_db_um(middle).abs() < 1e-12,
            "the threshold must be linear in dB over octaves"
        );
    }

    /// A tone `k` times above threshold has the ratio `k` at any frequency.
    #[test]
    fn a_tone_is_a_multiple_of_what_is_felt() {
        let (rate, n) = (2000.0, 8000);
        for (hz, k) in [(60.0, 1.0), (125.0, 3.0), (250.0, 12.0)] {
            let tone: Vec<f64> = (0..n).map(|i| k * 0.25 * (TAU * hz * f64::from(i) / rate).sin()).collect();
            let multiple = falling().multiple(&welch(&tone, Hertz(rate), 512));
            assert!((multiple / k - 1.0).abs() < 0.01, "{hz} Hz: got {multiple}, expected {k}");
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
