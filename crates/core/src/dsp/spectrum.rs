//! Spectra of signals: Welch's estimate, third-octave bands, centroid and goodness of fit.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;

use crate::units::Hertz;

/// One-sided power spectral density by Welch's method, with half-overlapping Hann windows of `window` samples. The mean
/// of each window is removed.
///
/// The density is in the squared unit of the signal per Hz, from zero to the Nyquist frequency. Empty if the signal is
/// shorter than a window, or the window is shorter than 2 samples.
pub fn welch(signal: &[f64], rate: Hertz, window: usize) -> Vec<(Hertz, f64)> {
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let density = hann_windowed(signal, rate, window, window, mean);
    density.into_iter().enumerate().map(|(i, d)| (Hertz(i as f64 * rate.0 / window as f64), d)).collect()
}

/// As [`welch`], but zero-padded to `n_bins` samples and without mean removal; for signals with zero mean.
pub(crate) fn periodogram(signal: &[f64], rate: Hertz, window: usize, n_bins: usize) -> Vec<f64> {
    hann_windowed(signal, rate, window, n_bins.max(window), |_| 0.0)
}

/// Periodic Hann window of `n` samples, with `w(i) + w(i + n/2) = 1`.
pub(crate) fn hann(n: usize) -> Vec<f64> {
    (0..n).map(|i| 0.5 - 0.5 * (TAU * i as f64 / n as f64).cos()).collect()
}

fn hann_windowed(
    signal: &[f64],
    rate: Hertz,
    window: usize,
    n_bins: usize,
    offset: impl Fn(&[f64]) -> f64,
) -> Vec<f64> {
    if window < 2 || signal.len() < window {
        return Vec::new();
    }
    let hann = hann(window);
    let power: f64 = hann.iter().map(|w| w * w).sum();
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(n_bins);
    let (mut input, mut bins) = (fft.make_input_vec(), fft.make_output_vec());
    let mut sum = vec![0.0; bins.len()];
    let mut n_windows = 0.0;
    for start in (0..=signal.len() - window).step_by((window / 2).max(1)) {
        let part = &signal[start..start + window];
        let offset = offset(part);
        input.fill(0.0);
        for ((x, s), w) in input.iter_mut().zip(part).zip(&hann) {
            *x = (s - offset) * w;
        }
        // The buffers have the lengths of the plan, so the transform cannot fail.
        if fft.process(&mut input, &mut bins).is_err() {
            return Vec::new();
        }
        for (s, b) in sum.iter_mut().zip(&bins) {
            *s += b.norm_sqr();
        }
        n_windows += 1.0;
    }
    let last = sum.len() - 1;
    let density = |(i, s): (usize, f64)| {
        let both_sides = if i == 0 || (i == last && n_bins.is_multiple_of(2)) { 1.0 } else { 2.0 };
        both_sides * s / (n_windows * power * rate.0)
    };
    sum.into_iter().enumerate().map(density).collect()
}

/// Center frequencies of the third-octave bands with centers in `low..=high`, relative to 1 kHz.
pub fn third_octave_centers(low: Hertz, high: Hertz) -> Vec<Hertz> {
    let center = |i: i32| Hertz(1000.0 * 2.0_f64.powf(f64::from(i) / 3.0));
    (-30..=15).map(center).filter(|f| f.0 >= low.0 && f.0 <= high.0).collect()
}

/// Root mean square of a signal, in its unit; zero for an empty signal.
pub fn rms(signal: &[f64]) -> f64 {
    if signal.is_empty() {
        0.0
    } else {
        (signal.iter().map(|v| v * v).sum::<f64>() / signal.len() as f64).sqrt()
    }
}

/// Median; NaN for an empty vector.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { 0.5 * (values[(n - 1) / 2] + values[n / 2]) }
}

/// Power-weighted mean frequency (spectral centroid) of a density between `low` and `high`; 0 Hz without power.
pub fn centroid(density: &[(Hertz, f64)], low: Hertz, high: Hertz) -> Hertz {
    let inside = density.iter().filter(|(f, _)| f.0 >= low.0 && f.0 <= high.0);
    let (moment, sum) = inside.fold((0.0, 0.0), |(m, s), (f, p)| (m + f.0 * p, s + p));
    Hertz(if sum > 0.0 { moment / sum } else { 0.0 })
}

/// Goodness of fit `|Σ S₁S₂| / sqrt(Σ S₁² Σ S₂²)` of two spectra on the same bins, 0 to 1.
pub fn goodness_of_fit(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(p, q)| p * q).sum::<f64>();
    let norm = (dot(a, a) * dot(b, b)).sqrt();
    if norm > 0.0 { dot(a, b).abs() / norm } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{centroid, goodness_of_fit, rms, third_octave_centers, welch};
    use crate::maths::rng::lcg_noise;
    use crate::units::Hertz;

    #[test]
    fn density_integrates_to_the_variance() {
        let x = lcg_noise(100_000, 3);
        let density = welch(&x, Hertz(1000.0), 256);
        let integral: f64 = density.iter().map(|d| d.1).sum::<f64>() * 1000.0 / 256.0;
        // Windows weight the ends less: one percent for 100,000 samples.
        assert!((integral / rms(&x).powi(2) - 1.0).abs() < 0.01, "{integral}");
        // White noise: each band has the same density, within five standard errors of 78 windows x 12 bins.
        for band in density[1..121].chunks(12) {
            let mean = band.iter().map(|d| d.1).sum::<f64>() / 12.0;
            assert!((mean / 0.002 - 1.0).abs() < 0.2, "{mean}");
        }
    }

    #[test]
    fn a_tone_lies_at_its_frequency_with_its_power() {
        let x: Vec<f64> = (0..10_000)
            .map(|i| 3.0 * (std::f64::consts::TAU * 125.0 * f64::from(i) / 1000.0).sin())
            .collect();
        let density = welch(&x, Hertz(1000.0), 256);
        let power: f64 = density.iter().map(|d| d.1).sum::<f64>() * 1000.0 / 256.0;
        assert!((power - 4.5).abs() < 1e-3, "{power}");
        assert!((centroid(&density, Hertz(10.0), Hertz(500.0)).0 - 125.0).abs() < 0.5);
    }

    #[test]
    fn short_signals_have_no_spectrum() {
        assert!(welch(&[1.0; 100], Hertz(1000.0), 256).is_empty());
        assert!(welch(&[1.0; 100], Hertz(1000.0), 1).is_empty());
        assert_eq!(rms(&[]), 0.0);
    }

    #[test]
    fn bands_and_agreement() {
        let centers = third_octave_centers(Hertz(30.0), Hertz(400.0));
        assert_eq!(centers.len(), 12);
        assert!((centers[0].0 - 31.25).abs() < 1e-9 && (centers[11].0 - 396.85).abs() < 0.01);
        assert!((goodness_of_fit(&[1.0, 2.0], &[2.0, 4.0]) - 1.0).abs() < 1e-15);
        assert_eq!(goodness_of_fit(&[1.0, 0.0], &[0.0, 1.0]), 0.0);
    }
}
