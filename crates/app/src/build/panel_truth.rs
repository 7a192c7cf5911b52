//! A simulated panel that feels what the library knows of its textures.

use shagreen_core::panel::{PanelConfig, simulated_ratings, simulated_sorts};
use shagreen_core::ratings::{AdjectivePair, Rating};
use shagreen_core::sorting::Sort;
use shagreen_formats::library::{Place, TextureEntry};

use crate::strings;
use crate::strings::build as words;

/// Groups that each participant sorts into, one sort after the other.
const GROUPS: [usize; 3] = [3, 6, 9];
/// Textures that a space needs at least.
const MIN_TEXTURES: usize = 4;
/// What the participants are like, but for their seed.
const PANEL: PanelConfig =
    PanelConfig { n_participants: 10, noise_points: 8.0, bias_points: 5.0, scale_log_spread: 0.1, seed: 0 };

/// What a simulated panel said.
pub(super) struct Simulated {
    pub(super) sorts: Vec<Sort>,
    pub(super) ratings: Vec<Rating>,
}

/// A panel that sorts the placed textures by their places, and rates them by these and, where all have it, by friction.
///
/// # Errors
/// A sentence: too few textures have a place.
pub(super) fn simulate(textures: &[(&TextureEntry, Option<Place>)], seed: u64) -> Result<Simulated, String> {
    let placed: Vec<(&TextureEntry, Place)> =
        textures.iter().filter_map(|(texture, place)| Some((*texture, (*place)?))).collect();
    if placed.len() < MIN_TEXTURES {
        return Err(words::too_few_places(placed.len(), MIN_TEXTURES));
    }
    let names: Vec<String> = placed.iter().map(|(texture, _)| texture.id.clone()).collect();
    let mut labels: Vec<Vec<f64>> =
        placed.iter().map(|(_, place)| vec![place.at.rough_smooth, place.at.hard_soft]).collect();
    let config = PanelConfig { seed, ..PANEL };
    let groups: Vec<usize> = GROUPS.into_iter().filter(|n| *n < names.len()).collect();
    let sorts = simulated_sorts(&names, &labels, &groups, &config).map_err(|error| error.to_string())?;
    let pair = |low: &str, high: &str| AdjectivePair { low: low.to_owned(), high: high.to_owned() };
    let mut pairs = vec![pair(strings::ROUGH, strings::SMOOTH), pair(strings::HARD, strings::SOFT)];
    let frictions: Option<Vec<f64>> = placed.iter().map(|(texture, _)| texture.model.friction()).collect();
    if let Some(slippery) = frictions.and_then(|frictions| slipperiness(&frictions)) {
        pairs.push(pair(words::STICKY, words::SLIPPERY));
        for (label, value) in labels.iter_mut().zip(slippery) {
            label.push(value);
        }
    }
    let ratings = simulated_ratings(&names, &labels, &pairs, &config).map_err(|error| error.to_string())?;
    Ok(Simulated { sorts, ratings })
}

/// 0 for the highest coefficient of friction, 100 for the lowest; `None` where all are the same.
fn slipperiness(frictions: &[f64]) -> Option<Vec<f64>> {
    let low = frictions.iter().copied().fold(f64::INFINITY, f64::min);
    let high = frictions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (high > low).then(|| frictions.iter().map(|f| 100.0 * ((high - f) / (high - low))).collect())
}

#[cfg(test)]
mod tests {
    use super::{simulate, slipperiness};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_panel_sorts_and_rates_every_placed_texture() {
        let library = starter_library().unwrap();
        let n_textures = library.textures.len();
        let textures: Vec<_> = library.textures.iter().map(|texture| (texture, texture.place)).collect();
        let simulated = simulate(&textures, 1).unwrap();
        assert_eq!(simulated.sorts.len(), 10 * 3);
        assert!(simulated.sorts.iter().all(|sort| sort.placements.len() == n_textures));
        assert!(simulated.sorts.iter().all(|sort| sort.participant.starts_with("simulated-")));
        assert_eq!(simulated.ratings.len() % (10 * n_textures), 0);
        assert_eq!(simulate(&textures, 1).unwrap().ratings, simulated.ratings);
        assert_ne!(simulate(&textures, 2).unwrap().ratings, simulated.ratings);
        let unplaced: Vec<_> = library.textures.iter().map(|texture| (texture, None)).collect();
        let nobody = simulate(&unplaced, 1);
        assert!(nobody.is_err_and(|reason| reason.contains("place")));
    }

    #[test]
    fn the_least_friction_is_the_most_slippery() {
        assert_eq!(slipperiness(&[0.2, 0.6, 0.4]).unwrap()[..2], [100.0, 0.0]);
        assert_eq!(slipperiness(&[0.3, 0.3]), None);
        // Rounding must not lead off the scale.
        assert!(slipperiness(&[0.21, 0.87, 0.333]).unwrap().iter().all(|s| (0.0..=100.0).contains(s)));
    }
}
