//! A quantity over time, between points.

use crate::signals::haptic_envelope::EnvelopeError;

/// How a curve goes from one point to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// The value changes linearly.
    Linear,
    /// The root of the value changes linearly. Players that treat the given numbers as roots, such as those of AHAP patterns,
    /// interpolate so.
    Squared,
}

/// A quantity over time: `low + (high − low) · x`, or `low + (high − low) · x²`, with `x` interpolated linearly between points.
/// Before the first and after the last point, it has the value of that point.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Times in seconds, ascending, and `x` of each.
    points: Vec<[f64; 2]>,
    law: Law,
    low: f64,
    high: f64,
}

impl Curve {
    /// Curve through points of a time in seconds and an `x`. Two points at the same time are a step. `range` has the values at
    /// `x = 0` and `x = 1`.
    ///
    /// # Errors
    /// [`EnvelopeError::NoPoints`], [`EnvelopeError::Time`], or [`EnvelopeError::Value`] for an `x` or a range that is not
    /// finite.
    pub fn new(points: Vec<[f64; 2]>, law: Law, range: [f64; 2]) -> Result<Self, EnvelopeError> {
        let mut before_secs = 0.0;
        for (index, [secs, x]) in points.iter().enumerate() {
            if !(secs.is_finite() && *secs >= before_secs) {
                return Err(EnvelopeError::Time { index, secs: *secs });
            }
            before_secs = *secs;
            check_finite(*x)?;
        }
        range.into_iter().try_for_each(check_finite)?;
        if points.is_empty() {
            return Err(EnvelopeError::NoPoints);
        }
        let [low, high] = range;
        Ok(Self { points, law, low, high })
    }

    /// Value at a time in seconds. Cost: a search among the points.
    pub fn at(&self, secs: f64) -> f64 {
        let next = self.points.partition_point(|[time, _]| *time <= secs);
        self.between(next, secs)
    }

    /// Times of the points in seconds, ascending.
    pub fn times_secs(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|[secs, _]| *secs)
    }

    /// Time of the first point in seconds.
    pub(super) fn start_secs(&self) -> f64 {
        self.points.first().map_or(0.0, |[secs, _]| *secs)
    }

    /// Time of the last point in seconds.
    pub(super) fn end_secs(&self) -> f64 {
        self.points.last().map_or(0.0, |[secs, _]| *secs)
    }

    /// Lowest and highest value at the points. Between points a curve is monotonic where `x` does not change its sign.
    pub(super) fn extremes(&self) -> [f64; 2] {
        let values = self.points.iter().map(|[_, x]| self.value(*x));
        values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    }

    /// Reader of the curve at times that do not decrease.
    pub(super) fn cursor(&self) -> Cursor<'_> {
        Cursor { curve: self, next: 0 }
    }

    fn value(&self, x: f64) -> f64 {
        let shaped = match self.law {
            Law::Linear => x,
            Law::Squared => x * x,
        };
        self.low + (self.high - self.low) * shaped
    }

    /// Value at a time, of which `next` is the first later point.
    fn between(&self, next: usize, secs: f64) -> f64 {
        let before = next.checked_sub(1).and_then(|before| self.points.get(before));
        let x = match (before, self.points.get(next)) {
            (Some([from_secs, from]), Some([to_secs, to])) => {
                from + (secs - from_secs) / (to_secs - from_secs) * (to - from)
            }
            (Some([_, x]), None) | (None, Some([_, x])) => *x,
            (None, None) => 0.0,
        };
        self.value(x)
    }
}

fn check_finite(value: f64) -> Result<(), EnvelopeError> {
    if value.is_finite() {
        return Ok(());
    }
    let (low, high) = (f64::MIN, f64::MAX);
    Err(EnvelopeError::Value { what: "a value of an envelope", value, low, high })
}

/// Reads a curve at times that do not decrease, at constant cost.
pub(super) struct Cursor<'a> {
    curve: &'a Curve,
    /// Index of the first point after the last time.
    next: usize,
}

impl Cursor<'_> {
    pub(super) fn at(&mut self, secs: f64) -> f64 {
        while self.curve.points.get(self.next).is_some_and(|[time, _]| *time <= secs) {
            self.next += 1;
        }
        self.curve.between(self.next, secs)
    }
}
