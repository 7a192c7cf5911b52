//! Cached training set of picture features and labels, kept as a file because feature extraction takes most of the
//! time.

use candle_core::{Device, Tensor};
use serde::{Deserialize, Serialize};

use crate::model_file::{self, ModelFileError, Numbers};

/// Kind of the file.
const KIND: &str = "pictures that were looked at";

/// Features and labels of one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Features; all pictures have the same number.
    pub features: Vec<f32>,
    /// Labels of the picture.
    pub labels: Vec<f64>,
}

/// Features and labels of a series of drawn pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureSet {
    /// How the pictures were drawn and which extractor made the features; a set is only continued by the same method.
    pub made_by: String,
    /// Pictures in order of their numbers.
    pub pictures: Vec<Seen>,
}

#[derive(Serialize, Deserialize)]
struct About {
    made_by: String,
}

impl PictureSet {
    /// Returns the bytes of the set's file.
    ///
    /// # Errors
    /// [`ModelFileError`] if pictures differ in their number of features or labels, or a value is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ModelFileError> {
        let rows = |of: &dyn Fn(&Seen) -> Vec<f32>| -> Result<Tensor, candle_core::Error> {
            let rows: Vec<Vec<f32>> = self.pictures.iter().map(of).collect();
            let n_columns = rows.first().map_or(0, Vec::len);
            Tensor::from_vec(rows.concat(), (rows.len(), n_columns), &Device::Cpu)
        };
        let singles = |seen: &Seen| seen.labels.iter().map(|label| *label as f32).collect();
        let numbers = Numbers::from([
            ("features".to_owned(), rows(&|seen| seen.features.clone())?),
            ("labels".to_owned(), rows(&singles)?),
        ]);
        model_file::write(KIND, &About { made_by: self.made_by.clone() }, &numbers)
    }

    /// Returns the set of a file.
    ///
    /// # Errors
    /// [`ModelFileError`] if the file is damaged or of another kind.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ModelFileError> {
        let (About { made_by }, numbers) = model_file::read(KIND, bytes, &Device::Cpu)?;
        let rows = |name: &str| match numbers.get(name) {
            Some(tensor) => tensor.to_vec2::<f32>(),
            None => candle_core::bail!("tensor \"{name}\" is missing"),
        };
        let (features, labels) = (rows("features")?, rows("labels")?);
        if features.len() != labels.len() {
            return Err(ModelFileError::Shape(candle_core::Error::Msg(format!(
                "{} rows of features, but {} rows of labels",
                features.len(),
                labels.len()
            ))));
        }
        let seen = |(features, labels): (Vec<f32>, Vec<f32>)| Seen {
            features,
            labels: labels.into_iter().map(f64::from).collect(),
        };
        Ok(Self { made_by, pictures: features.into_iter().zip(labels).map(seen).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::{PictureSet, Seen};

    #[test]
    fn a_set_comes_back_and_damage_is_found() {
        let seen = |x: f32| Seen { features: vec![x, 2.0, -0.5], labels: vec![0.25, f64::from(x)] };
        let set = PictureSet { made_by: "seed 1".to_owned(), pictures: vec![seen(1.0), seen(3.5)] };
        let mut bytes = set.to_bytes().unwrap();
        assert_eq!(PictureSet::from_bytes(&bytes).unwrap(), set);
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        assert!(PictureSet::from_bytes(&bytes).is_err());
        let none = PictureSet { made_by: String::new(), pictures: Vec::new() };
        assert_eq!(PictureSet::from_bytes(&none.to_bytes().unwrap()).unwrap(), none);
        let uneven =
            PictureSet { pictures: vec![seen(1.0), Seen { features: vec![1.0], ..seen(2.0) }], ..set };
        assert!(uneven.to_bytes().is_err());
    }
}
