//! Spectra of models and of short signals with the same window leakage.

use realfft::RealFftPlanner;

use crate::dsp::spectrum::{hann, periodogram};
use crate::texture::plane::Grain;
use crate::units::Hertz;

/// Number of frequencies, over the full circle, from which a model's autocorrelation is computed. Poles of radius 0.9975
/// have decayed to a billionth where it starts to repeat.
const N_GRID: usize = 8192;

/// Welch density of a signal with Hann windows, on `n_bins` bins of the full circle. A signal shorter than `n_bins` has
/// one window of its own length.
pub(super) fn measured(signal: &[f64], rate: Hertz, n_bins: usize) -> Vec<f64> {
    periodogram(signal, rate, n_bins.min(signal.len()), n_bins)
}

/// Density of a fitted grain, which has no moving average, at [`N_GRID`] / 2 + 1 frequencies from zero to half of its
/// rate, in (m/s²)²/Hz.
pub(super) fn grain_density(grain: &Grain) -> Vec<f64> {
    let scale = 2.0 * grain.excitation_variance() / grain.rate.0;
    predictor_density(&grain.ar()).into_iter().map(|density| scale * density).collect()
}

/// Density of a predictor at the same frequencies, without its scale.
pub(super) fn predictor_density(ar: &[f64]) -> Vec<f64> {
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(N_GRID);
    let (mut input, mut bins) = (fft.make_input_vec(), fft.make_output_vec());
    input[0] = 1.0;
    input[1..=ar.len()].copy_from_slice(ar);
    crate::dsp::dft321::check_run(&fft.process(&mut input, &mut bins));
    bins.iter().map(|bin| bin.norm_sqr().recip()).collect()
}

/// Leakage of the window of [`measured`] for signals of a length.
pub(super) struct Leakage {
    n_bins: usize,
    /// Autocorrelation of the window, relative to its power.
    taper: Vec<f64>,
}

impl Leakage {
    /// Leakage of signals of `n_samples` samples.
    pub(super) fn new(n_samples: usize, n_bins: usize) -> Self {
        let window = n_bins.min(n_samples);
        let hann = hann(window);
        let power: f64 = hann.iter().map(|w| w * w).sum();
        let at = |k: usize| hann.iter().zip(&hann[k..]).map(|(a, b)| a * b).sum::<f64>() / power;
        Self { n_bins, taper: (0..window).map(at).collect() }
    }

    /// Expected value of [`measured`] for a signal with this density, as from [`grain_density`].
    pub(super) fn expected(&self, density: &[f64]) -> Vec<f64> {
        let density = mirrored(density, N_GRID);
        // The transform of an even real sequence is real: the autocorrelation times a constant that cancels.
        let lags = even_transform(&density, N_GRID);
        let mut tapered = vec![0.0; self.n_bins];
        for (k, taper) in self.taper.iter().enumerate() {
            let value = taper * lags[k] / N_GRID as f64;
            tapered[k % self.n_bins] += value;
            if k > 0 {
                tapered[self.n_bins - k] += value;
            }
        }
        even_transform(&tapered, self.n_bins)
    }
}

/// Full circle from its upper half.
fn mirrored(half: &[f64], n: usize) -> Vec<f64> {
    (0..n).map(|i| half[i.min(n - i)]).collect()
}

/// Cosine transform `Σ x cos` of an even sequence, up to half of its length.
fn even_transform(x: &[f64], n: usize) -> Vec<f64> {
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let (mut input, mut bins) = (x.to_vec(), fft.make_output_vec());
    crate::dsp::dft321::check_run(&fft.process(&mut input, &mut bins));
    bins.iter().map(|b| b.re).collect()
}

#[cfg(test)]
mod tests {
    use super::{Leakage, N_GRID, grain_density, measured};
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::lsf::lsf_from_ar;
    use crate::maths::rng::lcg_noise;
    use crate::texture::plane::{Grain, Plane};
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Contact, Hertz};

    fn grain() -> (Grain, Vec<f64>) {
        let ar = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.98), (Hertz(240.0), 0.93)]);
        let at = Contact::from_mm_per_s_and_n(100.0, 1.0);
        let lsf = lsf_from_ar(&ar).unwrap();
        let node = GrainNode { speed: at.speed, force: at.force, lsf, level_mps2: 2.0 };
        (Plane::new(&TextureModel::new(Hertz(1000.0), vec![node], None).unwrap()).at(at), ar)
    }

    #[test]
    fn the_expected_spectrum_is_the_mean_of_measured_ones() {
        let (grain, ar) = grain();
        let sigma = grain.excitation_variance().sqrt();
        let mut x: Vec<f64> = lcg_noise(401_000, 1).iter().map(|e| sigma * e).collect();
        for n in 0..x.len() {
            x[n] -= (1..=ar.len().min(n)).map(|k| ar[k - 1] * x[n - k]).sum::<f64>();
        }
        for n_samples in [120, 256, 1000] {
            let model = Leakage::new(n_samples, 256).expected(&grain_density(&grain));
            let mut mean = vec![0.0; 129];
            let parts: Vec<&[f64]> = x[1000..].chunks_exact(n_samples).collect();
            for part in &parts {
                for (mean, p) in mean.iter_mut().zip(measured(part, Hertz(1000.0), 256)) {
                    *mean += p / parts.len() as f64;
                }
            }
            let n_windows = 400_000.0 / 256.0_f64.min(n_samples as f64);
            for (i, (a, b)) in mean.iter().zip(&model).enumerate().skip(1).take(127) {
                // Five standard errors of the mean of this many periodograms.
                assert!(
                    (a / b - 1.0).abs() < 5.0 / n_windows.sqrt(),
                    "{n_samples} samples, bin {i}: got {a}, expected {b}"
                );
            }
        }
    }

    #[test]
    fn the_density_of_a_grain_is_that_of_its_formula() {
        let (grain, _) = grain();
        let frequencies: Vec<Hertz> =
            (0..=N_GRID / 2).map(|i| Hertz(i as f64 * grain.rate.0 / N_GRID as f64)).collect();
        for (fast, slow) in grain_density(&grain).iter().zip(grain.psd(&frequencies)) {
            assert!((fast / slow - 1.0).abs() < 1e-9, "got {fast}, expected {slow}");
        }
    }

    #[test]
    fn the_power_stays() {
        let (grain, _) = grain();
        for n_samples in [100, 256] {
            let model = Leakage::new(n_samples, 256).expected(&grain_density(&grain));
            // The bins at both ends belong to both halves of the circle.
            let power = (model.iter().sum::<f64>() - 0.5 * (model[0] + model[128])) * 1000.0 / 256.0;
            assert!((power / 4.0 - 1.0).abs() < 1e-6, "{power}");
        }
    }
}
