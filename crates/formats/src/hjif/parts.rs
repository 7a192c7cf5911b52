//! Effects, bands and channels of an `.hjif` file that is written from a texture model.

use std::f64::consts::SQRT_2;

use shagreen_core::actuator::Actuator;

use crate::hjif::conditions::{BAND_EDGES_HZ, Condition, Sine};
use crate::hjif::scale::Scale;
use crate::hjif::tree::{
    ActuatorType, Band, BandType, BaseSignal, Channel, CurveType, Effect, EffectType, Keyframe,
    ReferenceDevice,
};
use crate::library::{DIGITS, digits};

/// Length of an effect in ticks: one second, in which sines of whole frequencies repeat without a seam.
const EFFECT_TICKS: i32 = 1000;
/// Band of a constant curve, in Hz.
const CURVE_LIMITS_HZ: [i32; 2] = [0, 1];

/// Id of the effect for a band of a condition; each has one.
fn effect_id(condition: usize, band: usize, n_bands: usize) -> i32 {
    let id = condition * n_bands + band + 1;
    i32::try_from(id).unwrap_or(i32::MAX)
}

/// Ids of the first and the last effect of a condition.
pub(super) fn effect_ids(condition: usize, n_bands: usize) -> [i32; 2] {
    [0, n_bands.saturating_sub(1)].map(|band| effect_id(condition, band, n_bands))
}

/// Library with an effect for each band of each condition.
pub(super) fn effect_library(conditions: &[Condition], scale: Scale) -> Vec<Effect> {
    let effects_of = |(index, condition): (usize, &Condition)| {
        let n_bands = condition.sines.len();
        let effect = |(band, sine): (usize, &Sine)| {
            let amplitude = scale.amplitude(sine.amplitude_mps2);
            let keyframes = [0, EFFECT_TICKS].map(|ticks| Keyframe {
                relative_position: Some(ticks),
                amplitude_modulation: Some(amplitude),
                frequency_modulation: Some(sine.frequency_hz),
            });
            Effect { id: Some(effect_id(index, band, n_bands)), ..basis(keyframes.to_vec()) }
        };
        condition.sines.iter().enumerate().map(effect).collect::<Vec<_>>()
    };
    conditions.iter().enumerate().flat_map(effects_of).collect()
}

/// Channel that plays the condition with this index by its effects in the library.
pub(super) fn vibration_channel(
    conditions: &[Condition],
    played: usize,
    scale: Scale,
    device: Option<&ReferenceDevice>,
) -> Channel {
    let n_bands = conditions[played].sines.len();
    let limits = BAND_EDGES_HZ.windows(2).map(|edges| [edges[0], edges[1]].map(i32::from));
    let band = |(index, limits): (usize, [i32; 2])| {
        let effect = Effect {
            effect_type: EffectType::Reference,
            id: Some(effect_id(played, index, n_bands)),
            position: Some(0),
            phase: None,
            base_signal: None,
            semantic_keywords: None,
            keyframes: Vec::new(),
            wavelet_stream: None,
        };
        band_of(BandType::VectorialWave, limits, effect)
    };
    let bands = limits.take(n_bands).enumerate().map(band).collect();
    let reference_device_id = device.map(|device| device.id);
    Channel { reference_device_id, ..channel(&conditions[played].name(), scale.gain, bands) }
}

/// Channel of a constant quantity.
pub(super) fn constant_channel(description: &str, value: f64) -> (Channel, Scale) {
    let scale = Scale::of(value);
    let amplitude = scale.amplitude(value);
    let keyframes = [0, EFFECT_TICKS].map(|ticks| Keyframe {
        relative_position: Some(ticks),
        amplitude_modulation: Some(amplitude),
        frequency_modulation: None,
    });
    let curve = band_of(BandType::Curve, CURVE_LIMITS_HZ, basis(keyframes.to_vec()));
    let band = Band { curve_type: Some(CurveType::Linear), ..curve };
    (channel(description, scale.gain, vec![band]), scale)
}

/// Reference device of a voice coil. Amplitude, displacement, weight and size are not written, because the standard does not
/// say in which unit.
pub(super) fn reference_device(actuator: &Actuator) -> ReferenceDevice {
    let resonance_hz = actuator.measured.map(|measured| measured.response.resonance().0);
    let lowest_hz = actuator.lowest.0;
    let peak_of = |rms: f64| digits(SQRT_2 * rms, DIGITS);
    let limits = actuator.limits_in_volts();
    let rated_v = limits.rated_volts_rms.map(|rated| peak_of(rated.0));
    ReferenceDevice {
        id: 1,
        name: actuator.name.clone(),
        body_part_mask: None,
        maximum_frequency: None,
        // A profile may compensate only frequencies above the resonance.
        minimum_frequency: Some(lowest_hz).filter(|low| resonance_hz.is_none_or(|high| *low <= high)),
        resonance_frequency: resonance_hz,
        maximum_amplitude: None,
        impedance: actuator.physical.resistance_ohm,
        maximum_voltage: limits.peak_volts.map(|peak| peak.0).or(rated_v),
        maximum_current: limits.rated_amps_rms.map(peak_of),
        maximum_displacement: None,
        weight: None,
        size: None,
        custom: None,
        kind: Some(ActuatorType::Vca),
    }
}

fn basis(keyframes: Vec<Keyframe>) -> Effect {
    Effect {
        effect_type: EffectType::Basis,
        id: None,
        position: Some(0),
        phase: Some(0.0),
        base_signal: Some(BaseSignal::Sine),
        semantic_keywords: None,
        keyframes,
        wavelet_stream: None,
    }
}

fn band_of(band_type: BandType, limits_hz: [i32; 2], effect: Effect) -> Band {
    Band {
        band_type,
        curve_type: None,
        block_length: None,
        lower_frequency_limit: limits_hz[0],
        upper_frequency_limit: limits_hz[1],
        priority: None,
        effects: vec![effect],
    }
}

fn channel(description: &str, gain: f64, bands: Vec<Band>) -> Channel {
    Channel {
        id: 0,
        description: description.to_owned(),
        gain,
        mixing_coefficient: 1.0,
        body_part_mask: 0,
        priority: None,
        reference_device_id: None,
        frequency_sampling: None,
        sample_count: None,
        direction: None,
        actuator_resolution: None,
        body_part_target: Vec::new(),
        actuator_target: Vec::new(),
        vertices: Vec::new(),
        bands,
    }
}
