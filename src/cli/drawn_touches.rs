//! Prediction of hard-soft for drawn materials that are touched with drawn tools, with and without tap transients.

use anyhow::Context as _;
use serde_json::{Map, Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::LabelSource;
use shagreen_core::space::attribute_predictor::{Known, leave_one_out, quantities};
use shagreen_core::surfaces::random_touch::random_touch;
use shagreen_core::texture::TextureModel;
use shagreen_core::words::counted;
use shagreen_studio::parallel::in_parallel;

use crate::cli::method_predictions::{Comparison, MethodPredictions};
use crate::cli::progress::Progress;

/// Where the labels come from, which limits what the errors say.
const NOTE: &str =
    "the labels and the tap transients of drawn materials are computed from the same contact stiffness";

/// Leave-one-out predictions of hard-soft over drawn materials.
pub(crate) struct DrawnTouches {
    seed: u64,
    /// Name of the only attribute.
    names: [String; 1],
    /// Hard-soft of each material, 0 for the hardest and 100 for the softest.
    values: Vec<Vec<f64>>,
    all: Vec<MethodPredictions>,
}

/// Strokes and taps `n` drawn materials, each with another tool, and predicts hard-soft of each from the others.
///
/// # Errors
/// A material gives no texture, or the textures do not suffice for a prediction.
pub(crate) fn drawn_touches(n: usize, seed: u64) -> anyhow::Result<DrawnTouches> {
    let progress = Progress::new("stroking drawn materials with drawn tools", n);
    let touched = in_parallel(n, |index| {
        let touch = random_touch(seed, index as u64);
        let texture = touch.texture(seed).with_context(|| format!("{} has no texture", touch.material.name));
        progress.step();
        texture.map(|texture| (texture, touch.hardness_log10_n_per_m()))
    });
    progress.finish();
    let touched = touched.into_iter().collect::<anyhow::Result<Vec<(TextureModel, f64)>>>()?;
    let softest = touched.iter().map(|(_, hardness)| *hardness).fold(f64::INFINITY, f64::min);
    let hardest = touched.iter().map(|(_, hardness)| *hardness).fold(f64::NEG_INFINITY, f64::max);
    let hard_soft = |hardness: f64| 100.0 * (hardest - hardness) / (hardest - softest);
    let values: Vec<Vec<f64>> = touched.iter().map(|(_, hardness)| vec![hard_soft(*hardness)]).collect();
    let predicted = |name: &str, of: &dyn Fn(&TextureModel) -> TextureModel| {
        let known: Vec<Known> = touched
            .iter()
            .zip(&values)
            .map(|((texture, _), values)| Known {
                quantities: quantities(&of(texture)),
                attributes: values.clone(),
            })
            .collect();
        let estimates = leave_one_out(&known)?;
        let means = |of: &Vec<Estimate>| of.iter().map(|estimate| estimate.mean).collect::<Vec<f64>>();
        let predicted = estimates.iter().map(means).collect();
        anyhow::Ok(MethodPredictions { name: name.to_owned(), predicted })
    };
    let all = vec![
        predicted("with tap transients", &TextureModel::clone)?,
        predicted("without tap transients", &|texture| texture.clone().with_tap(None))?,
        MethodPredictions::mean_of_others(&values),
    ];
    Ok(DrawnTouches { seed, names: ["hard-soft".to_owned()], values, all })
}

impl DrawnTouches {
    fn comparison(&self) -> Comparison<'_> {
        Comparison::new(&self.all, &self.names, &self.values)
    }

    /// Returns the fields of the JSON result.
    pub(crate) fn as_json(&self) -> Map<String, Value> {
        let mut result = self.comparison().as_json();
        let more = json!({
            "materials": self.values.len(),
            "seed": self.seed,
            "label_source": LabelSource::PhysicalLabels.id(),
            "note": NOTE,
        });
        result.extend(more.as_object().cloned().unwrap_or_default());
        result
    }

    /// Returns the tables of errors with their source.
    pub(crate) fn text(&self) -> String {
        format!(
            "Leave-one-out errors over {}, each touched with another tool; {NOTE}.\n\n{}",
            counted(self.values.len(), "drawn material"),
            self.comparison().text()
        )
    }
}
