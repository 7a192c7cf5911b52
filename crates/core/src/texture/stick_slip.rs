//! Friction of a texture over tip speed, and the speeds at which a tip on it sticks and slips.
//!
//! [`shagreen_synth::stick_slip`] has the model and its constants: a pen's lateral mass on a grip, over LuGre bristles.

use std::ops::RangeInclusive;

use shagreen_synth::stick_slip::{
    BRISTLE_M, DAMPING_N_S_PER_M, Friction, MASS_KG, STIFFNESS_N_PER_M, VISCOUS_N_S_PER_M,
};

use crate::units::{MetersPerSecond, Newtons};

/// Valid ratios of the static to the kinetic friction coefficient: those that the renderer accepts.
pub const STATIC_RATIOS: RangeInclusive<f64> = 1.0..=5.0;

/// Valid Stribeck speeds, in m/s: those that the renderer accepts.
pub const STRIBECK_MPS: RangeInclusive<f64> = 1e-3..=0.5;

/// Stribeck speed of a texture that does not stick; it matters only where such a texture is mixed with one that does.
const USUAL_STRIBECK: MetersPerSecond = MetersPerSecond(0.02);

/// Halvings of the interval that contains the critical speed.
const HALVINGS: usize = 50;

/// Friction over tip speed, relative to the kinetic coefficient: a coefficient that falls from its static to its kinetic
/// value as `exp(-(v / v_s)²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickSlip {
    /// Static over kinetic coefficient, in [`STATIC_RATIOS`].
    pub static_ratio: f64,
    /// Stribeck speed `v_s`, in [`STRIBECK_MPS`].
    pub stribeck_speed: MetersPerSecond,
}

/// Reasons why numbers are not valid stick-slip friction.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StickSlipError {
    /// A value is out of range or not a number.
    #[error("the {what} of its stick-slip friction is {value}; it must be between {low} and {high}{unit}")]
    Value {
        /// Quantity that is out of range.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Lowest valid value.
        low: f64,
        /// Highest valid value.
        high: f64,
        /// Unit of the values, after a space; empty for a ratio.
        unit: &'static str,
    },
}

impl StickSlip {
    /// Friction that does not depend on speed: a tip never sticks.
    pub const NONE: Self = Self { static_ratio: 1.0, stribeck_speed: USUAL_STRIBECK };

    /// Returns the friction if its values are in range.
    ///
    /// # Errors
    /// See [`StickSlipError`].
    pub fn checked(self) -> Result<Self, StickSlipError> {
        for (what, value, range, unit) in [
            ("static ratio", self.static_ratio, &STATIC_RATIOS, ""),
            ("Stribeck speed", self.stribeck_speed.0, &STRIBECK_MPS, " m/s"),
        ] {
            if !range.contains(&value) {
                let (low, high) = (*range.start(), *range.end());
                return Err(StickSlipError::Value { what, value, low, high, unit });
            }
        }
        Ok(self)
    }

    /// Returns the friction for the renderer, with this kinetic coefficient.
    pub fn with_kinetic(self, kinetic: f64) -> Friction {
        Friction {
            kinetic: kinetic as f32,
            static_ratio: self.static_ratio as f32,
            stribeck_speed_mps: self.stribeck_speed.0 as f32,
        }
    }

    /// Returns the highest speed at which steady sliding is unstable, so that a tip sticks and slips, for a kinetic
    /// coefficient and a normal force; `None` if it slides steadily at any speed.
    ///
    /// With a rigid bristle it is the larger solution of `2 (F_s - F_k) v / v_s² exp(-(v / v_s)²) = c + σ₂`: friction falls
    /// with speed as fast as the grip damps. The bristles change this slightly: steady sliding is stable by the
    /// Routh-Hurwitz criterion of the linearized model, `a₂ a₁ > a₀` with `α = σ₀ v / g`, `β = v g' / g` and
    ///
    /// `a₂ = (c + σ₂ + σ₁ β) / m + α`, `a₁ = (α (c + σ₂ + g') + k) / m`, `a₀ = k α / m`.
    ///
    /// Above this speed an oscillation does not arise. One that has arisen while the tip was slower can last up to about
    /// twice this speed.
    pub fn critical_speed(self, kinetic: f64, force: Newtons) -> Option<MetersPerSecond> {
        let kinetic_n = kinetic * force.0;
        // The slope is steepest at this speed, and falls from there on.
        let mut low_mps = self.stribeck_speed.0 / std::f64::consts::SQRT_2;
        let mut high_mps = 8.0 * self.stribeck_speed.0;
        let is_number = kinetic_n.is_finite() && kinetic_n > 0.0;
        if !is_number || self.is_steady(kinetic_n, low_mps) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle_mps = 0.5 * (low_mps + high_mps);
            if self.is_steady(kinetic_n, middle_mps) {
                high_mps = middle_mps;
            } else {
                low_mps = middle_mps;
            }
        }
        Some(MetersPerSecond(high_mps))
    }

    /// Whether steady sliding at this speed is stable, for a kinetic friction force in N.
    fn is_steady(self, kinetic_n: f64, speed_mps: f64) -> bool {
        let x = speed_mps / self.stribeck_speed.0;
        let excess_n = kinetic_n * (self.static_ratio - 1.0) * (-x * x).exp();
        let friction_n = kinetic_n + excess_n;
        let slope = -2.0 * x / self.stribeck_speed.0 * excess_n;
        let [mass, stiffness, grip, viscous] =
            [MASS_KG, STIFFNESS_N_PER_M, DAMPING_N_S_PER_M, VISCOUS_N_S_PER_M].map(f64::from);
        let bristle = kinetic_n / f64::from(BRISTLE_M);
        let bristle_damping = (bristle * mass).sqrt();
        let alpha = bristle * speed_mps / friction_n;
        let beta = speed_mps * slope / friction_n;
        let a2 = (grip + viscous + bristle_damping * beta) / mass + alpha;
        let a1 = (alpha * (grip + viscous + slope) + stiffness) / mass;
        let a0 = stiffness * alpha / mass;
        a2 > 0.0 && a1 > 0.0 && a2 * a1 > a0
    }
}

/// Returns the friction of a texture for the renderer, or `None` without a known kinetic coefficient. A texture without
/// stick-slip has friction too: displays that render friction need its coefficient.
pub fn friction(kinetic: Option<f64>, stick_slip: Option<StickSlip>) -> Option<Friction> {
    Some(stick_slip.unwrap_or(StickSlip::NONE).with_kinetic(kinetic?))
}

#[cfg(test)]
mod tests;
