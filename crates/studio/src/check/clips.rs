//! Check of `.haptic` clips and AHAP patterns: of each point and of each entry, the first broken rule.

use std::fmt::Display;

use anyhow::bail;
use shagreen_core::words::counted;
use shagreen_formats::ahap::AhapPattern;
use shagreen_formats::first_faults::FirstFaults;
use shagreen_formats::foreign_file::Found;
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};

use super::Checked;

/// Mark at the begin of some UTF-8 files.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Checks a `.haptic` clip by all rules.
///
/// # Errors
/// The bytes are no clip of the known version.
pub(super) fn checked_haptic(bytes: &[u8]) -> anyhow::Result<Checked> {
    let bytes = object(bytes, "a haptic clip (.haptic)", "haptic")?;
    let (clip, faults) = HapticClip::with_faults(bytes, ClipRules::Strict)?;
    let n_emphases = clip.amplitude.iter().filter(|point| point.emphasis.is_some()).count();
    let about = [
        format!("{} of amplitude", counted(clip.amplitude.len(), "point")),
        format!("{} of frequency", counted(clip.frequency.len(), "point")),
        counted(n_emphases, "short event"),
        format!("{:.3} s", clip.end_secs() - clip.start_secs()),
    ];
    Ok(checked(about.join(", "), &faults, Vec::new()))
}

/// Checks an AHAP pattern. What players ignore or clamp is a warning.
///
/// # Errors
/// The bytes are no pattern of the known version.
pub(super) fn checked_ahap(bytes: &[u8]) -> anyhow::Result<Checked> {
    let bytes = object(bytes, "an AHAP pattern (.ahap)", "ahap")?;
    let (read, faults) = AhapPattern::with_faults(bytes)?;
    let about = [
        counted(read.value.events.len(), "event"),
        counted(read.value.curves.len(), "curve"),
        format!("{:.3} s", read.value.end_secs()),
    ];
    Ok(checked(about.join(", "), &faults, read.warnings))
}

/// Returns the bytes of a JSON object without a byte order mark.
fn object<'a>(bytes: &'a [u8], wanted: &str, format: &str) -> anyhow::Result<&'a [u8]> {
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    if text.trim_ascii_start().first() == Some(&b'{') {
        return Ok(text);
    }
    bail!(Found::of(bytes).instead_of(wanted, format))
}

fn checked<T: Display>(about: String, faults: &FirstFaults<T>, warnings: Vec<String>) -> Checked {
    let first = faults.first.iter().map(ToString::to_string).collect();
    Checked { about, faults: first, warnings, n_faults: faults.n }
}

#[cfg(test)]
mod tests {
    use super::{checked_ahap, checked_haptic};

    const CLIP: &str = r#"{"version": {"major": 1}, "signals": {"continuous": {"envelopes": {
        "amplitude": [{"time": 0, "amplitude": 0.5, "emphasis": {"amplitude": 1, "frequency": 0}}, {"time": 1, "amplitude": 0}],
        "frequency": [{"time": 1, "frequency": 0.5}]}}}}"#;
    const PATTERN: &str = r#"{"Version": 1, "Pattern": [{"Event": {"EventType": "HapticContinuous", "EventDuration": 2,
        "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 1}]}}]}"#;

    #[test]
    fn a_clip_follows_the_rules_or_its_faults_are_named() {
        for text in [CLIP.to_owned(), format!("\u{feff}{CLIP}")] {
            let checked = checked_haptic(text.as_bytes()).unwrap();
            assert_eq!(checked.about, "2 points of amplitude, 1 point of frequency, 1 short event, 1.000 s");
            assert_eq!(checked.n_faults, 0);
        }
        let late = CLIP.replace("{\"time\": 1, \"frequency\"", "{\"time\": 2, \"frequency\"");
        let checked = checked_haptic(late.as_bytes()).unwrap();
        assert!(checked.faults[0].contains("point 1 of the frequency envelope") && checked.n_faults == 1);
        let loud = late.replace("\"amplitude\": 0.5", "\"amplitude\": 5");
        let checked = checked_haptic(loud.as_bytes()).unwrap();
        assert!(checked.faults[0].contains("point 1 of the amplitude envelope"), "{checked:?}");
        assert!(checked.faults[1].contains("point 1 of the frequency envelope") && checked.n_faults == 2);
        let error = checked_haptic(CLIP.replace("\"major\": 1", "\"major\": 2").as_bytes()).unwrap_err();
        assert!(error.to_string().contains("version 2"), "{error}");
    }

    #[test]
    fn a_pattern_follows_the_rules_or_its_faults_are_named() {
        let checked = checked_ahap(PATTERN.as_bytes()).unwrap();
        assert_eq!((&*checked.about, checked.warnings.len()), ("1 event, 0 curves, 2.000 s", 0));
        let loud = PATTERN.replace("\"ParameterValue\": 1", "\"ParameterValue\": 7");
        let checked = checked_ahap(loud.as_bytes()).unwrap();
        assert!(checked.n_faults == 0 && checked.warnings[0].contains("clamped"), "{checked:?}");
        let checked = checked_ahap(PATTERN.replace("\"Event\"", "\"Events\"").as_bytes()).unwrap();
        assert!(checked.faults[0].contains("entry 1") && checked.n_faults == 1, "{checked:?}");
        let twice =
            PATTERN.replace("\"Pattern\": [", "\"Pattern\": [{\"Event\": {\"EventType\": \"Buzz\"}}, {}, ");
        let checked = checked_ahap(twice.as_bytes()).unwrap();
        assert!(
            checked.faults[0].contains("\"Buzz\"") && checked.faults[1].contains("entry 2"),
            "{checked:?}"
        );
        assert_eq!((&*checked.about, checked.n_faults), ("1 event, 0 curves, 2.000 s", 2));
        assert!(checked_ahap(b"{\"Version\": 1}").unwrap_err().to_string().contains("`Pattern` is missing"));
        assert!(checked_ahap(b"").unwrap_err().to_string().contains("the file is empty"));
    }
}
