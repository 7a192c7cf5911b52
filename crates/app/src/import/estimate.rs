//! Where a recorded texture would lie, by the textures of a library that lie there already.

use shagreen_core::attribute_predictor::{predict, quantities};
use shagreen_core::gaussian_process::Estimate;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::attribute_table::attribute_table;
use shagreen_formats::library::{Library, Place, TextureEntry};

use crate::strings::import as strings;

/// Fewer textures tell nothing about another one.
const LEAST_KNOWN: usize = 5;

/// Places a texture by an estimate and says so in its description; one that nothing can be told of stays as it is.
pub(super) fn place_by_estimate(entry: &mut TextureEntry, library: &Library) {
    let Some(axes) = estimates(entry, library) else { return };
    let [rough_smooth, hard_soft] = axes.map(|axis| axis.mean.clamp(0.0, 100.0));
    entry.place = Some(Place { at: SpacePoint { rough_smooth, hard_soft }, source: LabelSource::Estimated });
    let names = library.axis_names();
    let told = [0, 1].map(|axis| (names[axis], axes[axis].mean, axes[axis].deviation));
    let said = strings::placed_by_estimate(&told);
    if !entry.description.is_empty() {
        entry.description.push(' ');
    }
    entry.description.push_str(&said);
}

/// The two axes of a texture, where the library knows enough textures on both.
fn estimates(entry: &TextureEntry, library: &Library) -> Option<[Estimate; 2]> {
    let table = attribute_table(library).ok()?; // A library without places has no axes either.
    if table.textures.len() < LEAST_KNOWN {
        return None;
    }
    let indices = library.axis_names().map(|axis| table.names.iter().position(|name| name == axis));
    let [Some(across), Some(up)] = indices else { return None };
    // What shares no quantity with the others cannot be compared with them.
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
