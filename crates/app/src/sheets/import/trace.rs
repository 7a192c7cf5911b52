//! Recording reduced for drawing: the range of each interval, so that the cost does not depend on its length.

use shagreen_core::recording::Recording;

/// Maximum number of intervals of a drawn recording.
pub(super) const N_STRETCHES: usize = 600;

/// Recording reduced for drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Duration in seconds.
    pub seconds: f64,
    /// Center of each interval in seconds, lowest and highest acceleration in m/s².
    pub acceleration: Vec<[f64; 3]>,
    /// Center of each interval in seconds, mean speed in mm/s.
    pub speed_mm_per_s: Vec<[f64; 2]>,
    /// Center of each interval in seconds, mean force in N.
    pub force_n: Vec<[f64; 2]>,
    /// Excluded ranges, begin and end in seconds. Ranges less than an interval apart are merged.
    pub excluded: Vec<[f64; 2]>,
}

impl Trace {
    /// Reduces a recording to at most [`N_STRETCHES`] intervals. Samples that are not finite are left out.
    pub fn new(recording: &Recording) -> Self {
        let n = recording.acceleration_mps2.len();
        let length = n.div_ceil(N_STRETCHES).max(1);
        let time_secs = |i: usize, len: usize| {
            (i * length) as f64 / recording.rate.0 + 0.5 * len as f64 / recording.rate.0
        };
        let acceleration = recording.acceleration_mps2.chunks(length).enumerate().filter_map(|(i, part)| {
            let known = || part.iter().copied().filter(|a| a.is_finite());
            let (low, high) = (known().reduce(f64::min)?, known().reduce(f64::max)?);
            Some([time_secs(i, part.len()), low, high])
        });
        let means = |values: &[f64], scale: f64| -> Vec<[f64; 2]> {
            let mean = |(i, part): (usize, &[f64])| {
                let known = || part.iter().filter(|v| v.is_finite());
                let n_known = known().count();
                (n_known > 0)
                    .then(|| [time_secs(i, part.len()), scale * known().sum::<f64>() / n_known as f64])
            };
            values.chunks(length).enumerate().filter_map(mean).collect()
        };
        Self {
            seconds: recording.seconds(),
            acceleration: acceleration.collect(),
            speed_mm_per_s: means(&recording.speed_mps, 1e3),
            force_n: means(&recording.force_n, 1.0),
            excluded: excluded(recording, length),
        }
    }
}

/// Ranges between the usable ones, in seconds.
fn excluded(recording: &Recording, length: usize) -> Vec<[f64; 2]> {
    let n = recording.acceleration_mps2.len();
    let begins = std::iter::once(0).chain(recording.usable.iter().map(|r| r.end));
    let ends = recording.usable.iter().map(|r| r.start).chain(std::iter::once(n));
    let mut out: Vec<[usize; 2]> = Vec::new();
    for (begin, end) in begins.zip(ends).filter(|(begin, end)| begin < end) {
        match out.last_mut() {
            Some(last) if begin < last[1] + length => last[1] = end,
            _ => out.push([begin, end]),
        }
    }
    out.into_iter().map(|range| range.map(|i| i as f64 / recording.rate.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::{N_STRETCHES, Trace};
    use shagreen_core::recording::Recording;
    use shagreen_core::units::Hertz;

    fn recording(n: usize, usable: Vec<std::ops::Range<usize>>) -> Recording {
        Recording {
            rate: Hertz(1000.0),
            acceleration_mps2: (0..n).map(|i| if i % 2 == 0 { 1.0 } else { -(i as f64) }).collect(),
            speed_mps: vec![0.1; n],
            force_n: vec![2.0; n],
            usable,
        }
    }

    #[test]
    fn no_peak_is_lost_and_no_more_is_drawn_than_can_be_seen() {
        for n in [10, N_STRETCHES, 100_003] {
            let trace = Trace::new(&recording(n, std::iter::once(0..n).collect()));
            assert!(trace.acceleration.len() <= N_STRETCHES);
            let low = trace.acceleration.iter().map(|a| a[1]).fold(0.0, f64::min);
            let last_odd = if n % 2 == 0 { n - 1 } else { n - 2 };
            assert_eq!(low, -(last_odd as f64));
            assert!(trace.acceleration.iter().all(|a| a[0] > 0.0 && a[0] < trace.seconds && a[1] <= a[2]));
            assert!(trace.speed_mm_per_s.iter().all(|s| (s[1] - 100.0).abs() < 1e-9));
            assert!(trace.excluded.is_empty());
        }
    }

    #[test]
    fn what_is_not_usable_is_excluded_and_what_is_no_number_is_not_drawn() {
        let mut holed = recording(1000, vec![100..400, 600..1000]);
        holed.acceleration_mps2[400..600].fill(f64::NAN);
        let trace = Trace::new(&holed);
        assert_eq!(trace.excluded, [[0.0, 0.1], [0.4, 0.6]]);
        assert!(trace.acceleration.iter().all(|a| a.iter().all(|v| v.is_finite())));
        assert_eq!(Trace::new(&recording(1000, vec![])).excluded, [[0.0, 1.0]]);
    }
}
