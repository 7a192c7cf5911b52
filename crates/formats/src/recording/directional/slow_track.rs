//! Quantity of a slower sensor, interpolated at the times of the acceleration.

use std::f64::consts::{PI, TAU};

use shagreen_core::dsp::spectrum::median;

use crate::recording::directional::quantity_table::QuantityTable;

/// Number of usual steps between two values from which on the interval is a gap.
const GAP_STEPS: f64 = 3.0;

/// Time over which a displacement is measured, in s: longer than the step of a sensor, shorter than a stroke.
const LAG_SECS: f64 = 0.1;

/// Smallest straightness of a path that has a direction: 1 on a line, 0 on a circle.
const MIN_STRAIGHT: f64 = 0.9;

/// Share of the path that leads away from its start in a stroke that goes one way.
const ONE_WAY_SHARE: f64 = 0.5;

/// Values of a slower sensor with ascending times.
#[derive(Debug)]
pub(super) struct SlowTrack {
    times_secs: Vec<f64>,
    /// One value of each column for every time; finite.
    pub(super) columns: Vec<Vec<f64>>,
}

impl SlowTrack {
    /// Rows of a table whose time ascends and whose values are all finite; `None` if there are fewer than two.
    pub(super) fn new(table: &QuantityTable) -> Option<Self> {
        let mut rows: Vec<usize> = Vec::new();
        for (row, time) in table.times_secs.iter().enumerate() {
            let is_later = rows.last().is_none_or(|last| *time > table.times_secs[*last]);
            if time.is_finite() && is_later && table.columns.iter().all(|column| column[row].is_finite()) {
                rows.push(row);
            }
        }
        let picked = |column: &Vec<f64>| -> Vec<f64> { rows.iter().map(|row| column[*row]).collect() };
        (rows.len() >= 2).then(|| Self {
            times_secs: picked(&table.times_secs),
            columns: table.columns.iter().map(picked).collect(),
        })
    }

    /// First and last time, in seconds.
    pub(super) fn span_secs(&self) -> [f64; 2] {
        [self.times_secs[0], self.times_secs[self.times_secs.len() - 1]]
    }

    /// Columns at these times (s) by linear interpolation; NaN in gaps and at times that are not finite.
    pub(super) fn at(&self, times_secs: &[f64]) -> Vec<Vec<f64>> {
        let most_secs = GAP_STEPS * self.step_secs();
        let places: Vec<Option<(usize, f64)>> = times_secs
            .iter()
            .map(|time| {
                let after =
                    self.times_secs.partition_point(|t| t <= time).clamp(1, self.times_secs.len() - 1);
                let (from, to) = (self.times_secs[after - 1], self.times_secs[after]);
                let share = (time - from) / (to - from);
                (to - from <= most_secs && share.is_finite()).then_some((after, share))
            })
            .collect();
        let value = |column: &[f64], place: &Option<(usize, f64)>| {
            place.map_or(f64::NAN, |(after, share)| {
                column[after - 1] + share * (column[after] - column[after - 1])
            })
        };
        self.columns.iter().map(|column| places.iter().map(|place| value(column, place)).collect()).collect()
    }

    /// Direction of the motion in rad, 0 to 2π, if the columns are the positions x and y. A path there and back has the
    /// direction of its axis, 0 to π. `None` unless the path is straight.
    pub(super) fn direction_rad(&self) -> Option<f64> {
        let [x, y] = &self.columns[..] else { return None };
        let lag = ((LAG_SECS / self.step_secs()).ceil() as usize).clamp(1, x.len() - 1);
        let moves: Vec<[f64; 2]> =
            (lag..x.len()).map(|row| [x[row] - x[row - lag], y[row] - y[row - lag]]).collect();
        // Opposite moves have the same square as complex numbers.
        let (mut re, mut im, mut total) = (0.0, 0.0, 0.0);
        for [dx, dy] in &moves {
            re += dx * dx - dy * dy;
            im += 2.0 * dx * dy;
            total += dx * dx + dy * dy;
        }
        let axis_rad = 0.5 * im.atan2(re);
        let (sin, cos) = axis_rad.sin_cos();
        let along: Vec<f64> = moves.iter().map(|[dx, dy]| dx * cos + dy * sin).collect();
        let net: f64 = along.iter().sum();
        let path: f64 = along.iter().map(|d| d.abs()).sum();
        let direction_rad = if net.abs() < ONE_WAY_SHARE * path {
            axis_rad.rem_euclid(PI)
        } else if net > 0.0 {
            axis_rad.rem_euclid(TAU)
        } else {
            (axis_rad + PI).rem_euclid(TAU)
        };
        (re.hypot(im) >= MIN_STRAIGHT * total && total > 0.0).then_some(direction_rad)
    }

    /// Median time between two rows, in seconds.
    fn step_secs(&self) -> f64 {
        median(self.times_secs.windows(2).map(|pair| pair[1] - pair[0]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{QuantityTable, SlowTrack};
    use std::f64::consts::PI;

    fn track(times_secs: Vec<f64>, columns: Vec<Vec<f64>>) -> Option<SlowTrack> {
        SlowTrack::new(&QuantityTable { times_secs, columns, warnings: Vec::new() })
    }

    #[test]
    fn values_are_interpolated_and_gaps_stay_empty() {
        // Row 2 goes back in time, row 4 has no value.
        let times = vec![0.0, 0.01, 0.005, 0.02, 0.03, 0.04, 0.2, 0.21];
        let values = vec![0.0, 1.0, 9.0, 2.0, f64::NAN, 4.0, 5.0, 6.0];
        let slow = track(times, vec![values]).unwrap();
        assert_eq!(slow.span_secs(), [0.0, 0.21]);
        let at = &slow.at(&[0.0, 0.015, 0.03, 0.1, 0.205, f64::NAN])[0];
        for (value, expected) in at.iter().zip([0.0, 1.5, 3.0, f64::NAN, 5.5, f64::NAN]) {
            let is_same = (value - expected).abs() < 1e-9 || (value.is_nan() && expected.is_nan());
            assert!(is_same, "{at:?}");
        }
        assert!(track(vec![1.0, 1.0], vec![vec![0.0, 0.0]]).is_none(), "one time is no track");
    }

    #[test]
    fn a_straight_path_has_a_direction_and_others_have_none() {
        let path = |place: &dyn Fn(f64) -> [f64; 2]| {
            let times: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i)).collect();
            let (x, y) = times.iter().map(|t| place(*t)).map(|[x, y]| (x, y)).unzip();
            track(times, vec![x, y]).unwrap().direction_rad().map(f64::to_degrees)
        };
        for degrees in [0.0_f64, 45.0, 130.0, 200.0, 315.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            // The tip rests at first, and the sensor has some noise.
            let place = |t: f64| {
                let d = 0.02 * (t - 0.3).max(0.0);
                [d * cos + 1e-5 * (97.0 * t).sin(), d * sin + 1e-5 * (71.0 * t).cos()]
            };
            let found = path(&place).unwrap();
            let off = (found - degrees).to_radians().sin().abs();
            assert!(off < 0.02 && (found - degrees).to_radians().cos() > 0.0, "{found}, expected {degrees}");
            let back = |t: f64| [0.01 * (PI * t).cos() * cos, 0.01 * (PI * t).cos() * sin];
            let axis = path(&back).unwrap();
            assert!((axis - degrees).to_radians().sin().abs() < 1e-6 && axis < 180.0, "{axis}");
        }
        assert_eq!(path(&|t| [0.01 * (PI * t).cos(), 0.01 * (PI * t).sin()]), None);
        assert_eq!(path(&|_| [1.0, 1.0]), None);
        assert!(track(vec![0.0, 0.01, 0.02], vec![vec![0.0, 1.0, 2.0]]).unwrap().direction_rad().is_none());
    }
}
