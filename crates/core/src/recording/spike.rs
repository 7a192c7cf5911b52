//! Glitches of the electronics: a few rows far above everything around them, that no tip can have felt.
//!
//! What a tip feels rings: a tap or a bump sets the tool swinging, and that takes milliseconds to die away. A glitch is one
//! to three rows wide, and its neighbors are as if it had not been. Where such events are many, or where there are as
//! steadily more of them the smaller they are, they are what the surface is like, and nothing is left out.

use crate::recording::Finding;
use crate::recording::clock::{Count, Timeline};
use crate::recording::dropout::Axis;
use crate::recording::missing::ACCELERATION;
use crate::spectrum::median;

/// Least height of a glitch, in robust standard deviations of what is around it.
const HEIGHT: f64 = 20.0;
/// Below this rate in Hz a tap may be as narrow as a glitch.
const LEAST_RATE_HZ: f64 = 900.0;
/// Most rows of a glitch.
const WIDTH_ROWS: usize = 3;
/// What is around a glitch stays below so many robust standard deviations, or below this share of its height: noise does
/// by chance, and a tip that swings with a time constant of a millisecond does not, not even at 1 kHz.
const CALM_HEIGHT: f64 = 4.0;
const CALM_SHARE: f64 = 0.1;
/// The root mean square behind it stays below half of that: a ring that is lost in the noise peak by peak is not lost there.
const CALM_RMS: f64 = 0.5;
/// How far around it is looked, in seconds and at least in rows.
const CALM_SECS: f64 = 0.002;
const CALM_ROWS: usize = 5;
/// What the level is worked out over: a block and one on either side, so that an onset is no glitch.
const BLOCK_SECS: f64 = 0.05;
const BLOCK_ROWS: usize = 32;
/// Robust standard deviation of normal noise, over the median of its magnitude.
const DEVIATION_PER_MEDIAN: f64 = 1.4826;
/// Least height that counts among the smaller ones, and where these end and begin below a glitch, as shares of its height.
const SMALLER_HEIGHT: f64 = 6.0;
const SMALLER_TO: f64 = 1.0 / 1.5;
const SMALLER_FROM: f64 = 0.1;
/// Most of those for each glitch. Of a power law of heights with exponent n there are `10^n - 1.5^n`: 23 at the exponent
/// of 1.4, and chance leaves the highest of it alone in a share `10^-n` of recordings.
const SMALLER_SHARE: f64 = 1.0 / 3.0;
/// Most glitches a second within so many seconds, before they are a texture: bumps of gratings come faster, and slower ones
/// are wider than [`WIDTH_ROWS`].
const NEAR: [(f64, f64); 2] = [(0.25, 10.0), (2.0, 4.0)];
/// As many may always be near each other.
const FEW: usize = 3;

/// Something sharp, as places in the timeline.
struct Event {
    start: usize,
    end: usize,
    peak: usize,
    /// Over the robust standard deviation around it.
    height: f64,
    /// Whether it is calm for [`CALM_SECS`] on either side.
    is_alone: bool,
}

/// Marks rows of glitches as unusable and says so; gives, by place, which they are. Places where `axis` has no number are
/// passed over.
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

/// A column by place, with the level around each.
struct Signal<'a> {
    timeline: &'a Timeline,
    /// NaN where there is no number.
    values: Vec<f64>,
    block_rows: usize,
    /// Median of each block, and the robust standard deviation of the widest of it and its neighbors.
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
        // What a converter cannot tell apart is no level; `max` passes blocks without numbers over.
        let widest = |block: usize| {
            let around = &blocks[block.saturating_sub(1)..(block + 2).min(blocks.len())];
            around.iter().fold(step, |most, (_, deviation)| most.max(*deviation))
        };
        let levels = (0..blocks.len()).map(|block| (blocks[block].0, widest(block))).collect();
        Self { timeline, values, block_rows, levels }
    }

    /// How far a place is from the middle of its block; NaN where there is no number.
    fn off(&self, place: usize) -> f64 {
        (self.values[place] - self.levels[place / self.block_rows].0).abs()
    }

    fn deviation(&self, place: usize) -> f64 {
        self.levels[place / self.block_rows].1
    }

    /// Whether a place follows the one before it without a gap.
    fn follows(&self, place: usize) -> bool {
        let times = &self.timeline.times;
        place > 0 && times[place] - times[place - 1] <= self.timeline.gap_secs
    }

    /// Everything sharp from [`SMALLER_HEIGHT`] up, in order.
    fn events(&self) -> Vec<Event> {
        let is_high = |place: &usize| self.off(*place) > SMALLER_HEIGHT * self.deviation(*place);
        (0..self.values.len()).filter(is_high).filter_map(|place| self.event(place)).collect()
    }

    /// The sharp event with its peak here, if there is one.
    fn event(&self, peak: usize) -> Option<Event> {
        let (off, deviation) = (self.off(peak), self.deviation(peak));
        let calm = (CALM_HEIGHT * deviation).max(CALM_SHARE * off);
        let (mut start, mut end) = (peak, peak + 1);
        while start > 0 && self.follows(start) && self.off(start - 1) > calm {
            start -= 1;
            // The first of equal ones is the peak.
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
        // Between two gaps there is too little to be far above.
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

    /// How many places on one side are calm, up to `most`; nothing where a gap or an end comes first. Beside each of
    /// `places` stands the later one of it and the one before it.
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

/// Which of the events are glitches.
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
    // The lowest height that stands apart from the smaller ones; what is higher does all the more.
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
