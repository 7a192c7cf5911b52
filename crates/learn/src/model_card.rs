//! Model card of a network of strokes: what it predicts, how well, and how it was trained.

use serde::{Deserialize, Serialize};
use shagreen_core::maths::statistics::mean;
use shagreen_core::words::two_digits;

/// Model card: what a network predicts, its error, and its training data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCard {
    /// Names of the attributes.
    pub attributes: Vec<String>,
    /// RMSE of each attribute on textures left out of training, in points of 0 to 100.
    pub left_out_rmse: Vec<f64>,
    /// Kind of network.
    pub network: String,
    /// Description of the training data.
    pub learned_from: String,
    /// Sources of the training labels, as identifiers of library files.
    pub label_sources: Vec<String>,
    /// Comparison with the Gaussian process on the same textures; `None` in files of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gaussian_process: Option<GaussianProcessComparison>,
    /// Epochs and strokes of the training; `None` in files of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<TrainingExtent>,
}

/// Leave-one-texture-out errors of a network and of the Gaussian process over texture models, on the same textures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GaussianProcessComparison {
    /// Mean absolute error of the network for each attribute, in points of 0 to 100.
    pub network_mae: Vec<f64>,
    /// Mean absolute error of the Gaussian process for each attribute, in points of 0 to 100.
    pub gaussian_process_mae: Vec<f64>,
    /// Whether the error of the network, averaged over the attributes, is lower.
    pub network_is_better: bool,
}

impl GaussianProcessComparison {
    /// Compares the mean absolute errors, which are in the order of the attributes.
    pub fn new(network_mae: Vec<f64>, gaussian_process_mae: Vec<f64>) -> Self {
        let network_is_better = is_lower(&network_mae, &gaussian_process_mae);
        Self { network_mae, gaussian_process_mae, network_is_better }
    }

    /// Returns a sentence that says which of the two predicts better.
    pub fn sentence(&self) -> String {
        let says = if self.network_is_better { "beats" } else { "does not beat" };
        format!(
            "The network {says} the Gaussian process on the same textures: mean absolute error {:.1} points, Gaussian process {:.1} (leave one texture out, mean of the attributes).",
            mean(&self.network_mae),
            mean(&self.gaussian_process_mae)
        )
    }
}

fn is_lower(a: &[f64], b: &[f64]) -> bool {
    mean(a) < mean(b)
}

/// How long a network was trained, and on which strokes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingExtent {
    /// Largest number of epochs that was allowed.
    pub most_epochs: usize,
    /// Epochs of the network in the file; a fraction is the last, incomplete epoch.
    pub epochs: f64,
    /// Epochs of the networks that the leave-one-out errors are from, one for each texture.
    pub left_out_epochs: Vec<f64>,
    /// Time budget of the whole training in minutes; `None` without one.
    pub minutes: Option<f64>,
    /// Origin of the strokes.
    pub strokes: StrokeOrigin,
    /// Lowest and highest tip speed of the strokes.
    pub speed_mm_per_s: [f64; 2],
    /// Lowest and highest normal force of the strokes, in N.
    pub force_n: [f64; 2],
}

/// Origin of training strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StrokeOrigin {
    /// Rendered from texture models.
    Rendered,
    /// Recorded from surfaces.
    Recorded,
}

impl TrainingExtent {
    /// Returns a sentence about a training that its time budget ended; `None` if nothing was cut short.
    pub fn sentence(&self) -> Option<String> {
        let minutes = self.minutes?;
        let is_short = |epochs: &f64| *epochs < self.most_epochs as f64;
        (is_short(&self.epochs) || self.left_out_epochs.iter().any(is_short)).then(|| {
            format!(
                "It was trained for {} of at most {} epochs, and the networks that its errors are from for {}, in a time budget of {} minutes for all.",
                two_digits(self.epochs),
                self.most_epochs,
                range_words(&self.left_out_epochs),
                two_digits(minutes)
            )
        })
    }
}

/// Returns the lowest and the highest number of epochs in words: `0.61 to 0.90`, or one number if they are the same.
pub fn range_words(epochs: &[f64]) -> String {
    let highest = epochs.iter().copied().fold(0.0, f64::max);
    let lowest = epochs.iter().copied().fold(highest, f64::min);
    let (lowest, highest) = (two_digits(lowest), two_digits(highest));
    if lowest == highest { highest } else { format!("{lowest} to {highest}") }
}

impl ModelCard {
    /// Returns whether the card can belong to a network with this number of attributes.
    pub(crate) fn fits(&self, n_outputs: usize) -> bool {
        let are_errors = |errors: &[f64]| {
            errors.len() == n_outputs && errors.iter().all(|error| error.is_finite() && *error >= 0.0)
        };
        let is_comparison = |of: &GaussianProcessComparison| {
            are_errors(&of.network_mae)
                && are_errors(&of.gaussian_process_mae)
                && of.network_is_better == is_lower(&of.network_mae, &of.gaussian_process_mae)
        };
        self.attributes.len() == n_outputs
            && are_errors(&self.left_out_rmse)
            && self.gaussian_process.as_ref().is_none_or(is_comparison)
            && self.extent.as_ref().is_none_or(is_extent)
    }
}

/// Returns whether all numbers are possible.
fn is_extent(extent: &TrainingExtent) -> bool {
    let is_range = |[low, high]: [f64; 2]| low >= 0.0 && low <= high && high.is_finite();
    let is_number = |number: f64| number.is_finite() && number >= 0.0;
    is_number(extent.epochs)
        && extent.left_out_epochs.iter().copied().all(is_number)
        && extent.minutes.is_none_or(is_number)
        && is_range(extent.speed_mm_per_s)
        && is_range(extent.force_n)
}

#[cfg(test)]
mod tests {
    use super::{GaussianProcessComparison, ModelCard, StrokeOrigin, TrainingExtent, range_words};

    fn card() -> ModelCard {
        ModelCard {
            attributes: ["rough-smooth", "hard-soft"].map(str::to_owned).to_vec(),
            left_out_rmse: vec![7.5, 12.0],
            network: "serial".to_owned(),
            learned_from: "generated textures".to_owned(),
            label_sources: vec!["simulated".to_owned()],
            gaussian_process: Some(GaussianProcessComparison::new(vec![6.0, 10.0], vec![5.0, 4.0])),
            extent: Some(extent()),
        }
    }

    fn extent() -> TrainingExtent {
        TrainingExtent {
            most_epochs: 200,
            epochs: 1.3,
            left_out_epochs: vec![0.9, 0.61, 0.75],
            minutes: Some(20.0),
            strokes: StrokeOrigin::Rendered,
            speed_mm_per_s: [50.0, 250.0],
            force_n: [0.1, 0.5],
        }
    }

    #[test]
    fn the_card_says_which_predictor_is_better() {
        let worse = GaussianProcessComparison::new(vec![6.0, 10.0], vec![5.0, 4.0]);
        assert_eq!(
            worse.sentence(),
            "The network does not beat the Gaussian process on the same textures: mean absolute error 8.0 points, Gaussian process 4.5 (leave one texture out, mean of the attributes)."
        );
        // Better on average, although not for each attribute.
        let better = GaussianProcessComparison::new(vec![6.0, 1.0], vec![5.0, 4.0]);
        assert!(better.network_is_better && better.sentence().starts_with("The network beats"));
        assert!(!GaussianProcessComparison::new(vec![5.0], vec![5.0]).network_is_better);
    }

    #[test]
    fn a_training_that_was_cut_short_says_so() {
        let said = extent().sentence().unwrap();
        for words in ["for 1.3 of at most 200 epochs", "0.61 to 0.90", "20 minutes"] {
            assert!(said.contains(words), "{said}");
        }
        let done = TrainingExtent { epochs: 200.0, left_out_epochs: vec![200.0; 3], ..extent() };
        assert_eq!(done.sentence(), None);
        assert_eq!(TrainingExtent { minutes: None, ..extent() }.sentence(), None);
        assert_eq!(range_words(&[2.0, 2.0]), "2.0");
    }

    #[test]
    fn cards_of_earlier_files_are_read() {
        let text = r#"{"attributes":["rough-smooth"],"left_out_rmse":[9.5],"network":"paper320",
            "learned_from":"25 textures","label_sources":["simulated"]}"#;
        let card: ModelCard = serde_json::from_str(text).unwrap();
        assert_eq!((card.gaussian_process.clone(), card.extent.clone()), (None, None));
        assert!(card.fits(1) && !card.fits(2));
    }

    #[test]
    fn a_card_is_read_as_it_was_written_and_a_contradictory_one_does_not_fit() {
        let text = serde_json::to_string(&card()).unwrap();
        assert!(text.contains(r#""network_is_better":false"#), "{text}");
        assert_eq!(serde_json::from_str::<ModelCard>(&text).unwrap(), card());
        assert!(card().fits(2));
        let mut comparison = GaussianProcessComparison::new(vec![6.0, 10.0], vec![5.0, 4.0]);
        comparison.network_is_better = true;
        let short = GaussianProcessComparison::new(vec![6.0], vec![5.0]);
        for wrong in [
            ModelCard { gaussian_process: Some(comparison), ..card() },
            ModelCard { gaussian_process: Some(short), ..card() },
            ModelCard { extent: Some(TrainingExtent { epochs: f64::NAN, ..extent() }), ..card() },
            ModelCard { extent: Some(TrainingExtent { force_n: [0.5, 0.1], ..extent() }), ..card() },
        ] {
            assert!(!wrong.fits(2), "{wrong:?}");
        }
    }
}
