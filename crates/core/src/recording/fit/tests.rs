use super::{FitError, FitOptions, FitReport, HeldOut, fit, hull_share};
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::spectrum::{goodness_of_fit, median, rms};
use crate::maths::rng::lcg_noise;
use crate::recording::Recording;
use crate::texture::Interpolation;
use crate::texture::plane::Plane;
use crate::units::{Contact, Hertz};
use std::f64::consts::TAU;

/// Before, a recording at one speed and force covered "-0 %" of the plane.
#[test]
fn a_single_speed_and_force_covers_zero_percent() {
    let few: [&[[f64; 2]]; 3] = [&[], &[[1.0, 1.0]], &[[0.5, 0.5], [1.0, 1.0]]];
    for points in few {
        assert_eq!(format!("{:.0} %", 100.0 * hull_share(points)), "0 %");
    }
}

/// Resonances of the texture in all tests; its level follows the power law below.
const RESONANCES: [(Hertz, f64); 2] = [(Hertz(90.0), 0.97), (Hertz(230.0), 0.95)];

fn level_mps2(speed_mps: f64, force_n: f64) -> f64 {
    5.0 * speed_mps.powf(0.9) * force_n.powf(0.3)
}

/// Simulated back-and-forth strokes on a texture whose spectrum is constant.
fn strokes(rate_hz: f64, seconds: f64, seed: u64) -> Recording {
    // Poles fixed in Hz at any sample rate: radii depend on the sampling interval.
    let poles = RESONANCES.map(|(f, radius)| (f, radius.powf(1000.0 / rate_hz)));
    let ar = from_resonances(Hertz(rate_hz), &poles);
    let n = (seconds * rate_hz) as usize;
    let mut x = lcg_noise(n, seed);
    for i in 0..n {
        x[i] -= (1..=ar.len().min(i)).map(|k| ar[k - 1] * x[i - k]).sum::<f64>();
    }
    let scale = 1.0 / rms(&x);
    let contact = |i: usize| {
        let t = i as f64 / rate_hz;
        (
            (0.05 + 0.1 * (TAU * t / 9.0).sin().powi(2)) * (1.0 + 0.9 * (TAU * 0.6 * t).sin()),
            1.0 + 0.6 * (TAU * t / 7.0).sin(),
        )
    };
    let (speed_mps, force_n): (Vec<f64>, Vec<f64>) = (0..n).map(contact).unzip();
    for ((x, v), f) in x.iter_mut().zip(&speed_mps).zip(&force_n) {
        *x *= scale * level_mps2(*v, *f);
    }
    // Adds gravity and hand motion.
    let acceleration_mps2 = x.iter().zip(0..).map(|(x, i)| x + 9.81 + (TAU * f64::from(i) / rate_hz).sin());
    Recording {
        rate: Hertz(rate_hz),
        acceleration_mps2: acceleration_mps2.collect(),
        speed_mps,
        force_n,
        usable: std::iter::once(0..n).collect(),
    }
}

#[track_caller]
fn check(rate_hz: f64, model_hz: f64) {
    let fitted = fit(&[strokes(rate_hz, 15.0, 3)], &FitOptions::usual()).unwrap();
    let report = &fitted.report;
    assert_eq!(report.rate, Hertz(model_hz), "of {rate_hz} Hz");
    // 15 s contain about 3 s near each speed and force: spectra agree to 0.9 with their own model.
    assert_eq!(report.held_out, HeldOut::Segments);
    assert!(report.gfc_median() > 0.88, "{}", report.gfc_median());
    assert!(report.level_error_db_median() < 1.2, "{}", report.level_error_db_median());
    assert_eq!(report.frequencies.len(), report.segments[0].comparison.model_psd.len());
    // Compares with the true model, within the range of the strokes.
    let frequencies: Vec<Hertz> = (10..390).map(|f| Hertz(f64::from(f))).collect();
    let poles = RESONANCES.map(|(f, radius)| (f, radius.powf(1000.0 / rate_hz)));
    let truth =
        crate::dsp::ar::psd(&from_resonances(Hertz(rate_hz), &poles), 1.0, Hertz(rate_hz), &frequencies);
    let plane = Plane::new(&fitted.model);
    for contact in [(80.0, 1.0), (120.0, 0.8), (60.0, 1.3)] {
        let grain = plane.at(Contact::from_mm_per_s_and_n(contact.0, contact.1));
        // 15 minutes of strokes would give 0.999; a few seconds blur and shift the peaks by some hertz.
        let gfc = goodness_of_fit(&grain.psd(&frequencies), &truth);
        assert!(gfc > 0.93, "{gfc} at {contact:?}, {rate_hz} Hz");
        let error_db = 20.0 * (grain.level_mps2 / level_mps2(1e-3 * contact.0, contact.1)).log10();
        assert!(error_db.abs() < 1.2, "{error_db} dB at {contact:?}, {rate_hz} Hz");
    }
}

#[test]
fn strokes_of_any_rate_give_back_their_texture() {
    for rate_hz in [1000.0, 2500.0, 8000.0, 44_100.0] {
        check(rate_hz, 1000.0);
    }
    check(800.0, 800.0);
}

/// A gain that is changed halfway is said, with its place; strokes at changing speeds and forces alone are not.
#[test]
fn a_jump_of_the_level_is_said() {
    let notes = |gain: f64| {
        let mut recording = strokes(1000.0, 15.0, 3);
        for x in &mut recording.acceleration_mps2[5000..] {
            *x = 9.81 + gain * (*x - 9.81);
        }
        fit(&[recording], &FitOptions::usual()).unwrap().report.notes.join(" ")
    };
    let said = notes(6.0);
    assert!(said.contains("The level rises by 1") && said.contains(" dB near 5."), "{said}");
    assert!(!notes(1.0).contains("The level"), "{}", notes(1.0));
}

#[test]
fn the_band_decides_the_rate() {
    let mut wide = strokes(8000.0, 6.0, 1);
    for (a, e) in wide.acceleration_mps2.iter_mut().zip(lcg_noise(48_000, 8)) {
        *a += 2.0 * e;
    }
    assert_eq!(fit(&[wide.clone()], &FitOptions::usual()).unwrap().report.rate, Hertz(4000.0));
    let asked = FitOptions { rate: Some(Hertz(1500.0)), order: Some(7), ..FitOptions::usual() };
    let report = fit(&[wide], &asked).unwrap().report;
    assert_eq!((report.rate, report.order), (Hertz(1500.0), 7));
}

#[test]
fn the_interpolation_that_was_asked_for_is_fitted_and_compared() {
    let recording = strokes(1000.0, 12.0, 2);
    let [triangles, radial] = [Interpolation::Barycentric, Interpolation::RadialBasis].map(|interpolation| {
        let options = FitOptions { interpolation, ..FitOptions::usual() };
        let fitted = fit(std::slice::from_ref(&recording), &options).unwrap();
        assert_eq!(fitted.model.interpolation(), Some(interpolation));
        fitted.report
    });
    assert_eq!(triangles.segments.len(), radial.segments.len());
    // The same nodes, but another interpolation between them.
    let level = |report: &FitReport| report.level_error_db_median();
    assert!((level(&triangles) - level(&radial)).abs() > 1e-6);
    assert!(radial.gfc_median() > 0.85 && level(&radial) < 1.4, "{} {}", radial.gfc_median(), level(&radial));
}

/// A simulated stroke at one speed and force on a surface with ten sharp resonances, each driven by its own noise.
fn resonant(seconds: f64) -> Recording {
    const RESONANCES: [(f64, f64); 10] = [
        (28.0, 0.988),
        (47.0, 0.985),
        (66.0, 0.982),
        (91.0, 0.985),
        (120.0, 0.98),
        (150.0, 0.982),
        (190.0, 0.977),
        (240.0, 0.977),
        (300.0, 0.97),
        (370.0, 0.97),
    ];
    let n = (1000.0 * seconds) as usize;
    let mut sum = vec![0.0; n];
    for ((hz, radius), seed) in RESONANCES.into_iter().zip(2..) {
        let ar = from_resonances(Hertz(1000.0), &[(Hertz(hz), radius)]);
        let mut x = lcg_noise(n, seed);
        for i in 1..n {
            x[i] -= ar[0] * x[i - 1] + if i > 1 { ar[1] * x[i - 2] } else { 0.0 };
        }
        let scale = 1.0 / rms(&x);
        sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += scale * x);
    }
    Recording {
        rate: Hertz(1000.0),
        acceleration_mps2: sum,
        speed_mps: vec![0.1; n],
        force_n: vec![1.0; n],
        usable: std::iter::once(0..n).collect(),
    }
}

/// Before, orders ended at 20 at 1 kHz, and a comparison of two segments was one with what the model was fitted to.
#[test]
fn sharp_resonances_are_kept_and_few_segments_are_held_out_in_blocks() {
    let fitted = |order| {
        let options = FitOptions { order, ..FitOptions::usual() };
        let report = fit(&[resonant(2.1)], &options).unwrap().report;
        assert_eq!((report.held_out, report.segments.len()), (HeldOut::Blocks, 3));
        (report.order, report.gfc_median())
    };
    let (_, smeared) = fitted(Some(20));
    let (order, sharp) = fitted(None);
    // A reference computation gives 0.82 for order 20, and order 40 with 0.96.
    assert!(smeared < 0.86, "{smeared}");
    assert!(order >= 32 && sharp > 0.93, "order {order}: {sharp}");
}

#[test]
fn a_stroke_too_short_to_divide_is_compared_with_its_own_model() {
    let report = fit(&[resonant(0.6)], &FitOptions::usual()).unwrap().report;
    assert_eq!((report.held_out, report.segments.len()), (HeldOut::Nothing, 1));
    assert!(!report.held_out.is_any() && (10..=20).contains(&report.order), "{}", report.order);
}

#[test]
fn several_recordings_are_one_texture() {
    let both = fit(&[strokes(1000.0, 8.0, 1), strokes(2500.0, 8.0, 2)], &FitOptions::usual()).unwrap();
    assert!([0, 1].iter().all(|r| both.report.segments.iter().any(|s| s.recording == *r)));
    assert!(both.report.coverage > 0.2 && both.report.coverage <= 1.0);
    assert_eq!(both.report.tap, None);
}

#[test]
fn what_a_held_out_model_cannot_know_it_does_not_get_right() {
    // Negative control of the cross-validation: fast strokes have another texture. If all of them lie in one fold, the
    // model compared with them was fitted without them. If they lie in every fold, it was fitted to some of them.
    let fastest_gfc = |is_fast: fn(usize) -> bool| {
        let mut r = strokes(1000.0, 16.0, 1);
        let mut other = lcg_noise(16_000, 5);
        let ar = from_resonances(Hertz(1000.0), &[(Hertz(400.0), 0.97)]);
        for i in 2..other.len() {
            other[i] -= ar[0] * other[i - 1] + ar[1] * other[i - 2];
        }
        let scale = 1.0 / rms(&other);
        for (i, other) in other.into_iter().enumerate() {
            let speed_mps = if is_fast(i) { 0.25 } else { 0.05 };
            let usual = (r.acceleration_mps2[i] - 9.81) / level_mps2(r.speed_mps[i], r.force_n[i]);
            let grain = if is_fast(i) { scale * other } else { usual };
            r.acceleration_mps2[i] = 9.81 + level_mps2(speed_mps, 1.0) * grain;
            (r.speed_mps[i], r.force_n[i]) = (speed_mps, 1.0);
        }
        let report = fit(&[r], &FitOptions::usual()).unwrap().report;
        let fast = report.segments.iter().filter(|s| s.speed.0 > 0.2);
        median(fast.map(|s| s.comparison.gfc).collect())
    };
    // A fold is a tenth of each half: fast strokes in the fourth tenth of both halves, or in every fold.
    let unseen = fastest_gfc(|i| (2600..3000).contains(&(i % 8000)));
    let seen = fastest_gfc(|i| (i % 800) < 200);
    assert!(unseen < 0.5 && seen > 0.88, "{unseen} and {seen}");
}

#[test]
fn what_makes_no_texture_says_why() {
    let good = strokes(1000.0, 4.0, 1);
    let check = |change: &dyn Fn(&mut Recording), word: &str| {
        let mut r = good.clone();
        change(&mut r);
        let message = fit(&[r], &FitOptions::usual()).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    };
    assert_eq!(fit(&[], &FitOptions::usual()), Err(FitError::Empty));
    check(&|r| r.usable.clear(), "usable");
    check(&|r| r.force_n.fill(0.01), "force never exceeds 0.010 N");
    check(&|r| r.speed_mps.iter_mut().for_each(|v| *v *= 1e-3), "unit of the speed column");
    check(&|r| r.acceleration_mps2.fill(0.0), "acceleration column");
    check(&|r| r.acceleration_mps2[2000] = f64::NAN, "row 2000");
    check(&|r| r.rate = Hertz(100.0), "at least 500");
    check(&|r| _ = r.force_n.pop(), "differ in length");
    let jumps = |r: &mut Recording| {
        for (i, v) in r.speed_mps.iter_mut().enumerate() {
            *v = if (i / 40) % 2 == 0 { 0.05 } else { 0.2 };
        }
    };
    check(&jumps, "more evenly");
    let asked =
        |rate, order| fit(std::slice::from_ref(&good), &FitOptions { rate, order, ..FitOptions::usual() });
    assert!(matches!(asked(Some(Hertz(2000.0)), None), Err(FitError::RateAsked { .. })));
    assert!(matches!(asked(None, Some(65)), Err(FitError::OrderAsked { order: 65, highest: 64 })));
}
