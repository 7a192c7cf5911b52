//! Figures of the attributes that were predicted for classes of labelled photos.

use shagreen_formats::library::USUAL_AXES;
use shagreen_formats::prediction_report::{Prediction, PredictionFigure};
use shagreen_learn::photo_config::PhotoConfig;
use shagreen_learn::photo_set::PhotoSet;
use shagreen_learn::photo_validation::by_class::predictions_of_classes;
use shagreen_learn::photo_validation::{JudgedPhoto, OF_MODEL};

use crate::cli::prediction_figures::FigureArgs;

/// Origin of the actual values of each attribute.
const SOURCES: [&str; 2] =
    ["estimates of the lexicon; nobody rated them", "physical labels of the classes; nobody rated them"];

/// Writes the figures of the model, and the table of all predictors, if they are requested. Each class was left out of the
/// training that predicted it.
pub(crate) fn draw_classes(
    figures: &FigureArgs,
    set: &PhotoSet,
    judged: &[JudgedPhoto],
    config: &PhotoConfig,
) -> anyhow::Result<()> {
    if figures.folder().is_none() {
        return Ok(());
    }
    let of_classes = predictions_of_classes(set, judged, config).into_iter();
    let predictions: Vec<Prediction> = of_classes
        .map(|of| Prediction {
            texture: set.classes[of.class].name.clone(),
            attribute: of.attribute.to_owned(),
            method: of.predictor.to_owned(),
            actual: of.actual,
            predicted: of.predicted,
            deviation: of.deviation,
        })
        .collect();
    let shown = [0, 1].map(|index| PredictionFigure {
        attribute: USUAL_AXES[index],
        method: OF_MODEL,
        of: "material",
        validation: "class left out; mean of its photos",
        source: SOURCES[index],
    });
    figures.draw(&predictions, &shown)
}
