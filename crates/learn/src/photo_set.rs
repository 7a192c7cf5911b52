//! Features of labelled photos, kept as a file because their extraction takes most of the time of a training.
//!
//! # File
//!
//! A safetensors file that any program can read, for experiments. All tensors are 32-bit floats; indices begin at 0.
//!
//! | tensor | shape | content |
//! |---|---|---|
//! | `late` | rows × late features | features of one view or variation of a photo |
//! | `rows` | rows × 3 | index of the photo; pass: 0 for the plain photo, then the number of the variation; view: 0 for the whole central square, 1 to 4 for its quarters |
//! | `early` | photos × early features | features of the plain photo |
//! | `photos` | photos × 9 | index of the class, index of the source, hard-soft and its standard deviation, rough-smooth and its standard deviation, RMS detail (0 to 1), sharpness in dB, side of the central square of the file in pixels |
//!
//! The metadata entry `shagreen` is JSON. Its `about` has the names behind the indices: `classes`, `sources`, and `files`
//! with the SHA-256 of each photo. The photos themselves are not in the file.

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};
use shagreen_core::surfaces::picture_doubts::Detail;
use shagreen_core::surfaces::picture_features::N_VIEWS;

use crate::model_file::{self, ModelFileError, Numbers};

/// Kind of the file.
const KIND: &str = "photos that were looked at";
/// Columns of the tensor `rows`.
const N_OF_ROW: usize = 3;
/// Columns of the tensor `photos`.
const N_OF_PHOTO: usize = 9;

/// Features of a photo.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoFeatures {
    /// Early features of the central square.
    pub early: Vec<f32>,
    /// Late features of each of the [`N_VIEWS`] views, then of each variation of a training photo.
    pub late: Vec<Vec<f32>>,
    /// Amount of detail in the central square.
    pub detail: Detail,
    /// Side of the central square of the file, in pixels.
    pub side_px: usize,
}

/// Class of materials with its labels, 0 to 100.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialClass {
    /// Name, such as "carpet".
    pub name: String,
    /// Hardness, 0 (hardest) to 100 (softest): a physical label of the class.
    pub hard_soft: f64,
    /// Standard deviation of the hardness within the class.
    pub hard_soft_sd: f64,
    /// Roughness, 0 (roughest) to 100 (smoothest): an estimate that nobody rated.
    pub rough_smooth: f64,
    /// Standard deviation of the roughness.
    pub rough_smooth_sd: f64,
}

/// Labelled photo and its features.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenPhoto {
    /// Path of the file in its table.
    pub file: String,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Index of its class.
    pub class: usize,
    /// Index of its source.
    pub source: usize,
    /// Features of the views, then of the variations.
    pub features: PhotoFeatures,
}

/// Labelled photos and their features.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoSet {
    /// How the features were made; a set is only continued by the same method.
    pub made_by: String,
    /// Classes of the photos.
    pub classes: Vec<MaterialClass>,
    /// Names of the sources of the photos.
    pub sources: Vec<String>,
    /// The photos; all have the same numbers of features and of variations.
    pub photos: Vec<SeenPhoto>,
}

#[derive(Serialize, Deserialize)]
struct About {
    made_by: String,
    classes: Vec<MaterialClass>,
    sources: Vec<String>,
    files: Vec<KeptFile>,
}

#[derive(Serialize, Deserialize)]
struct KeptFile {
    file: String,
    sha256: String,
}

/// Indices of a row: photo, pass and view.
fn indices(photo: usize, index_in_photo: usize) -> [usize; N_OF_ROW] {
    match index_in_photo.checked_sub(N_VIEWS - 1) {
        None | Some(0) => [photo, 0, index_in_photo],
        Some(variation) => [photo, variation, 0],
    }
}

impl PhotoSet {
    /// Returns the bytes of the set's file.
    ///
    /// # Errors
    /// [`ModelFileError`] if photos differ in their number of features or variations, or a value is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ModelFileError> {
        let n_rows: usize = self.photos.iter().map(|photo| photo.features.late.len()).sum();
        let late = || self.photos.iter().flat_map(|photo| &photo.features.late);
        let n_late = late().next().map_or(0, Vec::len);
        let n_early = self.photos.first().map_or(0, |photo| photo.features.early.len());
        let mut rows = Vec::with_capacity(N_OF_ROW * n_rows);
        let mut photos = Vec::with_capacity(N_OF_PHOTO * self.photos.len());
        for (index, photo) in self.photos.iter().enumerate() {
            for row in 0..photo.features.late.len() {
                rows.extend(indices(index, row).map(|index| index as f32));
            }
            let Some(of) = self.classes.get(photo.class) else {
                return Err(shape_error(format!("photo {index} has no class")));
            };
            let labels = [of.hard_soft, of.hard_soft_sd, of.rough_smooth, of.rough_smooth_sd];
            let Detail { rms, sharpness_db } = photo.features.detail;
            photos.extend([photo.class as f32, photo.source as f32]);
            photos.extend(labels.iter().chain(&[rms, sharpness_db]).map(|value| *value as f32));
            photos.push(photo.features.side_px as f32);
        }
        let early: Vec<f32> = self.photos.iter().flat_map(|photo| &photo.features.early).copied().collect();
        let late: Vec<f32> = late().flatten().copied().collect();
        let n_photos = self.photos.len();
        let tensor = |values: Vec<f32>, shape: (usize, usize)| Tensor::from_vec(values, shape, &Device::Cpu);
        let numbers = Numbers::from([
            ("late".to_owned(), tensor(late, (n_rows, n_late))?),
            ("rows".to_owned(), tensor(rows, (n_rows, N_OF_ROW))?),
            ("early".to_owned(), tensor(early, (n_photos, n_early))?),
            ("photos".to_owned(), tensor(photos, (n_photos, N_OF_PHOTO))?),
        ]);
        let kept = |photo: &SeenPhoto| KeptFile { file: photo.file.clone(), sha256: photo.sha256.clone() };
        let about = About {
            made_by: self.made_by.clone(),
            classes: self.classes.clone(),
            sources: self.sources.clone(),
            files: self.photos.iter().map(kept).collect(),
        };
        model_file::write(KIND, &about, &numbers)
    }

    /// Returns the set of a file.
    ///
    /// # Errors
    /// [`ModelFileError`] if the file is damaged or of another kind.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ModelFileError> {
        let (about, numbers) = model_file::read::<About>(KIND, bytes, &Device::Cpu)?;
        let rows_of = |name: &str| match numbers.get(name) {
            Some(tensor) => tensor.to_vec2::<f32>(),
            None => candle_core::bail!("tensor \"{name}\" is missing"),
        };
        let (late, rows) = (rows_of("late")?, rows_of("rows")?);
        let (early, photos) = (rows_of("early")?, rows_of("photos")?);
        let n_photos = about.files.len();
        let n_each = late.len().checked_div(n_photos).unwrap_or(0);
        if [early.len(), photos.len()] != [n_photos; 2]
            || [late.len(), rows.len()] != [n_each * n_photos; 2]
            || (n_photos > 0 && n_each < N_VIEWS)
        {
            let what = format!("{n_photos} photos do not have {} rows of features", late.len());
            return Err(shape_error(what));
        }
        let is_row = |(index, row): (usize, &Vec<f32>)| {
            row[..] == indices(index / n_each, index % n_each).map(|index| index as f32)
        };
        if !rows.iter().enumerate().all(is_row) {
            return Err(shape_error("the rows of features are in another order".to_owned()));
        }
        let mut late = late.into_iter();
        let mut seen = Vec::with_capacity(n_photos);
        for ((kept, early), photo) in about.files.into_iter().zip(early).zip(photos) {
            let [class, source, .., rms, sharpness_db, side_px] = photo[..] else {
                return Err(shape_error("a photo has no class".to_owned()));
            };
            let (class, source) = (class as usize, source as usize);
            if class >= about.classes.len() || source >= about.sources.len() {
                return Err(shape_error(format!("\"{}\" has no class or no source", kept.file)));
            }
            let detail = Detail { rms: f64::from(rms), sharpness_db: f64::from(sharpness_db) };
            let late = late.by_ref().take(n_each).collect();
            let features = PhotoFeatures { early, late, detail, side_px: side_px as usize };
            seen.push(SeenPhoto { file: kept.file, sha256: kept.sha256, class, source, features });
        }
        Ok(Self { made_by: about.made_by, classes: about.classes, sources: about.sources, photos: seen })
    }
}

fn shape_error(what: String) -> ModelFileError {
    ModelFileError::Shape(candle_core::Error::Msg(what))
}

/// Made-up photos for tests.
#[cfg(test)]
pub(crate) mod made_up;

#[cfg(test)]
mod tests {
    use super::{MaterialClass, N_VIEWS, PhotoFeatures, PhotoSet, SeenPhoto, indices};
    use shagreen_core::surfaces::picture_doubts::Detail;

    fn set() -> PhotoSet {
        let class = |name: &str, hard_soft: f64| MaterialClass {
            name: name.to_owned(),
            hard_soft,
            hard_soft_sd: 8.0,
            rough_smooth: 30.5,
            rough_smooth_sd: 11.0,
        };
        let photo = |n: usize| SeenPhoto {
            file: format!("{n}.jpg"),
            sha256: format!("{n:064}"),
            class: n % 2,
            source: n / 2,
            features: PhotoFeatures {
                early: vec![n as f32; 2],
                late: (0..N_VIEWS + 2).map(|row| vec![n as f32, row as f32, 0.5]).collect(),
                detail: Detail { rms: 0.25, sharpness_db: -3.5 },
                side_px: 128 + n,
            },
        };
        PhotoSet {
            made_by: "seed 1".to_owned(),
            classes: vec![class("brick", 9.0), class("carpet", 85.0)],
            sources: vec!["mine".to_owned(), "theirs".to_owned()],
            photos: (0..3).map(photo).collect(),
        }
    }

    #[test]
    fn rows_are_the_views_and_then_the_variations() {
        let rows: Vec<[usize; 3]> = (0..N_VIEWS + 2).map(|row| indices(7, row)).collect();
        assert_eq!(rows[..2], [[7, 0, 0], [7, 0, 1]]);
        assert_eq!(rows[N_VIEWS - 1..], [[7, 0, 4], [7, 1, 0], [7, 2, 0]]);
    }

    #[test]
    fn a_set_comes_back_and_damage_is_found() {
        let set = set();
        let mut bytes = set.to_bytes().unwrap();
        assert_eq!(PhotoSet::from_bytes(&bytes).unwrap(), set);
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        assert!(PhotoSet::from_bytes(&bytes).is_err());
        let none = PhotoSet { photos: Vec::new(), ..set.clone() };
        assert_eq!(PhotoSet::from_bytes(&none.to_bytes().unwrap()).unwrap(), none);
        let mut uneven = set.clone();
        uneven.photos[1].features.late[3].pop();
        assert!(uneven.to_bytes().is_err());
        let mut without = set.clone();
        without.classes.pop();
        assert!(without.to_bytes().is_err());
        let mut few = set.clone();
        few.photos.iter_mut().for_each(|photo| photo.features.late.truncate(2));
        assert!(PhotoSet::from_bytes(&few.to_bytes().unwrap()).is_err());
        let mut unequal = set;
        unequal.photos[2].features.late.pop();
        assert!(PhotoSet::from_bytes(&unequal.to_bytes().unwrap()).is_err());
    }
}
