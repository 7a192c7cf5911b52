//! The few points that a curve needs.

/// Largest number of points that one line replaces, which bounds the work for curves that stay near a line.
const MAX_RUN: usize = 4096;

/// Returns the indices of the points that curves keep, ascending: straight lines between them differ from every curve by at most
/// its tolerance, at all times. The first and the last point stay, and so do those of `kept`. Greedy: each line goes as far as
/// the tolerances allow.
///
/// `times_secs` ascend strictly. A curve has a value at each time; its tolerance is in the unit of its values.
///
/// # Panics
/// A curve has fewer values than there are times.
pub fn simplified(times_secs: &[f64], curves: &[(&[f64], f64)], kept: &[usize]) -> Vec<usize> {
    let Some(last) = times_secs.len().checked_sub(1) else { return Vec::new() };
    let mut ends: Vec<usize> = kept.iter().copied().filter(|point| (1..last).contains(point)).collect();
    ends.push(last);
    ends.sort_unstable();
    let mut indices = vec![0];
    let mut from = 0;
    for end in ends {
        while from < end {
            from = line_end(times_secs, curves, from, end);
            indices.push(from);
        }
    }
    indices
}

/// Farthest point up to `end` that a line from `from` may reach: it passes all points between within the tolerances.
fn line_end(times_secs: &[f64], curves: &[(&[f64], f64)], from: usize, end: usize) -> usize {
    // Lowest and highest slope that pass the points so far.
    let mut slopes = vec![[f64::NEG_INFINITY, f64::INFINITY]; curves.len()];
    let mut farthest = from + 1;
    for to in (from + 1..=end).take(MAX_RUN) {
        let secs = times_secs[to] - times_secs[from];
        let slope = |values: &[f64], shift: f64| (values[to] + shift - values[from]) / secs;
        let reaches = |((values, _), [low, high]): (&(&[f64], f64), &[f64; 2])| {
            (*low..=*high).contains(&slope(values, 0.0))
        };
        if curves.iter().zip(&slopes).all(reaches) {
            farthest = to;
        }
        for ((values, tolerance), [low, high]) in curves.iter().zip(&mut slopes) {
            *low = low.max(slope(values, -tolerance));
            *high = high.min(slope(values, *tolerance));
        }
        if slopes.iter().any(|[low, high]| low > high) {
            break;
        }
    }
    farthest
}
