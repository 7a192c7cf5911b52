//! Rotations of periodic maps by quarter turns, which are exact, and any other rotation as a mixture of two of them.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Distance from a quarter turn, in quarter turns, up to which a rotation is replaced by it alone.
const ALONE: f64 = 1.0 / 3.0;

/// A square periodic array, stored row by row with x along a row and y upward, rotated by a number of quarter turns around its
/// first value, counterclockwise.
pub(super) fn quarter_turned<T: Copy>(values: &[T], quarter: u8) -> Vec<T> {
    let n = values.len().isqrt();
    let opposite = |i: usize| if i == 0 { 0 } else { n - i };
    let source = |x: usize, y: usize| match quarter % 4 {
        0 => (x, y),
        1 => (y, opposite(x)),
        2 => (opposite(x), opposite(y)),
        _ => (opposite(y), x),
    };
    let at = |y: usize| {
        (0..n).map(move |x| {
            let (x, y) = source(x, y);
            values[y * n + x]
        })
    };
    (0..n).flat_map(at).collect()
}

/// Numbers of quarter turns, with their gains, that replace a rotation in rad, counterclockwise: the nearest one, or, more than
/// [`ALONE`] away from it, the nearest two. The gains are continuous in the rotation, and their squares sum to one.
pub(super) fn quarter_turns(turn_rad: f64) -> [(u8, f64); 2] {
    let turns = turn_rad / FRAC_PI_2;
    let nearest = turns.round();
    let apart = turns - nearest;
    let share = ((apart.abs() - ALONE) / (0.5 - ALONE)).clamp(0.0, 1.0);
    let (sin, cos) = (FRAC_PI_4 * share).sin_cos();
    let quarter = |turns: f64| turns.rem_euclid(4.0) as u8;
    [(quarter(nearest), cos), (quarter(nearest + apart.signum()), sin)]
}

#[cfg(test)]
mod tests {
    use super::{quarter_turned, quarter_turns};

    #[test]
    fn a_quarter_turn_brings_the_x_axis_to_the_y_axis() {
        // Values along the x axis, and along the y axis after a quarter turn.
        let mut along_x = [0; 16];
        along_x[..4].copy_from_slice(&[9, 1, 2, 3]);
        let turned = quarter_turned(&along_x, 1);
        let column = |values: &[i32], x: usize| [0, 1, 2, 3].map(|y| values[4 * y + x]);
        assert_eq!(column(&turned, 0), [9, 1, 2, 3]);
        assert!(turned.iter().sum::<i32>() == 15);
        assert_eq!(quarter_turned(&along_x, 2)[..4], [9, 3, 2, 1]);
        assert_eq!(column(&quarter_turned(&along_x, 3), 0), [9, 3, 2, 1]);
    }

    #[test]
    fn quarter_turns_add_up() {
        let values: Vec<u32> = (0..64).collect();
        assert_eq!(quarter_turned(&values, 0), values);
        for quarter in 0..4 {
            let next = quarter_turned(&quarter_turned(&values, quarter), 1);
            assert_eq!(next, quarter_turned(&values, quarter + 1), "after {quarter}");
        }
    }

    #[test]
    fn rotations_are_continuous_mixtures_of_quarter_turns() {
        for (degrees, expected) in
            [(0.0, 0), (20.0, 0), (-29.0, 0), (100.0, 1), (180.0, 2), (-90.0, 3), (270.0, 3)]
        {
            let [(quarter, gain), (_, other)] = quarter_turns(f64::to_radians(degrees));
            assert_eq!((quarter, other), (expected, 0.0), "{degrees}°");
            assert!((gain - 1.0).abs() < 1e-15);
        }
        let gains = |degrees: f64| {
            let mut gains = [0.0; 4];
            for (quarter, gain) in quarter_turns(degrees.to_radians()) {
                gains[usize::from(quarter)] += gain;
            }
            gains
        };
        let half = gains(45.0);
        assert!((half[0] - half[1]).abs() < 1e-9 && (half[0] * half[0] - 0.5).abs() < 1e-9, "{half:?}");
        for i in -7200..7200 {
            let (before, after) = (gains(0.05 * f64::from(i)), gains(0.05 * f64::from(i + 1)));
            assert!((after.iter().map(|gain| gain * gain).sum::<f64>() - 1.0).abs() < 1e-12);
            // A gain changes by at most a quarter turn in 15°.
            assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() < 0.006), "at {i}");
        }
    }
}
