use crate::maths::rng::{Random, lcg_noise};
use crate::recording::{
    Fault, Finding, RawClock, RawMotion, RawRecording, RawTrack, Recording, RecordingError, check_clock,
};
use crate::units::Hertz;
use proptest::prelude::{any, prop_assert, proptest};
use std::f64::consts::TAU;

const RATE_HZ: f64 = 1000.0;

/// White noise on one axis at constant speed and force.
fn noise(n_rows: usize, clock: RawClock) -> RawRecording {
    RawRecording {
        clock,
        acceleration_mps2: vec![lcg_noise(n_rows, 7)],
        motion: RawMotion::Speed(RawTrack::Constant(0.1)),
        force_n: RawTrack::Constant(1.0),
        full_scale_mps2: None,
    }
}

fn times(n_rows: usize) -> Vec<f64> {
    (0..n_rows).map(|row| 5.0 + row as f64 / RATE_HZ).collect()
}

fn read(raw: RawRecording) -> (Recording, Vec<&'static str>) {
    let (recording, findings) = Recording::from_raw(raw).expect("a recording");
    let names = findings.iter().filter(|f| f.name() != "constant").map(Finding::name).collect();
    (recording, names)
}

#[track_caller]
fn check_findings(raw: RawRecording, expected: &[&str], usable_secs: f64) -> Recording {
    let (recording, names) = read(raw);
    assert_eq!(names, expected);
    // A drifting clock gets one rate for the whole recording, and its mean step differs from its usual step.
    let share = recording.usable_seconds() / usable_secs - 1.0;
    assert!(share.abs() < 2e-3, "{} s", recording.usable_seconds());
    for (i, value) in recording.acceleration_mps2.iter().enumerate() {
        let inside = recording.usable.iter().any(|range| range.contains(&i));
        assert_eq!(value.is_finite(), inside, "sample {i}");
    }
    recording
}

fn fault_names(raw: RawRecording) -> Vec<&'static str> {
    let RecordingError { faults, .. } = Recording::from_raw(raw).expect_err("no recording");
    faults.iter().map(Fault::name).collect()
}

fn at_times(edit: impl Fn(&mut Vec<f64>)) -> RawRecording {
    let mut times = times(2000);
    edit(&mut times);
    noise(2000, RawClock::Times(times))
}

#[test]
fn a_regular_clock_stays_as_it_is() {
    let raw = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    let acceleration = raw.acceleration_mps2[0].clone();
    let by_rate = check_findings(raw, &[], 2.0);
    let by_times = check_findings(at_times(|_| ()), &[], 2.0);
    assert_eq!(by_times, by_rate);
    let off = by_rate.acceleration_mps2.iter().zip(&acceleration).map(|(a, b)| (a - b).abs());
    // One axis through a Fourier transform and back.
    assert!(off.fold(0.0, f64::max) < 1e-12);
    assert_eq!((by_rate.speed_mps[5], by_rate.force_n[5], by_rate.rate.0), (0.1, 1.0, RATE_HZ));
    // Timestamps of an 800 Hz clock, rounded to tenths of a millisecond, count as regular.
    let rounded = at_times(|times| {
        for (row, time) in times.iter_mut().enumerate() {
            *time = (row as f64 * 12.5).round() * 1e-4;
        }
    });
    assert!((check_findings(rounded, &[], 2.5).rate.0 - 800.0).abs() < 0.1);
}

#[test]
fn what_is_odd_in_the_clock_is_said_and_left_out() {
    check_findings(at_times(|t| t[500] = t[499]), &["repeated timestamps", "gaps"], 1.999);
    check_findings(at_times(|t| t[500] = t[400]), &["backward timestamps", "gaps"], 1.999);
    check_findings(at_times(|t| t[500] = f64::NAN), &["not a number", "gaps"], 1.999);
    let with_gap = at_times(|t| t[1000..].iter_mut().for_each(|time| *time += 0.7));
    let recording = check_findings(with_gap, &["gaps"], 2.0);
    assert_eq!(recording.usable, [0..1000, 1700..2700]);
    let drifting = (0..8000).map(|row| f64::from(row) * (1.0 + 2e-7 * f64::from(row)) / RATE_HZ).collect();
    check_findings(noise(8000, RawClock::Times(drifting)), &["clock drift"], 8.0);
}

#[test]
fn too_bad_a_clock_is_an_error_by_name() {
    let twice = at_times(|t| (0..2000).for_each(|row| t[row] = (row / 2) as f64 * 0.002));
    let bursts =
        at_times(|t| (0..2000).for_each(|row| t[row] = (row / 9) as f64 * 0.09 + (row % 9) as f64 * 5e-5));
    let mut rng = Random::new(3);
    let mut at = 0.0;
    let chance: Vec<f64> = (0..2000)
        .map(|_| {
            at -= 1e-3 * rng.uniform().ln();
            at
        })
        .collect();
    let ends = at_times(|t| t[1999] = 1e12);
    for (clock, words) in [
        (twice, "50 % of the rows"),
        (bursts, "sampling intervals are too irregular"),
        (noise(2000, RawClock::Times(chance)), "bad clock"),
        (ends, "cannot last"),
    ] {
        let message = Recording::from_raw(clock).expect_err("no clock").to_string();
        assert!(message.contains("bad clock") && message.contains(words), "{message}");
    }
    assert_eq!(fault_names(noise(2000, RawClock::Rate(Hertz(f64::NAN)))), ["rate too high"]);
    assert_eq!(fault_names(noise(2000, RawClock::Rate(Hertz(96_000.0)))), ["rate too high"]);
}

#[test]
fn all_faults_are_told_at_once() {
    let mut raw = noise(1000, RawClock::Rate(Hertz(100.0)));
    raw.motion = RawMotion::Speed(RawTrack::Missing);
    raw.force_n = RawTrack::Missing;
    let message = Recording::from_raw(raw.clone()).expect_err("three faults").to_string();
    assert!(message.contains("rate too low: 100 Hz, a model needs at least 500 Hz"), "{message}");
    assert_eq!(fault_names(raw.clone()), ["no speed", "no force", "rate too low"]);
    raw.acceleration_mps2 = Vec::new();
    assert_eq!(fault_names(raw), ["no acceleration", "no speed", "no force", "rate too low"]);
    let mut raw = noise(1000, RawClock::Rate(Hertz(RATE_HZ)));
    raw.force_n = RawTrack::Column(vec![1.0; 999]);
    raw.motion = RawMotion::Speed(RawTrack::Constant(f64::NAN));
    assert_eq!(fault_names(raw), ["bad constant", "unequal columns"]);
    assert_eq!(fault_names(noise(1, RawClock::Rate(Hertz(RATE_HZ)))), ["too few rows"]);
    assert_eq!(check_clock(&RawClock::Rate(Hertz(100.0))).1, [Fault::RateTooLow { rate_hz: 100.0 }]);
}

fn with_axis(edit: impl Fn(&mut Vec<f64>)) -> RawRecording {
    let mut raw = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    edit(&mut raw.acceleration_mps2[0]);
    raw
}

#[test]
fn stuck_clipped_and_missing_rows_are_left_out() {
    let stuck = || with_axis(|axis| axis[300..500].fill(0.25));
    let recording = check_findings(stuck(), &["stuck sensor"], 1.8);
    assert_eq!(recording.usable, [0..300, 500..2000]);
    // A sensor on a lifted tip may well be constant.
    let mut lifted = stuck();
    let force = (0..2000).map(|row| if (290..510).contains(&row) { 0.0 } else { 1.0 }).collect();
    lifted.force_n = RawTrack::Column(force);
    check_findings(lifted, &[], 2.0);
    check_findings(with_axis(|axis| axis[300] = f64::NAN), &["not a number"], 1.999);
    // A 3 m/s² oscillation on a sensor with a range of 2.5 m/s².
    let clipped = with_axis(|axis| {
        for (row, value) in axis.iter_mut().enumerate() {
            *value = (3.0 * (TAU * 10.0 * row as f64 / RATE_HZ).sin() + 0.01 * *value).clamp(-2.5, 2.5);
        }
    });
    let (recording, names) = read(clipped);
    // The parts between the clipped peaks are too short.
    assert_eq!(names, ["clipping", "fragments"]);
    assert!(recording.usable_seconds() < 1.5 && recording.usable_seconds() > 1.0);
    // A silent recording is no texture.
    let silence = Recording::from_raw(with_axis(|axis| axis.fill(0.0))).expect_err("silence");
    assert_eq!((silence.faults[0].name(), silence.findings[0].name()), ("no signal", "dead axis"));
}

#[test]
fn coarse_converters_and_gravity_are_neither_stuck_nor_clipped() {
    // Eight converter steps from peak to peak, plus gravity.
    check_findings(with_axis(|axis| axis.iter_mut().for_each(|v| *v = v.round() + 9.8)), &[], 2.0);
    // A slow oscillation repeats values at its rounded peaks.
    let swing = |row: usize| (40.0 * (TAU * 2.0 * row as f64 / RATE_HZ).sin()).round();
    check_findings(with_axis(|axis| (0..2000).for_each(|row| axis[row] = swing(row))), &[], 2.0);
}

#[test]
fn values_that_are_held_tell_the_true_rate() {
    let held = |every: usize| with_axis(|axis| (0..2000).for_each(|row| axis[row] = axis[row - row % every]));
    check_findings(held(2), &["repeated values"], 2.0);
    let error = Recording::from_raw(held(10)).expect_err("100 Hz");
    assert_eq!(error.faults, [Fault::RateTooLow { rate_hz: 100.0 }]);
}

#[test]
fn axes_are_combined_and_dead_ones_left_out() {
    let mut raw = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    raw.acceleration_mps2 = vec![lcg_noise(2000, 1), lcg_noise(2000, 2), vec![0.0; 2000]];
    let energy: f64 = raw.acceleration_mps2.iter().flatten().map(|v| v * v).sum();
    let recording = check_findings(raw, &["dead axis", "axes combined"], 2.0);
    let combined: f64 = recording.acceleration_mps2.iter().map(|v| v * v).sum();
    // Energy is restored above 10 Hz; the mean and slower changes of white noise are a small part of it.
    assert!((combined / energy - 1.0).abs() < 0.005, "{combined} for {energy}");
}

#[test]
fn speeds_follow_from_positions_and_lose_their_sign() {
    let mut raw = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    raw.motion = RawMotion::Speed(RawTrack::Column(vec![-0.2; 2000]));
    assert_eq!(check_findings(raw.clone(), &["signed speed"], 2.0).speed_mps[7], 0.2);
    raw.motion = RawMotion::Positions(vec![(0..2000).map(|row| 1e-4 * f64::from(row)).collect()]);
    let recording = check_findings(raw, &["speed from positions"], 2.0);
    assert!(recording.speed_mps.iter().all(|speed| (speed - 0.1).abs() < 1e-9));
}

#[test]
fn speed_and_force_of_slower_sensors_are_on_lines_between_their_values() {
    let slow = |every: usize, value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..2001).map(|row| if row % every == 0 { value(row) } else { f64::NAN }).collect()
    };
    let mut raw = noise(2001, RawClock::Rate(Hertz(RATE_HZ)));
    raw.motion = RawMotion::Speed(RawTrack::Column(slow(10, &|row| 1e-4 * row as f64)));
    raw.force_n = RawTrack::Column(slow(8, &|_| 1.5));
    let recording = check_findings(raw.clone(), &["slower track", "slower track"], 2.001);
    for (row, speed) in recording.speed_mps.iter().enumerate() {
        assert!((speed - 1e-4 * row as f64).abs() < 1e-12, "row {row} is {speed}");
    }
    assert!(recording.force_n.iter().all(|force| *force == 1.5));
    raw.motion = RawMotion::Positions(vec![slow(10, &|row| 1e-4 * row as f64)]);
    let recording =
        check_findings(raw.clone(), &["slower track", "slower track", "speed from positions"], 2.001);
    assert!(recording.speed_mps.iter().all(|speed| (speed - 0.1).abs() < 1e-9));
    // Values that are too sparse are not interpolated.
    raw.force_n = RawTrack::Column(slow(100, &|_| 1.5));
    assert_eq!(fault_names(raw), ["nothing usable"]);
}

#[test]
fn glitches_are_left_out_and_do_not_hide_what_is_clipped() {
    let recording = check_findings(with_axis(|axis| axis[300] = -250.0), &["spikes"], 1.999);
    assert_eq!(recording.usable, [0..300, 301..2000]);
    // A 3 m/s² oscillation on a sensor with a range of 2.5 m/s², and a spike beyond.
    let clipped = with_axis(|axis| {
        for (row, value) in axis.iter_mut().enumerate() {
            *value = (3.0 * (TAU * 10.0 * row as f64 / RATE_HZ).sin() + 0.01 * *value).clamp(-2.5, 2.5);
        }
        axis[1000] = 900.0;
    });
    assert_eq!(read(clipped).1, ["spikes", "clipping", "fragments"]);
    // Findings name each axis.
    let mut three = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    three.acceleration_mps2 = (1..4).map(|seed| lcg_noise(2000, seed)).collect();
    three.acceleration_mps2.iter_mut().for_each(|axis| axis[700] = 99.0);
    check_findings(three, &["spikes", "spikes", "spikes", "axes combined"], 1.999);
    let (_, findings) = Recording::from_raw(with_axis(|axis| axis[300] = -250.0)).expect("a recording");
    let said = findings[0].to_string();
    for words in [
        "1 electrical glitch",
        "acceleration, up to -250.0 m/s²",
        "1 of 2000 rows, first at 0.300 s",
        "left out",
    ] {
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn values_that_cannot_be_are_left_out() {
    check_findings(with_axis(|axis| axis[300] = 1e308), &["impossible values"], 1.999);
}

proptest! {
    #[test]
    fn a_sine_on_a_jittered_clock_comes_back(
        seed in any::<u64>(),
        frequency_hz in 20.0..250.0_f64,
        jitter in 0.05..0.2_f64,
    ) {
        let mut rng = Random::new(seed);
        let mut times = times(1500);
        for time in &mut times {
            *time += jitter * (2.0 * rng.uniform() - 1.0) / RATE_HZ;
        }
        let sine = |secs: f64| (TAU * frequency_hz * secs).sin();
        let mut raw = noise(1500, RawClock::Times(times.clone()));
        raw.acceleration_mps2 = vec![times.iter().map(|time| sine(*time)).collect()];
        let start = times[0];
        let (recording, names) = read(raw);
        prop_assert!(names.contains(&"irregular timestamps"), "{names:?}");
        prop_assert!((recording.rate.0 / RATE_HZ - 1.0).abs() < 1e-3);
        prop_assert!(recording.usable_seconds() > 1.45);
        let mut worst = 0.0_f64;
        for sample in recording.usable.iter().cloned().flatten() {
            let expected = sine(start + sample as f64 / recording.rate.0);
            worst = worst.max((recording.acceleration_mps2[sample] - expected).abs());
        }
        // Error bound of the polynomial; uninterpolated rows would have an error of up to 2 pi f times the jitter,
        // 0.31.
        prop_assert!(worst < 5e-3, "{worst} at {frequency_hz} Hz, jitter {jitter}");
    }
}

#[test]
fn a_dead_axis_may_lack_cells() {
    let mut raw = noise(2000, RawClock::Rate(Hertz(RATE_HZ)));
    let mut dead = vec![0.5; 2000];
    dead[700] = f64::NAN;
    raw.acceleration_mps2.push(dead);
    check_findings(raw, &["dead axis"], 2.0);
}

#[test]
fn times_that_are_no_numbers_are_a_fault() {
    assert_eq!(fault_names(at_times(|times| times.fill(f64::NAN))), ["bad clock"]);
}
