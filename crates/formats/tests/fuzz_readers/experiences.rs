//! Haptic files of MPEG, and scenes that refer to haptic maps.

use shagreen_formats::haptic_maps::check_gltf;
use shagreen_formats::hjif::{check_hjif, read_hjif, write_hjif};

/// A file that this program wrote, and a small one with bands and effects of other kinds.
pub(crate) fn hjif_seeds() -> Vec<Vec<u8>> {
    let other = br#"{"version": "2023", "profile": "Main", "level": 2, "date": "2026", "description": "", "avatars": [],
        "perceptions": [{"id": 0, "avatar_id": 0, "description": "", "perception_modality": "Force", "effect_library": [],
        "channels": [{"id": 0, "description": "", "gain": 1, "mixing_coefficient": 1, "body_part_mask": 1,
        "direction": {"X": 0, "Y": 127, "Z": 0}, "vertices": [1, 2], "bands": [{"band_type": "WaveletWave",
        "block_length": 64, "lower_frequency_limit": 0, "upper_frequency_limit": 900, "effects": [{"effect_type": "Basis",
        "position": 0, "wavelet_stream": "AAEC"}]}]}]}], "syncs": [{"timestamp": 0}]}"#;
    vec![include_bytes!("../golden/cork.hjif").to_vec(), other.to_vec()]
}

pub(crate) fn read_an_hjif(bytes: &[u8]) -> Result<(), String> {
    let Ok(checked) = check_hjif(bytes) else { return Ok(()) };
    let written = write_hjif(&checked.file);
    let again = check_hjif(&written).map_err(|error| format!("the written file cannot be read: {error}"))?;
    if again != checked {
        return Err("the file and its faults are not the same when it is written".into());
    }
    if read_hjif(bytes).is_ok() == (checked.n_faults == 0) {
        Ok(())
    } else {
        Err("a file with faults is read, or one without is not".into())
    }
}

pub(crate) fn scene_seeds() -> Vec<Vec<u8>> {
    vec![include_bytes!("../golden/cork.gltf").to_vec()]
}

pub(crate) fn read_a_scene(bytes: &[u8]) -> Result<(), String> {
    let Ok(checked) = check_gltf(bytes) else { return Ok(()) };
    if checked.faults.len() <= checked.n_faults { Ok(()) } else { Err("more faults than there are".into()) }
}
