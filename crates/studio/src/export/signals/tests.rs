use std::path::{Path, PathBuf};

use shagreen_core::actuator::Drive;
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::Hertz;
use shagreen_formats::acf::acf;
use shagreen_formats::actuator_toml::built_in_actuators;
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};
use shagreen_formats::wav::{SidecarV1, TraceV1};
use shagreen_formats::wav_encoding::{Level, SampleType, WavEncoding};

use super::{refuse_foreign_files, shared_full_scale_mps2, signal_paths, write_signal};
use crate::export::{
    Rendered, SIGNAL_FORMATS, SignalFormat, SignalSamples, StrokeSignal, WAV, signal_format,
};
use crate::report::Warnings;

const RATE: Hertz = Hertz(1000.0);
const PEAK: WavEncoding = WavEncoding { samples: SampleType::Pcm16, level: Level::Peak };

fn of(samples: &[f32]) -> SignalSamples<'_> {
    SignalSamples { all: samples, without_taps: None, rate: RATE, loops: false }
}

/// Half a second in the air, then a landing.
fn landing() -> (Vec<f32>, SidecarV1) {
    let wave = |i: u32| if i < 500 { 0.0 } else { (0.9 * f64::from(i)).sin() as f32 };
    let trace = TraceV1 {
        time_s: vec![0.0, 0.49, 0.5, 1.0],
        speed_mm_per_s: vec![100.0; 4],
        force_n: vec![0.0, 0.0, 1.0, 1.0],
        ..TraceV1::default()
    };
    let sidecar = SidecarV1 {
        texture: Some("cork".to_owned()),
        library: "Starter".to_owned(),
        trace,
        ..SidecarV1::new(1000, 1.0, 1, "test")
    };
    ((0..1000).map(wave).collect(), sidecar)
}

fn files(format: &dyn SignalFormat, samples: &[f32], sidecar: &SidecarV1) -> Vec<(PathBuf, Vec<u8>)> {
    let samples = of(samples);
    let full_scale_mps2 = shared_full_scale_mps2([format.full_scale_mps2(samples, PEAK)]);
    let signal = StrokeSignal { samples, sidecar, encoding: PEAK, full_scale_mps2, acf: None };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("oak").with_extension(format.ending());
    let paths = write_signal(format, &signal, (&out, "test"), &Warnings::default()).unwrap();
    let named = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap();
        assert!(format.may_replace(&path, &bytes), "{}", path.display());
        (PathBuf::from(path.file_name().unwrap()), bytes)
    };
    paths.into_iter().map(named).collect()
}

#[test]
fn silence_has_the_scale_of_the_others() {
    assert_eq!(shared_full_scale_mps2([0.0, 0.25, 0.2]), 0.25);
    assert_eq!((shared_full_scale_mps2([0.0]), shared_full_scale_mps2([])), (1.0, 1.0));
    let (samples, _) = landing();
    for format in SIGNAL_FORMATS {
        assert_eq!(format.full_scale_mps2(of(&[0.0; 100]), PEAK), 0.0, "{}", format.id());
        let [quiet, loud] = [1.0, 3.0].map(|gain| {
            let samples: Vec<f32> = samples.iter().map(|x| gain * x).collect();
            format.full_scale_mps2(of(&samples), PEAK)
        });
        assert!((loud / quiet - 3.0).abs() < 1e-5, "{}", format.id());
    }
    // Samples in m/s² have one scale, whatever they are.
    let wav = signal_format(WAV.id).unwrap();
    assert_eq!(wav.full_scale_mps2(of(&[0.0; 100]), WavEncoding::default()), 1.0);
    assert_eq!(wav.full_scale_mps2(of(&samples), WavEncoding::default()), 1.0);
}

#[test]
fn every_format_writes_its_files_and_recognizes_them_only() {
    let (samples, sidecar) = landing();
    let all: Vec<_> =
        SIGNAL_FORMATS.into_iter().map(|format| (format, files(format, &samples, &sidecar))).collect();
    let names =
        |i: usize| all[i].1.iter().map(|(name, _)| name.to_string_lossy().into_owned()).collect::<Vec<_>>();
    assert_eq!(names(0), ["oak.wav", "oak.json"]);
    assert_eq!(names(1), ["oak.haptic"]);
    assert_eq!(names(2), ["oak.ahap", "oak.transients.ahap"]);
    assert_eq!(names(3), ["oak.android.json"]);
    assert_eq!(names(4), ["oak.openxr.json"]);
    for (format, _) in &all {
        for (other, files) in all.iter().filter(|(other, _)| other.id() != format.id()) {
            for (name, bytes) in files {
                assert!(!format.may_replace(name, bytes), "{} {}", format.id(), other.id());
            }
        }
    }
}

#[test]
fn files_say_what_they_lack_and_what_their_numbers_mean() {
    let tap = Some(Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 6.0 });
    let (samples, sidecar) = landing();
    for format in SIGNAL_FORMATS {
        let rendered = Rendered { texture: None, tap, rate: RATE, follows_stroke: true };
        let lost = format.lost(rendered).join("; ");
        assert!(lost.contains("all tip speeds and normal forces"), "{}: {lost}", format.id());
        assert_eq!(lost.contains("fine structure"), !format.stores_samples(), "{}: {lost}", format.id());
        assert_eq!(lost.contains("decay of tap"), !format.stores_samples(), "{}: {lost}", format.id());
        if !format.stores_samples() {
            let (name, bytes) = files(format, &samples, &sidecar).remove(0);
            let text = String::from_utf8(bytes).unwrap();
            assert!(text.contains("Amplitude 1 is 1.0") && text.contains("cork"), "{}", name.display());
        }
    }
}

#[test]
fn a_name_with_the_ending_of_another_format_is_refused() {
    for format in SIGNAL_FORMATS {
        let named = Path::new("/a/oak").with_extension(format.ending());
        let paths = signal_paths(format, &named, true).unwrap();
        assert_eq!(paths[0], named);
        let mut different = paths.clone();
        different.sort();
        different.dedup();
        assert_eq!(different.len(), paths.len(), "{paths:?}");
        let refused = signal_paths(format, Path::new("/a/oak.flac"), false).unwrap_err().to_string();
        assert!(refused.contains(format.ending()) && refused.contains(".flac"), "{refused}");
    }
    let wav = signal_format(WAV.id).unwrap();
    let paths = |out: &str| signal_paths(wav, Path::new(out), false).unwrap();
    assert_eq!(paths("/a/b.oak.WAV"), ["/a/b.oak.WAV", "/a/b.oak.json"].map(PathBuf::from));
    assert_eq!(paths("oak"), ["oak", "oak.json"].map(PathBuf::from));
}

#[test]
fn a_signal_does_not_overwrite_its_own_sidecar() {
    let folder = tempfile::tempdir().unwrap();
    let (samples, sidecar) = landing();
    let signal = StrokeSignal {
        samples: of(&samples),
        sidecar: &sidecar,
        encoding: PEAK,
        full_scale_mps2: 1.0,
        acf: None,
    };
    let out = folder.path().join("oak.json");
    let wav = signal_format(WAV.id).unwrap();
    let refused = write_signal(wav, &signal, (&out, "test"), &Warnings::default()).unwrap_err().to_string();
    assert!(refused.contains("ending in .wav") && !out.exists(), "{refused}");
}

#[test]
fn a_file_of_another_kind_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    for format in SIGNAL_FORMATS {
        let out = folder.path().join("oak").with_extension(format.ending());
        for path in signal_paths(format, &out, true).unwrap() {
            std::fs::write(&path, "my notes").unwrap();
            let refused = refuse_foreign_files(format, std::slice::from_ref(&path)).unwrap_err();
            assert!(refused.to_string().contains("would replace"), "{refused}");
            std::fs::remove_file(&path).unwrap();
            assert!(refuse_foreign_files(format, &[path]).is_ok());
        }
    }
}

#[test]
fn an_actuator_adds_its_file_and_an_old_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let actuator = built_in_actuators().unwrap();
    let actuator = actuator.into_iter().find(|known| known.response().is_ok()).unwrap();
    let acf = acf(&actuator, Drive::ASSUMED, "test").unwrap();
    let (samples, sidecar) = landing();
    let write = |id: &str, samples: &[f32], has_actuator: bool| {
        let format = signal_format(id).unwrap();
        let out = folder.path().join("oak").with_extension(format.ending());
        let acf = has_actuator.then_some(&acf);
        let samples = of(samples);
        let signal = StrokeSignal { samples, sidecar: &sidecar, encoding: PEAK, full_scale_mps2: 1.0, acf };
        let warnings = Warnings::default();
        let paths = write_signal(format, &signal, (&out, "test"), &warnings).unwrap();
        (paths.len(), warnings.into_vec())
    };
    assert_eq!(write("haptic", &samples, true), (2, Vec::new()));
    assert_eq!(write("haptic", &samples, false), (1, Vec::new()));
    assert_eq!(write("ahap", &samples, false), (2, Vec::new()));
    // A signal without onsets has no pattern of short events; that of the other signal is still there.
    let steady: Vec<f32> = samples.iter().skip(500).chain(samples.iter().skip(500)).copied().collect();
    let mut steady_sidecar = sidecar.clone();
    steady_sidecar.trace = TraceV1::default();
    let signal = StrokeSignal {
        samples: of(&steady),
        sidecar: &steady_sidecar,
        encoding: PEAK,
        full_scale_mps2: 1.0,
        acf: None,
    };
    let warnings = Warnings::default();
    let out = folder.path().join("oak.ahap");
    let paths = write_signal(signal_format("ahap").unwrap(), &signal, (&out, "test"), &warnings).unwrap();
    assert_eq!(paths, [out]);
    let warnings = warnings.into_vec();
    assert!(warnings.len() == 1 && warnings[0].contains("oak.transients.ahap"), "{warnings:?}");
}

/// A tap far above the texture is an emphasis, and the envelope is that of the texture alone.
#[test]
fn a_tap_does_not_bury_the_texture() {
    let (texture, sidecar) = landing();
    let texture: Vec<f32> = texture.iter().map(|x| 0.01 * x).collect();
    let tap = |i: usize| if i < 500 { 0.0 } else { (5.0 * (-0.1 * (i - 500) as f64).exp()) as f32 };
    let all: Vec<f32> = texture.iter().enumerate().map(|(i, x)| x + tap(i)).collect();
    let samples = SignalSamples { without_taps: Some(&texture), ..of(&all) };
    let made = |id: &str| {
        let format = signal_format(id).unwrap();
        let full_scale_mps2 = format.full_scale_mps2(samples, PEAK);
        let signal = StrokeSignal { samples, sidecar: &sidecar, encoding: PEAK, full_scale_mps2, acf: None };
        (full_scale_mps2, format.warning(&signal), format.files(&signal, "test").unwrap().remove(0).bytes)
    };
    for id in ["haptic", "ahap", "openxr"] {
        let (full_scale_mps2, warning, bytes) = made(id);
        assert!(full_scale_mps2 < 0.02, "{id}: {full_scale_mps2}");
        let warning = warning.unwrap();
        assert!(warning.contains("strongest tap") && warning.contains(" dB above"), "{warning}");
        assert!(String::from_utf8(bytes).unwrap().contains("The strongest tap is"), "{id}");
    }
    let clip = HapticClip::from_json(&made("haptic").2, ClipRules::Strict).unwrap();
    let emphases: Vec<f64> =
        clip.amplitude.iter().filter_map(|point| Some(point.emphasis?.amplitude)).collect();
    assert_eq!(emphases, [1.0]);
    let end = clip.amplitude.last().unwrap();
    assert!(end.amplitude > 0.8, "the texture is felt: {end:?}");
    // Without short events, the tap is in the envelope, and the file holds what the signal has.
    let (full_scale_mps2, warning, _) = made("android");
    assert!(full_scale_mps2 > 1.0 && warning.is_none());
}

#[test]
fn the_envelope_of_a_loop_ends_as_it_begins() {
    let (_, mut sidecar) = landing();
    (sidecar.trace, sidecar.loops) = (TraceV1::default(), true);
    let rising: Vec<f32> =
        (0..1000).map(|i| (f64::from(i) / 1e3 * (0.9 * f64::from(i)).sin()) as f32).collect();
    let ends = |loops: bool| {
        let samples = SignalSamples { loops, ..of(&rising) };
        let haptic = signal_format("haptic").unwrap();
        let full_scale_mps2 = haptic.full_scale_mps2(samples, PEAK);
        let signal = StrokeSignal { samples, sidecar: &sidecar, encoding: PEAK, full_scale_mps2, acf: None };
        let bytes = haptic.files(&signal, "test").unwrap().remove(0).bytes;
        let clip = HapticClip::from_json(&bytes, ClipRules::Strict).unwrap();
        let amplitudes = [clip.amplitude[0].amplitude, clip.amplitude.last().unwrap().amplitude];
        (amplitudes, [clip.frequency[0].frequency, clip.frequency.last().unwrap().frequency])
    };
    let ([first, last], [first_frequency, last_frequency]) = ends(true);
    assert_eq!((first, first_frequency), (last, last_frequency));
    let ([first, last], _) = ends(false);
    assert!(last > 5.0 * first, "{first} {last}");
}
