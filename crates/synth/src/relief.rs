//! Surface relief: a signal stored over position and played by the tip's displacement, in both directions.

use crate::contact::Place;
use crate::high_pass::HighPass;
use crate::limits::MAX_TICK;
use crate::octave::{lower_and_share, octave_for};

/// Fewest samples of an octave: the number that the cubic interpolation uses.
pub const LEAST_SAMPLES: usize = 4;
/// Most samples of an octave.
pub const MOST_SAMPLES: usize = 1 << 24;
/// Cutoff of the high-pass in Hz. Slower changes are not vibration, and a tip at rest must give no signal.
pub const HIGH_PASS_HZ: f32 = 10.0;
/// Largest plausible displacement in one tick, in m. A larger one counts as a jump.
const JUMP_M: f64 = 0.015;
/// Largest ratio of normal force to reference force that still increases the level.
const MOST_GAIN: f32 = 4.0;

/// Reasons why data do not form a valid relief.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReliefError {
    /// The step or the reference force is not a positive finite number.
    Range,
    /// The number of samples is not a power of two in range, or the slice does not have the length of all octaves.
    Length,
    /// A sample is not finite.
    Number,
}

/// A periodic acceleration profile in m/s² over the tip position along the texture's x axis, stored as octaves (a
/// multiresolution pyramid). Octave 0 has `n` samples, one per step. Each further octave has half as many samples and
/// half the bandwidth. Every octave contains only components with at least four samples per period, for the cubic
/// interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief<'a> {
    step_m: f32,
    force_n: f32,
    n: usize,
    octaves: &'a [f32],
}

/// Total number of samples of all octaves of a relief of `n` samples (a power of two), down to [`LEAST_SAMPLES`].
pub const fn length(n: usize) -> usize {
    (2 * n).saturating_sub(LEAST_SAMPLES)
}

impl<'a> Relief<'a> {
    /// A relief of `n` samples (a power of two) with its octaves in sequence, a step in m, and the reference force in N
    /// at which the samples have their stated level.
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

    /// A relief over data that [`Relief::new`] has accepted before. Invalid data give zero or non-finite output and
    /// never an out-of-bounds access.
    pub fn checked_before(step_m: f32, force_n: f32, n: usize, octaves: &'a [f32]) -> Self {
        Self { step_m, force_n, n: n.clamp(LEAST_SAMPLES, MOST_SAMPLES).next_power_of_two(), octaves }
    }

    /// Distance between two samples of octave 0, in m.
    pub fn step_m(&self) -> f32 {
        self.step_m
    }

    /// Reference force in N, at which the samples have their stated level.
    pub fn force_n(&self) -> f32 {
        self.force_n
    }

    /// Number of samples of octave 0.
    pub fn n(&self) -> usize {
        self.n
    }

    /// Samples of all octaves in sequence, in m/s².
    pub fn octaves(&self) -> &'a [f32] {
        self.octaves
    }

    /// Acceleration in m/s² at a position in m along the texture's x axis, at the reference force, without components that
    /// repeat within twice the displacement `way_m`.
    pub fn value_mps2(&self, x_m: f64, way_m: f64) -> f32 {
        self.at(x_m / f64::from(self.step_m), octave_for(way_m, self.step_m))
    }

    /// The value in m/s² at a position, in samples of octave 0. A fractional octave interpolates linearly between two
    /// octaves.
    fn at(&self, place: f64, octave: f32) -> f32 {
        // After the last octave only the mean remains.
        let beyond = (self.n / LEAST_SAMPLES).ilog2() + 1;
        let (lower, share) = lower_and_share(octave, beyond);
        let value = self.in_octave(place, lower);
        if share > 0.0 { value + share * (self.in_octave(place, lower + 1) - value) } else { value }
    }

    /// The value by cubic (Catmull-Rom) interpolation through the four surrounding samples.
    fn in_octave(&self, place: f64, octave: u32) -> f32 {
        let n = self.n >> octave;
        if n < LEAST_SAMPLES {
            let last = self.octaves.get(2 * (self.n - LEAST_SAMPLES)..).unwrap_or(&[]);
            return last.iter().sum::<f32>() / LEAST_SAMPLES as f32;
        }
        let begin = 2 * (self.n - n);
        // The first samples of all octaves lie at the same position.
        let at = place / f64::from(1_u32 << octave);
        // A position that is not finite is read as zero.
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
}

/// Tip displacement during a tick, with the normal force at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passage {
    /// Position to the right at the start and at the end of the tick, in m.
    pub x_m: (f64, f64),
    /// Position upwards at the start and at the end of the tick, in m.
    pub y_m: (f64, f64),
    /// Normal force at the start and at the end, in N.
    pub forces_n: (f32, f32),
    /// Whether the start position differs from the previous end position (a contact onset or a jump).
    pub is_elsewhere: bool,
    n_jumps: u32,
}

impl Passage {
    /// Returns the next passage, from the end of this one to a new position and force. After a lifted tip, or after a
    /// jump, the passage starts at the new position without a displacement.
    #[must_use]
    pub fn on(self, place: Place, force_n: f32) -> Self {
        let here_m = |place_m: f64, before_m: f64| if place_m.is_finite() { place_m } else { before_m };
        let (x_m, y_m) = (here_m(place.x_m, self.x_m.1), here_m(place.y_m, self.y_m.1));
        let (right_m, up_m) = (x_m - self.x_m.1, y_m - self.y_m.1);
        let is_far = right_m * right_m + up_m * up_m > JUMP_M * JUMP_M;
        let is_elsewhere = self.forces_n.1 <= 0.0 || place.n_jumps != self.n_jumps || is_far;
        let (from_x_m, from_y_m) = if is_elsewhere { (x_m, y_m) } else { (self.x_m.1, self.y_m.1) };
        Self {
            x_m: (from_x_m, x_m),
            y_m: (from_y_m, y_m),
            forces_n: (self.forces_n.1, force_n),
            is_elsewhere,
            n_jumps: place.n_jumps,
        }
    }

    /// Returns the passage in the axes of a texture whose x axis lies at an angle on the pad, given by the cosine and
    /// the sine of that angle (counterclockwise). It is the same passage for an angle of zero.
    #[must_use]
    pub fn turned(&self, (cos, sin): (f32, f32)) -> Self {
        let (cos, sin) = (f64::from(cos), f64::from(sin));
        let turn = |x_m: f64, y_m: f64| (cos * x_m + sin * y_m, cos * y_m - sin * x_m);
        let (from, to) = (turn(self.x_m.0, self.y_m.0), turn(self.x_m.1, self.y_m.1));
        Self { x_m: (from.0, to.0), y_m: (from.1, to.1), ..*self }
    }
}

/// Playback state of a relief.
#[derive(Clone, Debug)]
pub struct ReliefVoice {
    high_pass: HighPass,
    is_touching: bool,
    octave: f32,
}

impl ReliefVoice {
    /// A silent voice at the model's sample rate in Hz.
    pub fn new(rate_hz: f32) -> Self {
        Self { high_pass: HighPass::new(HIGH_PASS_HZ, rate_hz), is_touching: false, octave: 0.0 }
    }

    /// Clears the playback state.
    pub fn reset(&mut self) {
        self.is_touching = false;
    }

    /// Adds a tick to `out` (at most [`MAX_TICK`] samples), multiplied by a weight that changes linearly from
    /// `weights.0` to `weights.1`. Of the passage, in the texture's axes, it uses x only. At a contact onset, the output
    /// starts at zero whatever the relief's value there.
    ///
    /// Cost per sample: at most two cubic interpolations.
    pub fn add_tick(&mut self, relief: &Relief<'_>, passage: &Passage, weights: (f32, f32), out: &mut [f32]) {
        let Passage { x_m, forces_n, is_elsewhere, .. } = *passage;
        if forces_n.1 <= 0.0 && (forces_n.0 <= 0.0 || !self.is_touching) {
            self.is_touching = false;
            return;
        }
        let n = out.len().min(MAX_TICK);
        let share = 1.0 / n.max(1) as f32;
        let way_m = (x_m.1 - x_m.0) * f64::from(share);
        let octave = octave_for(way_m, relief.step_m);
        // The octave before a contact onset or a jump does not match the current speed.
        let goes_on = self.is_touching && !is_elsewhere;
        let octave_before = if goes_on { self.octave } else { octave };
        self.octave = octave;
        let here = || relief.at(x_m.0 / f64::from(relief.step_m), octave_before);
        // The high-pass state is kept after a jump, to avoid a click.
        if !self.is_touching {
            self.high_pass.start_at(here());
        } else if is_elsewhere {
            self.high_pass.jump_to(here());
        }
        let gain = |force_n: f32, weight: f32| weight * (force_n / relief.force_n).min(MOST_GAIN);
        let gains = (gain(forces_n.0, weights.0), gain(forces_n.1, weights.1));
        for (i, y) in out[..n].iter_mut().enumerate() {
            let done = (i + 1) as f32 * share;
            let place = (x_m.0 + way_m * (i + 1) as f64) / f64::from(relief.step_m);
            let x = relief.at(place, octave_before + done * (self.octave - octave_before));
            *y += (gains.0 + done * (gains.1 - gains.0)) * self.high_pass.next(x);
        }
        self.is_touching = forces_n.1 > 0.0;
    }
}

#[cfg(test)]
mod tests;
