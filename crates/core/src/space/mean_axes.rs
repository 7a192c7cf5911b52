//! Mean axes of textures that are rotated on the pad, and what a rotated texture contributes to the grain across and along
//! them.
//!
//! A lay has an axis, but no sign: 170° and -10° are the same. Rotations are therefore averaged as vectors of twice the angle,
//! and the length R of the mean vector, 0 to 1, tells how well the axes agree (K. Mardia and P. Jupp, "Directional statistics",
//! 2000). The power of a grain in the direction φ of a stroke has the share `sin² φ` of the grain along its lay, so that a
//! texture at the angle δ to the mean axes contributes
//!
//! `(1 − ρ cos 2δ) / 2` of its grain along the lay across them, and `(1 + ρ cos 2δ) / 2` along them.
//!
//! Two lays at right angles with equal weights thus give an isotropic texture. Where R is zero, the mean axes are undefined and
//! jump; ρ is one except for R below [`CERTAIN`], and zero there, so that nothing is felt of the jump.

use std::f64::consts::PI;

/// Length of the mean vector from which the mean axes are certain.
const CERTAIN: f64 = 0.25;

/// Length of the mean vector below which its direction is rounding; the axes of the heaviest texture replace it.
const ROUNDING: f64 = 1e-12;

/// Mean axes of some textures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MeanAxes {
    /// Angle of the x axis on the pad, counterclockwise, in rad.
    pub(crate) turn_rad: f64,
    /// The factor ρ, 0 to 1.
    certainty: f64,
}

impl MeanAxes {
    /// Axes of a single texture.
    pub(crate) const fn at(turn_rad: f64) -> Self {
        Self { turn_rad, certainty: 1.0 }
    }

    /// Mean axes of textures with these rotations in rad and weights; exactly those of the pad if none is rotated.
    ///
    /// Of the two rotations with the mean axis, the result has the one nearer to that of the texture with the largest weight.
    /// Negative weights count as zero: they would turn the axis away from a texture.
    pub(crate) fn mean(parts: impl Iterator<Item = (f64, f64)>) -> Self {
        let (mut x, mut y, mut total) = (0.0, 0.0, 0.0);
        let (mut heaviest, mut heaviest_turn_rad) = (0.0, 0.0);
        let mut is_turned = false;
        for (turn_rad, weight) in parts {
            let weight = f64::max(weight, 0.0);
            let (sin, cos) = f64::sin_cos(2.0 * turn_rad);
            (x, y, total) = (x + weight * cos, y + weight * sin, total + weight);
            is_turned |= turn_rad != 0.0;
            if weight > heaviest {
                (heaviest, heaviest_turn_rad) = (weight, turn_rad);
            }
        }
        if !is_turned || total == 0.0 {
            return Self::at(0.0);
        }
        let resultant = f64::hypot(x, y) / total;
        if resultant < ROUNDING {
            return Self { turn_rad: heaviest_turn_rad, certainty: 0.0 };
        }
        let axis_rad = 0.5 * f64::atan2(y, x);
        let is_opposite = f64::cos(axis_rad - heaviest_turn_rad) < 0.0;
        let certainty = (resultant / CERTAIN).min(1.0);
        Self { turn_rad: if is_opposite { axis_rad + PI } else { axis_rad }, certainty }
    }

    /// Shares of the grain along its lay, 0 to 1, in what a texture with this rotation in rad contributes to the grain across
    /// and to that along the lay of the mean axes. They are exactly 0 and 1 for a texture with these axes.
    pub(crate) fn shares_along(&self, turn_rad: f64) -> [f64; 2] {
        let cos = self.certainty * (2.0 * (turn_rad - self.turn_rad)).cos();
        [0.5 * (1.0 - cos), 0.5 * (1.0 + cos)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{prop, prop_assert, proptest};

    use super::MeanAxes;

    fn mean(parts_degrees: &[(f64, f64)]) -> MeanAxes {
        MeanAxes::mean(parts_degrees.iter().map(|(turn, weight)| (turn.to_radians(), *weight)))
    }

    fn check_turn(parts_degrees: &[(f64, f64)], expected_degrees: f64) {
        let mean_degrees = mean(parts_degrees).turn_rad.to_degrees();
        let apart = (mean_degrees - expected_degrees).rem_euclid(360.0);
        assert!(apart.min(360.0 - apart) < 1e-9, "{mean_degrees} instead of {expected_degrees}");
    }

    #[test]
    fn rotations_are_averaged_as_axes() {
        check_turn(&[(20.0, 0.5), (40.0, 0.5)], 30.0);
        // 170° is the axis of -10°.
        check_turn(&[(20.0, 0.6), (170.0, 0.4)], mean_of_axes(20.0, 0.6, -10.0, 0.4));
        check_turn(&[(150.0, 1.0)], 150.0);
        check_turn(&[(150.0, 0.9), (-30.0, 0.1)], 150.0);
        check_turn(&[(30.0, 1.25), (80.0, -0.25)], 30.0);
        assert_eq!(mean(&[(0.0, 0.3), (0.0, 0.7)]), MeanAxes::at(0.0));
        assert_eq!(mean(&[]), MeanAxes::at(0.0));
    }

    /// Mean axis of two that are less than 45° apart on either side of zero, in degrees.
    fn mean_of_axes(a: f64, weight_a: f64, b: f64, weight_b: f64) -> f64 {
        let tangent =
            |f: fn(f64) -> f64| weight_a * f(2.0 * a.to_radians()) + weight_b * f(2.0 * b.to_radians());
        0.5 * (tangent(f64::sin) / tangent(f64::cos)).atan().to_degrees()
    }

    #[test]
    fn a_texture_with_the_mean_axes_contributes_each_grain_to_its_own() {
        for turn_degrees in [0.0, 33.0, 143.0, -170.0, 90.0] {
            let axes = mean(&[(turn_degrees, 0.3)]);
            assert_eq!(axes.shares_along(f64::to_radians(turn_degrees)), [0.0, 1.0], "{turn_degrees}°");
            assert_eq!(MeanAxes::at(turn_degrees).shares_along(turn_degrees), [0.0, 1.0]);
        }
        let [across, along] = MeanAxes::at(0.0).shares_along(f64::to_radians(90.0));
        assert!((across - 1.0).abs() < 1e-15 && along.abs() < 1e-15);
    }

    #[test]
    fn equal_lays_at_right_angles_are_isotropic() {
        let grain = |axes: MeanAxes, turns: [f64; 2], weights: [f64; 2]| {
            let shares = turns.map(|turn: f64| axes.shares_along(turn.to_radians()));
            [0, 1].map(|of| weights[0] * shares[0][of] + weights[1] * shares[1][of])
        };
        for begin in [0.0, 20.0, -75.0] {
            let axes = mean(&[(begin, 0.5), (begin + 90.0, 0.5)]);
            let [across, along] = grain(axes, [begin, begin + 90.0], [0.5, 0.5]);
            assert!((across - 0.5).abs() < 1e-12 && (along - 0.5).abs() < 1e-12, "{across} and {along}");
        }
        // Away from that, the heavier lay remains by the resultant.
        let axes = mean(&[(0.0, 0.8), (90.0, 0.2)]);
        let [across, along] = grain(axes, [0.0, 90.0], [0.8, 0.2]);
        assert!((along - across - 0.6).abs() < 1e-12);
    }

    /// Differences of the grains along and across three lays.
    const DIFFERENCES: [f64; 3] = [1.0, 2.0, 0.5];

    /// Difference from the grain across the lay that a stroke at this angle in rad feels on lays with these rotations and
    /// weights, in the axes that `mean` returns.
    fn felt(
        stroke_rad: f64,
        turns_rad: [f64; 3],
        weights: [f64; 3],
        mean: fn([f64; 3], [f64; 3]) -> MeanAxes,
    ) -> f64 {
        let axes = mean(turns_rad, weights);
        let along_stroke = (stroke_rad - axes.turn_rad).sin().powi(2);
        let of_lay = |i: usize| {
            let [across, along] = axes.shares_along(turns_rad[i]);
            weights[i] * DIFFERENCES[i] * (across + along_stroke * (along - across))
        };
        of_lay(0) + of_lay(1) + of_lay(2)
    }

    fn mean_of_three(turns_rad: [f64; 3], weights: [f64; 3]) -> MeanAxes {
        MeanAxes::mean(turns_rad.into_iter().zip(weights))
    }

    /// Negative control: axes that are always certain jump where three lays cancel.
    #[test]
    fn certain_axes_jump_where_lays_cancel() {
        let certain = |turns_rad, weights| MeanAxes { certainty: 1.0, ..mean_of_three(turns_rad, weights) };
        let turns = [0.0_f64, 60.0, 120.0].map(f64::to_radians);
        let jump = |mean: fn([f64; 3], [f64; 3]) -> MeanAxes| {
            felt(0.3, turns, [1.0, 1.0 + 1e-9, 1.0], mean) - felt(0.3, turns, [1.0 + 1e-9, 1.0, 1.0], mean)
        };
        assert!(jump(certain).abs() > 0.05, "{}", jump(certain));
        assert!(jump(mean_of_three).abs() < 1e-7, "{}", jump(mean_of_three));
    }

    proptest! {
        /// What a stroke in any direction feels changes little with the weights.
        #[test]
        fn grains_are_continuous_in_the_weights(
            turns_rad in prop::array::uniform3(-3.1_f64..3.1),
            weights in prop::array::uniform3(0.05_f64..1.0),
            change in prop::array::uniform3(-1.0_f64..1.0),
            stroke_rad in 0.0_f64..3.1,
        ) {
            let step = 1e-6;
            let changed = [0, 1, 2].map(|i| weights[i] + step * change[i]);
            let before = felt(stroke_rad, turns_rad, weights, mean_of_three);
            let after = felt(stroke_rad, turns_rad, changed, mean_of_three);
            // The axes turn by at most the change over R, and count with R / CERTAIN.
            prop_assert!((after - before).abs() < 100.0 * step, "{}", after - before);
        }
    }
}
