//! What simulated participants perceive: hidden positions of the stimuli.

use std::collections::{BTreeMap, BTreeSet};

use crate::maths::rng::{Random, derive_seed};
use crate::people::ratings::AdjectivePair;
use crate::people::study::plan::{Design, Plan, Source, Stimulus, Variant};
use crate::people::study::simulated::SimulationError;
use crate::people::study::simulated::ends::positions_at_ends;

/// Hidden positions of the stimuli of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Names of the dimensions; those with the name of an adjective pair determine its ratings.
    pub dimensions: Vec<String>,
    /// Position of each stimulus by its identifier, one coordinate (0 to 100) for each dimension.
    pub positions: BTreeMap<String, Vec<f64>>,
    /// Mean grade in each condition of a questionnaire, as a fraction of the scale, 0 to 1; 0.5 for other conditions.
    pub conditions: BTreeMap<String, f64>,
}

/// Distance in points by which a variant is moved from its texture in an invented world.
const AUTHORED_POINTS: f64 = 6.0;
const CODED_POINTS_KBPS: f64 = 40.0;
const WINDOW_POINTS_PER_MM: f64 = 4.0;
const MOST_POINTS: f64 = 60.0;

impl World {
    /// World with random positions, the same for the same seed. Versions of a texture lie near it: an authored one 6 points
    /// away, a coded one the further the lower the bit rate, a reconstructed one the further the wider the window. Anchors, and
    /// references of dissimilarities, lie at the ends of a dimension.
    pub fn invented(plan: &Plan, seed: u64) -> Self {
        let dimensions = dimensions_of(plan);
        let at_ends = positions_at_ends(plan, dimensions.len());
        let place = |stimulus: &Stimulus| {
            let (kind, name) = match &stimulus.source {
                Source::Texture(name) => ("texture", name),
                Source::Profile(name) => ("profile", name),
            };
            let mut random = Random::new(derive_seed(seed, &format!("{kind} {name}")));
            let home: Vec<f64> = match at_ends.iter().find(|(source, _)| **source == stimulus.source) {
                Some((_, end)) => end.clone(),
                None => dimensions.iter().map(|_| 10.0 + 80.0 * random.uniform()).collect(),
            };
            let offset = match stimulus.variant {
                Variant::Original => 0.0,
                Variant::Authored => AUTHORED_POINTS,
                Variant::Coded { kbps } => (CODED_POINTS_KBPS / kbps).min(MOST_POINTS),
                Variant::Reconstructed { window_mm } => (WINDOW_POINTS_PER_MM * window_mm).min(MOST_POINTS),
            };
            let mut random = Random::new(derive_seed(seed, &format!("{kind} {name}, direction")));
            let direction: Vec<f64> = dimensions.iter().map(|_| random.normal()).collect();
            let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
            let at = home.iter().zip(&direction).map(|(home, d)| home + offset * d / length).collect();
            (stimulus.id.clone(), at)
        };
        let positions = plan.stimuli.iter().map(place).collect();
        Self { positions, conditions: BTreeMap::new(), dimensions }
    }

    /// Checks that every stimulus of a plan has a position.
    pub(super) fn check(&self, plan: &Plan) -> Result<(), SimulationError> {
        let n_dimensions = self.dimensions.len();
        for Stimulus { id, .. } in &plan.stimuli {
            let n = self.positions.get(id).map_or(0, Vec::len);
            if n != n_dimensions {
                return Err(SimulationError::Position { stimulus: id.clone(), n, n_dimensions });
            }
        }
        Ok(())
    }

    /// Position of a stimulus; empty if it is unknown.
    pub(super) fn position(&self, stimulus: &str) -> &[f64] {
        self.positions.get(stimulus).map_or(&[][..], Vec::as_slice)
    }

    /// Value of a stimulus on a scale, about 0 to 100: its coordinate, if a dimension has this name; its nearness to a pole, if
    /// the scale is an adjective that is one; else a combination of its coordinates that depends on the name.
    pub(super) fn value(&self, stimulus: &str, scale: &str) -> f64 {
        let position = self.position(stimulus);
        let is_same = |name: &str| name.trim().eq_ignore_ascii_case(scale.trim());
        for (name, coordinate) in self.dimensions.iter().zip(position) {
            if is_same(name) {
                return *coordinate;
            }
            let Ok(AdjectivePair { low, high }) = name.parse::<AdjectivePair>() else { continue };
            if is_same(&low) {
                return 100.0 - coordinate;
            }
            if is_same(&high) {
                return *coordinate;
            }
        }
        let mut random = Random::new(derive_seed(0, scale));
        let weights: Vec<f64> = position.iter().map(|_| random.normal()).collect();
        let length = weights.iter().map(|w| w * w).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        50.0 + position.iter().zip(&weights).map(|(x, w)| (x - 50.0) * w / length).sum::<f64>()
    }
}

/// Adjective pairs that the plan asks for; without any, two unnamed dimensions.
fn dimensions_of(plan: &Plan) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let mut names: Vec<String> = Vec::new();
    for part in &plan.parts {
        if let Design::Rating { pairs, .. } = &part.design {
            names.extend(pairs.iter().map(AdjectivePair::name).filter(|name| seen.insert(name.clone())));
        }
    }
    if names.is_empty() { ["dimension 1", "dimension 2"].map(str::to_owned).to_vec() } else { names }
}
