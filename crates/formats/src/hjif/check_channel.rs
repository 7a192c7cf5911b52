//! Rules of channels, bands, effects and keyframes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::hjif::faults::{Context, Faults, MOST_SHOWN};
use crate::hjif::rule::{MOST_BANDS, Rule, UNIT_NORMS};
use crate::hjif::tree::{Band, BandType, Channel, Effect, EffectType, Keyframe, Profile, Target};
use crate::text_limits::begin_of;

/// Scheme of semantic keywords if a perception states none.
const STANDARD_SCHEME: &str = "urn:mpeg:mpegi:haptics:effectsemantic:2023";
/// Categories of the semantic keywords of the standard.
const CATEGORIES: [&str; 8] =
    ["UX", "Avatar", "SpecialFX", "WeaponCombat", "Ambient", "Texture", "Vehicle", "Music"];
/// Names in the category of textures.
const TEXTURES: [&str; 7] = ["Undefined", "Rock", "Gravel", "Sand", "Wood", "Metal", "Plastic"];
/// A direction is in steps of this share.
const DIRECTION_STEPS: f64 = 127.0;

pub(super) fn check_channel(channel: &Channel, context: &Context<'_>, place: &str, faults: &mut Faults) {
    let device = channel.reference_device_id.filter(|id| !context.devices.contains(id));
    if let Some(id) = device {
        let place = format!("{place}.reference_device_id");
        faults.add(place, Rule::NoSuch { what: "reference device", id });
    }
    if let Some(direction) = channel.direction {
        let parts = [direction.x, direction.y, direction.z].map(|part| f64::from(part) / DIRECTION_STEPS);
        let norm = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        if !UNIT_NORMS.contains(&norm) {
            faults.add(format!("{place}.direction"), Rule::Direction { norm });
        }
    }
    check_targets(channel, place, faults);
    let of_bands = format!("{place}.bands");
    faults.check_number(&of_bands, ("bands", channel.bands.len()), MOST_BANDS, context.level);
    for (index, band) in channel.bands.iter().enumerate() {
        check_band(band, context, &format!("{of_bands}[{index}]"), faults);
    }
}

/// Checks the targets against the number of actuators along each axis.
fn check_targets(channel: &Channel, place: &str, faults: &mut Faults) {
    let axes = |target: Target| [target.x, target.y, target.z];
    let Some(resolution) = channel.actuator_resolution.map(axes) else {
        if !channel.actuator_target.is_empty() {
            let missing = Rule::Missing { what: "a list of actuator targets", field: "actuator_resolution" };
            faults.add(place, missing);
        }
        return;
    };
    for n in resolution.into_iter().filter(|n| *n < 0) {
        let rule = Rule::Negative { what: "the number of actuators along an axis", value: f64::from(n) };
        faults.add(format!("{place}.actuator_resolution"), rule);
    }
    for (index, target) in channel.actuator_target.iter().enumerate() {
        for (at, n) in
            axes(*target).into_iter().zip(resolution).filter(|(at, n)| !(0..=(*n).max(0)).contains(at))
        {
            let (value, high) = (f64::from(at), f64::from(n));
            let rule = Rule::Range { what: "a target along an axis", value, low: 0.0, high };
            faults.add(format!("{place}.actuator_target[{index}]"), rule);
        }
    }
}

fn check_band(band: &Band, context: &Context<'_>, place: &str, faults: &mut Faults) {
    let is_wavelet = band.band_type == BandType::WaveletWave;
    if band.curve_type.is_some() && band.band_type != BandType::Curve {
        let rule = Rule::Misplaced { field: "curve_type", what: "bands of the type Curve" };
        faults.add(format!("{place}.curve_type"), rule);
    }
    match band.block_length {
        None if is_wavelet => {
            faults
                .add(place, Rule::Missing { what: "a band of the type WaveletWave", field: "block_length" });
        }
        Some(_) if !is_wavelet => {
            let rule = Rule::Misplaced { field: "block_length", what: "bands of the type WaveletWave" };
            faults.add(format!("{place}.block_length"), rule);
        }
        Some(found) if !u32::try_from(found).is_ok_and(u32::is_power_of_two) => {
            faults.add(format!("{place}.block_length"), Rule::BlockLength { found });
        }
        None | Some(_) => {}
    }
    if is_wavelet && context.profile == Profile::SimpleParametric {
        faults.add(format!("{place}.band_type"), Rule::ToolOfProfile { what: "bands of wavelets" });
    }
    let (low, high) = (f64::from(band.lower_frequency_limit), f64::from(band.upper_frequency_limit));
    if low < 0.0 {
        let rule = Rule::Negative { what: "the lower frequency limit", value: low };
        faults.add(format!("{place}.lower_frequency_limit"), rule);
    }
    faults.check_order(place, ("the lower frequency limit", low), ("the upper frequency limit", high));
    for (index, effect) in band.effects.iter().enumerate() {
        check_effect(effect, Some(band.band_type), context, &format!("{place}.effects[{index}]"), faults);
    }
}

/// Checks an effect of a band of this type, or of a library.
pub(super) fn check_effect(
    effect: &Effect,
    band_type: Option<BandType>,
    context: &Context<'_>,
    place: &str,
    faults: &mut Faults,
) {
    match effect.effect_type {
        EffectType::Basis => check_basis(effect, band_type, place, faults),
        EffectType::Reference => check_reference(effect, context, place, faults),
        EffectType::Composite if context.profile == Profile::SimpleParametric => {
            faults.add(format!("{place}.effect_type"), Rule::ToolOfProfile { what: "composite effects" });
        }
        EffectType::Composite => {}
    }
    if let Some(stream) = &effect.wavelet_stream {
        let place = format!("{place}.wavelet_stream");
        if band_type.is_some_and(|band_type| band_type != BandType::WaveletWave) {
            let rule = Rule::Misplaced { field: "wavelet_stream", what: "bands of the type WaveletWave" };
            faults.add(place, rule);
        } else if STANDARD.decode(stream).is_err() {
            faults.add(place, Rule::Base64);
        }
    }
    let is_standard = context.scheme.is_none_or(|scheme| scheme == STANDARD_SCHEME);
    if let Some(found) = effect.semantic_keywords.as_ref().filter(|found| is_standard && !is_keyword(found)) {
        let found = begin_of(found.clone(), MOST_SHOWN);
        faults.add(format!("{place}.semantic_keywords"), Rule::Semantic { found });
    }
    check_keyframes(&effect.keyframes, place, faults);
}

fn check_reference(effect: &Effect, context: &Context<'_>, place: &str, faults: &mut Faults) {
    let what = "an effect of the type Reference";
    match effect.id {
        None => faults.add(place, Rule::Missing { what, field: "id" }),
        Some(id) if !context.effects.contains(&id) => {
            faults.add(format!("{place}.id"), Rule::NoSuch { what: "effect in the library", id });
        }
        Some(_) => {}
    }
    if effect.position.is_none() {
        faults.add(place, Rule::Missing { what, field: "position" });
    }
}

fn check_basis(effect: &Effect, band_type: Option<BandType>, place: &str, faults: &mut Faults) {
    let what = "an effect of the type Basis";
    // Wavelets have coefficients instead.
    let is_wavelet = band_type == Some(BandType::WaveletWave) || effect.wavelet_stream.is_some();
    let parts = [
        ("position", effect.position.is_some()),
        ("phase", is_wavelet || effect.phase.is_some()),
        ("base_signal", is_wavelet || effect.base_signal.is_some()),
        ("keyframes", is_wavelet || !effect.keyframes.is_empty()),
        ("wavelet_stream", !is_wavelet || effect.wavelet_stream.is_some() || !effect.keyframes.is_empty()),
    ];
    for (field, _) in parts.into_iter().filter(|(_, has_field)| !has_field) {
        faults.add(place, Rule::Missing { what, field });
    }
}

fn check_keyframes(keyframes: &[Keyframe], place: &str, faults: &mut Faults) {
    let mut before = None;
    for (index, keyframe) in keyframes.iter().enumerate() {
        let place = || format!("{place}.keyframes[{index}]");
        if let Some(position) = keyframe.relative_position {
            if let Some(before) = before.filter(|before| position < *before) {
                faults.add(place(), Rule::Unsorted { position, before });
            }
            before = Some(position);
        }
        let amplitude = keyframe.amplitude_modulation.filter(|value| !(-1.0..=1.0).contains(value));
        if let Some(value) = amplitude {
            faults.add(place(), Rule::Range { what: "the amplitude", value, low: -1.0, high: 1.0 });
        }
        if let Some(value) = keyframe.frequency_modulation.filter(|value| *value < 0) {
            faults.add(place(), Rule::Negative { what: "the frequency", value: f64::from(value) });
        }
    }
}

/// Whether a text is a semantic keyword of the standard, as far as it is known here: its categories, and the names of
/// textures.
fn is_keyword(text: &str) -> bool {
    let Some((category, name)) = text.split_once('/') else { return false };
    let is_name = if category == "Texture" { TEXTURES.contains(&name) } else { !name.is_empty() };
    CATEGORIES.contains(&category) && is_name
}
