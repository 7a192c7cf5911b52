//! What an `.hjif` file cannot hold of a texture.

use crate::hjif::conditions::BAND_EDGES_HZ;
use crate::library::TextureEntry;
use crate::texture_parts::{Part, lost_description, lost_parts};

/// Lists the properties of a texture that the file of [`hjif_of_texture`](super::hjif_of_texture) cannot hold.
pub fn lost_in_hjif(entry: &TextureEntry) -> Vec<String> {
    let highest_hz = f64::from(BAND_EDGES_HZ[BAND_EDGES_HZ.len() - 1]);
    let mut lost = vec![
        "the randomness of the vibration: each band of the spectrum is one sine with its power".to_owned(),
        "the change with tip speed and normal force between those of the model: the format has no field for them, so a player must choose an effect of the library by its description".to_owned(),
    ];
    if entry.model.rate().0 > 2.0 * highest_hz {
        lost.push(format!("vibration above {highest_hz:.0} Hz"));
    }
    // The stiffness is one of the two physical labels.
    let has_stiffness = entry.physical.is_some_and(|physical| physical.stiffness_n_per_m().is_some());
    let kept: &[Part] = if has_stiffness { &[Part::Terms, Part::PhysicalLabels] } else { &[Part::Terms] };
    lost.extend(lost_parts(entry, kept));
    lost.extend(lost_description(entry));
    if has_stiffness {
        lost.push("the physical label of roughness".to_owned());
    }
    lost
}
