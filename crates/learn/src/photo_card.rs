//! Model card of a model that was trained on labelled photos: its data, settings, errors and limits.

use serde::{Deserialize, Serialize};

use crate::photo_config::PhotoConfig;
use crate::photo_folds::LeftOut;

/// Model card: where a model comes from, how far its predictions hold, and where they do not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoCard {
    /// Number of photos.
    pub n_photos: usize,
    /// Number of classes.
    pub n_classes: usize,
    /// Sources of the photos.
    pub sources: Vec<PhotoSource>,
    /// Rules by which photos of the table were left out.
    pub left_out: Vec<String>,
    /// Origin of the labels.
    pub labels: String,
    /// Training data of the heads for early features.
    pub drawn_materials: String,
    /// Number of random variations of each photo.
    pub n_variations: usize,
    /// Settings of the training.
    pub settings: PhotoConfig,
    /// Errors on photos that were left out of the training.
    pub figures: Vec<LeftOutFigure>,
    /// Known limits.
    pub limits: Vec<String>,
}

/// Source of training photos.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PhotoSource {
    /// Name.
    pub name: String,
    /// Number of photos.
    pub n_photos: usize,
    /// Licenses of the photos.
    pub licenses: Vec<String>,
    /// Authors of the photos.
    pub authors: Vec<String>,
}

/// Errors of one predictor of one attribute on photos that were left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOutFigure {
    /// Name of the attribute.
    pub attribute: String,
    /// What was left out as a whole.
    pub left_out: LeftOut,
    /// Name of the predictor.
    pub predictor: String,
    /// Number of photos.
    pub n: usize,
    /// Correlation of predictions and labels; `None` if either is constant.
    pub r: Option<f64>,
    /// Mean absolute error, in points of 0 to 100.
    pub mae: f64,
    /// Root mean square of error over standard deviation; `None` for predictors without a standard deviation. About one if
    /// the standard deviations hold.
    pub error_over_deviation: Option<f64>,
}

impl PhotoCard {
    /// Returns the lines of the card for people.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("trained on {} photos of {} classes of materials", self.n_photos, self.n_classes),
            format!("labels: {}", self.labels),
            format!("further training data: {}", self.drawn_materials),
            "sources:".to_owned(),
        ];
        lines.extend(self.sources.iter().map(|source| {
            let PhotoSource { name, n_photos, licenses, authors } = source;
            let by = if authors.is_empty() { String::new() } else { format!("; {}", authors.join(", ")) };
            format!("  {name}: {n_photos}; {}{by}", licenses.join(", "))
        }));
        lines.extend(self.left_out.iter().map(|rule| format!("left out: {rule}")));
        lines.push("errors on photos whose whole class or source was left out of the training:".to_owned());
        lines.extend(figure_lines(&self.figures).into_iter().map(|line| format!("  {line}")));
        lines.extend(self.limits.iter().map(|limit| format!("limit: {limit}")));
        lines
    }
}

/// Returns the figures as the lines of a table, its heading first.
pub fn figure_lines(figures: &[LeftOutFigure]) -> Vec<String> {
    let row = |cells: [&str; 7]| {
        let [attribute, left_out, predictor, n, r, mae, ratio] = cells;
        format!("{attribute:<13} {left_out:<9} {predictor:<28} {n:>6} {r:>6} {mae:>6} {ratio:>10}")
    };
    let mut lines = vec![row(["attribute", "left out", "predictor", "photos", "r", "MAE", "error/dev."])];
    lines.extend(figures.iter().map(|figure| {
        let optional = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.2}"));
        row([
            &figure.attribute,
            figure.left_out.noun(),
            &figure.predictor,
            &figure.n.to_string(),
            &optional(figure.r),
            &format!("{:.1}", figure.mae),
            &optional(figure.error_over_deviation),
        ])
    }));
    lines
}

#[cfg(test)]
mod tests {
    use super::{LeftOutFigure, PhotoCard, PhotoSource, figure_lines};
    use crate::photo_config::PhotoConfig;
    use crate::photo_folds::LeftOut;

    #[test]
    fn a_card_names_its_sources_and_says_how_far_it_holds() {
        let figure = LeftOutFigure {
            attribute: "hard-soft".to_owned(),
            left_out: LeftOut::Sources,
            predictor: "all heads".to_owned(),
            n: 40,
            r: Some(0.5),
            mae: 11.04,
            error_over_deviation: None,
        };
        let card = PhotoCard {
            n_photos: 40,
            n_classes: 3,
            sources: vec![PhotoSource {
                name: "mine".to_owned(),
                n_photos: 40,
                licenses: vec!["CC-BY 3.0".to_owned()],
                authors: vec!["A. Author".to_owned()],
            }],
            left_out: vec!["note contains \"unclear\"".to_owned()],
            labels: "physical".to_owned(),
            drawn_materials: "pictures of 8 drawn materials".to_owned(),
            n_variations: 6,
            settings: PhotoConfig::usual(1),
            figures: vec![figure.clone()],
            limits: vec!["meshes".to_owned()],
        };
        let text = card.lines().join("\n");
        for words in
            ["40 photos of 3 classes", "mine: 40; CC-BY 3.0; A. Author", "\"unclear\"", "limit: meshes"]
        {
            assert!(text.contains(words), "{text}");
        }
        let lines = figure_lines(&[figure]);
        assert!(lines[1].starts_with("hard-soft     sources   all heads"), "{lines:?}");
        assert!(lines[1].ends_with("0.50   11.0          -"), "{lines:?}");
        assert_eq!(lines[0].len(), lines[1].len());
        let text = serde_json::to_string(&card).unwrap();
        assert_eq!(serde_json::from_str::<PhotoCard>(&text).unwrap(), card);
    }
}
