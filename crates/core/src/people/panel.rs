//! Simulated participants, for testing a study's pipeline before real participants are invited; never for conclusions.
//!
//! All simulated participants perceive the same physical labels, with noise, and each has its own bias and use of the
//! scale. They are named `simulated-01` and so on. Every result derived from them must carry
//! [`crate::space::LabelSource::SimulatedRaters`].

use crate::maths::rng::{Random, derive_seed};
use crate::people::ratings::{AdjectivePair, Rating};
use crate::people::sorting::{Grouped, Sort};

/// Whether a participant's name contains "simulated"; such answers are never treated as those of a person.
pub fn is_simulated(participant: &str) -> bool {
    participant.to_lowercase().contains("simulated")
}

/// Maximum number of k-means iterations of a simulated participant.
const MAX_ROUNDS: usize = 50;

/// Parameters of a simulated panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelConfig {
    /// Number of participants.
    pub n_participants: usize,
    /// Standard deviation of the noise in one perception of one texture, in points of an axis (0 to 100).
    pub noise_points: f64,
    /// Standard deviation over participants of the constant bias on an adjective pair, in points.
    pub bias_points: f64,
    /// Standard deviation over participants of the logarithm of the scale factor on an adjective pair.
    pub scale_log_spread: f64,
    /// Random seed; the same seed gives the same answers.
    pub seed: u64,
}

/// Numbers of groups of the sorts that each participant makes, as in the authoring paper.
pub const USUAL_GROUPS: [usize; 3] = [3, 6, 9];

impl PanelConfig {
    /// Ten participants with noise of 8 points, a bias of 6 points and scale factors that vary by about 20 %.
    pub const fn usual(seed: u64) -> Self {
        Self { n_participants: 10, noise_points: 8.0, bias_points: 6.0, scale_log_spread: 0.2, seed }
    }
}

/// Reasons why a panel cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PanelError {
    /// A parameter is negative or not finite.
    #[error("{what} is {value}; it must be a finite number of 0 or more")]
    Config {
        /// Name of the parameter.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The panel has no participants.
    #[error("a panel needs at least one participant")]
    Nobody,
    /// A label is outside its axis.
    #[error("label {label} of texture {texture} is {value}; a label must be between 0 and 100")]
    Label {
        /// Index of the texture.
        texture: usize,
        /// Index of the label.
        label: usize,
        /// Its value.
        value: f64,
    },
    /// A texture has the wrong number of labels.
    #[error("texture {texture} has {n} labels, but {expected} are expected")]
    Labels {
        /// Index of the texture.
        texture: usize,
        /// Number of its labels.
        n: usize,
        /// Expected number of labels.
        expected: usize,
    },
    /// The numbers of texture names and of label rows differ.
    #[error("{n_names} texture names are given for {n_labels} textures with labels; give one name for each")]
    Names {
        /// Number of texture names.
        n_names: usize,
        /// Number of textures with labels.
        n_labels: usize,
    },
    /// The number of groups is 0 or exceeds the number of textures.
    #[error(
        "{n_textures} textures cannot be sorted into {n_groups} non-empty groups; choose 1 to {n_textures}"
    )]
    Groups {
        /// Number of textures.
        n_textures: usize,
        /// Number of groups requested.
        n_groups: usize,
    },
}

/// Ratings of textures by a simulated panel. `labels` holds one row per texture with one label (0..100) per adjective
/// pair.
///
/// Each rating is `50 + scale (label + noise - 50) + bias`, clamped to 0..100.
///
/// # Errors
/// See [`PanelError`].
pub fn simulated_ratings(
    textures: &[String],
    labels: &[Vec<f64>],
    pairs: &[AdjectivePair],
    config: &PanelConfig,
) -> Result<Vec<Rating>, PanelError> {
    check_names(textures, labels)?;
    check(labels, pairs.len(), config)?;
    let mut ratings = Vec::with_capacity(config.n_participants * textures.len() * pairs.len());
    for participant in participants(config) {
        let mut random = Random::new(derive_seed(config.seed, &format!("{participant} rates")));
        let habits: Vec<(f64, f64)> = pairs
            .iter()
            .map(|_| (random.log_normal(config.scale_log_spread), config.bias_points * random.normal()))
            .collect();
        for (texture, labels) in textures.iter().zip(labels) {
            for ((pair, label), (scale, bias)) in pairs.iter().zip(labels).zip(&habits) {
                let felt = label + config.noise_points * random.normal();
                ratings.push(Rating {
                    participant: participant.clone(),
                    texture: texture.clone(),
                    pair: pair.clone(),
                    value: Some((50.0 + scale * (felt - 50.0) + bias).clamp(0.0, 100.0)),
                });
            }
        }
    }
    Ok(ratings)
}

/// Sorts by a simulated panel: every participant sorts all textures once for each number of groups, with new noise each
/// time. No group is empty. Groups are numbered in the order of first appearance.
///
/// # Errors
/// See [`PanelError`].
pub fn simulated_sorts(
    textures: &[String],
    labels: &[Vec<f64>],
    numbers_of_groups: &[usize],
    config: &PanelConfig,
) -> Result<Vec<Sort>, PanelError> {
    check_names(textures, labels)?;
    check(labels, labels.first().map_or(0, Vec::len), config)?;
    let n_textures = labels.len();
    if let Some(n_groups) = numbers_of_groups.iter().copied().find(|n| *n == 0 || *n > n_textures) {
        return Err(PanelError::Groups { n_textures, n_groups });
    }
    let mut sorts = Vec::with_capacity(config.n_participants * numbers_of_groups.len());
    for participant in participants(config) {
        let mut random = Random::new(derive_seed(config.seed, &format!("{participant} sorts")));
        for n_groups in numbers_of_groups.iter().copied() {
            let felt: Vec<Vec<f64>> = labels
                .iter()
                .map(|l| l.iter().map(|v| v + config.noise_points * random.normal()).collect())
                .collect();
            let first = random.below(n_textures);
            let groups = by_first_appearance(&group(&felt, n_groups, first));
            let place = |(texture, group): (&String, usize)| Grouped {
                texture: texture.clone(),
                group: (group + 1).to_string(),
            };
            sorts.push(Sort {
                participant: participant.clone(),
                trial: format!("{n_groups} groups"),
                n_groups: Some(n_groups),
                placements: textures.iter().zip(groups).map(place).collect(),
            });
        }
    }
    Ok(sorts)
}

fn participants(config: &PanelConfig) -> impl Iterator<Item = String> {
    (1..=config.n_participants).map(simulated_name)
}

/// Name of a simulated participant, numbered from 1.
pub fn simulated_name(number: usize) -> String {
    format!("simulated-{number:02}")
}

fn check_names(textures: &[String], labels: &[Vec<f64>]) -> Result<(), PanelError> {
    let (n_names, n_labels) = (textures.len(), labels.len());
    if n_names == n_labels { Ok(()) } else { Err(PanelError::Names { n_names, n_labels }) }
}

fn check(labels: &[Vec<f64>], n_labels: usize, config: &PanelConfig) -> Result<(), PanelError> {
    let parts = [
        ("the noise", config.noise_points),
        ("the bias", config.bias_points),
        ("the spread of the scale", config.scale_log_spread),
    ];
    for (what, value) in parts {
        if !(value.is_finite() && value >= 0.0) {
            return Err(PanelError::Config { what, value });
        }
    }
    if config.n_participants == 0 {
        return Err(PanelError::Nobody);
    }
    for (texture, of_texture) in labels.iter().enumerate() {
        if of_texture.len() != n_labels {
            return Err(PanelError::Labels { texture, n: of_texture.len(), expected: n_labels });
        }
        if let Some(label) = of_texture.iter().position(|v| !(0.0..=100.0).contains(v)) {
            return Err(PanelError::Label { texture, label, value: of_texture[label] });
        }
    }
    Ok(())
}

/// Lloyd's k-means clustering; returns the group of each texture. The first center is texture `first`, and each further
/// center is the texture farthest from the existing ones. An empty group takes the texture farthest from its own
/// center.
pub(crate) fn group(felt: &[Vec<f64>], n_groups: usize, first: usize) -> Vec<usize> {
    let mut centers = vec![felt[first].clone()];
    while centers.len() < n_groups {
        let farthest = farthest(felt, |point| nearest(point, &centers).1);
        centers.push(felt[farthest].clone());
    }
    let mut groups = vec![usize::MAX; felt.len()];
    for _ in 0..MAX_ROUNDS {
        let mut moved: Vec<usize> = felt.iter().map(|point| nearest(point, &centers).0).collect();
        fill_empty(&mut moved, felt, &centers);
        if moved == groups {
            break;
        }
        groups = moved;
        for (index, center) in centers.iter_mut().enumerate() {
            let members: Vec<&Vec<f64>> =
                felt.iter().zip(&groups).filter(|(_, g)| **g == index).map(|(point, _)| point).collect();
            for (dimension, coordinate) in center.iter_mut().enumerate() {
                *coordinate = members.iter().map(|m| m[dimension]).sum::<f64>() / members.len() as f64;
            }
        }
    }
    groups
}

fn fill_empty(groups: &mut [usize], felt: &[Vec<f64>], centers: &[Vec<f64>]) {
    for empty in 0..centers.len() {
        if groups.contains(&empty) {
            continue;
        }
        let shared = |texture: &usize| groups.iter().filter(|g| **g == groups[*texture]).count() > 1;
        let off = |texture: &usize| squared_distance(&felt[*texture], &centers[groups[*texture]]);
        let taken = (0..felt.len()).filter(shared).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(taken) = taken {
            groups[taken] = empty;
        }
    }
}

fn farthest(felt: &[Vec<f64>], distance: impl Fn(&Vec<f64>) -> f64) -> usize {
    let distances: Vec<f64> = felt.iter().map(distance).collect();
    (0..felt.len()).max_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap_or_default()
}

/// Index of the nearest center and the squared distance to it.
fn nearest(point: &[f64], centers: &[Vec<f64>]) -> (usize, f64) {
    let distances = centers.iter().map(|center| squared_distance(point, center)).enumerate();
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

fn by_first_appearance(groups: &[usize]) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::new();
    let number = |group: &usize| {
        order.iter().position(|known| known == group).unwrap_or_else(|| {
            order.push(*group);
            order.len() - 1
        })
    };
    groups.iter().map(number).collect()
}

#[cfg(test)]
mod tests;
