//! `--figures` of `shagreen train`: predicted against actual attributes, as figures and as a table.

use std::path::{Path, PathBuf};

use shagreen_formats::library::{free_id, id_from_name};
use shagreen_formats::prediction_report::{
    Prediction, PredictionFigure, is_prediction_csv, prediction_csv, prediction_figure,
};

use crate::cli::method_predictions::MethodPredictions;
use shagreen_studio::figure_files::{check_figures, check_together, figure_files, write_together};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Name of the table in the folder of the figures.
const TABLE: &str = "predictions.csv";

#[derive(clap::Args)]
pub(crate) struct FigureArgs {
    /// Folder for figures of predicted against actual attributes, one for each attribute as SVG and CSV: a dot for each
    /// texture, or for each class of labelled photos, the identity line, and bars of one standard deviation if the method
    /// states it. They show the method with the lowest root mean square error, or the model of labelled photos. The table
    /// predictions.csv has the predictions of all methods.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
}

/// Predictions of all methods for textures with known attributes.
pub(crate) struct Judged<'a> {
    /// Predictions of each method; at least one is not the baseline.
    pub(crate) methods: &'a [MethodPredictions],
    /// Standard deviations that a method states (textures × attributes), by its name.
    pub(crate) deviations: &'a [(String, Vec<Vec<f64>>)],
    /// Names of the textures.
    pub(crate) textures: &'a [String],
    /// Names of the attributes.
    pub(crate) attributes: &'a [String],
    /// Actual attributes: textures × attributes, 0..100.
    pub(crate) actual: &'a [Vec<f64>],
    /// How the textures were kept out of training, in words.
    pub(crate) validation: &'a str,
    /// Where the actual attributes come from, in words.
    pub(crate) source: &'a str,
}

impl FigureArgs {
    /// Returns the folder for the figures.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.figures.as_deref()
    }

    /// Checks before hours of training that the figures of these attributes can be written, and replace neither an input
    /// nor a file of another kind.
    pub(crate) fn check(&self, attributes: &[String], inputs: &[Option<&Path>]) -> anyhow::Result<()> {
        let Some(folder) = &self.figures else { return Ok(()) };
        let names = names(attributes);
        check_figures(folder, &names, inputs)?;
        let table = folder.join(TABLE);
        refuse_inputs(&[&table], inputs)?;
        refuse_foreign(&table, "the table of predictions", is_prediction_csv)?;
        check_together(&[&table], Some(folder), &names)
    }

    /// Writes the figures of the best method, without the baseline, and the table of all methods, if they are requested.
    pub(crate) fn write(&self, judged: &Judged<'_>) -> anyhow::Result<()> {
        let mut shown = Vec::new();
        if let Some(method) = best(judged) {
            shown.extend(judged.attributes.iter().map(|attribute| PredictionFigure {
                attribute,
                method: &method.name,
                of: "texture",
                validation: judged.validation,
                source: judged.source,
            }));
        }
        self.draw(&predictions(judged), &shown)
    }

    /// Writes the figures `shown` and the table of all predictions, if they are requested.
    pub(crate) fn draw(
        &self,
        predictions: &[Prediction],
        shown: &[PredictionFigure<'_>],
    ) -> anyhow::Result<()> {
        let Some(folder) = &self.figures else { return Ok(()) };
        let attributes: Vec<String> = shown.iter().map(|figure| figure.attribute.to_owned()).collect();
        let mut files = vec![(folder.join(TABLE), prediction_csv(predictions))];
        for (name, figure) in names(&attributes).iter().zip(shown) {
            files.extend(figure_files(folder, name, &prediction_figure(predictions, figure)));
        }
        write_together(&files, Some(folder))
    }
}

/// Returns the names of the figures' files, without their endings.
fn names(attributes: &[String]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for attribute in attributes {
        let name = format!("predicted-{}", id_from_name(attribute));
        names.push(free_id(&name, |name| names.iter().any(|taken| taken == name)));
    }
    names
}

/// Returns the method with the lowest root mean square error, summed over the attributes, without the baseline.
fn best<'a>(judged: &Judged<'a>) -> Option<&'a MethodPredictions> {
    let total = |method: &MethodPredictions| method.rmse(judged.actual).iter().sum::<f64>();
    let methods = judged.methods.iter().filter(|method| !method.is_baseline());
    methods.min_by(|a, b| total(a).total_cmp(&total(b)))
}

/// Returns all predictions: method by method, attribute by attribute.
fn predictions(judged: &Judged<'_>) -> Vec<Prediction> {
    let mut all = Vec::new();
    for method in judged.methods {
        let deviations =
            judged.deviations.iter().find(|(name, _)| *name == method.name).map(|(_, deviations)| deviations);
        for (index, attribute) in judged.attributes.iter().enumerate() {
            let rows = judged.textures.iter().zip(judged.actual).zip(&method.predicted).enumerate();
            all.extend(rows.map(|(texture_idx, ((texture, actual), predicted))| Prediction {
                texture: texture.clone(),
                attribute: attribute.clone(),
                method: method.name.clone(),
                actual: actual[index],
                predicted: predicted[index],
                deviation: deviations.map(|deviations| deviations[texture_idx][index]),
            }));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{FigureArgs, Judged, MethodPredictions, names};

    fn words(words: &[&str]) -> Vec<String> {
        words.iter().map(|word| (*word).to_owned()).collect()
    }

    #[test]
    fn figures_have_names_of_their_own() {
        let attributes = words(&["rough-smooth", "Rough / smooth", "***"]);
        let expected = ["predicted-rough-smooth", "predicted-rough-smooth-2", "predicted-texture"];
        assert_eq!(names(&attributes), expected);
    }

    #[test]
    fn the_best_method_is_drawn_and_all_are_in_the_table() {
        let folder = tempfile::tempdir().unwrap();
        let figures = folder.path().join("figures");
        let args = FigureArgs { figures: Some(figures.clone()) };
        let actual = vec![vec![10.0, 0.0], vec![20.0, 50.0], vec![60.0, 100.0]];
        let near = vec![vec![13.0, 0.0], vec![24.0, 50.0], vec![60.0, 95.0]];
        let far = vec![vec![50.0, 50.0]; 3];
        let methods = [
            MethodPredictions { name: "far".to_owned(), predicted: far },
            MethodPredictions { name: "near".to_owned(), predicted: near },
            MethodPredictions::mean_of_others(&actual),
        ];
        let (textures, attributes) =
            (words(&["Cork", "Felt", "Glass"]), words(&["rough-smooth", "hard-soft"]));
        let deviations = [("near".to_owned(), vec![vec![5.0, 6.0]; 3])];
        let judged = Judged {
            methods: &methods,
            deviations: &deviations,
            textures: &textures,
            attributes: &attributes,
            actual: &actual,
            validation: "leave-one-texture-out",
            source: "simulated raters",
        };
        args.check(&attributes, &[None]).unwrap();
        assert!(!figures.exists(), "a check writes nothing");
        args.write(&judged).unwrap();
        let read = |name: &str| String::from_utf8(std::fs::read(figures.join(name)).unwrap()).unwrap();
        let table = read("predictions.csv");
        assert_eq!(table.lines().count(), 1 + 3 * 2 * 3);
        assert!(
            table.contains("Felt,hard-soft,near,50,50,6\n") && table.contains("Felt,hard-soft,far,50,50,\n")
        );
        let svg = read("predicted-hard-soft.svg");
        for words in ["predicted by near", "simulated raters", "Cork", "Glass", "standard deviation"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(read("predicted-rough-smooth.csv").contains("textures,Glass,60,60,simulated raters"));
        // The files may be written again, but not over those of others.
        args.check(&attributes, &[None]).unwrap();
        std::fs::write(figures.join("predictions.csv"), "mine").unwrap();
        let error = args.check(&attributes, &[None]).unwrap_err().to_string();
        assert!(error.contains("the table of predictions would replace a file of another kind"), "{error}");
        let none = FigureArgs { figures: None };
        assert!(none.check(&attributes, &[None]).is_ok() && none.write(&judged).is_ok());
    }
}
