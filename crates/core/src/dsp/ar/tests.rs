use super::test_signals::from_resonances;
use super::{ArError, burg, comparison_frequencies, order_by_bic, power_gain, psd, step_down, yule_walker};
use crate::dsp::lsf::{ar_from_lsf, lsf_from_ar};
use crate::maths::rng::lcg_noise;
use crate::units::Hertz;
use serde_json::Value;

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../../../vectors/a_ar/ar_vectors.json")).unwrap()
}

fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[track_caller]
fn check(actual: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(actual.len(), expected.len());
    for (i, (a, e)) in actual.iter().zip(expected).enumerate() {
        assert!((a - e).abs() < tolerance, "[{i}] got {a}, expected {e}");
    }
}

/// Signal that the golden vectors were computed from.
fn realization() -> Vec<f64> {
    let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
    let e: Vec<f64> = lcg_noise(7000, 12345).iter().map(|v| v * 0.25_f64.sqrt()).collect();
    let mut x = vec![0.0; e.len()];
    for n in 0..e.len() {
        x[n] = e[n] - (1..=4.min(n)).map(|k| a[k - 1] * x[n - k]).sum::<f64>();
    }
    x.split_off(2000)
}

#[test]
fn golden_true_model() {
    let v = &vectors()["true"];
    let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
    check(&a, &floats(&v["a"])[1..], 1e-12);
    check(&[0.25 * power_gain(&a)], &[v["power"].as_f64().unwrap()], 1e-12);
}

#[test]
fn golden_noise() {
    // Same operations in the same order: only the last bit of logarithm, sine and cosine may differ.
    check(&lcg_noise(8, 12345), &floats(&vectors()["noise_first8"]), 1e-14);
}

/// Reflection coefficients of a predictor, by the step-down recursion.
fn reflections(ar: &[f64]) -> Vec<f64> {
    let mut a = ar.to_vec();
    let mut out = Vec::new();
    while let Some(k) = a.pop() {
        out.push(k);
        let reversed: Vec<f64> = a.iter().rev().copied().collect();
        for (a, r) in a.iter_mut().zip(&reversed) {
            *a = (*a - k * r) / (1.0 - k * k);
        }
    }
    out.reverse();
    out
}

#[test]
fn golden_fits() {
    let (v, x) = (vectors(), realization());
    check(&x[..8], &floats(&v["x_first8"]), 1e-12);
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let variance = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / x.len() as f64;
    check(&[variance], &[v["x_var"].as_f64().unwrap()], 1e-12);
    for (name, fit) in [("yule_walker", yule_walker as fn(&[f64], usize) -> _), ("burg", burg)] {
        // Sums of 5000 products have rounding errors of about 1e-13; conditioning at order 20 costs two digits.
        let four = fit(&x, 4).unwrap();
        let golden = &v[format!("{name}_p4")];
        check(&four.ar, &floats(&golden["a"])[1..], 1e-11);
        check(&[four.variance], &[golden["s2"].as_f64().unwrap()], 1e-12);
        check(&reflections(&four.ar), &floats(&golden["k"]), 1e-11);
        // The reference computes polynomial roots with an accuracy of about 1e-11.
        check(&lsf_from_ar(&four.ar).unwrap(), &floats(&golden["lsf"]), 1e-10);
        let twenty = fit(&x, 20).unwrap();
        let golden = &v[format!("{name}_p20")];
        check(&[twenty.variance], &[golden["s2"].as_f64().unwrap()], 1e-11);
        check(&[twenty.variance * power_gain(&twenty.ar)], &[golden["power"].as_f64().unwrap()], 1e-9);
        check(&lsf_from_ar(&twenty.ar).unwrap(), &floats(&golden["lsf"]), 1e-9);
    }
}

#[test]
fn a_lowered_predictor_is_that_of_the_lower_order() {
    let x = realization();
    for fit in [yule_walker as fn(&[f64], usize) -> _, burg] {
        let mut lowered = fit(&x, 64).unwrap().ar;
        for order in (1..64).rev() {
            let left = step_down(&mut lowered).unwrap();
            assert!(left > 0.0 && left <= 1.0, "{left}");
            if order % 9 == 1 {
                check(&lowered, &fit(&x, order).unwrap().ar, 1e-10);
            }
        }
    }
    let mut none = Vec::new();
    assert_eq!(step_down(&mut none), None);
    for unstable in [1.0, -1.5, f64::NAN] {
        assert_eq!(step_down(&mut vec![0.5, unstable]), None);
    }
}

#[test]
fn golden_orders() {
    let (v, x) = (vectors(), realization());
    let fit = yule_walker(&x, 30).unwrap();
    let n = x.len() as f64;
    let order = |criterion: &dyn Fn(f64, f64) -> f64| {
        let value = |p: usize| criterion(fit.variance_by_order[p], p as f64);
        (0..=30).min_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap()
    };
    let golden = |name: &str| v["orders_pmax30"][name].as_u64().unwrap() as usize;
    assert_eq!(order_by_bic(&fit, x.len(), 0..=30), golden("BIC"));
    // The other criteria are unused; their agreement verifies the residual variance at every order.
    assert_eq!(order(&|e, p| n * e.ln() + 2.0 * p), golden("AIC"));
    assert_eq!(order(&|e, p| e * (n + p + 1.0) / (n - p - 1.0)), golden("FPE"));
    assert_eq!(order(&|e, p| 0.5 * n * e.ln() + 0.5 * p * n.ln()), golden("MDL"));
}

#[test]
fn golden_midpoint_of_two_predictors() {
    let v = &vectors()["interp"];
    let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
    let b = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
    let middle = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect() };
    let mid_lsf = ar_from_lsf(&middle(&lsf_from_ar(&a).unwrap(), &lsf_from_ar(&b).unwrap()));
    let mid_coef = middle(&a, &b);
    let number = |name: &str| v[name].as_f64().unwrap();
    check(&b, &floats(&v["b"])[1..], 1e-12);
    check(&lsf_from_ar(&b).unwrap(), &floats(&v["lsf_b"]), 1e-10);
    check(&mid_lsf, &floats(&v["a_mid_lsf"])[1..], 1e-10);
    check(&mid_coef, &floats(&v["a_mid_coef"])[1..], 1e-12);
    // Power gains reach 77 and are as sensitive as the sharpest pole.
    for (ar, name) in
        [(&a, "power_a"), (&b, "power_b"), (&mid_lsf, "power_mid_lsf"), (&mid_coef, "power_mid_coef")]
    {
        check(&[power_gain(ar) / number(name)], &[1.0], 1e-9);
    }
    // Largest pole radius r: the predictor with coefficients a_k r^-k is at the limit of stability.
    for (ar, name) in [(&mid_lsf, "rad_lsf"), (&mid_coef, "rad_coef")] {
        let stable = |radius: f64| {
            let scaled: Vec<f64> = ar.iter().zip(1..).map(|(a, k)| a * radius.powi(-k)).collect();
            power_gain(&scaled).is_finite()
        };
        assert!(stable(number(name) + 1e-9) && !stable(number(name) - 1e-9), "{name}");
    }
}

/// As `switching.py`: a predictor that moves between two predictors twice per second, updated every `n_update` samples.
fn switched(n_update: usize, level: impl Fn(f64, &[f64]) -> f64) -> [f64; 2] {
    let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
    let b = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
    let (lsf_a, lsf_b) = (lsf_from_ar(&a).unwrap(), lsf_from_ar(&b).unwrap());
    let mut all = Vec::new();
    for seed in [5, 6, 7] {
        let mut x = lcg_noise(4000, seed);
        let (mut ar, mut gain) = (Vec::new(), 0.0);
        for n in 0..x.len() {
            if n % n_update == 0 {
                let w = 0.5 + 0.5 * (std::f64::consts::TAU * 2.0 * n as f64 / 1000.0).sin();
                let lsf: Vec<f64> = lsf_a.iter().zip(&lsf_b).map(|(a, b)| w * a + (1.0 - w) * b).collect();
                ar = ar_from_lsf(&lsf);
                gain = level(w, &ar);
            }
            x[n] = gain * x[n] - (1..=4.min(n)).map(|k| ar[k - 1] * x[n - k]).sum::<f64>();
        }
        all.extend(x);
    }
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let rms = (all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / all.len() as f64).sqrt();
    [rms, all.iter().fold(0.0_f64, |m, x| m.max(x.abs())) / rms]
}

#[test]
fn golden_switching() {
    let v: Value = serde_json::from_str(include_str!("../../../../../vectors/a_ar/switching.json")).unwrap();
    let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
    let b = from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93)]);
    let (power_a, power_b) = (power_gain(&a), power_gain(&b));
    let excitation = |w: f64, _: &[f64]| (w / power_a + (1.0 - w) / power_b).sqrt();
    for n_update in [1, 10, 50] {
        let golden = |mode: &str| {
            let golden = &v[format!("U{n_update}_{mode}")];
            [golden["rms"].as_f64().unwrap(), golden["crest"].as_f64().unwrap()]
        };
        // Frequency errors of 1e-11 are amplified by the sharpness of the poles.
        check(&switched(n_update, |_, ar| power_gain(ar).powf(-0.5)), &golden("rms"), 1e-8);
        check(&switched(n_update, excitation), &golden("excvar"), 1e-8);
    }
    let middle: Vec<f64> =
        lsf_from_ar(&a).unwrap().iter().zip(&lsf_from_ar(&b).unwrap()).map(|(a, b)| 0.5 * (a + b)).collect();
    let middle = ar_from_lsf(&middle);
    let rms = |excitation: f64| excitation * power_gain(&middle).sqrt();
    check(&[rms(excitation(0.5, &[]))], &[v["mid_rms_excvar"].as_f64().unwrap()], 1e-9);
    check(&[rms(power_gain(&middle).powf(-0.5))], &[v["mid_rms_rmsmode"].as_f64().unwrap()], 1e-12);
}

#[test]
fn density_integrates_to_the_power() {
    let ar =
        from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93), (Hertz(400.0), 0.8)]);
    let n = 20_000;
    let f: Vec<Hertz> = (0..n).map(|i| Hertz((f64::from(i) + 0.5) * 500.0 / f64::from(n))).collect();
    let integral = psd(&ar, 0.7, Hertz(1000.0), &f).iter().sum::<f64>() * 500.0 / f64::from(n);
    check(&[integral / (0.7 * power_gain(&ar))], &[1.0], 1e-9);
}

#[test]
fn first_order_in_closed_form() {
    check(&[power_gain(&[-0.6])], &[1.0 / (1.0 - 0.36)], 1e-15);
    assert_eq!(power_gain(&[1.0]), f64::INFINITY);
    assert_eq!(power_gain(&[]), 1.0);
}

#[test]
fn bad_signals_are_named() {
    assert_eq!(burg(&[1.0, 2.0], 2), Err(ArError::TooShort { order: 2, len: 2 }));
    assert_eq!(yule_walker(&[1.0, f64::NAN, 2.0], 1), Err(ArError::NotFinite { index: 1 }));
    assert_eq!(burg(&[3.0; 50], 2), Err(ArError::Constant));
}

#[test]
fn frequencies_run_from_five_hertz_to_just_below_nyquist() {
    let f = comparison_frequencies(Hertz(1000.0), 256);
    assert_eq!((f.len(), f[0]), (256, Hertz(5.0)));
    check(&[f[255].0], &[499.5], 1e-9);
}
