//! A simulated panel that feels what the library knows of its textures, as `shagreen space panel` makes it by default.

use shagreen_core::panel::{PanelConfig, USUAL_GROUPS, simulated_ratings, simulated_sorts};
use shagreen_core::ratings::Rating;
use shagreen_core::sorting::Sort;
use shagreen_formats::library::Library;
use shagreen_formats::panel_labels::{PanelLabels, panel_labels};

/// What a simulated panel said.
pub(super) struct Simulated {
    pub(super) sorts: Vec<Sort>,
    pub(super) ratings: Vec<Rating>,
}

/// A panel that sorts and rates the textures that have a place.
///
/// # Errors
/// A sentence: there is nothing to perceive.
pub(super) fn simulate(library: &Library, seed: u64) -> Result<Simulated, String> {
    let PanelLabels { pairs, ids, labels } = panel_labels(library).map_err(|error| error.to_string())?;
    let config = PanelConfig::usual(seed);
    // Few textures make few groups.
    let groups: Vec<usize> = USUAL_GROUPS.into_iter().filter(|n| *n <= ids.len()).collect();
    let sorts = simulated_sorts(&ids, &labels, &groups, &config).map_err(|error| error.to_string())?;
    let ratings = simulated_ratings(&ids, &labels, &pairs, &config).map_err(|error| error.to_string())?;
    Ok(Simulated { sorts, ratings })
}

#[cfg(test)]
mod tests {
    use super::simulate;
    use shagreen_formats::library::Library;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_panel_sorts_and_rates_every_placed_texture() {
        let library = starter_library().unwrap();
        let n_textures = library.textures.len();
        let simulated = simulate(&library, 1).unwrap();
        assert_eq!(simulated.sorts.len(), 10 * 3);
        assert!(simulated.sorts.iter().all(|sort| sort.placements.len() == n_textures));
        assert!(simulated.sorts.iter().all(|sort| sort.participant.starts_with("simulated-")));
        assert_eq!(simulated.ratings.len(), 10 * n_textures * 5);
        assert_eq!(simulate(&library, 1).unwrap().ratings, simulated.ratings);
        assert_ne!(simulate(&library, 2).unwrap().ratings, simulated.ratings);
        assert!(simulate(&Library::default(), 1).is_err_and(|reason| reason.contains("place")));
    }
}
