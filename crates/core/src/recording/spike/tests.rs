use crate::maths::rng::{Random, lcg_noise};
use crate::recording::{Finding, RawClock, RawMotion, RawRecording, RawTrack, Recording};
use crate::units::Hertz;
use std::f64::consts::TAU;

const RATES_HZ: [f64; 4] = [1000.0, 3200.0, 10_000.0, 48_000.0];

fn read(rate_hz: f64, acceleration_mps2: Vec<f64>) -> (Recording, Vec<Finding>) {
    let raw = RawRecording {
        clock: RawClock::Rate(Hertz(rate_hz)),
        acceleration_mps2: vec![acceleration_mps2],
        motion: RawMotion::Speed(RawTrack::Constant(0.1)),
        force_n: RawTrack::Constant(1.0),
        full_scale_mps2: None,
    };
    Recording::from_raw(raw).expect("a recording")
}

/// Number of rows, number of spikes and highest value found.
fn found(rate_hz: f64, acceleration_mps2: Vec<f64>) -> Option<(usize, usize, f64)> {
    let (recording, findings) = read(rate_hz, acceleration_mps2);
    let spikes = findings.iter().find_map(|finding| match finding {
        Finding::Spikes { n, at, value, .. } => Some((at.n_rows, *n, *value)),
        _ => None,
    });
    let n_usable: usize = recording.usable.iter().map(ExactSizeIterator::len).sum();
    assert_eq!(recording.acceleration_mps2.len() - n_usable, spikes.map_or(0, |(n_rows, _, _)| n_rows));
    spikes
}

/// Low-pass filtered noise with a standard deviation of about 1, as smooth as the vibration of a tool.
fn smooth_noise(rate_hz: f64, seconds: f64, seed: u64) -> Vec<f64> {
    let keep = (-TAU * 300.0 / rate_hz).exp();
    let gain = (1.0 - keep * keep).sqrt();
    let mut last = 0.0;
    let noise = lcg_noise((seconds * rate_hz) as usize, seed);
    noise
        .into_iter()
        .map(|value| {
            last = keep * last + gain * value;
            last
        })
        .collect()
}

/// Adds taps at these times: decaying oscillations.
fn ring(values: &mut [f64], rate_hz: f64, times: &[f64], height: f64, (hz, decay_secs): (f64, f64)) {
    for start in times {
        let first = (start * rate_hz) as usize;
        for (i, value) in values.iter_mut().enumerate().skip(first) {
            let secs = (i as f64) / rate_hz - start;
            if secs > 20.0 * decay_secs {
                break;
            }
            *value += height * (-secs / decay_secs).exp() * (TAU * hz * secs).cos();
        }
    }
}

#[test]
fn glitches_are_named_and_left_out_at_any_rate() {
    for rate_hz in RATES_HZ {
        for width in 1..=3 {
            for height in [30.0, -200.0, 5e5] {
                for white in [false, true] {
                    let seconds = 4.0;
                    let n = (seconds * rate_hz) as usize;
                    let mut values = if white { lcg_noise(n, 4) } else { smooth_noise(rate_hz, seconds, 4) };
                    let first = (1.3 * rate_hz) as usize;
                    for (i, value) in values[first..first + width].iter_mut().enumerate() {
                        *value += height * if i == 1 { -1.0 } else { 0.9 };
                    }
                    let most = values[first..first + width].iter().copied();
                    let most = most.fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
                    assert_eq!(
                        found(rate_hz, values),
                        Some((width, 1, most)),
                        "{height} over {width} rows at {rate_hz} Hz, white: {white}"
                    );
                }
            }
        }
    }
}

#[test]
fn several_glitches_of_any_height_are_all_found() {
    for rate_hz in RATES_HZ {
        let mut rng = Random::new(11);
        let mut values = smooth_noise(rate_hz, 20.0, 9);
        let (mut n_rows, mut n) = (0, 0);
        // On average two per second at random times, with heights from 40 to 4000.
        while n < 40 {
            let at = (rng.uniform() * values.len() as f64) as usize;
            let width = 1 + n % 3;
            // Farther apart than the minimum length of a segment.
            let reach = (0.03 * rate_hz) as usize;
            let around = at.saturating_sub(reach)..(at + reach).min(values.len());
            if around.len() < 2 * reach || values[around].iter().any(|value| value.abs() > 20.0) {
                continue;
            }
            let height = 40.0 * 100.0_f64.powf(rng.uniform());
            values[at..at + width].iter_mut().for_each(|value| *value += height);
            (n_rows, n) = (n_rows + width, n + 1);
        }
        let (found_rows, found_n, _) = found(rate_hz, values).expect("glitches");
        assert_eq!((found_rows, found_n), (n_rows, n), "{rate_hz} Hz");
    }
}

#[test]
fn a_glitch_at_the_edge_of_a_recording_or_among_taps_is_one() {
    for rate_hz in RATES_HZ {
        let mut values = smooth_noise(rate_hz, 3.0, 2);
        values[0] = 400.0;
        assert_eq!(found(rate_hz, values), Some((1, 1, 400.0)), "at the start, {rate_hz} Hz");
        let mut values = smooth_noise(rate_hz, 3.0, 2);
        ring(&mut values, rate_hz, &[0.3, 0.8, 1.6, 2.2], 60.0, (180.0, 0.006));
        values[(1.2 * rate_hz) as usize] = 90.0;
        assert_eq!(found(rate_hz, values), Some((1, 1, 90.0)), "among taps, {rate_hz} Hz");
    }
}

#[test]
fn at_a_rate_where_a_tap_is_as_narrow_nothing_is_found() {
    for (rate_hz, expected) in [(800.0, None), (1000.0, Some((1, 1, 400.0)))] {
        let mut values = smooth_noise(rate_hz, 3.0, 2);
        values[1000] = 400.0;
        assert_eq!(found(rate_hz, values), expected);
    }
}

/// Signals without spikes.
#[test]
fn textures_are_no_glitches() {
    for rate_hz in RATES_HZ {
        let seconds = 6.0;
        let n = (seconds * rate_hz) as usize;
        let every = |step: f64| (1..(seconds / step) as u32).map(|i| f64::from(i) * step).collect::<Vec<_>>();
        let check = |what: &str, values: Vec<f64>| {
            assert_eq!(found(rate_hz, values), None, "{what} at {rate_hz} Hz");
        };
        for seed in 0..4 {
            check("white noise", lcg_noise(n, seed));
            check("smooth noise", smooth_noise(rate_hz, seconds, seed));
        }
        // Taps, bumps and gratings, on noise and on near silence.
        for (hz, decay_secs) in [(250.0, 0.0015), (180.0, 0.005), (60.0, 0.02), (400.0, 0.003)] {
            for step in [2.0, 0.5, 0.11, 0.02] {
                for (level, height) in [(1.0, 100.0), (1.0, 24.0), (0.001, 50.0)] {
                    let mut values = smooth_noise(rate_hz, seconds, 5);
                    for value in &mut values {
                        *value *= level;
                    }
                    ring(&mut values, rate_hz, &every(step), height, (hz, decay_secs));
                    check(&format!("taps of {hz} Hz, {decay_secs} s, every {step} s, {height}"), values);
                }
            }
        }
        // Impulses of a grating without ringing.
        for step in [0.1, 0.02] {
            let mut values = smooth_noise(rate_hz, seconds, 6);
            for time in every(step) {
                values[(time * rate_hz) as usize] += 80.0;
            }
            check("a grating of impulses", values);
        }
        // A stroke of 0.1 s in silence, and strokes of varying level.
        let stroke = |i: usize| if (n / 2..n / 2 + n / 60).contains(&i) { 30.0 } else { 0.01 };
        check(
            "one stroke",
            smooth_noise(rate_hz, seconds, 7).iter().enumerate().map(|(i, v)| v * stroke(i)).collect(),
        );
        let swell = |i: usize| (TAU * 1.5 * i as f64 / rate_hz).sin().abs().powi(3) + 1e-3;
        check("swelling strokes", lcg_noise(n, 8).iter().enumerate().map(|(i, v)| v * swell(i)).collect());
        check("a coarse converter", lcg_noise(n, 9).iter().map(|v| (0.7 * v).round()).collect());
    }
}

/// Heavy-tailed noise: all heights between the noise level and the maximum occur.
#[test]
fn heavy_tails_are_no_glitches() {
    let mut n_without_variance = 0;
    for (i, rate_hz) in RATES_HZ.into_iter().enumerate() {
        for seed in 0..6 {
            let mut rng = Random::new(100 * i as u64 + seed);
            let n = (5.0 * rate_hz) as usize;
            let laplace: Vec<f64> = (0..n)
                .map(|_| {
                    let u = 2.0 * rng.uniform() - 1.0;
                    -u.signum() * (1.0 - u.abs()).max(f64::MIN_POSITIVE).ln()
                })
                .collect();
            let speckle: Vec<f64> = (0..n).map(|_| rng.log_normal(1.0) * rng.normal()).collect();
            let student = |rng: &mut Random, freedom: u32| {
                let squares: f64 = (0..freedom).map(|_| rng.normal().powi(2)).sum();
                rng.normal() / (squares / f64::from(freedom)).sqrt()
            };
            let three: Vec<f64> = (0..n).map(|_| student(&mut rng, 3)).collect();
            let two: Vec<f64> = (0..n).map(|_| student(&mut rng, 2)).collect();
            for (what, values) in [("laplace", laplace), ("speckle", speckle), ("t3", three)] {
                assert_eq!(found(rate_hz, values), None, "{what} at {rate_hz} Hz, seed {seed}");
            }
            n_without_variance += found(rate_hz, two).map_or(0, |(n_rows, _, _)| n_rows);
        }
    }
    // This distribution has no finite variance: by chance one of 24 recordings has a maximum ten times above the next
    // value.
    assert!(n_without_variance <= 1, "{n_without_variance} rows");
}
