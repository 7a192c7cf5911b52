//! Input of simulated raters: positions and attributes of the textures of a library, plus values derived from their
//! models.
//!
//! The output always contains the five adjective pairs of "Predicting Perceptual Haptic Attributes of Textured Surface
//! from Tactile Data Based on Deep CNN-LSTM Network" (VRST 2023). If a library lacks one of them, the simulation
//! assumes:
//!
//! - `sticky-slippery` decreases with the friction coefficient, scaled to the range of the library;
//! - `flat-bumpy` decreases with the logarithm of the spectral centroid, because long wavelengths are bumps;
//! - `irritating-pleasant` is 0.7 `rough-smooth` + 0.3 `hard-soft`, if these are the first two axes.
//!
//! Axes that are computed from the vibration, and dimensions of a perceptual space, are not rated.
//!
//! No person stated this: these are assumptions of a simulation for testing the pipeline.

use shagreen_core::people::property::{ZeroAt, axis_positions};
use shagreen_core::people::ratings::{AdjectivePair, PairNameError};
use shagreen_core::space::features::{Physical, physical};
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::texture::patterns::paper_patterns;

use crate::library::{Library, TextureEntry, USUAL_AXES};
use crate::placed_space::is_dimension_name;

/// Attribute values of the textures that have a position.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedRaterLabels {
    /// The adjective pairs: the axes, further attributes that all these textures have, and assumed ones.
    pub pairs: Vec<AdjectivePair>,
    /// Identifiers of the textures.
    pub ids: Vec<String>,
    /// Values of each texture, 0..100, one per pair.
    pub labels: Vec<Vec<f64>>,
}

/// Why there are no labels.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulatedRaterLabelsError {
    /// No texture has a position.
    #[error(
        "no texture of the library has a position, which simulated raters need; assign positions from a table"
    )]
    NoPlaces,
    /// An attribute name is not an adjective pair.
    #[error(transparent)]
    Pair(#[from] PairNameError),
}

impl SimulatedRaterLabels {
    /// Returns the labels on these pairs, and the pairs that have none. A pair that is known with exchanged poles gets its
    /// labels from the other end.
    pub fn on(&self, pairs: &[AdjectivePair]) -> (Self, Vec<AdjectivePair>) {
        let is = |a: &str, b: &str| a.trim().eq_ignore_ascii_case(b.trim());
        let column = |pair: &AdjectivePair| {
            self.pairs.iter().enumerate().find_map(|(column, known)| {
                let is_same = is(&known.low, &pair.low) && is(&known.high, &pair.high);
                let is_turned = is(&known.low, &pair.high) && is(&known.high, &pair.low);
                (is_same || is_turned).then_some((column, is_turned))
            })
        };
        let (mut known, mut unknown) = (Vec::new(), Vec::new());
        for pair in pairs {
            match column(pair) {
                Some(found) => known.push((pair.clone(), found)),
                None => unknown.push(pair.clone()),
            }
        }
        let row = |labels: &Vec<f64>| -> Vec<f64> {
            let label = |(_, (column, is_turned)): &(AdjectivePair, (usize, bool))| {
                if *is_turned { 100.0 - labels[*column] } else { labels[*column] }
            };
            known.iter().map(label).collect()
        };
        let labels = self.labels.iter().map(row).collect();
        let pairs = known.into_iter().map(|(pair, _)| pair).collect();
        (Self { pairs, ids: self.ids.clone(), labels }, unknown)
    }
}

/// Returns the labels of a library.
///
/// # Errors
/// See [`SimulatedRaterLabelsError`].
pub fn panel_labels(library: &Library) -> Result<SimulatedRaterLabels, SimulatedRaterLabelsError> {
    let placed: Vec<&TextureEntry> = library.textures.iter().filter(|t| t.place.is_some()).collect();
    let first = placed.first().ok_or(SimulatedRaterLabelsError::NoPlaces)?;
    let is_known_to_all =
        |name: &&str| placed.iter().all(|t| t.attributes.as_ref().is_some_and(|a| a.get(name).is_some()));
    let names = first.attributes.iter().flat_map(|a| &a.values).map(|a| a.name.as_str());
    let axes = library.axis_names();
    let rated: Vec<(usize, &str)> =
        axes.iter().copied().enumerate().filter(|(_, name)| can_be_rated(name)).collect();
    let further: Vec<&str> =
        names.filter(|name| !axes.contains(name) && can_be_rated(name)).filter(is_known_to_all).collect();
    let pairs = rated.iter().map(|(_, name)| name).chain(&further).map(|name| name.parse());
    let of = |texture: &&TextureEntry| -> Option<Vec<f64>> {
        let at = texture.at()?.on(axes.len());
        let coordinates = rated.iter().filter_map(|(axis, _)| at.get(*axis));
        let attributes = further.iter().filter_map(|name| texture.attributes.as_ref()?.get(name));
        Some(coordinates.chain(attributes).collect())
    };
    let mut perceived = SimulatedRaterLabels {
        pairs: pairs.collect::<Result<_, _>>()?,
        ids: placed.iter().map(|texture| texture.id.clone()).collect(),
        labels: placed.iter().filter_map(of).collect(),
    };
    for (name, values) in assumed(&placed, axes.starts_with(&USUAL_AXES)) {
        let assumed: AdjectivePair = name.parse()?;
        let turned = AdjectivePair { low: assumed.high.clone(), high: assumed.low.clone() };
        let is_known = perceived.pairs.iter().any(|pair| *pair == assumed || *pair == turned);
        let Some(values) = values.filter(|_| !is_known) else { continue };
        perceived.pairs.push(assumed);
        for (labels, value) in perceived.labels.iter_mut().zip(values) {
            labels.push(value);
        }
    }
    Ok(perceived)
}

/// Whether an axis or attribute can be rated: it is neither computed from the vibration nor a dimension of a perceptual space.
fn can_be_rated(name: &str) -> bool {
    SignalAxis::from_name(name).is_none() && !is_dimension_name(name)
}

/// Returns the assumed values of the positioned textures, 0..100; `None` if a quantity is missing or equal for all.
/// Values derived from the axes need the usual ones as the first two.
fn assumed(placed: &[&TextureEntry], is_usual: bool) -> [(&'static str, Option<Vec<f64>>); 3] {
    let contacts = paper_patterns();
    let physical: Vec<Physical> = placed.iter().map(|texture| physical(&texture.model, &contacts)).collect();
    let falling = |quantity: fn(&Physical) -> Option<f64>| {
        let values: Option<Vec<f64>> = physical.iter().map(quantity).collect();
        axis_positions(&values?, ZeroAt::HighRatings)
    };
    let pleasant = placed.iter().map(|t| t.at().map(|at| 0.7 * at.x() + 0.3 * at.y()));
    [
        ("flat-bumpy", falling(|p| p.centroid_hz.map(f64::ln))),
        ("sticky-slippery", falling(|p| p.friction)),
        ("irritating-pleasant", if is_usual { pleasant.collect() } else { None }),
    ]
}

#[cfg(test)]
mod tests {
    use super::{SimulatedRaterLabelsError, panel_labels};
    use crate::library::{Attribute, Attributes, Library};
    use crate::starter::starter_library;
    use shagreen_core::people::ratings::AdjectivePair;
    use shagreen_core::space::LabelSource;

    #[test]
    fn places_and_shared_attributes_are_perceived() {
        let mut library = starter_library().unwrap();
        library.textures[3].place = None;
        for (i, texture) in library.textures.iter_mut().enumerate() {
            let value = |name: &str| Attribute { name: name.to_owned(), value: i as f64 };
            let mut values = vec![value("hard-soft"), value("flat-bumpy")];
            values.extend((i != 5).then(|| value("warm-cold")));
            texture.attributes = Some(Attributes { source: LabelSource::PhysicalLabels, values });
        }
        let labels = panel_labels(&library).unwrap();
        let names: Vec<String> = labels.pairs.iter().map(AdjectivePair::name).collect();
        let five = ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];
        assert_eq!(names, five);
        assert_eq!((labels.ids.len(), labels.labels.len(), labels.labels[0].len()), (24, 24, 5));
        assert!(labels.labels.iter().flatten().all(|value| (0.0..=100.0).contains(value)), "{labels:?}");
        let slippery: Vec<f64> = labels.labels.iter().map(|of| of[3]).collect();
        assert!(slippery.contains(&0.0) && slippery.contains(&100.0));
        // Other pairs are taken out of them, from either end.
        let pairs = ["slippery-sticky", "thick-thin", "rough-smooth"]
            .map(|name| name.parse::<AdjectivePair>().unwrap());
        let (on_pairs, unknown) = labels.on(&pairs);
        assert_eq!(
            (on_pairs.pairs.as_slice(), unknown.as_slice()),
            (&[pairs[0].clone(), pairs[2].clone()][..], &pairs[1..2])
        );
        for (row, all) in on_pairs.labels.iter().zip(&labels.labels) {
            assert_eq!(*row, [100.0 - all[3], all[0]]);
        }
        // The position takes precedence over the attribute of the same name.
        assert_eq!(labels.labels[4][1], library.textures[5].at().unwrap().y());
        assert_eq!(labels.labels[4][2], 5.0);
        assert_eq!(panel_labels(&Library::default()), Err(SimulatedRaterLabelsError::NoPlaces));
    }

    #[test]
    fn further_axes_are_perceived_unless_nobody_rates_them() {
        let mut library = starter_library().unwrap();
        let axes = ["rough-smooth", "hard-soft", "centroid", "warm-cold"];
        library.axes = Some(axes.map(str::to_owned).to_vec());
        for (i, texture) in library.textures.iter_mut().enumerate() {
            let place = texture.place.as_mut().unwrap();
            place.at = place.at.on(4).with(3, i as f64);
            let values = vec![Attribute { name: "dimension 3".to_owned(), value: 1.0 }];
            texture.attributes = Some(Attributes { source: LabelSource::SimulatedRaters, values });
        }
        let labels = panel_labels(&library).unwrap();
        let names: Vec<String> = labels.pairs.iter().map(AdjectivePair::name).collect();
        let expected = ["rough-smooth", "hard-soft", "warm-cold", "flat-bumpy", "sticky-slippery"];
        assert_eq!(names[..5], expected);
        let at = library.textures[7].at().unwrap();
        assert_eq!(labels.labels[7][..3], [at.x(), at.y(), 7.0]);
        assert!(labels.labels.iter().all(|of| of.len() == names.len()));
    }
}
