//! The one decaying oscillation through many transients.

use std::f64::consts::TAU;

use crate::tap::landing::Transient;
use crate::tap::{Landed, Tap};
use crate::units::Hertz;

/// Frequencies that are tried first, from the lowest, each this much above the one before.
const FIRST_HZ: f64 = 8.0;
const FREQUENCY_STEP: f64 = 1.08;

/// Highest frequency that is tried, as a share of the rate.
const HIGHEST_SHARE: f64 = 0.45;

/// Decays that are tried first, in 1/s: from hardly damped to gone within a few milliseconds.
const DECAYS_PER_SEC: [f64; 10] = [5.0, 15.0, 30.0, 50.0, 80.0, 120.0, 180.0, 260.0, 400.0, 600.0];

/// Times the steps of the search are halved after the first grid: to a ten-thousandth of a step.
const N_HALVINGS: usize = 14;

/// Coherent sums of the transients, aligned at their onsets; `A` and the moment of landing within a sample are free for
/// each frequency and decay, which makes it a sine and a cosine of free amplitudes.
pub(super) fn ring(transients: &[Transient]) -> Option<Landed> {
    let lowest_hz = transients.iter().map(|t| t.rate.0).min_by(f64::total_cmp)?;
    let frequencies = std::iter::successors(Some(FIRST_HZ), |f| Some(f * FREQUENCY_STEP))
        .take_while(|f| *f <= HIGHEST_SHARE * lowest_hz);
    let explained = |f: f64, b: f64| transients.iter().map(|t| projection(t, f, b).energy).sum::<f64>();
    let (mut f, mut b) = frequencies
        .flat_map(|f| DECAYS_PER_SEC.map(|b| (f, b)))
        .max_by(|x, y| explained(x.0, x.1).total_cmp(&explained(y.0, y.1)))?;
    let mut best = explained(f, b);
    let (mut step_f, mut step_b) = (FREQUENCY_STEP, 1.5);
    for _ in 0..N_HALVINGS {
        loop {
            let around = [(f * step_f, b), (f / step_f, b), (f, b * step_b), (f, b / step_b)];
            let inside = around.into_iter().filter(|(f, _)| *f <= 0.5 * lowest_hz);
            let Some((energy, next)) =
                inside.map(|(f, b)| (explained(f, b), (f, b))).max_by(|x, y| x.0.total_cmp(&y.0))
            else {
                break;
            };
            if energy <= best {
                break;
            }
            best = energy;
            (f, b) = next;
        }
        (step_f, step_b) = (step_f.sqrt(), step_b.sqrt());
    }
    let total: f64 = transients.iter().flat_map(|t| &t.signal).map(|x| x * x).sum();
    let amplitude: f64 = transients.iter().map(|t| projection(t, f, b).amplitude).sum();
    Some(Landed {
        tap: Tap {
            frequency: Hertz(f),
            decay_per_sec: b,
            amplitude_mps2: amplitude / transients.len() as f64,
        },
        n_landings: transients.len(),
        explained: if total > 0.0 { (best / total).min(1.0) } else { 0.0 },
    })
}

/// A transient on `e^{-bt} sin` and `e^{-bt} cos`.
struct Projection {
    /// Energy of the part that lies in their plane.
    energy: f64,
    /// Amplitude of that part at the onset.
    amplitude: f64,
}

fn projection(transient: &Transient, frequency_hz: f64, decay_per_sec: f64) -> Projection {
    let step_secs = 1.0 / transient.rate.0;
    let (turn_sin, turn_cos) = (TAU * frequency_hz * step_secs).sin_cos();
    let shrink = (-decay_per_sec * step_secs).exp();
    let (mut c, mut s) = (1.0, 0.0);
    let [mut cc, mut cs, mut ss, mut cx, mut sx] = [0.0; 5];
    for x in &transient.signal {
        cc += c * c;
        cs += c * s;
        ss += s * s;
        cx += c * x;
        sx += s * x;
        (c, s) = (shrink * (c * turn_cos - s * turn_sin), shrink * (s * turn_cos + c * turn_sin));
    }
    let determinant = cc * ss - cs * cs;
    if determinant <= 1e-12 * cc * ss {
        return Projection { energy: 0.0, amplitude: 0.0 };
    }
    let along_c = (ss * cx - cs * sx) / determinant;
    let along_s = (cc * sx - cs * cx) / determinant;
    // The oscillation began where its sine was zero, before the first sample: A is its envelope there.
    let phase = along_c.atan2(along_s).rem_euclid(std::f64::consts::PI);
    let before_secs = phase / (TAU * frequency_hz);
    let early = if before_secs <= 2.0 * step_secs { (decay_per_sec * before_secs).exp() } else { 1.0 };
    Projection { energy: along_c * cx + along_s * sx, amplitude: along_c.hypot(along_s) * early }
}
