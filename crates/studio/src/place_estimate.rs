//! Position of a new texture, predicted from the textures of a library that have one.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::attribute_predictor::{predict, quantities};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::attribute_table::attribute_table;
use shagreen_formats::library::{Library, Place, TextureEntry};

/// Smallest number of textures with a position for a prediction.
const LEAST_KNOWN: usize = 5;

/// Places a texture at its predicted position and states this in its description. Without a prediction the texture
/// stays unchanged.
pub fn place_by_estimate(entry: &mut TextureEntry, library: &Library) {
    let Some(axes) = estimates(entry, library) else { return };
    let [rough_smooth, hard_soft] = axes.map(|axis| axis.mean.clamp(0.0, 100.0));
    entry.place = Some(Place { at: SpacePoint { rough_smooth, hard_soft }, source: LabelSource::Estimated });
    let names = library.axis_names();
    let described =
        [0, 1].map(|axis| format!("{} {:.0} ± {:.0}", names[axis], axes[axis].mean, axes[axis].deviation));
    let said =
        format!("Estimated position (mean ± standard deviation): {}; nobody rated it.", described.join(", "));
    if !entry.description.is_empty() {
        entry.description.push(' ');
    }
    entry.description.push_str(&said);
}

/// Returns the predictions on both axes; `None` if the library has too few textures with positions.
fn estimates(entry: &TextureEntry, library: &Library) -> Option<[Estimate; 2]> {
    let table = attribute_table(library).ok()?; // A library without positions has no axes.
    if table.textures.len() < LEAST_KNOWN {
        return None;
    }
    let indices = library.axis_names().map(|axis| table.names.iter().position(|name| name == axis));
    let [Some(across), Some(up)] = indices else { return None };
    // A texture without a feature in common with the others cannot be compared.
    let all = predict(&table.known(library), &quantities(&entry.model)).ok()?;
    Some([all[across], all[up]])
}

#[cfg(test)]
mod tests {
    use super::place_by_estimate;
    use shagreen_core::space::LabelSource;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_texture_lands_near_where_it_lay() {
        let library = starter_library().unwrap();
        let mut mistakes = Vec::new();
        for index in 0..library.textures.len() {
            let mut others = library.clone();
            let mut entry = others.textures.remove(index);
            let before = entry.place.take().unwrap().at;
            place_by_estimate(&mut entry, &others);
            let place = entry.place.unwrap();
            assert_eq!(place.source, LabelSource::Estimated);
            assert!(entry.description.contains("±"), "{}", entry.description);
            mistakes.push((place.at.rough_smooth - before.rough_smooth).abs());
        }
        let mean = mistakes.iter().sum::<f64>() / mistakes.len() as f64;
        assert!(mean < 10.0, "{mean}");
        let mut few = library.clone();
        let mut entry = few.textures.remove(0);
        few.textures.truncate(3);
        entry.place = None;
        place_by_estimate(&mut entry, &few);
        assert_eq!(entry.place, None);
    }
}
