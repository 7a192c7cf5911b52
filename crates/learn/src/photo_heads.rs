//! Heads on late features of photos: class probabilities, a ridge regression, a kernel regression and small networks that
//! predict the hardness, and the distance from the training photos.
//!
//! All heads see the same scaled features of one view. A prediction is made for each view of a photo.

mod rows;
mod small_network;

use candle_core::{Device, Tensor};
use ndarray::{Array2, aview1};
use serde::{Deserialize, Serialize};
use shagreen_core::maths::class_distance::{ClassDistance, ClassDistanceError};
use shagreen_core::maths::kernel_ridge::{KernelRidge, KernelRidgeError};
use shagreen_core::maths::minimize::Stop;
use shagreen_core::maths::multinomial::{Examples, MultinomialError, MultinomialLogistic};
use shagreen_core::maths::ridge::{Ridge, RidgeError, ridge};
use shagreen_core::maths::rng::derive_seed;

use self::rows::Rows;
use crate::dense_stack;
use crate::feature_scale::FeatureScale;
use crate::model_file::{ModelFileError, Numbers};
use crate::parameters::Parameters;
use crate::photo_config::PhotoConfig;
use crate::photo_set::PhotoSet;

pub(crate) use self::rows::class_weights;

/// When the search for the class probabilities ends: their loss is then within 1e-4 of its minimum.
const STOP: Stop = Stop { slope: 1e-4, n_steps: 300 };
/// Weight of the identity in the covariance of the distance.
const SHRINKAGE: f64 = 0.1;
/// Largest numbers of features and of classes in a file.
const MOST_NUMBERS: usize = 1 << 14;
/// Largest number of photos behind a kernel regression in a file.
const MOST_EXAMPLES: usize = 1 << 20;

/// Reasons why heads cannot be trained, read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PhotoHeadsError {
    /// The settings are impossible.
    #[error("the settings of the heads are invalid; check penalties, weights and sizes")]
    Settings,
    /// There are too few classes or photos.
    #[error(
        "training needs photos of at least two classes, got {n_photos} photos of {n_classes}; add photos"
    )]
    TooFew {
        /// Number of photos.
        n_photos: usize,
        /// Number of their classes.
        n_classes: usize,
    },
    /// A photo has another number of features, or a feature that is not finite.
    #[error("photo {index} (from 0) has other features than the model needs; extract its features again")]
    Features {
        /// Index of the photo or view.
        index: usize,
    },
    /// The ridge regression failed.
    #[error(transparent)]
    Ridge(#[from] RidgeError),
    /// The kernel regression failed.
    #[error(transparent)]
    Kernel(#[from] KernelRidgeError),
    /// The class probabilities failed.
    #[error(transparent)]
    Classes(#[from] MultinomialError),
    /// The distance failed.
    #[error(transparent)]
    Distance(#[from] ClassDistanceError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// A tensor operation failed.
    #[error("the heads could not be evaluated: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// Trained heads.
#[derive(Clone, Debug)]
pub(crate) struct PhotoHeads {
    scale: FeatureScale,
    ridge: Option<Ridge>,
    kernel: Option<KernelRidge>,
    classes: MultinomialLogistic,
    /// Class of the set behind each class of `classes`.
    present: Vec<usize>,
    n_classes: usize,
    networks: Vec<Parameters>,
    distance: ClassDistance,
    device: Device,
}

/// Heads of a model besides the class probabilities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HeadParts {
    pub(crate) has_ridge: bool,
    pub(crate) kernel: Option<KernelSize>,
    pub(crate) n_networks: usize,
}

/// Size of a kernel regression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct KernelSize {
    pub(crate) n_examples: usize,
    pub(crate) n_components: usize,
}

impl KernelSize {
    fn of(centers: &Array2<f64>) -> Self {
        Self { n_examples: centers.nrows(), n_components: centers.ncols() }
    }

    fn is_possible(self) -> bool {
        (1..=MOST_EXAMPLES).contains(&self.n_examples) && (1..=MOST_NUMBERS).contains(&self.n_components)
    }
}

/// Predictions of the heads for one photo; vectors over views.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HeadOutputs {
    /// Hardness by the ridge regression; `None` if it was not trained.
    pub(crate) ridge: Option<Vec<f64>>,
    /// Hardness by the kernel regression; `None` if it was not trained.
    pub(crate) kernel: Option<Vec<f64>>,
    /// Hardness by each small network.
    pub(crate) networks: Vec<Vec<f64>>,
    /// Probability of each class of the set.
    pub(crate) probabilities: Vec<Vec<f64>>,
    /// Distance from the nearest class.
    pub(crate) distances: Vec<f64>,
}

impl PhotoHeads {
    /// Trains the heads on some photos of a set, by index.
    ///
    /// # Errors
    /// See [`PhotoHeadsError`].
    pub(crate) fn learn(
        set: &PhotoSet,
        photos: &[usize],
        config: &PhotoConfig,
    ) -> Result<Self, PhotoHeadsError> {
        if !config.is_sound() {
            return Err(PhotoHeadsError::Settings);
        }
        check(set, photos)?;
        let device = crate::device::best();
        let rows = Rows::of(set, photos, config.class_exponent);
        let n_present = rows.present.len();
        if n_present < 2 {
            return Err(PhotoHeadsError::TooFew { n_photos: photos.len(), n_classes: n_present });
        }
        let total: f64 = rows.weights.iter().sum();
        let ridge = (config.hardness.ridge > 0.0)
            .then(|| ridge(&rows.features, &rows.hard_soft, &rows.weights, config.ridge_penalty * total))
            .transpose()?;
        let kernel = (config.hardness.kernel > 0.0)
            .then(|| {
                let of_photos = rows.photos(set, photos);
                let (labels, weights) = (&of_photos.hard_soft, &of_photos.weights);
                let examples = (&of_photos.features, &labels[..], &weights[..]);
                KernelRidge::learn((&rows.features, &rows.weights), examples, config.kernel.into())
            })
            .transpose()?;
        let examples = Examples { rows: &rows.features, classes: &rows.classes, weights: &rows.weights };
        let classes = MultinomialLogistic::learn(examples, n_present, config.class_penalty, STOP)?;
        let distance =
            ClassDistance::learn(&rows.features, &rows.classes, &rows.weights, n_present, SHRINKAGE)?;
        let n_networks = if config.hardness.network > 0.0 { config.network.n_networks } else { 0 };
        let network = |index: usize| {
            let seed = derive_seed(config.seed, &format!("network {index}"));
            small_network::learn(&rows, &config.network, seed, &device)
        };
        let networks = (0..n_networks).map(network).collect::<Result<Vec<Parameters>, _>>()?;
        Ok(Self {
            scale: rows.scale,
            ridge: ridge.map(|of| Ridge {
                coefficients: rounded(of.coefficients),
                intercept: f64::from(of.intercept as f32),
            }),
            kernel: kernel.map(|of| KernelRidge {
                means: rounded(of.means),
                directions: of.directions.mapv(|x| f64::from(x as f32)),
                centers: of.centers.mapv(|x| f64::from(x as f32)),
                coefficients: rounded(of.coefficients),
                intercept: f64::from(of.intercept as f32),
                decay: f64::from(of.decay as f32),
            }),
            classes: MultinomialLogistic {
                coefficients: classes.coefficients.mapv(|x| f64::from(x as f32)),
                intercepts: rounded(classes.intercepts),
            },
            present: rows.present,
            n_classes: set.classes.len(),
            networks,
            distance: ClassDistance {
                whitening: distance.whitening.mapv(|x| f64::from(x as f32)),
                centers: distance.centers.mapv(|x| f64::from(x as f32)),
            },
            device,
        })
    }

    /// Returns the predictions for the views of a photo, at least one.
    ///
    /// # Errors
    /// [`PhotoHeadsError::Features`] if a view has another number of features or one that is not finite.
    pub(crate) fn look(&self, views: &[Vec<f32>]) -> Result<HeadOutputs, PhotoHeadsError> {
        let n_features = self.scale.n_features();
        let is_wrong = |view: &Vec<f32>| view.len() != n_features || view.iter().any(|x| !x.is_finite());
        if views.is_empty() {
            return Err(PhotoHeadsError::Features { index: 0 });
        }
        if let Some(index) = views.iter().position(is_wrong) {
            return Err(PhotoHeadsError::Features { index });
        }
        let scaled: Vec<Vec<f32>> = views.iter().map(|view| self.scale.apply(view)).collect();
        let exact: Vec<Vec<f64>> =
            scaled.iter().map(|view| view.iter().map(|x| f64::from(*x)).collect()).collect();
        let probabilities = |view: &Vec<f64>| {
            let mut of_all = vec![0.0; self.n_classes];
            for (class, probability) in self.present.iter().zip(self.classes.probabilities(view)) {
                of_all[*class] = probability;
            }
            of_all
        };
        let networks = self.networks.iter().map(|of| small_network::predict(of, &scaled, &self.device));
        Ok(HeadOutputs {
            ridge: self.ridge.as_ref().map(|ridge| exact.iter().map(|view| ridge.at(view)).collect()),
            kernel: self.kernel.as_ref().map(|kernel| exact.iter().map(|view| kernel.at(view)).collect()),
            networks: networks.collect::<Result<_, _>>()?,
            probabilities: exact.iter().map(probabilities).collect(),
            distances: exact.iter().map(|view| self.distance.at(view)).collect(),
        })
    }

    /// Returns the number of features of a view.
    pub(crate) fn n_features(&self) -> usize {
        self.scale.n_features()
    }

    /// Returns which heads there are besides the class probabilities.
    pub(crate) fn parts(&self) -> HeadParts {
        HeadParts {
            has_ridge: self.ridge.is_some(),
            kernel: self.kernel.as_ref().map(|kernel| KernelSize::of(&kernel.centers)),
            n_networks: self.networks.len(),
        }
    }

    /// Adds the weights to the tensors of a file, with names that begin with `prefix`.
    pub(crate) fn add_to(&self, numbers: &mut Numbers, prefix: &str) -> Result<(), candle_core::Error> {
        self.scale.add_to(numbers, prefix)?;
        let mut add = |name: &str, values: &Array2<f64>| {
            let flat: Vec<f32> = values.iter().map(|x| *x as f32).collect();
            let tensor = Tensor::from_vec(flat, values.dim(), &Device::Cpu)?;
            numbers.insert(format!("{prefix}{name}"), tensor);
            Ok::<(), candle_core::Error>(())
        };
        if let Some(Ridge { coefficients, intercept }) = &self.ridge {
            add("ridge.weight", &as_row(coefficients))?;
            add("ridge.bias", &as_row(&[*intercept]))?;
        }
        if let Some(KernelRidge { means, directions, centers, coefficients, intercept, decay }) = &self.kernel
        {
            add("kernel.means", &as_row(means))?;
            add("kernel.directions", directions)?;
            add("kernel.centers", centers)?;
            add("kernel.coefficients", &as_row(coefficients))?;
            add("kernel.intercept", &as_row(&[*intercept]))?;
            add("kernel.decay", &as_row(&[*decay]))?;
        }
        add("classes.weight", &self.classes.coefficients)?;
        add("classes.bias", &as_row(&self.classes.intercepts))?;
        add("distance.whitening", &self.distance.whitening)?;
        add("distance.centers", &self.distance.centers)?;
        for (index, network) in self.networks.iter().enumerate() {
            dense_stack::add_to(network, numbers, &format!("{prefix}network{index}."))?;
        }
        Ok(())
    }

    /// Reads what [`PhotoHeads::add_to`] wrote for heads trained on all classes. `parts` are those of
    /// [`PhotoHeads::parts`].
    ///
    /// # Errors
    /// [`PhotoHeadsError::File`] if a tensor is missing or has another shape, [`PhotoHeadsError::Settings`] for impossible
    /// sizes.
    pub(crate) fn read(
        numbers: &Numbers,
        prefix: &str,
        config: &PhotoConfig,
        [n_features, n_classes]: [usize; 2],
        HeadParts { has_ridge, kernel, n_networks }: HeadParts,
    ) -> Result<Self, PhotoHeadsError> {
        let is_possible = config.is_sound()
            && (1..=MOST_NUMBERS).contains(&n_features)
            && (2..=MOST_NUMBERS).contains(&n_classes)
            && n_networks <= config.network.n_networks
            && kernel.is_none_or(KernelSize::is_possible);
        if !is_possible {
            return Err(PhotoHeadsError::Settings);
        }
        let device = crate::device::best();
        let matrix = |name: &str, shape: [usize; 2]| -> Result<Array2<f64>, ModelFileError> {
            let name = format!("{prefix}{name}");
            let wrong = || {
                let what = format!("tensor \"{name}\" does not have the shape {shape:?}");
                ModelFileError::Shape(candle_core::Error::Msg(what))
            };
            let tensor = numbers.get(&name).filter(|tensor| tensor.dims() == shape).ok_or_else(wrong)?;
            let values: Vec<f32> = tensor.flatten_all()?.to_vec1()?;
            Array2::from_shape_vec(shape, values.into_iter().map(f64::from).collect()).map_err(|_| wrong())
        };
        let row = |name: &str, n: usize| -> Result<Vec<f64>, ModelFileError> {
            Ok(matrix(name, [1, n])?.into_iter().collect())
        };
        let ridge = if has_ridge {
            let intercept = row("ridge.bias", 1)?.into_iter().sum();
            Some(Ridge { coefficients: row("ridge.weight", n_features)?, intercept })
        } else {
            None
        };
        let one = |name: &str| row(name, 1).map(|values| values.into_iter().sum::<f64>());
        let kernel = match kernel {
            Some(KernelSize { n_examples, n_components }) => Some(KernelRidge {
                means: row("kernel.means", n_features)?,
                directions: matrix("kernel.directions", [n_components, n_features])?,
                centers: matrix("kernel.centers", [n_examples, n_components])?,
                coefficients: row("kernel.coefficients", n_examples)?,
                intercept: one("kernel.intercept")?,
                decay: one("kernel.decay")?,
            }),
            None => None,
        };
        let sizes = small_network::sizes(n_features, &config.network);
        let network =
            |index| dense_stack::read(numbers, &format!("{prefix}network{index}."), &sizes, &device);
        Ok(Self {
            scale: FeatureScale::read(numbers, prefix, n_features).map_err(ModelFileError::Shape)?,
            ridge,
            kernel,
            classes: MultinomialLogistic {
                coefficients: matrix("classes.weight", [n_classes, n_features])?,
                intercepts: row("classes.bias", n_classes)?,
            },
            present: (0..n_classes).collect(),
            n_classes,
            networks: (0..n_networks).map(network).collect::<Result<_, _>>()?,
            distance: ClassDistance {
                whitening: matrix("distance.whitening", [n_features; 2])?,
                centers: matrix("distance.centers", [n_classes, n_features])?,
            },
            device,
        })
    }
}

/// Rounds to the precision of files, so that a model that is read predicts the same as the trained one.
fn rounded(values: Vec<f64>) -> Vec<f64> {
    values.into_iter().map(|x| f64::from(x as f32)).collect()
}

fn as_row(values: &[f64]) -> Array2<f64> {
    aview1(values).to_owned().insert_axis(ndarray::Axis(0))
}

/// Checks that all photos have the same finite features, and classes that exist.
fn check(set: &PhotoSet, photos: &[usize]) -> Result<(), PhotoHeadsError> {
    let mut all = photos.iter().map(|index| (*index, set.photos.get(*index)));
    let first = photos.first().and_then(|index| set.photos.get(*index));
    let Some(n_features) = first.and_then(|photo| photo.features.late.first()).map(Vec::len) else {
        return Err(PhotoHeadsError::TooFew { n_photos: photos.len(), n_classes: 0 });
    };
    let is_sound = |late: &Vec<f32>| late.len() == n_features && late.iter().all(|x| x.is_finite());
    let is_wrong = all.find(|(_, photo)| {
        photo.is_none_or(|photo| {
            photo.features.late.is_empty()
                || !photo.features.late.iter().all(is_sound)
                || photo.class >= set.classes.len()
        })
    });
    is_wrong.map_or(Ok(()), |(index, _)| Err(PhotoHeadsError::Features { index }))
}

#[cfg(test)]
mod tests;
