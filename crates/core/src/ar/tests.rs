use super::test_signals::from_resonances;
use super::{ArError, burg, comparison_frequencies, order_by_bic, power_gain, psd, yule_walker};
use crate::rng::lcg_noise;
use crate::units::Hertz;
use serde_json::Value;

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../../vectors/a_ar/ar_vectors.json")).unwrap()
}

fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[track_caller]
fn check(actual: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(actual.len(), expected.len());
    for (i, (a, e)) in actual.iter().zip(expected).enumerate() {
        assert!((a - e).abs() < tolerance, "[{i}] {a} for {e}");
    }
}

/// The realization that the vectors were computed on.
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
fn golden_fits() {
    let (v, x) = (vectors(), realization());
    check(&x[..8], &floats(&v["x_first8"]), 1e-12);
    for (name, fit) in [("yule_walker", yule_walker as fn(&[f64], usize) -> _), ("burg", burg)] {
        // Sums of 5000 products round differently by about 1e-13; conditioning at order 20 costs two digits.
        let four = fit(&x, 4).unwrap();
        check(&four.ar, &floats(&v[format!("{name}_p4")]["a"])[1..], 1e-11);
        check(&[four.variance], &[v[format!("{name}_p4")]["s2"].as_f64().unwrap()], 1e-12);
        let twenty = fit(&x, 20).unwrap();
        let golden = &v[format!("{name}_p20")];
        check(&[twenty.variance], &[golden["s2"].as_f64().unwrap()], 1e-11);
        check(&[twenty.variance * power_gain(&twenty.ar)], &[golden["power"].as_f64().unwrap()], 1e-9);
    }
    let fit = yule_walker(&x, 30).unwrap();
    assert_eq!(order_by_bic(&fit, x.len(), 0..=30), 4);
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
