use std::f64::consts::SQRT_2;

use super::{STATIC_RATIOS, STRIBECK_MPS, StickSlip, StickSlipError, friction};
use crate::units::{MetersPerSecond, Newtons};
use proptest::prelude::{prop_assert, proptest};
use shagreen_synth::contact::Contact;
use shagreen_synth::stick_slip::{
    BRISTLE_M, DAMPING_N_S_PER_M, MASS_KG, MAX_STATIC_RATIO, STIFFNESS_N_PER_M, STRIBECK_SPEEDS_MPS,
    VISCOUS_N_S_PER_M,
};

const RATE_HZ: usize = 1000;
/// Time for an oscillation to arise or to die, in samples.
const SETTLED: usize = 800;
/// Length of a comparison in samples.
const COMPARED: usize = 800;

/// Kinetic coefficient, stick-slip and normal force of surfaces that stick.
const SURFACES: [(f64, StickSlip, Newtons); 4] = [
    (0.8, stick_slip(1.3, 0.02), Newtons(1.0)),
    (0.8, stick_slip(1.6, 0.02), Newtons(1.0)),
    (0.42, stick_slip(1.3, 0.02), Newtons(1.0)),
    (0.7, stick_slip(1.3, 0.03), Newtons(2.0)),
];

const fn stick_slip(static_ratio: f64, stribeck_mps: f64) -> StickSlip {
    StickSlip { static_ratio, stribeck_speed: MetersPerSecond(stribeck_mps) }
}

/// Slow oracle: velocity of the tip relative to the hand, a value per sample, by the Runge-Kutta method of fourth order
/// in steps of 4 µs, from steady sliding with a small deviation.
fn oracle_mps(kinetic: f64, of: StickSlip, force: Newtons, speed_mps: f64) -> Vec<f64> {
    const STEPS: usize = 250;
    let step_secs = 1.0 / (RATE_HZ * STEPS) as f64;
    let [mass, stiffness, grip, viscous] =
        [MASS_KG, STIFFNESS_N_PER_M, DAMPING_N_S_PER_M, VISCOUS_N_S_PER_M].map(f64::from);
    let kinetic_n = kinetic * force.0;
    let sigma0 = kinetic_n / f64::from(BRISTLE_M);
    let sigma1 = (sigma0 * mass).sqrt();
    let g = |w: f64| kinetic_n * (1.0 + (of.static_ratio - 1.0) * (-(w / of.stribeck_speed.0).powi(2)).exp());
    // Deflection, velocity and bristle.
    let rate = |[u, p, z]: [f64; 3]| {
        let w = speed_mps + p;
        let bristle_mps = w - sigma0 * w.abs() / g(w) * z;
        let friction_n = sigma0 * z + sigma1 * bristle_mps + viscous * w;
        [p, -(stiffness * u + grip * p + friction_n) / mass, bristle_mps]
    };
    let along = |[u, p, z]: [f64; 3], [du, dp, dz]: [f64; 3], h: f64| [u + h * du, p + h * dp, z + h * dz];
    let steady_n = g(speed_mps) + viscous * speed_mps;
    let mut state = [-steady_n / stiffness, -1e-3 * (speed_mps / 0.01).min(1.0), g(speed_mps) / sigma0];
    let mut velocities = Vec::with_capacity(SETTLED + COMPARED);
    for _ in 0..SETTLED + COMPARED {
        for _ in 0..STEPS {
            let k1 = rate(state);
            let k2 = rate(along(state, k1, 0.5 * step_secs));
            let k3 = rate(along(state, k2, 0.5 * step_secs));
            let k4 = rate(along(state, k3, step_secs));
            for j in 0..3 {
                state[j] += step_secs / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
            }
        }
        velocities.push(state[1]);
    }
    velocities
}

/// Acceleration in m/s² of the renderer.
fn rendered(kinetic: f64, of: StickSlip, force: Newtons, speed_mps: f64) -> Vec<f64> {
    let contact = Contact { speed_mps: speed_mps as f32, force_n: force.0 as f32 };
    let mut model = shagreen_synth::stick_slip::StickSlip::new(RATE_HZ as f32);
    let mut out = vec![0.0; SETTLED + COMPARED];
    for tick in out.chunks_mut(5) {
        model.add_tick(of.with_kinetic(kinetic), (contact, contact), (1.0, 1.0), tick);
    }
    out[SETTLED..].iter().map(|x| f64::from(*x)).collect()
}

/// Acceleration of the oracle as the renderer outputs it: the mean over each sample, after the same high-pass of 10 Hz.
fn accelerations(velocities: &[f64]) -> Vec<f64> {
    let corner = std::f64::consts::PI * 10.0 / RATE_HZ as f64;
    let (keep, take) = ((1.0 - corner) / (1.0 + corner), 1.0 / (1.0 + corner));
    let (mut input, mut output) = (0.0, 0.0);
    let filtered = velocities.windows(2).map(|w| {
        let next = RATE_HZ as f64 * (w[1] - w[0]);
        output = keep * output + take * (next - input);
        input = next;
        output
    });
    filtered.skip(SETTLED).collect()
}

fn rms(samples: &[f64]) -> f64 {
    (samples.iter().map(|x| x * x).sum::<f64>() / samples.len() as f64).sqrt()
}

/// Frequency in Hz by the autocorrelation: its first high maximum after its first zero, refined by a parabola.
fn frequency_hz(samples: &[f64]) -> f64 {
    let n = samples.len() / 2;
    let at = |lag: usize| samples[..n].iter().zip(&samples[lag..]).map(|(x, y)| x * y).sum::<f64>();
    // The period of the stick-slip of these surfaces is 20 to 35 ms.
    let values: Vec<f64> = (0..100).map(at).collect();
    let zero = values.iter().position(|x| *x < 0.0).unwrap();
    let highest = values[zero..].iter().copied().fold(0.0, f64::max);
    let is_peak = |lag: &usize| {
        let [before, here, after] = [values[lag - 1], values[*lag], values[lag + 1]];
        here >= before && here >= after && here > 0.7 * highest
    };
    let lag = (zero + 1..99).find(is_peak).unwrap();
    let [before, peak, after] = [values[lag - 1], values[lag], values[lag + 1]];
    let shift = 0.5 * (before - after) / (before - 2.0 * peak + after);
    RATE_HZ as f64 / (lag as f64 + shift)
}

#[test]
fn below_the_critical_speed_the_renderer_agrees_with_the_slow_oracle() {
    for (kinetic, of, force) in SURFACES {
        let critical_mps = of.critical_speed(kinetic, force).unwrap().0;
        for share in [0.5, 0.7, 0.9] {
            let speed_mps = share * critical_mps;
            let expected = accelerations(&oracle_mps(kinetic, of, force, speed_mps));
            let found = rendered(kinetic, of, force, speed_mps);
            let name = format!("{kinetic}, {of:?}, {force}, {share} of the critical speed");
            assert!(rms(&expected) > 1.0, "{name}");
            // Steps of 62.5 µs of the renderer leave errors below half a percent.
            let ratio = rms(&found) / rms(&expected);
            assert!((0.98..1.02).contains(&ratio), "{name}: amplitude {ratio}");
            let ratio = frequency_hz(&found) / frequency_hz(&expected);
            assert!((0.99..1.01).contains(&ratio), "{name}: frequency {ratio}");
        }
    }
}

#[test]
fn above_the_critical_speed_both_are_silent() {
    for (kinetic, of, force) in SURFACES {
        let critical_mps = of.critical_speed(kinetic, force).unwrap().0;
        for share in [1.15, 3.0] {
            let speed_mps = share * critical_mps;
            let oracle = rms(&accelerations(&oracle_mps(kinetic, of, force, speed_mps)));
            let found = rms(&rendered(kinetic, of, force, speed_mps));
            // Hundredths of a percent of the oscillation below; near the critical speed it dies slowly.
            assert!(oracle < 0.01 && found < 0.01, "{kinetic}, {of:?}, {force}, {share}: {oracle} {found}");
        }
    }
}

/// Closed form of the limit of rigid bristles: `x exp(-x²) = (c + σ₂) v_s / 2 (F_s - F_k)`, by the fixed point
/// `x = √(ln(x / right side))`.
#[test]
fn the_critical_speed_is_that_of_the_falling_friction() {
    for (kinetic, of, force) in SURFACES {
        let excess_n = kinetic * force.0 * (of.static_ratio - 1.0);
        let damping = f64::from(DAMPING_N_S_PER_M + VISCOUS_N_S_PER_M);
        let right = damping * of.stribeck_speed.0 / (2.0 * excess_n);
        let mut x = 1.5_f64;
        for _ in 0..1000 {
            x = (x / right).ln().sqrt();
        }
        assert!((x * (-x * x).exp() - right).abs() < 1e-9);
        let ratio = of.critical_speed(kinetic, force).unwrap().0 / (x * of.stribeck_speed.0);
        // The bristles give way to the oscillation by up to a percent, most where friction barely feeds it.
        assert!((0.99..1.02).contains(&ratio), "{kinetic}, {of:?}, {force}: {ratio}");
    }
}

#[test]
fn a_light_touch_and_a_constant_coefficient_have_no_critical_speed() {
    let rubber = stick_slip(1.3, 0.02);
    assert!(rubber.critical_speed(0.8, Newtons(1.0)).is_some());
    assert_eq!(rubber.critical_speed(0.8, Newtons(0.1)), None);
    assert_eq!(StickSlip::NONE.critical_speed(0.8, Newtons(10.0)), None);
    for (kinetic, force_n) in [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (0.8, f64::INFINITY)] {
        assert_eq!(rubber.critical_speed(kinetic, Newtons(force_n)), None);
    }
}

#[test]
fn values_out_of_range_are_refused_with_their_name() {
    assert_eq!(stick_slip(1.5, 0.02).checked(), Ok(stick_slip(1.5, 0.02)));
    assert_eq!(StickSlip::NONE.checked(), Ok(StickSlip::NONE));
    for bad in [0.9, 5.1, f64::NAN, f64::INFINITY] {
        let error = stick_slip(bad, 0.02).checked().unwrap_err();
        let StickSlipError::Value { what, .. } = error;
        assert_eq!(what, "static ratio");
    }
    for bad in [0.0, -0.02, 0.6, f64::NAN] {
        let text = stick_slip(1.5, bad).checked().unwrap_err().to_string();
        assert!(text.contains("Stribeck speed") && text.contains("0.5 m/s"), "{text}");
    }
    // The ranges are those of the renderer.
    assert_eq!(*STATIC_RATIOS.end(), f64::from(MAX_STATIC_RATIO));
    assert_eq!(*STRIBECK_MPS.start() as f32, STRIBECK_SPEEDS_MPS.0);
    assert_eq!(*STRIBECK_MPS.end() as f32, STRIBECK_SPEEDS_MPS.1);
}

#[test]
fn a_texture_has_friction_where_its_coefficient_is_known() {
    let rubber = stick_slip(1.3, 0.02);
    assert_eq!(friction(None, Some(rubber)), None);
    assert_eq!(friction(Some(0.8), Some(rubber)), Some(rubber.with_kinetic(0.8)));
    let steady = friction(Some(0.45), None).unwrap();
    assert_eq!((steady.kinetic, steady.static_ratio), (0.45, 1.0));
}

proptest! {
    #[test]
    fn the_critical_speed_is_where_the_slope_falls(
        kinetic in 0.05_f64..5.0, ratio in 1.0_f64..5.0, stribeck_mps in 1e-3_f64..0.5, force_n in 0.05_f64..10.0,
    ) {
        let of = stick_slip(ratio, stribeck_mps);
        if let Some(critical) = of.critical_speed(kinetic, Newtons(force_n)) {
            prop_assert!(critical.0 > stribeck_mps / SQRT_2 && critical.0 < 8.0 * stribeck_mps);
            // Pressing harder feeds the oscillation more.
            let harder = of.critical_speed(kinetic, Newtons(1.5 * force_n));
            prop_assert!(harder.is_some_and(|harder| harder.0 > critical.0));
        }
    }
}
