//! Windowed Fourier transform (STFT) of a profile, and its inverse.

use std::fmt;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::FftNum;
use rustfft::num_complex::Complex;

use crate::dsp::spectrum::hann;

use super::{Frames, Framing, FramingError, Spectra};

/// Sum of squared window values below which a sample counts as uncovered.
const NO_WEIGHT: f64 = 1e-8;

/// Windowed Fourier transform and its inverse for one framing; build once and use for many profiles.
#[derive(Clone)]
pub struct Transform<T = f64> {
    framing: Framing,
    /// Periodic Hann window: `w(n) + w(n + N/2) = 1`.
    hann: Vec<T>,
    forward: Arc<dyn RealToComplex<T>>,
    inverse: Arc<dyn ComplexToReal<T>>,
}

impl<T> fmt::Debug for Transform<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Transform").field("framing", &self.framing).finish_non_exhaustive()
    }
}

/// Converts a number to the precision of a transform.
pub(super) fn real<T: FftNum>(x: f64) -> T {
    // `from_f64` never fails for floating-point types.
    T::from_f64(x).unwrap_or_else(T::zero)
}

/// Work buffers for one window.
pub(super) struct Work<T> {
    samples: Vec<T>,
    scratch: Vec<Complex<T>>,
}

impl<T: FftNum + PartialOrd> Transform<T> {
    /// Returns the transform for a framing.
    pub fn new(framing: Framing) -> Self {
        let n = framing.window();
        let mut planner = RealFftPlanner::new();
        Self {
            framing,
            hann: hann(n).into_iter().map(real).collect(),
            forward: planner.plan_fft_forward(n),
            inverse: planner.plan_fft_inverse(n),
        }
    }

    /// Returns the framing.
    pub fn framing(&self) -> Framing {
        self.framing
    }

    /// Returns the inverse of the summed squared windows at each sample; zero where the sum is negligible.
    pub(super) fn weights(&self, n_samples: usize, n_frames: usize) -> Vec<T> {
        let mut sums = vec![T::zero(); n_samples];
        for frame in 0..n_frames {
            let (inside, first) = self.inside(frame, n_samples);
            for (sum, w) in sums[inside].iter_mut().zip(&self.hann[first..]) {
                *sum = *sum + *w * *w;
            }
        }
        let least = real::<T>(NO_WEIGHT);
        let weight = |sum: T| if sum > least { T::one() / sum } else { T::zero() };
        sums.into_iter().map(weight).collect()
    }

    /// Overlap-adds the windowed inverse transform of one window to a profile; overwrites `bins`.
    pub(super) fn add_window(
        &self,
        bins: &mut [Complex<T>],
        frame: usize,
        profile: &mut [T],
        work: &mut Work<T>,
    ) {
        // The DC and Nyquist bins of a real signal are real.
        let last = bins.len() - 1;
        (bins[0].im, bins[last].im) = (T::zero(), T::zero());
        let done = self.inverse.process_with_scratch(bins, &mut work.samples, &mut work.scratch);
        debug_assert!(done.is_ok(), "buffer lengths must come from the plan");
        let (inside, first) = self.inside(frame, profile.len());
        for ((y, x), w) in profile[inside].iter_mut().zip(&work.samples[first..]).zip(&self.hann[first..]) {
            *y = *y + *w * *x;
        }
    }

    /// Normalizes an overlap-added profile by the summed squared windows.
    pub(super) fn weigh(&self, profile: &mut [T], weights: &[T]) {
        let scale = real::<T>(1.0 / self.framing.window() as f64);
        for (y, weight) in profile.iter_mut().zip(weights) {
            *y = *y * *weight * scale;
        }
        if let ([first, second, ..], Some(weight)) = (profile, weights.first())
            && weight.is_zero()
        {
            *first = *second;
        }
    }

    /// Returns the range of profile samples within a window, and the index of the first of them in the window.
    pub(super) fn inside(&self, frame: usize, n_samples: usize) -> (std::ops::Range<usize>, usize) {
        let begin = frame * self.framing.hop();
        let lead = self.framing.lead();
        let end = (begin + self.framing.window()).saturating_sub(lead).min(n_samples);
        let first = begin.saturating_sub(lead).min(end);
        (first..end, lead.saturating_sub(begin))
    }

    /// Computes the spectrum of one window of a profile.
    pub(super) fn analyze_window(
        &self,
        profile: &[T],
        frame: usize,
        bins: &mut [Complex<T>],
        work: &mut Work<T>,
    ) {
        let n_samples = profile.len();
        let begin = frame * self.framing.hop();
        let lead = self.framing.lead();
        if let Some(part) =
            begin.checked_sub(lead).and_then(|begin| profile.get(begin..begin + self.hann.len()))
        {
            for ((sample, x), w) in work.samples.iter_mut().zip(part).zip(&self.hann) {
                *sample = *x * *w;
            }
        } else {
            // Mirror repeatedly, as often as the window extends beyond the profile.
            let lap = 2 * n_samples;
            let begin = begin + lap * lead.div_ceil(lap) - lead;
            for (i, (sample, w)) in work.samples.iter_mut().zip(&self.hann).enumerate() {
                let at = (begin + i) % lap;
                *sample = *w * profile[if at < n_samples { at } else { lap - 1 - at }];
            }
        }
        let done = self.forward.process_with_scratch(&mut work.samples, bins, &mut work.scratch);
        debug_assert!(done.is_ok(), "buffer lengths must come from the plan");
    }

    /// Returns work buffers, reusable for all windows.
    pub(super) fn work(&self) -> Work<T> {
        let n_scratch = self.forward.get_scratch_len().max(self.inverse.get_scratch_len());
        Work {
            samples: vec![T::zero(); self.hann.len()],
            scratch: vec![Complex::new(T::zero(), T::zero()); n_scratch],
        }
    }
}

impl Transform {
    /// Returns the spectra of a profile's windows.
    ///
    /// # Errors
    /// [`FramingError`] for a sample that is not finite, or a length that does not fit the framing.
    pub fn spectra(&self, profile: &[f64]) -> Result<Spectra, FramingError> {
        let n_frames = self.checked(profile)?;
        let mut spectra = self.empty(profile.len(), n_frames);
        self.analyze(profile, &mut spectra);
        Ok(spectra)
    }

    /// Returns the power of a profile's windows in the squared unit of the profile: eq. (1).
    ///
    /// # Errors
    /// [`FramingError`] for a sample that is not finite, or a length that does not fit the framing.
    pub fn power(&self, profile: &[f64]) -> Result<Frames<f64>, FramingError> {
        let n_frames = self.checked(profile)?;
        let n_bins = self.framing.n_bins();
        let mut bins = vec![Complex::default(); n_bins];
        let mut work = self.work();
        let mut values = Vec::with_capacity(n_frames * n_bins);
        for frame in 0..n_frames {
            self.analyze_window(profile, frame, &mut bins, &mut work);
            values.extend(bins.iter().map(Complex::norm_sqr));
        }
        Ok(Frames { framing: self.framing, n_samples: profile.len(), values })
    }

    /// Returns the profile of windowed spectra by weighted overlap-add, eqs. (5) and (6).
    ///
    /// Unchanged spectra of a profile reconstruct it exactly, up to round-off.
    pub fn profile(&self, spectra: &Spectra) -> Vec<f64> {
        let mut profile = vec![0.0; spectra.n_samples];
        let mut bins = vec![Complex::default(); self.framing.n_bins()];
        let mut work = self.work();
        for (frame, from) in spectra.frames().enumerate() {
            bins.copy_from_slice(from);
            self.add_window(&mut bins, frame, &mut profile, &mut work);
        }
        self.weigh(&mut profile, &self.weights(spectra.n_samples, spectra.n_frames()));
        profile
    }

    /// Returns all-zero spectra of `n_frames` windows.
    pub(super) fn empty(&self, n_samples: usize, n_frames: usize) -> Spectra {
        let values = vec![Complex::default(); n_frames * self.framing.n_bins()];
        Frames { framing: self.framing, n_samples, values }
    }

    /// Computes the spectra of a profile with the same number of samples.
    pub(super) fn analyze(&self, profile: &[f64], spectra: &mut Spectra) {
        let mut work = self.work();
        for (frame, bins) in spectra.frames_mut().enumerate() {
            self.analyze_window(profile, frame, bins, &mut work);
        }
    }

    /// Checks the samples, and returns the number of windows of a profile.
    fn checked(&self, profile: &[f64]) -> Result<usize, FramingError> {
        match profile.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(FramingError::NotFinite { index }),
            None => self.framing.n_frames(profile.len()),
        }
    }
}
