use super::{AccelerationUnit, Ask, Column, ColumnMap, RecordingFile, RecordingFileError, read_recording};
use crate::wav::{FORMAT, SidecarV1, TraceV1, VERSION, write_wav};
use proptest::prelude::{any, prop, prop_assert_eq, proptest};
use shagreen_core::recording::{RawClock, RawMotion, RawTrack, Recording};
use shagreen_core::units::Hertz;
use std::path::Path;

fn map(answers: &[(Ask, &str)]) -> ColumnMap {
    let mut map = ColumnMap::default();
    for (what, answer) in answers {
        map.answer(*what, answer).unwrap();
    }
    map
}

#[track_caller]
fn read(text: &str, answers: &[(Ask, &str)]) -> RecordingFile {
    read_recording("a.csv", text.as_bytes(), None, &map(answers)).unwrap()
}

/// The questions without a guess.
fn open(bytes: &[u8], answers: &[(Ask, &str)]) -> Vec<Ask> {
    match read_recording("a.csv", bytes, None, &map(answers)).unwrap_err() {
        RecordingFileError::NeedsAnswers(needed) => {
            needed.questions.iter().filter(|q| q.guess.is_none()).map(|q| q.what).collect()
        }
        other => panic!("{other}"),
    }
}

#[test]
fn the_same_recording_in_every_dialect() {
    let expected = read("t_s,a [m/s^2],v [mm/s],F [N]\n0,1.5,100,1\n0.001,-2.5,50,0.5\n", &[]);
    assert_eq!(expected.raw.clock, RawClock::Times(vec![0.0, 0.001]));
    assert_eq!(expected.raw.acceleration_mps2, [vec![1.5, -2.5]]);
    assert_eq!(expected.raw.motion, RawMotion::Speed(RawTrack::Column(vec![0.1, 0.05])));
    assert_eq!(expected.raw.force_n, RawTrack::Column(vec![1.0, 0.5]));
    assert!(expected.questions.is_empty() && expected.warnings.is_empty());
    let wide: Vec<u8> = "\u{feff}t_s;a [m/s²];v [mm/s];F [N]\n0;1,5;100;1\n0,001;-2,5;50;0,5\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_eq!(read_recording("a.csv", &wide, None, &ColumnMap::default()).unwrap().raw, expected.raw);
    for text in [
        "\u{feff}Time (ms); Acc (m/s²); Speed (cm/s); Force (mN)\r\n0;1,5;10;1000\r\n\r\n1;-2,5;5;500\r\n",
        "# a logger\ntime_us\tforce_n\tacc_mps2\tspeed_mps\t\n5\t1\t1.5\t0.1\t\n1005\t0.5\t-2.5\t0.05\t\n",
        "\"t\",\"a\",\"v\",\"F\"\ns,m/s2,m/s,N\n0,1.5,0.1,1\n0.001,-2.5,0.05,0.5\n",
        "t[s]   a[m/s2]  v[m/s] F[N]\n  0 1,5 0,1 1\n  0,001   -2,5 0,05 0,5\n",
    ] {
        let mut raw = read(text, &[]).raw;
        if let RawClock::Times(times) = &mut raw.clock {
            for time in times {
                *time = (*time * 1e9).round() * 1e-9;
            }
        }
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(&raw.acceleration_mps2[0], &[1.5, -2.5]), "{text}");
        let RawMotion::Speed(RawTrack::Column(speed)) = &raw.motion else { panic!("{text}") };
        let RawTrack::Column(force) = &raw.force_n else { panic!("{text}") };
        let RawClock::Times(times) = &raw.clock else { panic!("{text}") };
        assert!(
            near(speed, &[0.1, 0.05]) && near(force, &[1.0, 0.5]) && near(times, &[0.0, 0.001]),
            "{text}"
        );
    }
    let headless = [
        (Ask::RateHz, "1000"),
        (Ask::Acceleration, "1"),
        (Ask::AccelerationUnit, "g"),
        (Ask::Speed, "100 mm/s"),
        (Ask::Force, "2"),
    ];
    let raw = read("1 0.5\n2 0.25\n", &headless).raw;
    assert_eq!(
        (raw.clock, raw.acceleration_mps2),
        (RawClock::Rate(Hertz(1000.0)), vec![vec![9.80665, 19.6133]])
    );
}

#[test]
fn what_is_not_said_is_asked() {
    let answers = [(Ask::Speed, "100 mm/s"), (Ask::Force, "1 N")];
    assert_eq!(open(b"t_s,ax\n0,1\n0.001,2\n", &[]), [Ask::AccelerationUnit, Ask::Speed, Ask::Force]);
    assert_eq!(open(b"t_s,x,y,z\n0,1,2,3\n0.001,1,2,4\n", &[])[0], Ask::Acceleration);
    assert_eq!(open(b"ax [g]\n1\n2\n", &answers), [Ask::RateHz]);
    assert_eq!(open(b"1,2\n1,3\n", &answers), [Ask::RateHz, Ask::Acceleration]);
    assert_eq!(open(b"t_s,ax [g],x,y\n0,1,2,3\n0.001,1,2,4\n", &[(Ask::Force, "1 N")]), [Ask::PositionUnit]);
    let error = read_recording("a.csv", b"t,ax\n0,1\n0.01,2\n", None, &ColumnMap::default()).unwrap_err();
    let message = error.to_string();
    for words in ["acceleration_unit", "speed", "force", "rate too low: 100 Hz"] {
        assert!(message.contains(words) && !message.contains('\n'), "{message}");
    }
}

#[test]
fn guesses_are_said_and_physics_decides_them() {
    let row = |row: i32| format!("{row},{},0.01,0.99,{},-0.5", 0.02 * f64::from(row % 2), 100 + row % 3);
    let text = format!("time,ax,ay,az,v,fz\n{}\n", (0..100).map(row).collect::<Vec<_>>().join("\n"));
    let read_file = read(&text, &[]);
    let guessed: Vec<(Ask, &str)> =
        read_file.questions.iter().map(|q| (q.what, q.guess.as_deref().unwrap())).collect();
    assert_eq!(
        guessed,
        [
            (Ask::TimeUnit, "ms"),
            (Ask::AccelerationUnit, "g"),
            (Ask::SpeedUnit, "mm/s"),
            (Ask::Force, "6"),
            (Ask::ForceUnit, "N"),
            (Ask::PressingIsNegative, "yes")
        ]
    );
    assert_eq!(read_file.map.acceleration_unit, Some(AccelerationUnit::StandardGravity));
    assert_eq!(read_file.raw.force_n, RawTrack::Column(vec![0.5; 100]));
    // What came out as the map reads the same again, without a question.
    let again = read_recording("a.csv", text.as_bytes(), None, &read_file.map).unwrap();
    assert_eq!((again.raw, again.questions.len()), (read_file.raw, 0));
}

#[test]
fn damage_is_named_with_its_place() {
    for (text, words) in [
        ("", "no rows"),
        ("t,a\n", "no rows"),
        ("t,a\n0,1\n1,2,3\n", "3 values where the table has 2 columns in line 3"),
        ("t,Fx,Fy,Fz,Ft\n0,1,2,3,4\n0.1,1,2,3,4\n", "no acceleration: the columns are \"t\", \"Fx\""),
        ("\0\0", "neither"),
    ] {
        let message =
            read_recording("a.csv", text.as_bytes(), None, &ColumnMap::default()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
    let error = read_recording("a.csv", b"t,a\n0,1\n", None, &map(&[(Ask::Speed, "w")])).unwrap_err();
    assert!(error.to_string().contains("no column \"w\""), "{error}");
    let twice = map(&[(Ask::Speed, "a"), (Ask::SpeedUnit, "m/s"), (Ask::AccelerationUnit, "g")]);
    let error = read_recording("a.csv", b"t_s,a\n0,1\n1,2\n", None, &twice).unwrap_err();
    assert!(error.to_string().contains("\"a\" cannot be two things"), "{error}");
    // Two columns of one name are two.
    let axes = read("t_s,a [g],a [g],v [m/s],f [N]\n0,1,2,1,1\n1,3,4,1,1\n", &[]);
    let again =
        [axes.map.acceleration.clone().unwrap(), vec![Column::Name("a [g]".into()), Column::Number(3)]];
    assert_eq!((axes.raw.acceleration_mps2.len(), &again[0]), (2, &again[1]));
    let lacking = format!("{}\n{}", ["c"; 900].join(","), "1\n".repeat(900));
    let error = read_recording("a.csv", lacking.as_bytes(), None, &ColumnMap::default()).unwrap_err();
    assert!(error.to_string().contains("too many lines have fewer values"), "{error}");
    let odd = "t_s,a [g],note,v [m/s],f [N]\n0,1,x,1,1\n0.001,bad,x,1,1\n0.002,1\n";
    let warnings = read(odd, &[]).warnings.join("; ");
    for words in ["1 lines have fewer", "1 cells of \"a [g]\"", "not used: \"note\""] {
        assert!(warnings.contains(words), "{warnings}");
    }
}

/// A WAV file with an odd chunk ahead of its samples.
fn wav(tag: u16, channels: u16, bits: u16, data: &[u8]) -> Vec<u8> {
    let block = channels * bits.div_ceil(8);
    let mut bytes = b"RIFF\0\0\0\0WAVEjunk\x03\0\0\0abc\0fmt \x10\0\0\0".to_vec();
    for part in [tag, channels] {
        bytes.extend(part.to_le_bytes());
    }
    bytes.extend(8000_u32.to_le_bytes());
    bytes.extend((8000 * u32::from(block)).to_le_bytes());
    bytes.extend(block.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    bytes.extend(b"data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

#[test]
fn samples_of_every_width_are_read() {
    let sidecar = br#"{"units": "m/s^2", "full_scale": 20, "speed_mm_per_s": 100, "force_n": 1}"#;
    let check = |tag: u16, bits: u16, data: &[u8], expected: &[f64]| {
        let file =
            read_recording("a.wav", &wav(tag, 1, bits, data), Some(sidecar), &ColumnMap::default()).unwrap();
        assert_eq!(file.raw.acceleration_mps2, [expected.to_vec()], "{bits} bits");
        assert_eq!(file.raw.clock, RawClock::Rate(Hertz(8000.0)));
    };
    check(1, 8, &[192, 0], &[10.0, -20.0]);
    check(1, 16, &[0, 0x40, 0, 0x80], &[10.0, -20.0]);
    check(1, 12, &[0, 0x40, 0, 0x80], &[10.0, -20.0]);
    check(1, 24, &[0, 0, 0x40, 0, 0, 0x80], &[10.0, -20.0]);
    check(1, 32, &[0, 0, 0, 0x40, 0, 0, 0, 0x80], &[10.0, -20.0]);
    check(3, 32, &[0.5_f32.to_le_bytes(), (-1.5_f32).to_le_bytes()].concat(), &[10.0, -30.0]);
    check(3, 64, &[0.5_f64.to_le_bytes(), (-1.5_f64).to_le_bytes()].concat(), &[10.0, -30.0]);
    let cut = wav(1, 1, 16, &[0, 0x40, 0, 0x80]);
    let file = read_recording("a.wav", &cut[..cut.len() - 2], Some(sidecar), &ColumnMap::default()).unwrap();
    assert!(file.warnings[0].contains("cut off"), "{:?}", file.warnings);
    for (bytes, words) in [(wav(2, 1, 16, &[0; 4]), "compressed"), (b"RIFF".to_vec(), "begin")] {
        let error = read_recording("a.wav", &bytes, None, &ColumnMap::default()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn a_wav_file_without_a_sidecar_asks_for_all_its_units() {
    let mono = wav(1, 1, 16, &[0, 1, 2, 3]);
    assert_eq!(open(&mono, &[]), [Ask::AccelerationUnit, Ask::FullScale, Ask::Speed, Ask::Force]);
    assert_eq!(open(&wav(1, 2, 16, &[0; 8]), &[]), [Ask::Channels]);
    let five = wav(
        3,
        5,
        32,
        &[[0.1_f32, 0.2, 0.3, 150.0, 2.0], [0.1, 0.2, 0.3, 150.0, 2.0]]
            .concat()
            .iter()
            .flat_map(|v| v.to_le_bytes())
            .collect::<Vec<u8>>(),
    );
    let sidecar = br#"{"units": "g", "full_scale": 20, "channels": ["x","y","z","speed","force"],
        "speed_units": "mm/s", "force_units": "N"}"#;
    let file = read_recording("a.wav", &five, Some(sidecar), &ColumnMap::default()).unwrap();
    assert_eq!(file.raw.acceleration_mps2.len(), 3);
    assert_eq!(file.raw.motion, RawMotion::Speed(RawTrack::Column(vec![0.15; 2])));
    assert_eq!(file.questions.len(), 2);
    let error = read_recording("a.wav", &five, Some(b"{\n\"units\": 5}"), &ColumnMap::default()).unwrap_err();
    assert!(error.to_string().contains("line 2"), "{error}");
}

#[test]
fn what_render_wrote_comes_back_with_its_trace() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.wav");
    let trace =
        TraceV1 { time_s: vec![0.0, 0.002], speed_mm_per_s: vec![100.0, 200.0], force_n: vec![1.0, 1.0] };
    let sidecar = SidecarV1 {
        format: FORMAT.into(),
        version: VERSION.into(),
        units: "m/s^2".into(),
        full_scale: 1.0,
        channels: vec!["acceleration".into()],
        rate_hz: 1000,
        seconds: 0.003,
        texture: None,
        at: None,
        clamped: false,
        blend: "shared".into(),
        parents: Vec::new(),
        library: String::new(),
        label_source: None,
        seed: 1,
        stroke: None,
        trace,
        created_by: "test".into(),
    };
    write_wav(&path, &[0.5, -7.5, 1.0], &sidecar).unwrap();
    let beside = std::fs::read(folder.path().join("out.json")).unwrap();
    let file =
        read_recording("out.wav", &std::fs::read(&path).unwrap(), Some(&beside), &ColumnMap::default())
            .unwrap();
    assert_eq!(file.raw.acceleration_mps2, [vec![0.5, -7.5, 1.0]]);
    let RawMotion::Speed(RawTrack::Column(speed)) = file.raw.motion else { panic!("no speed") };
    assert!(speed.iter().zip([0.1, 0.15, 0.2]).all(|(a, b)| (a - b).abs() < 1e-12), "{speed:?}");
    assert_eq!(file.raw.force_n, RawTrack::Column(vec![1.0; 3]));
}

/// A file of the shared data, where it is beside the checkout.
fn shared(file: &str) -> Option<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let bytes = std::fs::read(root.join("../shared/data").join(file)).ok();
    if bytes.is_none() {
        #[expect(clippy::print_stdout, reason = "a test says that it skipped")]
        {
            println!("skipped: ../shared/data/{file} is not there");
        }
    }
    bytes
}

#[test]
fn real_files_are_refused_with_all_their_reasons() {
    for (file, words) in [
        (
            "recordings/hapmat/Wood.csv",
            &["acceleration_unit", "speed:", "force:", "rate too low: 100 Hz"][..],
        ),
        ("recordings/force-press-slide/Material_Wood_raw_1.csv", &["no acceleration", "\"Ft\"", "bad clock"]),
        ("wav-oddities/phone_eh.wav", &["acceleration_unit", "full_scale"]),
        ("wav-oddities/wav_bad_fact.wav", &["does not say what its samples are"]),
    ] {
        let Some(bytes) = shared(file) else { continue };
        let message = read_recording(file, &bytes, None, &ColumnMap::default()).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
    let Some(bytes) = shared("recordings/hapmat/Wood.csv") else { return };
    let answers = [(Ask::AccelerationUnit, "g"), (Ask::Speed, "100 mm/s"), (Ask::Force, "1 N")];
    let file = read_recording("Wood.csv", &bytes, None, &map(&answers)).unwrap();
    let error = Recording::from_raw(file.raw).unwrap_err();
    assert_eq!(error.faults[0].name(), "rate too low");
}

proptest! {
    #[test]
    fn tables_in_any_dialect_give_their_numbers_back(
        rows in prop::collection::vec((-50.0..50.0_f64, 0.0..400.0_f64, 0.0..9.0_f64), 2..40),
        dialect in 0_usize..5,
        header in any::<bool>(),
    ) {
        let (separator, comma) = [(",", false), (";", false), (";", true), ("\t", true), ("  ", false)][dialect];
        let mut text = if header { ["t", "a", "v", "f"].join(separator) + "\n" } else { String::new() };
        for (row, (a, v, f)) in rows.iter().enumerate() {
            let fields = [row as f64 + 0.5, *a, *v, *f].map(|value| {
                let written = format!("{value:?}");
                if comma { written.replace('.', ",") } else { written }
            });
            text += &(fields.join(separator) + "\n");
        }
        let file = read(&text, &[(Ask::Time, "1"), (Ask::TimeUnit, "ms"), (Ask::Acceleration, "2"),
            (Ask::AccelerationUnit, "m/s^2"), (Ask::Speed, "3"), (Ask::SpeedUnit, "m/s"), (Ask::Force, "4"),
            (Ask::ForceUnit, "N"), (Ask::PressingIsNegative, "no")]);
        let column = |pick: fn(&(f64, f64, f64)) -> f64| rows.iter().map(pick).collect::<Vec<f64>>();
        prop_assert_eq!(&file.raw.acceleration_mps2[0], &column(|row| row.0));
        prop_assert_eq!(file.raw.motion, RawMotion::Speed(RawTrack::Column(column(|row| row.1))));
        prop_assert_eq!(file.raw.force_n, RawTrack::Column(column(|row| row.2)));
    }

    #[test]
    fn mutated_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20)) {
        let table = b"time_ms;ax [g];ay [g];x;y;f\n0;0,5;1;2;3;1\n1;0,25;1;2;3;1\n".to_vec();
        for start in [table, wav(3, 2, 64, &[0; 64]), wav(1, 3, 24, &[7; 36])] {
            let mut bytes = start;
            for (at, byte) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            if let Ok(file) = read_recording("a", &bytes, Some(&bytes), &ColumnMap::default()) {
                let _ = Recording::from_raw(file.raw);
            }
        }
    }
}

#[test]
fn a_table_without_numbers_is_refused_at_once() {
    // Were every line added to the names, this would take minutes.
    let text = "t;a\n".to_owned() + &"0.1;2.5\n".repeat(200_000);
    let error = read_recording("a.csv", text.as_bytes(), None, &map(&[(Ask::Separator, "tab")])).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("no rows of numbers") && message.contains("parted by tab"), "{message}");
}

#[test]
fn the_later_of_a_constant_and_a_column_counts() {
    let both = map(&[(Ask::Speed, "100 mm/s"), (Ask::Speed, "v"), (Ask::Force, "f"), (Ask::Force, "1 N")]);
    assert!(both.constant_speed.is_none() && both.speed.is_some());
    assert!(both.constant_force.is_some() && both.force.is_none());
    assert!(map(&[(Ask::Speed, "1 m/s"), (Ask::Positions, "x")]).constant_speed.is_none());
}

#[test]
fn a_speed_channel_stands_beside_the_force_of_a_trace() {
    let mut wav = b"RIFF\x30\0\0\0WAVEfmt \x10\0\0\0\x01\0\x02\0".to_vec();
    for number in [1000_u32, 4000, 0x0010_0004] {
        wav.extend(number.to_le_bytes());
    }
    wav.extend(b"data\x0c\0\0\0");
    wav.extend([16384_i16; 6].iter().flat_map(|sample| sample.to_le_bytes()));
    let sidecar = br#"{"acceleration_unit": "m/s^2", "full_scale": 2, "channels": ["speed", "acceleration"],
        "speed_unit": "mm/s", "speed_full_scale": 100, "speed_mm_per_s": 7,
        "trace": {"time_s": [0, 0.002], "speed_mm_per_s": [1, 1], "force_n": [1, 2]}}"#;
    for (map, expected) in [(map(&[]), [1.0, 1.5, 2.0]), (map(&[(Ask::RateHz, "500")]), [1.0, 2.0, 2.0])] {
        let raw = read_recording("a.wav", &wav, Some(sidecar), &map).unwrap().raw;
        assert_eq!(raw.acceleration_mps2, [vec![1.0; 3]]);
        assert_eq!(raw.motion, RawMotion::Speed(RawTrack::Column(vec![0.05; 3])));
        assert_eq!(raw.force_n, RawTrack::Column(expected.to_vec()));
    }
}
