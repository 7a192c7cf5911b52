//! Tests of the whole output stage with a simulated coil.

extern crate std;

use std::f64::consts::TAU;
use std::vec;
use std::vec::Vec;

use super::{DriveChain, DriveConfig, Driven, HEAT_BLOCK, Inverse};
use crate::budget::Budget;
use crate::equalizer::Resonance;
use crate::lift_gate::Touching;
use crate::limiter::Limiter;

const RATE_HZ: f32 = 48_000.0;

/// Haptuator Mark II on 100 g: 1.41 V RMS, 4.5 V peak, amplifier with 5 V full scale.
const MARK_II: DriveConfig = DriveConfig {
    inverse: Some(Inverse {
        resonance: Resonance { frequency_hz: 65.0, q: 4.086_34, gain_mps2_per_volt: 2.133_938_6 },
        lowest_hz: 20.0,
    }),
    full_scale: 5.0,
    ceiling: 0.9,
    look_ahead_secs: 0.002,
    budget: Some(Budget { rms: 1.41 / 5.0, time_secs: 10.0 }),
};

/// Simulates a coil with its load by its equation of motion, in steps of 1/40 sample. It shares no code with the
/// inverse.
fn coil(volts: &[f64]) -> Vec<f64> {
    // `x'' + (ω/Q) x' + ω² x = K V`, and the acceleration is `x''`.
    let (w, q, k) = (TAU * 65.0, 4.086_340_698, 2.133_938_564);
    let n_steps = 40;
    let h = 1.0 / (f64::from(RATE_HZ) * f64::from(n_steps));
    let (mut x, mut v) = (0.0, 0.0);
    let mut before = 0.0;
    volts
        .iter()
        .map(|&now| {
            let mut a = 0.0;
            for i in 0..n_steps {
                let volt = before + (now - before) * f64::from(i) / f64::from(n_steps);
                a = k * volt - w / q * v - w * w * x;
                v += h * a;
                x += h * v;
            }
            before = now;
            a
        })
        .collect()
}

/// Level in dB of the simulated coil's acceleration at a frequency, relative to the requested acceleration.
fn response_db(config: DriveConfig, hz: f64, amplitude_mps2: f64) -> f64 {
    let mut chain = DriveChain::new(config, RATE_HZ);
    let n = 48_000;
    let wave = |i: usize| (TAU * hz * i as f64 / f64::from(RATE_HZ)).sin();
    let mut block: Vec<f32> = (0..n).map(|i| (amplitude_mps2 * wave(i)) as f32).collect();
    chain.process(&mut block, Driven::Acceleration, Touching::NotNeeded);
    assert_eq!(chain.limited_samples(), 0, "the limiter must not act, it would hide the response");
    let volts: Vec<f64> = block.iter().map(|x| 5.0 * f64::from(*x)).collect();
    let felt = coil(&volts);
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (i, a) in felt.iter().enumerate().skip(n / 2) {
        let phase = TAU * hz * i as f64 / f64::from(RATE_HZ);
        (sine, cosine) = (sine + a * phase.sin(), cosine + a * phase.cos());
    }
    let amplitude = 2.0 * f64::hypot(sine, cosine) / (n / 2) as f64;
    20.0 * (amplitude / amplitude_mps2).log10()
}

#[test]
fn an_equalized_coil_is_flat_and_a_bare_one_is_not() {
    let bare = DriveConfig { inverse: None, full_scale: 5.0 * 2.133_938_6, ..MARK_II };
    let (mut worst, mut worst_bare) = (0.0_f64, 0.0_f64);
    // Frequencies with whole periods in the half second that is evaluated.
    for hz in [
        40.0, 50.0, 56.0, 60.0, 64.0, 66.0, 70.0, 80.0, 100.0, 130.0, 160.0, 200.0, 250.0, 320.0, 400.0,
        500.0,
    ] {
        let (db, bare_db) = (response_db(MARK_II, hz, 0.3), response_db(bare, hz, 0.3));
        assert!(db.abs() < 1.0, "{db} dB at {hz} Hz");
        worst = worst.max(db.abs());
        worst_bare = worst_bare.max(bare_db.abs());
    }
    assert!(worst < 0.4, "{worst} dB");
    assert!(worst_bare > 10.0, "{worst_bare} dB without the equalizer");
}

fn noise(n: usize, amplitude: f32) -> Vec<f32> {
    let mut state = 1_u32;
    (0..n)
        .map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            amplitude * ((state >> 8) as f32 / 8_388_608.0 - 1.0)
        })
        .collect()
}

#[test]
fn a_proportional_chain_is_the_limiter_alone() {
    let mut chain = DriveChain::new(DriveConfig::proportional(10.0, 0.9), RATE_HZ);
    let mut limiter = Limiter::new(0.9, 0.8);
    let mut block = noise(5000, 20.0);
    let expected: Vec<f32> = block.iter().map(|x| limiter.limit(*x * 10.0_f32.recip())).collect();
    chain.process(&mut block, Driven::Acceleration, Touching::NotNeeded);
    assert_eq!(block, expected);
    assert_eq!((chain.limited_samples(), chain.latency_secs()), (limiter.limited_samples(), 0.0));
    assert_eq!((chain.heat_used(), chain.heat_gain()), (0.0, 1.0));
}

#[test]
fn blocks_do_not_change_the_limits() {
    // The thermal gain is updated every 32 samples of a block, so other block sizes differ only by rounding of that
    // gain.
    let run = |block: usize| {
        let mut chain = DriveChain::new(MARK_II, RATE_HZ);
        let mut out = noise(96_000, 8.0);
        out.chunks_mut(block).for_each(|part| chain.process(part, Driven::Acceleration, Touching::NotNeeded));
        out
    };
    let whole = run(96_000);
    for block in [HEAT_BLOCK, 128, 256] {
        assert_eq!(run(block), whole);
    }
    for block in [1, 7, 85] {
        assert!(run(block).iter().zip(&whole).all(|(x, y)| (x - y).abs() < 1e-3), "{block}");
    }
}

#[test]
fn neither_peak_nor_heat_exceed_what_the_coil_stands() {
    for driven in [Driven::Acceleration, Driven::Drive] {
        let mut chain = DriveChain::new(MARK_II, RATE_HZ);
        let forget = 1.0 / (10.0 * f64::from(RATE_HZ));
        let (mut square, mut highest, mut peak) = (0.0, 0.0_f64, 0.0_f32);
        for _ in 0..60 {
            let mut second = noise(48_000, 300.0);
            chain.process(&mut second, driven, Touching::NotNeeded);
            for x in second {
                peak = peak.max(x.abs());
                square += forget * (f64::from(x * x) - square);
                highest = highest.max(square);
            }
        }
        assert!(peak <= 0.9, "{peak}");
        let (volts, limit) = (5.0 * highest.sqrt(), 1.41);
        assert!(volts <= 1.001 * limit && volts > 0.98 * limit, "{volts} V for {limit} V");
        assert!(chain.heat_used() <= 1.001 && chain.heat_gain() < 0.5 && chain.limited_samples() > 0);
    }
}

#[test]
fn nonsense_latches_silence_and_reset_keeps_the_heat() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut chain = DriveChain::new(MARK_II, RATE_HZ);
        chain.process(&mut noise(48_000, 50.0), Driven::Acceleration, Touching::NotNeeded);
        let heat = chain.heat_used();
        assert!(heat > 0.1);
        let mut block = vec![1.0; 480];
        block[200] = bad;
        chain.process(&mut block, Driven::Acceleration, Touching::NotNeeded);
        assert!(block.iter().all(|x| x.abs() <= 0.9));
        assert!(chain.is_tripped() && block[400..].iter().all(|&x| x == 0.0));
        chain.reset();
        let mut block = vec![1.0; 480];
        chain.process(&mut block, Driven::Acceleration, Touching::NotNeeded);
        assert!(!chain.is_tripped() && block[100..].iter().all(|x| x.is_finite() && *x != 0.0));
        assert!(chain.heat_used() > 0.99 * heat && chain.heat_used().is_finite());
    }
}

#[test]
fn an_inverse_that_the_rate_cannot_hold_is_left_out() {
    let mut chain = DriveChain::new(MARK_II, 120.0);
    let mut block = vec![1.0; 10];
    chain.process(&mut block, Driven::Acceleration, Touching::NotNeeded);
    assert!(block.iter().all(|x| x.is_finite()));
}

#[test]
fn the_latency_is_that_of_the_look_ahead() {
    let mut chain = DriveChain::new(MARK_II, RATE_HZ);
    assert_eq!(chain.latency_secs(), 0.002);
    let mut block = vec![0.0; 200];
    block[0] = 0.3;
    chain.process(&mut block, Driven::Drive, Touching::NotNeeded);
    assert_eq!(block.iter().position(|x| *x != 0.0), Some(96));
    assert_eq!(block[96], 0.3);
}

#[test]
fn what_the_equalizer_rings_with_ends_beneath_drive_and_does_not_come_back() {
    let run = |driven| {
        let mut chain = DriveChain::new(DriveConfig { look_ahead_secs: 0.0, ..MARK_II }, RATE_HZ);
        let mut texture: Vec<f32> = (0..480_u16).map(|i| 0.1 - 0.1 * f32::from(i) / 480.0).collect();
        chain.process(&mut texture, Driven::Acceleration, Touching::NotNeeded);
        let mut signal = vec![0.0; 48_000];
        chain.process(&mut signal, driven, Touching::NotNeeded);
        let mut after = vec![0.0; 4800];
        chain.process(&mut after, Driven::Acceleration, Touching::NotNeeded);
        (texture, signal, after)
    };
    let (texture, beneath_drive, after) = run(Driven::Drive);
    let (_, beneath_texture, _) = run(Driven::Acceleration);
    assert!(beneath_texture[0].abs() > 1e-3, "the equalizer must ring: {}", beneath_texture[0]);
    assert!(
        (beneath_drive[0] - texture[479]).abs() < 0.02 * texture[479].abs(),
        "jump at the switch to drive"
    );
    assert!(beneath_drive.iter().zip(&beneath_texture).all(|(x, y)| (x - y).abs() < 1e-6));
    // One second is 90 time constants of the filter at 20 Hz.
    assert!(after.iter().all(|x| x.abs() < 1e-12));
}

/// A stiff actuator profile may ring for long; after lift-off even that ends.
#[test]
fn all_is_silent_soon_after_lift_off() {
    let inverse = Inverse {
        resonance: Resonance { frequency_hz: 65.0, q: 900.0, gain_mps2_per_volt: 1.0 },
        lowest_hz: 0.05,
    };
    for config in [MARK_II, DriveConfig { inverse: Some(inverse), ..MARK_II }] {
        let mut chain = DriveChain::new(config, RATE_HZ);
        let touching = Touching::Span { landed: 0, touched: 24_000 };
        chain.process(&mut noise(24_000, 50.0), Driven::Acceleration, touching);
        let silent = (crate::lift_gate::SILENT_AFTER_SECS * RATE_HZ).ceil() as usize + 2;
        let mut after = noise(48_000, 50.0);
        after.chunks_mut(480).for_each(|part| chain.process(part, Driven::Acceleration, touching));
        assert!(after[..4800].iter().any(|x| x.abs() > 0.1));
        assert!(after[silent..].iter().all(|x| *x == 0.0));
        assert!(chain.is_silenced());
        // A signal is played whether anything is touched or not.
        let mut signal = [0.25; 480];
        chain.process(&mut signal, Driven::Drive, Touching::NotNeeded);
        assert!(signal[300..].iter().all(|x| *x > 0.0), "only the coil's heat may weaken it");
    }
}
