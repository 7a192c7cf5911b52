use std::f64::consts::TAU;

use proptest::prelude::{prop_assert, proptest};

use super::{Burst, Curve, EnvelopeError, HapticEnvelope, Law, MAX_SECS, Voice};
use crate::units::Hertz;

const RATE: Hertz = Hertz(4000.0);

fn linear(points: &[[f64; 2]]) -> Curve {
    Curve::new(points.to_vec(), Law::Linear, [0.0, 1.0]).unwrap()
}

fn voice(level: &[[f64; 2]], frequency: &[[f64; 2]]) -> HapticEnvelope {
    let voice = Voice { level: linear(level), frequency: linear(frequency) };
    HapticEnvelope { voices: vec![voice], bursts: Vec::new() }
}

fn burst(start_secs: f64) -> Burst {
    Burst { start_secs, amplitude: 0.5, frequency: Hertz(200.0), decay_secs: 0.01 }
}

#[test]
fn a_constant_voice_is_a_sine() {
    let samples = voice(&[[0.0, 0.5], [2.0, 0.5]], &[[0.0, 150.0]]).render(RATE, 3.0).unwrap();
    assert_eq!(samples.len(), 8000);
    for (i, sample) in samples.iter().enumerate() {
        let expected = 1.5 * (TAU * 150.0 * i as f64 / RATE.0).sin();
        // Rounding of the phase: one addition a sample.
        assert!((sample - expected).abs() < 1e-9, "{i}: {sample} {expected}");
    }
}

/// The phase of a frequency that rises linearly is a parabola.
#[test]
fn a_rising_voice_is_a_chirp() {
    let samples = voice(&[[0.0, 0.0], [1.0, 1.0]], &[[0.0, 60.0], [1.0, 300.0]]).render(RATE, 1.0).unwrap();
    for (i, sample) in samples.iter().enumerate() {
        let t = i as f64 / RATE.0;
        let expected = t * (TAU * (60.0 * t + 120.0 * t * t)).sin();
        assert!((sample - expected).abs() < 1e-9, "{t}: {sample} {expected}");
    }
}

#[test]
fn a_voice_is_silent_outside_its_level() {
    let late = voice(&[[0.5, 1.0], [1.0, 1.0]], &[[0.0, 100.0]]);
    let mut both = late.clone();
    both.bursts.push(burst(1.5));
    let samples = both.render(RATE, 1.0).unwrap();
    assert_eq!(samples.len(), (1.55 * RATE.0) as usize);
    assert!(samples[..2000].iter().chain(&samples[4001..6000]).all(|sample| *sample == 0.0));
    // The sine begins with the voice.
    assert_eq!(samples[2000], 0.0);
    assert!((samples[2010] - 1.0).abs() < 1e-9, "a quarter of a period later");
    assert_eq!(samples[..4000], late.render(RATE, 1.0).unwrap()[..4000]);
}

#[test]
fn a_burst_decays() {
    let envelope = HapticEnvelope { voices: Vec::new(), bursts: vec![burst(0.1)] };
    let samples = envelope.render(RATE, 2.0).unwrap();
    assert_eq!(samples.len(), 600);
    for (i, sample) in samples.iter().enumerate().skip(400) {
        let t = i as f64 / RATE.0 - 0.1;
        let expected = (-t / 0.01).exp() * (TAU * 200.0 * t).sin();
        assert!((sample - expected).abs() < 1e-9, "{t}: {sample} {expected}");
    }
    let sudden = HapticEnvelope { bursts: vec![Burst { decay_secs: 0.0, ..burst(0.1) }], ..envelope };
    assert!(sudden.render(RATE, 2.0).unwrap().iter().all(|sample| *sample == 0.0));
}

#[test]
fn parts_are_added() {
    let voices = voice(&[[0.0, 0.5], [1.0, 0.25]], &[[0.0, 80.0]]);
    let bursts = HapticEnvelope { voices: Vec::new(), bursts: vec![burst(0.2), burst(0.9)] };
    let both = HapticEnvelope { voices: voices.voices.clone(), bursts: bursts.bursts.clone() };
    let [a, b, sum] = [&voices, &bursts, &both].map(|envelope| envelope.render(RATE, 1.0).unwrap());
    for (i, sum) in sum.iter().enumerate() {
        assert!((a.get(i).unwrap_or(&0.0) + b.get(i).unwrap_or(&0.0) - sum).abs() < 1e-12, "{i}");
    }
}

#[test]
fn curves_have_steps_and_laws() {
    let step = linear(&[[0.1, 0.2], [0.5, 0.4], [0.5, 1.0], [1.0, 0.0]]);
    for (secs, expected) in
        [(0.0, 0.2), (0.1, 0.2), (0.3, 0.3), (0.5, 1.0), (0.75, 0.5), (1.0, 0.0), (9.0, 0.0)]
    {
        assert!((step.at(secs) - expected).abs() < 1e-12, "{secs}");
    }
    let mut cursor = step.cursor();
    for i in 0..1200 {
        let secs = f64::from(i) * 1e-3;
        assert_eq!(cursor.at(secs), step.at(secs), "{secs}");
    }
    let squared = Curve::new(vec![[0.0, 0.0], [1.0, 1.0]], Law::Squared, [60.0, 300.0]).unwrap();
    for secs in [0.0, 0.25, 0.5, 1.0] {
        assert!((squared.at(secs) - (60.0 + 240.0 * secs * secs)).abs() < 1e-12, "{secs}");
    }
    assert_eq!(squared.extremes(), [60.0, 300.0]);
}

#[test]
fn what_cannot_be_rendered_is_named() {
    let of = |level: &[[f64; 2]], hz: f64| voice(level, &[[0.0, hz]]).render(RATE, 1.0);
    assert_eq!(of(&[[0.3, 0.5]], 100.0).map(|samples| samples.len()), Ok(1200));
    assert_eq!(of(&[[0.0, 0.5]], 100.0), Err(EnvelopeError::Empty));
    assert_eq!(HapticEnvelope::default().render(RATE, 1.0), Err(EnvelopeError::Empty));
    let too_long = of(&[[0.0, 0.5], [MAX_SECS + 1.0, 0.5]], 100.0);
    assert_eq!(too_long, Err(EnvelopeError::TooLong { secs: MAX_SECS + 1.0 }));
    let many = HapticEnvelope { voices: Vec::new(), bursts: vec![burst(0.0); 30_000] };
    assert!(matches!(many.render(RATE, 1.0), Err(EnvelopeError::TooMany { .. })));
    for (level, hz) in [(1.5, 100.0), (-0.1, 100.0), (0.5, 2000.0), (0.5, -1.0)] {
        let error = of(&[[0.0, level], [1.0, level]], hz).unwrap_err();
        assert!(matches!(error, EnvelopeError::Value { .. }), "{error}");
    }
    for wrong in
        [Burst { amplitude: 2.0, ..burst(0.0) }, Burst { decay_secs: f64::NAN, ..burst(0.0) }, burst(-1.0)]
    {
        let error = HapticEnvelope { voices: Vec::new(), bursts: vec![wrong] }.render(RATE, 1.0).unwrap_err();
        assert!(error.to_string().contains("transient"), "{error}");
    }
    let curve = |points: &[[f64; 2]]| Curve::new(points.to_vec(), Law::Linear, [0.0, 1.0]).unwrap_err();
    assert_eq!(curve(&[]), EnvelopeError::NoPoints);
    assert_eq!(curve(&[[0.5, 0.0], [0.4, 0.0]]), EnvelopeError::Time { index: 1, secs: 0.4 });
    assert_eq!(curve(&[[-0.5, 0.0]]), EnvelopeError::Time { index: 0, secs: -0.5 });
    assert!(matches!(curve(&[[0.0, f64::NAN]]), EnvelopeError::Value { .. }));
}

proptest! {
    /// Samples never exceed the sum of the amplitudes, whatever the curves are.
    #[test]
    fn samples_stay_within_their_level(
        times in proptest::collection::vec(0.0..2.0_f64, 2..20),
        levels in proptest::collection::vec(0.0..=1.0_f64, 20),
        hz in proptest::collection::vec(0.0..1900.0_f64, 1..5),
    ) {
        let mut times = times;
        times.sort_by(f64::total_cmp);
        let level: Vec<[f64; 2]> = times.iter().zip(&levels).map(|(secs, level)| [*secs, *level]).collect();
        let frequency: Vec<[f64; 2]> = hz.iter().enumerate().map(|(i, hz)| [i as f64 * 0.4, *hz]).collect();
        if let Ok(samples) = voice(&level, &frequency).render(RATE, 2.0) {
            let curve = linear(&level);
            for (i, sample) in samples.iter().enumerate() {
                prop_assert!(sample.abs() <= 2.0 * curve.at(i as f64 / RATE.0) + 1e-12);
            }
        }
    }
}
