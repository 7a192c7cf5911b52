use proptest::prelude::{Strategy, any, prop_assert, prop_assert_eq, proptest};
use serde_json::{Value, json};

use super::of_clip::{AhapPair, DUCKED, ahap_of_clip};
use super::{
    AhapError, AhapEvent, AhapEventKind, AhapPattern, ControlId, ControlPoint, DynamicParameter,
    EventParameterId, MAX_CURVE_POINTS, ParameterCurve,
};
use crate::haptic_clip::{AmplitudePoint, Emphasis, FrequencyPoint, HapticClip};
use crate::imported::Imported;

fn pattern() -> AhapPattern {
    let event =
        |kind, time_secs, duration_secs, parameters| AhapEvent { kind, time_secs, duration_secs, parameters };
    let intensity = |value| vec![(EventParameterId::HapticIntensity, value)];
    AhapPattern {
        events: vec![
            event(AhapEventKind::HapticTransient, 0.25, 0.0, intensity(0.5)),
            event(AhapEventKind::HapticContinuous, 0.5, 1.25, vec![(EventParameterId::AudioPan, -1.0)]),
        ],
        curves: vec![ParameterCurve {
            id: ControlId::HapticSharpnessControl,
            time_secs: 0.125,
            points: vec![
                ControlPoint { time_secs: 0.0, value: -0.5 },
                ControlPoint { time_secs: 1.0, value: 1.0 },
            ],
        }],
        parameters: vec![DynamicParameter {
            id: ControlId::HapticIntensityControl,
            time_secs: 0.0,
            value: 0.75,
        }],
    }
}

fn read(pattern: &Value) -> Result<Imported<AhapPattern>, AhapError> {
    AhapPattern::from_json(json!({"Version": 1.0, "Pattern": pattern}).to_string().as_bytes())
}

#[test]
fn a_pattern_comes_back_from_its_file() {
    let bytes = pattern().to_json("A test");
    let back = AhapPattern::from_json(&bytes).unwrap();
    assert_eq!(back, Imported { value: pattern(), warnings: Vec::new() });
    assert_eq!(back.value.end_secs(), 1.75);
    assert_eq!(back.value.events[0].value(EventParameterId::HapticIntensity), Some(0.5));
    assert_eq!(back.value.events[0].value(EventParameterId::HapticSharpness), None);
    let file: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!((&file["Version"], &file["Metadata"]["Description"]), (&json!(1.0), &json!("A test")));
    assert!(file["Pattern"][2]["Event"].get("EventDuration").is_none(), "a tap has no duration");
}

#[test]
fn what_is_missing_has_its_default_and_what_is_too_large_is_clamped() {
    let parameter = |id: &str, value: f64| json!({"ParameterID": id, "ParameterValue": value});
    let continuous = json!({"Event": {"EventType": "HapticContinuous", "EventDuration": 40, "EventParameters":
        [parameter("HapticIntensity", 1.5), parameter("HapticSharpness", -1.0), parameter("Glow", 1.0)]}});
    let custom = json!({"Event": {"EventType": "AudioCustom", "EventWaveformPath": "a.wav"}});
    let empty = json!({"ParameterCurve": {"ParameterID": "HapticIntensityControl"}});
    let absolute = json!({"ParameterCurve": {"ParameterID": "HapticSharpnessControl", "Time": 0.5,
        "ParameterCurveControlPoints": [{"Time": 0.5, "ParameterValue": 0.5}, {"Time": 1.0}]}});
    let Imported { value, warnings } = read(&json!([continuous, custom, empty, absolute])).unwrap();
    assert_eq!(value.events[0].value(EventParameterId::HapticIntensity), Some(1.0));
    assert_eq!(value.events[0].value(EventParameterId::HapticSharpness), Some(0.0));
    assert_eq!((value.events[1].time_secs, value.curves.len()), (0.0, 1));
    assert_eq!(value.curves[0].points[1], ControlPoint { time_secs: 1.0, value: 0.0 });
    for words in ["2 values", "1 event lasts", "sound file", "1 curve has no points", "Glow", "entry 4 seem"]
    {
        assert!(warnings.iter().any(|warning| warning.contains(words)), "{words}: {warnings:?}");
    }
    assert_eq!(read(&json!([])).unwrap(), Imported { value: AhapPattern::default(), warnings: Vec::new() });
    let endless = read(&json!([{"Event": {"EventType": "HapticContinuous"}}])).unwrap().warnings;
    assert!(endless.len() == 1 && endless[0].contains("no duration"), "{endless:?}");
}

#[test]
fn what_is_no_pattern_is_refused_with_a_reason() {
    let of_bytes = |text: &str| AhapPattern::from_json(text.as_bytes()).unwrap_err().to_string();
    for (text, words) in [
        ("", "it ends too early"),
        (r#"{"Version": 1.0}"#, "`Pattern` is missing"),
        (r#"{"Version": 2.0, "Pattern": []}"#, "version 2"),
    ] {
        assert!(of_bytes(text).contains(words), "{text}: {}", of_bytes(text));
    }
    let tap = json!({"Event": {"EventType": "HapticTransient"}});
    let curve = |points: Value| json!({"ParameterCurve": {"ParameterID": "HapticIntensityControl", "ParameterCurveControlPoints": points}});
    for (entry, words) in [
        (json!({"ParameterCurves": {}}), "entry 2"),
        (json!({"Event": tap["Event"], "Parameter": {"ParameterID": "x"}}), "entry 2"),
        (json!({"Event": {"EventType": "HapticBuzz"}}), "HapticBuzz"),
        (json!({"Event": {"EventType": "HapticTransient", "Time": -1}}), "-1 s"),
        (curve(json!([{"Time": 1}, {"Time": 0.5}])), "point 2 of the curve is at 0.5 s"),
        (curve(json!([{"Time": -1}])), "-1 s"),
    ] {
        let error = read(&json!([tap, entry])).unwrap_err().to_string();
        assert!(error.contains(words), "{entry}: {error}");
    }
}

#[test]
fn every_parameter_has_one_name() {
    for id in EventParameterId::ALL {
        assert_eq!(EventParameterId::of(id.name()), Some(id));
        assert_eq!(ControlId::of(id.name()), None);
    }
    for id in ControlId::ALL {
        assert_eq!(ControlId::of(id.name()), Some(id));
        assert!(id.range().contains(&id.neutral()));
    }
}

fn point(time_secs: f64, amplitude: f64) -> AmplitudePoint {
    AmplitudePoint { time_secs, amplitude, emphasis: None }
}

fn taps(pair: &AhapPair) -> Vec<(f64, Option<f64>, Option<f64>)> {
    let events = pair.transients.iter().flat_map(|pattern| &pattern.events);
    let tap = |event: &AhapEvent| {
        let value = |id| event.value(id);
        (event.time_secs, value(EventParameterId::HapticIntensity), value(EventParameterId::HapticSharpness))
    };
    events.map(tap).collect()
}

#[test]
fn a_clip_becomes_two_patterns() {
    let emphasis = Some(Emphasis { amplitude: 0.81, frequency: 0.5 });
    let mut clip = HapticClip {
        amplitude: vec![point(0.5, 0.25), AmplitudePoint { emphasis, ..point(1.0, 0.36) }, point(2.0, 0.0)],
        frequency: vec![FrequencyPoint { time_secs: 1.0, frequency: 0.49 }],
        ..HapticClip::default()
    };
    let pair = ahap_of_clip(&clip);
    let [intensity, sharpness] = &pair.continuous.curves[..] else { panic!("{:?}", pair.continuous.curves) };
    let points = |curve: &ParameterCurve| {
        curve.points.iter().map(|point| (point.time_secs, point.value)).collect::<Vec<_>>()
    };
    assert_eq!((intensity.id, intensity.time_secs), (ControlId::HapticIntensityControl, 0.5));
    assert_eq!(points(intensity), [(0.0, 0.5), (0.5, DUCKED * 0.6), (1.5, 0.0)]);
    // The first frequency holds from the start of the clip on.
    assert_eq!(sharpness.time_secs, 0.5);
    assert_eq!(points(sharpness), [(0.0, 0.7), (0.5, 0.7)]);
    assert_eq!(taps(&pair), [(1.0, Some(0.9), Some(0.5))]);
    let [event] = &pair.continuous.events[..] else { panic!("{:?}", pair.continuous.events) };
    assert_eq!((event.time_secs, event.duration_secs), (0.5, 1.5));
    assert_eq!(event.value(EventParameterId::HapticSharpness), Some(0.0));
    // Without frequencies, the event has the usual one.
    clip.frequency.clear();
    clip.amplitude[1].emphasis = None;
    let pair = ahap_of_clip(&clip);
    assert_eq!((pair.continuous.curves.len(), &pair.transients), (1, &None));
    let sharpness = pair.continuous.events[0].value(EventParameterId::HapticSharpness).unwrap();
    assert!((sharpness.powi(2) - 0.5).abs() < 1e-12);
}

#[test]
fn long_clips_are_split() {
    for (secs, expected) in [(30.0, &[30.0][..]), (30.5, &[30.0, 0.5]), (70.0, &[30.0, 30.0, 10.0])] {
        let clip =
            HapticClip { amplitude: vec![point(1.0, 0.5), point(1.0 + secs, 0.5)], ..HapticClip::default() };
        let events = ahap_of_clip(&clip).continuous.events;
        let durations: Vec<f64> = events.iter().map(|event| event.duration_secs).collect();
        assert_eq!(durations, expected, "{secs}");
        let ends: Vec<f64> = events.iter().map(|event| event.time_secs + event.duration_secs).collect();
        assert!(events.iter().skip(1).zip(&ends).all(|(event, end)| event.time_secs == *end));
    }
}

#[test]
fn long_curves_share_their_ends() {
    for n in [2, 15, 16, 17, 31, 32, 100] {
        let amplitude: Vec<AmplitudePoint> =
            (0..n).map(|i| point(0.5 * f64::from(i), f64::from(i % 7) / 7.0)).collect();
        let curves = ahap_of_clip(&HapticClip { amplitude, ..HapticClip::default() }).continuous.curves;
        let mut joined: Vec<(f64, f64)> = Vec::new();
        for curve in &curves {
            assert!((2..=MAX_CURVE_POINTS).contains(&curve.points.len()), "{n}: {}", curve.points.len());
            assert_eq!(curve.points[0].time_secs, 0.0);
            let absolute = curve.points.iter().map(|point| (curve.time_secs + point.time_secs, point.value));
            let absolute: Vec<(f64, f64)> = absolute.collect();
            if let Some(last) = joined.pop() {
                assert_eq!(last, absolute[0], "the point is shared");
            }
            joined.extend(absolute);
        }
        assert_eq!(joined.len(), n as usize);
        assert!(joined.iter().enumerate().all(|(i, (secs, _))| *secs == 0.5 * i as f64));
    }
}

/// Patterns as files may hold them.
fn patterns() -> impl Strategy<Value = AhapPattern> {
    let times = || proptest::collection::vec(0.0..100.0_f64, 1..6);
    let event = (0..4_usize, 0.0..100.0_f64, 0.0..30.0_f64, 0.0..=1.0_f64, 0..10_usize);
    let event = event.prop_map(|(kind, time_secs, duration_secs, value, id)| AhapEvent {
        kind: [
            AhapEventKind::HapticTransient,
            AhapEventKind::HapticContinuous,
            AhapEventKind::AudioContinuous,
            AhapEventKind::AudioCustom,
        ][kind],
        time_secs,
        duration_secs,
        parameters: vec![(EventParameterId::ALL[id], value)],
    });
    let curve = (0..12_usize, times(), 0.0..=1.0_f64).prop_map(|(id, mut times, value)| {
        times.sort_by(f64::total_cmp);
        let points = times.into_iter().map(|time_secs| ControlPoint { time_secs, value });
        // At the start of the pattern, so that no time looks absolute.
        ParameterCurve { id: ControlId::ALL[id], time_secs: 0.0, points: points.collect() }
    });
    let dynamic = (0..12_usize, 0.0..100.0_f64, 0.0..=1.0_f64)
        .prop_map(|(id, time_secs, value)| DynamicParameter { id: ControlId::ALL[id], time_secs, value });
    let all = (
        proptest::collection::vec(event, 0..6),
        proptest::collection::vec(curve, 0..6),
        proptest::collection::vec(dynamic, 0..6),
    );
    all.prop_map(|(events, curves, parameters)| AhapPattern { events, curves, parameters })
}

proptest! {
    #[test]
    fn every_pattern_comes_back_from_its_file(pattern in patterns(), text in ".{0,20}") {
        let back = AhapPattern::from_json(&pattern.to_json(&text));
        prop_assert_eq!(back, Ok(Imported { value: pattern, warnings: Vec::new() }));
    }

    #[test]
    fn any_bytes_are_a_pattern_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(AhapPattern::from_json(&bytes).is_err());
    }
}
