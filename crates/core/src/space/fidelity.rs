//! Spectral distance between textures: level differences per frequency channel and overall, at nine speeds and forces.
//!
//! This is a signal measure; no person judges. A texture is described by its vibration level in [`N_CHANNELS`] channels
//! at nine contacts with typical stroking speeds and forces. The distance between two textures is the difference of
//! these levels. Models are compared by their power spectral densities, not by rendered noise. Signals are compared by
//! Welch's estimate of the density.

use crate::dsp::ar::comparison_frequencies;
use crate::dsp::spectrum::{rms, welch};
use crate::maths::statistics::mean;
use crate::texture::blend::{Mode, mixture_psd, psd_of_grains};
use crate::texture::plane::{Grain, Plane};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons, Radians};

/// Number of frequency channels.
pub const N_CHANNELS: usize = 40;
/// Number of conditions (pairs of speed and force) at which textures are compared.
pub const N_CONDITIONS: usize = SPEEDS_MM_PER_S.len() * FORCES_N.len();
/// Sample rate whose frequency grid is used for all comparisons, whatever the textures' own rates; channels reach up to
/// half of it. Models of lower rates must be converted to it first.
pub const COMPARED_RATE: Hertz = Hertz(1000.0);

/// Speeds at which textures are compared, in mm/s; each is combined with every force.
pub const SPEEDS_MM_PER_S: [f64; 3] = [50.0, 80.0, 110.0];
/// Forces at which textures are compared, in N.
pub const FORCES_N: [f64; 3] = [0.3, 0.6, 0.9];
const N_BINS: usize = 256;
const LOWEST_CENTER_HZ: f64 = 20.0;
const HIGHEST_CENTER_HZ: f64 = 480.0;
/// Standard deviation of a channel's Gaussian weighting, relative to its center frequency.
const WIDTH: f64 = 0.1;
/// Lower limit of a spectral density, in (m/s²)²/Hz; smaller densities are raised to it.
const FLOOR_PSD: f64 = 1e-9;
/// Lower limit of a level, in m/s². It keeps silence finite in decibels; a level a thousand times higher is still below
/// the detection threshold.
const FLOOR_MPS2: f64 = 1e-5;
/// Length of Welch's windows: their bins are half a hertz wide, a quarter of the narrowest channel's standard
/// deviation.
const WELCH_SECS: f64 = 2.0;
/// Number of steps of the integral over a density. Over a full period of the spectrum, the trapezoidal rule is exact
/// except for the autocorrelation at lags of twice this number of samples and more, which is negligible.
const N_STEPS: usize = 8192;

/// Spectral profile of a texture: its levels in all channels and conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Mean density of each channel in dB re 1 (m/s²)²/Hz, condition by condition.
    pub channels_db: Vec<f64>,
    /// Total vibration level in dB re 1 m/s², one per condition.
    pub levels_db: Vec<f64>,
}

/// Frequency channels on a grid of frequencies.
#[derive(Clone, Debug)]
pub struct Channels {
    frequencies: Vec<Hertz>,
    /// Weight of each frequency, channel by channel; the weights of one channel sum to one.
    weights: Vec<f64>,
}

impl Channels {
    /// Channels for the comparison of models.
    pub fn of_models() -> Self {
        Self::over(comparison_frequencies(COMPARED_RATE, N_BINS))
    }

    /// Channels for the comparison of signals at `rate`, over the bins of Welch's estimate within the frequency range
    /// that is used for models.
    pub fn of_signals(rate: Hertz) -> Self {
        let width_hz = rate.0 / welch_window(rate) as f64;
        let models = comparison_frequencies(COMPARED_RATE, N_BINS);
        let (low, high) = (models[0].0, models[N_BINS - 1].0.min(0.5 * rate.0));
        let bins = (low / width_hz).ceil() as usize..=(high / width_hz).floor() as usize;
        Self::over(bins.map(|bin| Hertz(bin as f64 * width_hz)).collect())
    }

    /// Gaussian channels with logarithmically spaced centers.
    fn over(frequencies: Vec<Hertz>) -> Self {
        let mut weights = Vec::with_capacity(N_CHANNELS * frequencies.len());
        for channel in 0..N_CHANNELS {
            let center_hz = center(channel).0;
            let weight = |f: &Hertz| (-0.5 * ((f.0 - center_hz) / (WIDTH * center_hz)).powi(2)).exp();
            let sum: f64 = frequencies.iter().map(weight).sum();
            weights.extend(frequencies.iter().map(|f| weight(f) / sum));
        }
        Self { frequencies, weights }
    }

    /// Mean density of each channel in dB; `psd` holds one density per frequency.
    fn levels_db<'a>(&'a self, psd: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.weights.chunks_exact(self.frequencies.len()).map(move |weights| {
            let mean: f64 = weights.iter().zip(psd).map(|(w, p)| w * p).sum();
            10.0 * mean.max(FLOOR_PSD).log10()
        })
    }

    /// Profile of a texture or a mixture; all planes must have the same sample rate, at least [`COMPARED_RATE`].
    pub fn profile(&self, parents: &[(&Plane, f64)], mode: Mode) -> Profile {
        let mut profile = Profile::empty();
        for contact in conditions(parents.iter().map(|(plane, _)| *plane)) {
            let psd = mixture_psd(parents, mode, contact, &self.frequencies);
            profile.channels_db.extend(self.levels_db(&psd));
            profile.levels_db.push(level_db(mixture_level_mps2(parents, mode, contact)));
        }
        profile
    }

    /// Profile of signals in m/s² at `rate`, one for each of [`conditions`]; `self` must be [`Channels::of_signals`].
    pub fn profile_of_signals(&self, signals: &[Vec<f64>], rate: Hertz) -> Profile {
        let window = welch_window(rate);
        let width_hz = rate.0 / window as f64;
        let first = self.frequencies.first().map_or(0, |f| (f.0 / width_hz).round() as usize);
        let mut profile = Profile::empty();
        for signal in signals {
            let densities = welch(signal, rate, window).into_iter().skip(first);
            let psd: Vec<f64> = densities.take(self.frequencies.len()).map(|(_, density)| density).collect();
            profile.channels_db.extend(self.levels_db(&psd));
            profile.levels_db.push(level_db(rms(signal)));
        }
        profile
    }
}

impl Profile {
    fn empty() -> Self {
        Self { channels_db: Vec::new(), levels_db: Vec::new() }
    }
}

/// The nine conditions (speed and force), each clamped to the measured range of the planes.
///
/// The upper limits are the highest measured speed and force of any plane, because the other planes are constant above
/// theirs. The lower limits are the lowest speed and force at which all planes were measured. Below its lowest speed
/// and force, a texture fades linearly to silence. This is a model assumption, and a comparison there would compare
/// assumptions.
pub fn conditions<'a, I: Iterator<Item = &'a Plane>>(planes: I) -> [Contact; N_CONDITIONS] {
    let (mut low, mut high) = ([0.0_f64; 2], [0.0_f64; 2]);
    for plane in planes {
        for (axis, (lowest, highest)) in plane.measured_range().into_iter().enumerate() {
            low[axis] = low[axis].max(lowest);
            high[axis] = high[axis].max(highest);
        }
    }
    std::array::from_fn(|index| {
        let wanted = wanted(index);
        // `clamp` does not panic: each lower limit is at most the upper limit of its own plane.
        Contact {
            speed: MetersPerSecond(wanted.speed.0.clamp(low[0], high[0])),
            force: Newtons(wanted.force.0.clamp(low[1], high[1])),
        }
    })
}

/// Whether a texture was measured at all conditions of the comparison.
pub fn is_within_measured(plane: &Plane) -> bool {
    conditions(std::iter::once(plane)).into_iter().enumerate().all(|(index, at)| at == wanted(index))
}

/// Condition `index` before clamping to the measured range.
fn wanted(index: usize) -> Contact {
    Contact::from_mm_per_s_and_n(SPEEDS_MM_PER_S[index / FORCES_N.len()], FORCES_N[index % FORCES_N.len()])
}

/// Root-mean-square difference of the channel levels over conditions and channels, in dB.
pub fn error_db(a: &Profile, b: &Profile) -> f64 {
    let squares = a.channels_db.iter().zip(&b.channels_db).map(|(a, b)| (a - b).powi(2));
    (squares.sum::<f64>() / a.channels_db.len() as f64).sqrt()
}

/// Root-mean-square difference of the channel levels in dB that remains when the overall level is known: one gain in dB,
/// the same in all conditions and channels, is added to `a` so that its mean channel level equals that of `b`.
///
/// With `d` the differences and `m` their mean, it is `sqrt(mean((d - m)²))`, so that `error² = shape² + m²` with the
/// error of [`error_db`]. What remains is the shape of the spectra and their dependence on speed and force. A pure level
/// difference has a shape error of 0.
pub fn shape_error_db(a: &Profile, b: &Profile) -> f64 {
    let differences: Vec<f64> = a.channels_db.iter().zip(&b.channels_db).map(|(a, b)| a - b).collect();
    let mean = mean(&differences);
    let squares = differences.iter().map(|difference| (difference - mean).powi(2));
    (squares.sum::<f64>() / differences.len() as f64).sqrt()
}

/// Mean absolute difference of the total vibration level over conditions, in dB.
pub fn level_error_db(a: &Profile, b: &Profile) -> f64 {
    let differences = a.levels_db.iter().zip(&b.levels_db).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / a.levels_db.len() as f64
}

/// Root-mean-square level of a mixture at one contact, in m/s². For parents with weights `w` and levels `σ`, it is
/// `sqrt(Σ w² σ²)` for independent signals and `Σ w σ` with level compensation. For signals that share one excitation,
/// it is the square root of the integral of the density. All parents must have the same sample rate.
pub fn mixture_level_mps2(parents: &[(&Plane, f64)], mode: Mode, contact: Contact) -> f64 {
    let grain = |(plane, w): &(&Plane, f64)| (plane.at(contact), *w);
    level_of(&parents.iter().map(grain).collect::<Vec<_>>(), mode)
}

/// As [`mixture_level_mps2`], which is for a stroke across the lay of each plane, for a stroke in a direction on the pad:
/// an angle from its x axis, counterclockwise.
pub fn mixture_level_toward_mps2(
    parents: &[(&Plane, f64)],
    mode: Mode,
    contact: Contact,
    direction: Radians,
) -> f64 {
    let grain = |(plane, w): &(&Plane, f64)| (plane.toward(contact, direction), *w);
    level_of(&parents.iter().map(grain).collect::<Vec<_>>(), mode)
}

/// Level of a mixture of grains with their weights.
fn level_of(grains: &[(Grain, f64)], mode: Mode) -> f64 {
    let levels = || grains.iter().map(|(grain, weight)| weight * grain.level_mps2);
    match (mode, grains) {
        (_, []) => 0.0,
        (_, [_]) | (Mode::Power, _) => levels().sum(),
        (Mode::Paper, _) => levels().map(|l| l * l).sum::<f64>().sqrt(),
        (Mode::Shared | Mode::Parametric | Mode::Field, [(first, _), ..]) => {
            let step_hz = 0.5 * first.rate.0 / N_STEPS as f64;
            let frequencies: Vec<Hertz> = (0..=N_STEPS).map(|i| Hertz(i as f64 * step_hz)).collect();
            let psd = psd_of_grains(grains, mode, &frequencies);
            let ends = 0.5 * (psd[0] + psd[N_STEPS]);
            (step_hz * (psd.iter().sum::<f64>() - ends)).sqrt()
        }
    }
}

/// Random error of Welch's estimate from a signal of `seconds`: root mean square over the channels, in dB, for
/// densities that are constant within a channel. An estimate over a bandwidth `B` and a time `T` has a relative
/// standard deviation of `1 / sqrt(B T)`, and a Gaussian weighting of standard deviation σ has a bandwidth of
/// `2 sqrt(π) σ`.
pub fn chance_db(seconds: f64) -> f64 {
    let share =
        |channel: usize| 1.0 / (2.0 * std::f64::consts::PI.sqrt() * WIDTH * center(channel).0 * seconds);
    let mean = (0..N_CHANNELS).map(share).sum::<f64>() / N_CHANNELS as f64;
    10.0 / std::f64::consts::LN_10 * mean.sqrt()
}

/// Center frequency of a channel, counted from zero.
pub fn center(channel: usize) -> Hertz {
    let share = channel as f64 / (N_CHANNELS - 1) as f64;
    Hertz(LOWEST_CENTER_HZ * (HIGHEST_CENTER_HZ / LOWEST_CENTER_HZ).powf(share))
}

fn welch_window(rate: Hertz) -> usize {
    (WELCH_SECS * rate.0).round() as usize
}

fn level_db(level_mps2: f64) -> f64 {
    20.0 * level_mps2.max(FLOOR_MPS2).log10()
}

#[cfg(test)]
mod tests;
