//! Spatial spectrograms: power of a profile by position and spatial frequency, and profiles reconstructed from it.
//!
//! Follows Meyer, Peshkin & Colgate, appendix, with the equations as corrected in docs/notes/spatial-spectrograms.md.
//!
//! A profile is split into Hann windows. The spectrogram is the power of every window at every spatial frequency.
//! Phases are discarded, except for what the steps of the local mean imply. Position is therefore preserved only to
//! about the window length. A spectrogram thus shows how much position information touch needs.

pub mod edit;
mod fidelity;
mod phase;
mod refine;
#[cfg(test)]
mod tests;
mod transform;

use rustfft::num_complex::Complex;

pub use crate::signals::spatial_spectrogram::fidelity::{ProfileFidelity, fidelity, fidelity_by_window};
pub use crate::signals::spatial_spectrogram::phase::profile_of;
pub use crate::signals::spatial_spectrogram::refine::{RefineError, refine};
pub use crate::signals::spatial_spectrogram::transform::Transform;

/// Window lengths of the paper, widest first, in m.
pub const PAPER_WINDOWS_M: [f64; 7] = [20e-3, 10e-3, 5e-3, 2e-3, 1e-3, 0.5e-3, 0.2e-3];

/// Window length, hop and edge handling of a transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Framing {
    window: usize,
    hop: usize,
    edges: Edges,
}

/// Extension of the profile beyond its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Edges {
    /// Mirrored: every sample is covered by the same number of windows.
    #[default]
    Mirrored,
    /// No extension: all windows lie inside the profile, as in the paper.
    ///
    /// The first sample has zero weight in every window, and is copied from the second.
    Cut,
}

/// Reasons why a profile cannot be split into windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FramingError {
    /// The window length is odd or too small.
    #[error("the window has {window} samples; use an even number of 4 or more")]
    Window {
        /// Samples per window.
        window: usize,
    },
    /// The hop is not a whole fraction, one half or less, of the window.
    #[error("the hop is {hop} samples for windows of {window}; use a half, a third, a quarter … of it")]
    Hop {
        /// Samples per hop.
        hop: usize,
        /// Samples per window.
        window: usize,
    },
    /// The profile is too short.
    #[error(
        "the profile has {n_samples} samples, needs {needed} for windows of {window}; use a longer profile"
    )]
    Short {
        /// Samples of the profile.
        n_samples: usize,
        /// Samples per window.
        window: usize,
        /// Smallest number of samples.
        needed: usize,
    },
    /// The profile has [`Edges::Cut`] and its length is not a multiple of the hop.
    #[error(
        "the profile has {n_samples} samples, not a multiple of the hop of {hop}; trim it, or mirror its ends"
    )]
    Ragged {
        /// Samples of the profile.
        n_samples: usize,
        /// Samples per hop.
        hop: usize,
    },
    /// A sample is not a finite number.
    #[error("sample {index} of the profile is not a finite number; correct or remove it")]
    NotFinite {
        /// Index of the sample, from 0.
        index: usize,
    },
}

impl Framing {
    /// Returns a framing with this window length in samples, a hop of half a window and mirrored edges.
    ///
    /// # Errors
    /// [`FramingError::Window`] unless the length is even and at least 4.
    pub fn new(window: usize) -> Result<Self, FramingError> {
        if window < 4 || !window.is_multiple_of(2) {
            return Err(FramingError::Window { window });
        }
        Ok(Self { window, hop: window / 2, edges: Edges::Mirrored })
    }

    /// Returns a framing with a window length in m for samples `step_m` apart.
    ///
    /// The length is rounded to the nearest even number of samples, at least 4. The hop is half a window and the edges
    /// are mirrored.
    pub fn of_length(window_m: f64, step_m: f64) -> Self {
        let half = (0.5 * window_m / step_m).round().clamp(2.0, 1e9) as usize;
        Self { window: 2 * half, hop: half, edges: Edges::Mirrored }
    }

    /// Returns this framing with another hop in samples.
    ///
    /// # Errors
    /// [`FramingError::Hop`] unless the window is a whole multiple, two or more, of the hop.
    pub fn with_hop(self, hop: usize) -> Result<Self, FramingError> {
        let Self { window, .. } = self;
        if hop == 0 || !window.is_multiple_of(hop) || window / hop < 2 {
            return Err(FramingError::Hop { hop, window });
        }
        Ok(Self { hop, ..self })
    }

    /// Returns this framing with other edge handling.
    #[must_use]
    pub fn with_edges(self, edges: Edges) -> Self {
        Self { edges, ..self }
    }

    /// Returns the samples per window.
    pub fn window(self) -> usize {
        self.window
    }

    /// Returns the samples per hop.
    pub fn hop(self) -> usize {
        self.hop
    }

    /// Returns the number of spatial frequencies per window, DC to Nyquist.
    pub fn n_bins(self) -> usize {
        self.window / 2 + 1
    }

    /// Samples by which the first window starts before the profile.
    fn lead(self) -> usize {
        match self.edges {
            Edges::Mirrored => self.window - self.hop,
            Edges::Cut => 0,
        }
    }

    /// Returns the number of windows over a profile of `n_samples`.
    ///
    /// # Errors
    /// [`FramingError::Short`], and [`FramingError::Ragged`] with [`Edges::Cut`].
    pub fn n_frames(self, n_samples: usize) -> Result<usize, FramingError> {
        let Self { window, hop, edges } = self;
        let needed = match edges {
            Edges::Mirrored => 2,
            Edges::Cut => window,
        };
        if n_samples < needed {
            return Err(FramingError::Short { n_samples, window, needed });
        }
        match edges {
            Edges::Mirrored => Ok((n_samples + self.lead()).div_ceil(hop)),
            Edges::Cut if n_samples.is_multiple_of(hop) => Ok((n_samples - window) / hop + 1),
            Edges::Cut => Err(FramingError::Ragged { n_samples, hop }),
        }
    }

    /// Returns the center of a window in samples of the profile; it may lie outside the profile with mirrored edges.
    pub fn center(self, frame: usize) -> f64 {
        (frame * self.hop + self.window / 2) as f64 - self.lead() as f64
    }
}

/// One value for each window and spatial frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames<T> {
    framing: Framing,
    n_samples: usize,
    /// Window by window, each with frequencies from DC up.
    values: Vec<T>,
}

impl<T> Frames<T> {
    /// Returns the framing.
    pub fn framing(&self) -> Framing {
        self.framing
    }

    /// Returns the samples of the profile.
    pub fn n_samples(&self) -> usize {
        self.n_samples
    }

    /// Returns the number of windows.
    pub fn n_frames(&self) -> usize {
        self.values.len() / self.framing.n_bins()
    }

    /// Returns the windows in order, each with one value per frequency.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &[T]> {
        self.values.chunks_exact(self.framing.n_bins())
    }

    /// Returns the windows in order, mutably.
    pub fn frames_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [T]> {
        let n_bins = self.framing.n_bins();
        self.values.chunks_exact_mut(n_bins)
    }
}

/// Complex windowed transform (STFT) of a profile, with phases.
pub type Spectra = Frames<Complex<f64>>;

impl Spectra {
    /// Returns the power by window and frequency, in the squared unit of the profile.
    pub fn power(&self) -> Frames<f64> {
        let values = self.values.iter().map(Complex::norm_sqr).collect();
        Frames { framing: self.framing, n_samples: self.n_samples, values }
    }
}

/// A spatial spectrogram `S = |Σ w f e^(-2πikn/N)|²` by window and frequency, in the squared unit of the profile.
///
/// A profile with negative values is raised by [`SpatialSpectrogram::offset`] first, which changes the power near DC;
/// [`Transform::power`] is that of the profile as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialSpectrogram {
    power: Frames<f64>,
    /// Added to the profile first, so that no local mean is negative: the power loses its sign.
    offset: f64,
}

impl SpatialSpectrogram {
    /// Returns the spectrogram of a profile.
    ///
    /// # Errors
    /// [`FramingError`] for a sample that is not finite, or a length that does not fit the framing.
    pub fn of(profile: &[f64], transform: &Transform) -> Result<Self, FramingError> {
        let offset = offset_of(profile);
        let power = transform.power(&lifted(profile, offset))?;
        Ok(Self { power, offset })
    }

    /// Returns the power by window and frequency.
    pub fn power(&self) -> &Frames<f64> {
        &self.power
    }

    /// Returns the offset added to the profile, in its unit; reconstruction subtracts it.
    pub fn offset(&self) -> f64 {
        self.offset
    }
}

/// Returns the offset that a profile needs before it is reconstructed from its power: minus the lowest value, or 0 if no
/// value is negative.
pub fn offset_of(profile: &[f64]) -> f64 {
    profile.iter().fold(0.0_f64, |offset, x| offset.max(-x))
}

/// Returns the profile plus an offset.
fn lifted(profile: &[f64], offset: f64) -> Vec<f64> {
    profile.iter().map(|x| x + offset).collect()
}

/// Returns the spectral convergence `‖√S − √S'‖ / ‖√S‖` over frequencies from `first_bin` up.
///
/// Zero if both spectrograms are equal, or if `wanted` is zero throughout.
pub fn spectral_convergence(wanted: &Frames<f64>, got: &Frames<f64>, first_bin: usize) -> f64 {
    let (mut apart, mut all) = (0.0, 0.0);
    for (wanted, got) in wanted.frames().zip(got.frames()) {
        for (w, g) in wanted.iter().zip(got).skip(first_bin) {
            let (w, g) = (w.max(0.0).sqrt(), g.max(0.0).sqrt());
            apart += (w - g).powi(2);
            all += w * w;
        }
    }
    if all > 0.0 { (apart / all).sqrt() } else { 0.0 }
}
