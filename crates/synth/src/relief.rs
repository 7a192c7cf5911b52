//! What a texture has at each place: played by where the tip is, forwards, backwards, and not at all while it stands.

use core::f32::consts::PI;

use crate::contact::Place;
use crate::voice::MAX_TICK;

/// Fewest samples of an octave: as many as the cubic between samples looks at.
pub const LEAST_SAMPLES: usize = 4;
/// Most samples of an octave.
pub const MOST_SAMPLES: usize = 1 << 24;
/// What changes slower is no vibration, and a tip that stands feels none: the cut-off in Hz.
pub const HIGH_PASS_HZ: f32 = 10.0;
/// A way in one tick that no hand goes, in m: the tip is somewhere else.
const JUMP_M: f64 = 0.015;
/// Times the force of its level that a relief may be pressed with.
const MOST_GAIN: f32 = 4.0;

/// Why slices do not make a relief.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReliefError {
    /// A step or a force that is not a positive finite number.
    Range,
    /// The slice is not as long as its octaves.
    Length,
    /// A value is not finite.
    Number,
}

/// Values in m/s² over places, that repeat, in octaves: the first has `n` samples a step apart, each of the others half as
/// many of the lower half of the band. Every octave holds only what has four samples or more a period, for the cubic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief<'a> {
    step_m: f32,
    force_n: f32,
    n: usize,
    octaves: &'a [f32],
}

/// Numbers of all octaves of a relief of `n` samples, a power of two, down to [`LEAST_SAMPLES`].
pub const fn length(n: usize) -> usize {
    (2 * n).saturating_sub(LEAST_SAMPLES)
}

impl<'a> Relief<'a> {
    /// A relief of `n` samples, a power of two, whose octaves stand one behind the other, at the force in N at which it has
    /// its level.
    ///
    /// # Errors
    /// See [`ReliefError`].
    pub fn new(step_m: f32, force_n: f32, n: usize, octaves: &'a [f32]) -> Result<Self, ReliefError> {
        let positive = |x: f32| x.is_finite() && x > 0.0;
        if !(positive(step_m) && positive(force_n)) {
            return Err(ReliefError::Range);
        }
        if !(LEAST_SAMPLES..=MOST_SAMPLES).contains(&n) || !n.is_power_of_two() || octaves.len() != length(n)
        {
            return Err(ReliefError::Length);
        }
        if !octaves.iter().all(|x| x.is_finite()) {
            return Err(ReliefError::Number);
        }
        Ok(Self { step_m, force_n, n, octaves })
    }

    /// A relief over numbers that [`Relief::new`] has accepted before. Others are silent or not finite, never out of bounds.
    pub fn checked_before(step_m: f32, force_n: f32, n: usize, octaves: &'a [f32]) -> Self {
        Self { step_m, force_n, n: n.clamp(LEAST_SAMPLES, MOST_SAMPLES).next_power_of_two(), octaves }
    }

    /// Distance of two samples of the first octave, in m.
    pub fn step_m(&self) -> f32 {
        self.step_m
    }

    /// Force in N at which it has its level.
    pub fn force_n(&self) -> f32 {
        self.force_n
    }

    /// Samples of the first octave.
    pub fn n(&self) -> usize {
        self.n
    }

    /// The numbers of all octaves.
    pub fn octaves(&self) -> &'a [f32] {
        self.octaves
    }

    /// The value in m/s² at a place, in samples of the first octave, between octaves: 0.5 is half of both.
    fn at(&self, place: f64, octave: f32) -> f32 {
        // Beyond the last octave nothing but the mean is left.
        let beyond = (self.n / LEAST_SAMPLES).ilog2() + 1;
        let octave = octave.clamp(0.0, beyond as f32);
        let lower = octave as u32;
        let share = octave - lower as f32;
        let value = self.in_octave(place, lower);
        if share > 0.0 { value + share * (self.in_octave(place, lower + 1) - value) } else { value }
    }

    /// The cubic through the four samples around (Catmull and Rom).
    fn in_octave(&self, place: f64, octave: u32) -> f32 {
        let n = self.n >> octave;
        if n < LEAST_SAMPLES {
            let last = self.octaves.get(2 * (self.n - LEAST_SAMPLES)..).unwrap_or(&[]);
            return last.iter().sum::<f32>() / LEAST_SAMPLES as f32;
        }
        let begin = 2 * (self.n - n);
        // The first samples of all octaves lie at one place.
        let at = place / f64::from(1_u32 << octave);
        // So far away that there is no telling where.
        let at = if at.is_finite() { at } else { 0.0 };
        let whole = libm::floor(at);
        let t = (at - whole) as f32;
        let sample = |i: i64| {
            let index = (whole as i64).wrapping_add(i) as usize & (n - 1);
            self.octaves.get(begin + index).copied().unwrap_or(0.0)
        };
        let [a, b, c, d] = [sample(-1), sample(0), sample(1), sample(2)];
        b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
    }

    /// The octave that is played where the tip goes so far from model sample to model sample: the one whose band ends at half
    /// the rate or below. From there the next one comes in within a quarter of an octave, so that what is heard at the very
    /// end of the band is not lost a little later, and only there anything can fold back.
    fn octave(&self, way_m: f64) -> f32 {
        let ways = libm::fabs(way_m) as f32 / (2.0 * self.step_m);
        if ways <= 1.0 {
            return 0.0;
        }
        let octave = libm::log2f(ways);
        let lower = libm::floorf(octave);
        lower + (4.0 * (octave - lower)).min(1.0)
    }
}

/// Where the tip goes in a tick, and how hard it is pressed at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passage {
    /// Place at the beginning and at the end, in m.
    pub places_m: (f64, f64),
    /// Force at the beginning and at the end, in N.
    pub forces_n: (f32, f32),
    /// Whether it begins elsewhere than the one before ended.
    pub is_elsewhere: bool,
    n_jumps: u32,
}

impl Passage {
    /// The way from the end of this one to another place and force. Where the tip was in the air, or is somewhere else of a
    /// sudden, it does not go there: it is there.
    #[must_use]
    pub fn on(self, place: Place, force_n: f32) -> Self {
        let Place { x_m, n_jumps } = place;
        let place_m = if x_m.is_finite() { x_m } else { self.places_m.1 };
        let is_far = libm::fabs(place_m - self.places_m.1) > JUMP_M;
        let is_elsewhere = self.forces_n.1 <= 0.0 || n_jumps != self.n_jumps || is_far;
        let before_m = if is_elsewhere { place_m } else { self.places_m.1 };
        Self { places_m: (before_m, place_m), forces_n: (self.forces_n.1, force_n), is_elsewhere, n_jumps }
    }
}

/// A relief sounding.
#[derive(Clone, Debug)]
pub struct ReliefVoice {
    /// What the high-pass keeps of its last output from sample to sample, and takes of a change.
    keep: f32,
    take: f32,
    /// Last input and output in m/s², while the tip is down.
    last: Option<(f32, f32)>,
    octave: f32,
}

impl ReliefVoice {
    /// A silent voice at a model's rate.
    pub fn new(rate_hz: f32) -> Self {
        let corner = PI * HIGH_PASS_HZ / rate_hz;
        let (keep, take) = ((1.0 - corner) / (1.0 + corner), 1.0 / (1.0 + corner));
        Self { keep, take, last: None, octave: 0.0 }
    }

    /// Forgets what sounded.
    pub fn reset(&mut self) {
        self.last = None;
    }

    /// Adds a tick to `out` (at most [`MAX_TICK`] samples), times a weight that goes from `weights.0` to `weights.1`. A tip
    /// that lands begins in silence, whatever is there.
    ///
    /// Cost a sample: two cubics.
    pub fn add_tick(&mut self, relief: &Relief<'_>, passage: &Passage, weights: (f32, f32), out: &mut [f32]) {
        let Passage { places_m, forces_n, is_elsewhere, .. } = *passage;
        if forces_n.1 <= 0.0 && (forces_n.0 <= 0.0 || self.last.is_none()) {
            self.last = None;
            return;
        }
        let n = out.len().min(MAX_TICK);
        let share = 1.0 / n.max(1) as f32;
        let way_m = (places_m.1 - places_m.0) * f64::from(share);
        let octave = relief.octave(way_m);
        // What was played before a landing or a jump says nothing of how fast the tip is now.
        let goes_on = self.last.is_some() && !is_elsewhere;
        let octave_before = if goes_on { self.octave } else { octave };
        self.octave = octave;
        let here = || relief.at(places_m.0 / f64::from(relief.step_m), octave_before);
        // What still sounds goes on from there, so that nothing clicks.
        let (mut input, mut kept) = match self.last {
            Some((_, kept)) if is_elsewhere => (here(), kept),
            Some(last) => last,
            None => (here(), 0.0),
        };
        let gain = |force_n: f32, weight: f32| weight * (force_n / relief.force_n).min(MOST_GAIN);
        let gains = (gain(forces_n.0, weights.0), gain(forces_n.1, weights.1));
        for (i, y) in out[..n].iter_mut().enumerate() {
            let done = (i + 1) as f32 * share;
            let place = (places_m.0 + way_m * (i + 1) as f64) / f64::from(relief.step_m);
            let x = relief.at(place, octave_before + done * (self.octave - octave_before));
            kept = self.keep * kept + self.take * (x - input);
            input = x;
            *y += (gains.0 + done * (gains.1 - gains.0)) * kept;
        }
        self.last = (forces_n.1 > 0.0).then_some((input, kept));
    }
}

#[cfg(test)]
mod tests;
