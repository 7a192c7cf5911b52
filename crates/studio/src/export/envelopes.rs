//! What the formats have in common that describe a signal by envelopes.

use shagreen_core::signals::haptic_outline::{HapticOutline, highest_amplitude_mps2};
use shagreen_formats::clip_scale::ClipScale;
use shagreen_formats::haptic_clip::of_outline::clip_of_outline;
use shagreen_formats::haptic_clip::{ClipMetadata, HapticClip};
use shagreen_formats::signal_description::signal_description;

use super::signal_format::{SignalSamples, StrokeSignal};
use super::stroke_losses::{Rendered, lost_of_stroke};

/// Acceleration in m/s² of the highest amplitude of the envelope, which has no taps; of the taps if there is nothing else. 0 for
/// silence.
pub(super) fn full_scale_mps2(samples: SignalSamples<'_>) -> f64 {
    let SignalSamples { all, without_taps, rate, loops } = samples;
    let highest = |samples: &[f32]| highest_amplitude_mps2(samples, rate, loops);
    without_taps.map(highest).filter(|highest| *highest > 0.0).unwrap_or_else(|| highest(all))
}

pub(super) fn outline_of(signal: &StrokeSignal<'_>) -> HapticOutline {
    let SignalSamples { all, without_taps, rate, loops } = signal.samples;
    let landings_secs = signal.sidecar.trace.landings_secs();
    match without_taps {
        Some(texture) => HapticOutline::with_taps(texture, all, rate, &landings_secs),
        None if loops => HapticOutline::of_loop(all, rate),
        None => HapticOutline::of(all, rate, &landings_secs),
    }
}

/// Acceleration in m/s² of the strongest onset that is above full scale.
fn highest_clipped_mps2(signal: &StrokeSignal<'_>, outline: &HapticOutline) -> Option<f64> {
    let highest = outline.onsets.iter().map(|onset| onset.amplitude_mps2).fold(0.0, f64::max);
    // The peak of a steady texture is above its amplitude; only taps are an event of their own.
    (signal.samples.without_taps.is_some() && highest > signal.full_scale_mps2).then_some(highest)
}

/// Warning about taps that are stronger than the files can say, if there are any.
pub(super) fn clipped_onset(signal: &StrokeSignal<'_>) -> Option<String> {
    signal.samples.without_taps?;
    let full_scale_mps2 = signal.full_scale_mps2;
    let highest_mps2 = highest_clipped_mps2(signal, &outline_of(signal))?;
    let over_db = 20.0 * (highest_mps2 / full_scale_mps2).log10();
    Some(format!(
        "the strongest tap, {highest_mps2:.3} m/s², is {over_db:.1} dB above an amplitude of 1, {full_scale_mps2:.3} m/s²; taps are limited to 1, so that the texture can be felt"
    ))
}

pub(super) fn scale_of(signal: &StrokeSignal<'_>) -> ClipScale {
    ClipScale::new(signal.full_scale_mps2, signal.acf)
}

pub(super) fn description_of(signal: &StrokeSignal<'_>) -> String {
    signal_description(signal.sidecar, scale_of(signal))
}

/// Returns the clip of a signal.
///
/// # Errors
/// The signal has no samples.
pub(super) fn clip_of(signal: &StrokeSignal<'_>, created_by: &str) -> anyhow::Result<HapticClip> {
    let sidecar = signal.sidecar;
    let outline = outline_of(signal);
    let of_taps = highest_clipped_mps2(signal, &outline)
        .map(|mps2| format!(" The strongest tap is {mps2:.4} m/s²; taps are limited to 1."));
    let named = sidecar.name.as_ref().or(sidecar.texture.as_ref());
    let metadata = ClipMetadata {
        editor: created_by.to_owned(),
        source: sidecar.texture.clone().unwrap_or_default(),
        project: sidecar.library.clone(),
        tags: named.into_iter().cloned().collect(),
        description: description_of(signal) + &of_taps.unwrap_or_default(),
        ..ClipMetadata::default()
    };
    Ok(clip_of_outline(&outline, scale_of(signal), metadata)?)
}

/// Lists what envelopes lack of a texture; `resolution` states the distance of their points.
pub(super) fn lost_in_envelopes(rendered: Rendered<'_>, resolution: &str) -> Vec<String> {
    let mut lost = vec![
        format!("the fine structure of the vibration: the file has its amplitude and one frequency, {resolution}"),
        "the spectrum: the frequency is the spectral centroid, which players limit to the band of their actuator"
            .to_owned(),
        "the acceleration in m/s²: amplitudes are fractions of full scale, which the description states"
            .to_owned(),
    ];
    if rendered.tap.is_some() && rendered.follows_stroke {
        lost.push("the decay of tap transients: players have their own short events".to_owned());
    }
    lost.extend(lost_of_stroke(rendered));
    lost
}
