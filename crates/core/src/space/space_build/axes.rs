//! The two axes of an authoring space: choice of the adjective pairs, positions of the textures, and their prediction.

use crate::people::property::{ZeroAt, angle_degrees, axis_positions, orthogonal_to, project};
use crate::people::ratings::AdjectivePair;
use crate::space::features::FeatureTable;
use crate::space::selection::{
    self, AxisModel, Method, PaperChain, STANDARD, Scheme, SelectionError, Validation, fit_axis, paper_chain,
    validate,
};
use crate::space::space_build::{Adjective, PlacedBy, SpaceBuildError, SpaceOptions};

/// Axis of an authoring space.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Adjective pair of the axis, the pole at 0 first.
    pub pair: AdjectivePair,
    /// Index of the pair among the adjectives.
    pub adjective: usize,
    /// Unit vector in the perceptual space along which axis values increase.
    pub direction: Vec<f64>,
    /// Perceived position of each texture, from the judgments, 0..100.
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
/// positions correlated better.
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

/// The axes, and the adjective pairs chosen for them.
pub(super) struct Axes {
    pub(super) fitted: [Axis; 2],
    /// Angle between the directions of the two pairs in the perceptual space, in degrees.
    pub(super) angle_degrees: f64,
    /// Indices of the pairs among the adjectives, and which pole of each is at 0.
    pub(super) chosen: [(usize, ZeroAt); 2],
}

/// Poles of the preferred axes.
const USUAL: [[&str; 2]; 2] = [["rough", "smooth"], ["hard", "soft"]];

/// Fits both axes. `begin_axis` is called with the index of each axis before its model is fitted; an error from
/// `begin_axis` is returned. `go_on` is called before every model fit; if it returns `false`, the work stops.
pub(super) fn fit_axes(
    adjectives: &[Adjective],
    points: &[Vec<f64>],
    features: &FeatureTable,
    options: &SpaceOptions,
    begin_axis: &dyn Fn(usize) -> Result<(), SpaceBuildError>,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Axes, SpaceBuildError> {
    let chosen = choose(adjectives, options)?;
    let oriented = chosen.map(|(index, zero_at)| {
        let line = adjectives[index].line.as_ref().map_or_else(|_| Vec::new(), |line| line.direction.clone());
        zero_at.oriented(line)
    });
    let angle_degrees = angle_degrees(&oriented[0], &oriented[1]);
    let [first, mut second] = oriented;
    if options.is_orthogonal {
        second = orthogonal_to(&second, std::slice::from_ref(&first))
            .map_err(|source| SpaceBuildError::Axis { pair: adjectives[chosen[1].0].pair.name(), source })?;
    }
    let fit = |at: usize, direction: Vec<f64>| -> Result<Axis, SpaceBuildError> {
        let (adjective, zero_at) = chosen[at];
        let pair = as_axis(&adjectives[adjective].pair, zero_at);
        let felt = axis_positions(&project(points, &direction), ZeroAt::LowRatings)
            .ok_or_else(|| SpaceBuildError::FlatAxis { pair: pair.name() })?;
        begin_axis(at)?;
        let prediction = match predict(features, &felt, options, go_on) {
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
    };
    Ok(Axes { fitted: [fit(0, first)?, fit(1, second)?], angle_degrees, chosen })
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

/// The pair with the pole at 0 first.
fn as_axis(pair: &AdjectivePair, zero_at: ZeroAt) -> AdjectivePair {
    match zero_at {
        ZeroAt::LowRatings => pair.clone(),
        ZeroAt::HighRatings => AdjectivePair { low: pair.high.clone(), high: pair.low.clone() },
    }
}

/// Indices of the adjectives that become the axes, and which pole of each is at 0.
fn choose(adjectives: &[Adjective], options: &SpaceOptions) -> Result<[(usize, ZeroAt); 2], SpaceBuildError> {
    if let Some([first, second]) = &options.axes {
        let axes = [named(adjectives, first)?, named(adjectives, second)?];
        if axes[0].0 == axes[1].0 {
            return Err(no_such_axis(adjectives, second, "it is already the other axis"));
        }
        return Ok(axes);
    }
    let usable: Vec<usize> =
        (0..adjectives.len()).filter(|i| adjectives[*i].usable_line().is_some()).collect();
    if usable.len() < 2 {
        return Err(SpaceBuildError::TooFewPairs { n_pairs: usable.len(), reasons: reasons(adjectives) });
    }
    let usual = USUAL.map(|poles| find(adjectives, poles).filter(|(index, _)| usable.contains(index)));
    if let [Some(first), Some(second)] = usual {
        return Ok([first, second]);
    }
    let mut chosen: Vec<(usize, ZeroAt)> = Vec::new();
    for dimension in 0..2 {
        let strength = |i: &usize| {
            let line = adjectives[*i].usable_line();
            line.and_then(|line| *line.correlations.get(dimension)?).map_or(0.0, f64::abs)
        };
        let free = usable.iter().filter(|i| chosen.iter().all(|(taken, _)| taken != *i));
        let best = free.max_by(|a, b| strength(a).total_cmp(&strength(b)));
        chosen.extend(best.map(|index| (*index, ZeroAt::LowRatings)));
    }
    match chosen[..] {
        [first, second] => Ok([first, second]),
        _ => Err(SpaceBuildError::TooFewPairs { n_pairs: chosen.len(), reasons: reasons(adjectives) }),
    }
}

/// Reasons why pairs cannot be axes, each after a semicolon.
fn reasons(adjectives: &[Adjective]) -> String {
    let reason = |adjective: &Adjective| match &adjective.line {
        Err(error) => Some(format!("; {}: {error}", adjective.pair)),
        Ok(_) if !adjective.is_relevant => {
            Some(format!("; {}: too few votes find it relevant", adjective.pair))
        }
        Ok(_) => None,
    };
    adjectives.iter().filter_map(reason).collect()
}

/// Index of the adjective with these poles, and which pole of it is at 0.
fn find(adjectives: &[Adjective], [low, high]: [&str; 2]) -> Option<(usize, ZeroAt)> {
    let is = |a: &str, b: &str| a.trim().eq_ignore_ascii_case(b.trim());
    adjectives.iter().enumerate().find_map(|(index, Adjective { pair, .. })| {
        if is(&pair.low, low) && is(&pair.high, high) {
            Some((index, ZeroAt::LowRatings))
        } else if is(&pair.low, high) && is(&pair.high, low) {
            Some((index, ZeroAt::HighRatings))
        } else {
            None
        }
    })
}

fn named(adjectives: &[Adjective], pair: &AdjectivePair) -> Result<(usize, ZeroAt), SpaceBuildError> {
    let Some((index, zero_at)) = find(adjectives, [&pair.low, &pair.high]) else {
        return Err(no_such_axis(adjectives, pair, "it was not rated"));
    };
    if !adjectives[index].is_relevant {
        return Err(no_such_axis(adjectives, pair, "too few votes find it relevant"));
    }
    match &adjectives[index].line {
        Ok(_) => Ok((index, zero_at)),
        Err(source) => Err(SpaceBuildError::Axis { pair: pair.name(), source: source.clone() }),
    }
}

fn no_such_axis(adjectives: &[Adjective], pair: &AdjectivePair, reason: &'static str) -> SpaceBuildError {
    let usable = adjectives.iter().filter(|a| a.usable_line().is_some());
    let pairs: Vec<String> = usable.map(|a| a.pair.name()).collect();
    SpaceBuildError::NoSuchAxis { pair: pair.name(), reason, pairs: pairs.join(", ") }
}
