//! Clips and patterns that other programs wrote, if they are there: the repository contains none.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and says what it skips")]

use std::fs;
use std::path::PathBuf;

use shagreen_formats::ahap::of_clip::ahap_of_clip;
use shagreen_formats::ahap::{
    AhapEvent, AhapEventKind, AhapPattern, ControlId, EventParameterId, ParameterCurve,
};
use shagreen_formats::clip::{ClipKind, read_clip};
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};

/// Numbers of the other program are rounded to 32 bits.
const ROUNDING: f64 = 1e-6;

/// Names and contents of the samples with this ending; `None` without samples.
fn samples(ending: &str) -> Option<Vec<(String, Vec<u8>)>> {
    let folder =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/haptic-files/meta-haptics-sdk");
    let Ok(entries) = fs::read_dir(&folder) else {
        println!("skipped: {} does not exist", folder.display());
        return None;
    };
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|of| of == ending)).collect();
    paths.sort();
    assert!(paths.len() > 10, "{} samples", paths.len());
    let named =
        |path: PathBuf| (path.file_stem().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap());
    Some(paths.into_iter().map(named).collect())
}

/// Whether a sample breaks a rule, by its name. The tests of one rule are named after it, except one that breaks none.
fn is_invalid(name: &str) -> bool {
    name.starts_with("invalid") || (name.starts_with("validation") && name != "validation_v1_optionals")
}

#[test]
fn every_valid_clip_is_read_and_comes_back_and_every_other_is_refused() {
    let Some(samples) = samples("haptic") else { return };
    for (name, bytes) in samples {
        // The frequency envelope of one old clip is half a millisecond too long.
        let rules = if name == "2_points" { ClipRules::Legacy } else { ClipRules::Strict };
        let clip = HapticClip::from_json(&bytes, rules);
        assert_eq!(clip.is_err(), is_invalid(&name), "{name}: {clip:?}");
        if let Ok(clip) = clip {
            assert_eq!(HapticClip::from_json(&clip.to_json(), rules), Ok(clip), "{name}");
        }
        let signal = read_clip(ClipKind::Haptic, &bytes, [60.0, 300.0]);
        assert_eq!(signal.is_err(), is_invalid(&name), "{name}: {signal:?}");
    }
}

#[test]
fn every_valid_pattern_is_read_and_comes_back_and_every_other_is_refused() {
    let Some(samples) = samples("ahap") else { return };
    for (name, bytes) in samples {
        let pattern = AhapPattern::from_json(&bytes);
        assert_eq!(pattern.is_err(), is_invalid(&name), "{name}: {pattern:?}");
        let Ok(pattern) = pattern else { continue };
        // Their frequency envelopes begin late, and the exporter counted times from the start of the pattern.
        let is_absolute = matches!(&*name, "multiple_emphasis" | "valid_v1" | "valid_v1_continuous");
        assert_eq!(pattern.warnings.is_empty(), !is_absolute, "{name}: {:?}", pattern.warnings);
        let back = AhapPattern::from_json(&pattern.value.to_json("")).unwrap();
        assert_eq!(back.value, pattern.value, "{name}");
    }
}

/// Points of all curves of a parameter, with times from the start of the pattern, each shared point once.
fn joined(pattern: &AhapPattern, id: ControlId) -> Vec<[f64; 2]> {
    let absolute = |curve: &ParameterCurve| {
        curve.points.iter().map(|point| [curve.time_secs + point.time_secs, point.value]).collect::<Vec<_>>()
    };
    let mut points: Vec<[f64; 2]> =
        pattern.curves.iter().filter(|curve| curve.id == id).flat_map(absolute).collect();
    points.dedup();
    points
}

fn events(pattern: &AhapPattern, kind: AhapEventKind) -> Vec<[f64; 4]> {
    let numbers = |event: &AhapEvent| {
        let value = |id| event.value(id).unwrap();
        let [intensity, sharpness] =
            [EventParameterId::HapticIntensity, EventParameterId::HapticSharpness].map(value);
        [event.time_secs, event.duration_secs, intensity, sharpness]
    };
    pattern.events.iter().filter(|event| event.kind == kind).map(numbers).collect()
}

fn assert_near<const N: usize>(ours: &[[f64; N]], theirs: &[[f64; N]], what: &str) {
    assert_eq!(ours.len(), theirs.len(), "{what}");
    for (ours, theirs) in ours.iter().zip(theirs) {
        let is_near = ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < ROUNDING);
        assert!(is_near, "{what}: {ours:?} {theirs:?}");
    }
}

/// The other program exported these patterns from these clips; ours agree, but for the split of curves and for its error with
/// late frequency envelopes.
#[test]
fn patterns_of_clips_are_those_of_another_program() {
    let (Some(clips), Some(patterns)) = (samples("haptic"), samples("ahap")) else { return };
    for name in
        ["2_points", "3_points", "16_points", "17_points", "long_clip", "multiple_emphasis", "valid_v1"]
    {
        let named = |(known, _): &&(String, Vec<u8>)| known == name;
        let clip = &clips.iter().find(named).unwrap().1;
        let ours = ahap_of_clip(&HapticClip::from_json(clip, ClipRules::Legacy).unwrap());
        let theirs = &patterns.iter().find(named).unwrap().1;
        let theirs = AhapPattern::from_json(theirs).unwrap();
        let id = ControlId::HapticIntensityControl;
        assert_near(&joined(&ours.continuous, id), &joined(&theirs.value, id), name);
        if theirs.warnings.is_empty() {
            let id = ControlId::HapticSharpnessControl;
            assert_near(&joined(&ours.continuous, id), &joined(&theirs.value, id), name);
        }
        let kind = AhapEventKind::HapticContinuous;
        assert_near(&events(&ours.continuous, kind), &events(&theirs.value, kind), name);
        let kind = AhapEventKind::HapticTransient;
        let ours = ours.transients.unwrap_or_default();
        assert_near(&events(&ours, kind), &events(&theirs.value, kind), name);
    }
}
