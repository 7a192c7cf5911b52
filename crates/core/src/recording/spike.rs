//! Detection of spikes (electrical glitches): a few rows far above their surroundings, which cannot be mechanical.
//!
//! Mechanical events ring: a tap or a bump makes the tool oscillate, and the oscillation takes milliseconds to decay. A
//! spike is one to three rows wide, and does not affect its neighbors. If such events are frequent, or if the number of
//! events grows steadily towards smaller heights, they belong to the surface, and nothing is left out.

use crate::dsp::spectrum::median;
use crate::recording::Finding;
use crate::recording::axis::Axis;
use crate::recording::bounds::ACCELERATION;
use crate::recording::clock::{Count, Timeline};

/// Minimum height of a spike, in robust standard deviations of its surroundings.
const HEIGHT: f64 = 20.0;
/// Sample rate in Hz below which a tap can be as narrow as a spike.
const LEAST_RATE_HZ: f64 = 900.0;
/// Maximum width of a spike, in rows.
const WIDTH_ROWS: usize = 3;
/// Calm limit of the surroundings: robust standard deviations, or a fraction of the spike's height if that is larger.
/// Noise stays below it by chance. A ringing tip with a time constant of one millisecond does not, not even at 1 kHz.
const CALM_HEIGHT: f64 = 4.0;
const CALM_SHARE: f64 = 0.1;
/// Maximum root mean square after a spike, relative to the calm limit; it reveals ringing whose peaks are hidden in
/// noise.
const CALM_RMS: f64 = 0.5;
/// Range around a spike that must be calm, in seconds and at least in rows.
const CALM_SECS: f64 = 0.002;
const CALM_ROWS: usize = 5;
/// Block length for the local level; a block and both neighbors are used, so that an onset is not a spike.
const BLOCK_SECS: f64 = 0.05;
const BLOCK_ROWS: usize = 32;
/// Ratio of the robust standard deviation of normal noise to the median of its magnitude.
const DEVIATION_PER_MEDIAN: f64 = 1.4826;
/// Minimum height of smaller events, and the range of heights below a spike in which they are counted, as fractions of
/// its height.
const SMALLER_HEIGHT: f64 = 6.0;
const SMALLER_TO: f64 = 1.0 / 1.5;
const SMALLER_FROM: f64 = 0.1;
/// Maximum number of smaller events for each spike. For a power law of heights with exponent n, the number is
/// `10^n - 1.5^n`: 23 for the exponent 1.4. By chance, the highest event of this law stands alone in a share `10^-n` of
/// recordings.
const SMALLER_SHARE: f64 = 1.0 / 3.0;
/// Pairs of time range in seconds and maximum number of spikes per second within it; above, they are a texture. Bumps
/// of gratings are more frequent, and slower ones are wider than [`WIDTH_ROWS`].
const NEAR: [(f64, f64); 2] = [(0.25, 10.0), (2.0, 4.0)];
/// Number of neighboring spikes that is always allowed.
const FEW: usize = 3;

/// Narrow event, as indices into the timeline.
struct Event {
    start: usize,
    end: usize,
    peak: usize,
    /// Height in robust standard deviations of the surroundings.
    height: f64,
    /// Whether both sides are calm for [`CALM_SECS`].
    is_alone: bool,
}

/// Marks rows of spikes as unusable and reports them. Returns a flag for each place of the timeline. Places where
/// `axis` has no number are skipped.
pub(super) fn mark_spikes(
    axis: &Axis<'_>,
    timeline: &Timeline,
    step: f64,
    usable: &mut [bool],
    findings: &mut Vec<Finding>,
) -> Vec<bool> {
    let mut is_spike = vec![false; timeline.rows.len()];
    if timeline.rate_hz < LEAST_RATE_HZ {
        return is_spike;
    }
    let signal = Signal::new(axis.values, timeline, step);
    let events = signal.events();
    let spikes = spikes(&events, timeline);
    let mut count = Count::default();
    let (mut value, mut times) = (0.0_f64, 0.0_f64);
    for event in &spikes {
        is_spike[event.start..event.end].fill(true);
        usable[event.start..event.end].fill(false);
        timeline.times[event.start..event.end].iter().for_each(|time| count.add(*time));
        let peak = signal.values[event.peak];
        if peak.abs() > value.abs() {
            (value, times) = (peak, event.height);
        }
    }
    findings.extend(count.found(axis.values.len()).map(|at| Finding::Spikes {
        column: axis.column.to_owned(),
        n: spikes.len(),
        at,
        value,
        times,
    }));
    is_spike
}

/// Column by place in the timeline, with the level around each place.
struct Signal<'a> {
    timeline: &'a Timeline,
    /// NaN for missing values.
    values: Vec<f64>,
    block_rows: usize,
    /// Median of each block, and the largest robust standard deviation of the block and its neighbors.
    levels: Vec<(f64, f64)>,
}

impl<'a> Signal<'a> {
    fn new(values: &[f64], timeline: &'a Timeline, step: f64) -> Self {
        let is_number = |value: f64| value.abs() <= ACCELERATION.most;
        let at = |row: &usize| if is_number(values[*row]) { values[*row] } else { f64::NAN };
        let values: Vec<f64> = timeline.rows.iter().map(at).collect();
        let block_rows = ((BLOCK_SECS * timeline.rate_hz) as usize).max(BLOCK_ROWS);
        let blocks: Vec<(f64, f64)> = values
            .chunks(block_rows)
            .map(|block| {
                let numbers: Vec<f64> = block.iter().copied().filter(|value| !value.is_nan()).collect();
                let middle = median(numbers.clone());
                let off = numbers.iter().map(|value| (value - middle).abs()).collect();
                (middle, DEVIATION_PER_MEDIAN * median(off))
            })
            .collect();
        // The converter step is the lower limit of the level; `max` ignores blocks without numbers.
        let widest = |block: usize| {
            let around = &blocks[block.saturating_sub(1)..(block + 2).min(blocks.len())];
            around.iter().fold(step, |most, (_, deviation)| most.max(*deviation))
        };
        let levels = (0..blocks.len()).map(|block| (blocks[block].0, widest(block))).collect();
        Self { timeline, values, block_rows, levels }
    }

    /// Distance of a value from the median of its block; NaN for missing values.
    fn off(&self, place: usize) -> f64 {
        (self.values[place] - self.levels[place / self.block_rows].0).abs()
    }

    fn deviation(&self, place: usize) -> f64 {
        self.levels[place / self.block_rows].1
    }

    /// Whether a place follows the previous one without a gap.
    fn follows(&self, place: usize) -> bool {
        let times = &self.timeline.times;
        place > 0 && times[place] - times[place - 1] <= self.timeline.gap_secs
    }

    /// All narrow events of at least [`SMALLER_HEIGHT`], in order.
    fn events(&self) -> Vec<Event> {
        let is_high = |place: &usize| self.off(*place) > SMALLER_HEIGHT * self.deviation(*place);
        (0..self.values.len()).filter(is_high).filter_map(|place| self.event(place)).collect()
    }

    /// Narrow event with its peak at this place, if there is one.
    fn event(&self, peak: usize) -> Option<Event> {
        let (off, deviation) = (self.off(peak), self.deviation(peak));
        let calm = (CALM_HEIGHT * deviation).max(CALM_SHARE * off);
        let (mut start, mut end) = (peak, peak + 1);
        while start > 0 && self.follows(start) && self.off(start - 1) > calm {
            start -= 1;
            // Of equal values, the first is the peak.
            if peak - start >= WIDTH_ROWS || self.off(start) >= off {
                return None;
            }
        }
        while end < self.values.len() && self.follows(end) && self.off(end) > calm {
            if end - start >= WIDTH_ROWS || self.off(end) > off {
                return None;
            }
            end += 1;
        }
        let n_alone = ((CALM_SECS * self.timeline.rate_hz).ceil() as usize).max(CALM_ROWS);
        let before = (0..start).rev().map(|place| (place, place + 1));
        let after = (end..self.values.len()).map(|place| (place, place));
        let sides = [self.n_calm(before, n_alone, calm), self.n_calm(after, n_alone, calm)];
        // Between two gaps there is too little signal for comparison.
        if sides == [None, None] || sides.iter().flatten().any(|n| *n < CALM_ROWS) {
            return None;
        }
        let behind = end..(end + n_alone).min(self.values.len());
        let squares: Vec<f64> =
            behind.map(|place| self.off(place).powi(2)).filter(|square| !square.is_nan()).collect();
        let rings = squares.iter().sum::<f64>() > (CALM_RMS * calm).powi(2) * squares.len() as f64;
        let is_alone = !rings && sides.iter().flatten().all(|n| *n == n_alone);
        Some(Event { start, end, peak, height: off / deviation, is_alone })
    }

    /// Number of calm places on one side, up to `most`; `None` if a gap or the end of the recording comes first. Each
    /// item of `places` is a place and the later one of it and its predecessor.
    fn n_calm(&self, places: impl Iterator<Item = (usize, usize)>, most: usize, calm: f64) -> Option<usize> {
        let mut n = 0;
        for (place, later) in places.take(most) {
            if !self.follows(later) {
                return None;
            }
            if self.off(place) > calm {
                return Some(n);
            }
            n += 1;
        }
        (n == most).then_some(n)
    }
}

/// Selects the events that are spikes.
fn spikes<'a>(events: &'a [Event], timeline: &Timeline) -> Vec<&'a Event> {
    let mut high: Vec<&Event> = events.iter().filter(|e| e.is_alone && e.height >= HEIGHT).collect();
    let times: Vec<f64> = high.iter().map(|event| timeline.times[event.peak]).collect();
    let last_secs = timeline.times.last().copied().unwrap_or(0.0);
    let is_rare = |time: f64| {
        NEAR.iter().all(|(reach_secs, most_per_sec)| {
            let (from, to) = (time - reach_secs, time + reach_secs);
            let n = times.partition_point(|t| *t <= to) - times.partition_point(|t| *t < from);
            let covered_secs = to.min(last_secs) - from.max(0.0);
            n <= FEW || n as f64 <= most_per_sec * covered_secs
        })
    };
    let mut heights: Vec<f64> = events.iter().map(|event| event.height).collect();
    heights.sort_by(f64::total_cmp);
    let below = |height: f64| heights.partition_point(|h| *h < height);
    let mut tops: Vec<f64> = high.iter().map(|event| event.height).collect();
    tops.sort_by(f64::total_cmp);
    // Lowest height that is separated from the smaller events; higher events are separated even more.
    let least = tops.iter().enumerate().find(|(i, height)| {
        let n_smaller = below(SMALLER_TO * **height) - below(SMALLER_FROM * **height);
        n_smaller as f64 <= SMALLER_SHARE * (tops.len() - i) as f64
    });
    let Some((_, least)) = least else { return Vec::new() };
    high.retain(|event| event.height >= *least && is_rare(timeline.times[event.peak]));
    high
}

#[cfg(test)]
mod tests;
