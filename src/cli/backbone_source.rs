//! Which network looks at pictures: a file of the user's, the one that was fetched, or none.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use shagreen_learn::backbone::Backbone;

use crate::cli::model_folder::model_folder;
use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct BackboneArgs {
    /// The network that looks at pictures, as safetensors: EfficientNet-Lite0, or ResNet-50 by the names of torchvision;
    /// "none" looks by statistics alone. Without it the one that `shagreen model fetch` brought, or none.
    #[arg(long, value_name = "FILE")]
    backbone: Option<PathBuf>,
}

impl BackboneArgs {
    /// The file that was named.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.backbone.as_deref().filter(|path| !is_none(path))
    }
}

fn is_none(path: &Path) -> bool {
    path == Path::new("none")
}

/// The network that the arguments name.
pub(crate) fn read_backbone(args: &BackboneArgs) -> anyhow::Result<Option<Backbone>> {
    match &args.backbone {
        Some(path) if is_none(path) => Ok(None),
        Some(path) => {
            let backbone = Backbone::from_bytes(&output::read_file(path)?);
            backbone.map(Some).with_context(|| output::in_file(path))
        }
        // A system without a folder for networks has none.
        None => model_folder().map_or(Ok(None), |folder| folder.backbone()),
    }
}
