//! Fit of one decaying sinusoid to several tap transients.

use std::f64::consts::TAU;

use crate::recording::tap_transients::FittedTap;
use crate::recording::tap_transients::transient::Transient;
use crate::texture::tap::Tap;
use crate::units::Hertz;

/// Initial search grid of frequencies: the lowest, and the ratio between neighbors.
const FIRST_HZ: f64 = 8.0;
const FREQUENCY_STEP: f64 = 1.08;

/// Highest frequency of the search, as a fraction of the sample rate.
const HIGHEST_SHARE: f64 = 0.45;

/// Initial search grid of decay rates, in 1/s: from almost undamped to decayed within a few milliseconds.
const DECAYS_PER_SEC: [f64; 10] = [5.0, 15.0, 30.0, 50.0, 80.0, 120.0, 180.0, 260.0, 400.0, 600.0];

/// Number of halvings of the search step after the grid, down to one ten-thousandth of the step.
const N_HALVINGS: usize = 14;

/// Maximum number of samples by which a transient can start too early: one for safety, and the sampling of the rise.
const MAX_EARLY: usize = 3;

/// Least-squares fit of a decaying sinusoid to all transients. Amplitude `A` and phase are free for each transient,
/// which makes it a sum of a sine and a cosine. Frequency and decay rate are common and searched from coarse to fine.
pub(super) fn ring(transients: &[Transient]) -> Option<FittedTap> {
    let total: f64 = transients.iter().flat_map(|t| &t.signal).map(|x| x * x).sum();
    let whole: Vec<_> = transients.iter().map(|t| (t.rate, t.signal.as_slice())).collect();
    let (f, b, _) = search(&whole)?;
    // Second pass: each transient starts at the sample from which the sinusoid explains the most energy.
    let trimmed: Vec<_> = whole
        .into_iter()
        .map(|(rate, signal)| {
            let from = |skip: usize| (rate, signal.get(skip..).unwrap_or_default());
            let explained = |skip: &usize| projection(from(*skip), f, b).energy;
            let skip = (0..=MAX_EARLY).max_by(|x, y| explained(x).total_cmp(&explained(y))).unwrap_or(0);
            from(skip)
        })
        .collect();
    let (f, b, explained) = search(&trimmed)?;
    let amplitude: f64 = trimmed.iter().map(|t| projection(*t, f, b).amplitude).sum();
    Some(FittedTap {
        tap: Tap {
            frequency: Hertz(f),
            decay_per_sec: b,
            amplitude_mps2: amplitude / transients.len() as f64,
        }
        .bounded(),
        n_landings: transients.len(),
        explained: if total > 0.0 { (explained / total).min(1.0) } else { 0.0 },
    })
}

/// Frequency and decay rate that explain the most energy of the transients, and this energy.
fn search(transients: &[(Hertz, &[f64])]) -> Option<(f64, f64, f64)> {
    let lowest_hz = transients.iter().map(|t| t.0.0).min_by(f64::total_cmp)?;
    let frequencies = std::iter::successors(Some(FIRST_HZ), |f| Some(f * FREQUENCY_STEP))
        .take_while(|f| *f <= HIGHEST_SHARE * lowest_hz);
    let explained = |f: f64, b: f64| transients.iter().map(|t| projection(*t, f, b).energy).sum::<f64>();
    let grid = frequencies.flat_map(|f| DECAYS_PER_SEC.map(|b| (f, b)));
    let (mut best, (mut f, mut b)) =
        grid.map(|(f, b)| (explained(f, b), (f, b))).max_by(|x, y| x.0.total_cmp(&y.0))?;
    let (mut step_f, mut step_b) = (FREQUENCY_STEP, 1.5);
    for _ in 0..N_HALVINGS {
        loop {
            let around = [(f * step_f, b), (f / step_f, b), (f, b * step_b), (f, b / step_b)];
            let inside = around.into_iter().filter(|(f, _)| *f <= HIGHEST_SHARE * lowest_hz);
            let tried = inside.map(|(f, b)| (explained(f, b), (f, b)));
            match tried.max_by(|x, y| x.0.total_cmp(&y.0)) {
                Some((energy, next)) if energy > best => (best, (f, b)) = (energy, next),
                _ => break,
            }
        }
        (step_f, step_b) = (step_f.sqrt(), step_b.sqrt());
    }
    Some((f, b, best))
}

/// Projection of a transient onto `e^{-bt} sin` and `e^{-bt} cos`.
struct Projection {
    /// Energy of the projection.
    energy: f64,
    /// Amplitude of the projection at the onset.
    amplitude: f64,
}

fn projection((rate, signal): (Hertz, &[f64]), frequency_hz: f64, decay_per_sec: f64) -> Projection {
    let step_secs = 1.0 / rate.0;
    let (turn_sin, turn_cos) = (TAU * frequency_hz * step_secs).sin_cos();
    let shrink = (-decay_per_sec * step_secs).exp();
    let (mut c, mut s) = (1.0, 0.0);
    let [mut cc, mut cs, mut ss, mut cx, mut sx] = [0.0; 5];
    for x in signal {
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
    // The sinusoid starts at its zero before the first sample; A is the envelope at that time.
    let phase = along_c.atan2(along_s).rem_euclid(std::f64::consts::PI);
    let before_secs = phase / (TAU * frequency_hz);
    let early = if before_secs <= 1.5 * step_secs { (decay_per_sec * before_secs).exp() } else { 1.0 };
    Projection { energy: along_c * cx + along_s * sx, amplitude: along_c.hypot(along_s) * early }
}
