//! Minimum of a smooth function of many variables, by the method of Broyden, Fletcher, Goldfarb and Shanno with limited
//! memory (L-BFGS; J. Nocedal 1980; Nocedal and Wright 2006, algorithm 7.5).

use std::collections::VecDeque;

use crate::maths::statistics::dot;

/// Number of steps that the approximation of the curvature remembers.
const N_REMEMBERED: usize = 10;
/// Fraction of the decrease that the slope predicts which a step must reach (Armijo's condition).
const LEAST_DECREASE: f64 = 1e-4;
/// Largest number of times that a step is halved; after that, only rounding error is left to gain.
const MOST_HALVINGS: usize = 40;
/// Smallest curvature along a step, relative to the change of the gradient, that is remembered.
const LEAST_CURVATURE: f64 = 1e-12;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Largest absolute component of the gradient at which the search ends; above 0.
    pub slope: f64,
    /// Largest number of steps.
    pub n_steps: usize,
}

/// Step taken, and the change of the gradient along it.
struct Curvature {
    step: Vec<f64>,
    change: Vec<f64>,
    /// One over the product of both.
    inverse: f64,
}

/// Returns the point with the smallest value found from `start`.
///
/// `function` returns the value and the gradient at a point. It is called once per step, and again where a step is too
/// long.
pub fn minimize(
    start: Vec<f64>,
    stop: Stop,
    mut function: impl FnMut(&[f64]) -> (f64, Vec<f64>),
) -> Vec<f64> {
    let mut at = start;
    let (mut value, mut gradient) = function(&at);
    let mut remembered: VecDeque<Curvature> = VecDeque::with_capacity(N_REMEMBERED);
    for _ in 0..stop.n_steps {
        if gradient.iter().all(|slope| slope.abs() <= stop.slope) {
            break;
        }
        let mut direction = downhill(&gradient, &remembered);
        let mut slope = dot(&direction, &gradient);
        // Rounding can turn the direction uphill; the steepest descent never is.
        if slope >= 0.0 {
            remembered.clear();
            direction = gradient.iter().map(|slope| -slope).collect();
            slope = -dot(&gradient, &gradient);
        }
        // Nothing is known about the scale of the function before the first step.
        let mut length = if remembered.is_empty() { (-slope).sqrt().max(1.0).recip() } else { 1.0 };
        let mut found = None;
        for _ in 0..MOST_HALVINGS {
            let next: Vec<f64> = at.iter().zip(&direction).map(|(x, d)| x + length * d).collect();
            let (next_value, next_gradient) = function(&next);
            if next_value <= value + LEAST_DECREASE * length * slope {
                found = Some((next, next_value, next_gradient));
                break;
            }
            length *= 0.5;
        }
        let Some((next, next_value, next_gradient)) = found else { break };
        let step: Vec<f64> = next.iter().zip(&at).map(|(new, old)| new - old).collect();
        let change: Vec<f64> = next_gradient.iter().zip(&gradient).map(|(new, old)| new - old).collect();
        let curvature = dot(&step, &change);
        if curvature > LEAST_CURVATURE * dot(&change, &change) {
            if remembered.len() == N_REMEMBERED {
                remembered.pop_front();
            }
            remembered.push_back(Curvature { step, change, inverse: curvature.recip() });
        }
        (at, value, gradient) = (next, next_value, next_gradient);
    }
    at
}

/// Returns the direction of the next step: minus the gradient, scaled by the approximated inverse curvature.
fn downhill(gradient: &[f64], remembered: &VecDeque<Curvature>) -> Vec<f64> {
    let mut direction: Vec<f64> = gradient.iter().map(|slope| -slope).collect();
    let mut shares = Vec::with_capacity(remembered.len());
    for Curvature { step, change, inverse } in remembered.iter().rev() {
        let share = inverse * dot(step, &direction);
        add(&mut direction, -share, change);
        shares.push(share);
    }
    if let Some(Curvature { change, inverse, .. }) = remembered.back() {
        let scale = (inverse * dot(change, change)).recip();
        for x in &mut direction {
            *x *= scale;
        }
    }
    for (Curvature { step, change, inverse }, share) in remembered.iter().zip(shares.into_iter().rev()) {
        let other = inverse * dot(change, &direction);
        add(&mut direction, share - other, step);
    }
    direction
}

fn add(to: &mut [f64], factor: f64, vector: &[f64]) {
    for (x, v) in to.iter_mut().zip(vector) {
        *x += factor * v;
    }
}

#[cfg(test)]
mod tests {
    use super::{Stop, minimize};

    const STOP: Stop = Stop { slope: 1e-9, n_steps: 500 };

    #[test]
    fn the_minimum_of_a_quadratic_is_its_closed_form() {
        // Σ s (x - c)², with curvatures over four orders of magnitude.
        let (scales, centers) = ([1.0, 30.0, 900.0, 1e4], [2.0, -1.0, 0.5, 7.0]);
        let at = minimize(vec![0.0; 4], STOP, |x| {
            let value = (0..4).map(|i| scales[i] * (x[i] - centers[i]).powi(2)).sum();
            (value, (0..4).map(|i| 2.0 * scales[i] * (x[i] - centers[i])).collect())
        });
        // A slope of 1e-9 leaves an error of at most 1e-9 / 2.
        assert!(at.iter().zip(centers).all(|(x, c)| (x - c).abs() < 1e-8), "{at:?}");
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        // The function of H. Rosenbrock (1960), with its minimum at (1, 1).
        let at = minimize(vec![-1.2, 1.0], STOP, |x| {
            let (a, b) = (1.0 - x[0], x[1] - x[0] * x[0]);
            (a * a + 100.0 * b * b, vec![-2.0 * a - 400.0 * x[0] * b, 200.0 * b])
        });
        assert!(at.iter().all(|x| (x - 1.0).abs() < 1e-6), "{at:?}");
    }

    #[test]
    fn the_search_ends_after_the_stated_number_of_steps() {
        let mut n = 0;
        let slow = |x: &[f64]| {
            n += 1;
            (x[0].powi(4), vec![4.0 * x[0].powi(3)])
        };
        let at = minimize(vec![3.0], Stop { slope: 1e-300, n_steps: 5 }, slow);
        assert!(at[0].abs() < 3.0 && n < 5 * 40, "{at:?} after {n}");
        assert_eq!(minimize(vec![3.0], Stop { slope: 1.0, n_steps: 0 }, |_| (0.0, vec![9.0])), [3.0]);
    }
}
