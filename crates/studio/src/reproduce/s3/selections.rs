//! Selections of features of the quality model: goodness of fit, elimination, and the weights of the best rotation.

use shagreen_core::maths::least_squares::least_squares;
use shagreen_core::maths::statistics::{centered, dot, is_constant};
use shagreen_core::signals::quality::{
    Feature, PAPER_FEATURES, QualityModel, RatedPair, Rotation, USUAL_TOLERANCE, fit_quality_model, rotate,
};

use crate::reproduce::work::Work;

/// Why the numbers differ from the printed ones.
const REASON: &str =
    "simulated participants judged, whose answers depend on the bit rate alone; other signals and codec";
/// How weights are fitted here.
const FIT: &str = "here, no weight is below 0, and there is no constant";

/// Computes the item from pairs with judged d′.
pub(super) fn item(work: &mut Work<'_>, pairs: &[RatedPair], who: &str) -> anyhow::Result<()> {
    let mut item = work.item("selections", who);
    let spectral = [Feature::SpectralPower, Feature::SpectralAmplitude];
    let of_both = regression(&spectral, pairs);
    let of_all = regression(&Feature::ALL, pairs);
    item.set("power", regression(&spectral[..1], pairs), "");
    item.set("amplitude", regression(&spectral[1..], pairs), "");
    item.set("spectral", of_both, "");
    item.set("spectral-adjusted", of_both.map(|r2| adjusted(r2, pairs.len(), spectral.len())), "");
    item.set("all", of_all, "");
    item.set("all-adjusted", of_all.map(|r2| adjusted(r2, pairs.len(), Feature::ALL.len())), "");
    item.set("gain", of_all.zip(of_both).and_then(|(all, both)| gain(all, both)), "");
    // The paper states no limit of the elimination.
    let selected = fit_quality_model(&Feature::ALL, pairs, USUAL_TOLERANCE)?;
    let kept: Vec<&str> = selected.elimination.kept.iter().map(|feature| feature.id()).collect();
    let what = format!("kept here: {}; {FIT}; {REASON}", kept.join(", "));
    item.set("kept", Some(kept.len() as f64), &what);
    let rotations = rotate(&PAPER_FEATURES, pairs)?;
    for term in rotations.first().map(|best| best.model.terms()).unwrap_or_default() {
        let reason = format!("{FIT}; {REASON}");
        item.set(&format!("weight-{}", term.feature.id()), Some(term.weight), &reason);
    }
    let of_model = QualityModel::fitted(&Feature::ALL, pairs)?.r_squared(pairs);
    item.add("R² of all features without a constant and without weights below 0", "", of_model);
    // What the paper does not report: errors on textures that nothing was fitted to.
    let nested = selected.nested.r_squared;
    item.add("R² with each texture left out of selection and fit", "", nested);
    item.add(
        "root mean square error on left-out textures, over all rotations",
        "d'",
        error_left_out(&rotations, pairs),
    );
    item.explain_all(REASON);
    work.done(item);
    Ok(())
}

/// Goodness of fit of d′ by a linear regression on these features, with weights of either sign and a constant, which the
/// printed adjusted values count. `None` if all judgments are equal, or a feature depends on the others.
fn regression(features: &[Feature], pairs: &[RatedPair]) -> Option<f64> {
    let judged: Vec<f64> = pairs.iter().map(|pair| pair.d_prime).collect();
    if is_constant(&judged) {
        return None;
    }
    let column =
        |feature: &Feature| pairs.iter().map(|pair| pair.distances.by(*feature)).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> =
        std::iter::once(vec![1.0; pairs.len()]).chain(features.iter().map(column)).collect();
    // Dependent features have no regression, and the number counts as missing.
    let residuals = least_squares(&columns, &judged).ok()?.residuals;
    let about_mean = centered(&judged);
    Some(1.0 - dot(&residuals, &residuals) / dot(&about_mean, &about_mean))
}

/// How much larger one goodness of fit is than another, in percent of the other; `None` if the other explains nothing.
fn gain(all: f64, both: f64) -> Option<f64> {
    (both > 0.0).then(|| 100.0 * (all - both) / both)
}

/// Root mean square error over the textures that each rotation leaves out.
fn error_left_out(rotations: &[Rotation], pairs: &[RatedPair]) -> Option<f64> {
    let n_of =
        |rotation: &Rotation| pairs.iter().filter(|pair| rotation.left_out.contains(&pair.texture)).count();
    let n: usize = rotations.iter().map(n_of).sum();
    let squared: f64 = rotations.iter().map(|rotation| rotation.squared_error_left_out).sum();
    (n > 0).then(|| (squared / n as f64).sqrt())
}

/// R² adjusted for the number of features of a regression with a constant. The printed values agree with the definition only
/// if the constant counts as a further feature.
fn adjusted(r_squared: f64, n_pairs: usize, n_features: usize) -> f64 {
    let n_free = n_pairs as f64 - n_features as f64 - 1.0;
    1.0 - (1.0 - r_squared) * (n_pairs as f64 - 1.0) / n_free
}

#[cfg(test)]
mod tests {
    use super::{adjusted, gain, regression};
    use shagreen_core::signals::quality::{Distances, Feature, QualityModel, RatedPair};

    /// Without a constant, the fit of ratings far from 0 is worse than their mean; a regression never is.
    #[test]
    fn a_regression_has_a_constant_and_weights_of_either_sign() {
        let pair = |(texture, roughness): (usize, f64)| {
            let mut distances = Distances::default();
            distances.0[Feature::Roughness as usize] = roughness;
            RatedPair { texture, distances, d_prime: 3.0 - 0.5 * roughness, weight: 1.0 }
        };
        let mut pairs: Vec<RatedPair> = [0.1, 0.4, 0.2, 0.9].into_iter().enumerate().map(pair).collect();
        let features = [Feature::Roughness];
        assert!((regression(&features, &pairs).unwrap() - 1.0).abs() < 1e-12);
        assert!(QualityModel::fitted(&features, &pairs).unwrap().r_squared(&pairs).unwrap() < 0.0);
        assert_eq!(regression(&[Feature::Envelope], &pairs), None, "no signals differ in it");
        for pair in &mut pairs {
            pair.d_prime = 1.0;
        }
        assert_eq!(regression(&features, &pairs), None);
    }

    /// The printed improvement of 30 % is that of 0.90 over 0.69.
    #[test]
    fn an_improvement_needs_something_to_improve() {
        assert!((gain(0.9, 0.69).unwrap() - 30.43).abs() < 0.01);
        assert_eq!((gain(0.4, 0.0), gain(0.4, -0.6)), (None, None));
    }

    /// The printed adjusted value of 0.84 belongs to nine coefficients, that of 0.64 to three.
    #[test]
    fn the_adjusted_goodness_of_fit_is_that_of_the_definition() {
        assert!((adjusted(0.9, 25, 9) - 0.84).abs() < 1e-12);
        assert!((adjusted(0.69, 25, 3) - 0.645_714).abs() < 1e-6);
        assert_eq!(adjusted(1.0, 25, 7), 1.0);
    }
}
