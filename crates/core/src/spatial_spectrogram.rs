//! Spatial spectrograms: the spectral content of a profile, place by place, and profiles made from that alone (Meyer,
//! Peshkin & Colgate, appendix; the equations as corrected in ARCHITECTURE.md).
//!
//! A profile is cut by Hann windows; the power of every window at every spatial frequency is the spectrogram. Phases are
//! thrown away, except what the steps of the local mean tell of them: where something *is* survives as far as windows are
//! narrow. So a spectrogram says how much of the place of things a hand needs.

pub mod edit;
mod fidelity;
mod phase;
mod refine;
#[cfg(test)]
mod tests;
mod transform;

use rustfft::num_complex::Complex;

pub use crate::spatial_spectrogram::fidelity::{ProfileFidelity, fidelity, fidelity_by_window};
pub use crate::spatial_spectrogram::phase::profile_of;
pub use crate::spatial_spectrogram::refine::{RefineError, refine};
pub use crate::spatial_spectrogram::transform::Transform;

/// The windows of the paper, widest first, in m.
pub const PAPER_WINDOWS_M: [f64; 7] = [20e-3, 10e-3, 5e-3, 2e-3, 1e-3, 0.5e-3, 0.2e-3];

/// How a profile is cut into windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Framing {
    window: usize,
    hop: usize,
    edges: Edges,
}

/// What the first and the last window see beyond the ends of the profile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Edges {
    /// The profile once more, backwards: every sample lies in as many windows as every other.
    #[default]
    Mirrored,
    /// Nothing: windows lie inside the profile, as in the paper. The very first sample has no weight in any, and is told by
    /// the one after it.
    Cut,
}

/// Why a profile cannot be cut so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FramingError {
    /// A window of an odd number of samples, or of too few.
    #[error("a window of {window} samples; an even number of 4 or more is needed")]
    Window {
        /// Its samples.
        window: usize,
    },
    /// Steps of which no whole number, two or more, make a window.
    #[error(
        "steps of {hop} samples in windows of {window}; a half, a third, a quarter … of the window is needed"
    )]
    Hop {
        /// Samples of a step.
        hop: usize,
        /// Samples of a window.
        window: usize,
    },
    /// The profile is empty or shorter than what is asked of it.
    #[error("a profile of {n_samples} samples in windows of {window}; {needed} samples or more are needed")]
    Short {
        /// Samples of the profile.
        n_samples: usize,
        /// Samples of a window.
        window: usize,
        /// Fewest that can be cut.
        needed: usize,
    },
    /// A profile that is to be cut as in the paper and does not end where a step does.
    #[error(
        "a profile of {n_samples} samples does not end with a step of {hop}; mirror its ends, or cut it there"
    )]
    Ragged {
        /// Samples of the profile.
        n_samples: usize,
        /// Samples of a step.
        hop: usize,
    },
    /// A sample that is no number.
    #[error("sample {index} of the profile is not a finite number")]
    NotFinite {
        /// Which, from zero.
        index: usize,
    },
}

impl Framing {
    /// Windows of so many samples, each half a window after the one before, with mirrored ends.
    ///
    /// # Errors
    /// [`FramingError::Window`].
    pub fn new(window: usize) -> Result<Self, FramingError> {
        if window < 4 || !window.is_multiple_of(2) {
            return Err(FramingError::Window { window });
        }
        Ok(Self { window, hop: window / 2, edges: Edges::Mirrored })
    }

    /// Windows of a length in m on samples of a distance in m, to the nearest even number of samples, four at least.
    pub fn of_length(window_m: f64, step_m: f64) -> Self {
        let half = (0.5 * window_m / step_m).round().clamp(2.0, 1e9) as usize;
        Self { window: 2 * half, hop: half, edges: Edges::Mirrored }
    }

    /// The same with steps of so many samples.
    ///
    /// # Errors
    /// [`FramingError::Hop`].
    pub fn with_hop(self, hop: usize) -> Result<Self, FramingError> {
        let Self { window, .. } = self;
        if hop == 0 || !window.is_multiple_of(hop) || window / hop < 2 {
            return Err(FramingError::Hop { hop, window });
        }
        Ok(Self { hop, ..self })
    }

    /// The same with other ends.
    #[must_use]
    pub fn with_edges(self, edges: Edges) -> Self {
        Self { edges, ..self }
    }

    /// Samples of a window.
    pub fn window(self) -> usize {
        self.window
    }

    /// Samples from a window to the next.
    pub fn hop(self) -> usize {
        self.hop
    }

    /// Spatial frequencies of a window: 0 to half of its samples.
    pub fn n_bins(self) -> usize {
        self.window / 2 + 1
    }

    /// Where the first window begins, in samples before the first one of the profile.
    fn lead(self) -> usize {
        match self.edges {
            Edges::Mirrored => self.window - self.hop,
            Edges::Cut => 0,
        }
    }

    /// Windows over a profile.
    ///
    /// # Errors
    /// [`FramingError::Short`], [`FramingError::Ragged`].
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

    /// The place of the middle of a window, in samples of the profile; outside of it for windows that only reach into it.
    pub fn center(self, frame: usize) -> f64 {
        (frame * self.hop + self.window / 2) as f64 - self.lead() as f64
    }
}

/// Something for every window and every spatial frequency of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames<T> {
    framing: Framing,
    n_samples: usize,
    /// Window after window, its frequencies from zero up.
    values: Vec<T>,
}

impl<T> Frames<T> {
    /// How the profile was cut.
    pub fn framing(&self) -> Framing {
        self.framing
    }

    /// Samples of the profile.
    pub fn n_samples(&self) -> usize {
        self.n_samples
    }

    /// Number of windows.
    pub fn n_frames(&self) -> usize {
        self.values.len() / self.framing.n_bins()
    }

    /// Windows, first to last: each a value for every frequency.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &[T]> {
        self.values.chunks_exact(self.framing.n_bins())
    }

    /// The same, to be changed.
    pub fn frames_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [T]> {
        let n_bins = self.framing.n_bins();
        self.values.chunks_exact_mut(n_bins)
    }
}

/// The windowed transform of a profile, phases and all.
pub type Spectra = Frames<Complex<f64>>;

impl Spectra {
    /// The power of each window and frequency, in the square of the profile's unit.
    pub fn power(&self) -> Frames<f64> {
        let values = self.values.iter().map(Complex::norm_sqr).collect();
        Frames { framing: self.framing, n_samples: self.n_samples, values }
    }
}

/// A spatial spectrogram: `S = |Σ w f e^(-2πikn/N)|²` in the square of the profile's unit, by window and frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialSpectrogram {
    power: Frames<f64>,
    /// What was added to the profile before, so that no local mean is below zero: its sign would be lost.
    offset: f64,
}

impl SpatialSpectrogram {
    /// The spectrogram of a profile.
    ///
    /// # Errors
    /// See [`FramingError`].
    pub fn of(profile: &[f64], transform: &Transform) -> Result<Self, FramingError> {
        let offset = profile.iter().fold(0.0_f64, |offset, x| offset.max(-x));
        let power = transform.power(&lifted(profile, offset))?;
        Ok(Self { power, offset })
    }

    /// Power by window and frequency.
    pub fn power(&self) -> &Frames<f64> {
        &self.power
    }

    /// What was added to the profile before, in its unit; what is made of the spectrogram has it taken off again.
    pub fn offset(&self) -> f64 {
        self.offset
    }
}

/// A profile with this added.
fn lifted(profile: &[f64], offset: f64) -> Vec<f64> {
    profile.iter().map(|x| x + offset).collect()
}

/// `‖√S − √S'‖ / ‖√S‖` over frequencies from `first_bin` up: how far a profile is from having this spectrogram. Zero for
/// none at all.
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
