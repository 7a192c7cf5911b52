use super::{RATE, python_speech_features, recommended};
use crate::dsp::mfcc::{
    Framing, Lifter, Logarithm, MAX_SAMPLE, MfccError, MfccOptions, MfccPlan, MfccPlanError, TransformLength,
};
use crate::units::Hertz;

#[track_caller]
fn refused(options: &MfccOptions, rate: Hertz, part: &str) {
    let message = MfccPlan::new(options, rate).err().expect("a refusal").to_string();
    assert!(message.contains(part), "{message}");
}

#[test]
fn nonsense_options_are_refused() {
    let base = recommended();
    refused(&base, Hertz(f64::NAN), "the rate in Hz is NaN");
    refused(&base, Hertz(0.0), "the rate in Hz");
    let slow = MfccOptions { low: Hertz(1.0), high: Hertz(9.0), ..base.clone() };
    refused(&slow, Hertz(19.0), "a frame of 0.025 s is shorter than one sample at 19 Hz");
    refused(&MfccOptions { hop_secs: 1e-4, ..base.clone() }, RATE, "a hop of 0.0001 s");
    refused(&MfccOptions { frame_secs: f64::INFINITY, ..base.clone() }, RATE, "frame in s is inf");
    refused(&MfccOptions { pre_emphasis: -0.1, ..base.clone() }, RATE, "pre-emphasis is -0.1");
    refused(&MfccOptions { lifter: Lifter::FromOne(0.0), ..base.clone() }, RATE, "lifter is 0.0");
    let floor = |floor| MfccOptions { logarithm: Logarithm::Floored { floor }, ..recommended() };
    refused(&floor(0.0), RATE, "floor of the logarithm is 0.0");
    refused(&floor(f64::NAN), RATE, "floor of the logarithm is NaN");
    let decibels = Logarithm::Decibels { floor: 1e-10, top_db: 0.0 };
    refused(&MfccOptions { logarithm: decibels, ..base.clone() }, RATE, "dynamic range in dB is 0.0");
    refused(&MfccOptions { n_coefficients: 21, ..base.clone() }, RATE, "20 mel filters have 1 to 20");
    refused(&MfccOptions { n_coefficients: 0, ..base.clone() }, RATE, "got 0");
    refused(&MfccOptions { n_filters: 0, ..base.clone() }, RATE, "got 0");
    refused(&MfccOptions { n_filters: usize::MAX, ..base.clone() }, RATE, "mel filters must lie");
    let transform = |transform| MfccOptions { transform, ..recommended() };
    refused(&transform(TransformLength::Samples(24)), RATE, "a transform of 24 samples");
    refused(&transform(TransformLength::PowersOfTwo(usize::MAX)), RATE, "to 65536");
    refused(&MfccOptions { frame_secs: 1e5, ..base }, RATE, "a transform of");
}

#[test]
fn a_rate_too_low_for_the_filters_is_refused() {
    for (rate_hz, low, high) in
        [(900.0, 10.0, 500.0), (1000.0, 500.0, 500.0), (1000.0, -1.0, 500.0), (1000.0, f64::NAN, 500.0)]
    {
        let options = MfccOptions { low: Hertz(low), high: Hertz(high), ..recommended() };
        let error = MfccPlan::new(&options, Hertz(rate_hz)).err().unwrap();
        assert!(matches!(error, MfccPlanError::Edges { .. }), "{error}");
    }
    refused(&recommended(), Hertz(900.0), "10 to 500 Hz do not fit between 0 and 450 Hz");
}

#[test]
fn bad_signals_are_refused_by_sample() {
    let plan = MfccPlan::new(&recommended(), RATE).unwrap();
    assert_eq!(plan.coefficients(&[0.0; 24]), Err(MfccError::TooShort { n: 24, needed: 25 }));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.01 * MAX_SAMPLE] {
        let mut x = vec![0.5; 100];
        x[98] = bad;
        let message = plan.coefficients(&x).unwrap_err().to_string();
        assert!(message.contains("sample 98 is"), "{message}");
    }
    let padded = MfccPlan::new(&python_speech_features(), RATE).unwrap();
    assert_eq!(padded.coefficients(&[]), Err(MfccError::TooShort { n: 0, needed: 1 }));
}

#[test]
fn extremes_stay_finite() {
    for framing in [Framing::Whole, Framing::PaddedEnd, Framing::Centered] {
        for options in [recommended(), python_speech_features(), super::librosa(), super::htk()] {
            let plan = MfccPlan::new(&MfccOptions { framing, ..options }, RATE).unwrap();
            for value in [0.0, 1.0, MAX_SAMPLE, f64::MIN_POSITIVE, 1e-160] {
                let mut x = vec![value; 40];
                x[3] = -value;
                let got = plan.coefficients(&x).unwrap();
                assert!(got.iter().all(|c| c.is_finite()), "{}: {value}", plan.label());
            }
        }
    }
}
