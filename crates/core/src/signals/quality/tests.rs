use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
use realfft::RealFftPlanner;
use serde_json::Value;

use super::{
    Distances, Feature, PAPER_FEATURES, PAPER_WEIGHTS, QualityError, QualityMeter, QualityModel,
    QualityModelError, RatedPair, Term, eliminate, nested_validation, rotate, spqi, st_sim,
};
use crate::dsp::spectrum::rms;
use crate::dsp::threshold::Threshold;
use crate::maths::rng::{Random, lcg_noise};
use crate::units::Hertz;

const RATE: Hertz = Hertz(2000.0);

fn golden() -> Value {
    serde_json::from_str(include_str!("../../../../../vectors/h_thresh/quality_vectors.json")).unwrap()
}

fn pacinian() -> Threshold {
    let table = include_str!("../../../../../assets/thresholds/pacinian.csv");
    let point = |line: &str| {
        let (hz, db) = line.split_once(',').unwrap();
        (Hertz(hz.parse().unwrap()), db.parse().unwrap())
    };
    Threshold::new(&table.lines().skip(1).map(point).collect::<Vec<_>>()).unwrap()
}

fn meter() -> QualityMeter {
    QualityMeter::new(RATE, &pacinian()).unwrap()
}

fn base() -> Vec<f64> {
    let table = include_str!("../../../../../vectors/h_thresh/base.csv");
    table.lines().map(|line| line.parse().unwrap()).collect()
}

fn low_passed(signal: &[f64], hz: f64) -> Vec<f64> {
    let n = signal.len();
    let mut planner = RealFftPlanner::<f64>::new();
    let forward = planner.plan_fft_forward(n);
    let (mut samples, mut bins) = (signal.to_vec(), forward.make_output_vec());
    forward.process(&mut samples, &mut bins).unwrap();
    for (k, bin) in bins.iter_mut().enumerate() {
        *bin *= if k as f64 * RATE.0 / (n as f64) < hz { 1.0 / n as f64 } else { 0.0 };
    }
    planner.plan_fft_inverse(n).process(&mut bins, &mut samples).unwrap();
    samples
}

fn noisy(signal: &[f64]) -> Vec<f64> {
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let spread = rms(&signal.iter().map(|x| x - mean).collect::<Vec<_>>());
    signal.iter().zip(lcg_noise(signal.len(), 100)).map(|(x, n)| x + 0.31 * spread * n).collect()
}

#[test]
fn golden_distances() {
    let (v, base, meter) = (golden(), base(), meter());
    let cases = [
        ("identical", base.clone()),
        ("gain+1dB", base.iter().map(|x| x * 10.0_f64.powf(0.05)).collect()),
        ("gain-6dB", base.iter().map(|x| 0.5 * x).collect()),
        ("lowpass", low_passed(&base, 120.0)),
        ("noise-10dB", noisy(&base)),
    ];
    for (name, other) in cases {
        let got = meter.distances(&base, &other).unwrap();
        let keys = ["d_rough", "d_bright", "d_reg", "d_asym", "D_power", "D_amp", "d_env"];
        for (feature, key) in Feature::ALL.into_iter().zip(keys) {
            let want = v["cases"][name][key].as_f64().unwrap();
            // The low-pass leaves round-off, which the small amplitude exponents amplify.
            let tolerance = if name == "lowpass" { 1e-6 } else { 1e-9 } * want.abs().max(1.0);
            let got = got.by(feature);
            assert!((got - want).abs() < tolerance, "{name}, {}: {got}, not {want}", feature.id());
        }
    }
    let features = meter.features(&base).unwrap();
    for (got, key) in [
        (features.roughness, "rough"),
        (features.brightness_hz, "bright"),
        (features.regularity, "reg"),
        (features.asymmetry, "asym"),
    ] {
        let want = v["base_features"][key].as_f64().unwrap();
        assert!((got - want).abs() < 1e-9 * want.abs().max(1.0), "{key}: {got}, not {want}");
    }
}

/// The features of a tone are known in closed form.
#[test]
fn a_tone_has_the_features_of_a_tone() {
    let tone: Vec<f64> = (0..1600).map(|i| (std::f64::consts::TAU * 0.1 * f64::from(i)).sin()).collect();
    let features = meter().features(&tone).unwrap();
    assert!((features.roughness - 0.5_f64.log10()).abs() < 1e-9, "{features:?}");
    assert!((features.brightness_hz - 200.0).abs() < 1e-6 && (features.regularity - 1.0).abs() < 1e-9);
    assert!(features.asymmetry.abs() < 1e-9);
}

#[test]
fn silence_and_constants_have_distances_too() {
    let (meter, base) = (meter(), base());
    for flat in [0.0, 0.7, -1e-30] {
        let flat = vec![flat; 1600];
        for (a, b) in [(&flat, &base), (&base, &flat), (&flat, &flat)] {
            let distances = meter.distances(a, b).unwrap();
            assert!(distances.0.iter().all(|d| d.is_finite() && *d >= 0.0), "{distances:?}");
        }
        assert_eq!(meter.distances(&flat, &flat).unwrap(), Distances::default());
        assert_eq!(meter.distances(&base, &flat).unwrap().by(Feature::Envelope), 1.0);
    }
}

#[test]
fn what_cannot_be_compared_is_named() {
    let meter = meter();
    let short = meter.distances(&[0.0; 1599], &[0.0; 1599]);
    assert_eq!(short, Err(QualityError::Short { n_samples: 1599, needed: 1600 }));
    let lengths = meter.distances(&[0.0; 1600], &[0.0; 1601]);
    assert_eq!(lengths, Err(QualityError::Lengths { n_reference: 1600, n_other: 1601 }));
    let mut odd = vec![0.0; 1600];
    odd[7] = f64::NAN;
    assert_eq!(meter.features(&odd), Err(QualityError::NotFinite { index: 7 }));
    for hz in [0.0, 199.0, f64::NAN, f64::INFINITY] {
        assert!(QualityMeter::new(Hertz(hz), &pacinian()).is_err());
    }
}

#[test]
fn longer_signals_are_the_mean_of_their_pieces() {
    let (meter, base) = (meter(), base());
    let quiet: Vec<f64> = base.iter().map(|x| 0.5 * x).collect();
    let one = meter.distances(&base, &quiet).unwrap();
    let long = |a: &[f64], b: &[f64]| [a, b, &[0.3; 100]].concat();
    let two = meter.distances(&long(&base, &base), &long(&quiet, &base)).unwrap();
    for (one, two) in one.0.iter().zip(two.0) {
        assert!((0.5 * one - two).abs() < 1e-9 * one.max(1.0));
    }
}

#[test]
fn likenesses_of_others_fall_with_noise() {
    let (base, threshold) = (base(), pacinian());
    let louder =
        |gain: f64| -> Vec<f64> { base.iter().zip(lcg_noise(1600, 7)).map(|(x, n)| x + gain * n).collect() };
    for measure in [st_sim, spqi] {
        let of = |other: &[f64]| measure(&base, other, RATE, &threshold).unwrap();
        let (same, little, much) = (of(&base), of(&louder(0.2)), of(&louder(2.0)));
        assert!((same - 1.0).abs() < 1e-9 && little < same && much < little && much > 0.0, "{little} {much}");
        assert_eq!(measure(&base, &base[1..], RATE, &threshold), None);
        assert_eq!(measure(&base[..100], &base[..100], RATE, &threshold), None);
        let silent = measure(&[0.0; 1600], &[0.0; 1600], RATE, &threshold);
        assert_eq!(silent, Some(1.0));
        assert!(measure(&[0.0; 1600], &base, RATE, &threshold).unwrap() < 0.1);
    }
}

/// Simulated pairs: ratings depend on two features plus noise; the other features are noise.
pub(super) fn rated(n_textures: usize, noise: f64, seed: u64) -> Vec<RatedPair> {
    let mut random = Random::new(seed);
    let mut pairs = Vec::new();
    for texture in 0..n_textures {
        for _ in 0..5 {
            let distances = Distances(std::array::from_fn(|_| random.uniform()));
            let truth = 2.0 * distances.by(Feature::Roughness) + 0.5 * distances.by(Feature::Envelope);
            pairs.push(RatedPair {
                texture,
                distances,
                d_prime: truth + noise * random.normal(),
                weight: 1.0,
            });
        }
    }
    pairs
}

#[test]
fn features_that_say_something_are_kept_and_their_weights_found() {
    let pairs = rated(5, 0.05, 1);
    let elimination = eliminate(&Feature::ALL, &pairs, 0.5).unwrap();
    assert_eq!(elimination.kept, [Feature::Roughness, Feature::Envelope]);
    assert_eq!(elimination.dropped.len(), 5);
    let model = QualityModel::fitted(&elimination.kept, &pairs).unwrap();
    for (term, weight) in model.terms().iter().zip([2.0, 0.5]) {
        assert!((term.weight / term.length - weight).abs() < 0.1, "{term:?}");
    }
    assert!(model.r_squared(&pairs).unwrap() > 0.98);
    let rotations = rotate(&elimination.kept, &pairs).unwrap();
    assert_eq!(rotations.len(), 10);
    assert!(rotations.windows(2).all(|w| w[0].squared_error <= w[1].squared_error));
    assert!(nested_validation(&Feature::ALL, &pairs, 0.5).unwrap().r_squared.unwrap() > 0.97);
}

/// With random ratings, the best in-sample R² still looks good, but the nested R² does not.
#[test]
fn chance_is_not_taken_for_knowledge() {
    let pairs: Vec<RatedPair> = {
        let mut random = Random::new(3);
        rated(5, 0.0, 2)
            .into_iter()
            .map(|pair| RatedPair { d_prime: 2.0 + random.normal(), ..pair })
            .collect()
    };
    let kept = eliminate(&Feature::ALL, &pairs, 0.1).unwrap().kept;
    let in_sample = QualityModel::fitted(&kept, &pairs).unwrap().r_squared(&pairs).unwrap();
    let nested = nested_validation(&Feature::ALL, &pairs, 0.1).unwrap().r_squared.unwrap();
    assert!(nested < in_sample - 0.1, "{nested} of {in_sample}");
}

#[test]
fn the_papers_weights_reach_the_papers_range() {
    let pairs = rated(5, 0.0, 4);
    let corpus: Vec<Distances> = pairs.iter().map(|pair| pair.distances).collect();
    let weights: Vec<(Feature, f64)> = PAPER_FEATURES.into_iter().zip(PAPER_WEIGHTS).collect();
    let model = QualityModel::weighted(&weights, &corpus).unwrap();
    // Equal distances over 25 pairs each normalize to one fifth.
    let even = Distances([1.0; 7]);
    let model_of_even = QualityModel::weighted(&weights, &[even; 25]).unwrap();
    assert!((model_of_even.d_prime(&even) - 18.6 / 5.0).abs() < 1e-9);
    assert_eq!(model.d_prime(&Distances::default()), 0.0);
    let mut flat = corpus;
    for distances in &mut flat {
        distances.0[Feature::Envelope as usize] = 0.0;
    }
    let constant = QualityModelError::Constant { feature: Feature::Envelope };
    assert_eq!(QualityModel::weighted(&weights, &flat), Err(constant));
    assert_eq!(QualityModel::weighted(&[], &flat), Err(QualityModelError::Nothing));
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        let term = Term { feature: Feature::Envelope, weight: wrong, length: 1.0 };
        let impossible = Err(QualityModelError::Term { feature: Feature::Envelope });
        assert_eq!(QualityModel::of_terms(vec![term]), impossible);
        assert_eq!(QualityModel::of_terms(vec![Term { weight: 1.0, length: wrong, ..term }]), impossible);
    }
    assert_eq!(rotate(&Feature::ALL, &rated(2, 0.0, 1)), Err(QualityModelError::Textures { n: 2 }));
}

proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(24))]

    /// Distances are zero for equal signals, and symmetric.
    #[test]
    fn distances_are_distances(
        seed in 0_u64..1000,
        gain in 0.01_f64..10.0,
        hz in prop::sample::select(vec![1000.0, 2000.0, 2800.0, 8000.0]),
    ) {
        let meter = QualityMeter::new(Hertz(hz), &pacinian()).unwrap();
        let n = meter.n_segment();
        let (a, b): (Vec<f64>, Vec<f64>) =
            (lcg_noise(n, seed), lcg_noise(n, seed + 1).into_iter().map(|x| gain * x).collect());
        prop_assert_eq!(meter.distances(&a, &a).unwrap(), Distances::default());
        let (there, back) = (meter.distances(&a, &b).unwrap(), meter.distances(&b, &a).unwrap());
        for (there, back) in there.0.iter().zip(back.0) {
            prop_assert!((there - back).abs() <= 1e-9 * there.abs() && *there >= 0.0);
        }
    }
}
