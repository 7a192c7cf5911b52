//! How far apart textures are on signals: levels of channels, and in all, at nine speeds and forces.
//!
//! No person is asked. A texture is described by the level of its vibration in [`N_CHANNELS`] channels at the nine
//! contacts of a hand that strokes at ordinary speeds and forces; two textures are as far apart as these levels are.
//! Models are compared by their densities, not by noise that was rendered from them; signals, by Welch's estimate.

use crate::ar::comparison_frequencies;
use crate::blend::{Mode, mixture_psd};
use crate::plane::Plane;
use crate::spectrum::{rms, welch};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Channels of a spectrum.
pub const N_CHANNELS: usize = 40;
/// Speeds and forces at which textures are compared.
pub const N_CONDITIONS: usize = SPEEDS_MM_PER_S.len() * FORCES_N.len();
/// The rate whose grid of frequencies all are compared on, whatever their own: half of it is what channels reach up to.
/// Models of lower rates are converted to it.
pub const COMPARED_RATE: Hertz = Hertz(1000.0);

/// Speeds at which textures are compared, in mm/s, each with every force.
pub const SPEEDS_MM_PER_S: [f64; 3] = [50.0, 80.0, 110.0];
/// Forces at which textures are compared, in N.
pub const FORCES_N: [f64; 3] = [0.3, 0.6, 0.9];
const N_BINS: usize = 256;
const LOWEST_CENTER_HZ: f64 = 20.0;
const HIGHEST_CENTER_HZ: f64 = 480.0;
/// Standard deviation of a channel, as a share of its center.
const WIDTH: f64 = 0.1;
/// Density below which nothing is told apart, in (m/s²)²/Hz.
const FLOOR_PSD: f64 = 1e-9;
/// Level below which nothing is told apart, in m/s²: silence has none in decibels, and no hand feels a thousand times more.
const FLOOR_MPS2: f64 = 1e-5;
/// Length of Welch's windows: bins of half a hertz, a quarter of the narrowest channel's deviation.
const WELCH_SECS: f64 = 2.0;
/// Steps of the integral over a density: on a full turn of the unit circle the rule of trapezoids leaves only what the
/// process still remembers after twice as many samples, which is nothing.
const N_STEPS: usize = 8192;

/// A texture as it is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Mean density of each channel in dB re 1 (m/s²)²/Hz, condition by condition.
    pub channels_db: Vec<f64>,
    /// Level of all that vibrates, in dB re 1 m/s², for each condition.
    pub levels_db: Vec<f64>,
}

/// Channels over a grid of frequencies.
#[derive(Clone, Debug)]
pub struct Channels {
    frequencies: Vec<Hertz>,
    /// Weight of each frequency, channel by channel; those of a channel sum to one.
    weights: Vec<f64>,
}

impl Channels {
    /// The channels in which models are compared.
    pub fn of_models() -> Self {
        Self::over(comparison_frequencies(COMPARED_RATE, N_BINS))
    }

    /// The channels in which signals of `rate` are compared, over the bins of Welch's estimate that lie where models have
    /// theirs.
    pub fn of_signals(rate: Hertz) -> Self {
        let width_hz = rate.0 / welch_window(rate) as f64;
        let models = comparison_frequencies(COMPARED_RATE, N_BINS);
        let (low, high) = (models[0].0, models[N_BINS - 1].0.min(0.5 * rate.0));
        let bins = (low / width_hz).ceil() as usize..=(high / width_hz).floor() as usize;
        Self::over(bins.map(|bin| Hertz(bin as f64 * width_hz)).collect())
    }

    /// Gaussian channels, their centers in equal ratios.
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

    /// Mean density of each channel in dB; `psd` holds a density for each frequency.
    fn levels_db<'a>(&'a self, psd: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.weights.chunks_exact(self.frequencies.len()).map(move |weights| {
            let mean: f64 = weights.iter().zip(psd).map(|(w, p)| w * p).sum();
            10.0 * mean.max(FLOOR_PSD).log10()
        })
    }

    /// The profile of a texture or a mixture; all planes have one rate, at least [`COMPARED_RATE`].
    pub fn profile(&self, parents: &[(&Plane, f64)], mode: Mode) -> Profile {
        let mut profile = Profile::empty();
        for contact in conditions(parents.iter().map(|(plane, _)| *plane)) {
            let psd = mixture_psd(parents, mode, contact, &self.frequencies);
            profile.channels_db.extend(self.levels_db(&psd));
            profile.levels_db.push(level_db(mixture_level_mps2(parents, mode, contact)));
        }
        profile
    }

    /// The profile of signals in m/s² of `rate`, one for each of [`conditions`]; these are [`Channels::of_signals`].
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

/// The nine speeds and forces, each moved to the nearest at which the planes know something: up to the highest speed and
/// force of any of them, since the others stay as they are at theirs, and from the lowest at which all were measured.
///
/// Below its lowest speed and force a texture fades to silence on a straight line that nobody measured; a comparison there
/// would be one of boundaries.
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
        // Each lowest is at most the highest of its own plane.
        Contact {
            speed: MetersPerSecond(wanted.speed.0.clamp(low[0], high[0])),
            force: Newtons(wanted.force.0.clamp(low[1], high[1])),
        }
    })
}

/// Whether a texture was measured at all speeds and forces of the comparison.
pub fn is_within_measured(plane: &Plane) -> bool {
    conditions(std::iter::once(plane)).into_iter().enumerate().all(|(index, at)| at == wanted(index))
}

/// Speed and force of a comparison, as far as textures were measured there.
fn wanted(index: usize) -> Contact {
    Contact::from_mm_per_s_and_n(SPEEDS_MM_PER_S[index / FORCES_N.len()], FORCES_N[index % FORCES_N.len()])
}

/// Root mean square over conditions and channels of the difference of levels, in dB.
pub fn error_db(a: &Profile, b: &Profile) -> f64 {
    let squares = a.channels_db.iter().zip(&b.channels_db).map(|(a, b)| (a - b).powi(2));
    (squares.sum::<f64>() / a.channels_db.len() as f64).sqrt()
}

/// Mean over conditions of the absolute difference of the level of all that vibrates, in dB.
pub fn level_error_db(a: &Profile, b: &Profile) -> f64 {
    let differences = a.levels_db.iter().zip(&b.levels_db).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / a.levels_db.len() as f64
}

/// Level of a mixture at one contact, root mean square in m/s²: `sqrt(Σ w² σ²)` of independent signals, `Σ w σ` where their
/// level is made up, and the integral of the density where they share one excitation. All parents have one rate.
pub fn mixture_level_mps2(parents: &[(&Plane, f64)], mode: Mode, contact: Contact) -> f64 {
    let levels = || parents.iter().map(|(plane, weight)| weight * plane.at(contact).level_mps2);
    match (mode, parents) {
        (_, []) => 0.0,
        (_, [_]) | (Mode::Power, _) => levels().sum(),
        (Mode::Paper, _) => levels().map(|l| l * l).sum::<f64>().sqrt(),
        (Mode::Shared | Mode::Parametric | Mode::Field, [(first, _), ..]) => {
            let step_hz = 0.5 * first.rate().0 / N_STEPS as f64;
            let frequencies: Vec<Hertz> = (0..=N_STEPS).map(|i| Hertz(i as f64 * step_hz)).collect();
            let psd = mixture_psd(parents, mode, contact, &frequencies);
            let ends = 0.5 * (psd[0] + psd[N_STEPS]);
            (step_hz * (psd.iter().sum::<f64>() - ends)).sqrt()
        }
    }
}

/// Root mean square over the channels of the deviation in dB that Welch's estimate has by chance after so many seconds,
/// for densities that are level within a channel: an estimate over a bandwidth `B` for a time `T` deviates by a share of
/// `1 / sqrt(B T)`, and a Gaussian of deviation σ is `2 sqrt(π) σ` wide.
pub fn chance_db(seconds: f64) -> f64 {
    let share =
        |channel: usize| 1.0 / (2.0 * std::f64::consts::PI.sqrt() * WIDTH * center(channel).0 * seconds);
    let mean = (0..N_CHANNELS).map(share).sum::<f64>() / N_CHANNELS as f64;
    10.0 / std::f64::consts::LN_10 * mean.sqrt()
}

/// Center of a channel, counted from zero.
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
