//! Results of the trained networks: predictions, and how far the training went.

use serde_json::{Map, Value, json};
use shagreen_core::words::two_digits;
use shagreen_learn::model_card::{GaussianProcessComparison, range_words};

use crate::cli::method_predictions::MethodPredictions;

/// Networks of one kind, one for each texture that was left out.
pub(super) struct TrainedKind {
    /// Name of the kind.
    pub(super) name: String,
    /// Row of the paper's Table 3 to which the kind corresponds.
    pub(super) method: &'static str,
    /// Epochs of each network; a fraction is an incomplete epoch.
    pub(super) epochs: Vec<f64>,
    /// Errors beside those of the Gaussian process.
    pub(super) comparison: GaussianProcessComparison,
}

/// Results of all networks.
pub(crate) struct Trained {
    /// Predictions of each kind.
    pub(crate) judged: Vec<MethodPredictions>,
    pub(super) kinds: Vec<TrainedKind>,
    /// Largest number of epochs that was allowed.
    pub(super) most_epochs: usize,
    /// Time budget of all networks.
    pub(super) minutes: Option<f64>,
}

impl Trained {
    /// Returns the number of complete epochs of all networks together.
    pub(crate) fn n_epochs(&self) -> usize {
        self.kinds.iter().flat_map(|kind| &kind.epochs).map(|epochs| *epochs as usize).sum()
    }

    /// Returns a JSON object with one entry for each kind.
    pub(crate) fn as_json(&self) -> Value {
        let of = |kind: &TrainedKind| {
            let fields = json!({
                "method": kind.method,
                "epochs": kind.epochs,
                "most_epochs": self.most_epochs,
                "minutes": self.minutes,
                "beats_gaussian_process": kind.comparison.network_is_better,
            });
            (kind.name.clone(), fields)
        };
        Value::Object(self.kinds.iter().map(of).collect::<Map<String, Value>>())
    }

    /// Returns a paragraph for each kind; empty if no network was trained.
    pub(crate) fn text(&self) -> String {
        let budget = match self.minutes {
            Some(minutes) => {
                format!(", in a time budget of {} minutes for all networks", two_digits(minutes))
            }
            None => String::new(),
        };
        let of = |kind: &TrainedKind| {
            format!(
                "Network {} ({}): each of {} networks trained for {} of at most {} epochs{budget}. {}",
                kind.name,
                kind.method,
                kind.epochs.len(),
                range_words(&kind.epochs),
                self.most_epochs,
                kind.comparison.sentence()
            )
        };
        self.kinds.iter().map(of).collect::<Vec<String>>().join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::{Trained, TrainedKind};
    use shagreen_learn::model_card::GaussianProcessComparison;

    #[test]
    fn results_say_how_far_each_kind_was_trained() {
        let serial = TrainedKind {
            name: "serial".to_owned(),
            method: "serial CNN-LSTM",
            epochs: vec![1.5, 2.75],
            comparison: GaussianProcessComparison::new(vec![8.0], vec![4.0]),
        };
        let trained =
            Trained { judged: Vec::new(), kinds: vec![serial], most_epochs: 200, minutes: Some(20.0) };
        assert_eq!(trained.n_epochs(), 3);
        let text = trained.text();
        for words in [
            "Network serial (serial CNN-LSTM): each of 2 networks trained for 1.5 to 2.8 of at most 200 epochs, in a time budget of 20 minutes",
            "does not beat the Gaussian process",
        ] {
            assert!(text.contains(words), "{text}");
        }
        let json = trained.as_json();
        assert_eq!(json["serial"]["epochs"][1], 2.75);
        assert_eq!((&json["serial"]["minutes"], &json["serial"]["most_epochs"]), (&20.0.into(), &200.into()));
        assert_eq!(json["serial"]["beats_gaussian_process"], false);
        let none = Trained { judged: Vec::new(), kinds: Vec::new(), most_epochs: 200, minutes: None };
        assert_eq!((none.text(), none.as_json().to_string()), (String::new(), "{}".to_owned()));
    }
}
