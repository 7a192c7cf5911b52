//! Stick-slip vibration: a tip on the spring and damper of a grip, dragged over bristles that stick and slip.
//!
//! The hand moves at the tip speed `v` of the contact. The tip has the deflection `u` from the hand, the velocity
//! `w = v + u̇` over the surface, and the bristle deflection `z` (C. Canudas de Wit, H. Olsson, K. J. Åström and P.
//! Lischinsky, "A new model for control of systems with friction", 1995, known as LuGre):
//!
//! - `m ü = -k u - c u̇ - F`
//! - `F = σ₀ z + σ₁ ż + σ₂ w` and `ż = w - σ₀ |w| z / g(w)`
//! - `g(w) = F_k + (F_s - F_k) exp(-(w / v_s)²)`, with `F_k` = kinetic coefficient × normal force and `F_s` = `F_k` ×
//!   static ratio
//!
//! The output is the acceleration `ü`. Friction that falls with speed feeds the oscillation, and the damping of the grip
//! takes it away: at speeds far above `v_s` the tip slides steadily and the output is silent. When the normal force
//! changes, the hand balances the change of the mean friction, so that pressing harder is no vibration of its own.

use crate::contact::Contact;
use crate::high_pass::HighPass;
use crate::limits::MAX_TICK;
use crate::relief::HIGH_PASS_HZ;

/// Mass `m` of the tip's lateral motion in kg: that of a pen.
pub const MASS_KG: f32 = 0.040;
/// Lateral stiffness `k` of the grip in N/m: three finger pads of 1 N/mm each (parameters of a finger pad in "Friction
/// perception resulting from laterally vibrotactile stimuli", ROBOMECH Journal, 2017, table 1). A stiffer grip, as that
/// of the contact model, whose lateral resonance lies at 110 Hz, damps more than the friction of most surfaces feeds.
pub const STIFFNESS_N_PER_M: f32 = 3000.0;
/// Lateral damping `c` of the grip in N s/m: three finger pads of 1 N s/m each, from the same source.
pub const DAMPING_N_S_PER_M: f32 = 3.0;
/// Bristle deflection `F_k / σ₀` in m. Canudas de Wit et al. use 10 µm, with `σ₁ = √(σ₀ m)`.
pub const BRISTLE_M: f32 = 1e-5;
/// Viscous friction `σ₂` in N s/m, that of Canudas de Wit et al.
pub const VISCOUS_N_S_PER_M: f32 = 0.4;
/// Highest static ratio that is rendered.
pub const MAX_STATIC_RATIO: f32 = 5.0;
/// Range of the Stribeck speed that is rendered, in m/s.
pub const STRIBECK_SPEEDS_MPS: (f32, f32) = (1e-3, 0.5);
/// Largest magnitude of the output in m/s².
pub const MAX_MPS2: f32 = 100.0;

/// Steps a second that resolve the bristles at [`HIGHEST_KINETIC_N`]. Their stiffness grows with the kinetic friction force,
/// so the steps that they need grow with its square root.
const HIGHEST_STEP_RATE_HZ: f32 = 16_000.0;
/// Steps a second that resolve a slip, whatever the force is.
const LOWEST_STEP_RATE_HZ: f32 = 4000.0;
/// Highest kinetic friction force that is rendered, in N.
const HIGHEST_KINETIC_N: f32 = 20.0;
/// Highest tip speed that is rendered, in m/s.
const HIGHEST_SPEED_MPS: f32 = 10.0;
/// Deviation from steady sliding at the begin of a contact: a share of the tip speed, and at most this much in m/s. An
/// oscillation needs one to grow from; without an oscillation, it is too weak to be felt.
const BEGIN_SHARE: f32 = 0.1;
const BEGIN_MPS: f32 = 1e-3;

/// Friction of a tip on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Friction {
    /// Kinetic coefficient, at least 0.
    pub kinetic: f32,
    /// Static over kinetic coefficient; a tip does not stick at 1 or less.
    pub static_ratio: f32,
    /// Stribeck speed in m/s, at which most of the static friction is gone.
    pub stribeck_speed_mps: f32,
}

impl Friction {
    /// Mean of frictions, each with its weight of 0 or more, and the sum of the weights; `None` if the sum is zero.
    pub fn mean(parts: impl Iterator<Item = (Self, f32)>) -> Option<(Self, f32)> {
        let (mut sum, mut sum_of_weights) = (Self::default(), 0.0_f32);
        for (friction, weight) in parts {
            sum.kinetic += weight * friction.kinetic;
            sum.static_ratio += weight * friction.static_ratio;
            sum.stribeck_speed_mps += weight * friction.stribeck_speed_mps;
            sum_of_weights += weight;
        }
        // A tick without friction divides nothing.
        (sum_of_weights > 0.0).then(|| {
            let mean = Self {
                kinetic: sum.kinetic / sum_of_weights,
                static_ratio: sum.static_ratio / sum_of_weights,
                stribeck_speed_mps: sum.stribeck_speed_mps / sum_of_weights,
            };
            (mean, sum_of_weights)
        })
    }

    fn can_stick(self) -> bool {
        self.is_finite() && self.kinetic > 0.0 && self.static_ratio > 1.0 && self.stribeck_speed_mps > 0.0
    }

    fn is_finite(self) -> bool {
        let Self { kinetic, static_ratio, stribeck_speed_mps } = self;
        [kinetic, static_ratio, stribeck_speed_mps].iter().all(|x| x.is_finite())
    }

    /// Friction within the limits of the integration.
    fn bounded(self) -> Self {
        Self {
            kinetic: self.kinetic.max(0.0),
            static_ratio: self.static_ratio.clamp(1.0, MAX_STATIC_RATIO),
            stribeck_speed_mps: self.stribeck_speed_mps.clamp(STRIBECK_SPEEDS_MPS.0, STRIBECK_SPEEDS_MPS.1),
        }
    }

    /// `g(w) / F_k` at a velocity over the surface, 1 to the static ratio.
    fn stribeck(self, velocity_mps: f32) -> f32 {
        let x = velocity_mps / self.stribeck_speed_mps;
        1.0 + (self.static_ratio - 1.0) * libm::expf(-x * x)
    }
}

/// State of the tip.
#[derive(Clone, Copy, Debug)]
struct Tip {
    deflection_m: f32,
    /// Velocity relative to the hand.
    velocity_mps: f32,
    /// Bristle deflection in units of [`BRISTLE_M`].
    bristle: f32,
    /// Kinetic friction force.
    kinetic_n: f32,
}

impl Tip {
    /// A tip that almost slides steadily.
    fn sliding(friction: Friction, speed_mps: f32, kinetic_n: f32) -> Self {
        let bristle = friction.stribeck(speed_mps);
        let friction_n = kinetic_n * bristle + VISCOUS_N_S_PER_M * speed_mps;
        Self {
            deflection_m: -friction_n / STIFFNESS_N_PER_M,
            velocity_mps: -(BEGIN_SHARE * speed_mps).min(BEGIN_MPS),
            bristle,
            kinetic_n,
        }
    }

    /// Changes the kinetic friction force, and the deflection so that the force on the tip stays.
    fn press(&mut self, kinetic_n: f32) {
        self.deflection_m -= (kinetic_n - self.kinetic_n) * self.bristle / STIFFNESS_N_PER_M;
        self.kinetic_n = kinetic_n;
    }

    /// Advances by equal steps. The bristle is exact for a constant velocity, so it is stable at any speed and never exceeds
    /// the static friction. The spring is integrated by the symplectic Euler method, the damper by the midpoint rule.
    fn advance(&mut self, friction: Friction, speed_mps: f32, n_steps: u32, step_secs: f32) {
        let micro_damping_n_s_per_m = libm::sqrtf(self.kinetic_n / BRISTLE_M * MASS_KG);
        let micro_n = micro_damping_n_s_per_m * BRISTLE_M / step_secs;
        let ways_per_mps = step_secs / BRISTLE_M;
        let damped = 0.5 * DAMPING_N_S_PER_M * step_secs / MASS_KG;
        let (kept, pulled) = ((1.0 - damped) / (1.0 + damped), step_secs / MASS_KG / (1.0 + damped));
        for _ in 0..n_steps {
            let velocity_mps = speed_mps + self.velocity_mps;
            let steady = friction.stribeck(velocity_mps);
            let way = libm::fabsf(velocity_mps) * ways_per_mps / steady;
            // The bristle approaches the deflection of steady sliding.
            let change = libm::expm1f(-way) * (self.bristle - libm::copysignf(steady, velocity_mps));
            self.bristle += change;
            let friction_n =
                self.kinetic_n * self.bristle + micro_n * change + VISCOUS_N_S_PER_M * velocity_mps;
            let pull_n = STIFFNESS_N_PER_M * self.deflection_m + friction_n;
            self.velocity_mps = kept * self.velocity_mps - pulled * pull_n;
            self.deflection_m += step_secs * self.velocity_mps;
        }
    }
}

/// A tip that can stick and slip.
#[derive(Clone, Debug)]
pub struct StickSlip {
    rate_hz: f32,
    /// Tip in motion.
    tip: Option<Tip>,
    high_pass: HighPass,
}

impl StickSlip {
    /// A tip at rest, at the model's sample rate in Hz.
    pub fn new(rate_hz: f32) -> Self {
        let rate_hz = if rate_hz.is_finite() { rate_hz.clamp(200.0, 4000.0) } else { 1000.0 };
        Self { rate_hz, tip: None, high_pass: HighPass::new(HIGH_PASS_HZ, rate_hz) }
    }

    /// Steps of the integration in a sample, for kinetic friction forces of at most this one.
    fn n_steps(&self, kinetic_n: f32) -> u32 {
        let needed_hz = HIGHEST_STEP_RATE_HZ * libm::sqrtf(kinetic_n / HIGHEST_KINETIC_N);
        libm::ceilf(needed_hz.max(LOWEST_STEP_RATE_HZ) / self.rate_hz) as u32
    }

    /// Puts the tip to rest.
    pub fn reset(&mut self) {
        if self.tip.take().is_some() {
            self.high_pass.start_at(0.0);
        }
    }

    /// Adds a tick of acceleration in m/s² to `out` (at most [`MAX_TICK`] samples), with the contacts at its start and end,
    /// and multiplied by a weight that changes linearly from `weights.0` to `weights.1`.
    ///
    /// Adds nothing at all if the friction cannot stick, and while the tip is lifted or at rest. From rest or a lifted tip,
    /// the output fades in within the tick, and fades out likewise; also if the friction can no longer stick. Its magnitude
    /// is at most [`MAX_MPS2`], whatever the friction and the contacts are, times the weight and the overshoot of a high-pass of [`HIGH_PASS_HZ`]. Cost: 4000 to
    /// 20 000 steps a second, more with a larger friction force, each with two exponential functions and a division.
    pub fn add_tick(
        &mut self,
        friction: Friction,
        contacts: (Contact, Contact),
        weights: (f32, f32),
        out: &mut [f32],
    ) {
        let is_moving = |contact: Contact| contact.speed_mps > 0.0 && contact.force_n > 0.0;
        let (from, to) = (contacts.0.sanitized(), contacts.1.sanitized());
        let sticks = friction.can_stick();
        let goes_on = sticks || (self.tip.is_some() && friction.is_finite());
        if !goes_on || !(is_moving(from) || is_moving(to)) {
            self.reset();
            return;
        }
        let friction = friction.bounded();
        let n = out.len().min(MAX_TICK);
        let share = 1.0 / n.max(1) as f32;
        let kinetic_n = |force_n: f32| (friction.kinetic * force_n).min(HIGHEST_KINETIC_N);
        let n_steps = self.n_steps(kinetic_n(from.force_n.max(to.force_n)));
        let step_secs = 1.0 / (self.rate_hz * n_steps as f32);
        let gain = |contact: Contact, weight: f32| if is_moving(contact) { weight } else { 0.0 };
        let gains = (gain(from, weights.0), if sticks { gain(to, weights.1) } else { 0.0 });
        for (i, y) in out[..n].iter_mut().enumerate() {
            let done = (i + 1) as f32 * share;
            let between = |a: f32, b: f32| a + done * (b - a);
            let speed_mps = between(from.speed_mps, to.speed_mps).min(HIGHEST_SPEED_MPS);
            let kinetic_n = kinetic_n(between(from.force_n, to.force_n));
            let begin = || Tip::sliding(friction, speed_mps, kinetic_n);
            let mut tip = self.tip.unwrap_or_else(begin);
            tip.press(kinetic_n);
            let before_mps = tip.velocity_mps;
            tip.advance(friction, speed_mps, n_steps, step_secs);
            // The change of velocity is the mean acceleration over the sample.
            let mps2 = (self.rate_hz * (tip.velocity_mps - before_mps)).clamp(-MAX_MPS2, MAX_MPS2);
            if !mps2.is_finite() {
                self.reset();
                return;
            }
            self.tip = Some(tip);
            *y += (gains.0 + done * (gains.1 - gains.0)) * self.high_pass.next(mps2);
        }
        if !sticks || !is_moving(to) {
            self.reset();
        }
    }
}

#[cfg(test)]
mod tests;
