//! From the outputs of the heads to one prediction of each attribute, with what makes it uncertain.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::statistics::mean;
use shagreen_core::maths::weighted_statistics::{weighted_mean, weighted_variance};

use crate::photo_config::PhotoConfig;
use crate::photo_deviation::Evidence;
use crate::photo_heads::HeadOutputs;
use crate::photo_set::MaterialClass;

/// Prediction from one photo, before its standard deviations are known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PhotoEvidence {
    /// Roughness, 0 (roughest) to 100 (smoothest).
    pub(crate) rough_smooth: Evidence,
    /// Hardness, 0 (hardest) to 100 (softest).
    pub(crate) hard_soft: Evidence,
    /// Hardness by each head, averaged over the views; `None` for a head that was not trained.
    pub(crate) by_head: ByHead,
    /// Roughness by the class probabilities alone.
    pub(crate) roughness_of_classes: f64,
    /// Probability of each class, averaged over the views.
    pub(crate) probabilities: Vec<f64>,
    /// Distance from the nearest class, averaged over the views.
    pub(crate) distance: f64,
}

/// Hardness by each head, 0 to 100.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ByHead {
    pub(crate) ridge: Option<f64>,
    pub(crate) classes: f64,
    pub(crate) network: Option<f64>,
    pub(crate) kernel: Option<f64>,
}

/// Returns the prediction from the outputs of the heads for all views, and from the roughness that the heads trained on
/// drawn materials predict; `None` for a photo with few pixels.
pub(crate) fn evidence(
    outputs: &HeadOutputs,
    drawn_roughness: Option<Estimate>,
    classes: &[MaterialClass],
    config: &PhotoConfig,
) -> PhotoEvidence {
    let n_views = outputs.probabilities.len();
    let column = |value: fn(&MaterialClass) -> f64| -> Vec<f64> { classes.iter().map(value).collect() };
    let hardness_of_classes = column(|class| class.hard_soft);
    let hardness_by_classes: Vec<f64> =
        outputs.probabilities.iter().map(|of| weighted_mean(&hardness_of_classes, of)).collect();
    let by_network: Option<Vec<f64>> = (!outputs.networks.is_empty()).then(|| {
        let of_view = |view: usize| mean(&outputs.networks.iter().map(|of| of[view]).collect::<Vec<f64>>());
        (0..n_views).map(of_view).collect()
    });
    // Each head with its weight and its prediction for each view.
    let weights = config.hardness;
    let mut heads: Vec<(f64, &[f64])> = vec![(weights.classes, &hardness_by_classes[..])];
    heads.extend(outputs.ridge.iter().map(|of| (weights.ridge, &of[..])));
    heads.extend(outputs.kernel.iter().map(|of| (weights.kernel, &of[..])));
    let n_networks = outputs.networks.len() as f64;
    heads.extend(outputs.networks.iter().map(|of| (weights.network / n_networks, &of[..])));
    let head_weights: Vec<f64> = heads.iter().map(|(weight, _)| *weight).collect();
    let head_means: Vec<f64> = heads.iter().map(|(_, by_view)| mean(by_view)).collect();
    let combined = |view: usize| {
        let values: Vec<f64> = heads.iter().map(|(_, by_view)| by_view[view]).collect();
        weighted_mean(&values, &head_weights)
    };
    let views: Vec<f64> = (0..n_views).map(combined).collect();
    let same = vec![1.0; n_views];

    let probabilities: Vec<f64> = (0..classes.len())
        .map(|class| mean(&outputs.probabilities.iter().map(|of| of[class]).collect::<Vec<f64>>()))
        .collect();
    let roughness_of_classes = column(|class| class.rough_smooth);
    let by_classes = weighted_mean(&roughness_of_classes, &probabilities);
    // What is not known neither moves the roughness nor disagrees with it.
    let drawn = drawn_roughness.unwrap_or(Estimate { mean: by_classes, deviation: 0.0 });
    let share = config.roughness_of_classes;
    let of_labels = |sds: &[f64]| {
        let squares: Vec<f64> = sds.iter().map(|sd| sd * sd).collect();
        weighted_mean(&squares, &probabilities).sqrt()
    };
    PhotoEvidence {
        rough_smooth: Evidence {
            mean: (share * by_classes + (1.0 - share) * drawn.mean).clamp(0.0, 100.0),
            terms: [
                1.0,
                drawn.deviation.powi(2),
                weighted_variance(&roughness_of_classes, &probabilities),
                (by_classes - drawn.mean).powi(2),
            ],
            of_labels: of_labels(&column(|class| class.rough_smooth_sd)),
        },
        hard_soft: Evidence {
            mean: weighted_mean(&head_means, &head_weights).clamp(0.0, 100.0),
            terms: [
                1.0,
                weighted_variance(&views, &same),
                weighted_variance(&head_means, &head_weights),
                weighted_variance(&hardness_of_classes, &probabilities),
            ],
            of_labels: of_labels(&column(|class| class.hard_soft_sd)),
        },
        by_head: ByHead {
            ridge: outputs.ridge.as_ref().map(|of| mean(of)),
            classes: mean(&hardness_by_classes),
            network: by_network.map(|of| mean(&of)),
            kernel: outputs.kernel.as_ref().map(|of| mean(of)),
        },
        roughness_of_classes: by_classes,
        probabilities,
        distance: mean(&outputs.distances),
    }
}

#[cfg(test)]
mod tests {
    use super::{ByHead, evidence};
    use crate::photo_config::{HeadWeights, PhotoConfig};
    use crate::photo_heads::HeadOutputs;
    use crate::photo_set::MaterialClass;
    use shagreen_core::maths::gaussian_process::Estimate;

    fn class(hard_soft: f64, hard_soft_sd: f64, rough_smooth: f64, rough_smooth_sd: f64) -> MaterialClass {
        MaterialClass { name: "a".to_owned(), hard_soft, hard_soft_sd, rough_smooth, rough_smooth_sd }
    }

    #[test]
    fn a_prediction_is_the_weighted_mean_of_heads_and_views_with_its_spread() {
        let classes = [class(10.0, 5.0, 80.0, 10.0), class(90.0, 7.0, 20.0, 20.0)];
        let outputs = HeadOutputs {
            ridge: Some(vec![30.0, 50.0]),
            kernel: None,
            networks: vec![vec![60.0, 60.0], vec![80.0, 80.0]],
            probabilities: vec![vec![1.0, 0.0], vec![0.5, 0.5]],
            distances: vec![1.0, 2.0],
        };
        let config = PhotoConfig {
            hardness: HeadWeights { ridge: 1.0, classes: 2.0, network: 1.0, kernel: 3.0 },
            roughness_of_classes: 0.25,
            ..PhotoConfig::usual(1)
        };
        let drawn = Estimate { mean: 45.0, deviation: 6.0 };
        let of = evidence(&outputs, Some(drawn), &classes, &config);
        assert_eq!(
            of.by_head,
            ByHead { ridge: Some(40.0), classes: 30.0, network: Some(70.0), kernel: None }
        );
        // (40 + 2 · 30 + 70) / 4, and by views (30 + 2 · 10 + 70) / 4 and (50 + 2 · 50 + 70) / 4.
        assert!((of.hard_soft.mean - 42.5).abs() < 1e-12);
        let [one, views, heads, mixture] = of.hard_soft.terms;
        assert_eq!(one, 1.0);
        assert!((views - 12.5_f64.powi(2)).abs() < 1e-9);
        // Heads of 30 (2), 40 (1), 60 (1/2) and 80 (1/2).
        let squares = [12.5_f64, 2.5, 17.5, 37.5].map(|off| off * off);
        let expected = (2.0 * squares[0] + squares[1] + 0.5 * squares[2] + 0.5 * squares[3]) / 4.0;
        assert!((heads - expected).abs() < 1e-9, "{heads} {expected}");
        // Probabilities of 3/4 and 1/4 of values that are 80 apart.
        assert!((mixture - 3.0 / 16.0 * 6400.0).abs() < 1e-9);
        assert!((of.hard_soft.of_labels - (0.75 * 25.0 + 0.25 * 49.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(of.probabilities, [0.75, 0.25]);
        assert_eq!((of.distance, of.roughness_of_classes), (1.5, 65.0));
        assert!((of.rough_smooth.mean - (0.25 * 65.0 + 0.75 * 45.0)).abs() < 1e-12);
        assert_eq!(of.rough_smooth.terms[1], 36.0);
        assert_eq!(of.rough_smooth.terms[3], 400.0);
    }

    #[test]
    fn heads_that_were_not_trained_do_not_count() {
        let classes = [class(10.0, 5.0, 80.0, 10.0), class(90.0, 7.0, 20.0, 20.0)];
        let outputs = HeadOutputs {
            ridge: None,
            kernel: None,
            networks: Vec::new(),
            probabilities: vec![vec![0.0, 1.0]],
            distances: vec![0.7],
        };
        let of = evidence(&outputs, None, &classes, &PhotoConfig::usual(1));
        assert_eq!(of.by_head, ByHead { ridge: None, classes: 90.0, network: None, kernel: None });
        assert_eq!((of.hard_soft.mean, of.hard_soft.terms), (90.0, [1.0, 0.0, 0.0, 0.0]));
        assert_eq!((of.rough_smooth.mean, of.rough_smooth.terms), (20.0, [1.0, 0.0, 0.0, 0.0]));
        // The kernel regression has three times the weight of the class probabilities.
        let outputs = HeadOutputs { kernel: Some(vec![50.0]), ..outputs };
        let usual = PhotoConfig::usual(1);
        let hardness = HeadWeights { kernel: 3.0, ..usual.hardness };
        let of = evidence(&outputs, None, &classes, &PhotoConfig { hardness, ..usual });
        assert_eq!((of.by_head.kernel, of.hard_soft.mean), (Some(50.0), 60.0));
    }
}
