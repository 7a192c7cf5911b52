use proptest::prelude::{Just, Strategy, any, prop_assert, prop_assert_eq, prop_oneof, proptest};
use serde_json::Value;

use super::{AmplitudePoint, ClipMetadata, ClipRules, Emphasis, FrequencyPoint, HapticClip, HapticClipError};

fn point(time_secs: f64, amplitude: f64) -> AmplitudePoint {
    AmplitudePoint { time_secs, amplitude, emphasis: None }
}

fn frequency(time_secs: f64, frequency: f64) -> FrequencyPoint {
    FrequencyPoint { time_secs, frequency }
}

fn clip() -> HapticClip {
    let emphasis = Some(Emphasis { amplitude: 0.75, frequency: 1.0 });
    HapticClip {
        metadata: ClipMetadata {
            editor: "test".to_owned(),
            tags: vec!["cork".to_owned(), "\"quoted\"".to_owned()],
            ..ClipMetadata::default()
        },
        amplitude: vec![point(0.5, 0.25), AmplitudePoint { emphasis, ..point(1.0, 0.75) }, point(1.0, 0.0)],
        frequency: vec![frequency(0.5, 0.125), frequency(1.0, 1.0)],
    }
}

fn read(text: &str) -> Result<HapticClip, HapticClipError> {
    HapticClip::from_json(text.as_bytes(), ClipRules::Strict)
}

#[test]
fn a_clip_comes_back_from_its_file() {
    assert_eq!(HapticClip::from_json(&clip().to_json(), ClipRules::Strict), Ok(clip()));
    let bare = HapticClip { metadata: ClipMetadata::default(), frequency: Vec::new(), ..clip() };
    assert_eq!(HapticClip::from_json(&bare.to_json(), ClipRules::Strict), Ok(bare.clone()));
    assert_eq!((bare.start_secs(), bare.end_secs()), (0.5, 1.0));
    let file: Value = serde_json::from_slice(&bare.to_json()).unwrap();
    assert_eq!(file["version"]["major"], 1);
    assert!(file["signals"]["continuous"]["envelopes"].get("frequency").is_none());
}

#[test]
fn only_what_is_needed_is_needed_and_more_is_ignored() {
    let text = r#"{"version": {"major": 1, "build": "x"}, "more": [1], "signals": {"continuous": {"gain": 2, "envelopes":
        {"amplitude": [{"time": 0, "amplitude": 1}, {"time": 2, "amplitude": 0, "emphasis": null}]}}}}"#;
    let read = read(text).unwrap();
    assert_eq!(
        read,
        HapticClip { amplitude: vec![point(0.0, 1.0), point(2.0, 0.0)], ..HapticClip::default() }
    );
}

#[test]
fn what_is_no_clip_is_refused_with_a_reason() {
    for (text, words) in [
        ("", "it ends too early"),
        ("[]", "Export the clip again"),
        (r#"{"version": {"major": 2}}"#, "version 2"),
        (r#"{"version": {"major": 1}}"#, "`signals` is missing"),
        (r#"{"version": {"major": 1}, "sssignals": {}}"#, "`signals` is missing"),
        (
            r#"{"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": [{"time": 0}]}}}}"#,
            "`amplitude` is missing",
        ),
        (
            r#"{"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": []}}}}"#,
            "0 points",
        ),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(words), "{text}: {error}");
    }
}

/// Each rule has a clip that breaks only it, and an error that names the point.
#[test]
fn each_rule_is_kept() {
    let with = |amplitude: Vec<AmplitudePoint>| HapticClip { amplitude, ..clip() };
    let tuned = |frequency: Vec<FrequencyPoint>| HapticClip { frequency, ..clip() };
    let emphasized = |amplitude: f64, frequency: f64| {
        let emphasis = Some(Emphasis { amplitude, frequency });
        with(vec![AmplitudePoint { emphasis, ..point(0.5, 0.5) }, point(1.0, 0.5)])
    };
    for (broken, words) in [
        (with(vec![point(0.5, 0.5)]), "1 points"),
        (
            with(vec![point(-0.5, 0.5), point(1.0, 0.5)]),
            "point 1 of the amplitude envelope: the time is -0.5 s",
        ),
        (
            with(vec![point(0.5, 0.5), point(f64::NAN, 0.5)]),
            "point 2 of the amplitude envelope: the time is NaN",
        ),
        (with(vec![point(0.5, 0.5), point(1e6, 0.5)]), "the time is 1000000 s"),
        (with(vec![point(0.5, 0.5), point(1.0, 0.5), point(0.75, 0.5)]), "point 3 of the amplitude envelope"),
        (with(vec![point(0.5, 0.5), point(1.0, 1.5)]), "amplitude is 1.5"),
        (with(vec![point(0.5, -0.5), point(1.0, 0.5)]), "amplitude is -0.5"),
        (with(vec![point(0.5, 0.5), point(0.5, 0.75)]), "no duration"),
        (emphasized(0.25, 0.5), "emphasis is 0.25, below"),
        (emphasized(1.25, 0.5), "amplitude of the emphasis is 1.25"),
        (emphasized(0.75, 1.25), "frequency of the emphasis is 1.25"),
        (tuned(vec![frequency(1.0, 0.5), frequency(0.75, 0.5)]), "point 2 of the frequency envelope"),
        (tuned(vec![frequency(0.5, -0.5)]), "frequency is -0.5"),
    ] {
        for rules in [ClipRules::Strict, ClipRules::Legacy] {
            let error = broken.clone().checked(rules).unwrap_err().to_string();
            assert!(error.contains(words), "{words}: {error}");
        }
    }
    assert!(emphasized(0.5, 0.5).checked(ClipRules::Strict).is_ok());
    // What is the same in 32 bits is the same.
    assert!(emphasized(0.5 - 1e-9, 1.0 + 1e-9).checked(ClipRules::Strict).is_ok());
    assert!(tuned(vec![frequency(1.0 + 1e-9, 0.5)]).checked(ClipRules::Strict).is_ok());
    // The only rule that old clips may break.
    for outside in [0.25, 1.001] {
        let late = tuned(vec![frequency(outside, 0.5)]);
        assert!(late.clone().checked(ClipRules::Legacy).is_ok());
        let late = late.checked(ClipRules::Strict);
        assert!(matches!(late, Err(HapticClipError::FrequencyOutside { secs, .. }) if secs == outside));
    }
}

/// Clips that keep the rules.
fn clips() -> impl Strategy<Value = HapticClip> {
    let unit = || prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64];
    let amplitudes = proptest::collection::vec((0.0..2.0_f64, unit(), any::<bool>(), unit(), unit()), 2..20);
    let frequencies = proptest::collection::vec((unit(), unit()), 0..20);
    (amplitudes, frequencies, ".{0,20}", proptest::collection::vec(".{0,8}", 0..3)).prop_map(
        |(amplitudes, mut frequencies, text, tags)| {
            let mut secs = 0.0;
            let amplitude: Vec<AmplitudePoint> = amplitudes
                .into_iter()
                .map(|(step_secs, amplitude, has_emphasis, more, frequency)| {
                    secs += step_secs;
                    let emphasis = Emphasis { amplitude: amplitude + more * (1.0 - amplitude), frequency };
                    let emphasis =
                        has_emphasis.then_some(emphasis).filter(|emphasis| emphasis.amplitude <= 1.0);
                    AmplitudePoint { time_secs: secs, amplitude, emphasis }
                })
                .collect();
            let start_secs = amplitude[0].time_secs;
            let last_secs = secs;
            frequencies.sort_by(|a, b| a.0.total_cmp(&b.0));
            let within = |share: f64| (start_secs + share * (last_secs - start_secs)).min(last_secs);
            let frequency = frequencies.into_iter().map(|(at, value)| frequency(within(at), value)).collect();
            let metadata = ClipMetadata { description: text, tags, ..ClipMetadata::default() };
            HapticClip { metadata, amplitude, frequency }
        },
    )
}

proptest! {
    #[test]
    fn every_clip_comes_back_from_its_file(clip in clips()) {
        // Steps of time may all be zero.
        if let Ok(clip) = clip.checked(ClipRules::Strict) {
            prop_assert_eq!(HapticClip::from_json(&clip.to_json(), ClipRules::Strict), Ok(clip));
        }
    }

    #[test]
    fn any_bytes_are_a_clip_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(HapticClip::from_json(&bytes, ClipRules::Legacy).is_err());
    }

    /// A file with one value replaced by any other keeps the rules or is refused.
    #[test]
    fn a_clip_with_any_number_keeps_the_rules_or_is_refused(number in any::<f64>(), place in 0..8_usize) {
        let mut broken = clip();
        let slot = match place {
            0 => &mut broken.amplitude[0].time_secs,
            1 => &mut broken.amplitude[0].amplitude,
            2 => &mut broken.amplitude[2].time_secs,
            3 => &mut broken.amplitude[2].amplitude,
            4 => &mut broken.frequency[0].time_secs,
            5 => &mut broken.frequency[0].frequency,
            6 => &mut broken.frequency[1].time_secs,
            _ => &mut broken.frequency[1].frequency,
        };
        *slot = number;
        if let Ok(read) = HapticClip::from_json(&broken.to_json(), ClipRules::Strict) {
            prop_assert!(read.amplitude.iter().all(|point| (0.0..=1.0).contains(&point.amplitude)));
            prop_assert!(read.end_secs() > read.start_secs());
            prop_assert_eq!(read, broken);
        }
    }
}

#[test]
fn independent_faults_are_all_listed_and_their_consequences_are_not() {
    let faults = |clip: &HapticClip| {
        let (_, faults) = HapticClip::with_faults(&clip.to_json(), ClipRules::Strict).unwrap();
        assert_eq!(faults.first.len(), faults.n);
        assert_eq!(clip.clone().checked(ClipRules::Strict).err(), faults.first.first().cloned());
        faults.first.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(faults(&clip()), "");
    // One late point, two loud ones and a frequency out of range.
    let amplitude = vec![point(0.0, 0.5), point(9.0, 2.0), point(0.2, 3.0), point(0.4, 0.0)];
    let mut broken = HapticClip { amplitude, frequency: vec![frequency(0.1, -1.0)], ..clip() };
    let listed = faults(&broken);
    assert_eq!(listed.lines().count(), 4, "{listed}");
    assert_eq!(listed.matches("before the previous point").count(), 1, "{listed}");
    // The times of the amplitude are wrong, so that nothing is known about the place of a frequency.
    broken.frequency = vec![frequency(5.0, 0.5)];
    assert_eq!(faults(&broken).lines().count(), 3);
    // Nothing more follows from a missing envelope.
    broken.amplitude.clear();
    assert_eq!(faults(&broken).lines().count(), 1);
}
