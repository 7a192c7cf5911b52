//! Leave-one-texture-out errors of attribute predictors.

use std::collections::BTreeMap;

use serde_json::{Value, json};

pub(crate) use shagreen_studio::method_predictions::MethodPredictions;

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
        let errors_of =
            |judged: &MethodPredictions| Errors { mae: judged.mae(values), rmse: judged.rmse(values) };
        let errors: Vec<Errors> = all.iter().map(errors_of).collect();
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

#[cfg(test)]
mod tests {
    use super::{Comparison, MethodPredictions};

    #[test]
    fn errors_are_their_definitions_and_the_best_way_is_named() {
        let values = vec![vec![10.0, 0.0], vec![20.0, 50.0], vec![60.0, 100.0]];
        let mean = MethodPredictions::mean_of_others(&values);
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
