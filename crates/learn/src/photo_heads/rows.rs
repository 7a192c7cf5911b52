//! Training rows: the plain view and the variations of labelled photos, scaled and weighted.

use ndarray::Array2;
use shagreen_core::surfaces::picture_features::N_VIEWS;

use crate::feature_scale::FeatureScale;
use crate::photo_set::{PhotoSet, SeenPhoto};

/// Training rows of some photos of a set.
pub(super) struct Rows {
    pub(super) scale: FeatureScale,
    /// Rows × features, scaled.
    pub(super) features: Array2<f64>,
    /// Index of the class of each row in `present`.
    pub(super) classes: Vec<usize>,
    /// Hardness of each row, 0 to 100.
    pub(super) hard_soft: Vec<f64>,
    /// Weight of each row, 1 on average.
    pub(super) weights: Vec<f64>,
    /// Classes of the set that have a row, in ascending order.
    pub(super) present: Vec<usize>,
    /// Exponent on the number of photos of a class that weights its photos.
    class_exponent: f64,
}

/// One row for each photo: the mean of its views, which is steadier than a single one.
pub(super) struct MeanRows {
    /// Photos × features, scaled.
    pub(super) features: Array2<f64>,
    /// Hardness of each photo, 0 to 100.
    pub(super) hard_soft: Vec<f64>,
    /// Weight of each photo.
    pub(super) weights: Vec<f64>,
}

impl Rows {
    /// Returns the rows of these photos, by index. Each photo counts as the size of its class among them to the power of
    /// `class_exponent`.
    pub(super) fn of(set: &PhotoSet, photos: &[usize], class_exponent: f64) -> Self {
        let photos: Vec<&SeenPhoto> = photos.iter().map(|index| &set.photos[*index]).collect();
        let of_photo =
            class_weights(photos.iter().map(|photo| photo.class), set.classes.len(), class_exponent);
        let mut present: Vec<usize> = photos.iter().map(|photo| photo.class).collect();
        present.sort_unstable();
        present.dedup();
        let (mut rows, mut classes, mut hard_soft, mut weights) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (photo, weight) in photos.iter().zip(&of_photo) {
            // The quarters only serve predictions: a variation is a crop already.
            let late = &photo.features.late;
            for row in late.iter().take(1).chain(late.iter().skip(N_VIEWS)) {
                rows.push(&row[..]);
                classes.push(present.partition_point(|class| *class < photo.class));
                hard_soft.push(set.classes[photo.class].hard_soft);
                weights.push(*weight);
            }
        }
        let mean = weights.iter().sum::<f64>() / weights.len().max(1) as f64;
        for weight in &mut weights {
            *weight /= mean;
        }
        let scale = FeatureScale::of(&rows);
        let mut features = Array2::zeros((rows.len(), scale.n_features()));
        for (row, mut to) in rows.iter().zip(features.rows_mut()) {
            for (to, x) in to.iter_mut().zip(scale.apply(row)) {
                *to = f64::from(x);
            }
        }
        Self { scale, features, classes, hard_soft, weights, present, class_exponent }
    }

    /// Returns the means of the views of these photos, by index, in the scale of the rows.
    pub(super) fn photos(&self, set: &PhotoSet, photos: &[usize]) -> MeanRows {
        let photos: Vec<&SeenPhoto> = photos.iter().map(|index| &set.photos[*index]).collect();
        let mut features = Array2::zeros((photos.len(), self.scale.n_features()));
        for (photo, mut to) in photos.iter().zip(features.rows_mut()) {
            let views = photo.features.late.iter().take(N_VIEWS);
            let share = 1.0 / views.len().max(1) as f64;
            for view in views {
                for (to, x) in to.iter_mut().zip(self.scale.apply(view)) {
                    *to += share * f64::from(x);
                }
            }
        }
        MeanRows {
            features,
            hard_soft: photos.iter().map(|photo| set.classes[photo.class].hard_soft).collect(),
            weights: class_weights(
                photos.iter().map(|photo| photo.class),
                set.classes.len(),
                self.class_exponent,
            ),
        }
    }
}

/// Returns the weight of each photo of these classes: the number of photos of its class to the power of `exponent`.
pub(crate) fn class_weights(
    classes: impl Iterator<Item = usize> + Clone,
    n_classes: usize,
    exponent: f64,
) -> Vec<f64> {
    let mut counts = vec![0_usize; n_classes];
    for class in classes.clone() {
        counts[class] += 1;
    }
    classes.map(|class| (counts[class] as f64).powf(exponent)).collect()
}
