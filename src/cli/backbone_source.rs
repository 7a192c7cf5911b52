//! The image backbone that extracts features from pictures: a file of the user, the downloaded network, or none.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use shagreen_learn::backbone::Backbone;

use crate::cli::model_folder::model_folder;
use shagreen_formats::bounded_file::FileKind;
use shagreen_studio::file;

#[derive(clap::Args)]
pub(crate) struct BackboneArgs {
    /// Pretrained image network (backbone), as a safetensors file: EfficientNet-Lite0, or ResNet-50 with torchvision's
    /// tensor names. "none" uses only statistics of the picture. Default: the network that `shagreen model fetch`
    /// downloaded, otherwise none.
    #[arg(long, value_name = "FILE")]
    backbone: Option<PathBuf>,
}

impl BackboneArgs {
    /// Returns the file that was named.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.backbone.as_deref().filter(|path| !is_none(path))
    }

    /// Returns whether a file or "none" was named.
    pub(crate) fn is_given(&self) -> bool {
        self.backbone.is_some()
    }
}

fn is_none(path: &Path) -> bool {
    path == Path::new("none")
}

/// Reads the network that the arguments specify.
pub(crate) fn read_backbone(args: &BackboneArgs) -> anyhow::Result<Option<Backbone>> {
    match &args.backbone {
        Some(path) if is_none(path) => Ok(None),
        Some(path) => {
            let backbone = Backbone::from_bytes(&file::read_file(path, FileKind::Network)?);
            backbone.map(Some).with_context(|| file::in_file(path))
        }
        // Without a folder for user files there is no downloaded network.
        None => model_folder().map_or(Ok(None), |folder| folder.backbone()),
    }
}
