//! WAV files and their sidecar files.

use super::{map, open, wav};
use crate::recording::{Ask, ColumnMap, read_recording};
use crate::wav::{FORMAT, SidecarV1, TraceV1, VERSION, write_wav};
use shagreen_core::recording::{RawClock, RawMotion, RawTrack};
use shagreen_core::units::Hertz;

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
    assert!(file.warnings[0].contains("truncated"), "{:?}", file.warnings);
    for (bytes, words) in
        [(wav(2, 1, 16, &[0; 4]), "compressed"), (b"RIFF".to_vec(), "does not begin with a WAV header")]
    {
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
    let trace = TraceV1 {
        time_s: vec![0.0, 0.002],
        speed_mm_per_s: vec![100.0, 200.0],
        force_n: vec![1.0, 1.0],
        ..TraceV1::default()
    };
    let sidecar = SidecarV1 {
        format: FORMAT.into(),
        version: VERSION.into(),
        units: "m/s^2".into(),
        full_scale: 1.0,
        channels: vec!["acceleration".into()],
        rate_hz: 1000,
        seconds: 0.003,
        loops: false,
        name: None,
        texture: None,
        at: None,
        at_named: None,
        shape: None,
        clamped: false,
        extrapolated: false,
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
    let RawMotion::Speed(RawTrack::Column(speed)) = file.raw.motion else {
        panic!("the motion is not a speed column")
    };
    assert!(speed.iter().zip([0.1, 0.15, 0.2]).all(|(a, b)| (a - b).abs() < 1e-12), "{speed:?}");
    assert_eq!(file.raw.force_n, RawTrack::Column(vec![1.0; 3]));
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

#[test]
fn the_sidecar_of_the_guide_says_all() {
    let guide = include_str!("../../../../../docs/guide/import-recordings.md");
    let (_, block) = guide.split_once("```json\n").unwrap();
    let (sidecar, _) = block.split_once("```").unwrap();
    let halves = [0, 0x40].repeat(5);
    let file =
        read_recording("a.wav", &wav(1, 5, 16, &halves), Some(sidecar.as_bytes()), &ColumnMap::default())
            .unwrap();
    assert!(file.questions.is_empty() && file.warnings.is_empty(), "{file:?}");
    assert_eq!(file.raw.acceleration_mps2, [[10.0], [10.0], [10.0]]);
    assert_eq!(file.raw.motion, RawMotion::Speed(RawTrack::Column(vec![0.25])));
    assert_eq!(file.raw.force_n, RawTrack::Column(vec![5.0]));
}
