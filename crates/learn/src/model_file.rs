//! Model files: safetensors with a Shagreen header that describes the model.
//!
//! No other format is read, in particular none that can contain code, such as pickle.

use std::collections::{BTreeMap, HashMap};

use candle_core::{Device, Tensor};
use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// Metadata key of the header.
const KEY: &str = "shagreen";
/// Format name in the header.
const FORMAT: &str = "shagreen-model";
/// Version that is written; newer versions are rejected.
const VERSION: u32 = 1;

/// Reasons why a file is not a usable model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelFileError {
    /// The file is damaged or not safetensors.
    #[error("it is not a safetensors file, or it is damaged; choose another file, or get this one again")]
    Tensors(safetensors::SafeTensorError),
    /// The file has no Shagreen header.
    #[error("it was not written by Shagreen; train a model with `shagreen train`")]
    Foreign,
    /// The header is invalid.
    #[error("its description of the model is damaged; get the file again")]
    Header(serde_json::Error),
    /// The version is newer than this program.
    #[error("it has version {version}, this program reads up to {VERSION}; use a newer version of Shagreen")]
    Version {
        /// Version of the file.
        version: u32,
    },
    /// The file holds another kind of model.
    #[error("its kind is \"{found}\", needs \"{expected}\"; choose another file")]
    Kind {
        /// Kind of the file.
        found: String,
        /// Required kind.
        expected: &'static str,
    },
    /// The weights do not match their hash.
    #[error("its weights were changed or cut since it was written; get the file again")]
    Hash,
    /// A weight is not finite.
    #[error("its weights \"{name}\" are not finite; train again with another seed, in another folder")]
    NotFinite {
        /// Name of the tensor.
        name: String,
    },
    /// The tensors do not match the header.
    #[error("its weights do not fit the model that it describes; get the file again, or train a new model")]
    Shape(candle_core::Error),
}

/// The readers' words are not causes to show: they describe bytes and types of the format.
impl From<safetensors::SafeTensorError> for ModelFileError {
    fn from(error: safetensors::SafeTensorError) -> Self {
        Self::Tensors(error)
    }
}

impl From<serde_json::Error> for ModelFileError {
    fn from(error: serde_json::Error) -> Self {
        Self::Header(error)
    }
}

impl From<candle_core::Error> for ModelFileError {
    fn from(error: candle_core::Error) -> Self {
        Self::Shape(error)
    }
}

#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    version: u32,
    kind: String,
    /// Hash of all tensors, in the order of their names.
    sha256: String,
    about: serde_json::Value,
}

/// Tensors by name.
pub(crate) type Numbers = BTreeMap<String, Tensor>;

/// Returns the bytes of a file of this kind.
///
/// # Errors
/// [`ModelFileError::NotFinite`], and [`ModelFileError::Shape`] for tensors that are not `f32`.
pub(crate) fn write<T: Serialize>(
    kind: &str,
    about: &T,
    numbers: &Numbers,
) -> Result<Vec<u8>, ModelFileError> {
    let data: BTreeMap<&str, (Vec<usize>, Vec<u8>)> = numbers
        .iter()
        .map(|(name, tensor)| {
            let values = tensor.flatten_all()?.to_device(&Device::Cpu)?.to_vec1::<f32>()?;
            check_finite(name, &values)?;
            let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
            Ok((name.as_str(), (tensor.dims().to_vec(), bytes)))
        })
        .collect::<Result<_, ModelFileError>>()?;
    let sha256 = hash(data.iter().map(|(name, (shape, bytes))| (*name, &shape[..], &bytes[..])));
    let about = serde_json::to_value(about)?;
    let header = Header { format: FORMAT.to_owned(), version: VERSION, kind: kind.to_owned(), sha256, about };
    // A single metadata key, so that the same model gives the same bytes.
    let metadata = HashMap::from([(KEY.to_owned(), serde_json::to_string(&header)?)]);
    let views = data
        .iter()
        .map(|(name, (shape, bytes))| {
            let view = safetensors::tensor::TensorView::new(safetensors::Dtype::F32, shape.clone(), bytes)?;
            Ok((*name, view))
        })
        .collect::<Result<Vec<_>, safetensors::SafeTensorError>>()?;
    Ok(safetensors::serialize(views, Some(metadata))?)
}

/// Returns the kind of a file.
///
/// # Errors
/// [`ModelFileError`] if the file is damaged, foreign or newer.
pub fn kind_of(bytes: &[u8]) -> Result<String, ModelFileError> {
    Ok(header_of(bytes)?.kind)
}

fn header_of(bytes: &[u8]) -> Result<Header, ModelFileError> {
    let (_, metadata) = SafeTensors::read_metadata(bytes)?;
    let header = metadata.metadata().as_ref().and_then(|metadata| metadata.get(KEY));
    let header: Header = serde_json::from_str(header.ok_or(ModelFileError::Foreign)?)?;
    if header.format != FORMAT {
        return Err(ModelFileError::Foreign);
    }
    if header.version > VERSION {
        return Err(ModelFileError::Version { version: header.version });
    }
    Ok(header)
}

/// Returns the metadata and tensors of a file of this kind.
///
/// # Errors
/// [`ModelFileError`] if the file is damaged, foreign, newer, of another kind or not finite.
pub(crate) fn read<T: for<'de> Deserialize<'de>>(
    kind: &'static str,
    bytes: &[u8],
    device: &Device,
) -> Result<(T, Numbers), ModelFileError> {
    let header = header_of(bytes)?;
    if header.kind != kind {
        return Err(ModelFileError::Kind { found: header.kind, expected: kind });
    }
    let tensors = SafeTensors::deserialize(bytes)?;
    let mut views = tensors.tensors();
    views.sort_by(|(a, _), (b, _)| a.cmp(b));
    if hash(views.iter().map(|(name, view)| (name.as_str(), view.shape(), view.data()))) != header.sha256 {
        return Err(ModelFileError::Hash);
    }
    let mut numbers = Numbers::new();
    for (name, view) in &views {
        let (values, _) = view.data().as_chunks::<4>();
        let values: Vec<f32> = values.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        check_finite(name, &values)?;
        numbers.insert(name.clone(), Tensor::from_vec(values, view.shape(), device)?);
    }
    Ok((serde_json::from_value(header.about)?, numbers))
}

fn check_finite(name: &str, values: &[f32]) -> Result<(), ModelFileError> {
    if values.iter().all(|value| value.is_finite()) {
        Ok(())
    } else {
        Err(ModelFileError::NotFinite { name: name.to_owned() })
    }
}

/// Returns whether a file is a Shagreen model of any kind and version.
pub fn is_model(bytes: &[u8]) -> bool {
    SafeTensors::read_metadata(bytes)
        .is_ok_and(|(_, metadata)| metadata.metadata().as_ref().is_some_and(|m| m.contains_key(KEY)))
}

/// Returns the SHA-256 of a file in hexadecimal, which is reported with every prediction.
pub fn sha256_of(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}

fn hash<'a>(tensors: impl Iterator<Item = (&'a str, &'a [usize], &'a [u8])>) -> String {
    let mut hasher = Sha256::new();
    for (name, shape, bytes) in tensors {
        hasher.update(format!("{name} {shape:?} {}\n", bytes.len()));
        hasher.update(bytes);
    }
    format!("{:x}", hasher.finalize())
}

#[cfg(test)]
mod tests {
    use super::{ModelFileError, Numbers, hash, read, write};
    use candle_core::{Device, Tensor};
    use safetensors::SafeTensors;

    fn numbers() -> Numbers {
        let tensor = |values: &[f32]| Tensor::new(values, &Device::Cpu).unwrap();
        Numbers::from([("a".to_owned(), tensor(&[1.0, 2.0])), ("b".to_owned(), tensor(&[-3.5]))])
    }

    fn failure(bytes: &[u8]) -> ModelFileError {
        read::<u32>("toy", bytes, &Device::Cpu).unwrap_err()
    }

    #[test]
    fn what_is_written_is_read_again_and_is_always_the_same() {
        let bytes = write("toy", &7, &numbers()).unwrap();
        assert_eq!(bytes, write("toy", &7, &numbers()).unwrap());
        let (about, read) = read::<u32>("toy", &bytes, &Device::Cpu).unwrap();
        assert_eq!(about, 7);
        assert_eq!(read["a"].to_vec1::<f32>().unwrap(), [1.0, 2.0]);
        assert_eq!(read["b"].to_vec1::<f32>().unwrap(), [-3.5]);
    }

    #[test]
    fn numbers_that_are_none_are_neither_written_nor_read() {
        let with = |value: f32| {
            let mut numbers = numbers();
            numbers.insert("c".to_owned(), Tensor::new(&[1.0, value], &Device::Cpu).unwrap());
            numbers
        };
        let is_refused =
            |error: ModelFileError| matches!(error, ModelFileError::NotFinite { name } if name == "c");
        assert!(is_refused(write("toy", &7, &with(f32::NAN)).unwrap_err()));
        // A foreign file with a valid hash.
        let bytes_of = |value: f32| [1.0, value].map(f32::to_le_bytes).concat();
        let bytes = write("toy", &7, &with(3.5)).unwrap();
        let at = bytes.windows(8).position(|window| window == bytes_of(3.5)).unwrap();
        let mut changed = bytes.clone();
        changed[at..at + 8].copy_from_slice(&bytes_of(f32::INFINITY));
        let [before, after] = [&bytes, &changed].map(|bytes| {
            let tensors = SafeTensors::deserialize(bytes).unwrap();
            let mut views = tensors.tensors();
            views.sort_by(|(a, _), (b, _)| a.cmp(b));
            hash(views.iter().map(|(name, view)| (name.as_str(), view.shape(), view.data())))
        });
        let at = changed.windows(64).position(|window| window == before.as_bytes()).unwrap();
        changed[at..at + 64].copy_from_slice(after.as_bytes());
        assert!(is_refused(failure(&changed)));
    }

    #[test]
    fn what_is_damaged_cut_or_something_else_is_refused() {
        let bytes = write("toy", &7, &numbers()).unwrap();
        let mut changed = bytes.clone();
        *changed.last_mut().unwrap() ^= 1;
        assert!(matches!(failure(&changed), ModelFileError::Hash));
        for end in 0..bytes.len() {
            assert!(matches!(failure(&bytes[..end]), ModelFileError::Tensors(_)), "cut to {end}");
        }
        assert!(super::is_model(&bytes) && super::is_model(&changed) && !super::is_model(&bytes[..40]));
        let other = write("other toy", &7, &numbers()).unwrap();
        assert_eq!(super::kind_of(&other).unwrap(), "other toy");
        assert!(matches!(failure(&other), ModelFileError::Kind { found, .. } if found == "other toy"));
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let later = text.replace(r#"\"version\":1"#, r#"\"version\":2"#);
        assert_ne!(later, text);
        // Lossy conversion may corrupt the weights; only the header matters here.
        assert!(matches!(
            failure(later.as_bytes()),
            ModelFileError::Version { version: 2 } | ModelFileError::Tensors(_)
        ));
        let foreign =
            safetensors::serialize(Vec::<(&str, safetensors::tensor::TensorView<'_>)>::new(), None).unwrap();
        assert!(matches!(failure(&foreign), ModelFileError::Foreign) && !super::is_model(&foreign));
    }
}
