//! The files of a small signal are those of `vectors/export`, which were written by hand.
#![allow(clippy::unwrap_used, reason = "a test may panic on an unexpected result")]

use serde_json::Value;
use shagreen_core::signals::haptic_outline::{HapticOutline, Onset, OutlinePoint, STEP_SECS};
use shagreen_core::units::Hertz;
use shagreen_formats::ahap::AhapPattern;
use shagreen_formats::ahap::of_clip::{AhapPair, ahap_of_clip};
use shagreen_formats::android_envelope::{android_envelope, write_android_envelope};
use shagreen_formats::clip_scale::ClipScale;
use shagreen_formats::haptic_clip::of_outline::clip_of_outline;
use shagreen_formats::haptic_clip::{ClipMetadata, ClipRules, HapticClip};
use shagreen_formats::openxr_parametric::{openxr_parametric, write_openxr_parametric};

const ABOUT: (&str, &str) = ("shagreen", "A triangle");
const CLIP: &[u8] = include_bytes!("../../../vectors/export/triangle.haptic");
const CONTINUOUS: &[u8] = include_bytes!("../../../vectors/export/triangle.ahap");
const TRANSIENTS: &[u8] = include_bytes!("../../../vectors/export/triangle.transients.ahap");
const ANDROID: &[u8] = include_bytes!("../../../vectors/export/triangle.android.json");
const OPENXR: &[u8] = include_bytes!("../../../vectors/export/triangle.openxr.json");

/// Amplitude and frequency as `vectors/export/README.md` states them.
fn triangle() -> HapticOutline {
    let point = |step: u32| {
        let share = f64::from(step) / 20.0;
        OutlinePoint {
            time_secs: f64::from(step) * STEP_SECS,
            amplitude_mps2: 1.0 - (2.0 * share - 1.0).abs(),
            frequency: Hertz(60.0 + 240.0 * share),
        }
    };
    let onset = Onset { point: 10, amplitude_mps2: 2.0, frequency: Hertz(300.0) };
    HapticOutline { points: (0..=20).map(point).collect(), onsets: vec![onset] }
}

fn scale() -> ClipScale {
    ClipScale::new(1.0, None)
}

fn clip() -> HapticClip {
    let metadata = ClipMetadata {
        editor: ABOUT.0.to_owned(),
        description: ABOUT.1.to_owned(),
        tags: vec!["triangle".to_owned()],
        ..ClipMetadata::default()
    };
    clip_of_outline(&triangle(), scale(), metadata).unwrap()
}

fn value(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).unwrap()
}

#[test]
fn a_clip_has_the_golden_values() {
    assert_eq!(value(&clip().to_json()), value(CLIP));
    assert_eq!(HapticClip::from_json(CLIP, ClipRules::Strict), Ok(clip()));
}

#[test]
fn patterns_have_the_golden_values() {
    let AhapPair { continuous, transients } = ahap_of_clip(&clip());
    let transients = transients.unwrap();
    for (pattern, golden) in [(continuous, CONTINUOUS), (transients, TRANSIENTS)] {
        assert_eq!(value(&pattern.to_json(ABOUT.1)), value(golden));
        assert_eq!(AhapPattern::from_json(golden).unwrap().value, pattern);
    }
}

#[test]
fn envelopes_for_android_have_the_golden_values() {
    let made = android_envelope(&triangle(), scale(), ABOUT);
    assert_eq!(value(&write_android_envelope(&made)), value(ANDROID));
}

#[test]
fn points_for_openxr_have_the_golden_values() {
    let made = openxr_parametric(&clip(), scale(), ABOUT);
    assert_eq!(value(&write_openxr_parametric(&made)), value(OPENXR));
}
