use std::f64::consts::TAU;

use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

use super::{HapticOutline, STEP_SECS, highest_amplitude_mps2, simplified};
use crate::maths::rng::lcg_noise;
use crate::units::Hertz;

const RATE: Hertz = Hertz(2000.0);

fn sine(seconds: f64, amplitude: f64, hz: f64, rate: Hertz) -> Vec<f32> {
    let n = (seconds * rate.0).round() as usize;
    (0..n).map(|i| (amplitude * (TAU * hz * i as f64 / rate.0 + 0.3).sin()) as f32).collect()
}

/// The closed form: a sine has its own amplitude and frequency.
#[test]
fn a_sine_has_its_amplitude_and_its_frequency() {
    for rate in [Hertz(1000.0), Hertz(4410.0), Hertz(8000.0)] {
        for (amplitude, hz) in [(2.0, 60.0), (0.01, 73.3), (5.0, 150.0), (1.0, 222.2), (1.0, 300.0)] {
            let outline = HapticOutline::of(&sine(0.3, amplitude, hz, rate), rate, &[]);
            assert_eq!(outline.points.len(), 61);
            assert!((outline.seconds() - 0.3).abs() < 1e-9);
            for point in &outline.points {
                // The window has at least one and a half periods: the ripple of the Hann window is below 1 %, and its bins
                // are symmetric but for the bins of negative frequencies.
                assert!((point.amplitude_mps2 / amplitude - 1.0).abs() < 0.01, "{hz} Hz: {point:?}");
                assert!((point.frequency.0 - hz).abs() < 0.5, "{hz} Hz: {point:?}");
            }
            assert!((outline.highest_mps2() / amplitude - 1.0).abs() < 0.01);
            let samples = sine(0.3, amplitude, hz, rate);
            assert_eq!(highest_amplitude_mps2(&samples, rate, false), outline.highest_mps2());
            assert!(
                outline.onsets.is_empty(),
                "a sine that is there from the first sample on does not begin"
            );
        }
    }
}

#[test]
fn the_outline_follows_the_signal() {
    let mut samples = sine(0.5, 1.0, 80.0, RATE);
    samples.extend(sine(0.5, 3.0, 240.0, RATE));
    let points = HapticOutline::of(&samples, RATE, &[]).points;
    let at = |secs: f64| points[(secs / STEP_SECS).round() as usize];
    for (secs, amplitude, hz) in [(0.1, 1.0, 80.0), (0.4, 1.0, 80.0), (0.6, 3.0, 240.0), (0.9, 3.0, 240.0)] {
        let point = at(secs);
        assert!((point.amplitude_mps2 / amplitude - 1.0).abs() < 0.01, "{point:?}");
        assert!((point.frequency.0 - hz).abs() < 0.5, "{point:?}");
    }
}

#[test]
fn white_noise_has_its_level_and_half_the_nyquist_frequency() {
    let noise: Vec<f32> = lcg_noise(20_000, 5).into_iter().map(|x| x as f32).collect();
    let points = HapticOutline::of(&noise, RATE, &[]).points;
    let n = points.len() as f64;
    let power = points.iter().map(|point| point.amplitude_mps2.powi(2) / 2.0).sum::<f64>() / n;
    let of_samples = noise.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / noise.len() as f64;
    // The windows overlap completely, so only the ends are weighted otherwise.
    assert!((power / of_samples - 1.0).abs() < 0.02, "{power} {of_samples}");
    let mean_hz = points.iter().map(|point| point.frequency.0).sum::<f64>() / n;
    // The bins are those from 20 to 1000 Hz; 200 independent windows have a standard error of 4 Hz.
    assert!((mean_hz - 510.0).abs() < 15.0, "{mean_hz}");
}

#[test]
fn silence_keeps_the_frequency_before_it() {
    let mut samples = vec![0.0; 1000];
    samples.extend(sine(0.5, 1.0, 150.0, RATE));
    samples.extend(vec![0.0; 1000]);
    let points = HapticOutline::of(&samples, RATE, &[]).points;
    assert_eq!(points[20].amplitude_mps2, 0.0);
    assert!((points[20].frequency.0 - points[0].frequency.0).abs() < 1e-9);
    // The last window with signal has its end, which spreads the spectrum.
    assert!((points[points.len() - 1].frequency.0 - 150.0).abs() < 30.0, "{:?}", points[points.len() - 1]);
    let silent = HapticOutline::of(&[0.0; 500], RATE, &[0.1]);
    assert_eq!((silent.highest_mps2(), silent.onsets.len()), (0.0, 0));
    assert!(silent.points.iter().all(|point| point.frequency.0 == 0.0));
    assert_eq!(HapticOutline::of(&[], RATE, &[0.0]), HapticOutline::default());
}

/// Times of the onsets.
fn times(outline: &HapticOutline) -> Vec<f64> {
    outline.onsets.iter().map(|onset| outline.points[onset.point].time_secs).collect()
}

#[test]
fn bursts_begin_and_ramps_do_not() {
    let decaying = |t: f64| 4.0 * (-60.0 * t).exp() * (TAU * 180.0 * t).sin();
    let begins = [0.203, 0.6];
    let burst = |secs: f64| {
        begins.iter().filter(|begin| secs >= **begin).map(|begin| decaying(secs - begin)).sum::<f64>()
    };
    let samples: Vec<f32> = (0..2000).map(|i| burst(f64::from(i) / RATE.0)).map(|x| x as f32).collect();
    let outline = HapticOutline::of(&samples, RATE, &[]);
    let found = times(&outline);
    assert_eq!(found.len(), 2, "{found:?}");
    for (found, begin) in found.iter().zip(begins) {
        // A part of 10 ms has the onset somewhere in it.
        assert!((begin - 0.01..=begin).contains(found), "{found} for {begin}");
    }
    for onset in &outline.onsets {
        // The highest of the samples, near the first quarter of a period.
        assert!((onset.amplitude_mps2 - 3.7).abs() < 0.2, "{onset:?}");
        assert!((onset.frequency.0 - 180.0).abs() < 25.0, "{onset:?}");
    }
    // A level that doubles every 50 ms rises by 1.2 dB in the time of an onset.
    let ramp = |i: usize| {
        let t = i as f64 / RATE.0;
        (1e-3 * 2.0_f64.powf(t / 0.05) * (TAU * 150.0 * t).sin()) as f32
    };
    assert!(HapticOutline::of(&(0..1200).map(ramp).collect::<Vec<_>>(), RATE, &[]).onsets.is_empty());
    for seed in 1..20 {
        let noise: Vec<f32> = lcg_noise(4000, seed).into_iter().map(|x| x as f32).collect();
        assert!(HapticOutline::of(&noise, RATE, &[]).onsets.is_empty(), "steady noise, seed {seed}");
    }
}

#[test]
fn a_landing_is_an_onset_where_the_signal_is_not_silent() {
    let mut samples = vec![0.0; 1000];
    samples.extend(sine(0.5, 1.0, 150.0, RATE));
    let found = |contacts: &[f64]| times(&HapticOutline::of(&samples, RATE, contacts));
    // The rise at 0.5 s is one onset, with a landing there or without.
    assert_eq!(found(&[]).len(), 1);
    assert_eq!(found(&[0.5]).len(), 1);
    assert_eq!(found(&[0.5, 0.75]), [found(&[])[0], 0.75]);
    assert_eq!(found(&[0.1, 0.2, f64::NAN, -1.0, 99.0]), found(&[]));
}

/// A loop of noise has no seam: it has the same outline wherever it begins.
#[test]
fn the_outline_of_a_loop_has_no_seam() {
    // A level that rises, so that the two ends differ most.
    let ramp = |(i, x): (usize, f64)| (x * (0.1 + i as f64 / 2000.0)) as f32;
    let samples: Vec<f32> = lcg_noise(2000, 3).into_iter().enumerate().map(ramp).collect();
    let outline = HapticOutline::of_loop(&samples, RATE);
    let (first, last) = (outline.points[0], outline.points[outline.points.len() - 1]);
    assert_eq!((first.amplitude_mps2, first.frequency), (last.amplitude_mps2, last.frequency));
    assert_eq!(highest_amplitude_mps2(&samples, RATE, true), outline.highest_mps2());
    let open = HapticOutline::of(&samples, RATE, &[]);
    assert!(open.points[0].amplitude_mps2 < 0.5 * open.points[200].amplitude_mps2, "the ends differ");
    // Turned by 100 points, of which each fourth has a frequency of its own.
    let mut turned = samples.clone();
    turned.rotate_left(1000);
    let turned = HapticOutline::of_loop(&turned, RATE);
    for (i, point) in turned.points[..200].iter().enumerate() {
        let same = outline.points[(i + 100) % 200];
        assert!((point.amplitude_mps2 - same.amplitude_mps2).abs() < 1e-9, "{i}: {point:?} {same:?}");
        assert!((point.frequency.0 - same.frequency.0).abs() < 1e-6, "{i}: {point:?} {same:?}");
    }
    // Shorter than a window, silent, and empty.
    for n in [1, 5, 30, 300] {
        let points = HapticOutline::of_loop(&samples[..n], RATE).points;
        let (first, last) = (points[0], points[points.len() - 1]);
        assert!((first.amplitude_mps2 - last.amplitude_mps2).abs() < 1e-12, "{n}");
        assert!((first.frequency.0 - last.frequency.0).abs() < 1e-9, "{n}");
    }
    assert_eq!(HapticOutline::of_loop(&[0.0; 100], RATE).highest_mps2(), 0.0);
    assert_eq!(HapticOutline::of_loop(&[], RATE), HapticOutline::default());
}

#[test]
fn a_tap_is_an_onset_and_not_in_the_points() {
    let texture = sine(1.0, 0.01, 150.0, RATE);
    let mut samples = texture.clone();
    for (begin, amplitude) in [(600, 6.0), (1400, 0.2)] {
        for (i, sample) in samples[begin..].iter_mut().enumerate() {
            let t = i as f64 / RATE.0;
            *sample += (amplitude * (-90.0 * t).exp() * (TAU * 250.0 * t).sin()) as f32;
        }
    }
    let outline = HapticOutline::with_taps(&texture, &samples, RATE, &[0.3, 0.7]);
    assert_eq!(outline.points, HapticOutline::of(&texture, RATE, &[]).points);
    assert!((outline.highest_mps2() / 0.01 - 1.0).abs() < 0.01);
    // The weaker tap is far below the stronger one, but above the texture.
    let [strong, weak] = outline.onsets[..] else { panic!("{:?}", outline.onsets) };
    assert!(strong.amplitude_mps2 > 4.0 && (0.1..0.2).contains(&weak.amplitude_mps2), "{strong:?} {weak:?}");
    assert!(strong.frequency.0 > 200.0, "the frequency of the tap: {strong:?}");
    let silent = HapticOutline::with_taps(&[0.0; 2000], &samples, RATE, &[0.3]);
    assert!(silent.highest_mps2() == 0.0 && !silent.onsets.is_empty());
}

/// A line through the kept points at a time.
fn line_at(times: &[f64], values: &[f64], kept: &[usize], secs: f64) -> f64 {
    let next = kept.partition_point(|point| times[*point] <= secs).clamp(1, kept.len() - 1);
    let (from, to) = (kept[next - 1], kept[next]);
    let share = (secs - times[from]) / (times[to] - times[from]);
    values[from] + share * (values[to] - values[from])
}

#[test]
fn straight_lines_need_two_points_and_corners_one_each() {
    let times: Vec<f64> = (0..100).map(f64::from).collect();
    let line: Vec<f64> = times.iter().map(|t| 3.0 - 0.25 * t).collect();
    assert_eq!(simplified(&times, &[(&line, 1e-9)], &[]), [0, 99]);
    let corner: Vec<f64> = times.iter().map(|t| (t - 40.0).abs()).collect();
    assert_eq!(simplified(&times, &[(&corner, 1e-9)], &[]), [0, 40, 99]);
    assert_eq!(simplified(&times, &[(&line, 1e-9), (&corner, 1e-9)], &[7, 0, 99, 40]), [0, 7, 40, 99]);
    // The tolerance is used: a parabola with a sagitta of 1/8 of its steps squared.
    let parabola: Vec<f64> = times.iter().map(|t| t * t).collect();
    let kept = simplified(&times, &[(&parabola, 2.0)], &[]);
    assert!(kept.windows(2).all(|pair| pair[1] - pair[0] <= 4) && kept.len() < 36, "{kept:?}");
    assert_eq!(simplified(&[], &[(&[], 1.0)], &[]), Vec::<usize>::new());
    assert_eq!(simplified(&[1.0], &[(&[2.0], 1.0)], &[0]), [0]);
}

proptest! {
    /// The error of every curve is within its tolerance at every time.
    #[test]
    fn lines_stay_within_the_tolerance(
        steps in proptest::collection::vec((0.01..1.0_f64, 0.0..1.0_f64, 60.0..300.0_f64), 1..80),
        tolerance in 0.0..0.5_f64,
        kept in proptest::collection::vec(0..100_usize, 0..4),
    ) {
        let mut secs = 0.0;
        let times: Vec<f64> = steps.iter().map(|(step, _, _)| { secs += step; secs }).collect();
        let a: Vec<f64> = steps.iter().map(|(_, a, _)| *a).collect();
        let b: Vec<f64> = steps.iter().map(|(_, _, b)| *b).collect();
        let points = simplified(&times, &[(&a, tolerance), (&b, 100.0 * tolerance)], &kept);
        prop_assert!(points.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert_eq!((points[0], points[points.len() - 1]), (0, times.len() - 1));
        prop_assert!(kept.iter().all(|point| *point >= times.len() || points.contains(point)));
        if points.len() > 1 {
            for (i, secs) in times.iter().enumerate() {
                // Rounding of slopes.
                prop_assert!((line_at(&times, &a, &points, *secs) - a[i]).abs() <= tolerance + 1e-9);
                prop_assert!((line_at(&times, &b, &points, *secs) - b[i]).abs() <= 100.0 * tolerance + 1e-7);
            }
        }
    }

    /// A louder signal has the same outline, louder.
    #[test]
    fn the_outline_scales_with_the_signal(seed in 1..1000_u64, gain in 0.01..100.0_f32) {
        let noise: Vec<f32> = lcg_noise(300, seed).into_iter().map(|x| x as f32).collect();
        let loud: Vec<f32> = noise.iter().map(|x| gain * x).collect();
        let (quiet, loud) = (HapticOutline::of(&noise, RATE, &[0.05]), HapticOutline::of(&loud, RATE, &[0.05]));
        for (quiet, loud) in quiet.points.iter().zip(&loud.points) {
            // Rounding of 32-bit samples.
            prop_assert!((loud.amplitude_mps2 / quiet.amplitude_mps2 / f64::from(gain) - 1.0).abs() < 1e-5);
            prop_assert!((loud.frequency.0 - quiet.frequency.0).abs() < 0.01);
        }
        prop_assert_eq!(quiet.onsets.len(), loud.onsets.len());
    }

    #[test]
    fn any_signal_has_an_outline(
        samples in proptest::collection::vec(any::<i16>(), 0..200),
        hz in 100.0..100_000.0_f64,
        contacts in proptest::collection::vec(any::<f64>(), 0..4),
    ) {
        let samples: Vec<f32> = samples.into_iter().map(f32::from).collect();
        let outline = HapticOutline::of(&samples, Hertz(hz), &contacts);
        prop_assert_eq!(outline.points.is_empty(), samples.is_empty());
        let is_finite = outline.points.iter().all(|p| p.amplitude_mps2.is_finite() && p.frequency.0.is_finite());
        prop_assert!(is_finite);
        prop_assert!(outline.points.windows(2).all(|pair| pair[0].time_secs < pair[1].time_secs));
        prop_assert!(outline.onsets.iter().all(|onset| onset.point < outline.points.len()));
    }
}
