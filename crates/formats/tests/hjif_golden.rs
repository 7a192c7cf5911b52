//! An `.hjif` file of a texture model, compared byte by byte and value by value. Its numbers come from a separate program:
//! the spectra of the two nodes of the golden library 1.0, integrated over the bands.

#![allow(clippy::unwrap_used, reason = "a test may panic on an unexpected result")]

use shagreen_formats::hjif::{Modality, hjif_of_texture, read_hjif, write_hjif};
use shagreen_formats::library::read_library;

const LIBRARY: &[u8] = include_bytes!("golden/library-1.0.json");
const CORK: &[u8] = include_bytes!("golden/cork.hjif");

#[test]
fn the_golden_file_is_that_of_its_texture() {
    let library = read_library(LIBRARY).unwrap().value;
    let golden = read_hjif(CORK).unwrap();
    let made = hjif_of_texture(&library.textures[0], None, ("shagreen 0.1.0", "2026-01-31")).unwrap();
    assert_eq!(made, golden);
    assert_eq!(String::from_utf8_lossy(&write_hjif(&made)), String::from_utf8_lossy(CORK));
}

/// What the guide says about this file.
#[test]
fn the_golden_file_has_three_perceptions() {
    let golden = read_hjif(CORK).unwrap();
    let modalities: Vec<Modality> =
        golden.perceptions.iter().map(|perception| perception.perception_modality).collect();
    assert_eq!(modalities, [Modality::VibrotactileTexture, Modality::Friction, Modality::Stiffness]);
    let vibration = &golden.perceptions[0];
    assert!(vibration.description.contains("speed=30 force=0.15 has effects 1 to 6"));
    // The strongest sine of the strongest condition: 0.68096 of 1.52144 m/s² at 7 Hz.
    let strongest = vibration.effect_library[6].keyframes[0];
    assert_eq!((strongest.amplitude_modulation, strongest.frequency_modulation), (Some(0.68096), Some(7)));
    assert_eq!((vibration.channels[0].gain, vibration.perception_unit_exponent), (0.152_143_869, Some(1)));
}
