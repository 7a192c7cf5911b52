//! Third-party networks on this machine: the user's files, which the program uses and checks, but never redistributes.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, ensure};
use serde::{Deserialize, Serialize};
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_learn::backbone::Backbone;
use shagreen_learn::diffusion::{Diffusion, Files, Part};
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::picture_predictor::PicturePredictor;

use crate::file::{file_name, reason_of};

/// License of EfficientNet-Lite0, as an SPDX expression.
pub const EFFICIENTNET_LITE0_LICENSE: &str = "Apache-2.0";

/// Folder of the networks, and of the records of networks elsewhere; it need not exist yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelFolder {
    folder: PathBuf,
}

/// Registered diffusion model: its folder, and the hashes of its files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AddedDiffusion {
    /// Format name of the record.
    format: String,
    /// Folder of the model's files.
    pub folder: PathBuf,
    /// SHA-256 of each file, by its name in the folder.
    pub sha256: BTreeMap<String, String>,
}

/// Value of the field `format` of [`AddedDiffusion`].
const ADDED: &str = "shagreen-diffusion";

impl AddedDiffusion {
    /// Returns the name of the model, as pictures record it.
    pub fn name(&self) -> String {
        format!("diffusion model \"{}\"", file_name(&self.folder))
    }
}

impl ModelFolder {
    /// Returns the model folder at this path.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Returns the path of EfficientNet-Lite0, which exists once it was downloaded.
    pub fn efficientnet_lite0(&self) -> PathBuf {
        self.folder.join("efficientnet-lite0.safetensors")
    }

    /// Reads the backbone network for pictures; `None` if it was not downloaded.
    ///
    /// # Errors
    /// The file cannot be read, or is damaged.
    pub fn backbone(&self) -> anyhow::Result<Option<Backbone>> {
        let path = self.efficientnet_lite0();
        if !path.is_file() {
            return Ok(None);
        }
        let backbone = Backbone::from_bytes(&read(&path)?);
        backbone.map(Some).with_context(|| {
            format!(
                "the downloaded network is damaged; fetch the network again with `shagreen model fetch`: {}",
                path.display()
            )
        })
    }

    /// Returns the picture predictor, with the downloaded backbone network or else with texture statistics.
    ///
    /// # Errors
    /// As [`ModelFolder::backbone`].
    pub fn looker(&self) -> anyhow::Result<PicturePredictor> {
        Ok(PicturePredictor::built_in(self.backbone()?)?)
    }

    /// Registers a diffusion model after checking that it is complete.
    ///
    /// # Errors
    /// The folder is not that of a model, or a file cannot be read.
    pub fn add_diffusion(&self, from: &Path) -> anyhow::Result<AddedDiffusion> {
        let from = from.canonicalize().map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => anyhow!("there is no such folder; check its name: {}", from.display()),
            _ => anyhow!("the folder cannot be read: {}: {}", reason_of(&error), from.display()),
        })?;
        let (files, sha256) = read_parts(&from)?;
        Diffusion::new(files).with_context(|| format!("this model cannot be used: {}", from.display()))?;
        let added = AddedDiffusion { format: ADDED.to_owned(), folder: from, sha256 };
        std::fs::create_dir_all(&self.folder).with_context(|| {
            format!("cannot create the folder; check your permissions: {}", self.folder.display())
        })?;
        atomic::write(&self.added(), &serde_json::to_vec_pretty(&added)?)?;
        Ok(added)
    }

    /// Returns the registered diffusion model; `None` if there is none.
    ///
    /// # Errors
    /// The record is damaged.
    pub fn added_diffusion(&self) -> anyhow::Result<Option<AddedDiffusion>> {
        let path = self.added();
        if !path.is_file() {
            return Ok(None);
        }
        let added: AddedDiffusion = serde_json::from_slice(&read(&path)?).with_context(|| {
            format!("the record of the diffusion model is damaged; add the model again with `shagreen model add`: {}", path.display())
        })?;
        ensure!(
            added.format == ADDED,
            "this file is not the record of a diffusion model; add the model again with `shagreen model add`: {}",
            path.display()
        );
        Ok(Some(added))
    }

    /// Reads a registered model, whose files must be unchanged.
    ///
    /// # Errors
    /// A file is missing, was changed or cannot be read.
    pub fn diffusion(&self, added: &AddedDiffusion) -> anyhow::Result<Diffusion> {
        let (files, sha256) = read_parts(&added.folder)?;
        let mut names = added.sha256.keys().chain(sha256.keys());
        if let Some(name) = names.find(|name| added.sha256.get(*name) != sha256.get(*name)) {
            anyhow::bail!(
                "this file of the model was changed since the model was added; restore it, or add the model again: {}",
                added.folder.join(name).display()
            );
        }
        Diffusion::new(files)
            .with_context(|| format!("this model cannot be used: {}", added.folder.display()))
    }

    fn added(&self) -> PathBuf {
        self.folder.join("diffusion.json")
    }
}

/// Reads the files of a model that exist, and computes their hashes.
fn read_parts(folder: &Path) -> anyhow::Result<(Files, BTreeMap<String, String>)> {
    let (mut files, mut sha256) = (Files::default(), BTreeMap::new());
    for part in Part::ALL {
        let Some(name) = part.names().iter().find(|name| folder.join(name).is_file()) else { continue };
        let bytes = read(&folder.join(name))?;
        sha256.insert((*name).to_owned(), sha256_of(&bytes));
        files.add(part, bytes);
    }
    Ok((files, sha256))
}

fn read(path: &Path) -> anyhow::Result<Vec<u8>> {
    bounded_file::read(path, FileKind::Network)
        .map_err(|error| anyhow!("cannot read the file: {}: {}", reason_of(&error), path.display()))
}

#[cfg(test)]
mod tests {
    use super::ModelFolder;
    use shagreen_formats::picture::decode;
    use shagreen_formats::starter::starter_library;
    use shagreen_learn::picture_predictor::PicturePredictor;

    /// No picture of the starter library was used for training. `shagreen train photo --drawn-only` reports mean
    /// absolute errors of 7.8 and 5.9 on them.
    #[test]
    fn pictures_of_the_starter_library_are_told_without_any_network() {
        let looker = PicturePredictor::built_in(None).unwrap();
        let library = starter_library().unwrap();
        let mut off = [0.0; 2];
        for texture in &library.textures {
            let packed = texture.picture.as_ref().unwrap();
            let seen = looker.look(&decode(packed).unwrap().into_surface(packed.millimeters)).unwrap();
            let at = texture.at().unwrap();
            let pairs = seen.attributes.iter().zip([at.x(), at.y()]);
            for (off, (seen, at)) in off.iter_mut().zip(pairs) {
                *off += (seen.mean - at).abs() / library.textures.len() as f64;
            }
        }
        assert!(off[0] < 8.2 && off[1] < 7.0, "{off:?}");
    }

    #[test]
    fn a_folder_without_networks_has_none_and_one_with_something_else_says_so() {
        let folder = tempfile::tempdir().unwrap();
        let models = ModelFolder::new(folder.path().join("models"));
        assert!(models.backbone().unwrap().is_none() && models.added_diffusion().unwrap().is_none());
        let error = format!("{:#}", models.add_diffusion(folder.path()).unwrap_err());
        assert!(error.contains("layout of diffusers"), "{error}");
        std::fs::create_dir(folder.path().join("models")).unwrap();
        std::fs::write(models.efficientnet_lite0(), b"not a network").unwrap();
        let error = format!("{:#}", models.backbone().unwrap_err());
        assert!(error.contains("fetch the network again") && error.contains("safetensors"), "{error}");
        std::fs::write(folder.path().join("models/diffusion.json"), b"{}").unwrap();
        assert!(models.added_diffusion().unwrap_err().to_string().contains("add the model again"));
    }
}
