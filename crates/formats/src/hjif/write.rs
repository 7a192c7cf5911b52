//! Writing of `.hjif` files, also from a texture model.

use std::fmt::Write as _;

use shagreen_core::actuator::Actuator;

use crate::hatt::RESTRICTED_TERMS;
use crate::hjif::conditions::{Condition, conditions, usual};
use crate::hjif::parts::{constant_channel, effect_ids, effect_library, reference_device, vibration_channel};
use crate::hjif::scale::Scale;
use crate::hjif::tree::{Hjif, Modality, Perception, Profile};
use crate::layout;
use crate::library::{Provenance, TextureEntry};

/// Edition of the standard that is written.
const VERSION: &str = "2023";
/// Ticks per second.
const TIMESCALE: u32 = 1000;
/// Positions are in ms.
const MILLI: i8 = -3;
/// Nesting up to which objects have a line for each field: an effect of the library stays on one line.
const OPEN_DEPTH: usize = 4;

/// Why a texture cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HjifWriteError {
    /// No node has vibration.
    #[error(
        "\"{id}\" has no vibration below 1000 Hz at any of its speeds and forces; choose a texture with a grain, or export its height map"
    )]
    Silent {
        /// Identifier of the texture.
        id: String,
    },
    /// A node has no finite power.
    #[error("the vibration of \"{id}\" at {condition} has no finite power; correct this node of the texture")]
    Infinite {
        /// Identifier of the texture.
        id: String,
        /// Speed and force of the node.
        condition: String,
    },
}

/// Serializes a file.
pub fn write_hjif(file: &Hjif) -> Vec<u8> {
    layout::to_bytes(file, OPEN_DEPTH)
}

/// Returns the file of a texture: a perception of its vibration, and one of its friction and of its stiffness if they are
/// known. `date` is that of the file (ISO 8601), and `created_by` the program with its version.
///
/// At each speed and force of the model, a sine stands for each band: it has the power of the band, at its mean frequency.
/// The library has these sines, and the channel plays those of the speed and force nearest to a usual stroke. A file has no
/// field for speed and force; the description of the perception names the effects of each condition.
///
/// # Errors
/// See [`HjifWriteError`].
pub fn hjif_of_texture(
    entry: &TextureEntry,
    actuator: Option<&Actuator>,
    (created_by, date): (&str, &str),
) -> Result<Hjif, HjifWriteError> {
    let conditions = conditions(&entry.model);
    if let Some(condition) = conditions.iter().find(|condition| !condition.peak_mps2().is_finite()) {
        return Err(HjifWriteError::Infinite { id: entry.id.clone(), condition: condition.name() });
    }
    let full_mps2 = conditions.iter().map(Condition::peak_mps2).fold(0.0, f64::max);
    let played = usual(&conditions).filter(|_| full_mps2 > 0.0);
    let played = played.ok_or_else(|| HjifWriteError::Silent { id: entry.id.clone() })?;
    let scale = Scale::of(full_mps2);
    let device = actuator.map(reference_device);
    let vibration = Perception {
        reference_devices: device.iter().cloned().collect(),
        effect_library: effect_library(&conditions, scale),
        channels: vec![vibration_channel(&conditions, played, scale, device.as_ref())],
        ..perception(0, Modality::VibrotactileTexture, about(&conditions, played), scale)
    };
    let mut perceptions = vec![vibration];
    let stiffness_n_per_m = entry.physical.and_then(|physical| physical.stiffness_n_per_m());
    let constants = [
        (Modality::Friction, "kinetic friction coefficient, without a unit", entry.model.friction()),
        (Modality::Stiffness, "contact stiffness at 1 N, in N/m", stiffness_n_per_m),
    ];
    for (modality, description, value) in constants {
        let Some(value) = value else { continue };
        let (channel, scale) = constant_channel(description, value);
        let id = perceptions.last().map_or(0, |before| before.id + 1);
        let of_value = perception(id, modality, format!("Constant: {description}."), scale);
        perceptions.push(Perception { channels: vec![channel], ..of_value });
    }
    Ok(Hjif {
        version: VERSION.to_owned(),
        profile: Profile::Main,
        level: 1,
        date: date.to_owned(),
        description: description(entry, created_by),
        timescale: Some(TIMESCALE),
        avatars: Vec::new(),
        perceptions,
        syncs: Vec::new(),
    })
}

/// Name, origin and license of the texture, and the program.
fn description(entry: &TextureEntry, created_by: &str) -> String {
    let stated = |what: &str, text: &str| (!text.is_empty()).then(|| format!("{what}: {text}"));
    let terms = (entry.provenance == Provenance::Restricted).then(|| RESTRICTED_TERMS.to_owned());
    let sentences = [
        Some(entry.name.clone()),
        stated("Origin", &entry.origin),
        stated("License", &entry.license),
        terms.filter(|terms| *terms != entry.license),
        Some(format!("Written by {created_by} from a texture model")),
    ];
    let closed = |sentence: String| format!("{}.", sentence.trim_end_matches('.'));
    sentences.into_iter().flatten().map(closed).collect::<Vec<_>>().join(" ")
}

/// Description of the vibration, with the effects of each condition.
fn about(conditions: &[Condition], played: usize) -> String {
    let n_bands = conditions[played].sines.len();
    let mut text = format!(
        "Acceleration of a tip in m/s²: amplitude times channel gain times 10^perception_unit_exponent. \
         Each condition is a tip speed in mm/s and a normal force in N, with one effect of the library for each band; positions \
         are in time. The channel plays {}. Conditions:",
        conditions[played].name()
    );
    for (index, condition) in conditions.iter().enumerate() {
        let [first, last] = effect_ids(index, n_bands);
        let before = if index == 0 { " " } else { "; " };
        let _ = write!(text, "{before}{} has effects {first} to {last}", condition.name());
    }
    text + "."
}

fn perception(id: i32, modality: Modality, description: String, scale: Scale) -> Perception {
    Perception {
        id,
        avatar_id: 0,
        description,
        perception_modality: modality,
        priority: None,
        unit_exponent: Some(MILLI),
        perception_unit_exponent: Some(scale.exponent),
        effect_semantic_scheme: None,
        reference_devices: Vec::new(),
        effect_library: Vec::new(),
        channels: Vec::new(),
    }
}
