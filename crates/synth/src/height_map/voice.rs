//! Playback of a height map by the tip's displacement.

use crate::height_map::{HeightMap, PATCH_FORCES, REFERENCE_SPEED_MPS};
use crate::high_pass::HighPass;
use crate::limits::MAX_TICK;
use crate::octave::octave_for;
use crate::relief::{HIGH_PASS_HZ, Passage};

/// Highest tip speed in m/s that still increases the level.
const HIGHEST_SPEED_MPS: f32 = 10.0;
/// Largest ratio of normal force to reference force that still increases the level.
const MOST_FORCE: f32 = 4.0;
/// Length in m over which the direction follows the tip. It averages the steps of a mouse, whose direction is coarse.
const DIRECTION_M: f64 = 3e-4;
/// Shortest displacement in a tick that has a direction, in m.
const LEAST_M: f64 = 1e-9;
/// Longest displacement along an axis in a tick, in m. A longer one is no displacement.
const MOST_M: f64 = 1.0;

/// Playback state of a height map.
#[derive(Clone, Debug)]
pub struct HeightMapVoice {
    rate_hz: f32,
    high_pass: HighPass,
    is_touching: bool,
    octave: f32,
    /// Level that follows from the speed in the last tick, relative to that at [`REFERENCE_SPEED_MPS`].
    level: f32,
    /// `u_x²`, `2 u_x u_y` and `u_y²` of the direction; `None` before the first displacement of a contact.
    direction: Option<[f32; 3]>,
}

impl HeightMapVoice {
    /// A silent voice at the model's sample rate in Hz.
    pub fn new(rate_hz: f32) -> Self {
        Self {
            rate_hz,
            high_pass: HighPass::new(HIGH_PASS_HZ, rate_hz),
            is_touching: false,
            octave: 0.0,
            level: 0.0,
            direction: None,
        }
    }

    /// Clears the playback state.
    pub fn reset(&mut self) {
        self.high_pass.start_at(0.0);
        self.is_touching = false;
        self.level = 0.0;
        self.direction = None;
    }

    /// Adds a tick to `out` (at most [`MAX_TICK`] samples), multiplied by a weight that changes linearly from
    /// `weights.0` to `weights.1`. The passage is in the axes of the texture.
    ///
    /// The signal is `(v/v₀)^p (F/F₀)^⅓` times the high-passed acceleration at [`REFERENCE_SPEED_MPS`] v₀, where p is the
    /// speed exponent and F/F₀ is limited to 4. The stiffness of a Hertz contact grows with `F^⅓`, and the contact patch
    /// with it. Speed, force, direction and patch change linearly within a tick. The output is zero at a contact onset,
    /// while the tip rests and while it is lifted, whatever the heights.
    ///
    /// Cost per sample: at most two octaves with 72 samples each.
    pub fn add_tick(&mut self, map: &HeightMap<'_>, passage: &Passage, weights: (f32, f32), out: &mut [f32]) {
        let (was_pressed, is_pressed) = (passage.forces_n.0 > 0.0, passage.forces_n.1 > 0.0);
        if !(self.is_touching && was_pressed) {
            self.reset();
        }
        if !(self.is_touching || is_pressed) {
            return;
        }
        self.is_touching = is_pressed;
        let n = out.len().min(MAX_TICK);
        let way_m = [passage.x_m, passage.y_m].map(displacement_m);
        let length_m = libm::hypot(way_m[0], way_m[1]);
        // A tip that has not moved since it landed gives no signal.
        let Some(direction) = followed(self.direction, way_m, length_m) else { return };
        let octave = octave_for(length_m / n.max(1) as f64, map.step_m());
        let level = level(length_m as f32 * self.rate_hz / n.max(1) as f32, map.speed_exponent());
        let forces = [passage.forces_n.0, passage.forces_n.1].map(|force_n| relative(force_n, map));
        let [patch_before, patch] = forces.map(patch_square);
        let [gain_before, gain] = forces.map(|force| libm::cbrtf(force.min(MOST_FORCE)));
        let gains = (weights.0 * self.level * gain_before, weights.1 * level * gain);
        let direction_before = self.direction.unwrap_or(direction);
        let start_m = [passage.x_m.0, passage.y_m.0];
        // The octave before a contact onset or a jump does not match the current speed. The output of the high-pass is kept
        // after a jump, to avoid a click.
        let is_new = self.direction.is_none() || passage.is_elsewhere;
        let octave_before = if is_new { octave } else { self.octave };
        if is_new {
            let here = map.acceleration_mps2(start_m, octave_before, patch_before, direction_before);
            self.high_pass.jump_to(here);
        }
        (self.octave, self.level, self.direction) = (octave, level, Some(direction));
        for (i, y) in out[..n].iter_mut().enumerate() {
            let done = (i + 1) as f64 / n as f64;
            let place_m = [start_m[0] + done * way_m[0], start_m[1] + done * way_m[1]];
            let done = done as f32;
            let between = |from: f32, to: f32| from + done * (to - from);
            let turned = core::array::from_fn(|i| between(direction_before[i], direction[i]));
            let input = map.acceleration_mps2(
                place_m,
                between(octave_before, octave),
                between(patch_before, patch),
                turned,
            );
            *y += between(gains.0, gains.1) * self.high_pass.next(input);
        }
    }
}

/// Displacement along an axis in m; a position that is not finite, or is too far away, counts as rest.
fn displacement_m((from_m, to_m): (f64, f64)) -> f64 {
    let way_m = to_m - from_m;
    if libm::fabs(way_m) < MOST_M { way_m } else { 0.0 }
}

/// The direction after a displacement, as `u_x²`, `2 u_x u_y` and `u_y²`, so that a stroke and its reversal are the same.
fn followed(before: Option<[f32; 3]>, [x_m, y_m]: [f64; 2], length_m: f64) -> Option<[f32; 3]> {
    if length_m < LEAST_M {
        return before;
    }
    let (x, y) = (x_m / length_m, y_m / length_m);
    let now = [x * x, 2.0 * x * y, y * y].map(|part| part as f32);
    let Some(before) = before else { return Some(now) };
    let share = 1.0 - libm::expf(-(length_m / DIRECTION_M) as f32);
    Some(core::array::from_fn(|i| before[i] + share * (now[i] - before[i])))
}

/// Level at a speed in m/s, relative to that at the reference speed.
fn level(speed_mps: f32, speed_exponent: f32) -> f32 {
    // A power of zero of a tip at rest would be one.
    if speed_mps > 0.0 {
        libm::powf(speed_mps.min(HIGHEST_SPEED_MPS) / REFERENCE_SPEED_MPS, speed_exponent)
    } else {
        0.0
    }
}

/// Normal force relative to the reference force; zero if it is no positive number.
fn relative(force_n: f32, map: &HeightMap<'_>) -> f32 {
    let force = force_n / map.force_n();
    if force > 0.0 { force } else { 0.0 }
}

/// Squared radius of the contact patch, relative to that at the reference force.
fn patch_square(force: f32) -> f32 {
    let [least, _, most] = PATCH_FORCES;
    let radius = libm::cbrtf(force.clamp(least, most));
    radius * radius
}
