//! Strokes on which networks are trained, with the attributes of their textures.

use anyhow::Context as _;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::recording::fit::Stroke;
use shagreen_core::texture::patterns::{
    PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns, render_patterns,
};
use shagreen_formats::attribute_table::AttributeTable;
use shagreen_formats::library::{Library, free_id, id_from_name};
use shagreen_learn::stroke_set::StrokedTexture;

use crate::report::Reporter;

/// Returns the 25 strokes of the paper on each texture of a table, rendered from the texture models, each texture with its own
/// noise. `share` is the fraction of each stroke of 1 s that is rendered, above 0 to 1.
///
/// # Errors
/// A texture cannot be rendered; the message names it.
pub fn rendered_strokes(
    library: &Library,
    table: &AttributeTable,
    share: f64,
    seed: u64,
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<StrokedTexture>> {
    let contacts = paper_patterns();
    of_textures(library, table, |texture_id, model_idx| {
        let plan = PatternPlan {
            contacts: &contacts,
            seconds: PAPER_SECS * share,
            rate: PAPER_RATE,
            seed: derive_seed(seed, texture_id),
        };
        let patterns = render_patterns(&library.textures[model_idx].model, &plan)?;
        for warning in &patterns.warnings {
            reporter.warn(&format!("{texture_id}: {warning}"));
        }
        let strokes = patterns.signals.into_iter().zip(&contacts).map(|(accel_mps2, contact)| Stroke {
            speed_mps: vec![contact.speed.0; accel_mps2.len()],
            force_n: vec![contact.force.0; accel_mps2.len()],
            axes_mps2: vec![accel_mps2],
        });
        Ok(strokes.collect())
    })
}

/// Returns the training set: the strokes that `strokes_of` returns for the id of each texture and its index in the library.
///
/// # Errors
/// Those of `strokes_of`, with the id of the texture.
pub fn of_textures(
    library: &Library,
    table: &AttributeTable,
    mut strokes_of: impl FnMut(&str, usize) -> anyhow::Result<Vec<Stroke>>,
) -> anyhow::Result<Vec<StrokedTexture>> {
    let mut ids: Vec<String> = Vec::new();
    let of = |(index, attributes): (&usize, &Vec<f64>)| {
        let texture_id = library.textures[*index].id.as_str();
        let strokes = strokes_of(texture_id, *index).with_context(|| format!("texture \"{texture_id}\""))?;
        // The state of each texture is saved in a file of this name.
        let id = free_id(&id_from_name(texture_id), |id| ids.iter().any(|taken| taken == id));
        ids.push(id.clone());
        Ok(StrokedTexture { id, strokes, attributes: attributes.clone() })
    };
    table.textures.iter().zip(&table.values).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::rendered_strokes;
    use crate::report::Warnings;
    use shagreen_formats::attribute_table::attribute_table;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn every_texture_has_the_strokes_of_the_paper() {
        let mut library = starter_library().unwrap();
        library.textures.truncate(2);
        let table = attribute_table(&library).unwrap();
        let rendered = |seed: u64| {
            let reporter = Warnings::default();
            rendered_strokes(&library, &table, 0.2, seed, &reporter).unwrap()
        };
        let strokes = rendered(1);
        assert_eq!(strokes.len(), 2);
        for (of, values) in strokes.iter().zip(&table.values) {
            assert_eq!((of.strokes.len(), &of.attributes), (25, values));
            let first = &of.strokes[0];
            assert_eq!((first.axes_mps2.len(), first.axes_mps2[0].len()), (1, 200));
            assert_eq!((first.speed_mps[0], first.force_n[199]), (0.05, 0.1));
        }
        assert!(strokes == rendered(1) && strokes != rendered(2));
    }
}
