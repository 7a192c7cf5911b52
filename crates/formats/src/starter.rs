//! The built-in starter library, its materials, and its variant positioned by simulated raters.

use shagreen_core::surfaces::material::Material;
use shagreen_core::surfaces::prompt_material::Anchor;
use shagreen_core::surfaces::starter::{LabelSpan, Labels};

use crate::library::{Library, LibraryError, read_library};
use crate::materials_toml::{MaterialsError, read_materials};
use crate::places_csv::{PlacesCsvError, Scale, place_textures, read_places};

const BYTES: &[u8] = include_bytes!("../../../assets/starter/starter.json");
const MATERIALS: &[u8] = include_bytes!("../../../assets/starter/materials.toml");
const SIMULATED_PLACES: &[u8] = include_bytes!("../../../assets/starter/simulated.csv");
const SIMULATED_REPORT: &[u8] = include_bytes!("../../../assets/starter/simulated.report.json");

/// The starter library: simulated everyday surfaces, positioned by physical labels.
///
/// # Errors
/// Fails only if the embedded file is damaged, which a test excludes. Reading takes some milliseconds.
pub fn starter_library() -> Result<Library, LibraryError> {
    read_library(BYTES).map(|imported| imported.value)
}

/// Why the materials of the starter library are unavailable.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StarterMaterialsError {
    /// The embedded materials are damaged.
    #[error(transparent)]
    Materials(#[from] MaterialsError),
    /// The embedded library is damaged.
    #[error(transparent)]
    Library(#[from] LibraryError),
}

/// Returns the materials that the starter library was synthesized from, with their positions, and the label span of its
/// axes.
///
/// # Errors
/// Fails only if an embedded file is damaged, which a test excludes.
pub fn starter_anchors() -> Result<(Vec<Anchor>, LabelSpan), StarterMaterialsError> {
    let materials = read_materials(MATERIALS)?.materials;
    let library = starter_library()?;
    let labels: Vec<Labels> =
        library.textures.iter().filter_map(|texture| texture.physical).map(Labels::from).collect();
    let anchor = |material: Material| {
        let place = library.textures[library.index_of(&material.id)?].at()?;
        Some(Anchor { material, place })
    };
    Ok((materials.into_iter().filter_map(anchor).collect(), LabelSpan::of(&labels)))
}

/// Why the library of simulated raters is unavailable.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimulatedLibraryError {
    /// The starter library is damaged.
    #[error(transparent)]
    Library(#[from] LibraryError),
    /// The table of positions is damaged.
    #[error(transparent)]
    Places(#[from] PlacesCsvError),
    /// The space report is damaged.
    #[error(transparent)]
    Report(#[from] serde_json::Error),
}

/// The textures of the starter library, positioned by simulated raters through the complete sorting and rating
/// analysis, with five attributes each. No person felt these textures.
///
/// # Errors
/// Fails only if an embedded file is damaged, which a test excludes.
pub fn simulated_library() -> Result<Library, SimulatedLibraryError> {
    let mut library = starter_library()?;
    let places = read_places(SIMULATED_PLACES, None, Scale::OF_SPACE)?.value;
    place_textures(&mut library, &places);
    "Starter, simulated raters".clone_into(&mut library.name);
    library.space_report = Some(serde_json::from_slice(SIMULATED_REPORT)?);
    Ok(library)
}

/// The embedded starter library file, byte for byte.
pub fn starter_bytes() -> &'static [u8] {
    BYTES
}

#[cfg(test)]
mod tests {
    use super::{BYTES, simulated_library, starter_anchors, starter_library};
    use crate::library::{read_library, write_library};
    use crate::picture::decode;
    use shagreen_core::space::LabelSource;

    #[test]
    fn the_committed_file_is_sound() {
        let imported = read_library(BYTES).unwrap();
        assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
        let library = starter_library().unwrap();
        assert_eq!(library.label_source(), Some(LabelSource::PhysicalLabels));
        assert!(library.textures.iter().all(|t| t.place.is_some() && t.physical.is_some()));
        for texture in &library.textures {
            decode(texture.picture.as_ref().unwrap()).unwrap();
        }
    }

    #[test]
    fn harder_materials_land_at_higher_frequencies() {
        let library = starter_library().unwrap();
        let mut by_stiffness: Vec<(f64, f64)> = library
            .textures
            .iter()
            .map(|t| (t.physical.unwrap().hardness_log10_n_per_m, t.model.tap().unwrap().frequency.0))
            .collect();
        by_stiffness.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(by_stiffness.is_sorted_by_key(|(_, hz)| *hz), "{by_stiffness:?}");
        let hz =
            |id: &str| library.textures.iter().find(|t| t.id == id).unwrap().model.tap().unwrap().frequency.0;
        let order = ["open-cell-foam", "flat-rubber", "sanded-wood", "glass"].map(hz);
        assert!(order.is_sorted(), "{order:?}");
    }

    #[test]
    fn every_material_of_it_is_an_anchor() {
        let (anchors, span) = starter_anchors().unwrap();
        let library = starter_library().unwrap();
        assert_eq!(anchors.len(), library.textures.len());
        for (anchor, texture) in anchors.iter().zip(&library.textures) {
            assert_eq!((&anchor.material.id, anchor.place), (&texture.id, texture.at().unwrap()));
            let [rough_smooth, hard_soft] = span.axes(&texture.physical.unwrap().into());
            // The file stores three decimals.
            assert!((rough_smooth - anchor.place.x()).abs() < 0.1, "{}", texture.id);
            assert!((hard_soft - anchor.place.y()).abs() < 0.1, "{}", texture.id);
        }
    }

    #[test]
    fn the_second_library_says_that_its_raters_are_simulated() {
        let library = simulated_library().unwrap();
        assert_eq!(library.label_source(), Some(LabelSource::SimulatedRaters));
        assert!(library.name.contains("simulated"));
        let report = library.space_report.as_ref().unwrap();
        assert_eq!(report["label_source"], "simulated");
        for (i, texture) in library.textures.iter().enumerate() {
            let at = texture.at().unwrap();
            let reported = &report["positions"][i];
            assert_eq!(reported["id"], texture.id.as_str());
            assert!((reported["at"][0].as_f64().unwrap() - at.x()).abs() < 1e-3);
            let attributes = texture.attributes.as_ref().unwrap();
            assert_eq!((attributes.values.len(), attributes.source), (5, LabelSource::SimulatedRaters));
        }
    }

    #[test]
    fn the_committed_file_is_what_is_written() {
        assert_eq!(write_library(&starter_library().unwrap()), BYTES);
    }
}
