use super::{BLOCK_SECS, MAX_SECS, MIN_SPEED, SPEED_TOLERANCE, SPEED_TOLERANCE_MPS, segment, smoothed};
use crate::maths::rng::lcg_noise;
use crate::recording::Recording;
use crate::units::Hertz;
use proptest::prelude::{any, prop_assert, proptest};
use std::f64::consts::TAU;

fn recording(rate_hz: f64, seconds: f64, contact: impl Fn(f64) -> (f64, f64)) -> Recording {
    let n = (seconds * rate_hz) as usize;
    let (speed_mps, force_n) = (0..n).map(|i| contact(i as f64 / rate_hz)).unzip();
    Recording {
        rate: Hertz(rate_hz),
        acceleration_mps2: vec![0.0; n],
        speed_mps,
        force_n,
        usable: std::iter::once(0..n).collect(),
    }
}

#[test]
fn steady_strokes_are_cut_where_they_change() {
    // Three plateaus of 0.8 s, and a lifted tip between the second and the third.
    let r = recording(1000.0, 3.2, |t| match (t / 0.8) as u32 {
        0 => (0.1, 1.0),
        1 => (0.2, 1.0),
        2 => (0.2, 0.0),
        _ => (0.05, 2.0),
    });
    let found = segment(&r, 0.1);
    let labels: Vec<[i64; 2]> = found
        .stretches
        .iter()
        .map(|s| [(1e3 * s.speed.0).round() as i64, (10.0 * s.force.0).round() as i64])
        .collect();
    assert_eq!(labels, [[100, 10], [200, 10], [50, 20]]);
    // Only blocks that contain an edge, smoothed over 20 ms, are lost.
    assert!((found.lifted_secs - 0.8).abs() < 0.11, "{found:?}");
    assert!(found.changing_secs < 0.21, "{found:?}");
    assert!((found.fastest.0 - 0.2).abs() < 1e-9 && (found.strongest.0 - 2.0).abs() < 1e-9);
}

#[test]
fn back_and_forth_leaves_enough() {
    // 0.7 Hz at up to 200 mm/s: at least a third of the time is within the tolerances of some segment.
    for rate_hz in [500.0, 1000.0, 3000.0, 44_100.0] {
        let r = recording(rate_hz, 6.0, |t| (0.2 * (TAU * 0.35 * t).sin().abs(), 1.0));
        let total: usize = segment(&r, 0.1).stretches.iter().map(|s| s.samples.len()).sum();
        assert!(total as f64 / rate_hz > 3.0, "{} s at {rate_hz} Hz", total as f64 / rate_hz);
    }
}

#[test]
fn what_is_not_usable_is_never_touched() {
    let mut r = recording(1000.0, 4.0, |_| (0.1, 1.0));
    r.usable = vec![100..1500, 2000..2050, 3000..4000];
    let found = segment(&r, 0.1);
    assert!(
        found
            .stretches
            .iter()
            .all(|s| r.usable.iter().any(|u| u.start <= s.samples.start && s.samples.end <= u.end))
    );
    let total: usize = found.stretches.iter().map(|s| s.samples.len()).sum();
    assert_eq!(total, 1400 + 1000);
    assert!(found.stretches.iter().all(|s| s.samples.len() <= 1000));
}

#[test]
fn a_noisy_speed_is_smoothed_without_delay() {
    let noise = lcg_noise(4000, 1);
    let track: Vec<f64> = noise.iter().zip(0..).map(|(n, i)| 0.1 + 2e-5 * f64::from(i) + 0.01 * n).collect();
    let smooth = smoothed(&track, 1000.0);
    // Three averages over 13 samples reduce white noise to a third.
    for (i, s) in smooth.iter().enumerate().skip(100).take(3800) {
        assert!((s - 0.1 - 2e-5 * i as f64).abs() < 0.015, "{i}: {s}");
    }
}

proptest! {
    #[test]
    fn stretches_keep_their_promises(seed in any::<u64>()) {
        let noise = lcg_noise(200, seed);
        // Drifting stroke: linear between random knots 0.2 s apart.
        let knot = |i: usize, scale: f64| scale * noise[i % 200].abs();
        let at = |t: f64, scale: f64, shift: usize| {
            let (i, share) = ((t / 0.2) as usize + shift, (t / 0.2).fract());
            knot(i, scale) + share * (knot(i + 1, scale) - knot(i, scale))
        };
        let r = recording(1000.0, 15.0, |t| (at(t, 0.15, 0), at(t, 1.0, 100)));
        let found = segment(&r, 2.0 * BLOCK_SECS);
        let speed = smoothed(&r.speed_mps, 1000.0);
        let mut end = 0;
        for s in &found.stretches {
            prop_assert!(s.samples.start >= end && s.samples.len() >= 100 && s.samples.len() as f64 <= 1000.0 * MAX_SECS);
            end = s.samples.end;
            let inside = &speed[s.samples.clone()];
            let (low, high) = inside.iter().fold((f64::MAX, 0.0_f64), |(l, h), v| (l.min(*v), h.max(*v)));
            prop_assert!(low >= MIN_SPEED.0 && s.speed.0 >= low && s.speed.0 <= high);
            let tolerance = (SPEED_TOLERANCE * 0.5 * (low + high)).max(SPEED_TOLERANCE_MPS);
            prop_assert!(high - low <= 2.0 * tolerance + 1e-12);
        }
        let used: usize = found.stretches.iter().map(|s| s.samples.len()).sum();
        let rest = found.lifted_secs + found.slow_secs + found.changing_secs;
        prop_assert!((used as f64 * 1e-3 + rest - 15.0).abs() < 1e-6);
    }
}
