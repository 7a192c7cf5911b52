//! Haptic clips and tables of envelopes.

use super::{map, open, read};
use crate::haptic_clip::{AmplitudePoint, HapticClip};
use crate::recording::{Ask, ColumnMap, RecordingFileError, read_recording};
use shagreen_core::recording::{RawClock, RawTrack, Recording};
use shagreen_core::signals::haptic_outline::HapticOutline;
use shagreen_core::units::Hertz;

const STROKE: [(Ask, &str); 2] = [(Ask::Speed, "100 mm/s"), (Ask::Force, "1 N")];

fn clip() -> Vec<u8> {
    let point = |(time_secs, amplitude)| AmplitudePoint { time_secs, amplitude, emphasis: None };
    let amplitude = [(0.0, 0.2), (1.0, 0.8), (2.0, 0.8)].map(point).to_vec();
    HapticClip { amplitude, ..HapticClip::default() }.to_json()
}

#[track_caller]
fn refused(text: &str, answers: &[(Ask, &str)]) -> String {
    match read_recording("a.csv", text.as_bytes(), None, &map(answers)) {
        Err(RecordingFileError::NeedsAnswers(needed)) => panic!("{needed}"),
        Err(error) => error.to_string(),
        Ok(_) => panic!("it was read"),
    }
}

#[test]
fn a_clip_asks_for_the_stroke_and_says_what_it_assumes() {
    assert_eq!(open(&clip(), &[]), [Ask::Speed, Ask::Force]);
    let file = read_recording("a.haptic", &clip(), None, &map(&STROKE)).unwrap();
    let guessed: Vec<(Ask, &str)> =
        file.questions.iter().map(|q| (q.what, q.guess.as_deref().unwrap())).collect();
    assert_eq!(guessed, [(Ask::FrequencyRange, "60-300"), (Ask::FullScale, "1")]);
    assert_eq!(file.raw.clock, RawClock::Rate(Hertz(4000.0)));
    assert_eq!(file.raw.force_n, RawTrack::Constant(1.0));
    // Reading again with the resulting map gives the same result without questions.
    let again = read_recording("a.haptic", &clip(), None, &file.map).unwrap();
    assert_eq!((&again.raw, again.questions.len()), (&file.raw, 0));
    // Other answers change what they say.
    let mut loud = map(&STROKE);
    loud.answer(Ask::FullScale, "2").unwrap();
    loud.answer(Ask::AccelerationUnit, "m/s^2").unwrap();
    loud.answer(Ask::FrequencyRange, "60 to 300 Hz").unwrap();
    loud.answer(Ask::RateHz, "4000").unwrap();
    let loud = read_recording("a.haptic", &clip(), None, &loud).unwrap();
    assert!(loud.questions.is_empty(), "{:?}", loud.questions);
    let (quiet, loud) = (&file.raw.acceleration_mps2[0], &loud.raw.acceleration_mps2[0]);
    assert!(quiet.iter().zip(loud).all(|(quiet, loud)| (2.0 * quiet - loud).abs() < 1e-12));
    assert!(Recording::from_raw(file.raw.clone()).is_ok());
}

#[test]
fn a_clip_has_no_columns_and_a_speed_has_a_unit() {
    for (speed, force, given) in
        [("100", "1 N", "\"100\""), ("100mph", "1 N", "\"100mph\""), ("1 m/s", "2", "\"2\"")]
    {
        let answers = map(&[(Ask::Speed, speed), (Ask::Force, force)]);
        match read_recording("a.haptic", &clip(), None, &answers) {
            Err(RecordingFileError::Map { problem }) => assert!(problem.contains(given), "{problem}"),
            other => panic!("{other:?}"),
        }
    }
    for (what, answer, units) in
        [(Ask::Speed, "-1mm/s", "(mm/s, cm/s, m/s)"), (Ask::Force, "-2N", "(N, mN, gf)")]
    {
        let error = ColumnMap::default().answer(what, answer).unwrap_err();
        assert!(error.answer == answer && error.needs.contains(units), "{error}");
    }
}

/// What the export of clips measures in a signal is what the clip was.
#[test]
fn the_signal_has_the_envelope_of_the_clip() {
    let file = read_recording("a.haptic", &clip(), None, &map(&STROKE)).unwrap();
    let samples: Vec<f32> = file.raw.acceleration_mps2[0].iter().map(|sample| *sample as f32).collect();
    let outline = HapticOutline::of(&samples, Hertz(4000.0), &[]);
    for point in &outline.points {
        let secs = point.time_secs;
        // At the ends, the window of the measurement is not full.
        if (0.05..1.95).contains(&secs) {
            let expected = 0.2 + 0.6 * secs.min(1.0);
            // A sine has a ripple of 1 % in this window, and the corner at 1 s is rounded.
            assert!((point.amplitude_mps2 - expected).abs() < 0.03, "{point:?} {expected}");
            assert!((point.frequency.0 - 180.0).abs() < 10.0, "{point:?}");
        }
    }
}

#[test]
fn a_range_of_frequencies_is_two_numbers() {
    for text in ["60-300", "60 - 300 Hz", "60,300", "60 to 300"] {
        assert_eq!(map(&[(Ask::FrequencyRange, text)]).frequency_range_hz, Some([60.0, 300.0]), "{text}");
    }
    for text in ["", "60", "300-60", "a-b", "-60-300", "60-inf"] {
        let error = ColumnMap::default().answer(Ask::FrequencyRange, text).unwrap_err().to_string();
        assert!(error.contains("two frequencies in Hz"), "{text}: {error}");
    }
}

#[test]
fn a_table_of_an_envelope_is_a_signal() {
    let table = "time,amplitude,frequency\n0,0.5,100\n1,0.5,100\n2,0,100\n";
    assert_eq!(open(table.as_bytes(), &[]), [Ask::Speed, Ask::Force]);
    let file = read(table, &STROKE);
    let guessed: Vec<Ask> = file.questions.iter().map(|question| question.what).collect();
    assert_eq!(guessed, [Ask::TimeUnit, Ask::FullScale]);
    let samples = &file.raw.acceleration_mps2[0];
    assert_eq!(samples.len(), 8000);
    // A quarter of a period after the start.
    assert!((samples[10] - 0.5).abs() < 1e-9);
    let again = read_recording("a.csv", table.as_bytes(), None, &file.map).unwrap();
    assert_eq!((again.raw, again.questions.len()), (file.raw, 0));
    // Units in the header, times in ms, other names, and frequencies from 0 to 1.
    let stated = read("Time (ms);Amplitude [m/s^2];Freq\n500;4;0,5\n1500;4;0,5\n", &STROKE);
    assert_eq!(stated.questions.iter().map(|q| q.what).collect::<Vec<_>>(), [Ask::FrequencyRange]);
    let samples = &stated.raw.acceleration_mps2[0];
    assert_eq!((samples.len(), stated.map.full_scale), (4000, Some(4.0)));
    assert!((samples.iter().fold(0.0_f64, |most, sample| most.max(*sample)) - 4.0).abs() < 0.05);
}

#[test]
fn what_is_no_envelope_is_named() {
    let waveform = "time [s],amplitude,frequency\n0,-0.5,100\n1,0.5,100\n";
    assert!(refused(waveform, &STROKE).contains("it is a waveform and not an envelope"));
    // A waveform that is named as one is read as one.
    let mut named = map(&STROKE);
    named.answer(Ask::Acceleration, "amplitude").unwrap();
    let error = read_recording("a.csv", waveform.as_bytes(), None, &named).unwrap_err();
    assert!(matches!(error, RecordingFileError::NeedsAnswers(_)), "{error}");
    for (row, words) in [
        ("1,3,100", "from 0 to 1; divide them"),
        ("1,0.5,-100", "frequencies are at least 0"),
        ("1,0.5,3000", "cannot be made into a signal"),
        ("-1,0.5,100", "must not decrease"),
        ("500,0.5,100", "at most 120 s are rendered"),
    ] {
        let said = refused(&format!("time [s],amplitude,frequency\n0,0.5,100\n{row}\n"), &STROKE);
        assert!(said.contains(words), "{row}: {said}");
    }
    let slow = read_recording("a.haptic", &clip(), None, &map(&[(Ask::RateHz, "100")])).unwrap_err();
    assert!(slow.to_string().contains("rate_hz is 100"), "{slow}");
    let damaged = read_recording("a.haptic", b"{\"version\"", None, &ColumnMap::default()).unwrap_err();
    assert!(matches!(damaged, RecordingFileError::Clip { .. }), "{damaged}");
    // Without a frequency, a table is no envelope.
    assert!(refused("time [s],amplitude\n0,0.5\n1,0.5\n", &STROKE).contains("no acceleration"));
}
