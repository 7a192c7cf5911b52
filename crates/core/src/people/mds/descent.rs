//! Minimization of a function with a continuous gradient: L-BFGS (Nocedal 1980) whose first step is the SMACOF step and
//! whose value never increases.

use std::collections::VecDeque;

/// Value of a function at a point, with the quantities that a step from there needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evaluation {
    /// Function value.
    pub(super) value: f64,
    /// Factor that turns the gradient into the step of the Guttman transform, which is guaranteed to descend.
    pub(super) guttman: f64,
    /// Sum of squared distances between the points.
    pub(super) size: f64,
}

/// Stopping criteria.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Relative decrease of the square root of the value in one step.
    pub(super) tolerance: f64,
    /// Maximum number of steps.
    pub(super) max_steps: usize,
}

/// Final state of a descent.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// Function at the final point.
    pub(super) at: Evaluation,
    /// Whether the final point is stationary.
    pub(super) converged: bool,
    /// Number of steps taken.
    pub(super) n_steps: usize,
    /// Whether `go_on` stopped the descent.
    pub(super) was_stopped: bool,
}

/// Number of past steps that contribute curvature.
const N_REMEMBERED: usize = 6;

/// Value below which no improvement is left: it corresponds to a stress of 1e-10.
const PERFECT: f64 = 1e-20;

/// Fraction of the decrease predicted by the slope that a step must achieve (Armijo condition).
const ENOUGH: f64 = 1e-4;

/// Maximum number of times a step is shortened before its direction is abandoned.
const MAX_SHORTENED: usize = 20;

/// Predicted relative decrease up to which a descent stopped by rounding still counts as converged.
const ROUNDING: f64 = 1e-10;

/// Moves `points` to a stationary point: a step there improves the value by less than the tolerance, and the Guttman
/// transform predicts no larger improvement. `go_on` is called before every step; returning `false` stops the descent.
pub(super) fn descend(
    points: &mut [f64],
    stop: Stop,
    go_on: &dyn Fn() -> bool,
    mut evaluate: impl FnMut(&[f64], &mut [f64]) -> Evaluation,
) -> End {
    let mut gradient = vec![0.0; points.len()];
    let mut tried = Tried { points: points.to_vec(), gradient: gradient.clone() };
    let mut direction = gradient.clone();
    let mut memory = Memory::default();
    let mut at = evaluate(points, &mut gradient);
    let mut n_steps = 0;
    while n_steps < stop.max_steps && at.value > PERFECT && at.value.is_finite() {
        if !go_on() {
            return End { at, converged: false, n_steps, was_stopped: true };
        }
        memory.direct(&gradient, at.guttman, &mut direction);
        let mut slope = -dot(&gradient, &direction);
        if slope.is_nan() || slope >= 0.0 {
            memory.steps.clear();
            memory.direct(&gradient, at.guttman, &mut direction);
            slope = -dot(&gradient, &direction);
        }
        let Some(next) = search(points, &direction, at.value, slope, &mut tried, &mut evaluate) else {
            if memory.steps.is_empty() {
                // Even the step that is guaranteed to descend fails, so only rounding error is left.
                let promised = 0.5 * at.guttman * dot(&gradient, &gradient);
                return End { at, converged: promised <= ROUNDING * at.value, n_steps, was_stopped: false };
            }
            memory.steps.clear();
            continue;
        };
        memory.remember(points, &gradient, &tried);
        points.copy_from_slice(&tried.points);
        gradient.copy_from_slice(&tried.gradient);
        n_steps += 1;
        let still = 2.0 * stop.tolerance * next.value;
        let (fell, promised) = (at.value - next.value, 0.5 * next.guttman * dot(&gradient, &gradient));
        at = next;
        if fell <= still && promised <= still {
            return End { at, converged: true, n_steps, was_stopped: false };
        }
    }
    End { at, converged: at.value <= PERFECT, n_steps, was_stopped: false }
}

/// A trial point and its gradient.
struct Tried {
    points: Vec<f64>,
    gradient: Vec<f64>,
}

/// Backtracking line search against `direction`: the first trial that decreases the value enough, or `None`.
fn search(
    points: &[f64],
    direction: &[f64],
    value: f64,
    slope: f64,
    tried: &mut Tried,
    evaluate: &mut impl FnMut(&[f64], &mut [f64]) -> Evaluation,
) -> Option<Evaluation> {
    let mut length = 1.0;
    for _ in 0..MAX_SHORTENED {
        for ((tried, point), d) in tried.points.iter_mut().zip(points).zip(direction) {
            *tried = point - length * d;
        }
        let next = evaluate(&tried.points, &mut tried.gradient);
        if next.value <= value + ENOUGH * length * slope {
            return Some(next);
        }
        // Minimum of the parabola through both values and the slope, limited to 0.1 to 0.5 of the present length.
        let lowest = -0.5 * slope * length * length / (next.value - value - slope * length);
        length = lowest.clamp(0.1 * length, 0.5 * length);
    }
    None
}

/// A step and the resulting change of the gradient.
struct Curvature {
    step: Vec<f64>,
    change: Vec<f64>,
    /// Reciprocal of the dot product of `step` and `change`.
    inverse: f64,
}

#[derive(Default)]
struct Memory {
    steps: VecDeque<Curvature>,
}

impl Memory {
    /// Computes the step to subtract from the point, by the two-loop recursion of L-BFGS.
    fn direct(&self, gradient: &[f64], guttman: f64, direction: &mut [f64]) {
        direction.copy_from_slice(gradient);
        let mut shares = [0.0; N_REMEMBERED];
        for (Curvature { step, change, inverse }, share) in self.steps.iter().zip(&mut shares).rev() {
            *share = inverse * dot(step, direction);
            add(direction, -*share, change);
        }
        let last = self.steps.back();
        let size = last.map_or(guttman, |last| 1.0 / (last.inverse * dot(&last.change, &last.change)));
        for d in direction.iter_mut() {
            *d *= size;
        }
        for (Curvature { step, change, inverse }, share) in self.steps.iter().zip(shares) {
            add(direction, share - inverse * dot(change, direction), step);
        }
    }

    /// Stores the step from `points` to `tried` if the gradient grew along it (positive curvature).
    fn remember(&mut self, points: &[f64], gradient: &[f64], tried: &Tried) {
        let full = self.steps.len() == N_REMEMBERED;
        let oldest = if full { self.steps.pop_front() } else { None };
        let (mut step, mut change) = oldest.map_or_else(Default::default, |c| (c.step, c.change));
        difference(&tried.points, points, &mut step);
        difference(&tried.gradient, gradient, &mut change);
        let product = dot(&step, &change);
        if product > f64::EPSILON * (dot(&step, &step) * dot(&change, &change)).sqrt() {
            self.steps.push_back(Curvature { step, change, inverse: 1.0 / product });
        }
    }
}

fn difference(to: &[f64], from: &[f64], out: &mut Vec<f64>) {
    out.clear();
    out.extend(to.iter().zip(from).map(|(t, f)| t - f));
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], share: f64, other: &[f64]) {
    for (to, other) in to.iter_mut().zip(other) {
        *to += share * other;
    }
}
