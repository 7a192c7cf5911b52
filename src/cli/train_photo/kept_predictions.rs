//! What was predicted without each texture, kept in a folder: an interrupted training goes on, and several computers can divide it.

use std::path::{Path, PathBuf};

use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::left_out_prediction::LeftOutPrediction;
use shagreen_formats::library::id_from_name;
use shagreen_formats::project::sha256_hex;
use shagreen_learn::picture_model::{PictureConfig, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

use crate::cli::output;

/// Predictions of one training, in a folder if there is one.
pub(super) struct KeptPredictions<'a> {
    folder: Option<&'a Path>,
    /// First part of the names of the files.
    name: String,
    /// Hash of everything that the predictions depend on.
    inputs: String,
}

impl<'a> KeptPredictions<'a> {
    /// Predictions of the training with these settings on drawn pictures and on `known` ones of each texture.
    pub(super) fn new(
        folder: Option<&'a Path>,
        (lesson, config): (&TrainingMetadata, &PictureConfig),
        drawn: &[Seen],
        known: &[Vec<Seen>],
    ) -> Self {
        let mut inputs = format!("{} {lesson:?} {config:?}\n", output::CREATED_BY);
        for pictures in [drawn].into_iter().chain(known.iter().map(Vec::as_slice)) {
            // The end of a texture is a part of it: its pictures are left out together.
            inputs.extend(pictures.iter().map(hash).chain(["\n".to_owned()]));
        }
        let name = format!("photo-{}", id_from_name(lesson.eyes.name()));
        Self { folder, name, inputs: sha256_hex(inputs.as_bytes()) }
    }

    /// The kept prediction for the texture with this index, if there is one of this training.
    pub(super) fn read(&self, index: usize) -> Option<LeftOutPrediction> {
        let bytes = bounded_file::read(&self.path(index)?, FileKind::Small).ok()?; // Without a readable file, it is made again.
        LeftOutPrediction::read(&bytes, &self.inputs)
    }

    /// Keeps the prediction for the texture with this index.
    pub(super) fn write(&self, index: usize, prediction: &LeftOutPrediction) -> anyhow::Result<()> {
        if let Some(path) = self.path(index) {
            atomic::write(&path, &prediction.to_bytes(&self.inputs))?;
        }
        Ok(())
    }

    fn path(&self, index: usize) -> Option<PathBuf> {
        Some(self.folder?.join(format!("{}-without-{:03}.json", self.name, index + 1)))
    }
}

/// Hash of the features and labels of a picture, in hexadecimal digits.
fn hash(seen: &Seen) -> String {
    let features = seen.features.iter().flat_map(|x| x.to_le_bytes());
    let labels = seen.labels.iter().flat_map(|x| x.to_le_bytes());
    sha256_hex(&features.chain(labels).collect::<Vec<u8>>())
}
