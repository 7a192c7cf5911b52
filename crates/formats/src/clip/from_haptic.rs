//! The envelope of a `.haptic` clip.

use shagreen_core::signals::haptic_envelope::{
    BURST_DECAY_SECS, Burst, Curve, EnvelopeError, HapticEnvelope, Law, Voice,
};
use shagreen_core::units::Hertz;

use crate::haptic_clip::{ClipRules, HapticClip, HapticClipError, USUAL_FREQUENCY};
use crate::imported::Imported;

/// Parts of the names of editors, in lower case, of which old versions wrote frequencies outside the times of the amplitudes.
const OLD_EDITORS: [&str; 2] = ["lofelt", "haptics studio"];

/// Reads a clip by all rules. One of an editor that is known to break a rule may break it; a warning says so.
pub(super) fn read_haptic(bytes: &[u8]) -> Result<Imported<HapticClip>, HapticClipError> {
    let error = match HapticClip::from_json(bytes, ClipRules::Strict) {
        Err(error @ HapticClipError::FrequencyOutside { .. }) => error,
        read => return Ok(Imported { value: read?, warnings: Vec::new() }),
    };
    let clip = HapticClip::from_json(bytes, ClipRules::Legacy)?;
    let editor = clip.metadata.editor.to_lowercase();
    if !OLD_EDITORS.into_iter().any(|old| editor.contains(old)) {
        return Err(error);
    }
    let warning = "frequencies lie outside the times of the amplitudes, as old versions of the clip's editor wrote them; nothing is played at those times";
    Ok(Imported { value: clip, warnings: vec![warning.to_owned()] })
}

/// Returns the vibration of a clip that keeps the rules of clips. An emphasis is a decaying burst.
pub(super) fn envelope_of_clip(
    clip: &HapticClip,
    band_hz: [f64; 2],
) -> Result<HapticEnvelope, EnvelopeError> {
    // The rules are those of 32-bit numbers, which allow a little more than 1.
    let level = clip.amplitude.iter().map(|point| [point.time_secs, point.amplitude.min(1.0)]).collect();
    let mut frequency: Vec<[f64; 2]> =
        clip.frequency.iter().map(|point| [point.time_secs, point.frequency]).collect();
    if frequency.is_empty() {
        frequency.push([0.0, USUAL_FREQUENCY]);
    }
    let [low_hz, high_hz] = band_hz;
    let bursts = clip.amplitude.iter().filter_map(|point| {
        let emphasis = point.emphasis?;
        Some(Burst {
            start_secs: point.time_secs,
            amplitude: emphasis.amplitude.min(1.0),
            frequency: Hertz(low_hz + emphasis.frequency * (high_hz - low_hz)),
            decay_secs: BURST_DECAY_SECS,
        })
    });
    let bursts = bursts.collect();
    let voice = Voice {
        level: Curve::new(level, Law::Linear, [0.0, 1.0])?,
        frequency: Curve::new(frequency, Law::Linear, band_hz)?,
    };
    Ok(HapticEnvelope { voices: vec![voice], bursts })
}
