//! Plausibility rules that infer units from the numbers themselves.

use shagreen_core::dsp::spectrum::median;
use shagreen_core::recording::{MAX_RATE_HZ, MIN_RATE_HZ};

use crate::recording::units::{AccelerationUnit, ForceUnit, TimeUnit};

/// Plausible sample rates in Hz, if only the unit of time is unknown.
const LIKELY_RATES_HZ: [f64; 2] = [20.0, 48_500.0];
/// Relative deviation of the mean vector from gravity below which it reveals the unit of acceleration.
const GRAVITY_SHARE: f64 = 0.06;
/// Largest standard deviation of the acceleration relative to its mean vector for that test.
const MOVING_SHARE: f64 = 0.5;

/// Force in N below which a tip is not in contact.
const TOUCH_N: f64 = 0.02;
/// Fraction of the largest magnitude that counts as clearly nonzero, and fraction of the samples that counts as a
/// substantial part.
const ALTERNATING_SHARE: f64 = 0.1;

/// Largest magnitude of the finite numbers.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()))
}

pub(super) fn median_of(values: &[f64]) -> f64 {
    median(values.iter().copied().filter(|value| value.is_finite()).collect())
}

/// Returns whether a column strictly increases.
pub(super) fn goes_on(values: &[f64]) -> bool {
    values.len() > 2 && values.windows(2).all(|pair| pair[1] > pair[0])
}

/// Returns the only unit of time that gives a plausible sample rate, with the reason; `None` if there are several.
pub(super) fn likely_time_unit(times: &[f64]) -> Option<(TimeUnit, String)> {
    let first = times.iter().copied().find(|time| time.is_finite())?;
    // Unix times of the years 2001 to 2065, in seconds.
    let epoch = TimeUnit::ALL.iter().find(|unit| (1e9..3e9).contains(&(first * unit.si())));
    if let Some(unit) = epoch {
        return Some((*unit, format!("{first} is a Unix time in {}", unit.name())));
    }
    let step = middle_step(times);
    let [low, high] = LIKELY_RATES_HZ;
    let rate_hz = |unit: &TimeUnit| 1.0 / (step * unit.si());
    let mut units = TimeUnit::ALL.iter().filter(|unit| (low..high).contains(&rate_hz(unit)));
    let unit = *units.next()?;
    if units.next().is_some() {
        return None;
    }
    Some((
        unit,
        format!("the median step is {step:.6}, which gives {:.1} Hz in {}", rate_hz(&unit), unit.name()),
    ))
}

/// Median positive step of times; NaN if there is none.
fn middle_step(times: &[f64]) -> f64 {
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    median(steps.filter(|step| *step > 0.0 && step.is_finite()).collect())
}

/// Sample rate in Hz of times whose unit is `si` seconds.
pub(super) fn rate_of(times: &[f64], si: f64) -> f64 {
    1.0 / (si * middle_step(times))
}

/// Returns a warning if the sample rate of times is implausible in this unit but plausible in another.
pub(super) fn other_time_unit(times: &[f64], unit: TimeUnit) -> Option<String> {
    let is_rate = |rate_hz: f64| (MIN_RATE_HZ..=MAX_RATE_HZ).contains(&rate_hz);
    let rate_hz = rate_of(times, unit.si());
    if rate_hz.is_nan() || is_rate(rate_hz) {
        return None;
    }
    let others = TimeUnit::ALL.iter().map(|other| (other, rate_of(times, other.si())));
    let others: Vec<String> = others
        .filter(|(_, rate_hz)| is_rate(*rate_hz))
        .map(|(other, rate_hz)| format!("{rate_hz:.1} Hz in {}", other.name()))
        .collect();
    let hint =
        format!("give {rate_hz:.1} Hz in {}, but {}; check the unit of time", unit.name(), others.join(", "));
    (!others.is_empty()).then_some(hint)
}

/// Returns whether force values can only be newtons: neither counts nor fractions of full scale, and too low for
/// contact in any other unit.
pub(super) fn is_newtons(values: &[f64]) -> bool {
    let most = largest(values);
    let is_counts = values.iter().all(|value| value.fract() == 0.0 || value.is_nan());
    let lighter = ForceUnit::ALL.iter().filter(|unit| **unit != ForceUnit::Newtons);
    most > 1.0 && !is_counts && lighter.into_iter().all(|unit| most * unit.si() < TOUCH_N)
}

/// Returns whether a force is clearly positive and clearly negative for a substantial part of the time each.
pub(super) fn alternates(values: &[f64]) -> bool {
    let least = ALTERNATING_SHARE * largest(values);
    let n_above = values.iter().filter(|value| **value > least).count();
    let n_below = values.iter().filter(|value| **value < -least).count();
    n_above.min(n_below) as f64 > ALTERNATING_SHARE * values.len() as f64
}

/// Returns the unit in which the mean vector of three axes has the length of gravity and the variation is small, with
/// that length.
pub(super) fn unit_by_gravity(axes: &[&[f64]], scale: f64) -> Option<(AccelerationUnit, f64)> {
    let [x, y, z] = axes else { return None };
    let moments = |axis: &[f64]| {
        let (n, sum, squares) = axis
            .iter()
            .filter(|value| value.is_finite())
            .fold((0.0, 0.0, 0.0), |(n, sum, squares), value| {
                (n + 1.0, sum + value * scale, squares + (value * scale).powi(2))
            });
        (sum / n, squares / n - (sum / n).powi(2))
    };
    let [x, y, z] = [moments(x), moments(y), moments(z)];
    let length = (x.0.powi(2) + y.0.powi(2) + z.0.powi(2)).sqrt();
    let moving = (x.1 + y.1 + z.1).max(0.0).sqrt();
    let gravity = AccelerationUnit::StandardGravity.si();
    let is_gravity = |unit: &&AccelerationUnit| (length * unit.si() / gravity - 1.0).abs() <= GRAVITY_SHARE;
    let unit = AccelerationUnit::ALL.iter().find(is_gravity)?;
    (moving <= MOVING_SHARE * length).then_some((*unit, length))
}
