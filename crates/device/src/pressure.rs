//! Conversion of a pen's unitless pressure to newtons.

/// Map from a pressure of 0..1 to a force: `F = F₀ + (F_max − F₀)(e^{cp} − 1)/(e^c − 1)`. With a positive curvature
/// `c`, the map is steeper towards full pressure, because usual pens report disproportionately high pressure at low
/// forces. Golden values: `vectors/l_stylus`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureMap {
    /// Activation force `F₀` of the tip, in N.
    pub activation_n: f64,
    /// Force `F_max` at full pressure, in N.
    pub full_n: f64,
    /// Curvature `c` of the exponential; zero is a straight line.
    pub bend: f64,
}

impl PressureMap {
    /// Default map for pens that declare no force.
    pub const USUAL: Self = Self { activation_n: 0.03, full_n: 4.0, bend: 2.0 };

    /// Force in N at `pressure` (clamped to 0..1); zero without contact or if `pressure` is NaN.
    pub fn force_n(&self, pressure: f64, touching: bool) -> f64 {
        if !touching || pressure.is_nan() {
            return 0.0;
        }
        let pressure = pressure.clamp(0.0, 1.0);
        let share = if self.bend.abs() < 1e-9 {
            pressure
        } else {
            (self.bend * pressure).exp_m1() / self.bend.exp_m1()
        };
        self.activation_n + (self.full_n - self.activation_n) * share
    }
}

#[cfg(test)]
mod tests {
    use super::PressureMap;

    #[test]
    fn golden_forces() {
        let golden: serde_json::Value =
            serde_json::from_str(include_str!("../../../vectors/l_stylus/kin_vectors.json")).unwrap();
        for (pressure, force_n) in golden["pressure_map_default"].as_object().unwrap() {
            let (pressure, expected): (f64, f64) = (pressure.parse().unwrap(), force_n.as_f64().unwrap());
            let force = PressureMap::USUAL.force_n(pressure, true);
            assert!((force - expected).abs() <= 1e-9 * expected, "{pressure}: {force} for {expected}");
        }
    }

    #[test]
    fn no_bend_is_a_straight_line_and_the_limit_of_a_small_one() {
        let line = PressureMap { bend: 0.0, ..PressureMap::USUAL };
        let nearly = PressureMap { bend: 1e-6, ..line };
        for pressure in [0.0, 0.25, 0.5, 1.0] {
            let expected = 0.03 + 3.97 * pressure;
            assert!((line.force_n(pressure, true) - expected).abs() < 1e-12);
            assert!((nearly.force_n(pressure, true) - expected).abs() < 1e-5);
        }
    }

    #[test]
    fn a_tip_that_is_off_has_no_force_and_nonsense_is_pulled_in() {
        for pressure in [0.0, 0.7, f64::NAN] {
            assert_eq!(PressureMap::USUAL.force_n(pressure, false), 0.0);
        }
        assert_eq!(PressureMap::USUAL.force_n(f64::NAN, true), 0.0);
        assert_eq!(PressureMap::USUAL.force_n(0.0, true), 0.03);
        assert_eq!(PressureMap::USUAL.force_n(7.0, true), 4.0);
        assert_eq!(PressureMap::USUAL.force_n(-7.0, true), 0.03);
    }
}
