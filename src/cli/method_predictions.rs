//! Leave-one-texture-out errors of attribute predictors.

use std::collections::BTreeMap;

use serde_json::{Value, json};
use shagreen_core::maths::statistics::mean;

/// Predictions of one method for all textures.
pub(crate) struct MethodPredictions {
    /// Name of the method.
    pub(crate) name: String,
    /// Predicted attributes: textures × attributes, 0..100.
    pub(crate) predicted: Vec<Vec<f64>>,
}

/// Name of the baseline.
const BASELINE: &str = "mean of the others";

impl MethodPredictions {
    /// Returns whether this is the baseline, which does not look at a texture.
    pub(crate) fn is_baseline(&self) -> bool {
        self.name == BASELINE
    }

    /// Baseline: the prediction for each texture is the mean of the others.
    pub(crate) fn mean_of_others(values: &[Vec<f64>]) -> Self {
        let n_attributes = values.first().map_or(0, Vec::len);
        let without = |index: usize, attribute: usize| {
            let others = values.iter().enumerate().filter(|(i, _)| *i != index);
            mean(&others.map(|(_, values)| values[attribute]).collect::<Vec<f64>>())
        };
        let of = |index| (0..n_attributes).map(|attribute| without(index, attribute)).collect();
        Self { name: BASELINE.to_owned(), predicted: (0..values.len()).map(of).collect() }
    }

    /// Returns the mean absolute error of each attribute, in points of 0..100.
    pub(crate) fn mae(&self, values: &[Vec<f64>]) -> Vec<f64> {
        errors(&self.predicted, values).mae
    }

    /// Returns the root mean square error (RMSE) of each attribute, in points of 0..100.
    pub(crate) fn rmse(&self, values: &[Vec<f64>]) -> Vec<f64> {
        errors(&self.predicted, values).rmse
    }
}

/// Errors of one method by attribute, in points of 0..100.
struct Errors {
    mae: Vec<f64>,
    rmse: Vec<f64>,
}

/// Comparison of several methods.
pub(crate) struct Comparison<'a> {
    all: &'a [MethodPredictions],
    names: &'a [String],
    errors: Vec<Errors>,
    best: usize,
}

impl<'a> Comparison<'a> {
    /// Compares at least one method. `values` are the true attributes (textures × attributes), `names` the names of the
    /// attributes.
    pub(crate) fn new(all: &'a [MethodPredictions], names: &'a [String], values: &[Vec<f64>]) -> Self {
        let errors: Vec<Errors> = all.iter().map(|judged| errors(&judged.predicted, values)).collect();
        let total = |errors: &Errors| errors.rmse.iter().sum::<f64>();
        let best =
            (0..all.len()).min_by(|a, b| total(&errors[*a]).total_cmp(&total(&errors[*b]))).unwrap_or(0);
        Self { all, names, errors, best }
    }

    /// Returns the name of the method with the smallest RMSE, summed over the attributes.
    pub(crate) fn chosen(&self) -> &str {
        &self.all[self.best].name
    }

    /// Returns the fields of the JSON result.
    pub(crate) fn as_json(&self) -> serde_json::Map<String, Value> {
        let baselines: BTreeMap<&str, Value> = self
            .all
            .iter()
            .zip(&self.errors)
            .map(|(judged, of)| {
                let of = json!({"mae": self.by_name(&of.mae), "rmse": self.by_name(&of.rmse)});
                (judged.name.as_str(), of)
            })
            .collect();
        let best = &self.errors[self.best];
        let fields = [
            ("chosen", json!(self.chosen())),
            ("mae", json!(self.by_name(&best.mae))),
            ("rmse", json!(self.by_name(&best.rmse))),
            ("baselines", json!(baselines)),
        ];
        fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Returns a table of mean absolute errors, a table of RMSEs, and the name of the best method.
    pub(crate) fn text(&self) -> String {
        let widest = self.all.iter().map(|judged| judged.name.len()).max().unwrap_or(0);
        let row = |name: &str, values: &[f64]| {
            let cell = |(value, name): (&f64, &String)| format!("{value:>0$.2}", name.len());
            let cells: Vec<String> = values.iter().zip(self.names).map(cell).collect();
            format!("{name:<widest$}  {}\n", cells.join("  "))
        };
        let heading = format!("{:widest$}  {}\n", "", self.names.join("  "));
        let table_of = |what: &str, pick: fn(&Errors) -> &[f64]| {
            let rows: String = self
                .all
                .iter()
                .zip(&self.errors)
                .map(|(judged, errors)| row(&judged.name, pick(errors)))
                .collect();
            format!("{what}\n{heading}{rows}")
        };
        format!(
            "{}\n{}\nLowest root mean square error, summed over the attributes: {}.",
            table_of("Mean absolute error, in points (0 to 100)", |errors| &errors.mae),
            table_of("Root mean square error, in points (0 to 100)", |errors| &errors.rmse),
            self.chosen()
        )
    }

    /// Returns values by attribute name.
    pub(crate) fn by_name(&self, values: &[f64]) -> BTreeMap<&str, f64> {
        self.names.iter().map(String::as_str).zip(values.iter().copied()).collect()
    }
}

fn errors(predicted: &[Vec<f64>], values: &[Vec<f64>]) -> Errors {
    let n_attributes = values.first().map_or(0, Vec::len);
    let off = |attribute: usize| -> Vec<f64> {
        predicted.iter().zip(values).map(|(p, v)| (p[attribute] - v[attribute]).abs()).collect()
    };
    let square =
        |errors: &[f64]| mean(&errors.iter().map(|error| error * error).collect::<Vec<f64>>()).sqrt();
    Errors {
        mae: (0..n_attributes).map(|attribute| mean(&off(attribute))).collect(),
        rmse: (0..n_attributes).map(|attribute| square(&off(attribute))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Comparison, MethodPredictions};

    #[test]
    fn errors_are_their_definitions_and_the_best_way_is_named() {
        let values = vec![vec![10.0, 0.0], vec![20.0, 50.0], vec![60.0, 100.0]];
        let mean = MethodPredictions::mean_of_others(&values);
        assert_eq!(mean.predicted, [[40.0, 75.0], [35.0, 50.0], [15.0, 25.0]]);
        let near = MethodPredictions {
            name: "near".to_owned(),
            predicted: vec![vec![13.0, 0.0], vec![24.0, 50.0], vec![60.0, 95.0]],
        };
        let names = ["a".to_owned(), "b".to_owned()];
        let all = [mean, near];
        let comparison = Comparison::new(&all, &names, &values);
        assert_eq!(comparison.chosen(), "near");
        let told = comparison.as_json();
        assert!((told["mae"]["a"].as_f64().unwrap() - 7.0 / 3.0).abs() < 1e-12);
        assert!((told["rmse"]["a"].as_f64().unwrap() - (25.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(told["baselines"]["mean of the others"]["mae"]["a"], 30.0);
        assert!(comparison.text().contains("summed over the attributes: near."));
    }
}
