//! Power over the direction of the stroke, and the modulation that chance produces.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::maths::least_squares::least_squares;
use crate::maths::rng::Random;
use crate::maths::statistics::quantile;
use crate::recording::fit::directional::groups::difference;

/// Largest gap between neighboring axes, in rad, from which the direction of the lay can be computed: 100°. Three axes
/// that are 45° and 90° apart suffice.
const MAX_GAP_RAD: f64 = 100.0 / 180.0 * PI;

/// Smallest distance of two axes, in rad, that shows a lay along one of them: 45°.
const MIN_APART_RAD: f64 = 0.25 * PI;

/// Lowest power of the law, relative to the quietest measured direction: 10 dB below it. A lay can be that quiet
/// between two measured axes; a surface that differs from the law can make the fitted power zero or negative.
const LEAST_SHARE: f64 = 0.1;

/// Smallest determinant of the normal equations, relative to the product of their diagonal, that determines a law.
const LEAST_DETERMINANT: f64 = 1e-6;

/// Number of passes of the weighted least squares; the weights converge by half in each.
const N_PASSES: usize = 20;

/// Number of simulated textures without a lay. The 95th percentile then has a standard error of about 3 %.
const N_DRAWS: usize = 400;

/// Share of the simulated textures whose modulation counts as chance.
const CHANCE: f64 = 0.95;

/// Seed of the simulated textures.
const SEED: u64 = 0x1A9;

/// Power over direction: `P(θ) = mean + cos · cos 2θ + sin · sin 2θ`, in the unit of the powers that it was fitted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PowerLaw {
    mean: f64,
    cos: f64,
    sin: f64,
    least: f64,
}

impl PowerLaw {
    /// Fits the law to the powers (above 0) of strokes along axes (0 to π, ascending).
    ///
    /// Axes with gaps of at most 100° determine the direction of the lay. Otherwise, two axes at least 45° apart suffice
    /// if the lay is assumed along one of them: the loudest axis lies across it. `None` for other axes.
    pub(super) fn fit(axes_rad: &[f64], powers: &[f64]) -> Option<Self> {
        if axes_rad.len() >= 3 && largest_gap_rad(axes_rad) <= MAX_GAP_RAD {
            let columns = [
                vec![1.0; axes_rad.len()],
                axes_rad.iter().map(|axis| (2.0 * axis).cos()).collect(),
                axes_rad.iter().map(|axis| (2.0 * axis).sin()).collect(),
            ];
            let coefficients = weighted(&columns, powers)?;
            let [mean, cos, sin] = coefficients[..] else { return None };
            return Some(Self { mean, cos, sin, least: least_of(powers) });
        }
        let apart = |a: &f64, b: &f64| difference(*a, *b, PI).abs();
        let is_wide = axes_rad.iter().any(|a| axes_rad.iter().any(|b| apart(a, b) >= MIN_APART_RAD - 1e-9));
        let (loudest_rad, _) = axes_rad.iter().zip(powers).max_by(|a, b| a.1.total_cmp(b.1))?;
        if is_wide { Self::fit_across(axes_rad, powers, *loudest_rad) } else { None }
    }

    /// Fits the law with the lay at a right angle to `across_rad`. `None` if the axes do not determine it.
    pub(super) fn fit_across(axes_rad: &[f64], powers: &[f64], across_rad: f64) -> Option<Self> {
        let columns = [
            vec![1.0; axes_rad.len()],
            axes_rad.iter().map(|axis| (2.0 * (axis - across_rad)).cos()).collect(),
        ];
        let coefficients = weighted(&columns, powers)?;
        let [mean, amplitude] = coefficients[..] else { return None };
        let (sin, cos) = (2.0 * across_rad).sin_cos();
        Some(Self { mean, cos: amplitude * cos, sin: amplitude * sin, least: least_of(powers) })
    }

    /// Shares of the measured axes in the fit at a direction, for a law from [`PowerLaw::fit_across`] and the same axes:
    /// the sum of the measured powers with these shares is the power of the law. `None` if the axes do not determine it.
    pub(super) fn shares(self, axes_rad: &[f64], across_rad: f64, direction_rad: f64) -> Option<Vec<f64>> {
        let column = |angle_rad: f64| (2.0 * (angle_rad - across_rad)).cos();
        let weights: Vec<f64> = axes_rad.iter().map(|axis| self.at(*axis).powi(-2)).collect();
        let moment = |power: i32| -> f64 {
            axes_rad.iter().zip(&weights).map(|(axis, weight)| weight * column(*axis).powi(power)).sum()
        };
        // The normal equations of the two columns 1 and cos 2(θ - across), solved for each axis.
        let [s0, s1, s2] = [moment(0), moment(1), moment(2)];
        let determinant = s0 * s2 - s1 * s1;
        let at = column(direction_rad);
        let share = |(axis, weight): (&f64, &f64)| {
            let own = column(*axis);
            weight * (s2 - s1 * own + at * (s0 * own - s1)) / determinant
        };
        (determinant > LEAST_DETERMINANT * s0 * s2)
            .then(|| axes_rad.iter().zip(&weights).map(share).collect())
    }

    /// Power of strokes in a direction, not below a tenth of the quietest measured one.
    pub(super) fn at(self, direction_rad: f64) -> f64 {
        let (sin, cos) = (2.0 * direction_rad).sin_cos();
        (self.mean + self.cos * cos + self.sin * sin).max(self.least)
    }

    /// Direction of the highest power in rad, -π/2 to π/2: across the lay.
    pub(super) fn across_rad(self) -> f64 {
        0.5 * self.sin.atan2(self.cos)
    }

    /// Highest power relative to the lowest, in dB.
    pub(super) fn modulation_db(self) -> f64 {
        let across_rad = self.across_rad();
        10.0 * (self.at(across_rad) / self.at(across_rad + FRAC_PI_2)).log10()
    }
}

/// 95th percentile of the modulation, in dB, of textures without a lay whose levels along the axes have these standard
/// errors in dB.
pub(super) fn modulation_by_chance_db(axes_rad: &[f64], errors_db: &[f64]) -> f64 {
    let mut random = Random::new(SEED);
    let mut modulation = || {
        let powers: Vec<f64> =
            errors_db.iter().map(|error_db| 10_f64.powf(0.1 * error_db * random.normal())).collect();
        PowerLaw::fit(axes_rad, &powers).map(PowerLaw::modulation_db)
    };
    let drawn: Vec<f64> = (0..N_DRAWS).filter_map(|_| modulation()).collect();
    quantile(&drawn, CHANCE).unwrap_or(0.0)
}

/// Lowest power that a law for these powers may have.
fn least_of(powers: &[f64]) -> f64 {
    (LEAST_SHARE * powers.iter().copied().fold(f64::INFINITY, f64::min)).max(f64::MIN_POSITIVE)
}

/// Largest angle between neighboring axes in rad, around half a turn.
fn largest_gap_rad(axes_rad: &[f64]) -> f64 {
    let (Some(first), Some(last)) = (axes_rad.first(), axes_rad.last()) else { return PI };
    let between = axes_rad.windows(2).map(|pair| pair[1] - pair[0]);
    between.fold(first + PI - last, f64::max)
}

/// Coefficients of the columns by least squares with the weights `1 / predicted power²`: the error of an estimated power
/// is proportional to the power, and the quiet directions matter most for the ratio.
fn weighted(columns: &[Vec<f64>], powers: &[f64]) -> Option<Vec<f64>> {
    let least = least_of(powers);
    let mut predicted = powers.to_vec();
    let mut coefficients = Vec::new();
    for _ in 0..N_PASSES {
        let scaled =
            |values: &[f64]| -> Vec<f64> { values.iter().zip(&predicted).map(|(x, p)| x / p).collect() };
        let scaled_columns: Vec<Vec<f64>> = columns.iter().map(|column| scaled(column)).collect();
        // Axes that do not determine the coefficients have no law.
        coefficients = least_squares(&scaled_columns, &scaled(powers)).ok()?.coefficients;
        for (row, predicted) in predicted.iter_mut().enumerate() {
            let sum: f64 = columns.iter().zip(&coefficients).map(|(column, c)| c * column[row]).sum();
            // Half a step at a time does not oscillate.
            *predicted = 0.5 * (*predicted + sum.max(least));
        }
    }
    Some(coefficients)
}

#[cfg(test)]
mod tests {
    use super::{PowerLaw, modulation_by_chance_db};
    use proptest::prelude::{prop_assert, proptest};
    use std::f64::consts::FRAC_PI_2;

    fn rad<const N: usize>(degrees: [f64; N]) -> Vec<f64> {
        degrees.iter().map(|degrees| degrees.to_radians()).collect()
    }

    proptest! {
        #[test]
        fn powers_of_the_law_give_back_the_law(
            across_rad in -1.5_f64..1.5,
            modulation_db in 0.5_f64..25.0,
            scale in 0.001_f64..1000.0,
        ) {
            let along = 10_f64.powf(-0.1 * modulation_db);
            let power = |axis: &f64| {
                let cos = (axis - across_rad).cos().powi(2);
                scale * (cos + along * (1.0 - cos))
            };
            for axes in [rad([0.0, 45.0, 90.0, 135.0]), rad([10.0, 60.0, 95.0, 170.0]), rad([0.0, 45.0, 90.0])] {
                let powers: Vec<f64> = axes.iter().map(power).collect();
                let law = PowerLaw::fit(&axes, &powers).unwrap();
                // The weights do not matter if the law is exact.
                let turned = (law.across_rad() - across_rad).sin().abs();
                prop_assert!(turned < 1e-6, "{turned}");
                // The lay is up to 45° from the nearest axis, so the floor of the law is 13 dB below its peak at least.
                if modulation_db < 12.0 {
                    prop_assert!((law.modulation_db() - modulation_db).abs() < 1e-6);
                    prop_assert!((law.at(across_rad) / scale - 1.0).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn two_axes_show_a_lay_along_one_of_them() {
        let law = PowerLaw::fit(&rad([20.0, 110.0]), &[1.0, 4.0]).unwrap();
        assert!((law.across_rad() - 110_f64.to_radians()).sin().abs() < 1e-9, "{law:?}");
        assert!((law.modulation_db() - 6.0206).abs() < 1e-3, "{law:?}");
        // A known direction across is kept, and the other axis may be the louder one.
        let law = PowerLaw::fit_across(&rad([20.0, 110.0]), &[1.0, 4.0], 20_f64.to_radians()).unwrap();
        assert!((law.at(20_f64.to_radians()) - 1.0).abs() < 1e-9);
        assert!((law.at(20_f64.to_radians() + FRAC_PI_2) - 4.0).abs() < 1e-9);
        for axes in [rad([0.0, 20.0]), rad([30.0, 35.0])] {
            assert_eq!(PowerLaw::fit(&axes, &[1.0, 2.0]), None);
        }
        assert_eq!(PowerLaw::fit(&[1.0], &[1.0]), None);
        assert_eq!(PowerLaw::fit(&[], &[]), None);
    }

    #[test]
    fn the_shares_of_the_axes_give_the_power_of_the_law() {
        let axes = rad([0.0, 45.0, 90.0, 135.0]);
        let powers = [3.0, 1.4, 0.4, 2.2];
        let across_rad = PowerLaw::fit(&axes, &powers).unwrap().across_rad();
        let law = PowerLaw::fit_across(&axes, &powers, across_rad).unwrap();
        for degrees in [-30.0_f64, 0.0, 20.0, 110.0] {
            let direction_rad = degrees.to_radians();
            let shares = law.shares(&axes, across_rad, direction_rad).unwrap();
            let sum: f64 = shares.iter().zip(powers).map(|(share, power)| share * power).sum();
            // The weights of the fit have converged to a millionth.
            assert!((sum / law.at(direction_rad) - 1.0).abs() < 1e-4, "{sum} at {degrees}");
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "a constant stays");
        }
        assert_eq!(law.shares(&rad([20.0, 20.0]), 0.0, 1.0), None);
    }

    #[test]
    fn a_quiet_direction_is_weighted_by_its_error() {
        // Across is off by half a decibel at one axis; the quiet axis is exact and stays within a tenth of a decibel.
        let axes = rad([0.0, 45.0, 90.0, 135.0]);
        let mut powers = [1.0, 0.525, 0.05, 0.525];
        powers[0] *= 10_f64.powf(0.05);
        let law = PowerLaw::fit(&axes, &powers).unwrap();
        let error_db = 10.0 * (law.at(FRAC_PI_2) / 0.05).log10();
        assert!(error_db.abs() < 0.1, "{error_db}");
    }

    #[test]
    fn chance_grows_with_the_spread() {
        let axes = rad([0.0, 45.0, 90.0, 135.0]);
        assert!(modulation_by_chance_db(&axes, &[0.0; 4]) < 1e-9);
        let chance = modulation_by_chance_db(&axes, &[0.5; 4]);
        // The cosine and the sine have the standard deviation 0.5 dB sqrt(2/4); the 95th percentile of the length of two
        // normal deviates is 2.45 of it, and the modulation is twice the length: 1.73 dB. The percentile of 400 draws
        // has a standard error of 3 %; five of them are allowed.
        assert!((chance / 1.73 - 1.0).abs() < 0.15, "{chance}");
        assert!(modulation_by_chance_db(&rad([0.0, 30.0]), &[0.5; 2]).abs() < 1e-12);
    }
}
