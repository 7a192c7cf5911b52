//! Whether the tip of a pen can follow the heights of a height map.

use shagreen_core::maths::statistics::standard_deviation;
use shagreen_core::surfaces::contact_model::{PEN, tip_heights_m};
use shagreen_core::texture::height_map::HeightMap;

/// Slope beyond which a tip stops or jumps instead of sliding, in degrees.
const STEEPEST_DEG: f64 = 60.0;
/// Share of the heights, as standard deviations, that a tip must reach.
const LEAST_REACHED: f64 = 0.5;

/// Says why a tip cannot follow the heights, in one sentence; `None` if it can.
pub(super) fn impossible(map: &HeightMap) -> Option<String> {
    let steepest_deg = steepest_deg(map);
    if steepest_deg > STEEPEST_DEG {
        return Some(format!(
            "these heights have slopes of {steepest_deg:.0}°, and a tip cannot slide over more than about {STEEPEST_DEG}°; use a smaller height or a larger side"
        ));
    }
    let reached = reached(map);
    (reached < LEAST_REACHED).then(|| {
        format!(
            "a pen tip with a radius of {} mm reaches only {:.0} % of these heights, because it does not fit between them; use a smaller height or a larger side",
            1e3 * PEN.tip_radius_m,
            100.0 * reached
        )
    })
}

/// Steepest slope from a height to its neighbors on the periodic tile, in degrees.
fn steepest_deg(map: &HeightMap) -> f64 {
    let (n, heights_m) = (map.n(), map.heights_m());
    let step_m = map.side_m() / n as f64;
    let at = |column: usize, row: usize| heights_m[row % n * n + column % n];
    let rise_m = |index: usize| {
        let (column, row) = (index % n, index / n);
        let here = at(column, row);
        (at(column + 1, row) - here).hypot(at(column, row + 1) - here)
    };
    let steepest_m = (0..n * n).map(rise_m).fold(0.0, f64::max);
    (steepest_m / step_m).atan().to_degrees()
}

/// Standard deviation of the heights of a ball that rolls over the map, relative to that of the map: 1 if the ball touches
/// everywhere, near 0 if it rolls over the peaks. A ball of any size follows a flat map.
fn reached(map: &HeightMap) -> f64 {
    let all_m = standard_deviation(map.heights_m());
    if all_m == 0.0 {
        return 1.0;
    }
    let tip_m = tip_heights_m(map.heights_m(), map.n(), map.side_m() / map.n() as f64, &PEN);
    standard_deviation(&tip_m) / all_m
}

#[cfg(test)]
mod tests {
    use super::{HeightMap, PEN, impossible, reached, steepest_deg};
    use shagreen_core::texture::height_map::HeightMapOptions;

    const N: usize = 64;
    /// Side on which the steepest ramps stay below the highest height.
    const SIDE_M: f64 = 0.005;

    /// Map of a height in m at each column and row.
    fn map(side_m: f64, height_m: impl Fn(usize, usize) -> f64) -> HeightMap {
        let heights_m = (0..N * N).map(|index| height_m(index % N, index / N)).collect();
        HeightMap::new(heights_m, side_m, HeightMapOptions::HARD_PLASTIC).unwrap()
    }

    /// A ramp up and down again along x, which rises by `step_m` a column.
    fn ramp(step_m: f64) -> impl Fn(usize, usize) -> f64 {
        move |column, _| step_m * column.min(N - column) as f64
    }

    /// Closed form: the slope of a ramp, and of two ramps at a right angle.
    #[test]
    fn a_ramp_has_its_slope() {
        let step_m = SIDE_M / N as f64;
        for deg in [1.0_f64, 30.0, 44.0] {
            let rise_m = deg.to_radians().tan() * step_m;
            // Rounding of the differences of heights.
            assert!((steepest_deg(&map(SIDE_M, ramp(rise_m))) - deg).abs() < 1e-6, "{deg}°");
            let both = map(SIDE_M, |column, row| ramp(rise_m)(column, row) + ramp(rise_m)(row, column));
            let expected = (2.0_f64.sqrt() * deg.to_radians().tan()).atan().to_degrees();
            assert!((steepest_deg(&both) - expected).abs() < 1e-6, "{deg}°");
        }
        assert_eq!(steepest_deg(&map(SIDE_M, |_, _| 0.0)), 0.0);
    }

    #[test]
    fn slopes_beyond_a_tip_are_named_with_their_angle() {
        let step_m = SIDE_M / N as f64;
        let of = |deg: f64| impossible(&map(SIDE_M, ramp(deg.to_radians().tan() * step_m)));
        // Valleys of these ramps are wide enough for the tip.
        assert_eq!([of(20.0), of(40.0)], [None, None]);
        let said = of(61.4).expect("it is too steep");
        assert!(said.contains("slopes of 61°") && said.contains("about 60°"), "{said}");
    }

    /// Closed form: a ball that rests on ridges at a distance d sinks by R - √(R² - d²/4) between them.
    #[test]
    fn a_tip_rolls_over_what_is_too_narrow_for_it() {
        assert_eq!(reached(&map(SIDE_M, |_, _| 0.0)), 1.0);
        // Ridges of 20 µm on every other column, 40 µm apart.
        let narrow = map(40e-6 * 32.0, |column, _| if column % 2 == 0 { 20e-6 } else { 0.0 });
        let sinks_m = PEN.tip_radius_m - (PEN.tip_radius_m.powi(2) - 20e-6_f64.powi(2)).sqrt();
        assert!((reached(&narrow) - sinks_m / 20e-6).abs() < 1e-6, "{}", reached(&narrow));
        let said = impossible(&narrow).expect("the tip rolls over the ridges");
        assert!(said.contains("1.5 mm") && said.contains("reaches only 1 %"), "{said}");
        // Waves of 20 mm and 0.1 mm height are wide for a tip of 1.5 mm.
        let wave = |column: usize, _: usize| 5e-5 * (std::f64::consts::TAU * column as f64 / N as f64).cos();
        let wide = map(0.02, wave);
        assert!((reached(&wide) - 1.0).abs() < 0.01, "{}", reached(&wide));
        assert_eq!(impossible(&wide), None);
    }
}
