//! Speeds and forces that no hand has: then a unit may be wrong, and nothing else would tell.

use crate::recording::missing::SPEED;
use crate::recording::{Fault, Finding, Recording};
use crate::spectrum::median;

/// Below this share of its highest speed a tip rests or turns.
const MOVING_SHARE: f64 = 0.05;
/// Median speeds in m/s between which hands stroke.
const SLOWEST_MPS: f64 = 5e-4;
const FASTEST_MPS: f64 = 5.0;
/// Highest force in N that a stylus is pressed with, and much more.
const STRONGEST_N: f64 = 100.0;

/// Says what is implausible in the motion of a recording; gives what is impossible.
pub(super) fn check_plausible(recording: &Recording, findings: &mut Vec<Finding>) -> Option<Fault> {
    let inside = |values: &[f64]| -> Vec<f64> {
        recording.usable.iter().flat_map(|range| values[range.clone()].iter().copied()).collect()
    };
    let speeds_mps = inside(&recording.speed_mps);
    let most_mps = speeds_mps.iter().copied().fold(0.0, f64::max);
    if most_mps > SPEED.most {
        return Some(Fault::ImpossibleSpeed { most_mps });
    }
    let moving = speeds_mps.into_iter().filter(|speed| *speed > MOVING_SHARE * most_mps);
    let median_mps = median(moving.collect());
    if median_mps < SLOWEST_MPS || median_mps > FASTEST_MPS {
        findings.push(Finding::ImplausibleSpeed { median_mps });
    }
    let most_n = inside(&recording.force_n).into_iter().fold(0.0, f64::max);
    if most_n > STRONGEST_N {
        findings.push(Finding::ImplausibleForce { most_n });
    }
    None
}
