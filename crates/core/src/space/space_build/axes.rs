//! The two axes of an authoring space: positions of the textures, and their prediction.

use crate::maths::statistics::is_constant;
use crate::people::property::{ZeroAt, angle_degrees, axis_positions, orthogonal_to, project};
use crate::people::ratings::AdjectivePair;
use crate::space::SpacePoint;
use crate::space::features::FeatureTable;
use crate::space::selection::{
    self, AxisModel, Method, PaperChain, STANDARD, Scheme, SelectionError, Validation, fit_axis, paper_chain,
    validate,
};
use crate::space::space_build::axis_choice::{Chosen, as_axis, rating_correlation};
use crate::space::space_build::{Adjective, PlacedBy, SpaceBuildError, SpaceOptions};

/// Axis of an authoring space.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Adjective pair of the axis, the pole at 0 first.
    pub pair: AdjectivePair,
    /// Index of the pair among the adjectives.
    pub adjective: usize,
    /// Unit vector in the perceptual space along which axis values increase; `None` without sorts.
    pub direction: Option<Vec<f64>>,
    /// Perceived position of each texture, from the judgments, 0..100. Without sorts, it is the mean rating.
    pub felt: Vec<f64>,
    /// Prediction from features; `None` with fewer textures than [`selection::MIN_TEXTURES`].
    pub prediction: Option<Prediction>,
    /// Whether the perceived or the predicted positions are used.
    pub placed_by: PlacedBy,
}

/// Lowest nested correlation ([`Validation::nested_cv_r`]) at which the predicted positions of an axis are used
/// automatically. From this value on, they are assumed to be closer to human perception than the perceived positions of
/// a small panel, because features do not contain the noise of the panel.
///
/// Determined on the starter library with simulated panels of 3 and 10 raters. The true positions were simulated: those
/// that the vibrations predict, plus a deviation with a standard deviation of 0 to 60 points. For 36 of the 46 axes at
/// or above this limit, the predicted positions correlated better with the true positions than the perceived ones; for
/// the other 10, their correlation was lower by at most 0.02. For 60 of the 74 axes below the limit, the perceived
/// positions correlated better. It was not determined for ratings without sorts, whose positions are the mean ratings.
pub const TRUSTED_NESTED_R: f64 = 0.85;

impl Axis {
    /// Position of each texture, 0..100.
    pub fn places(&self) -> &[f64] {
        match (&self.prediction, self.placed_by) {
            (Some(prediction), PlacedBy::Predicted) => &prediction.predicted,
            _ => &self.felt,
        }
    }

    /// Whether the axis is this pair with its poles exchanged.
    pub fn is_turned(&self, pair: &AdjectivePair) -> bool {
        self.pair.low == pair.high && self.pair.high == pair.low
    }
}

/// Prediction of the positions on an axis from features.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Predicted position of each texture, 0..100, from a model trained on the same textures.
    pub predicted: Vec<f64>,
    /// The axis model.
    pub model: AxisModel,
    /// Intermediate results of the published method, if the method is [`Method::Paper`].
    pub chain: Option<PaperChain>,
    /// Names of the features in the model.
    pub features: Vec<String>,
    /// Cross-validation of the model.
    pub validation: Validation,
}

/// Input that both axes share.
pub(super) struct Fitting<'a> {
    pub(super) adjectives: &'a [Adjective],
    pub(super) features: &'a FeatureTable,
    pub(super) options: &'a SpaceOptions,
    /// Called with the index of each axis before its model is fitted; an error ends the work.
    pub(super) begin_axis: &'a dyn Fn(usize) -> Result<(), SpaceBuildError>,
    /// Called before every model fit; returning `false` ends the work.
    pub(super) go_on: &'a (dyn Fn() -> bool + Sync),
}

/// Axes along the directions of the chosen pairs in the perceptual space with these `points`, and the angle between the
/// two directions, in degrees.
pub(super) fn axes_along(
    fitting: &Fitting<'_>,
    chosen: Chosen,
    points: &[Vec<f64>],
) -> Result<([Axis; 2], f64), SpaceBuildError> {
    let adjectives = fitting.adjectives;
    let oriented = chosen.map(|(index, zero_at)| {
        let line = adjectives[index].line.as_ref().map_or_else(|_| Vec::new(), |line| line.direction.clone());
        zero_at.oriented(line)
    });
    let angle_degrees = angle_degrees(&oriented[0], &oriented[1]);
    let [first, mut second] = oriented;
    if fitting.options.is_orthogonal {
        second = orthogonal_to(&second, std::slice::from_ref(&first))
            .map_err(|source| SpaceBuildError::Axis { pair: adjectives[chosen[1].0].pair.name(), source })?;
    }
    let axis = |at: usize, direction: Vec<f64>| {
        let felt = axis_positions(&project(points, &direction), ZeroAt::LowRatings);
        fitted(fitting, at, chosen[at], Some(direction), felt)
    };
    Ok(([axis(0, first)?, axis(1, second)?], angle_degrees))
}

/// Axes whose perceived positions are the mean ratings on the chosen pairs. Every texture must have a mean rating on both.
pub(super) fn axes_of_means(fitting: &Fitting<'_>, chosen: Chosen) -> Result<[Axis; 2], SpaceBuildError> {
    let axis = |at: usize| {
        let (index, zero_at) = chosen[at];
        let means = fitting.adjectives[index].ratings.iter().filter_map(|average| average.mean);
        let felt: Vec<f64> = match zero_at {
            ZeroAt::LowRatings => means.collect(),
            ZeroAt::HighRatings => means.map(|mean| 100.0 - mean).collect(),
        };
        fitted(fitting, at, chosen[at], None, (!is_constant(&felt)).then_some(felt))
    };
    Ok([axis(0)?, axis(1)?])
}

/// Correlation of the mean ratings on the two axes; `None` if it is unknown.
pub(super) fn axis_correlation(adjectives: &[Adjective], chosen: Chosen) -> Option<f64> {
    let [(first, first_zero), (second, second_zero)] = chosen;
    let r = rating_correlation(&adjectives[first], &adjectives[second])?;
    Some(if first_zero == second_zero { r } else { -r })
}

/// Position of each texture, from both axes.
pub(super) fn positions([first, second]: &[Axis; 2]) -> Vec<SpacePoint> {
    let pairs = first.places().iter().zip(second.places());
    pairs.map(|(x, y)| SpacePoint::plane(*x, *y)).collect()
}

/// An axis with its prediction. `felt` is `None` if all textures have the same perceived position.
fn fitted(
    fitting: &Fitting<'_>,
    at: usize,
    (adjective, zero_at): (usize, ZeroAt),
    direction: Option<Vec<f64>>,
    felt: Option<Vec<f64>>,
) -> Result<Axis, SpaceBuildError> {
    let Fitting { adjectives, features, options, begin_axis, go_on } = fitting;
    let pair = as_axis(&adjectives[adjective].pair, zero_at);
    let felt = felt.ok_or_else(|| SpaceBuildError::FlatAxis { pair: pair.name() })?;
    begin_axis(at)?;
    let prediction = match predict(features, &felt, options, *go_on) {
        Ok(prediction) => Some(prediction),
        Err(SelectionError::Stopped) => return Err(SpaceBuildError::Stopped),
        // With few textures, the space is built without predictions.
        Err(SelectionError::TooFew { .. }) if options.placement != Some(PlacedBy::Predicted) => None,
        Err(source) => return Err(SpaceBuildError::Selection { pair: pair.name(), source }),
    };
    let nested_r = prediction.as_ref().map_or(0.0, |p: &Prediction| p.validation.nested_cv_r);
    let trusted = if nested_r >= TRUSTED_NESTED_R { PlacedBy::Predicted } else { PlacedBy::Felt };
    let placed_by = options.placement.unwrap_or(trusted);
    Ok(Axis { pair, adjective, direction, felt, prediction, placed_by })
}

fn predict(
    features: &FeatureTable,
    felt: &[f64],
    options: &SpaceOptions,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Prediction, SelectionError> {
    let rows: Vec<Vec<f64>> = features.values.rows().into_iter().map(|row| row.to_vec()).collect();
    let columns = selection::FeatureMatrix::from_rows(&rows)?;
    let (model, chain) = match options.method {
        Method::Paper(order) => {
            let chain = paper_chain(&columns, felt, order)?;
            (chain.model.clone(), Some(chain))
        }
        Method::Practical => (fit_axis(&columns, felt, options.method)?, None),
    };
    let scheme = Scheme { n_permutations: options.n_permutations, seed: options.seed, ..STANDARD };
    let validation = validate(&columns, felt, options.method, &scheme, go_on)?;
    let mut used: Vec<usize> = model.features().collect();
    used.sort_unstable();
    used.dedup();
    Ok(Prediction {
        // All features of a table are finite, so the model predicts every row.
        predicted: rows.iter().map(|row| model.predict(row).unwrap_or(50.0)).collect(),
        features: used.into_iter().map(|feature| features.names[feature].clone()).collect(),
        model,
        chain,
        validation,
    })
}
