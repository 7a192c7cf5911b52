use super::{
    HEADER_BYTES, MAX_SAMPLES, ParentV1, SidecarV1, TraceV1, WavWriteError, check_length, sidecar_path,
    write_wav, write_wav_as, write_wav_scaled,
};
use crate::wav_encoding::{Level, SampleType, WavEncoding, pack};
use std::collections::BTreeMap;
use std::fs;

fn sidecar() -> SidecarV1 {
    SidecarV1 {
        channels: vec!["acceleration".into()],
        at: Some(vec![30.0, 70.0]),
        at_named: Some(BTreeMap::from([("a-b".into(), 30.0), ("c".into(), 70.0)])),
        blend: "shared".into(),
        parents: vec![ParentV1 { id: "cork".into(), weight: 1.0, licence: "CC0-1.0".into() }],
        library: "Starter".into(),
        label_source: Some("physical".into()),
        trace: TraceV1 {
            time_s: vec![0.0, 0.003],
            speed_mm_per_s: vec![100.0; 2],
            force_n: vec![1.0; 2],
            x_mm: Some(vec![0.0, 0.3]),
            y_mm: Some(vec![0.0; 2]),
            speed_normal_mm_per_s: Some(vec![Some(50.0), None]),
        },
        ..SidecarV1::new(1000, 0.003, 5, "shagreen")
    }
}

#[test]
fn samples_and_sidecar_come_back_exactly() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.wav");
    // Values above one are kept, because the unit is m/s², not a fraction of full scale.
    write_wav(&path, &[0.25, -7.5, 1e-9], &sidecar()).unwrap();
    let mut reader = hound::WavReader::open(&path).unwrap();
    assert_eq!((reader.spec().channels, reader.spec().sample_rate), (1, 1000));
    let samples: Vec<f32> = reader.samples().map(Result::unwrap).collect();
    assert_eq!(samples, [0.25, -7.5, 1e-9]);
    let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
    assert_eq!(beside, sidecar());
    // A sidecar of an earlier version states no names.
    let mut older = serde_json::to_value(sidecar()).unwrap();
    assert_eq!(older["at_named"]["c"], 70.0);
    older.as_object_mut().unwrap().remove("at_named");
    let read: SidecarV1 = serde_json::from_value(older).unwrap();
    assert_eq!(read, SidecarV1 { at_named: None, ..sidecar() });
    // Only a loop says whether it is one.
    assert!(serde_json::to_value(sidecar()).unwrap().get("loop").is_none());
    let looped = SidecarV1 { loops: true, ..sidecar() };
    let json = serde_json::to_value(&looped).unwrap();
    assert_eq!(json["loop"], true);
    assert_eq!(serde_json::from_value::<SidecarV1>(json).unwrap(), looped);
}

#[test]
fn the_tip_lands_where_its_force_begins() {
    let trace = |force_n: &[f64], impact: Option<f64>| TraceV1 {
        time_s: (0..force_n.len()).map(|i| 0.1 * i as f64).collect(),
        speed_mm_per_s: vec![100.0; force_n.len()],
        force_n: force_n.to_vec(),
        speed_normal_mm_per_s: Some(std::iter::once(impact).chain(vec![None; force_n.len() - 1]).collect()),
        ..TraceV1::default()
    };
    let landing = trace(&[0.0, 0.5, 0.5, 0.0, 0.0, 1.0], None);
    assert_eq!(landing.landings_secs(), [0.1, 0.5]);
    assert_eq!((landing.steady(), trace(&[1.0, 1.0], None).steady()), (None, Some((100.0, 1.0))));
    assert_eq!(trace(&[1.0, 1.0], None).landings_secs(), Vec::<f64>::new());
    assert_eq!(trace(&[1.0, 1.0], Some(0.0)).landings_secs(), Vec::<f64>::new());
    assert_eq!(trace(&[1.0, 1.0], Some(50.0)).landings_secs(), [0.0]);
    assert_eq!((TraceV1::default().landings_secs().len(), TraceV1::default().steady()), (0, None));
}

/// What a player plays is below full scale, and the sidecar gives the acceleration back.
#[test]
fn peaks_fit_every_player_and_the_sidecar_undoes_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.wav");
    let given = [0.25, -7.5, 3.0, 0.0];
    for (samples, bits, step) in
        [(SampleType::Float32, 32, 1e-7), (SampleType::Pcm24, 24, 1.2e-7), (SampleType::Pcm16, 16, 3.1e-5)]
    {
        write_wav_as(&path, &given, &sidecar(), WavEncoding { samples, level: Level::Peak }).unwrap();
        let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
        let mut reader = hound::WavReader::open(&path).unwrap();
        assert_eq!(reader.spec().bits_per_sample, bits);
        let full = f64::from(2.0_f32.powi(i32::from(bits) - 1) - 1.0);
        let read: Vec<f64> = match samples {
            SampleType::Float32 => reader.samples::<f32>().map(|x| f64::from(x.unwrap())).collect(),
            _ => reader.samples::<i32>().map(|x| f64::from(x.unwrap()) / full).collect(),
        };
        let peak = read.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
        assert!((peak - 10_f64.powf(-0.05)).abs() < 1e-4, "{peak}");
        for (x, expected) in read.iter().zip(given) {
            assert!((x * beside.full_scale - f64::from(expected)).abs() < step * beside.full_scale, "{x}");
        }
    }
    // Silence has no peak; integers cannot hold the level of floats, so it is not kept.
    write_wav_as(
        &path,
        &[0.0; 4],
        &sidecar(),
        WavEncoding { samples: SampleType::Pcm16, level: Level::Kept },
    )
    .unwrap();
    let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
    assert_eq!(beside.full_scale, 1.0);
}

#[test]
fn signals_at_one_scale_keep_the_ratio_of_their_levels() {
    let folder = tempfile::tempdir().unwrap();
    let [loud, quiet] = [[0.5_f32, -4.0], [0.25, -2.0]];
    let scale = WavEncoding { samples: SampleType::Pcm16, level: Level::Peak }.full_scale(&loud);
    let read = |name: &str, samples: &[f32]| {
        let path = folder.path().join(name);
        write_wav_scaled(&path, samples, &sidecar(), (SampleType::Pcm16, scale)).unwrap();
        let mut reader = hound::WavReader::open(&path).unwrap();
        reader.samples::<i32>().map(|x| f64::from(x.unwrap())).collect::<Vec<f64>>()
    };
    let (loud, quiet) = (read("loud.wav", &loud), read("quiet.wav", &quiet));
    // Each number is rounded to a whole one.
    assert!(loud.iter().zip(&quiet).all(|(loud, quiet)| (loud - 2.0 * quiet).abs() <= 1.5), "{quiet:?}");
}

#[test]
fn nothing_is_left_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.wav");
    fs::create_dir(sidecar_path(&path)).unwrap();
    assert!(write_wav(&path, &[0.0], &sidecar()).is_err());
    assert!(!path.exists());
    assert!(write_wav(&folder.path().join("x.json"), &[0.0], &sidecar()).is_err());
    assert!(!folder.path().join("x.json").exists());
}

#[test]
fn what_32_bits_cannot_count_is_refused() {
    let header = pack(&[], 1.0, 1000, SampleType::Float32).unwrap();
    assert_eq!(header.len(), HEADER_BYTES as usize);
    assert!(check_length(MAX_SAMPLES).is_ok());
    let fits = |n_samples: u64| u32::try_from(4 * n_samples + u64::from(HEADER_BYTES)).is_ok();
    assert!(fits(MAX_SAMPLES) && !fits(MAX_SAMPLES + 1));
    let error = check_length(MAX_SAMPLES + 1).unwrap_err();
    assert!(matches!(error, WavWriteError::TooLong { n_samples } if n_samples == MAX_SAMPLES + 1));
}
