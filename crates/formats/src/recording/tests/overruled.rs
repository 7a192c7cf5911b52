//! Conflicts between file and column map, and impossible values.

use super::{map, open, read, wav};
use crate::recording::{Ask, ColumnMap, RecordingFileError, read_recording};
use shagreen_core::recording::{RawMotion, RawTrack};
use shagreen_core::units::MetersPerSecond;

#[track_caller]
fn check_warning(text: &str, answers: &[(Ask, &str)], words: &[&str]) {
    let warnings = read(text, answers).warnings.join("; ");
    assert!(words.iter().all(|word| warnings.contains(word)), "{warnings}");
}

const TABLE: &str = "t_s,a [g],v [mm/s],F [N]\n0,1.5,100,1\n0.001,-2.5,50,0.5\n0.002,1.25,50,0.5\n";

#[test]
fn what_the_map_overrules_in_a_header_is_said() {
    for (what, answer, words) in [
        (
            Ask::AccelerationUnit,
            "m/s^2",
            "the unit of a [g] is g; the column map states m/s^2, which is used",
        ),
        (Ask::SpeedUnit, "m/s", "the unit of v [mm/s] is mm/s; the column map states m/s"),
        (Ask::ForceUnit, "mN", "the unit of F [N] is N; the column map states mN"),
        (Ask::TimeUnit, "ms", "the unit of t_s is s; the column map states ms"),
        (
            Ask::RateHz,
            "2000",
            "\"t_s\" is not used, because the sample rate is stated; its times give 1000.0 Hz, the column map 2000 Hz",
        ),
        (Ask::Speed, "100 mm/s", "\"v [mm/s]\" is not used, because a constant speed is stated"),
        (Ask::Force, "1 N", "\"F [N]\" is not used, because a constant force is stated"),
    ] {
        check_warning(TABLE, &[(what, answer)], &[words]);
    }
    let positions = "t_s,a [g],x [mm],F [N]\n0,1,2,1\n0.001,1,3,1\n";
    check_warning(positions, &[(Ask::PositionUnit, "m")], &["x [mm] is mm; the column map states m"]);
    // Agreement raises no warning.
    assert_eq!(read(TABLE, &[(Ask::AccelerationUnit, "g"), (Ask::RateHz, "1000")]).warnings.len(), 1);
    assert!(!read(TABLE, &[(Ask::RateHz, "1000")]).warnings[0].contains("its times"));
}

#[test]
fn a_column_that_is_not_there_is_an_error_even_beside_a_constant() {
    let mut both = map(&[(Ask::Speed, "w")]);
    both.constant_speed = Some(MetersPerSecond(0.1));
    let error = read_recording("a.csv", TABLE.as_bytes(), None, &both).unwrap_err().to_string();
    assert!(error.contains("there is no column \"w\"; the columns are \"t_s\""), "{error}");
    both.speed = None;
    let file = read_recording("a.csv", TABLE.as_bytes(), None, &both).unwrap();
    assert_eq!(file.raw.motion, RawMotion::Speed(RawTrack::Constant(0.1)));
}

#[test]
fn times_of_an_unlikely_unit_hint_at_another() {
    let answers = [(Ask::TimeUnit, "us")];
    check_warning(
        TABLE.replace("t_s", "t").as_str(),
        &answers,
        &["give 1000000000.0 Hz in us", "1000.0 Hz in s"],
    );
    let slow = TABLE.replace("0.001", "1").replace("0.002", "2");
    check_warning(
        &slow,
        &[],
        &["the times of t_s give 1.0 Hz in s, but 1000.0 Hz in ms; check the unit of time"],
    );
    assert!(read(TABLE, &[]).warnings.is_empty());
}

#[test]
fn a_decimal_comma_that_does_not_fit_is_named() {
    let comma = [(Ask::DecimalComma, "yes")];
    for (text, words) in [
        (
            "t_s;a [g];v [mm/s];F [N]\n0;1,000.5;1;1\n0.001;1,000.5;1;1\n",
            "2 of 2 cells of \"a [g]\" are not numbers",
        ),
        (
            "t_s,a [g]\n0,001,1,5\n",
            "4 values where the table has 2 columns; decimal_comma = true may be wrong",
        ),
        ("t_s;a [g]\n0,000.1;1,000.5\n", "no rows of numbers"),
    ] {
        let error = read_recording("a.csv", text.as_bytes(), None, &map(&comma)).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("decimal_comma = true"), "{error}");
    }
    // A file whose rows are read anyway raises no error.
    assert_eq!(read(TABLE, &comma).raw, read(TABLE, &[]).raw);
}

#[test]
fn forces_without_a_unit_are_asked_for_but_where_only_newtons_can_be() {
    let table = |forces: [f64; 4]| {
        let row = |(i, force): (usize, &f64)| format!("{},{},100,{force}", 0.001 * i as f64, i % 3);
        let rows: Vec<String> = forces.iter().enumerate().map(row).collect();
        format!("t_s,a [g],v [mm/s],F\n{}\n", rows.join("\n"))
    };
    // Fractions of full scale, counts, gram-force, values too high for newtons.
    for forces in
        [[0.2, 0.5, 1.0, 0.3], [0.0, 2.0, 1.0, 1.0], [0.2, 4.5, 30.5, 8.25], [70.5, 80.5, 60.5, 50.0]]
    {
        assert_eq!(open(table(forces).as_bytes(), &[]), [Ask::ForceUnit], "{forces:?}");
    }
    let file = read(&table([0.25, 1.75, 1.5, 0.5]), &[]);
    assert_eq!(file.questions[0].guess.as_deref(), Some("N"));
    // Neither sign is clearly that of pressing.
    let swinging = table([1.5, -1.25, 1.75, -1.5]);
    assert_eq!(open(swinging.as_bytes(), &[(Ask::ForceUnit, "N")]), [Ask::PressingIsNegative]);
    assert!(read(&swinging, &[(Ask::ForceUnit, "N"), (Ask::PressingIsNegative, "no")]).questions.is_empty());
}

#[test]
fn a_signal_of_zeros_is_told_before_all_questions() {
    let error = read_recording("a.csv", b"t_s,a\n0,0\n0.001,0\n", None, &ColumnMap::default()).unwrap_err();
    let message = error.to_string();
    assert!(message.starts_with("no signal: acceleration is 0 in every row"), "{message}");
    let RecordingFileError::NeedsAnswers(needed) = error else { panic!("{error}") };
    assert_eq!(needed.questions.len(), 3);
    let silent = wav(1, 1, 16, &[0; 40]);
    let error = read_recording("a.wav", &silent, None, &ColumnMap::default()).unwrap_err().to_string();
    assert!(error.starts_with("no signal"), "{error}");
}

#[test]
fn what_a_sidecar_says_in_vain_is_said() {
    let mono = wav(1, 1, 16, &[0, 0x40, 0, 0x80]);
    let warnings = |sidecar: &str, answers: &[(Ask, &str)]| {
        read_recording("a.wav", &mono, Some(sidecar.as_bytes()), &map(answers)).unwrap().warnings
    };
    let sidecar = r#"{"units": "m/s^2", "full_scale": 20, "speed_mm_per_s": 100, "force_n": 1}"#;
    assert_eq!(warnings(sidecar, &[]), [""; 0]);
    for (what, answer, words) in [
        (
            Ask::AccelerationUnit,
            "g",
            "the unit of acceleration is m/s^2; the column map states g, which is used",
        ),
        (Ask::FullScale, "30", "full_scale is 20; the column map states 30"),
        (Ask::Speed, "50 mm/s", "the constant speed is 100 mm/s; the column map states 50 mm/s"),
        (Ask::Force, "2 N", "the constant force is 1 N; the column map states 2 N"),
        (Ask::RateHz, "4000", "the sample rate is 8000 Hz; the column map states 4000 Hz"),
        (Ask::Acceleration, "ax", "the column map names columns (acceleration), but a WAV file has channels"),
    ] {
        let said = warnings(sidecar, &[(what, answer)]);
        assert!(said.len() == 1 && said[0].contains(words), "{said:?}");
    }
    let odd = sidecar.replace('{', r#"{"ful_scale": 3, "sensor": {"name": "x"}, "rate_hz": 44100, "#);
    let said = warnings(&odd, &[]);
    assert!(said[0].contains("\"ful_scale\", \"sensor\"; known keys are format"), "{said:?}");
    assert!(said[1].contains("the sidecar file states 44100 Hz, the WAV file 8000 Hz"), "{said:?}");
    // Sidecars of this program have more keys, which are known.
    let ours = sidecar.replace('{', r#"{"format": "shagreen-signal", "version": "1.0", "seed": 3, "#);
    assert_eq!(warnings(&ours, &[]), [""; 0]);
}
