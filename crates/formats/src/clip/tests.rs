use proptest::prelude::{Strategy, any, prop_assert, proptest};
use shagreen_core::signals::haptic_envelope::{HapticEnvelope, USUAL_BAND_HZ};
use shagreen_core::units::Hertz;

use super::{ClipKind, read_clip};
use crate::ahap::of_clip::ahap_of_clip;
use crate::haptic_clip::{AmplitudePoint, Emphasis, FrequencyPoint, HapticClip};
use crate::haptic_maps::uri::uri_of;

const RATE: Hertz = Hertz(4000.0);
const MACARON: &str = r#"{"duration": 2000, "parameters": {
    "amplitude": {"valueScale": [0, 1], "data": [{"id": 1, "t": 1500, "value": 0.25, "selected": false},
        {"id": 0, "t": 500, "value": 0.75, "selected": true}]},
    "frequency": {"valueScale": [50, 500], "data": [{"id": 2, "t": 0, "value": 100}, {"id": 3, "t": 2000, "value": 300}]}}}"#;

fn clip(points: &[(f64, f64)], frequencies: &[(f64, f64)]) -> HapticClip {
    let amplitude = points.iter().map(|(time_secs, amplitude)| AmplitudePoint {
        time_secs: *time_secs,
        amplitude: *amplitude,
        emphasis: None,
    });
    let frequency = frequencies
        .iter()
        .map(|(time_secs, frequency)| FrequencyPoint { time_secs: *time_secs, frequency: *frequency });
    HapticClip { amplitude: amplitude.collect(), frequency: frequency.collect(), ..HapticClip::default() }
}

fn envelope(kind: ClipKind, bytes: &[u8]) -> HapticEnvelope {
    read_clip(kind, bytes, USUAL_BAND_HZ).unwrap().envelope
}

/// Amplitude and frequency in Hz of the only voice of an envelope.
fn at(envelope: &HapticEnvelope, secs: f64) -> [f64; 2] {
    let [voice] = &envelope.voices[..] else { panic!("{} voices", envelope.voices.len()) };
    [voice.level.at(secs), voice.frequency.at(secs)]
}

#[test]
fn a_file_is_recognized_by_its_content() {
    let clip = clip(&[(0.0, 0.5), (1.0, 0.5)], &[]).to_json();
    let pattern = br#"{"Version": 1.0, "Pattern": []}"#;
    for (name, bytes, kind) in [
        ("a.json", &clip[..], Some(ClipKind::Haptic)),
        ("a", pattern, Some(ClipKind::Ahap)),
        ("a.txt", MACARON.as_bytes(), Some(ClipKind::Macaron)),
        ("a.json", br#"{"format": "shagreen-library", "signals": 1}"#, None),
        ("a.json", b"{}", None),
        ("a.json", b"{\"signals\": ", None),
        // A damaged file is what its name says.
        ("a.HAPTIC", b"{\"signals\": ", Some(ClipKind::Haptic)),
        ("a.ahap", b"", Some(ClipKind::Ahap)),
        ("a.csv", b"t,a\n", None),
    ] {
        assert_eq!(ClipKind::of(name, bytes), kind, "{name} {:?}", String::from_utf8_lossy(bytes));
    }
}

#[test]
fn points_of_macaron_are_sorted_and_last_for_the_whole_clip() {
    let bare = envelope(ClipKind::Macaron, MACARON.as_bytes());
    for (secs, level) in [(0.0, 0.75), (0.5, 0.75), (1.0, 0.5), (1.5, 0.25), (2.0, 0.25)] {
        let [found, hz] = at(&bare, secs);
        assert!(
            (found - level).abs() < 1e-12 && (hz - 100.0 - 100.0 * secs).abs() < 1e-9,
            "{secs}: {found} {hz}"
        );
    }
    assert_eq!(bare.seconds(), 2.0);
    for head in ["\u{feff}", "data:text/json;charset=utf-8,", " data:application/octet-stream,"] {
        let file = format!("{head}{MACARON}");
        assert_eq!(ClipKind::of("a.json", file.as_bytes()), Some(ClipKind::Macaron), "{head:?}");
        assert_eq!(envelope(ClipKind::Macaron, file.as_bytes()), bare);
    }
    let copied = format!("data:text/json;charset=utf8,{}", uri_of(MACARON));
    assert_eq!(ClipKind::of("a.txt", copied.as_bytes()), Some(ClipKind::Macaron));
    assert_eq!(envelope(ClipKind::Macaron, copied.as_bytes()), bare);
    assert_eq!(ClipKind::of("a.json", b"data:text/json,%zz"), None);
    // A scale that is no scale in Hz is that of the band.
    let relative = MACARON.replace("[50, 500]", "[0, 1]").replace("100}", "0}").replace("300}", "0.5}");
    let read = read_clip(ClipKind::Macaron, relative.as_bytes(), [50.0, 250.0]).unwrap();
    assert!(read.has_relative_frequencies && read.warnings.is_empty());
    assert_eq!(at(&read.envelope, 2.0)[1], 150.0);
    let short = MACARON.replace("\"duration\": 2000", "\"duration\": 1000");
    let read = read_clip(ClipKind::Macaron, short.as_bytes(), USUAL_BAND_HZ).unwrap();
    assert_eq!((read.envelope.seconds(), at(&read.envelope, 1.0)[0]), (1.0, 0.5));
    assert!(read.warnings[0].contains("duration of 1000 ms; points after it: 2"), "{:?}", read.warnings);
}

#[test]
fn what_is_damaged_is_named() {
    for (from, to, words) in [
        ("\"duration\": 2000", "\"duration\": 0", "`duration` is 0 ms"),
        ("0.75", "1.5", "point 2 of amplitude is 1.5, outside its `valueScale` [0, 1]"),
        ("\"t\": 500", "\"t\": -5", "point 2 of amplitude is at -5 ms"),
        ("[50, 500]", "[500, 50]", "`valueScale` of frequency is [500, 50]"),
        ("\"frequency\"", "\"frequencies\"", "the field `frequency` is missing"),
        ("]}}}", "]}}", "it ends too early"),
    ] {
        let file = MACARON.replacen(from, to, 1);
        let error = read_clip(ClipKind::Macaron, file.as_bytes(), USUAL_BAND_HZ).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("export it again"), "{error}");
    }
    let none = MACARON
        .replace("[{\"id\": 2, \"t\": 0, \"value\": 100}, {\"id\": 3, \"t\": 2000, \"value\": 300}]", "[]");
    let error = read_clip(ClipKind::Macaron, none.as_bytes(), USUAL_BAND_HZ).unwrap_err().to_string();
    assert!(error.contains("no points"), "{error}");
    let error = read_clip(ClipKind::Haptic, b"{}", USUAL_BAND_HZ).unwrap_err().to_string();
    assert!(error.contains("clip"), "{error}");
}

/// Old versions of two editors wrote frequencies beyond the last amplitude; from others, that is an error.
#[test]
fn frequencies_outside_the_amplitudes_are_those_of_old_editors() {
    let mut clip = clip(&[(0.0, 0.5), (1.0, 0.5)], &[(0.0, 0.0), (1.001, 1.0)]);
    let read = |clip: &HapticClip| read_clip(ClipKind::Haptic, &clip.to_json(), USUAL_BAND_HZ);
    for editor in ["", "my editor"] {
        editor.clone_into(&mut clip.metadata.editor);
        let error = read(&clip).unwrap_err().to_string();
        assert!(error.contains("point 2 of the frequency envelope") && error.contains("move"), "{error}");
    }
    for editor in ["Lofelt GmbH", "Meta Haptics Studio 1.0"] {
        editor.clone_into(&mut clip.metadata.editor);
        let old = read(&clip).unwrap();
        assert!(old.warnings.len() == 1 && old.warnings[0].contains("old versions"), "{:?}", old.warnings);
        assert_eq!(old.envelope.seconds(), 1.0);
    }
    // All other rules hold for them too.
    clip.amplitude[1].amplitude = 1.5;
    assert!(read(&clip).is_err());
    // A rounded 1 can be rendered.
    clip.amplitude[1].amplitude = 1.0 + 1e-9;
    assert!(read(&clip).unwrap().envelope.render(RATE, 1.0).is_ok());
}

#[test]
fn an_emphasis_is_a_burst_in_the_band() {
    let mut clip = clip(&[(0.0, 0.25), (1.0, 0.25)], &[]);
    clip.amplitude[0].emphasis = Some(Emphasis { amplitude: 0.75, frequency: 0.5 });
    for (kind, bytes) in [
        (ClipKind::Haptic, clip.to_json()),
        (ClipKind::Ahap, ahap_of_clip(&clip).transients.unwrap().to_json("")),
    ] {
        let [burst] = envelope(kind, &bytes).bursts[..] else { panic!("one burst") };
        assert_eq!((burst.start_secs, burst.frequency), (0.0, Hertz(180.0)), "{kind:?}");
        assert!((burst.amplitude - 0.75).abs() < 1e-9, "{kind:?}");
    }
    // Without frequencies, the middle of the band is played.
    assert_eq!(at(&envelope(ClipKind::Haptic, &clip.to_json()), 0.5), [0.25, 180.0]);
}

#[test]
fn controls_of_a_pattern_act_on_all_events() {
    let read = |entries: &str| {
        let file = format!("{{\"Pattern\": [{entries}]}}");
        read_clip(ClipKind::Ahap, file.as_bytes(), [0.0, 100.0]).unwrap()
    };
    let event = |time: f64, seconds: f64, more: &str| {
        format!(
            "{{\"Event\": {{\"EventType\": \"HapticContinuous\", \"Time\": {time}, \"EventDuration\": {seconds}, \"EventParameters\": [{{\"ParameterID\": \"HapticIntensity\", \"ParameterValue\": 0.5}}{more}]}}}}"
        )
    };
    let plain = read(&event(1.0, 2.0, "")).envelope;
    // Silent before the event.
    assert_eq!((at(&plain, 1.5), plain.voices[0].level.times_secs().next()), ([0.25, 25.0], Some(1.0)));
    // A curve that begins at 2 s halves the intensity; a later single change ends it.
    let curve = "{\"ParameterCurve\": {\"ParameterID\": \"HapticIntensityControl\", \"Time\": 2, \"ParameterCurveControlPoints\": [{\"Time\": 0, \"ParameterValue\": 1}, {\"Time\": 1, \"ParameterValue\": 0}]}}";
    let change = "{\"Parameter\": {\"ParameterID\": \"HapticIntensityControl\", \"Time\": 2.5, \"ParameterValue\": 1}}";
    let curved = read(&format!("{},{curve},{change}", event(1.0, 2.0, ""))).envelope;
    for (secs, level) in [(1.9, 0.25), (2.25, 0.25 * 0.75 * 0.75), (2.6, 0.25), (3.0, 0.25)] {
        assert!((at(&curved, secs)[0] - level).abs() < 1e-12, "{secs}: {:?}", at(&curved, secs));
    }
    let sound = "{\"Event\": {\"EventType\": \"AudioContinuous\", \"EventDuration\": 1}}";
    let attack = ",{\"ParameterID\": \"AttackTime\", \"ParameterValue\": 0.5}";
    let noted = read(&format!("{},{sound}", event(0.0, 1.0, attack)));
    assert_eq!(noted.envelope.voices.len(), 1);
    for words in ["1 audio event is left out", "1 event has attack, decay or release times"] {
        assert!(noted.warnings.iter().any(|warning| warning.contains(words)), "{:?}", noted.warnings);
    }
    let fades = ",{\"ParameterID\": \"Sustained\", \"ParameterValue\": 0}";
    let control = change.replace("HapticIntensityControl", "HapticDecayTimeControl");
    let noted = read(&format!("{},{control}", event(0.0, 1.0, fades))).warnings;
    assert!(
        noted.len() == 2 && noted[0].contains("no sustained") && noted[1].contains("controls"),
        "{noted:?}"
    );
    assert!(read(&event(0.0, 1.0, &fades.replace(": 0}", ": 1}"))).warnings.is_empty());
}

#[test]
fn more_points_than_a_file_needs_are_refused() {
    let point = |i: u32| format!("{{\"Time\": {}, \"ParameterValue\": 1}}", f64::from(i) / 1000.0);
    let points = (0..1000).map(point).collect::<Vec<String>>().join(",");
    let curve = format!(
        "{{\"ParameterCurve\": {{\"ParameterID\": \"HapticIntensityControl\", \"ParameterCurveControlPoints\": [{points}]}}}}"
    );
    let event = "{\"Event\": {\"EventType\": \"HapticContinuous\", \"EventDuration\": 1}}";
    let file = format!("{{\"Pattern\": [{curve},{}]}}", vec![event; 1000].join(","));
    let error = read_clip(ClipKind::Ahap, file.as_bytes(), USUAL_BAND_HZ).unwrap_err().to_string();
    assert!(error.contains("more than 500000 points"), "{error}");
}

fn unit() -> impl Strategy<Value = f64> {
    0.0..=1.0_f64
}

proptest! {
    /// What is written as a clip or as a pattern is rendered with the same envelope. The root of an amplitude, which a pattern
    /// has, is linear between points, so only the points are compared.
    #[test]
    fn a_written_clip_has_its_envelope(
        values in proptest::collection::vec((0.01..0.5_f64, unit(), unit()), 2..12),
    ) {
        let mut secs = 0.0;
        let (mut points, mut frequencies) = (Vec::new(), Vec::new());
        for (step, amplitude, frequency) in values {
            points.push((secs, amplitude));
            frequencies.push((secs, frequency));
            secs += step;
        }
        let clip = clip(&points, &frequencies);
        let of_clip = envelope(ClipKind::Haptic, &clip.to_json());
        let of_pattern = envelope(ClipKind::Ahap, &ahap_of_clip(&clip).continuous.to_json(""));
        for ((secs, amplitude), (_, frequency)) in points.iter().zip(&frequencies) {
            for envelope in [&of_clip, &of_pattern] {
                let [level, hz] = at(envelope, *secs);
                prop_assert!((level - amplitude).abs() < 1e-9, "{level} {amplitude}");
                prop_assert!((hz - 60.0 - 240.0 * frequency).abs() < 1e-6, "{hz} {frequency}");
            }
        }
        // The peak of each period is the envelope, which changes little within one.
        let samples = of_clip.render(RATE, 2.0).unwrap();
        let highest = points.iter().fold(0.0_f64, |most, (_, amplitude)| most.max(*amplitude));
        prop_assert!(samples.iter().all(|sample| sample.abs() <= 2.0 * highest + 1e-9));
    }

    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300), name in "[a-z.]{0,8}") {
        for kind in [ClipKind::Haptic, ClipKind::Ahap, ClipKind::Macaron] {
            if let Ok(read) = read_clip(kind, &bytes, USUAL_BAND_HZ) {
                let _ = read.envelope.render(RATE, 1.0);
            }
        }
        let _ = ClipKind::of(&name, &bytes);
    }

    /// Numbers of any size in the place of the times and values.
    #[test]
    fn no_numbers_panic(number in any::<f64>(), index in 0..5_usize) {
        let places = ["2000, ", "1500", "0.25", "500]", "300}"];
        let place = places[index];
        let with = place.replace(|c: char| c.is_ascii_digit() || c == '.', "");
        let file = MACARON.replacen(place, &format!("{number}{with}"), 1);
        if let Ok(read) = read_clip(ClipKind::Macaron, file.as_bytes(), USUAL_BAND_HZ) {
            let _ = read.envelope.render(RATE, 1.0);
        }
    }
}
